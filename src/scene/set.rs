//! `--set path.to.key=value`: overrides of single scene values.
//!
//! The path is that of the scene file, with dots. An element of an array is addressed by its
//! index, from 0: `screen.1.fov=45`. Without an index the *first* table of an array of tables is
//! meant: `screen.fov` is `screen.0.fov`, and `surface.map` is `surface.0.map`.
//!
//! The value is TOML; what is not TOML is taken as text, so `surface.outside=clamp` needs no
//! quotes. A relative path in a value starts where one in the scene file would. Options apply in
//! order, and a later one wins. Where the scene says the same thing in another form, the option
//! replaces that form: `camera.forward` replaces the three angles, an angle replaces `forward` and
//! `up` (the angles that are not given stay as they were), `screen.fov` replaces `distance` and
//! `pixel`, and `surface.kind` drops the keys of the other kind.

use toml::de::DeValue;

use super::error::SceneError;
use super::shown::shorten;
use super::tree::{KeyValue, Node, Origin, Value};

/// No key of a scene lies deeper.
const DEEPEST: usize = 8;

/// Keys whose value is an array of tables.
const TABLE_ARRAYS: [&str; 2] = ["screen", "surface"];

/// Applies the options to a scene and returns their paths, as messages show them.
pub(super) fn apply(root: &mut Node, options: &[String]) -> Result<Vec<String>, SceneError> {
    let mut paths = Vec::with_capacity(options.len());
    for (index, option) in options.iter().enumerate() {
        let (path, value) = split(option)?;
        insert(root, path, value_of(value, index), index)?;
        paths.push(shorten(path));
    }
    Ok(paths)
}

pub(super) fn split(option: &str) -> Result<(&str, &str), SceneError> {
    let error = |reason: String| SceneError::Override {
        option: shorten(option),
        reason,
        remedy: "write --set path.to.key=value, for example --set camera.heading=10".to_owned(),
    };
    let (path, value) =
        option.split_once('=').ok_or_else(|| error("there is no `=`".to_owned()))?;
    let path = path.trim();
    if path.split('.').any(|key| key.trim().is_empty()) {
        return Err(error("a key of the path is empty".to_owned()));
    }
    if path.split('.').count() > DEEPEST {
        return Err(error(format!("no key of a scene is more than {DEEPEST} levels deep")));
    }
    Ok((path, value.trim()))
}

/// The value as TOML, or else as text.
fn value_of(text: &str, option: usize) -> Node {
    match DeValue::parse(text) {
        Ok(value) if !text.is_empty() => Node::option(value, option),
        _ => Node { origin: Origin::Set(option), value: Value::String(text.to_owned()) },
    }
}

fn insert(root: &mut Node, path: &str, value: Node, option: usize) -> Result<(), SceneError> {
    let origin = Origin::Set(option);
    let mut node = root;
    let mut walked = String::new();
    for key in path.split('.').map(str::trim) {
        let top = walked.is_empty();
        let parent = if top { "the scene".to_owned() } else { format!("`{walked}`") };
        let error = |reason: String, remedy: String| SceneError::Override {
            option: shorten(path),
            reason,
            remedy,
        };
        let index = key.parse::<usize>().ok();
        if index.is_none() {
            node = first_table(node);
        }
        let what = node.describe();
        node = match (&mut node.value, index) {
            (Value::Array(nodes), Some(index)) => {
                // The array as a whole now is what the option made of it.
                if !nodes.iter().any(|node| matches!(node.value, Value::Table(_))) {
                    node.origin = origin;
                }
                let count = nodes.len();
                nodes.get_mut(index).ok_or_else(|| {
                    let remedy = match count {
                        0 => "set it as a whole".to_owned(),
                        1 => "the only index is 0".to_owned(),
                        _ => format!("indices go from 0 to {}", count - 1),
                    };
                    error(format!("{parent} has no element {index}"), remedy)
                })?
            }
            (Value::Table(entries), _) => child(entries, key, origin, top),
            _ => {
                return Err(error(
                    format!("{parent} is {what}, so it has no key `{}`", shorten(key)),
                    format!("set {parent} as a whole"),
                ));
            }
        };
        walked = if top { key.to_owned() } else { format!("{walked}.{key}") };
    }
    *node = value;
    Ok(())
}

/// The first table of an array of tables; any other node is itself.
fn first_table(node: &mut Node) -> &mut Node {
    let of_tables = matches!(
        &node.value,
        Value::Array(nodes) if matches!(nodes.first(), Some(Node { value: Value::Table(_), .. }))
    );
    if !of_tables {
        return node;
    }
    match node.value {
        Value::Array(ref mut nodes) => &mut nodes[0],
        _ => node,
    }
}

/// The value under a key, an empty table (or array of one) where there was none.
fn child<'a>(entries: &'a mut Vec<KeyValue>, key: &str, origin: Origin, top: bool) -> &'a mut Node {
    let at = entries.iter().position(|entry| entry.key == key).unwrap_or_else(|| {
        let table = Node { origin, value: Value::Table(Vec::new()) };
        let node = if top && TABLE_ARRAYS.contains(&key) {
            Node { origin, value: Value::Array(vec![table]) }
        } else {
            table
        };
        entries.push(KeyValue { key: key.to_owned(), origin, node });
        entries.len() - 1
    });
    &mut entries[at].node
}
