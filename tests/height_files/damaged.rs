//! GeoTIFF files that lie, end early or lead in circles.

use super::tiff_file::{Form, Kind, LONG, LONG8, Layout, SHORT, TiffFile};
use super::{read, refused};

#[test]
fn claims_that_the_file_cannot_hold() {
    let small = TiffFile::small;
    for (file, words) in [
        (small().with(256, LONG, &[0]), &["0 x 3"][..]),
        (small().without(257), &["4 x 0"]),
        (small().with(256, LONG, &[20000]), &["cut short", "240000 bytes"]),
        (small().with(256, LONG, &[16384]).with(257, LONG, &[16384]), &["5462 strips"]),
        (small().with(256, LONG, &[1 << 21]), &["2097152 x 3", "gdal_translate"]),
        (small().with(256, LONG, &[16384]).with(257, LONG, &[4096]), &["offsets"]),
        (small().with(256, LONG, &[8000]), &["cut short"]),
        (small().with(278, LONG, &[1]), &["3 strips"]),
        (small().with(273, LONG, &[4_000_000_000]), &["cut short"]),
        (small().with(256, LONG, &[4, 5]), &["tag 256"]),
        (small().with_text(258, "16"), &["tag 258"]),
    ] {
        let mut file = file;
        // Only the last of two entries with one tag is written.
        file.entries.retain({
            let texts: Vec<u16> = file.texts.iter().map(|(tag, _)| *tag).collect();
            move |(tag, ..)| !texts.contains(tag)
        });
        refused(&file.bytes(), "lies.tif", words);
    }
    let tiles = Form { layout: Layout::Tiles(16, 16), ..Form::plain() };
    let tiled = || TiffFile::new(20, 20, &tiles, |i, j| (i + j) as f64);
    for (file, word) in [
        (tiled().with(322, LONG, &[u64::from(u32::MAX)]), "4294967295 pixels"),
        (tiled().with(323, LONG, &[0]), "0 pixels"),
        (tiled().with(322, LONG, &[8192]).with(323, LONG, &[8192]), "cut short"),
    ] {
        refused(&file.bytes(), "tiles.tif", &[word]);
    }
    // One tile, larger than the map and than what its bytes can hold.
    let mut huge = tiled().with(322, LONG, &[16384]).with(323, LONG, &[16384]);
    huge.blocks.truncate(1);
    refused(&huge.bytes(), "huge.tif", &["cut short"]);
}

#[test]
fn directories_that_lead_nowhere() {
    let sound = TiffFile::small().bytes();
    let directory = u32::from_le_bytes(sound[4..8].try_into().unwrap());
    // The last four bytes are the offset of the next directory.
    let with_next = |next: u32| {
        let end = sound.len() - 4;
        [&sound[..end], &next.to_le_bytes()].concat()
    };
    refused(&with_next(directory), "circle.tif", &["circle"]);
    refused(&with_next(u32::MAX), "far.tif", &["outside the file"]);
    refused(&with_next(3), "near.tif", &["TIFF"]);
    let mut none = sound.clone();
    none[4..8].fill(0);
    refused(&none, "none.tif", &["no image"]);
    // BigTIFF with a number of entries that no memory holds.
    let mut big = TiffFile { big: true, ..TiffFile::small() }.bytes();
    let directory = u64::from_le_bytes(big[8..16].try_into().unwrap()) as usize;
    big[directory..directory + 8].fill(0xFF);
    refused(&big, "entries.tif", &["entries"]);
    // A list of offsets that claims more values than the file has bytes.
    let mut file = TiffFile { big: true, ..TiffFile::small() }.with(273, LONG8, &[16]);
    file.next = 0;
    let mut bytes = file.bytes();
    let at = bytes.windows(4).position(|w| w == [17, 1, 16, 0]).expect("the entry") + 4;
    bytes[at..at + 8].copy_from_slice(&(1_u64 << 60).to_le_bytes());
    refused(&bytes, "list.tif", &["cut short"]);
}

#[test]
fn a_file_cut_anywhere_gives_no_map() {
    for compression in [1, 5, 8, 32773] {
        let form = Form {
            compression,
            kind: Kind { format: 2, bits: 16 },
            layout: Layout::Tiles(16, 16),
            ..Form::plain()
        };
        let whole = TiffFile::new(40, 30, &form, |i, j| (i * j) as f64).bytes();
        assert_eq!(read(&whole, "whole.tif").map.columns(), 40);
        for length in 0..whole.len() {
            refused(&whole[..length], "cut.tif", &[]);
        }
    }
}

#[test]
fn blocks_that_unpack_to_too_little() {
    for compression in [5, 8, 32773] {
        let form = Form { compression, ..Form::plain() };
        let mut file = TiffFile::new(32, 32, &form, |i, j| (i * 31 + j * 17) as f64);
        let block = &mut file.blocks[0];
        block.truncate(block.len() / 2);
        refused(&file.bytes(), "short.tif", &["strip or tile 0 cannot be unpacked"]);
        let form = Form { compression, ..Form::plain() };
        let mut file = TiffFile::new(32, 32, &form, |i, j| (i * 31 + j * 17) as f64);
        file.blocks[0].fill(0x80);
        refused(&file.bytes(), "noise.tif", &["strip or tile 0"]);
    }
    let file = TiffFile::small().with(259, SHORT, &[8]);
    refused(&file.bytes(), "plain.tif", &["cannot be unpacked"]);
}
