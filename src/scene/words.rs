//! Enums that the file names by words.

use super::kind::Kind;

/// An enum that the file names by words.
pub(super) trait Words: Copy + PartialEq + 'static {
    /// Every word with what it stands for.
    const WORDS: &'static [(&'static str, Self)];

    /// The word for a value.
    fn word(self) -> &'static str {
        // All variants have one.
        Self::WORDS.iter().find(|(_, value)| *value == self).map_or("", |(word, _)| *word)
    }

    /// Any of the words.
    fn kind() -> Kind {
        Self::kind_without(&[])
    }

    /// As `kind`, with words that the format will know one day.
    fn kind_without(unbuilt: &'static [&'static str]) -> Kind {
        Kind::Word(Self::WORDS.iter().map(|(word, _)| *word).collect(), unbuilt)
    }
}
