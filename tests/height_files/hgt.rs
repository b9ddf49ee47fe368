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
    assert_eq!((file.storage.format, file.storage.packed), ("SRTM HGT", Some("zip")));
    refused(&zipped(&[("readme.txt", b"about")]), "a.zip", &["no height file"]);
    let two = zipped(&[("a.hgt", &tile(11)), ("b.hgt", &tile(11))]);
    refused(&two, "a.zip", &["2 height files", "unpack"]);
    for cut in [5, 30, bytes.len() / 2, bytes.len() - 3] {
        refused(&bytes[..cut], "a.zip", &["zip file cannot be unpacked"]);
    }
    let mut damaged = bytes.clone();
    for byte in &mut damaged[200..400] {
        *byte ^= 0x5A;
    }
    refused(&damaged, "a.zip", &["zip file cannot be unpacked"]);
}

#[test]
fn tiles_that_are_none() {
    refused(&tile(1201)[..2_884_800], "N36W085.hgt", &["2884800 bytes", "2884802"]);
    refused(&[], "N36W085.hgt", &["not a tile"]);
    refused(&[1, 2], "N36W085.hgt", &["not a tile"]);
    refused(&[0x80, 0, 0x80, 0, 0x80, 0, 0x80, 0], "N36W085.hgt", &["no node has data"]);
}

#[test]
fn tiles_towards_the_poles_have_fewer_columns() {
    let heights = (0..1801 * 3601).flat_map(|k| ((k % 1801) as i16).to_be_bytes());
    let file = read(&heights.collect::<Vec<u8>>(), "N55E010.hgt");
    assert_eq!((file.map.columns(), file.map.rows()), (1801, 3601));
    assert_eq!(file.georeference.cell, Some(DVec2::new(1.0 / 1800.0, 1.0 / 3600.0)));
    assert_eq!(file.map.sample(1800, 7), 1800.0);
    assert!(file.notes.is_empty(), "{:?}", file.notes);
}

#[test]
fn rasters_of_floats_under_the_same_ending_are_refused() {
    let phase = |k: i32| (k as f32 / 37.0).sin() * 3.0;
    let little: Vec<u8> = (0..10_000).flat_map(|k| phase(k).to_le_bytes()).collect();
    refused(&little, "20200101.geo.hgt", &["32-bit floats (little-endian)", "gdal_translate"]);
    let big: Vec<u8> = (0..10_000).flat_map(|k| phase(k).to_be_bytes()).collect();
    refused(&big, "20200101.geo.hgt", &["32-bit floats (big-endian)"]);
    // Cliffs, voids and seas are heights.
    let cliff = |k: i32| if k % 141 < 70 { 0_i16 } else { 4000 + (k % 7) as i16 };
    let steep: Vec<u8> = (0..141 * 141).flat_map(|k| cliff(k).to_be_bytes()).collect();
    assert_eq!(read(&steep, "N36W085.hgt").map.range(), (0.0, 4006.0));
}

#[test]
fn remarks_of_an_operating_system_are_no_tiles() {
    let tile = tile(11);
    for name in ["__MACOSX/._N36W085.hgt", "._N36W085.hgt", "a/.hidden.hgt"] {
        let file = read(&zipped(&[("N36W085.hgt", &tile), (name, b"remark")]), "a.zip");
        assert_eq!(file.map.columns(), 11, "{name}");
    }
}

#[test]
fn other_formats_in_zip_and_gzip() {
    let tiff = super::tiff_file::TiffFile::small().bytes();
    let file = read(&zipped(&[("dem/map.tif", &tiff)]), "map.zip");
    assert_eq!((file.storage.format, file.storage.packed), ("GeoTIFF", Some("zip")));
    let gzip = |bytes: &[u8]| {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        encoder.write_all(bytes).expect("memory");
        encoder.finish().expect("memory")
    };
    let file = read(&gzip(&tiff), "map.tif.gz");
    assert_eq!((file.storage.format, file.storage.packed), ("GeoTIFF", Some("gzip")));
    let file = read(&gzip(&tile(31)), "S12W077.hgt.gz");
    assert_eq!(file.georeference.origin, Some(DVec2::new(-77.0, -11.0)));
    refused(&gzip(&gzip(&tiff)), "twice.gz", &["packed file in a packed file"]);
    // Members one after another, and what programs pad a file with.
    let (head, tail) = tiff.split_at(tiff.len() / 2);
    let padded = [gzip(head), gzip(tail), vec![0; 512]].concat();
    assert_eq!(read(&padded, "map.tif.gz").map.columns(), 4);
    // Remedies name a file inside another as GDAL does.
    let odd = super::tiff_file::TiffFile::small().with(266, super::tiff_file::SHORT, &[2]).bytes();
    refused(&gzip(&odd), "a.tif.gz", &["gdal_translate /vsigzip/a.tif.gz a-new.tif"]);
    let zip = zipped(&[("dem/map.tif", &odd)]);
    refused(&zip, "b.zip", &["gdal_translate /vsizip/b.zip/dem/map.tif map-new.tif"]);
    refused(b"PK\x05\x06", "empty.zip", &["without any file"]);
    let whole = gzip(&tiff);
    refused(&whole[..whole.len() / 2], "cut.gz", &["gzip file cannot be unpacked"]);
}
