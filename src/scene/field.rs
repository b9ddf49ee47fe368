//! Typed access to the fields of a scene; whatever does not fit becomes one [`SceneError`].

use std::ops::RangeInclusive;

use super::error::{Place, SceneError, list, nearest};
use super::maps::Maps;
use super::shown::{shorten, shown};
use super::tree::{KeyValue, Node, Origin, Value};

/// What is needed beside the values: names and texts of their origins, and where maps come from.
pub(super) struct Context<'a> {
    /// The scene file as messages call it.
    pub(super) file: &'a str,
    pub(super) text: &'a str,
    /// Paths of the `--set` options.
    pub(super) options: Vec<String>,
    pub(super) maps: Maps<'a>,
    /// Paths of all keys of a scene: one that is unknown here may belong elsewhere.
    pub(super) paths: fn() -> Vec<String>,
}

impl Context<'_> {
    pub(super) fn place(&self, origin: Origin) -> Place {
        match origin {
            Origin::File(offset) => Place::in_text(self.file, self.text, offset),
            Origin::Set(option) => {
                Place::Set { option: self.options.get(option).cloned().unwrap_or_default() }
            }
        }
    }

    pub(super) fn error(
        &self,
        origin: Origin,
        field: &str,
        reason: impl Into<String>,
        remedy: impl Into<String>,
    ) -> SceneError {
        SceneError::Field {
            place: self.place(origin),
            field: field.to_owned(),
            reason: reason.into(),
            remedy: remedy.into(),
        }
    }
}

/// The fields of one table.
pub(super) struct Fields<'a> {
    context: &'a Context<'a>,
    path: String,
    origin: Origin,
    entries: &'a [KeyValue],
}

impl<'a> Fields<'a> {
    /// The top level of a scene.
    pub(super) fn root(context: &'a Context<'a>, node: &'a Node) -> Result<Self, SceneError> {
        Field { context, path: String::new(), origin: node.origin, node }.open()
    }

    /// Where the maps of the scene come from.
    pub(super) fn maps(&self) -> Maps<'a> {
        self.context.maps
    }

    pub(super) fn get(&self, key: &str) -> Option<Field<'a>> {
        let entry = self.entries.iter().find(|entry| entry.key == key)?;
        Some(self.field(entry))
    }

    /// All fields in the order of the file.
    pub(super) fn all(&self) -> impl Iterator<Item = (&'a str, Field<'a>)> + '_ {
        self.entries.iter().map(|entry| (entry.key.as_str(), self.field(entry)))
    }

    fn field(&self, entry: &'a KeyValue) -> Field<'a> {
        Field {
            context: self.context,
            path: join(&self.path, &entry.key),
            origin: entry.origin,
            node: &entry.node,
        }
    }

    /// A table of which nothing is given.
    pub(super) fn empty(&self, key: &str) -> Self {
        Self {
            context: self.context,
            path: join(&self.path, key),
            origin: self.origin,
            entries: &[],
        }
    }

    /// An error about the table as a whole, or about a field that is missing.
    pub(super) fn error(
        &self,
        key: &str,
        reason: impl Into<String>,
        remedy: impl Into<String>,
    ) -> SceneError {
        self.context.error(self.origin, &join(&self.path, key), reason, remedy)
    }

    /// Fails at the first key that is not `known`, unless `allow` lets it pass.
    pub(super) fn check_keys(
        &self,
        known: &[&str],
        allow: impl Fn(&KeyValue) -> bool,
    ) -> Result<(), SceneError> {
        let stray = |entry: &&KeyValue| !known.contains(&entry.key.as_str()) && !allow(entry);
        let Some(entry) = self.entries.iter().find(stray) else { return Ok(()) };
        let key = entry.key.as_str();
        let path = join(&self.path, key);
        let elsewhere = (self.context.paths)()
            .into_iter()
            .find(|found| found.rsplit('.').next() == Some(key) && *found != path);
        let guess = elsewhere
            .or_else(|| nearest(key, known.iter().copied()).map(|key| join(&self.path, key)));
        let all = list(known.iter().copied());
        let remedy = match guess {
            Some(guess) => format!("did you mean `{guess}`? Known keys here: {all}"),
            None => format!("known keys here: {all}"),
        };
        let reason = format!("unknown key `{}`", shorten(key));
        Err(self.context.error(entry.origin, &path, reason, remedy))
    }
}

/// One field that is given.
#[derive(Clone)]
pub(super) struct Field<'a> {
    pub(super) context: &'a Context<'a>,
    /// As `--set` takes it.
    pub(super) path: String,
    /// Of the key.
    pub(super) origin: Origin,
    pub(super) node: &'a Node,
}

impl<'a> Field<'a> {
    pub(super) fn is_set(&self) -> bool {
        self.origin.is_set() || self.node.origin.is_set()
    }

    /// Where the key stands.
    pub(super) fn place(&self) -> Place {
        let origin = if self.node.origin.is_set() { self.node.origin } else { self.origin };
        self.context.place(origin)
    }

    /// An error at the value.
    pub(super) fn error(&self, reason: impl Into<String>, remedy: impl Into<String>) -> SceneError {
        self.context.error(self.node.origin, &self.path, reason, remedy)
    }

    /// An error about a value that is not what was `expected`.
    pub(super) fn expected(&self, expected: &str) -> SceneError {
        self.error(format!("found {}", self.node.describe()), format!("give {expected}"))
    }

    /// A finite number; `expected` says which, for the message.
    pub(super) fn finite(&self, expected: &str) -> Result<f64, SceneError> {
        match &self.node.value {
            Value::Integer(value) => Ok(*value as f64),
            Value::Float(value) if value.is_finite() => Ok(*value),
            Value::Float(value) => Err(self.not_finite(*value, expected)),
            _ => Err(self.expected(expected)),
        }
    }

    fn not_finite(&self, value: f64, expected: &str) -> SceneError {
        let reason = format!("{} is not a finite number", shown(value));
        self.error(reason, format!("give {expected}"))
    }

    /// A whole number in a range.
    pub(super) fn integer(
        &self,
        expected: &str,
        range: &RangeInclusive<i64>,
    ) -> Result<i64, SceneError> {
        match self.node.value {
            Value::Integer(value) if range.contains(&value) => Ok(value),
            Value::Float(value) if !value.is_finite() => Err(self.not_finite(value, expected)),
            _ => Err(self.expected(expected)),
        }
    }

    /// The value as a text.
    pub(super) fn text(&self, expected: &str) -> Result<&'a str, SceneError> {
        match &self.node.value {
            Value::String(value) => Ok(value),
            _ => Err(self.expected(expected)),
        }
    }

    /// The elements of an array.
    pub(super) fn elements(&self, expected: &str) -> Result<Vec<Self>, SceneError> {
        let Value::Array(nodes) = &self.node.value else {
            return Err(self.expected(expected));
        };
        let element = |(index, node): (usize, &'a Node)| Field {
            context: self.context,
            path: format!("{}.{index}", self.path),
            origin: node.origin,
            node,
        };
        Ok(nodes.iter().enumerate().map(element).collect())
    }

    /// The tables of an array of tables. A lone one is called without its index.
    pub(super) fn tables(&self) -> Result<Vec<Self>, SceneError> {
        let expected = format!("tables, each under a line [[{}]]", self.path);
        let mut tables = self.elements(&expected)?;
        match tables.as_mut_slice() {
            [] => return Err(self.expected(&expected)),
            [lone] => lone.path.clone_from(&self.path),
            _ => {}
        }
        Ok(tables)
    }

    /// The same value under another name: messages call an element of a vector by the vector, that
    /// is the field, its element is the place.
    pub(super) fn called(&self, path: &str) -> Self {
        Self { path: path.to_owned(), ..self.clone() }
    }

    /// The value as a table with keys of any name.
    pub(super) fn open(&self) -> Result<Fields<'a>, SceneError> {
        let Value::Table(entries) = &self.node.value else {
            return Err(self.expected("a table of keys and values"));
        };
        Ok(Fields {
            context: self.context,
            path: self.path.clone(),
            origin: self.node.origin,
            entries,
        })
    }
}

/// The path of a key, safe to show on one line.
fn join(path: &str, key: &str) -> String {
    let key = shorten(key);
    if path.is_empty() { key } else { format!("{path}.{key}") }
}
