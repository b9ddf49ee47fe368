//! TIFF files that break a rule and that every other program reads.

use terraline::scene::Interpretation;
use terraline::scene::height_map::Thinning;
use terraline::scene::height_map::source;

use super::tiff_file::{FLOAT, Form, Kind, LONG, Layout, SHORT, TiffFile};
use super::{read, with_keys};

/// 20 x 30 samples, all different.
fn sample(i: usize, j: usize) -> f64 {
    (20 * j + i) as f64
}

#[track_caller]
fn is_whole(bytes: &[u8], what: &str) {
    let map = read(bytes, "odd.tif").map;
    assert_eq!((map.columns(), map.rows()), (20, 30), "{what}");
    for (k, &found) in map.samples().iter().enumerate() {
        assert_eq!(found, k as f32, "{what} at {k}");
    }
}

#[test]
fn lengths_of_strips_are_missing_or_wrong() {
    for compression in [1, 5, 8, 32773, 50000] {
        for rows in [7, usize::MAX] {
            let form = Form { compression, layout: Layout::Strips(rows), ..Form::plain() };
            let file = TiffFile::new(20, 30, &form, sample);
            let count = file.blocks.len();
            let what = format!("compression {compression}, {count} strips");
            is_whole(&file.bytes(), &what);
            is_whole(&file.clone().with(279, LONG, &vec![0; count]).bytes(), &what);
            let mut none = file.clone();
            // An entry without values: the tag is there and says nothing.
            none.entries.push((279, LONG, Vec::new()));
            is_whole(&none.bytes(), &what);
            // The last strip claims the rows that it does not have.
            let mut counts: Vec<u64> = file.blocks.iter().map(|block| block.len() as u64).collect();
            counts[count - 1] += 4096;
            is_whole(&file.clone().with(279, LONG, &counts).bytes(), &what);
        }
    }
}

#[test]
fn lists_are_too_long() {
    let form = Form { layout: Layout::Strips(16), ..Form::plain() };
    let file = TiffFile::new(20, 30, &form, sample);
    let lengths: Vec<u64> = file.blocks.iter().map(|block| block.len() as u64).collect();
    let offsets = [8, 8 + lengths[0], 0];
    let counts = [lengths[0], lengths[1], 0];
    is_whole(&file.with(273, LONG, &offsets).with(279, LONG, &counts).bytes(), "an extra strip");
}

#[test]
fn tiles_stand_under_the_tags_of_strips() {
    let form = Form { layout: Layout::Tiles(16, 16), ..Form::plain() };
    let mut file = TiffFile::new(20, 30, &form, sample);
    file.tiled = false;
    is_whole(&file.bytes(), "tiles by the tags of strips");
    let mut file = TiffFile::new(20, 30, &Form::plain(), sample);
    file.tiled = true;
    is_whole(&file.bytes(), "strips by the tags of tiles");
}

#[test]
fn tags_are_missing_or_of_another_type() {
    let file = || TiffFile::new(20, 30, &Form::plain(), sample);
    is_whole(&file().without(262).bytes(), "no photometric interpretation");
    is_whole(&file().with(262, SHORT, &[0]).bytes(), "white is zero");
    is_whole(&file().without(277).bytes(), "no number of bands");
    is_whole(&file().without(259).bytes(), "no compression");
    is_whole(&file().with(278, LONG, &[0]).bytes(), "strips of no rows");
    is_whole(&file().with(278, LONG, &[u64::from(u32::MAX)]).bytes(), "strips of all rows");
    let kind = Kind { format: 1, bits: 16 };
    let ints = TiffFile::new(20, 30, &Form { kind, ..Form::plain() }, sample);
    is_whole(&ints.clone().without(339).bytes(), "no format of samples");
    is_whole(&ints.with(339, SHORT, &[4]).bytes(), "a format that is not defined");
    let floats = |values: &[f32]| -> Vec<u64> {
        values.iter().map(|value| u64::from(value.to_bits())).collect()
    };
    let placed = file().with(33550, FLOAT, &floats(&[30.0, 30.0, 0.0])).with(
        33922,
        FLOAT,
        &floats(&[0.0, 0.0, 0.0, 412_000.0, 4_120_000.0, 0.0]),
    );
    is_whole(&placed.bytes(), "a scale in 32-bit floats");
    let cell = read(&placed.bytes(), "odd.tif").georeference.cell;
    assert_eq!(cell, Some(glam::DVec2::splat(30.0)));
}

#[test]
fn a_turn_that_moves_no_node_is_none() {
    let turned = |skew: f64| {
        let list = [30.0, skew, 0.0, 412_000.0, -skew, -30.0, 0.0, 4_120_000.0];
        let rest = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        TiffFile::new(20, 30, &Form::plain(), sample).with_doubles(34264, &[list, rest].concat())
    };
    is_whole(&turned(1e-12).bytes(), "a rounding");
    super::refused(&turned(1e-3).bytes(), "turned.tif", &["rotated", "gdalwarp turned.tif"]);
}

#[test]
fn lerc_with_each_method_on_top() {
    let values: Vec<f32> = (0..600).map(|k| k as f32).collect();
    let blob = lerc::encode_slice(20, 30, &values, lerc::Precision::Lossless).unwrap();
    for (on_top, compression) in [(0, 1), (1, 8), (2, 50000)] {
        let mut file = TiffFile::new(20, 30, &Form::plain(), sample)
            .with(259, SHORT, &[34887])
            .with(50674, LONG, &[4, on_top]);
        file.blocks = vec![super::tiff_file::pack(&blob, compression)];
        is_whole(&file.bytes(), &format!("method {on_top}"));
        // Every cut of it is refused.
        for length in [0, 1, 50, file.blocks[0].len() / 2, file.blocks[0].len() - 1] {
            let mut cut = file.clone();
            cut.blocks[0].truncate(length);
            super::refused(&cut.bytes(), "cut.tif", &[]);
        }
    }
    // Pixels that LERC masks are no data.
    let mut mask = lerc::bitmask::BitMask::new(600);
    (0..600).filter(|k| k % 5 != 0).for_each(|k| mask.set_valid(k));
    let precision = lerc::Precision::Lossless;
    let blob = lerc::encode_slice_masked(20, 30, &values, &mask, precision).unwrap();
    let mut file = TiffFile::new(20, 30, &Form::plain(), sample).with(259, SHORT, &[34887]);
    file.blocks = vec![blob];
    let map = read(&file.bytes(), "masked.tif").map;
    assert!(map.samples().iter().enumerate().all(|(k, s)| s.is_nan() == (k % 5 == 0)));
    // A block of another size.
    let blob = lerc::encode_slice(30, 20, &values, lerc::Precision::Lossless).unwrap();
    file.blocks = vec![blob];
    super::refused(&file.bytes(), "turned.tif", &["30 x 20"]);
}

#[test]
fn every_nth_node_is_kept_of_any_layout() {
    for layout in [Layout::Strips(7), Layout::Tiles(16, 16)] {
        for every in 1..=35 {
            let form = Form { layout, ..Form::plain() };
            let bytes = TiffFile::new(20, 30, &form, sample)
                .with_doubles(33922, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
                .with_doubles(33550, &[30.0, 30.0, 0.0])
                .bytes();
            let asked =
                Interpretation { thinning: Thinning::Every(every), ..Interpretation::default() };
            let file = source::decode(&bytes, "thin.tif", &asked).unwrap();
            let (columns, rows) = (20_usize.div_ceil(every), 30_usize.div_ceil(every));
            assert_eq!((file.map.columns(), file.map.rows()), (columns, rows));
            assert_eq!((file.whole, file.every), ((20, 30), every));
            assert_eq!(file.georeference.cell, Some(glam::DVec2::splat(30.0 * every as f64)));
            for j in 0..rows {
                for i in 0..columns {
                    let expected = sample(every * i, every * j) as f32;
                    assert_eq!(file.map.sample(i, j), expected, "{layout:?} {every}: {i}, {j}");
                }
            }
        }
    }
    let asked = Interpretation { thinning: Thinning::Fit(100), ..Interpretation::default() };
    let bytes = TiffFile::new(20, 30, &Form::plain(), sample).bytes();
    let file = source::decode(&bytes, "thin.tif", &asked).unwrap();
    assert_eq!((file.every, file.map.samples().len()), (3, 70));
}

#[test]
fn thinned_rows_that_run_north_end_at_a_row_that_is_kept() {
    let list = [30.0, 0.0, 0.0, 0.0, 0.0, 30.0, 0.0, 0.0];
    let rest = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let file = with_keys(
        TiffFile::new(20, 30, &Form::plain(), sample).with_doubles(34264, &[list, rest].concat()),
        &[(1024, 1), (1025, 2), (3072, 32613)],
        &[],
        &[],
    );
    let asked = Interpretation { thinning: Thinning::Every(4), ..Interpretation::default() };
    let file = source::decode(&file.bytes(), "north.tif", &asked).unwrap();
    // The file as a whole reaches one row further north.
    assert_eq!(file.whole_origin, Some(glam::DVec2::new(0.0, 29.0 * 30.0)));
    // Rows 0, 4, … 28 of the file, the last one in the north.
    assert_eq!(file.map.sample(0, 0), sample(0, 28) as f32);
    assert_eq!(file.georeference.origin, Some(glam::DVec2::new(0.0, 28.0 * 30.0)));
}

#[test]
fn a_predictor_of_what_is_not_packed_means_nothing() {
    for compression in [1, 32773] {
        let form = Form { compression, ..Form::plain() };
        let file = TiffFile::new(20, 30, &form, sample).with(317, SHORT, &[3]);
        is_whole(&file.bytes(), &format!("compression {compression}"));
    }
}

#[test]
fn lerc_of_big_endian_files_holds_bytes_turned_round() {
    let turned = |value: f64| f32::from_bits((value as f32).to_bits().swap_bytes());
    let values: Vec<f32> = (0..600).map(|k| turned(f64::from(k))).collect();
    let blob = lerc::encode_slice(20, 30, &values, lerc::Precision::Lossless).unwrap();
    let form = Form { big_endian: true, ..Form::plain() };
    let mut file = TiffFile::new(20, 30, &form, sample).with(259, SHORT, &[34887]);
    file.blocks = vec![blob];
    is_whole(&file.bytes(), "big-endian");
    // A block of one height is a few bytes, however large it is.
    let blob = lerc::encode_slice(2048, 2048, &vec![7.0_f32; 1 << 22], lerc::Precision::Lossless);
    let mut flat = TiffFile::new(1, 1, &Form::plain(), sample)
        .with(256, LONG, &[2048])
        .with(257, LONG, &[2048])
        .with(278, LONG, &[2048])
        .with(259, SHORT, &[34887]);
    flat.blocks = vec![blob.unwrap()];
    assert_eq!(read(&flat.bytes(), "flat.tif").map.range(), (7.0, 7.0));
}

#[test]
fn a_scale_counts_more_than_a_matrix() {
    let list = [7.0, 0.0, 0.0, 1.0, 0.0, -7.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let both = TiffFile::new(20, 30, &Form::plain(), sample)
        .with_doubles(34264, &list)
        .with_doubles(33550, &[30.0, 30.0, 0.0])
        .with_doubles(33922, &[0.0; 6]);
    let cell = read(&both.bytes(), "both.tif").georeference.cell;
    assert_eq!(cell, Some(glam::DVec2::splat(30.0)));
}

#[test]
fn claims_that_would_take_long_are_refused() {
    // 2^20 x 20000 nodes of one small strip each.
    let long = TiffFile::small().with(256, LONG, &[1 << 20]).with(257, LONG, &[20_000]);
    super::refused(&long.bytes(), "long.tif", &["1048576 x 20000"]);
    let many =
        TiffFile::small().with(33550, SHORT, &vec![1; 70_000]).with_doubles(33922, &[0.0; 6]);
    super::refused(&many.bytes(), "many.tif", &["tag 33550 holds 70000 numbers"]);
}
