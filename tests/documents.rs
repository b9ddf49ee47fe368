//! Documents that are generated from the code, compared with it; `UPDATE_DOCS=1` rewrites them.

#[path = "documents/pages.rs"]
mod pages;

use std::path::Path;

use terraline::scene::{load, write};

fn is_current(file: &str, text: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    if std::env::var_os("UPDATE_DOCS").is_some() {
        std::fs::write(&path, text).expect("docs can be written");
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        found == text,
        "{file} is not what the code says; run `UPDATE_DOCS=1 cargo test --test documents`"
    );
}

#[test]
fn the_register_page_is_generated_from_the_table() {
    is_current("docs/registers.md", &pages::registers());
}

#[test]
fn the_page_of_scene_keys_is_generated_from_their_declarations() {
    is_current("docs/scene-keys.md", &pages::scene_keys());
}

#[test]
fn the_overview_lists_every_key_with_its_meaning() {
    let overview = load(Some("overview"), &[]).expect("a built-in scene");
    let top = [
        "Overview: the whole Jacksboro map from above its north edge, looking south and down.",
        "Lengths in scene units, angles in degrees. x = column = east, z = row = south, y up. \
         A key that is left out has the value it shows here, but for [camera].",
    ];
    let text = write::commented(&overview, "", &top.map(str::to_owned));
    is_current("src/scene/builtin/overview.toml", &text);
}

#[test]
fn the_page_of_buffers_is_generated_from_the_table() {
    is_current("docs/buffers.md", &pages::buffers());
}

#[test]
fn every_unit_has_a_page() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for entry in std::fs::read_dir(root.join("src/unit")).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
        // The module's root, what units are made of, and the stage of four of them are no units.
        if !["mod", "coefficient", "description", "line", "shader", "surface_unit"]
            .contains(&stem.as_str())
        {
            assert!(root.join(format!("docs/units/{stem}.md")).exists(), "docs/units/{stem}.md");
        }
    }
}
