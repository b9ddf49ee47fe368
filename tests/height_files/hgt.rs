//! SRTM tiles, also zipped.

use std::io::{Cursor, Write as _};

use glam::DVec2;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::{read, refused};

/// A tile of `side` x `side` heights with one void.
fn tile(side: usize) -> Vec<u8> {
    let mut heights: Vec<i16> = (0..side * side).map(|k| (k % 5000) as i16 - 100).collect();
    heights[side + 2] = i16::MIN;
    heights.iter().flat_map(|height| height.to_be_bytes()).collect()
}

fn zipped(entries: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in entries {
        zip.start_file(*name, SimpleFileOptions::default()).expect("memory");
        zip.write_all(bytes).expect("memory");
    }
    zip.finish().expect("memory").into_inner()
}

#[test]
fn the_size_decides_and_the_name_places() {
    for side in [1201, 3601, 31] {
        let file = read(&tile(side), "somewhere/S12W077.hgt");
        assert_eq!((file.map.columns(), file.map.rows()), (side, side));
        assert_eq!((file.map.sample(0, 0), file.map.sample(3, 0)), (-100.0, -97.0));
        assert_eq!(file.map.voids(), 1);
        assert!(file.map.sample(2, 1).is_nan());
        let place = file.georeference;
        assert_eq!(place.origin, Some(DVec2::new(-77.0, -11.0)));
        assert_eq!(place.cell, Some(DVec2::splat(1.0 / (side as f64 - 1.0))));
        let far = place.far_corner(side, side).unwrap();
        assert!((far - DVec2::new(-76.0, -12.0)).length() < 1e-9, "{far}");
        assert_eq!((place.epsg, place.height_unit_m), (Some(4326), Some(1.0)));
        assert_eq!(file.notes.len(), usize::from(side == 31), "{:?}", file.notes);
    }
    let nameless = read(&tile(1201), "tile.dat");
    assert!(nameless.notes[0].contains("equator"), "{:?}", nameless.notes);
}

#[test]
fn zipped_tiles() {
    let bytes = zipped(&[("readme.txt", b"about"), ("N36W085.HGT", &tile(101))]);
    let file = read(&bytes, "N36W085.zip");
    assert_eq!(file.map.columns(), 101);
    assert_eq!(file.georeference.origin, Some(DVec2::new(-85.0, 37.0)));
    assert_eq!(file.storage.format, "SRTM HGT in ZIP");
    refused(&zipped(&[("readme.txt", b"about")]), "a.zip", &["no .hgt file"]);
    let two = zipped(&[("a.hgt", &tile(11)), ("b.hgt", &tile(11))]);
    refused(&two, "a.zip", &["2 .hgt files", "unpack"]);
    for cut in [5, 30, bytes.len() / 2, bytes.len() - 3] {
        refused(&bytes[..cut], "a.zip", &["zip file is damaged"]);
    }
    let mut damaged = bytes.clone();
    for byte in &mut damaged[200..400] {
        *byte ^= 0x5A;
    }
    refused(&damaged, "a.zip", &["zip file is damaged"]);
}

#[test]
fn tiles_that_are_none() {
    refused(&tile(1201)[..2_884_800], "N36W085.hgt", &["2884800 bytes", "2884802"]);
    refused(&[], "N36W085.hgt", &["not a square"]);
    refused(&[1, 2], "N36W085.hgt", &["not a square"]);
    refused(&[0x80, 0, 0x80, 0, 0x80, 0, 0x80, 0], "N36W085.hgt", &["no node has data"]);
}
