//! Several height files as one map.

use std::path::PathBuf;

use glam::DVec2;
use terraline::scene::height_map::{Thinning, mosaic};
use terraline::scene::{HeightFile, Interpretation};

use super::tiff_file::{Form, TiffFile};
use super::with_keys;

struct Tiles {
    folder: tempfile::TempDir,
    paths: Vec<PathBuf>,
}

impl Tiles {
    fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a folder"), paths: Vec::new() }
    }

    /// A tile of `columns` x `rows` nodes, its north-west one at (west, north) in cells of 30.
    fn with(mut self, west: f64, north: f64, columns: usize, rows: usize, cell: f64) -> Self {
        let height = move |i: usize, j: usize| 100.0 * (north - j as f64) + west + i as f64;
        let file = with_keys(
            TiffFile::new(columns, rows, &Form::plain(), height)
                .with_doubles(33922, &[0.0, 0.0, 0.0, 30.0 * west, 30.0 * north, 0.0])
                .with_doubles(33550, &[cell, cell, 0.0]),
            &[(1024, 1), (1025, 2), (3072, 32613)],
            &[],
            &[],
        );
        let path = self.folder.path().join(format!("{}.tif", self.paths.len()));
        std::fs::write(&path, file.bytes()).expect("a file");
        self.paths.push(path);
        self
    }

    fn read(&self, asked: &Interpretation) -> Result<HeightFile, String> {
        mosaic::read(&self.paths, asked).map_err(|error| error.to_string())
    }
}

#[test]
fn tiles_that_touch_overlap_or_leave_gaps() {
    // The second one shares a column with the first, the third lies one row below a gap.
    let tiles = Tiles::new()
        .with(10.0, 50.0, 5, 4, 30.0)
        .with(14.0, 50.0, 3, 4, 30.0)
        .with(10.0, 45.0, 7, 2, 30.0);
    let file = tiles.read(&Interpretation::default()).unwrap();
    assert_eq!((file.map.columns(), file.map.rows()), (7, 7));
    assert_eq!(file.georeference.origin, Some(DVec2::new(300.0, 1500.0)));
    for j in 0..7 {
        for i in 0..7 {
            let expected = 100.0 * (50.0 - j as f32) + 10.0 + i as f32;
            let found = file.map.sample(i, j);
            assert!(if j == 4 { found.is_nan() } else { found == expected }, "{i}, {j}: {found}");
        }
    }
    assert!(file.notes[0].contains("3 files make one map of 7 x 7"), "{:?}", file.notes);
    // The order of files changes nothing here.
    let mut turned = Tiles { folder: tiles.folder, paths: tiles.paths };
    turned.paths.reverse();
    let again = turned.read(&Interpretation::default()).unwrap();
    let bits = |file: &HeightFile| -> Vec<u32> {
        file.map.samples().iter().map(|sample| sample.to_bits()).collect()
    };
    assert_eq!(bits(&file), bits(&again));
    assert_eq!(file.georeference, again.georeference);
    // Thinned as a whole.
    let asked = Interpretation { thinning: Thinning::Every(3), ..Interpretation::default() };
    let thin = turned.read(&asked).unwrap();
    assert_eq!((thin.map.columns(), thin.map.rows()), (3, 3));
    assert_eq!(thin.georeference.cell, Some(DVec2::splat(90.0)));
    for j in 0..3 {
        for i in 0..3 {
            assert_eq!(
                thin.map.sample(i, j).to_bits(),
                file.map.sample(3 * i, 3 * j).to_bits(),
                "{i}, {j}"
            );
        }
    }
}

#[test]
fn tiles_that_do_not_fit() {
    let first = || Tiles::new().with(10.0, 50.0, 5, 4, 30.0);
    for (tiles, words) in [
        (first().with(15.5, 50.0, 5, 4, 30.0), "lie between the nodes"),
        (first().with(15.0, 50.0, 5, 4, 31.0), "cells are 31.0 x 31.0, not 30.0 x 30.0"),
        (first().with(1e7, 50.0, 5, 4, 30.0), "cells away"),
        (first().with(20_000.0, 50.0, 5, 4, 30.0), "surface.thin = 2"),
    ] {
        let message = tiles.read(&Interpretation::default()).unwrap_err();
        assert!(message.contains(words), "{words}: {message}");
        assert_eq!(message.lines().count(), 1, "{message}");
    }
    let mut tiles = first();
    let path = tiles.folder.path().join("bare.tif");
    std::fs::write(&path, TiffFile::small().bytes()).expect("a file");
    tiles.paths.push(path);
    let message = tiles.read(&Interpretation::default()).unwrap_err();
    assert!(message.contains("bare.tif") && message.contains("where it lies"), "{message}");
}

#[test]
fn tiles_on_both_sides_of_180_degrees() {
    let folder = tempfile::tempdir().expect("a folder");
    let paths: Vec<PathBuf> =
        ["N00E179.hgt", "N00W180.hgt"].map(|name| folder.path().join(name)).into();
    for (tile, path) in paths.iter().enumerate() {
        let height = |k: i16| 100 * tile as i16 + k % 11;
        let bytes: Vec<u8> = (0..121).flat_map(|k| height(k).to_be_bytes()).collect();
        std::fs::write(path, bytes).expect("a file");
    }
    for paths in [paths.clone(), vec![paths[1].clone(), paths[0].clone()]] {
        let file = mosaic::read(&paths, &Interpretation::default()).unwrap();
        assert_eq!((file.map.columns(), file.map.rows()), (21, 11));
        assert_eq!((file.map.sample(0, 0), file.map.sample(20, 0)), (0.0, 110.0));
    }
}

#[test]
fn a_tile_without_data_adds_nothing() {
    let mut tiles = Tiles::new().with(10.0, 50.0, 5, 4, 30.0);
    let sea = TiffFile::new(5, 4, &Form::plain(), |_, _| -9999.0).with_text(42113, "-9999");
    let path = tiles.folder.path().join("sea.tif");
    std::fs::write(&path, sea.bytes()).expect("a file");
    tiles.paths.insert(0, path);
    let file = tiles.read(&Interpretation::default()).unwrap();
    assert_eq!((file.map.columns(), file.map.rows()), (5, 4));
    assert!(file.notes.iter().any(|note| note.contains("1 of the files have no data")));
    tiles.paths.truncate(1);
    assert!(tiles.read(&Interpretation::default()).unwrap_err().contains("no node has data"));
}
