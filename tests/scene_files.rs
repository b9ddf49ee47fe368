//! Scene files: defaults, every key, and one clear message for everything that can be wrong.

use std::path::Path;

use glam::{DVec2, DVec3};
use peak_alloc::PeakAlloc;
use support::described;
use terraline::scene::file::{Document, parse};
use terraline::scene::{
    Angles, Attitude, Bisection, Extent, FormatRequest, NoData, Outside, Overflow, Rounding, Scene,
    SceneError, StepperMode, Surface, Terrain, WordSize, builtin, load,
};
use terraline::word::{Class, Register, Registers};

mod support;

#[path = "scene_files/damage.rs"]
mod damage;
#[path = "scene_files/fuzz.rs"]
mod fuzz;
#[path = "scene_files/grids.rs"]
mod grids;
#[path = "scene_files/messages.rs"]
mod messages;
#[path = "scene_files/options.rs"]
mod options;
#[path = "scene_files/random_texts.rs"]
mod random_texts;
#[path = "scene_files/wild.rs"]
mod wild;

#[global_allocator]
static PEAK: PeakAlloc = PeakAlloc;

/// A file to change: two screens, a map without an end, formats.
const EVERY_TABLE: &str = r#"
unit_m = 10
[camera]
position = [1, 2.5, -3e2]
offset = [0, 1, 0]
heading = 90
pitch = 5.5
roll = -1
[[screen]]
name = "left"
size = [640, 480]
fov = 45
mount = { heading = 30, pitch = 1, roll = 2 }
[[screen]]
name = "right"
distance = 2.0
pixel = [0.001, 0.002]
[[surface]]
kind = "terrain"
map = "builtin:jacksboro"
cell = [2, 3]
height = { offset = 0, scale = 1 }
outside = "wrap"
nodata = -32768
base_depth = 4
[kernel]
deformation = 1
weight_shift = 64
table = 16
[stepper]
mode = "plain"
halvings = 20
[light]
direction = [0, 2, 0]
ambient = 1
[color]
ramp = [[0, 0, 0], [1, 2, 3], [255, 255, 255]]
checker = [[4, 4, 4], [5, 5, 5]]
[machine]
clock_mhz = 0.5
words = "wide"
[format]
view = { width = 62, point = 62 }
ground_x = { width = 48, point = 30, rounding = "nearest_even" }
"#;

fn try_scene(text: &str, sets: &[&str]) -> Result<Scene, SceneError> {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let document = Document { name: "my", file: "my.toml", folder: Path::new(""), text };
    parse(&document, &sets)
}

fn scene(text: &str, sets: &[&str]) -> Scene {
    try_scene(text, sets).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn assert_says(error: &SceneError, words: &[&str]) {
    let message = error.to_string();
    for word in words {
        assert!(message.contains(word), "no {word:?} in: {message}");
    }
    assert_eq!(message.lines().count(), 1, "{message}");
}

fn terrain(scene: &Scene) -> &Terrain {
    scene.terrain().expect("a height map")
}

fn angles(scene: &Scene) -> Angles {
    match scene.camera.attitude {
        Attitude::Angles(angles) => angles,
        Attitude::Directions { .. } => panic!("directions"),
    }
}

#[test]
fn an_empty_file_is_the_default_scene() {
    let scene = scene("", &[]);
    assert_eq!(described(&scene), described(&Scene::of(scene.surfaces[0].clone())));
    assert_eq!((scene.name.as_str(), scene.screens.len()), ("my", 1));
    let terrain = terrain(&scene);
    assert_eq!((terrain.source.file.as_str(), terrain.cell), ("builtin:jacksboro", DVec2::ONE));
    assert_eq!((terrain.map.columns(), terrain.map.rows()), (344, 344));
    assert_eq!((terrain.map.sample(232, 168), terrain.node(232, 168)), (316.0, 2.0));
    // All but the camera of overview.toml shows the default values.
    let overview = load(Some("overview"), &[]).unwrap();
    let shown = Scene { camera: scene.camera.clone(), ..overview };
    assert_eq!(described(&shown), described(&scene));
}

#[test]
fn keys_go_where_they_belong() {
    let scene = scene(EVERY_TABLE, &[]);
    assert_eq!((scene.unit_m, scene.camera.offset), (10.0, DVec3::Y));
    assert_eq!(scene.camera.position, DVec3::new(1.0, 2.5, -300.0));
    assert_eq!(angles(&scene).roll, (-1.0_f64).to_radians());
    let [left, right] = scene.screens.as_slice() else { panic!("two screens") };
    assert_eq!((left.columns, left.lines, right.columns), (640, 480, 1024));
    assert_eq!(left.mount.heading, 30.0_f64.to_radians());
    let pixel = DVec2::new(0.001, 0.002);
    assert_eq!(right.extent, Extent::Pitch { distance: 2.0, pixel });
    let terrain = terrain(&scene);
    assert_eq!((terrain.nodata, terrain.base_depth), (NoData::Sample(-32768.0), Some(4.0)));
    assert_eq!((terrain.offset, terrain.scale), (0.0, 1.0));
    assert_eq!((terrain.cell, terrain.outside), (DVec2::new(2.0, 3.0), Outside::Wrap));
    assert_eq!(scene.stepper.halvings, Bisection::Fixed(20));
    assert_eq!((scene.stepper.mode, scene.kernel.table), (StepperMode::Plain, 16));
    assert_eq!(scene.color.checker, [[4; 3], [5; 3]]);
    assert_eq!((scene.machine.clock_mhz, scene.machine.words), (0.5, WordSize::Wide));
    assert_eq!((scene.light.direction, scene.color.ramp.len()), (DVec3::Y, 3));
    // In the order of the file, so that a register may refine its class.
    let coarse = FormatRequest {
        width: 62,
        point: 62,
        rounding: Rounding::Nearest,
        overflow: Overflow::Wrap,
    };
    let fine = FormatRequest { width: 48, point: 30, rounding: Rounding::NearestEven, ..coarse };
    assert_eq!(
        scene.formats,
        [(Registers::Class(Class::View), coarse), (Registers::One(Register::GroundX), fine)]
    );
}

#[test]
fn directions_and_planes() {
    let text = "[camera]\nforward = [0, -2, 0]\nup = [5, 0, 0]\n\
                [[surface]]\nkind = \"plane\"\nnormal = [0, 0, 4]\ndistance = 12\nchecker = 3";
    let scene = scene(text, &[]);
    let (forward, up) = (DVec3::new(0.0, -2.0, 0.0), DVec3::new(5.0, 0.0, 0.0));
    assert_eq!(scene.camera.attitude, Attitude::Directions { forward, up });
    let [Surface::Plane(plane)] = &scene.surfaces[..] else { panic!("a plane") };
    assert_eq!((plane.normal, plane.distance, plane.checker), (DVec3::Z, 3.0, 3.0));
}

#[test]
fn whole_turns_change_nothing() {
    for (written, reduced) in [
        ("3610", 10.0),
        ("-3610", -10.0),
        ("360000010.0", 10.0),
        ("9223372036854775807", 7.0),
        ("36000.25", 0.25),
        ("720.0", 0.0),
    ] {
        let scene = scene(&format!("[camera]\nheading = {written}"), &[]);
        assert_eq!(angles(&scene).heading, f64::to_radians(reduced), "{written}");
    }
}

#[test]
fn small_and_constant_maps() {
    let folder = tempfile::tempdir().unwrap();
    let text = |outside: &str| format!("[[surface]]\nmap = \"map.png\"\noutside = \"{outside}\"");
    let read = |columns, rows, outside: &str| {
        image::GrayImage::from_pixel(columns, rows, image::Luma([7]))
            .save(folder.path().join("map.png"))
            .unwrap();
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, text(outside)).unwrap();
        load(path.to_str(), &[])
    };
    for (columns, rows) in [(1, 1), (1, 5), (5, 1)] {
        let error = read(columns, rows, "sky").unwrap_err();
        let size = format!("{columns} x {rows}");
        let words = ["scene.toml, line 2, column 7: surface.map", &size, "\"clamp\"", "2 x 2"];
        assert_says(&error, &words);
        for outside in ["clamp", "wrap"] {
            let scene = read(columns, rows, outside).unwrap();
            assert_eq!(terrain(&scene).map.columns(), columns as usize);
        }
    }
    let scene = read(2, 2, "sky").unwrap();
    assert_eq!(scene.name, "scene");
    assert_eq!(terrain(&scene).map.range(), (7.0, 7.0));
    assert_eq!(terrain(&scene).base_depth(), 2.0);
}

// The scenes say 0.7071, not the root of one half.
#[allow(clippy::approx_constant)]
#[test]
fn scenes_by_name_and_path() {
    assert_eq!(load(None, &[]).unwrap().name, "overview");
    for builtin in &builtin::SCENES {
        let scene = load(Some(builtin.name), &[]).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((scene.screens[0].columns, scene.screens[0].lines), (1024, 1024));
        assert!(!builtin.description.is_empty());
        // Written to a file, the text renders as it is.
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("copy.toml");
        std::fs::write(&path, builtin.toml).unwrap();
        assert_eq!(load(path.to_str(), &[]).unwrap().camera, scene.camera);
    }
    let overview = load(Some("overview"), &[]).unwrap();
    assert_eq!(overview.camera.position, DVec3::new(172.0, 192.0, -12.0));
    let forward = DVec3::new(0.0, -0.7071, 0.7071);
    assert_eq!(overview.camera.attitude, Attitude::Directions { forward, up: DVec3::Y });
    let plane = load(Some("plane"), &[]).unwrap();
    assert_eq!(plane.camera.position, DVec3::new(0.0, 10.0, 0.0));
    assert_eq!(angles(&plane).pitch, (-10.0_f64).to_radians());

    let error = load(Some("overvew"), &[]).unwrap_err();
    assert_says(&error, &["overvew", "did you mean `overview`?", "flight, valley and plane"]);
    let error = load(Some("some/valey.toml"), &[]).unwrap_err();
    assert_says(&error, &["some/valey.toml", "no such file", "did you mean `valley`?"]);
    assert_says(&load(Some(""), &[]).unwrap_err(), &["unknown scene"]);
    assert_says(&load(Some("src/"), &[]).unwrap_err(), &["src/", "folder"]);

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("latin.toml");
    std::fs::write(&path, b"unit_m = 1\n# caf\xe9").unwrap();
    let error = load(path.to_str(), &[]).unwrap_err();
    assert_says(&error, &["latin.toml", "line 2", "UTF-8"]);
    std::fs::write(&path, "#".repeat(2 << 20)).unwrap();
    assert_says(&load(path.to_str(), &[]).unwrap_err(), &["latin.toml", "larger"]);
}

#[test]
fn byte_order_mark_and_line_ends_of_windows() {
    assert_eq!(scene("\u{feff}unit_m = 3\r\n[camera]\r\nroll = 4\r\n", &[]).unit_m, 3.0);
    messages::assert_fails(
        "unit_m = 3\r\n[camera]\r\nrol = 4\r\n",
        &["line 3, column 1: camera.rol"],
    );
}

#[test]
fn resampled_built_in_maps_keep_their_ground() {
    let at = |sets: &[&str]| terrain(&scene("", sets)).clone();
    let fine = at(&["surface.map=builtin:jacksboro@687"]);
    assert_eq!((fine.map.columns(), fine.cell), (687, DVec2::splat(0.5)));
    let given = at(&["surface.map=builtin:jacksboro@687", "surface.cell=[2, 3]"]);
    assert_eq!(given.cell, DVec2::new(2.0, 3.0));
    // The longer sides of two cells are more than a quarter of the height range.
    assert_eq!(given.base_depth(), 6.0);
    assert_eq!(at(&[]).cell, DVec2::ONE);
    let error = try_scene("[[surface]]\nmap = \"builtin:jacksboro@1\"", &[]).unwrap_err();
    assert_says(&error, &["line 2", "surface.map", "from 2 to 8192"]);
}
