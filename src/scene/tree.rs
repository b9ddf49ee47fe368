//! A scene as values that remember where each was written: in the file or in a `--set` option.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::shown::{shorten, shown};

/// Where a value comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    /// Byte offset into the scene file.
    File(usize),
    /// Index of the `--set` option.
    Set(usize),
}

impl Origin {
    pub(super) fn is_set(self) -> bool {
        matches!(self, Self::Set(_))
    }
}

/// A value and where it comes from.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) origin: Origin,
    pub(super) value: Value,
}

/// A TOML value.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Boolean(bool),
    Integer(i64),
    Float(f64),
    /// A number as written that fits no 64-bit type.
    Huge(String),
    String(String),
    Datetime(String),
    Array(Vec<Node>),
    Table(Vec<KeyValue>),
}

/// A key of a table, in the order of the file, `--set` last.
#[derive(Clone, Debug)]
pub(super) struct KeyValue {
    pub(super) key: String,
    /// Of the key; the node has its own.
    pub(super) origin: Origin,
    pub(super) node: Node,
}

impl Node {
    /// The root of a document.
    pub(super) fn document(table: Spanned<DeTable<'_>>) -> Self {
        let root = table.into_inner();
        Self { origin: Origin::File(0), value: Value::table(root, &Origin::File) }
    }

    /// The value of `--set` option number `option`.
    pub(super) fn option(value: Spanned<DeValue<'_>>, option: usize) -> Self {
        Self::new(value, &|_| Origin::Set(option))
    }

    fn new(value: Spanned<DeValue<'_>>, origin: &dyn Fn(usize) -> Origin) -> Self {
        let start = value.span().start;
        let value = match value.into_inner() {
            DeValue::Boolean(value) => Value::Boolean(value),
            DeValue::Integer(value) => i64::from_str_radix(value.as_str(), value.radix())
                .map_or_else(|_| Value::Huge(value.to_string()), Value::Integer),
            DeValue::Float(value) => {
                value.as_str().parse().map_or_else(|_| Value::Huge(value.to_string()), Value::Float)
            }
            DeValue::String(value) => Value::String(value.into_owned()),
            DeValue::Datetime(value) => Value::Datetime(value.to_string()),
            DeValue::Array(values) => {
                Value::Array(values.into_iter().map(|value| Self::new(value, origin)).collect())
            }
            DeValue::Table(table) => Value::table(table, origin),
        };
        Self { origin: origin(start), value }
    }

    /// What a message calls this value.
    pub(super) fn describe(&self) -> String {
        match &self.value {
            Value::Boolean(value) => value.to_string(),
            Value::Integer(value) => value.to_string(),
            Value::Float(value) => shown(*value),
            Value::Huge(value) => shorten(value),
            Value::String(value) => format!("the text \"{}\"", shorten(value)),
            Value::Datetime(value) => format!("the date {value}"),
            Value::Array(values) if values.len() == 1 => "an array of 1 value".to_owned(),
            Value::Array(values) => format!("an array of {} values", values.len()),
            Value::Table(_) => "a table".to_owned(),
        }
    }
}

impl Value {
    fn table(table: DeTable<'_>, origin: &dyn Fn(usize) -> Origin) -> Self {
        let mut entries: Vec<(usize, KeyValue)> = table
            .into_iter()
            .map(|(key, value)| {
                let start = key.span().start;
                let node = Node::new(value, origin);
                (
                    start,
                    KeyValue { key: key.into_inner().into_owned(), origin: origin(start), node },
                )
            })
            .collect();
        // The library sorts by name; later register formats must win over earlier ones.
        entries.sort_by_key(|(start, _)| *start);
        Self::Table(entries.into_iter().map(|(_, entry)| entry).collect())
    }
}
