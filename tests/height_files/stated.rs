//! Units, scales and marks that a file states, in each of the ways in which files state them; and
//! what users say.

use glam::DVec2;
use terraline::scene::height_map::georeference::Coordinates;
use terraline::scene::height_map::{CoordinateUnit, source};
use terraline::scene::{HeightFile, Interpretation};

use super::tiff_file::{Form, Kind, TiffFile};
use super::{read, with_keys};

const SURVEY_FOOT: f64 = 1200.0 / 3937.0;

const GEOGCS: &str = "GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\",SPHEROID[\"WGS_1984\",6378137.0,\
                      298.257223563]],PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]]";

/// 4 x 3 nodes from 154 to 165 with cells of 30 units.
fn file() -> TiffFile {
    TiffFile::new(4, 3, &Form::plain(), |i, j| 154.0 + (4 * j + i) as f64)
        .with_doubles(33922, &[0.0, 0.0, 0.0, 412_000.0, 4_120_000.0, 0.0])
        .with_doubles(33550, &[30.0, 30.0, 0.0])
}

fn metadata(items: &str) -> String {
    format!("<GDALMetadata>{items}</GDALMetadata>")
}

#[track_caller]
fn says(file: &HeightFile, words: &str) {
    assert!(file.notes.iter().any(|note| note.contains(words)), "{words}: {:?}", file.notes);
}

#[track_caller]
fn is_silent_of(file: &HeightFile, words: &str) {
    assert!(!file.notes.iter().any(|note| note.contains(words)), "{words}: {:?}", file.notes);
}

#[test]
fn units_of_the_plan() {
    let pe = format!(
        "ESRI PE String = PROJCS[\"Custom_ft\",{GEOGCS},PROJECTION[\"Mercator_X\"],\
                      UNIT[\"Foot_US\",0.3048006096012192]]"
    );
    for (what, codes, numbers, texts, unit_m) in [
        ("the code implies feet", &[(1024, 1), (3072, 2227)][..], &[][..], &[][..], SURVEY_FOOT),
        ("so does that of a compound system", &[(1024, 1), (3072, 6529)], &[], &[], SURVEY_FOOT),
        ("no kind of model, a unit", &[(3076, 9003)], &[], &[], SURVEY_FOOT),
        ("no kind of model, a code", &[(3072, 2222)], &[], &[], 0.3048),
        ("a code of metres", &[(1024, 1), (3072, 32613)], &[], &[], 1.0),
        ("a unit of its own size", &[(1024, 1), (3076, 32767)], &[(3077, 20.5)], &[], 20.5),
        ("a text", &[(1024, 32767)], &[], &[(3073, pe.as_str())], SURVEY_FOOT),
        ("a text in another key", &[(1024, 1), (3072, 32767)], &[], &[(1026, &pe)], SURVEY_FOOT),
        (
            "a name in a citation",
            &[(1024, 1), (3076, 32767)],
            &[],
            &[(3073, "PCS Name = a|LUnits = foot")],
            0.3048,
        ),
        (
            "brackets in a citation",
            &[(1024, 1)],
            &[],
            &[(1026, "California 3 (ftUS)")],
            SURVEY_FOOT,
        ),
    ] {
        let file = read(&with_keys(file(), codes, numbers, texts).bytes(), "plan.tif");
        let Coordinates::Lengths { unit_m: found } = file.georeference.coordinates else {
            panic!("{what}: {:?}", file.georeference);
        };
        assert!((found / unit_m - 1.0).abs() < 1e-6, "{what}: {found}");
        is_silent_of(&file, "projected coordinates is not stated");
        is_silent_of(&file, "what its coordinates count");
    }
    let silent = read(&with_keys(file(), &[(1024, 1), (3076, 32767)], &[], &[]).bytes(), "s.tif");
    says(
        &silent,
        "the unit of the projected coordinates is not stated: metres are assumed (--unit",
    );
}

#[test]
fn units_of_angles_and_other_bodies() {
    let degrees = |codes: &[(u64, u64)], numbers: &[(u64, f64)], texts: &[(u64, &str)]| {
        let file = TiffFile::small()
            .with_doubles(33922, &[0.0, 0.0, 0.0, 5.0, 50.0, 0.0])
            .with_doubles(33550, &[1.0, 1.0, 0.0]);
        read(&with_keys(file, codes, numbers, texts).bytes(), "angle.tif").georeference
    };
    // Grads by the code alone: Paris.
    assert_eq!(degrees(&[(1024, 2), (2048, 4807)], &[], &[]).cell, Some(DVec2::splat(0.9)));
    assert_eq!(degrees(&[(1024, 2), (2048, 4326)], &[], &[]).cell, Some(DVec2::ONE));
    // No kind of model, but a system of degrees.
    assert_eq!(degrees(&[(2048, 4326)], &[], &[]).coordinates, Coordinates::Degrees);
    assert_eq!(degrees(&[], &[], &[(2049, GEOGCS)]).coordinates, Coordinates::Degrees);
    // The Moon: a degree of its meridian is 30.3 km.
    let moon = degrees(&[(1024, 2)], &[(2057, 1_737_400.0), (2059, 0.0)], &[]);
    let cell = moon.cell_m(4, 3).unwrap();
    assert!((cell.y - 30_323.35).abs() < 0.01, "{cell}");
}

#[test]
fn units_of_heights() {
    let projected = [(1024, 1), (3072, 32613)];
    let of = |extra: &[(u64, u64)], texts: &[(u64, &str)]| {
        let codes = [&projected[..], extra].concat();
        read(&with_keys(file(), &codes, &[], texts).bytes(), "h.tif").georeference.height_unit_m
    };
    let near = |found: Option<f64>, unit_m: f64| {
        assert!(found.is_some_and(|found| (found / unit_m - 1.0).abs() < 1e-6), "{found:?}");
    };
    near(of(&[(4099, 9002)], &[]), 0.3048);
    near(of(&[(4096, 6360)], &[]), SURVEY_FOOT);
    near(of(&[(4096, 5703)], &[]), 1.0);
    near(of(&[(4096, 32767)], &[(4097, "NAVD88 height (ftUS)")]), SURVEY_FOOT);
    near(of(&[], &[(1026, "UTM zone 13N + NAVD88 height (ft)")]), 0.3048);
    near(of(&[], &[(4097, "VERTCS[\"N\",VDATUM[\"N\"],UNIT[\"Foot\",0.3048]]")]), 0.3048);
    // Geographic systems with heights, and heights above an ellipsoid.
    near(of(&[(4096, 4979)], &[]), 1.0);
    near(of(&[(4096, 5030)], &[]), 1.0);
    // A datum says nothing of units.
    assert_eq!(of(&[(4096, 5103)], &[]), None);
    assert_eq!(of(&[], &[]), None);
    let text = format!(
        "PROJCS[\"a\",{GEOGCS},UNIT[\"Meter\",1.0]],VERTCS[\"N\",VDATUM[\"N\"],UNIT[\"Foot\",0.3048]]"
    );
    near(of(&[], &[(1026, &text)]), 0.3048);
    let band = |unit: &str| {
        let item = format!("<Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">{unit}</Item>");
        let codes = [&projected[..], &[(4099, 9001)]].concat();
        read(
            &with_keys(file(), &codes, &[], &[]).with_text(42112, &metadata(&item)).bytes(),
            "b.tif",
        )
    };
    near(band("US survey foot").georeference.height_unit_m, SURVEY_FOOT);
    near(band("cm").georeference.height_unit_m, 0.01);
    says(
        &band("cm"),
        "the band states centimetres as the unit of heights, the coordinate system metres",
    );
    is_silent_of(&band("m"), "the band states");
    let unknown = band("cubit");
    near(unknown.georeference.height_unit_m, 1.0);
    says(&unknown, "`cubit`");
    let depths = [&projected[..], &[(4096, 5715)]].concat();
    says(&read(&with_keys(file(), &depths, &[], &[]).bytes(), "d.tif"), "counts downwards");
    let feet = read(&with_keys(file(), &[(1024, 1), (3072, 2227)], &[], &[]).bytes(), "f.tif");
    let remark = feet.georeference.height_unit_remark().unwrap();
    assert!(
        remark.contains("metres are assumed, though coordinates are US survey feet"),
        "{remark}"
    );
    assert!(remark.contains("--height-unit"), "{remark}");
}

#[test]
fn a_metre_is_a_metre_on_the_ground() {
    let at_60 = |codes: &[(u64, u64)], northing: f64| {
        let file = TiffFile::small()
            .with_doubles(33922, &[0.0, 0.0, 0.0, 1_200_000.0, northing, 0.0])
            .with_doubles(33550, &[60.0, 60.0, 0.0]);
        read(&with_keys(file, codes, &[], &[]).bytes(), "m.tif")
    };
    // Web Mercator, of the ellipsoid's latitudes: N cos φ/a and M cos φ/a.
    let web = at_60(&[(1024, 1), (3072, 3857)], 8_399_827.9);
    let cell = web.georeference.cell_m(4, 3).unwrap();
    assert!((cell - DVec2::new(30.0757, 30.0259)).abs().max_element() < 1e-3, "{cell}");
    let latitude = web.georeference.middle_latitude(4, 3).unwrap();
    assert!((latitude - 60.0).abs() < 1e-5, "{latitude}");
    let conformal = at_60(&[(1024, 1), (3072, 3395)], 8_362_788.5);
    let cell = conformal.georeference.cell_m(4, 3).unwrap();
    assert!((cell - DVec2::splat(30.0757)).abs().max_element() < 1e-3, "{cell}");
    let utm = at_60(&[(1024, 1), (3072, 32613)], 6_650_000.0);
    assert_eq!(utm.georeference.cell_m(4, 3), Some(DVec2::splat(60.0)));
    is_silent_of(&utm, "on the ground");
    says(&at_60(&[(1024, 1), (3072, 5070)], 2e6), "not lengths on the ground");
    says(&at_60(&[(1024, 1), (3072, 32767), (3075, 24)], 2e6), "sinusoidal");
    says(&at_60(&[(1024, 1), (3072, 3347)], 2e6), "Lambert conic of wide parallels");
    is_silent_of(&at_60(&[(1024, 1), (3072, 2154)], 6.7e6), "on the ground");
    says(&at_60(&[(1024, 1), (3072, 40000)], 2e6), "projected coordinates is not stated");
    // The Moon's south in a system that counts from 80° S: true to scale there.
    let south = TiffFile::small()
        .with_doubles(33922, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        .with_doubles(33550, &[100.0, 100.0, 0.0]);
    let numbers = [(2057, 1_737_400.0), (2059, 0.0), (3078, -80.0), (3089, -80.0)];
    let south = with_keys(south, &[(1024, 1), (3072, 32767), (3075, 17)], &numbers, &[]);
    let cell = read(&south.bytes(), "moon.tif").georeference.cell_m(4, 3).unwrap();
    assert!((cell - DVec2::splat(100.0)).abs().max_element() < 0.1, "{cell}");
    // Cells of a map of the globe are not alike.
    let globe = with_keys(
        TiffFile::small()
            .with_doubles(33922, &[0.0, 0.0, 0.0, 0.0, 60.0, 0.0])
            .with_doubles(33550, &[30.0, 40.0, 0.0]),
        &[(1024, 2)],
        &[],
        &[],
    );
    says(&read(&globe.bytes(), "g.tif"), "on the ground they are");
}

#[test]
fn scale_and_offset_are_applied() {
    let items = "<Item name=\"OFFSET\" sample=\"0\" role=\"offset\">-100</Item>\
                 <Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.1</Item>";
    let ints = Form { kind: Kind { format: 2, bits: 16 }, ..Form::plain() };
    let file =
        TiffFile::new(
            4,
            3,
            &ints,
            |i, j| {
                if (i, j) == (0, 0) { -32768.0 } else { 1539.0 + i as f64 }
            },
        );
    let marked = file.clone().with_text(42112, &metadata(items)).with_text(42113, "-32768");
    let marked = read(&marked.bytes(), "s.tif");
    assert_eq!((marked.map.range(), marked.map.voids()), ((53.9, 54.2), 1));
    says(&marked, "times 0.1 plus -100.0");
    // Numbers are read as far as they go.
    let tail = items.replace("0.1<", "0.1 m<");
    let tail = file.clone().with_text(42112, &metadata(&tail)).with_text(42113, "-32768");
    assert_eq!(read(&tail.bytes(), "s.tif").map.range(), (53.9, 54.2));
    // The mark that is missing is named as it is stored.
    says(&read(&file.with_text(42112, &metadata(items)).bytes(), "s.tif"), "add --nodata -32768");
}

#[test]
fn marks_count_in_the_type_that_is_kept() {
    let of = |mark: &str, sample: f64| {
        let file = TiffFile::new(4, 3, &Form::plain(), |i, j| {
            if (i, j) == (1, 1) { sample } else { 154.0 + i as f64 }
        });
        read(&file.with_text(42113, mark).bytes(), "n.tif").map.voids()
    };
    let lowest = f64::from(f32::MIN);
    for (mark, sample) in [
        ("-3.4028234663852886e+38", lowest),
        ("-3.40282346638529e+38", lowest),
        ("-3.4e38", lowest),
        (" -9999 ", -9999.0),
        ("-9999.9", -9999.9),
        ("1e20", 1e20),
    ] {
        assert_eq!(of(mark, sample), 1, "{mark}");
    }
    assert_eq!(of("-9999", -9998.0), 0);
    let text = "ncols 3\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 30\nNODATA_value \
                -3.4028234663852886e+38\n5 -340282346638528859811704183484516925440.0 7\n";
    assert_eq!(read(text.as_bytes(), "n.asc").map.voids(), 1);
}

#[test]
fn what_a_grid_counts_follows_from_extent_and_relief() {
    let grid = |cell: f64, west: f64, south: f64, columns: usize, rows: usize, relief: f64| {
        let mut text = format!(
            "ncols {columns}\nnrows {rows}\nxllcorner {west}\nyllcorner {south}\ncellsize {cell}\n"
        );
        for k in 0..columns * rows {
            text += &format!("{} ", 100.0 * relief * (k % 7) as f64 / 600.0);
        }
        read(text.as_bytes(), "grid.asc").georeference.coordinates
    };
    let metres = Coordinates::Lengths { unit_m: 1.0 };
    // The globe in cells of 2 degrees, and a part of it in halves.
    assert_eq!(grid(2.0, -180.0, -90.0, 180, 90, 6000.0), Coordinates::Degrees);
    assert_eq!(grid(0.5, 6.0, 40.0, 48, 36, 593.0), Coordinates::Degrees);
    assert_eq!(grid(1.0 / 1200.0, 8.0, 46.0, 60, 60, 40.0), Coordinates::Degrees);
    // A level sea in arc seconds.
    assert_eq!(grid(1.0 / 1200.0, 8.0, 46.0, 60, 60, 0.0), Coordinates::Degrees);
    // A sandbox in cells of 5 cm, and the tip of a needle under a microscope.
    assert_eq!(grid(0.05, 0.0, 0.0, 48, 36, 0.07), metres);
    assert_eq!(grid(1e-6, 0.0, 0.0, 48, 36, 6e-8), metres);
    assert_eq!(grid(30.0, 412_000.0, 5_120_000.0, 48, 36, 600.0), metres);
    assert_eq!(grid(2.0, -500.0, -90.0, 180, 90, 6000.0), metres);
}

#[test]
fn what_users_say_counts_more() {
    let bytes = with_keys(file(), &[(1024, 1), (3072, 32613), (4099, 9001)], &[], &[]).bytes();
    let asked = Interpretation {
        nodata: Some(155.0),
        unit: Some(CoordinateUnit::Length(0.3048)),
        height_unit_m: Some(0.01),
        ..Interpretation::default()
    };
    let file = source::decode(&bytes, "asked.tif", &asked).unwrap();
    assert_eq!(file.georeference.coordinates, Coordinates::Lengths { unit_m: 0.3048 });
    assert_eq!(file.georeference.height_unit_m, Some(0.01));
    assert_eq!(file.map.voids(), 1);
    says(&file, "coordinates are taken as feet, as asked for; the file has metres");
    says(&file, "heights are taken as centimetres, as asked for; the file has metres");
    for (text, unit) in [
        ("deg", CoordinateUnit::Degrees),
        ("ft", CoordinateUnit::Length(0.3048)),
        ("0.5", CoordinateUnit::Length(0.5)),
    ] {
        assert_eq!(CoordinateUnit::parse(text), Ok(unit));
    }
    for text in ["", "cubit", "-1", "0", "nan", "inf"] {
        let reason = CoordinateUnit::parse(text).unwrap_err();
        assert!(reason.contains("us-ft") && reason.contains("deg"), "{reason}");
    }
    // Latitudes that are none, unless they are lengths.
    let far = with_keys(
        TiffFile::small()
            .with_doubles(33922, &[0.0, 0.0, 0.0, 0.0, 950.0, 0.0])
            .with_doubles(33550, &[1.0, 1.0, 0.0]),
        &[(1024, 2)],
        &[],
        &[],
    )
    .bytes();
    super::refused(&far, "far.tif", &["latitudes", "--unit m", "gdal_edit -a_ullr"]);
    let metres =
        Interpretation { unit: Some(CoordinateUnit::Length(1.0)), ..Interpretation::default() };
    assert!(source::decode(&far, "far.tif", &metres).is_ok());
}
