//! Damaged and random files of every format: a map or a message, never a panic.
//!
//! `TERRALINE_FUZZ_CASES` sets the number of cases of each test, `PROPTEST_RNG_SEED` a seed:
//! without it, every run takes a new one.

use std::io::{Cursor, Write as _};
use std::sync::LazyLock;

use image::{ImageBuffer, ImageFormat, Luma, Rgb};
use proptest::prelude::*;
use terraline::scene::height_map::source;
use terraline::scene::{Encoding, Interpretation};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::tiff_file::{Form, Kind, Layout, SHORT, TiffFile};

pub fn cases() -> ProptestConfig {
    let asked = std::env::var("TERRALINE_FUZZ_CASES").ok().and_then(|cases| cases.parse().ok());
    ProptestConfig::with_cases(asked.unwrap_or(256))
}

/// Sound files to damage, with their names.
static SEEDS: LazyLock<Vec<(&'static str, Vec<u8>)>> = LazyLock::new(|| {
    let mut seeds = Vec::new();
    for (compression, predictor) in [(1, 1), (5, 2), (8, 3), (32773, 1)] {
        for (layout, big_endian, big) in [
            (Layout::Strips(7), false, false),
            (Layout::Tiles(16, 16), true, false),
            (Layout::Tiles(32, 16), false, true),
        ] {
            let kind = Kind { format: 3, bits: 32 };
            let form = Form { kind, compression, predictor, layout, big_endian, big };
            let file = TiffFile::new(25, 19, &form, |i, j| (i * j) as f64)
                .with_doubles(33922, &[0.0, 0.0, 0.0, 9.0, 48.0, 0.0])
                .with_doubles(33550, &[0.001, 0.001, 0.0])
                .with(34735, SHORT, &[1, 1, 0, 2, 1024, 0, 1, 2, 2054, 0, 1, 9102])
                .with_text(42113, "-9999");
            seeds.push(("seed.tif", file.bytes()));
        }
    }
    let tile: Vec<u8> = (0..31 * 31).flat_map(|k: i16| (k * 7).to_be_bytes()).collect();
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    zip.start_file("N10E010.hgt", SimpleFileOptions::default()).expect("memory");
    zip.write_all(&tile).expect("memory");
    seeds.push(("seed.zip", zip.finish().expect("memory").into_inner()));
    seeds.push(("N10E010.hgt", tile));
    let grid = "ncols 4\nnrows 3\nxllcorner 10\nyllcorner 40\ncellsize 0.01\nNODATA_value -1\n\
                1 2 3 4\n5 6 7 8\n9 10 -1 12\n";
    seeds.push(("seed.asc", grid.as_bytes().to_vec()));
    let mut png = |image: image::DynamicImage| {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, ImageFormat::Png).expect("memory");
        seeds.push(("seed.png", bytes.into_inner()));
    };
    png(ImageBuffer::from_fn(20, 20, |i, j| Luma([(i * j * 99) as u16])).into());
    png(ImageBuffer::from_fn(20, 20, |i, j| Rgb([1, i as u8, j as u8])).into());
    seeds
});

/// Reads with every encoding; what is refused has a message of one line. Whether any was read.
pub fn try_all(bytes: &[u8], name: &str) -> bool {
    let mut read = false;
    for (_, encoding) in Encoding::NAMES {
        match source::decode(bytes, name, &Interpretation::encoded(encoding)) {
            Ok(file) => {
                read = true;
                let (columns, rows) = (file.map.columns(), file.map.rows());
                assert_eq!(file.map.samples().len(), columns * rows);
                assert!(file.map.samples().iter().all(|sample| !sample.is_infinite()));
                let (low, high) = file.map.range();
                assert!(low <= high, "{low} to {high}");
                if let Some(cell) = file.georeference.cell_m(columns, rows) {
                    assert!(cell.is_finite() && cell.min_element() >= 0.0, "{cell}");
                }
                if let Some(far) = file.georeference.far_corner(columns, rows) {
                    assert!(far.is_finite(), "{far}");
                }
                for note in &file.notes {
                    assert_eq!(note.lines().count(), 1, "{note}");
                    assert!(note.len() < 600, "{note}");
                }
            }
            Err(error) => {
                let message = error.to_string();
                assert_eq!(message.lines().count(), 1, "{message}");
                assert!(message.len() < 600, "{message}");
                assert!(!message.contains(char::is_control), "{message:?}");
            }
        }
    }
    read
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn damaged_files(
        seed in 0_usize..1000,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12),
        cut in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        let (name, sound) = &SEEDS[seed % SEEDS.len()];
        let mut bytes = sound.clone();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        try_all(&bytes, name);
    }

    /// Most of a TIFF is samples; this aims at the directory and its values.
    #[test]
    fn damaged_directories(
        seed in 0_usize..12,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let (name, sound) = &SEEDS[seed];
        let mut bytes = sound.clone();
        // Directory and geodata stand at the end, the header at the beginning.
        let tail = 420.min(bytes.len() - 16);
        for (at, byte) in changes {
            let at = at.index(tail + 16);
            let at = if at < 16 { at } else { bytes.len() - (at - 15) };
            bytes[at] = byte;
        }
        try_all(&bytes, name);
    }

    #[test]
    fn random_bytes(
        head in prop::sample::select(vec![
            &b"II\x2A\0\x08\0\0\0"[..], b"MM\0\x2A\0\0\0\x08", b"II\x2B\0\x08\0\0\0", b"PK\x03\x04",
            b"\x89PNG\r\n\x1a\n", b"ncols ", b"nrows 3\nncols 3\ncellsize ", b"",
        ]),
        name in prop::sample::select(vec!["a.tif", "N10E010.hgt", "a.asc", "a.zip", "a"]),
        bytes: Vec<u8>,
    ) {
        try_all(&[head, &bytes].concat(), name);
    }

    #[test]
    fn random_grids(text in "(ncols|nrows|xllcorner|yllcenter|cellsize|dx|nodata_value)( |\n){1,2}[-+.,0-9einaf \r\n]{0,60}") {
        try_all(text.as_bytes(), "a.asc");
    }
}
