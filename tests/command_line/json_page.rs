//! The page about `--json` names every field that the program prints.

use std::path::Path;

use serde_json::Value;

use super::{Folder, write_map};

/// Field names of an object and of the objects in it, at any depth.
fn names(value: &Value, into: &mut Vec<String>) {
    match value {
        Value::Object(fields) => {
            for (name, value) in fields {
                into.push(name.clone());
                names(value, into);
            }
        }
        Value::Array(values) => values.iter().for_each(|value| names(value, into)),
        _ => {}
    }
}

#[test]
fn every_field_is_on_its_page() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/json.md");
    let page = std::fs::read_to_string(path).expect("the page");
    // A field stands in code, alone or among others, as in `name`, `notes[]` or `{median, max}`.
    let code: Vec<&str> = page.split('`').skip(1).step_by(2).collect();
    let words: Vec<&str> = code
        .iter()
        .flat_map(|code| code.split(|c: char| !c.is_ascii_alphanumeric() && c != '_'))
        .collect();
    let folder = Folder::new();
    folder.write(
        "a.asc",
        "ncols 3\nnrows 2\nxllcorner 7\nyllcorner 45\ncellsize 0.1\n1 2 3\n4 -9999 6\n",
    );
    write_map(&folder.path("b.png"), 20, 20, |i, j| (i * j) as u16);
    folder.prints(&["render", "b.png", "-o", "a1.png", "--buffers", "a1.npz", "--size", "32x20"]);
    folder.prints(&[
        "render",
        "b.png",
        "-o",
        "a2.png",
        "--buffers",
        "a2.npz",
        "--size",
        "32x20",
        "--set",
        "light.ambient=0.9",
    ]);
    for arguments in [
        &["info", "a.asc", "b.png"][..],
        &["render", "b.png", "--size", "32x20", "--sample", "8"],
        &["render", "flight", "--size", "32x32", "--sample", "8"],
        // Lists that are empty elsewhere.
        &["render", "overview", "--size", "40x30", "--format", "ground=9.20", "--sample", "4"],
        &["explain", "flight", "--pixel", "500,900"],
        &["plan", "flight"],
        &["cycles", "flight", "--size", "32x32"],
        &["vectors", "flight", "--size", "32x32", "-o", "vectors"],
        &["compare", "a1.png", "a2.png"],
        &["compare", "a1.npz", "a2.npz"],
        &["scenes"],
        &["scenes", "plane"],
    ] {
        let mut found = Vec::new();
        names(&folder.json(arguments), &mut found);
        for name in found {
            assert!(words.contains(&name.as_str()), "`{name}` of {arguments:?} is not on the page");
        }
    }
}
