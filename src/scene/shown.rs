//! Numbers, names and paths as messages show them: on one line.

use std::path::Path;

/// A number as the user would write it, a point included.
pub(super) fn shown(value: f64) -> String {
    if value.is_finite() && value != 0.0 && !(1e-4..1e7).contains(&value.abs()) {
        format!("{value:e}")
    } else {
        format!("{value:?}").to_lowercase()
    }
}

/// The head of a text, safe to show on one line.
pub(crate) fn shorten(text: &str) -> String {
    const LONGEST: usize = 60;
    let head: String = text.chars().take(LONGEST).flat_map(char::escape_debug).collect();
    if text.chars().nth(LONGEST).is_some() { head + "..." } else { head }
}

/// A path on one line.
pub(super) fn shown_path(path: &Path) -> String {
    let path = path.display().to_string();
    let escape = |c: char| if c.is_control() { c.escape_debug().to_string() } else { c.into() };
    if path.contains(char::is_control) { path.chars().map(escape).collect() } else { path }
}

/// A message of a library, with its line breaks taken out.
pub(super) fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A word for a POSIX shell.
pub(crate) fn quote(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=./,:+@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// "2nd", "3rd", "11th".
pub(super) fn ordinal(number: u64) -> String {
    let ending = match (number % 10, number % 100) {
        (1, tens) if tens != 11 => "st",
        (2, tens) if tens != 12 => "nd",
        (3, tens) if tens != 13 => "rd",
        _ => "th",
    };
    format!("{number}{ending}")
}
