//! The chosen scene as TOML.

use std::fmt::Write as _;

use toml_edit::{DocumentMut, InlineTable, Item, Table, Value};

use super::super::error::SceneError;
use super::super::set;
use super::Encoding;
use super::view::{FIELD, PITCH, View};

/// Writes the scene, with what was chosen and why beside it.
pub(super) fn write(view: &View, map: &str, encoding: Encoding) -> String {
    let mut out = String::new();
    let mut line = |text: &str| {
        let _ = writeln!(out, "{text}");
    };
    line("# Chosen by terraline for this height file: the whole map from above one of its sides.");
    line(
        "# Lengths in scene units, angles in degrees; x east, y up, z south. Keys that are left out",
    );
    line("# have defaults: `terraline scenes overview` lists all.");
    for reason in &view.reasons {
        line(&format!("# Note: {reason}."));
    }
    line("");
    line(&format!("unit_m = {:?}  # metres per scene unit: the mean cell", view.unit_m));
    line("");
    line("[camera]");
    let [x, y, z] = view.position.to_array();
    line(&format!("position = [{x:?}, {y:?}, {z:?}]  # as near as the whole map allows"));
    line(&format!("heading = {:?}  # 0 looks east, 90 north", view.heading));
    line(&format!("pitch = {PITCH:?}"));
    line("roll = 0.0");
    line("");
    line("[[screen]]");
    line(&format!("size = [{}, {}]  # columns, lines", view.size.0, view.size.1));
    line(&format!("fov = {FIELD:?}  # across the width"));
    line("");
    line("[[surface]]");
    line("kind = \"terrain\"");
    line(&format!("map = {}  # from the folder of this file", Value::from(map)));
    if encoding != Encoding::Stored {
        line(&format!("encoding = \"{}\"", encoding.name()));
    }
    line(&format!("cell = [{:?}, {:?}]  # x, z", view.cell.x, view.cell.y));
    line(&format!(
        "height = {{ offset = {:?}, scale = {:?} }}  # y = (sample - offset) * scale; {} x life size",
        view.offset, view.scale, view.exaggeration
    ));
    line(&format!("base_depth = {:?}  # of the block under the lowest node", view.base_depth));
    line("outside = \"sky\"");
    line("nodata = \"hole\"  # hole | nearest | a height sample");
    line("");
    line("[light]");
    line("direction = [-1.0, 1.6, -0.3]  # from the west, a little from the north");
    line("ambient = 0.35");
    line("");
    line("[color]");
    line("# From the lowest node to the highest, evenly spaced.");
    line(&format!("ramp = {:?}", view.ramp));
    line("sky = [186, 208, 230]");
    line("far = [186, 208, 230]");
    line("side = [104, 92, 78]");
    out
}

/// Keys that say the same thing in another form: an option for one replaces the others.
const FORMS: [(&str, &[&str], &[&str]); 3] = [
    ("camera", &["forward", "up"], &["heading", "pitch", "roll"]),
    ("screen", &["distance", "pixel"], &["fov"]),
    (
        "surface",
        &["normal", "distance", "checker"],
        &["map", "encoding", "cell", "height", "base_depth", "outside", "nodata"],
    ),
];

/// The text with `--set` options written into it. They are known to fit the scene.
pub(super) fn with_sets(text: &str, sets: &[String]) -> Result<String, SceneError> {
    let error = |option: &str, reason: String| SceneError::Override {
        option: option.to_owned(),
        reason,
        remedy: "write the scene without this option, and change the file".to_owned(),
    };
    let mut document: DocumentMut =
        text.parse().map_err(|why: toml_edit::TomlError| error("", why.message().to_owned()))?;
    for option in sets {
        let (path, value) = set::split(option)?;
        let value: Value = value.parse().unwrap_or_else(|_| Value::from(value));
        let keys: Vec<&str> = path.split('.').map(str::trim).collect();
        let mut item = document.as_item_mut();
        for (depth, key) in keys.iter().enumerate() {
            // The first table of several is meant where no index stands.
            if key.parse::<usize>().is_err()
                && let Some(tables) = item.as_array_of_tables()
                && !tables.is_empty()
            {
                item = &mut item[0];
            }
            if depth == 1 {
                replace_forms(item, keys[0], key, &value);
            }
            let missing = match depth {
                _ if depth + 1 == keys.len() => Item::None,
                0 => Item::Table(Table::new()),
                _ => Item::Value(Value::InlineTable(InlineTable::new())),
            };
            item = child(item, key, missing)
                .ok_or_else(|| error(path, format!("there is no place for `{key}`")))?;
        }
        *item = Item::Value(value);
    }
    Ok(document.to_string())
}

/// Takes away what an option says in another form.
fn replace_forms(table: &mut Item, of: &str, key: &str, value: &Value) {
    let plane = (of, key, value.as_str()) == ("surface", "kind", Some("plane"));
    for (_, new, old) in FORMS.iter().filter(|(table, ..)| *table == of) {
        if (new.contains(&key) || plane)
            && let Some(table) = table.as_table_like_mut()
        {
            for key in *old {
                table.remove(key);
            }
        }
    }
}

/// The place under a key or an index; `missing` is put where there is none.
fn child<'a>(item: &'a mut Item, key: &str, missing: Item) -> Option<&'a mut Item> {
    if let Ok(index) = key.parse::<usize>() {
        return item.get_mut(index);
    }
    match item {
        Item::Table(table) => Some(table.entry(key).or_insert(missing)),
        // An inline table holds values only, to be replaced.
        Item::Value(Value::InlineTable(table)) => {
            if !table.contains_key(key) {
                table.insert(key, missing.into_value().unwrap_or_else(|_| Value::from(0)));
            }
            item.get_mut(key)
        }
        _ => None,
    }
}
