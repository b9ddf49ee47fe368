//! Memory that reading a height file takes: at most four times its honest size, which is that of
//! the file or of its samples as 32-bit floats, whichever is more.

#[path = "support/tiff_file.rs"]
mod tiff_file;

use peak_alloc::PeakAlloc;
use terraline::scene::Interpretation;
use terraline::scene::height_map::source;
use tiff_file::{Form, Kind, LONG, Layout, TiffFile, pack};

#[global_allocator]
static PEAK: PeakAlloc = PeakAlloc;

/// Tables, buffers and messages that do not grow with the file.
const CONSTANT: usize = 1 << 20;

/// Reads a file on disk and checks what that took; whether it was read.
fn check(what: &str, bytes: &[u8], name: &str) -> bool {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).expect("a file");
    let before = PEAK.current_usage();
    PEAK.reset_peak_usage();
    let read = source::read(&path, &Interpretation::default());
    let taken = PEAK.peak_usage() - before;
    let decoded = read.as_ref().map_or(0, |file| 4 * file.map.samples().len());
    let honest = bytes.len().max(decoded);
    assert!(taken <= 4 * honest + CONSTANT, "{what}: {taken} bytes for an honest size of {honest}");
    read.is_ok()
}

/// One test, because the allocator counts all threads.
#[test]
fn reading_takes_at_most_four_times_the_honest_size() {
    let side = 700;
    for kind in Kind::ALL {
        for compression in [1, 5, 8, 32773] {
            for layout in [Layout::Strips(usize::MAX), Layout::Strips(1), Layout::Tiles(256, 256)] {
                let predictor = if kind.format == 3 { 3 } else { 2 };
                let form = Form { kind, compression, predictor, layout, ..Form::plain() };
                let file = TiffFile::new(side, side, &form, |i, j| ((i * j) % 100) as f64);
                assert!(check(&format!("{form:?}"), &file.bytes(), "a.tif"), "{form:?}");
            }
        }
    }
    // A map of one column in tiles that are as wide as may be.
    let zeros = pack(&vec![0; 16384 * 64 * 8], 8);
    let kind = Kind { format: 3, bits: 64 };
    let form = Form { kind, compression: 8, layout: Layout::Tiles(16, 64), ..Form::plain() };
    let mut wide = TiffFile::new(1, 64, &form, |_, _| 0.0).with(322, LONG, &[16384]);
    wide.blocks = vec![zeros.clone()];
    assert!(check("wide tiles", &wide.bytes(), "a.tif"));

    // Georeference and texts that are larger than the map.
    let geodata = TiffFile::small()
        .with_doubles(33922, &vec![1.0; 6000])
        .with_doubles(33550, &vec![1.0; 5000])
        .with_text(42112, &"x".repeat(50_000))
        .with_text(34737, &"y|".repeat(50_000));
    assert!(check("much geodata", &geodata.bytes(), "a.tif"));

    // Claims that are not true.
    assert!(!check("no claim", &TiffFile::small().without(257).bytes(), "a.tif"));
    let claims =
        [(256, 16384), (257, 4096), (278, u64::from(u32::MAX)), (322, 16384), (323, 16384)];
    for (tag, value) in claims {
        check("a claim", &TiffFile::small().with(tag, LONG, &[value]).bytes(), "a.tif");
        check("a claim", &wide.clone().with(tag, LONG, &[value]).bytes(), "a.tif");
    }
    let grid = "ncols 8192\nnrows 8192\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n";
    assert!(!check("a grid that boasts", grid.as_bytes(), "a.asc"));
    let heights = "1 ".repeat(side * side);
    let grid =
        format!("ncols {side}\nnrows {side}\nxllcorner 0\nyllcorner 0\ncellsize 1\n{heights}");
    assert!(check("a dense grid", grid.as_bytes(), "a.asc"));
    let tile: Vec<u8> =
        (0..1201 * 1201).flat_map(|k: u32| ((k % 999) as u16).to_be_bytes()).collect();
    assert!(check("a tile", &tile, "N00E000.hgt"));
    // A zip file that claims entries by the thousand.
    let mut end = b"PK\x05\x06\0\0\0\0\xff\xff\xff\xff".to_vec();
    end.extend([0; 10]);
    assert!(!check("a zip directory", &[&b"PK\x03\x04"[..], &end].concat(), "a.zip"));
}
