//! Why something was chosen, tied to the keys that it explains.

use crate::scene::set;

/// A sentence about what was chosen, and the keys of the scene that it speaks of.
#[derive(Clone, Debug)]
pub(super) struct Reason {
    pub(super) text: String,
    keys: &'static [&'static str],
}

impl Reason {
    pub(super) fn new(keys: &'static [&'static str], text: String) -> Self {
        Self { text, keys }
    }

    /// Whether it still holds when options set other values.
    pub(super) fn holds(&self, sets: &[String]) -> bool {
        !self.keys.iter().any(|key| is_set(sets, key))
    }
}

/// Whether an option sets a key, a part of it, or a table that it stands in.
pub(crate) fn is_set(sets: &[String], key: &str) -> bool {
    let begins = |long: &str, short: &str| {
        long.strip_prefix(short).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    sets.iter().filter_map(|option| set::split(option).ok()).any(|(path, _)| {
        // The scene that is chosen has one surface and one screen: indices tell nothing.
        let names = path.split('.').map(str::trim).filter(|name| name.parse::<usize>().is_err());
        let path = names.collect::<Vec<_>>().join(".");
        begins(&path, key) || begins(key, &path)
    })
}
