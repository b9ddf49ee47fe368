//! Heights packed into colours, and files of no known format.

use std::io::Cursor;

use image::{ImageBuffer, ImageFormat, Rgb, Rgba};
use terraline::scene::height_map::source;
use terraline::scene::{Encoding, Interpretation};

use super::forged::{deflated, png as chunks};
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
    let file = source::decode(&png(tile), "t.png", &Interpretation::encoded(Encoding::TerrainRgb))
        .unwrap();
    assert_eq!(file.map.samples(), [0.0, 8848.9, -10_000.0, -0.1]);
    assert_eq!(file.georeference.height_unit_m, Some(1.0));
    let tile = ImageBuffer::from_fn(2, 1, |i, _| {
        if i == 0 { Rgba([129_u8, 44, 64, 255]) } else { Rgba([1, 2, 3, 0]) }
    });
    let file =
        source::decode(&png(tile), "t.png", &Interpretation::encoded(Encoding::Terrarium)).unwrap();
    assert_eq!(file.map.sample(0, 0), 300.25);
    assert!(file.map.sample(1, 0).is_nan());
}

#[test]
fn the_key_is_named_where_it_is_missing_and_refused_where_it_is_wrong() {
    let color = png(ImageBuffer::<Rgb<u8>, _>::new(3, 3));
    refused(&color, "c.png", &["colour", "surface.encoding", "terrain-rgb", "terrarium"]);
    let grey = png(ImageBuffer::<image::Luma<u8>, _>::new(3, 3));
    let error = source::decode(&grey, "g.png", &Interpretation::encoded(Encoding::Terrarium))
        .unwrap_err()
        .to_string();
    assert!(error.contains("terrarium") && error.contains("8 bits of red"), "{error}");
    let tiff = TiffFile::small().bytes();
    let error = source::decode(&tiff, "g.tif", &Interpretation::encoded(Encoding::TerrainRgb))
        .unwrap_err()
        .to_string();
    assert!(error.contains("PNG files"), "{error}");
}

#[test]
fn unknown_formats_are_named_where_they_can_be() {
    for (bytes, name, word) in [
        (&b""[..], "a.tif", "empty"),
        (b"\x1f\x8b\x08\0", "a.hgt.gz", "cannot be unpacked"),
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

#[test]
fn a_palette_holds_packed_heights_too() {
    // Two colours, each a height: 128·256 + 3 and 128·256 + 200 less 32768.
    let palette = |colors: &[u8]| {
        let header = [&2_u32.to_be_bytes()[..], &1_u32.to_be_bytes(), &[8, 3, 0, 0, 0]].concat();
        let image = deflated(&[0, 1, 0]);
        chunks(&[
            (b"IHDR", header),
            (b"PLTE", colors.to_vec()),
            (b"IDAT", image),
            (b"IEND", Vec::new()),
        ])
    };
    let asked = Interpretation::encoded(Encoding::Terrarium);
    let bytes = palette(&[128, 3, 0, 128, 200, 0]);
    let file = source::decode(&bytes, "p.png", &asked).unwrap();
    assert_eq!(file.map.samples(), [200.0, 3.0]);
    refused(&bytes, "p.png", &["palette", "--encoding terrarium"]);
    // Seven bytes are no list of colours.
    let error = source::decode(&palette(&[128, 3, 0, 128, 200, 0, 7]), "p.png", &asked);
    let error = error.unwrap_err().to_string();
    assert!(error.contains("palette"), "{error}");
}
