//! Scenes written as TOML read back as the same scenes.

use std::path::Path;

use support::described;
use support::keys::{file_with, legal};
use terraline::scene::file::{Document, parse};
use terraline::scene::keys::sections;
use terraline::scene::{MapSource, Scene, builtin, load, write};

mod support;

fn read(text: &str) -> Scene {
    let document = Document { name: "mine", file: "mine.toml", folder: Path::new(""), text };
    parse(&document, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Everything but the samples of the map, which are the same ones.
#[track_caller]
fn assert_same(a: &Scene, b: &Scene) {
    assert_eq!(described(a), described(b));
}

#[test]
fn every_key_reads_back_with_each_of_its_values() {
    for section in sections() {
        for key in &section.keys {
            let mut seen = Vec::new();
            for value in legal(key) {
                let scene = read(&file_with(&section, key, &value));
                for text in [write::toml(&scene, ""), write::commented(&scene, "", &[])] {
                    assert_same(&scene, &read(&text));
                }
                seen.push(described(&scene));
            }
            let values = seen.len();
            seen.sort();
            seen.dedup();
            assert!(values > 0 && seen.len() == values, "{}.{}", section.path, key.name);
        }
    }
}

#[test]
fn directions_and_angles_of_many_digits_read_back() {
    let text = "[camera]\nheading = 126.86989764584402\npitch = -719.123456789\n\
                [[surface]]\nkind = \"plane\"\nnormal = [0.1, 7.3, -0.7]\ndistance = 3.3\n\
                [light]\ndirection = [-1.9759827702627455, 0.9681417604920153, -3.8598810234647223]";
    assert_same(&read(text), &read(&write::toml(&read(text), "")));
}

#[test]
fn built_in_scenes_read_back() {
    for builtin in builtin::SCENES {
        let scene = load(Some(builtin.name), &[]).unwrap();
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
    scene.terrain_mut().expect("a terrain").source = MapSource::new("maps/my \"map\".png");
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
        let samples = |scene: &Scene| scene.terrain().expect("a terrain").map.samples().to_vec();
        assert_eq!(samples(&scene), samples(&again));
    }
}
