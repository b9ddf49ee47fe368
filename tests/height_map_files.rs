//! Height maps from PNG: exact samples, and one clear message for every bad file.

use std::io::Cursor;
use std::path::Path;

use image::{GrayImage, ImageBuffer, ImageFormat, Luma, RgbImage};
use proptest::prelude::*;
use terraline::scene::{HeightMap, builtin};

/// A chunk of a PNG file.
fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let mut body = kind.to_vec();
    body.extend_from_slice(data);
    let mut crc = u32::MAX;
    for &byte in &body {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg());
        }
    }
    let mut bytes = u32::try_from(data.len()).expect("short data").to_be_bytes().to_vec();
    bytes.extend(body);
    bytes.extend((!crc).to_be_bytes());
    bytes
}

/// A PNG of any kind, uncompressed: `raw` holds the rows with their filter bytes.
fn png(columns: u32, rows: u32, depth: u8, color: u8, raw: &[u8]) -> Vec<u8> {
    let mut header = [columns.to_be_bytes(), rows.to_be_bytes()].concat();
    header.extend([depth, color, 0, 0, 0]);
    let length = u16::try_from(raw.len()).expect("short rows");
    let mut data = vec![0x78, 0x01, 0x01];
    data.extend(length.to_le_bytes());
    data.extend((!length).to_le_bytes());
    data.extend_from_slice(raw);
    let (mut a, mut b) = (1_u32, 0_u32);
    for &byte in raw {
        a = (a + u32::from(byte)) % 65521;
        b = (b + a) % 65521;
    }
    data.extend(((b << 16) | a).to_be_bytes());
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    bytes.extend(chunk(b"IHDR", &header));
    if color == 3 {
        bytes.extend(chunk(b"PLTE", &[0, 0, 0, 255, 255, 255]));
    }
    bytes.extend(chunk(b"IDAT", &data));
    bytes.extend(chunk(b"IEND", &[]));
    bytes
}

fn encoded(image: impl Into<image::DynamicImage>) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.into().write_to(&mut bytes, ImageFormat::Png).expect("an image that can be written");
    bytes.into_inner()
}

fn message(bytes: &[u8]) -> String {
    HeightMap::from_png(bytes, "hills.png").expect_err("a bad file").to_string()
}

fn assert_says(message: &str, words: &[&str]) {
    for word in words {
        assert!(message.contains(word), "no {word:?} in: {message}");
    }
    assert_eq!(message.lines().count(), 1, "{message}");
}

#[test]
fn every_16_bit_value_is_exact() {
    let image = ImageBuffer::<Luma<u16>, _>::from_fn(256, 256, |x, y| Luma([(y * 256 + x) as u16]));
    let map = HeightMap::from_png(&encoded(image), "all.png").unwrap();
    assert_eq!((map.columns(), map.rows()), (256, 256));
    for (index, &sample) in map.samples().iter().enumerate() {
        assert_eq!(sample, index as f32);
    }
    assert_eq!(map.range(), (0.0, 65535.0));
    assert_eq!(map.sample(3, 2), 515.0);
}

#[test]
fn every_8_bit_value_is_exact() {
    let image = GrayImage::from_fn(32, 8, |x, y| Luma([(y * 32 + x) as u8]));
    let map = HeightMap::from_png(&encoded(image), "all.png").unwrap();
    assert_eq!((map.columns(), map.rows()), (32, 8));
    assert!(map.samples().iter().enumerate().all(|(index, &sample)| sample == index as f32));
}

#[test]
fn a_handmade_png_reads_as_an_encoded_one() {
    let map = HeightMap::from_png(&png(2, 1, 16, 0, &[0, 1, 2, 3, 4]), "two.png").unwrap();
    assert_eq!(map.samples(), [258.0, 772.0]);
}

#[test]
fn colour_palette_transparency_and_few_bits_are_refused() {
    let remedy = "greyscale PNG of 8 or 16 bits";
    assert_says(&message(&encoded(RgbImage::new(2, 2))), &["hills.png", "colour", remedy]);
    assert_says(&message(&encoded(image::GrayAlphaImage::new(2, 2))), &["transparency", remedy]);
    assert_says(&message(&png(2, 1, 8, 3, &[0, 0, 1])), &["palette", remedy]);
    for depth in [1, 2, 4] {
        assert_says(&message(&png(2, 1, depth, 0, &[0, 0])), &["fewer than 8 bits", remedy]);
    }
}

#[test]
fn claims_too_large_are_refused_before_they_are_believed() {
    for (columns, rows) in [(16385, 1), (1, 16385), (u32::MAX >> 1, u32::MAX >> 1)] {
        let size = format!("{columns} x {rows}");
        assert_says(&message(&png(columns, rows, 16, 0, &[0])), &["hills.png", &size, "16384"]);
    }
    assert_says(&message(&png(16384, 16384, 8, 0, &[0])), &["16384 x 16384", "67108864"]);
    // Within the limits, but more than the file can hold.
    assert_says(&message(&png(8192, 8192, 16, 0, &[0])), &["cut short"]);
}

#[test]
fn a_file_cut_anywhere_gives_no_map() {
    let whole = encoded(ImageBuffer::<Luma<u16>, _>::from_fn(64, 64, |x, y| {
        Luma([(x * x * 31 + y * 977) as u16])
    }));
    assert!(HeightMap::from_png(&whole, "whole.png").is_ok());
    for length in 0..whole.len() {
        let text = message(&whole[..length]);
        assert_says(&text, &["hills.png", ";"]);
    }
    let jacksboro = std::fs::read("assets/jacksboro.png").unwrap();
    for length in (0..jacksboro.len()).step_by(97) {
        assert_says(&message(&jacksboro[..length]), &["hills.png", ";"]);
    }
    assert_says(&message(&whole[..whole.len() / 2]), &["cut short", "give the whole file"]);
    assert_says(&message(&[]), &["empty"]);
}

#[test]
fn what_follows_the_last_chunk_does_no_harm() {
    let mut bytes = encoded(GrayImage::new(2, 2));
    bytes.extend_from_slice(b"made by a program that signs its files");
    assert!(HeightMap::from_png(&bytes, "signed.png").is_ok());
}

#[test]
fn files_that_are_no_maps() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing.png");
    let text = HeightMap::read(&missing).unwrap_err().to_string();
    assert_says(&text, &["missing.png", "no such file", "builtin:jacksboro"]);

    let path = folder.path().join("notes.png");
    std::fs::write(&path, "these are notes").unwrap();
    let text = HeightMap::read(&path).unwrap_err().to_string();
    assert_says(&text, &["notes.png", "not a PNG file", "greyscale"]);

    let text = HeightMap::read(folder.path()).unwrap_err().to_string();
    assert_says(&text, &["folder"]);
    if cfg!(unix) {
        let text = HeightMap::read(Path::new("/dev/zero")).unwrap_err().to_string();
        assert_says(&text, &["not a regular file"]);
    }
}

#[test]
fn the_jacksboro_map_is_the_one_it_should_be() {
    let map = HeightMap::read(Path::new("assets/jacksboro.png")).unwrap();
    assert_eq!((map.columns(), map.rows()), (344, 344));
    assert_eq!(map.sample(232, 168), 316.0);
    assert_eq!(builtin::map("jacksboro").unwrap().unwrap().as_ref(), &map);
    assert!(builtin::map("atlantis").is_none());
}

#[test]
fn built_in_maps_come_at_any_resolution() {
    let map = |name: &str| builtin::map(name).expect("a name that is known");
    assert_eq!(map("jacksboro@344").unwrap(), map("jacksboro").unwrap());
    for side in [2, 256, 1000] {
        let map = map(&format!("jacksboro@{side}")).unwrap();
        assert_eq!((map.columns(), map.rows()), (side, side));
    }
    for (nodes, words) in [
        ("", ["`` is not a number", "from 2 to 8192"]),
        ("4k", ["`4k` is not a number", "builtin:jacksboro@4096"]),
        ("-5", ["`-5` is not a number", "from 2 to 8192"]),
        ("12@3", ["`12@3` is not a number", "from 2 to 8192"]),
        ("1", ["1 nodes a side", "from 2 to 8192"]),
        ("8193", ["8193 nodes a side are too many", "from 2 to 8192"]),
        ("99999999999999999999999", ["too many", "from 2 to 8192"]),
    ] {
        let error = map(&format!("jacksboro@{nodes}")).unwrap_err().to_string();
        assert_says(&error, &["builtin:jacksboro@", words[0], words[1]]);
    }
    assert!(builtin::map("atlantis@5").is_none());
}

proptest! {
    #[test]
    fn damaged_files_never_panic(at in 0_usize..4000, byte: u8, cut in 0_usize..4000) {
        let mut bytes = encoded(ImageBuffer::<Luma<u16>, _>::from_fn(24, 24, |x, y| {
            Luma([(x * y * 131) as u16])
        }));
        let at = at % bytes.len();
        bytes[at] = byte;
        let _ = HeightMap::from_png(&bytes, "damaged.png");
        bytes.truncate(cut % bytes.len());
        let _ = HeightMap::from_png(&bytes, "damaged.png");
    }

    #[test]
    fn random_bytes_never_panic(bytes: Vec<u8>, signed: bool) {
        let head: &[u8] = if signed { b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" } else { b"" };
        let bytes = [head, &bytes].concat();
        prop_assert!(HeightMap::from_png(&bytes, "random.png").is_err());
    }
}
