//! Heights packed into colours, and files of no known format.

use std::io::Cursor;

use image::{ImageBuffer, ImageFormat, Rgb, Rgba};
use terraline::scene::Encoding;
use terraline::scene::height_map::source;

use super::{refused, tiff_file::TiffFile};

fn png(image: impl Into<image::DynamicImage>) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.into().write_to(&mut bytes, ImageFormat::Png).expect("memory");
    bytes.into_inner()
}

#[test]
fn packed_heights() {
    // 0 m in Terrain-RGB is 100000 tenths; 8848.9 m is 188489 tenths.
    let bytes = |value: u32| [(value >> 16) as u8, (value >> 8) as u8, value as u8];
    let tile = ImageBuffer::from_fn(2, 2, |i, j| {
        Rgb(bytes([[100_000, 188_489], [0, 99_999]][j as usize][i as usize]))
    });
    let file = source::decode(&png(tile), "t.png", Encoding::TerrainRgb).unwrap();
    assert_eq!(file.map.samples(), [0.0, 8848.9, -10_000.0, -0.1]);
    assert_eq!(file.georeference.height_unit_m, Some(1.0));
    let tile = ImageBuffer::from_fn(2, 1, |i, _| {
        if i == 0 { Rgba([129_u8, 44, 64, 255]) } else { Rgba([1, 2, 3, 0]) }
    });
    let file = source::decode(&png(tile), "t.png", Encoding::Terrarium).unwrap();
    assert_eq!(file.map.sample(0, 0), 300.25);
    assert!(file.map.sample(1, 0).is_nan());
}

#[test]
fn the_key_is_named_where_it_is_missing_and_refused_where_it_is_wrong() {
    let color = png(ImageBuffer::<Rgb<u8>, _>::new(3, 3));
    refused(&color, "c.png", &["colour", "surface.encoding", "terrain-rgb", "terrarium"]);
    let grey = png(ImageBuffer::<image::Luma<u8>, _>::new(3, 3));
    let error = source::decode(&grey, "g.png", Encoding::Terrarium).unwrap_err().to_string();
    assert!(error.contains("terrarium") && error.contains("8 bits of red"), "{error}");
    let tiff = TiffFile::small().bytes();
    let error = source::decode(&tiff, "g.tif", Encoding::TerrainRgb).unwrap_err().to_string();
    assert!(error.contains("PNG files"), "{error}");
}

#[test]
fn unknown_formats_are_named_where_they_can_be() {
    for (bytes, name, word) in [
        (&b""[..], "a.tif", "empty"),
        (b"\x1f\x8b\x08\0", "a.hgt.gz", "gunzip"),
        (b"\xff\xd8\xff\xe0", "a.tif", "JPEG"),
        (b"\x89HDF\r\n\x1a\n", "a.nc", "HDF5"),
        (b"CDF\x01", "a.nc", "netCDF"),
        (b"MOUNT ST. HELENS", "a.dem", "USGS"),
        (b"notes", "a.tif", "not a TIFF"),
        (b"notes", "a.asc", "ncols"),
        (b"notes", "a.txt", "no known format"),
    ] {
        refused(bytes, name, &[word]);
    }
}
