//! Where a GeoTIFF lies.

use glam::DVec2;
use terraline::scene::HeightFile;
use terraline::scene::height_map::georeference::{Coordinates, PixelIs};
use terraline::scene::height_map::projection::Ellipsoid;

use super::tiff_file::{SHORT, TiffFile};
use super::{read, refused, with_keys};

fn keys(file: TiffFile, keys: &[(u64, u64)]) -> TiffFile {
    with_keys(file, keys, &[], &[])
}

/// 4 x 3 nodes with a tie point at raster (column, row).
fn tied(tie: [f64; 6], scale: [f64; 3]) -> TiffFile {
    TiffFile::small().with_doubles(33922, &tie).with_doubles(33550, &scale)
}

fn place(file: &TiffFile) -> HeightFile {
    read(&file.bytes(), "place.tif")
}

#[test]
fn areas_and_points_put_nodes_at_sample_centres() {
    let file = tied([0.0, 0.0, 0.0, 500.0, 900.0, 0.0], [10.0, 20.0, 0.0]);
    let projected = [(1024, 1), (3072, 32632), (3076, 9001)];
    let area = place(&keys(file.clone(), &[&projected[..], &[(1025, 1)]].concat())).georeference;
    assert_eq!(area.origin, Some(DVec2::new(505.0, 890.0)));
    assert_eq!(area.cell, Some(DVec2::new(10.0, 20.0)));
    assert_eq!(area.far_corner(4, 3), Some(DVec2::new(535.0, 850.0)));
    assert_eq!((area.epsg, area.pixel_is), (Some(32632), Some(PixelIs::Area)));
    assert_eq!(area.cell_m(4, 3), Some(DVec2::new(10.0, 20.0)));
    let point = place(&keys(file, &[&projected[..], &[(1025, 2)]].concat())).georeference;
    assert_eq!(point.origin, Some(DVec2::new(500.0, 900.0)));
    assert_eq!((point.cell, point.pixel_is), (area.cell, Some(PixelIs::Point)));
    // A tie point inside the raster.
    let file = tied([2.0, 1.0, 0.0, 520.0, 880.0, 0.0], [10.0, 20.0, 0.0]);
    let inside = place(&keys(file, &[&projected[..], &[(1025, 2)]].concat())).georeference;
    assert_eq!(inside.origin, point.origin);
}

#[test]
fn units_of_length_and_angle() {
    let file = tied([0.0, 0.0, 0.0, 5.0, 46.0, 0.0], [0.5, 0.25, 0.0]);
    let of = |list: &[(u64, u64)]| place(&keys(file.clone(), list)).georeference;
    let feet = of(&[(1024, 1), (3076, 9002), (4099, 9003)]);
    assert_eq!(feet.coordinates, Coordinates::Lengths { unit_m: 0.3048 });
    assert_eq!(feet.cell_m(4, 3), Some(DVec2::new(0.5, 0.25) * 0.3048));
    assert_eq!(feet.height_unit_m, Some(0.304_800_609_601_219_24));
    let degrees = of(&[(1024, 2), (1025, 2), (2048, 4326), (2054, 9102)]);
    assert_eq!(degrees.coordinates, Coordinates::Degrees);
    assert_eq!(degrees.epsg, Some(4326));
    assert_eq!(degrees.middle_latitude(4, 3), Some(45.75));
    assert_eq!(
        degrees.cell_m(4, 3),
        Some(DVec2::new(0.5, 0.25) * Ellipsoid::WGS84.degree_m(45.75))
    );
    let minutes = of(&[(1024, 2), (2054, 9103)]);
    assert_eq!(minutes.cell, Some(DVec2::new(0.5, 0.25) / 60.0));
    // A unit given by its size.
    let file = keys(file.clone(), &[(1024, 1), (3076, 32767)]).with(
        34735,
        SHORT,
        &[1, 1, 0, 3, 1024, 0, 1, 1, 3076, 0, 1, 32767, 3077, 34736, 1, 1],
    );
    let own = place(&file.clone().with_doubles(34736, &[9.0, 2.5])).georeference;
    refused(
        &file.with_doubles(34736, &[9.0, 1.7e308]).with_doubles(33550, &[1e9, 1e9, 0.0]).bytes(),
        "u.tif",
        &["beyond all numbers"],
    );
    assert_eq!(own.coordinates, Coordinates::Lengths { unit_m: 2.5 });
    let unknown = place(&keys(tied([0.0; 6], [1.0; 3]), &[(1024, 1), (3076, 9999)]));
    assert_eq!(unknown.georeference.coordinates, Coordinates::Lengths { unit_m: 1.0 });
    assert!(unknown.notes[0].contains("EPSG code 9999") && unknown.notes[0].contains("--unit"));
    refused(&keys(tied([0.0; 6], [1.0; 3]), &[(1024, 3)]).bytes(), "g.tif", &["geocentric"]);
}

#[test]
fn what_a_file_leaves_open_is_assumed_aloud() {
    let degrees = place(&tied([0.0, 0.0, 0.0, -84.0, 36.0, 0.0], [0.001, 0.001, 0.0]));
    assert_eq!(degrees.georeference.coordinates, Coordinates::Degrees);
    assert!(degrees.notes[0].contains("degrees"), "{:?}", degrees.notes);
    let metres = place(&tied([0.0, 0.0, 0.0, 500.0, 36.0, 0.0], [0.001, 0.001, 0.0]));
    assert_eq!(metres.georeference.coordinates, Coordinates::Lengths { unit_m: 1.0 });
    assert!(metres.notes[0].contains("metres"), "{:?}", metres.notes);
    let unit = place(&keys(tied([0.0; 6], [1.0; 3]), &[(1024, 1)]));
    assert!(unit.notes[0].contains("metres are assumed"), "{:?}", unit.notes);
    let nothing = place(&TiffFile::small());
    assert_eq!(nothing.georeference.coordinates, Coordinates::Unknown);
    assert_eq!(nothing.georeference.cell_m(4, 3), None);
}

#[test]
fn transformations() {
    let matrix = |a: f64, b: f64, d: f64, e: f64, f: f64, h: f64| {
        let list = [a, b, 0.0, d, e, f, 0.0, h, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        keys(TiffFile::small().with_doubles(34264, &list), &[(1024, 1), (3076, 9001), (1025, 2)])
    };
    let north_up = place(&matrix(10.0, 0.0, 500.0, 0.0, -20.0, 900.0));
    assert_eq!(north_up.georeference.origin, Some(DVec2::new(500.0, 900.0)));
    assert_eq!(north_up.map.sample(0, 0), 0.0);
    // South-up rows are turned over: row 0 is the northern one.
    let south_up = place(&matrix(10.0, 0.0, 500.0, 0.0, 20.0, 860.0));
    assert_eq!(south_up.georeference.origin, Some(DVec2::new(500.0, 900.0)));
    assert_eq!(south_up.georeference.cell, Some(DVec2::new(10.0, 20.0)));
    let column: Vec<f32> = (0..3).map(|j| south_up.map.sample(1, j)).collect();
    assert_eq!(column, [9.0, 5.0, 1.0]);
    assert!(south_up.notes.join("\n").contains("south to north"));
    for rotated in [
        matrix(10.0, 1.0, 500.0, 0.0, -20.0, 900.0),
        matrix(10.0, 0.0, 500.0, 1.0, -20.0, 900.0),
        matrix(0.0, 10.0, 500.0, 20.0, 0.0, 900.0),
        matrix(-10.0, 0.0, 500.0, 0.0, -20.0, 900.0),
    ] {
        refused(&rotated.bytes(), "turned.tif", &["rotated", "gdalwarp"]);
    }
}

#[test]
fn grids_that_make_no_sense() {
    let geographic = [(1024, 2), (2054, 9102)];
    for (file, words) in [
        (tied([0.0; 6], [1.0, -1.0, 0.0]), &["negative", "gdalwarp"][..]),
        (tied([0.0; 6], [0.0, 0.0, 0.0]), &["beyond all numbers"]),
        (tied([0.0; 6], [f64::NAN, 1.0, 0.0]), &["beyond all numbers"]),
        (tied([0.0, 0.0, 0.0, f64::INFINITY, 0.0, 0.0], [1.0; 3]), &["beyond all numbers"]),
        (keys(tied([0.0, 0.0, 0.0, 0.0, 95.0, 0.0], [1.0; 3]), &geographic), &["latitudes"]),
        (keys(tied([0.0; 6], [1.0, 60.0, 0.0]), &geographic), &["latitudes from -150"]),
        // Degrees whose metres are beyond all numbers: found by fuzzing.
        (keys(tied([0.0; 6], [1e306, 0.1, 0.0]), &geographic), &["cells of", "degrees"]),
        (TiffFile::small().with_doubles(34264, &[1.0, 0.0, 0.0]), &["fewer than 8"]),
        (TiffFile::small().with_doubles(33922, &[1.0]).with_doubles(33550, &[1.0]), &["too few"]),
        (
            TiffFile::small().with_text(33550, "1 1 0").with_doubles(33922, &[0.0; 6]),
            &["tag 33550 holds no numbers"],
        ),
    ] {
        refused(&file.bytes(), "senseless.tif", words);
    }
    let file = place(&TiffFile::small().with_doubles(33922, &[0.0; 6]));
    assert!(file.notes.join("\n").contains("without a scale"), "{:?}", file.notes);
}
