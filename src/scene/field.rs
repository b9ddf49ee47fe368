//! Typed access to the fields of a scene; whatever does not fit becomes one [`SceneError`].

use std::ops::RangeInclusive;

use super::error::{Place, SceneError, list, nearest};
use super::keys::{self, Keys};
use super::tree::{Entry, Node, Origin, Value, shorten, shown};

/// Lengths and positions lie within this many scene units: beyond, `f64` itself gets coarse.
pub(super) const FARTHEST: f64 = 1e9;

/// A length or a direction below this is a slip, not a wish.
pub(super) const SMALLEST: f64 = 1e-9;

/// What messages need beside the values: names and texts of their origins.
pub(super) struct Context<'a> {
    /// The scene file as messages call it.
    pub(super) file: &'a str,
    pub(super) text: &'a str,
    /// Paths of the `--set` options.
    pub(super) options: Vec<String>,
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
    entries: &'a [Entry],
}

impl<'a> Fields<'a> {
    /// The top level of a scene.
    pub(super) fn root(context: &'a Context<'a>, node: &'a Node) -> Result<Self, SceneError> {
        let field = Field { context, path: String::new(), origin: node.origin, node };
        field.table(&keys::SCENE)
    }

    pub(super) fn get(&self, key: &str) -> Option<Field<'a>> {
        let entry = self.entries.iter().find(|entry| entry.key == key)?;
        Some(self.field(entry))
    }

    /// All fields in the order of the file.
    pub(super) fn all(&self) -> impl Iterator<Item = (&'a str, Field<'a>)> + '_ {
        self.entries.iter().map(|entry| (entry.key.as_str(), self.field(entry)))
    }

    fn field(&self, entry: &'a Entry) -> Field<'a> {
        Field {
            context: self.context,
            path: join(&self.path, &entry.key),
            origin: entry.origin,
            node: &entry.node,
        }
    }

    /// The field's value, or the default where the scene has none.
    pub(super) fn read<T>(
        &self,
        key: &str,
        default: T,
        read: impl FnOnce(&Field<'a>) -> Result<T, SceneError>,
    ) -> Result<T, SceneError> {
        self.get(key).map_or(Ok(default), |field| read(&field))
    }

    /// The table under a key; a missing one has no fields.
    pub(super) fn table(&self, key: &str, known: &Keys) -> Result<Self, SceneError> {
        self.get(key).map_or_else(|| Ok(self.empty(key)), |field| field.table(known))
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
        known: &Keys,
        allow: impl Fn(&Entry) -> bool,
    ) -> Result<(), SceneError> {
        let unknown = self.entries.iter().find(|entry| !known.has(&entry.key) && !allow(entry));
        let Some(entry) = unknown else { return Ok(()) };
        let key = entry.key.as_str();
        let path = join(&self.path, key);
        let guess = keys::elsewhere(key)
            .filter(|found| *found != path)
            .or_else(|| nearest(key, known.keys.iter().copied()).map(|key| join(&self.path, key)));
        let all = list(known.keys.iter().copied());
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

    /// A finite number that passes the test; `expected` says which, for the message.
    pub(super) fn number(
        &self,
        expected: &str,
        test: impl Fn(f64) -> bool,
    ) -> Result<f64, SceneError> {
        let value = self.finite(expected)?;
        if test(value) { Ok(value) } else { Err(self.expected(expected)) }
    }

    pub(super) fn finite(&self, expected: &str) -> Result<f64, SceneError> {
        match &self.node.value {
            Value::Integer(value) => Ok(*value as f64),
            Value::Float(value) if value.is_finite() => Ok(*value),
            Value::Float(value) => Err(self.error(
                format!("{} is not a finite number", shown(*value)),
                format!("give {expected}"),
            )),
            _ => Err(self.expected(expected)),
        }
    }

    /// A length above 0.
    pub(super) fn length(&self) -> Result<f64, SceneError> {
        self.number("a number above 0 (from 1e-9 to 1e9)", is_length)
    }

    /// An angle in degrees, of any size, in radians.
    pub(super) fn angle(&self) -> Result<f64, SceneError> {
        // The remainder of integers and of f64 is exact, so whole turns change nothing.
        let degrees = match self.node.value {
            Value::Integer(value) => (value % 360) as f64,
            _ => self.finite("an angle in degrees")? % 360.0,
        };
        Ok(degrees.to_radians())
    }

    /// A whole number in a range.
    pub(super) fn integer(&self, range: RangeInclusive<i64>) -> Result<i64, SceneError> {
        let expected = if *range.end() == i64::MAX {
            format!("a whole number from {}", range.start())
        } else {
            format!("a whole number from {} to {}", range.start(), range.end())
        };
        match self.node.value {
            Value::Integer(value) if range.contains(&value) => Ok(value),
            Value::Float(value) if !value.is_finite() => Err(self.error(
                format!("{} is not a finite number", shown(value)),
                format!("give {expected}"),
            )),
            _ => Err(self.expected(&expected)),
        }
    }

    /// As [`Field::integer`].
    pub(super) fn count(&self, range: RangeInclusive<u32>) -> Result<u32, SceneError> {
        let wide = i64::from(*range.start())..=i64::from(*range.end());
        self.integer(wide).map(|value| value as u32)
    }

    /// A text.
    pub(super) fn text(&self, expected: &str) -> Result<&'a str, SceneError> {
        match &self.node.value {
            Value::String(value) => Ok(value),
            _ => Err(self.expected(expected)),
        }
    }

    /// Whether the value is a text.
    pub(super) fn is_text(&self) -> bool {
        matches!(self.node.value, Value::String(_))
    }

    /// One of a few words.
    pub(super) fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T, SceneError> {
        let names = || choices.iter().map(|(name, _)| *name);
        let quoted: Vec<String> = names().map(|name| format!("\"{name}\"")).collect();
        let all = format!("one of {}", list(quoted.iter().map(String::as_str)));
        let text = self.text(&all)?;
        if let Some((_, value)) = choices.iter().find(|(name, _)| *name == text) {
            return Ok(*value);
        }
        let remedy = match nearest(text, names()) {
            Some(guess) => format!("did you mean \"{guess}\"? Give {all}"),
            None => format!("give {all}"),
        };
        Err(self.error(format!("found {}", self.node.describe()), remedy))
    }

    /// The value as a table without unknown keys.
    pub(super) fn table(&self, known: &Keys) -> Result<Fields<'a>, SceneError> {
        let fields = self.open()?;
        fields.check_keys(known, |_| false)?;
        Ok(fields)
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

pub(super) fn is_length(value: f64) -> bool {
    (SMALLEST..=FARTHEST).contains(&value)
}

/// The path of a key, safe to show on one line.
fn join(path: &str, key: &str) -> String {
    let key = shorten(key);
    if path.is_empty() { key } else { format!("{path}.{key}") }
}
