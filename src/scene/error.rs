//! The one message a user gets about a bad scene: where, which field, why, and what to do.

use std::fmt;

use thiserror::Error;

use super::height_map::MapError;

/// Why a scene cannot be used. Its `Display` is one complete line.
#[derive(Debug, Error)]
pub enum SceneError {
    /// The name is no built-in scene and does not look like a path.
    #[error(
        "unknown scene `{name}`; {}the built-in scenes are {known}, and a scene file is given \
         with its folder or its ending, as in ./my.toml",
        meant(suggestion.as_deref())
    )]
    UnknownScene {
        /// What was asked for.
        name: String,
        /// The nearest built-in name, if one is near.
        suggestion: Option<String>,
        /// All built-in names.
        known: String,
    },
    /// The scene file cannot be read at all.
    #[error("{file}: {reason}; {remedy}")]
    Unreadable {
        /// The path as given.
        file: String,
        /// What the system or the reader said.
        reason: String,
        /// What the user can do about it.
        remedy: String,
    },
    /// The scene file is not TOML.
    #[error("{place}: not valid TOML: {reason}; {remedy}")]
    Syntax {
        /// Line and column, or the option, that it is about.
        place: Place,
        /// What the parser says.
        reason: String,
        /// What the user can do about it.
        remedy: String,
    },
    /// A field is unknown, missing, of the wrong type or out of range.
    #[error("{}: {reason}; {remedy}", at(place, field))]
    Field {
        /// Line and column, or the option, that it is about.
        place: Place,
        /// Path of the field, as `--set` takes it: `camera.position`.
        field: String,
        /// What is wrong with the value.
        reason: String,
        /// What the user can do about it.
        remedy: String,
    },
    /// The height map that a field names cannot be used.
    #[error("{}: {source}", at(place, field))]
    Map {
        /// Line and column, or the option, that it is about.
        place: Place,
        /// Path of the field.
        field: String,
        /// What is wrong with the map.
        source: Box<MapError>,
    },
    /// A `--set` option that cannot be carried out.
    #[error("in --set {option}: {reason}; {remedy}")]
    Override {
        /// The option's path, or the whole option where it has none.
        option: String,
        /// What the reader of the map said.
        reason: String,
        /// What the user can do about it.
        remedy: String,
    },
}

/// Where a value was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// In a file or a built-in scene.
    File {
        /// Path as given, or `builtin:NAME`.
        file: String,
        /// Line of the file, from 1.
        line: usize,
        /// In characters, from 1.
        column: usize,
    },
    /// In a `--set` option.
    Set {
        /// The option's path.
        option: String,
    },
}

impl Place {
    /// The place of a byte offset into the text of a file.
    pub(super) fn in_text(file: &str, text: &str, offset: usize) -> Self {
        let mut offset = offset.min(text.len());
        while !text.is_char_boundary(offset) {
            offset -= 1;
        }
        let before = &text[..offset];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        Self::File {
            file: file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        }
    }

    /// How another message refers to this place.
    pub(super) fn brief(&self) -> String {
        match self {
            Self::File { line, .. } => format!("line {line}"),
            Self::Set { option } => format!("--set {option}"),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { file, line, column } => write!(f, "{file}, line {line}, column {column}"),
            Self::Set { option } => write!(f, "in --set {option}"),
        }
    }
}

/// Place and field; an option that is the field's own path is not said twice.
fn at(place: &Place, field: &str) -> String {
    match place {
        Place::Set { option } if option == field => place.to_string(),
        _ if field.is_empty() => place.to_string(),
        _ => format!("{place}: {field}"),
    }
}

fn meant(suggestion: Option<&str>) -> String {
    suggestion.map_or_else(String::new, |name| format!("did you mean `{name}`? If not, "))
}

/// The candidate nearest to a mistyped word, if any is near enough to be worth naming.
pub(crate) fn nearest<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    // The measure is quadratic in the length, and no name of ours is that long.
    if word.chars().count() > 64 {
        return None;
    }
    let word = word.to_lowercase();
    candidates
        .into_iter()
        .map(|candidate| (strsim::normalized_damerau_levenshtein(&word, candidate), candidate))
        .filter(|(likeness, _)| *likeness >= 0.4)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

/// `a, b and c` for a message.
pub(crate) fn list<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.into_iter().collect();
    match names.split_last() {
        None => "none".to_owned(),
        Some((last, [])) => (*last).to_owned(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
    }
}
