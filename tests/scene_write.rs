//! Scenes written as TOML read back as the same scenes.

use std::path::Path;

use glam::DVec3;
use proptest::prelude::*;
use terraline::scene::file::{Document, parse};
use terraline::scene::{Scene, Surface, builtin, write};

fn read(text: &str) -> Scene {
    let document = Document { name: "mine", file: "mine.toml", folder: Path::new(""), text };
    parse(&document, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Everything but the samples of the map, which are the same ones.
fn assert_same(a: &Scene, b: &Scene) {
    let text = |scene: &Scene| {
        let surface = match &scene.surface {
            Surface::Terrain(t) => format!(
                "{} {:?} {:?} {:?} {:?} {:?} {:?} {:?}",
                t.source, t.encoding, t.cell, t.offset, t.scale, t.outside, t.nodata, t.base_depth
            ),
            Surface::Plane(plane) => format!("{plane:?}"),
        };
        format!(
            "{:?} {:?} {:#?} {:#?} {surface} {:?} {:?} {:?} {:?} {:?} {:?}",
            scene.unit_m,
            scene.seed,
            scene.camera,
            scene.screens,
            scene.kernel,
            scene.stepper,
            scene.light,
            scene.color,
            scene.machine,
            scene.formats
        )
    };
    assert_eq!(text(a), text(b));
}

#[test]
fn built_in_scenes_read_back() {
    for builtin in builtin::SCENES {
        let scene = builtin::load(Some(builtin.name), &[]).unwrap();
        let text = write::toml(&scene, "");
        assert_same(&scene, &read(&text));
        // What is written is complete: it does not change when it is written again.
        assert_eq!(write::toml(&read(&text), ""), text);
    }
}

#[test]
fn formats_and_paths_are_written() {
    let text = "[format]\nground_x = { width = 40, point = 12, rounding = \"stochastic\" }\n\
                ground = { width = 30, point = 8, overflow = \"saturate\" }";
    let scene = read(text);
    assert_same(&scene, &read(&write::toml(&scene, "")));

    let mut scene = read("");
    if let Surface::Terrain(terrain) = &mut scene.surface {
        terrain.source = "maps/my \"map\".png".into();
    }
    let text = write::toml(&scene, "/data/a \"b\" \\ c.png");
    let value: toml::Table = text.parse().unwrap();
    assert_eq!(value["surface"][0]["map"].as_str(), Some("/data/a \"b\" \\ c.png"));
}

#[test]
fn encodings_are_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("tile.png");
    image::RgbImage::from_fn(9, 7, |i, j| image::Rgb([128, (3 * i) as u8, (29 * j) as u8]))
        .save(&path)
        .expect("a picture");
    for encoding in ["terrarium", "terrain-rgb"] {
        let scene = read(&format!("[[surface]]\nmap = {path:?}\nencoding = \"{encoding}\""));
        let text = write::toml(&scene, path.to_str().expect("text"));
        assert!(text.contains(&format!("encoding = \"{encoding}\"")), "{text}");
        let again = read(&text);
        assert_same(&scene, &again);
        let (Surface::Terrain(a), Surface::Terrain(b)) = (&scene.surface, &again.surface) else {
            panic!("terrain");
        };
        assert_eq!(a.map.samples(), b.map.samples());
    }
}

fn vector(range: f64) -> impl Strategy<Value = [f64; 3]> {
    [-range..range, -range..range, -range..range]
        .prop_filter("a direction", |v| DVec3::from_array(*v).length() > 1e-6)
}

fn listed(values: &[f64]) -> String {
    format!("{values:?}")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn scenes_of_any_numbers_read_back(
        position in vector(1e6),
        forward in vector(10.0),
        angles in prop::array::uniform3(-720.0..720.0_f64),
        by_angles: bool,
        mount in prop::array::uniform3(-90.0..90.0_f64),
        fov in 0.001..175.0_f64,
        pitch in prop::option::of((1e-6..1.0_f64, 1e-6..1.0_f64, 0.1..10.0_f64)),
        size in (1..5000_u32, 1..5000_u32),
        plane in prop::option::of((vector(20.0), -100.0..100.0_f64, 0.001..100.0_f64)),
        light in vector(5.0),
        ambient in 0.0..1.0_f64,
        kernel in (0..4_usize, 0..3_u32, 0..64_u32, 4..16_u32),
        height in (-1e3..1e3_f64, 1e-6..1e3_f64),
        color in prop::collection::vec(prop::array::uniform3(0..255_u8), 2..16),
        halvings in prop::option::of(0..20_u32),
        seed in 0..i64::MAX,
    ) {
        let attitude = if by_angles {
            let [heading, pitch, roll] = angles;
            format!("heading = {heading:?}\npitch = {pitch:?}\nroll = {roll:?}")
        } else {
            format!("forward = {}\nup = {}", listed(&forward), listed(&[forward[1], forward[2] + 1.0, -forward[0]]))
        };
        let extent = match pitch {
            Some((z, y, distance)) => format!("distance = {distance:?}\npixel = [{z:?}, {y:?}]"),
            None => format!("fov = {fov:?}"),
        };
        let surface = match plane {
            Some((normal, distance, checker)) => format!(
                "kind = \"plane\"\nnormal = {}\ndistance = {distance:?}\nchecker = {checker:?}",
                listed(&normal)
            ),
            None => format!("height = {{ offset = {:?}, scale = {:?} }}\nnodata = 3.5", height.0, height.1),
        };
        let (shape, deformation, shift, table) = kernel;
        let shape = ["cosine", "parabola", "exponential", "hat"][shape];
        let halvings = halvings.map_or("\"footprint\"".to_owned(), |count| count.to_string());
        let [h, p, r] = mount;
        let text = format!(
            "seed = {seed}\n[camera]\nposition = {}\n{attitude}\n\
             [[screen]]\nsize = [{}, {}]\n{extent}\n\
             mount = {{ heading = {h:?}, pitch = {p:?}, roll = {r:?} }}\n\
             [[surface]]\n{surface}\n\
             [kernel]\nshape = \"{shape}\"\ndeformation = {deformation}\nweight_shift = {shift}\n\
             table = {}\n\
             [stepper]\nhalvings = {halvings}\n\
             [light]\ndirection = {}\nambient = {ambient:?}\n\
             [color]\nramp = {color:?}\n",
            listed(&position), size.0, size.1, 1 << table, listed(&light)
        );
        let document = Document { name: "mine", file: "mine.toml", folder: Path::new(""), text: &text };
        // Directions may be parallel to each other by chance.
        let Ok(scene) = parse(&document, &[]) else { return Ok(()) };
        assert_same(&scene, &read(&write::toml(&scene, "")));
    }
}
