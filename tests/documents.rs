//! Documents that are generated from the code, compared with it; `UPDATE_DOCS=1` rewrites them.

use std::path::Path;

use terraline::scene::{keys, load, write};
use terraline::setup::table;
use terraline::word::Register;

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
    is_current("docs/registers.md", &table::markdown());
}

#[test]
fn the_page_of_scene_keys_is_generated_from_their_declarations() {
    is_current("docs/scene-keys.md", &keys::markdown());
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
fn every_register_is_on_its_page() {
    let page = table::markdown();
    for register in Register::ALL {
        assert!(page.contains(&format!("| `{register}` |")), "{register}");
    }
}

#[test]
fn every_unit_has_a_page() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for entry in std::fs::read_dir(root.join("src/unit")).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
        // The module's root, the wires between the units and what two of them share are no units.
        if !["mod", "line", "color"].contains(&stem.as_str()) {
            assert!(root.join(format!("docs/units/{stem}.md")).exists(), "docs/units/{stem}.md");
        }
    }
}

/// All Rust files below a folder.
fn sources(folder: &Path, into: &mut Vec<std::path::PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, into);
        } else if path.extension().is_some_and(|end| end == "rs") {
            into.push(path);
        }
    }
}

#[test]
fn equations_that_the_code_cites_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = std::fs::read_to_string(root.join("docs/mathematics.md")).expect("the page");
    let exists = |number: u32| page.contains(&format!("\\tag{{{number}}}"));
    for &register in Register::ALL {
        for number in table::entry(register).equations.split(", ") {
            let number = number.parse().expect("a number");
            assert!(exists(number), "equation {number} of {register}");
        }
    }
    let mut files = Vec::new();
    sources(&root.join("src"), &mut files);
    let mut cited = 0;
    for file in files {
        let text = std::fs::read_to_string(&file).expect("a source");
        // "equation 9", "equations 14 to 18", "(equations 5 and 6": the numbers that follow.
        for after in text.split("equation").skip(1) {
            let after = after.trim_start_matches('s');
            let words = after
                .split([' ', ',', ')', '(', '.', '\n', ';', ':', '`'])
                .filter(|w| !w.is_empty());
            for word in words.take_while(|w| *w == "to" || *w == "and" || w.parse::<u32>().is_ok())
            {
                if let Ok(number) = word.parse() {
                    assert!(exists(number), "{}: equation {number}", file.display());
                    cited += 1;
                }
            }
        }
    }
    assert!(cited > 30, "{cited} citations found");
}
