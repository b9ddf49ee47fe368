//! Holes of height files, from the file to the pixels.

use std::fmt::Write as _;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use glam::DVec2;
use terraline::frame::{Frame, Hit};
use terraline::scene::{Scene, Terrain, load};
use tiff::encoder::{TiffEncoder, colortype::Gray32Float};

use super::support::{assert_same, both, count, plan, terrain};

const SIDE: usize = 24;

/// A slope with a hole in its middle, another at its edge and one of a single node.
fn slope(i: usize, j: usize) -> Option<i16> {
    let middle = (9..15).contains(&i) && (8..13).contains(&j);
    let edge = i < 4 && j > 18;
    (!middle && !edge && (i, j) != (19, 4)).then(|| 100 + 3 * i as i16 + 2 * j as i16)
}

fn nodes() -> impl Iterator<Item = Option<i16>> {
    (0..SIDE * SIDE).map(|at| slope(at % SIDE, at / SIDE))
}

/// The same ground in three formats, each with its own mark for a node without data.
fn written(folder: &Path) -> Vec<PathBuf> {
    let path = |name: &str| folder.join(name);
    let mut grid = format!(
        "ncols {SIDE}\nnrows {SIDE}\nxllcorner 0\nyllcorner 0\ncellsize 30\nNODATA_value -1\n"
    );
    for node in nodes() {
        let _ = writeln!(grid, "{}", node.unwrap_or(-1));
    }
    std::fs::write(path("a.asc"), grid).expect("a file");
    let hgt: Vec<u8> = nodes().flat_map(|node| node.unwrap_or(i16::MIN).to_be_bytes()).collect();
    std::fs::write(path("b.hgt"), hgt).expect("a file");
    let floats: Vec<f32> = nodes().map(|node| node.map_or(f32::NAN, f32::from)).collect();
    let mut bytes = Cursor::new(Vec::new());
    let side = SIDE as u32;
    TiffEncoder::new(&mut bytes)
        .and_then(|mut file| file.write_image::<Gray32Float>(side, side, &floats))
        .expect("a TIFF");
    std::fs::write(path("c.tif"), bytes.into_inner()).expect("a file");
    ["a.asc", "b.hgt", "c.tif"].map(path).into()
}

/// The scene chosen for a file, on a small screen, with a rule for nodes without data.
fn scene(path: &Path, size: [u32; 2], rule: &str) -> Scene {
    let sets = [format!("screen.size={size:?}"), format!("surface.nodata={rule}")];
    load(path.to_str(), &sets).unwrap_or_else(|error| panic!("{error}"))
}

/// Draws with processor and fast engine, which agree in every bit.
#[track_caller]
fn draw(scene: &Scene) -> Frame {
    let (processor, fast) = both(scene, &plan(scene)).expect("a frame");
    assert_same("processor and fast", &processor, &fast);
    fast
}

/// Places of the surface that a frame shows: the pixel, and the place in cells.
fn seen(frame: &Frame, cell: DVec2) -> impl Iterator<Item = (usize, DVec2)> {
    let buffers = frame.buffers.as_ref().expect("buffers");
    let surface = |at: &usize| frame.hit[*at] == Hit::Surface;
    (0..frame.hit.len())
        .filter(surface)
        .map(move |at| (at, DVec2::new(buffers.ground_x[at], buffers.ground_z[at]) / cell))
}

/// Whether a place, up to the rounding of registers, lies on a cell whose nodes all have data.
fn has_ground(terrain: &Terrain, place: DVec2) -> bool {
    let [columns, rows] = [terrain.map.columns(), terrain.map.rows()];
    let near = |place: f64, nodes: usize| {
        [-1e-4, 1e-4].map(|off| ((place + off).max(0.0) as usize).min(nodes - 2))
    };
    near(place.x, columns).into_iter().any(|i| {
        near(place.y, rows).into_iter().any(|j| {
            [(0, 0), (1, 0), (0, 1), (1, 1)]
                .iter()
                .all(|(x, z)| !terrain.map.sample(i + x, j + z).is_nan())
        })
    })
}

/// Draws a file under all three rules: holes have no ground, filled maps no holes.
fn under_every_rule(path: &Path, size: [u32; 2], voids: usize, fill: f32) {
    let mut holed = scene(path, size, "hole");
    let frame = draw(&holed);
    let terrain_of = terrain(&mut holed).clone();
    assert_eq!(terrain_of.map.voids(), voids);
    assert!(count(&frame, Hit::Surface) > 1000, "{path:?}");
    for (at, place) in seen(&frame, terrain_of.cell) {
        assert!(has_ground(&terrain_of, place), "pixel {at} of {path:?}: {place}");
    }
    for rule in ["nearest", &format!("{fill:?}")] {
        let mut filled = scene(path, size, rule);
        let filling = terrain(&mut filled).clone();
        assert_eq!(filling.map.voids(), 0);
        for (sample, old) in filling.map.samples().iter().zip(terrain_of.map.samples()) {
            let changed = if rule == "nearest" { !sample.is_nan() } else { *sample == fill };
            assert!(if old.is_nan() { changed } else { sample == old });
        }
        let whole = draw(&filled);
        assert_eq!(count(&whole, Hit::OutOfRange), 0);
        assert!(count(&whole, Hit::Surface) > count(&frame, Hit::Surface), "{rule}");
        let was_hole = seen(&whole, filling.cell).filter(|(_, at)| !has_ground(&terrain_of, *at));
        assert!(was_hole.count() > 0, "{rule}: {path:?}");
    }
}

#[test]
fn files_with_voids_are_drawn_by_their_rule() {
    let folder = tempfile::tempdir().expect("a folder");
    let voids = nodes().filter(Option::is_none).count();
    let mut frames = Vec::new();
    for path in written(folder.path()) {
        under_every_rule(&path, [96, 60], voids, 101.5);
        // Whatever the format, the holes are the same ones.
        let mut scene = scene(&path, [96, 60], "hole");
        frames.push(terrain(&mut scene).map.samples().iter().map(|s| s.to_bits()).collect());
    }
    let nan = |bits: &Vec<u32>| bits.iter().map(|&b| f32::from_bits(b).is_nan()).collect();
    let [a, b, c]: [Vec<bool>; 3] = [nan(&frames[0]), nan(&frames[1]), nan(&frames[2])];
    assert!(a == b && b == c);
}

#[test]
fn from_above_each_pixel_is_ground_or_hole() {
    let folder = tempfile::tempdir().expect("a folder");
    for path in written(folder.path()) {
        // Straight down from so high that rays are all but vertical.
        let sets = [
            "screen.size=[60, 60]",
            "screen.fov=2",
            "camera.position=[11.5, 700, 11.5]",
            "camera.forward=[0, -1, 0]",
            "camera.up=[0, 0, -1]",
            "surface.cell=[1, 1]",
            "surface.height.scale=0.001",
        ];
        let mut scene = load(path.to_str(), &sets.map(str::to_owned)).expect("a scene");
        let frame = draw(&scene);
        let terrain = terrain(&mut scene).clone();
        let pitch = 2.0 * 700.0 * 1_f64.to_radians().tan() / 60.0;
        let mut holes = 0;
        for at in 0..3600 {
            let offset = |pixel: usize| 11.5 + (pixel as f64 - 29.5) * pitch;
            let place = DVec2::new(offset(at % 60), offset(at / 60));
            // On a rim, a thousandth of a cell decides.
            let rim = |x: f64| (x - x.round()).abs() < 0.01;
            if rim(place.x) || rim(place.y) {
                continue;
            }
            let inside = place.min_element() > 0.0 && place.max_element() < (SIDE - 1) as f64;
            let ground = inside && has_ground(&terrain, place);
            holes += usize::from(inside && !ground);
            let expected = if ground { Hit::Surface } else { Hit::Sky };
            // A ray that is not quite vertical may meet the side of a hole.
            assert!(
                frame.hit[at] == expected || !ground && frame.hit[at] == Hit::Side,
                "{path:?}, pixel {at}, {place}: {:?}",
                frame.hit[at]
            );
        }
        assert!(holes > 200, "{holes}");
    }
}

#[test]
fn real_files_with_voids_are_drawn_by_their_rule() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/dem");
    for (name, voids, fill) in [
        ("st_helens_utm10_i16_lzw_nodata.tif", 4151, 682.0),
        ("mt_fuji_srtm3_voids.tif", 2437, 0.0),
        ("west_bijou_gully_3m.asc", 2739, 1700.0),
    ] {
        let path = folder.join(name);
        if !path.exists() {
            println!("skipped: {} does not exist", path.display());
            continue;
        }
        under_every_rule(&path, [240, 150], voids, fill);
    }
}
