//! ESRI ASCII grids.

use glam::DVec2;
use terraline::scene::height_map::georeference::{Coordinates, PixelIs};

use super::{read, refused};

const GRID: &str = "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\n\
                    NODATA_value -9999\n1 2.5 -3e1\n-9999 5 6\n";

#[test]
fn keys_in_any_case_order_and_line_ending() {
    let expected = read(GRID.as_bytes(), "a.asc");
    assert_eq!(expected.map.sample(1, 0), 2.5);
    assert_eq!(expected.map.sample(2, 0), -30.0);
    assert!(expected.map.sample(0, 1).is_nan());
    assert_eq!((expected.map.voids(), expected.nodata), (1, Some(-9999.0)));
    let place = &expected.georeference;
    assert_eq!(place.origin, Some(DVec2::new(105.0, 215.0)));
    assert_eq!(place.cell, Some(DVec2::splat(10.0)));
    assert_eq!(place.coordinates, Coordinates::Lengths { unit_m: 1.0 });
    assert_eq!(place.pixel_is, Some(PixelIs::Area));
    for same in [
        GRID.replace('\n', "\r\n"),
        GRID.to_uppercase(),
        format!("\u{feff}\n  {GRID}"),
        GRID.replace(' ', " \t "),
        GRID.replace("cellsize 10\n", "dx 10\ndy 10\n"),
        GRID.replace("-3e1\n", "-3e1 "),
        GRID.replace("xllcorner 100", "xllcenter 105").replace("xllcenter 105", "xllcorner 1e2"),
    ] {
        let map = read(same.as_bytes(), "b.asc").map;
        assert_eq!(map.samples()[..3], expected.map.samples()[..3], "{same}");
        assert_eq!(map.samples()[4..], expected.map.samples()[4..], "{same}");
    }
    let center = GRID.replace("xllcorner", "xllcenter").replace("yllcorner", "YLLCENTRE");
    let place = read(center.as_bytes(), "c.asc").georeference;
    assert_eq!(place.origin, Some(DVec2::new(100.0, 210.0)));
    let oblong = GRID.replace("cellsize 10\n", "dx 10\ndy 4\n");
    let place = read(oblong.as_bytes(), "d.asc").georeference;
    assert_eq!(place.cell, Some(DVec2::new(10.0, 4.0)));
    assert_eq!(place.origin, Some(DVec2::new(105.0, 206.0)));
}

#[test]
fn degrees_are_guessed_and_said() {
    let grid = GRID.replace("100", "-84.5").replace("200", "36.5").replace(" 10\n", " 0.001\n");
    let file = read(grid.as_bytes(), "e.asc");
    assert_eq!(file.georeference.coordinates, Coordinates::Degrees);
    assert!(file.notes[0].contains("degrees"), "{:?}", file.notes);
    let file = read(GRID.replace("NODATA_value -9999\n", "").as_bytes(), "f.asc");
    assert_eq!((file.map.voids(), file.nodata), (1, None));
    assert!(file.notes.join("\n").contains("without NODATA_value"), "{:?}", file.notes);
}

#[test]
fn mistakes_are_located() {
    let change = |from: &str, to: &str| GRID.replace(from, to);
    for (grid, words) in [
        (change("2.5", "2,5"), &["line 7", "decimal comma"][..]),
        (change("cellsize 10", "cellsize 10,5"), &["line 5", "decimal comma"]),
        (change("2.5", "two"), &["line 7", "`two`"]),
        (change("-9999 5 6", "-9999 5"), &["line 9", "5 of 6 heights"]),
        (change("5 6", "5 6 7"), &["line 8", "more than 3 x 2"]),
        (change("5 6\n", "5 6\n7\n"), &["line 9", "more than"]),
        (change("nrows 2\n", ""), &["no `nrows`"]),
        (change("cellsize 10\n", ""), &["no `cellsize`"]),
        (change("cellsize 10\n", "dx 10\n"), &["no `dy`"]),
        (change("cellsize 10\n", "cellsize 10\ndx 3\n"), &["both cellsize"]),
        (change("cellsize 10", "cellsize 0"), &["0 x 0"]),
        (change("cellsize 10", "cellsize -3"), &["-3"]),
        (change("cellsize 10", "cellsize 1e308"), &["beyond all numbers"]),
        (change("yllcorner 200\n", "yllcorner 200\nyllcenter 3\n"), &["both yllcorner"]),
        (change("xllcorner 100\n", ""), &["no `xllcorner`"]),
        (change("ncols 3", "ncols 3.5"), &["ncols is 3.5"]),
        (change("ncols 3", "ncols -3"), &["ncols is -3"]),
        (change("ncols 3", "ncols 0"), &["0 x 2"]),
        (change("ncols 3", "ncols 99999"), &["99999 x 2", "16384"]),
        (change("ncols 3", "ncols"), &["line 1", "`ncols` has no value"]),
        (change("ncols 3", "ncols inf"), &["not finite"]),
        (change("ncols 3\n", "ncols 3\nncols 3\n"), &["line 2", "twice"]),
        (change("cellsize", "cellsice"), &["line 5", "`cellsice`"]),
        (change("1 2.5 -3e1\n-9999 5 6\n", ""), &["0 of 6"]),
        (change("1 2.5 -3e1\n-9999 5 6", "-9999 -9999 nan inf -9999 -9999"), &["no node has data"]),
    ] {
        refused(grid.as_bytes(), "wrong.asc", words);
    }
    // A claim that the text cannot hold is refused before memory is taken for it.
    let boast = change("ncols 3", "ncols 8000").replace("nrows 2", "nrows 8000");
    refused(boast.as_bytes(), "boast.asc", &["6 of 64000000"]);
}

#[test]
fn what_c_programs_write_for_no_number_is_no_data() {
    let text =
        "dx 30\ndy 30\nncols 4\nnrows 1\nxllcorner 0\nyllcorner 0\n1.#QNAN -nan(ind) nan 7\n";
    assert_eq!(read(text.as_bytes(), "nan.asc").map.voids(), 3);
}
