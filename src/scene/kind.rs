//! Which values a key takes: plain data, for the reader and its messages, for documents and tests.

use std::ops::RangeInclusive;

use super::error::list;
use super::shown::shown;

/// Lengths and positions lie within this many scene units: beyond, `f64` itself gets coarse.
pub(super) const FARTHEST: f64 = 1e9;

/// A length or a direction below this is a slip, not a wish.
pub(super) const SMALLEST: f64 = 1e-9;

/// A length above 0.
pub(super) const LENGTH: Kind = Kind::Number(SMALLEST..=FARTHEST);

/// A number of any sign.
pub(super) const COORDINATE: Kind = Kind::Number(-FARTHEST..=FARTHEST);

/// One key of a table.
#[derive(Clone, Debug)]
pub struct Key {
    /// As it stands in the file.
    pub name: &'static str,
    /// What it means, a sentence without its full stop.
    pub meaning: String,
    /// Which values it takes.
    pub kind: Kind,
    /// What counts where the key is left out, as TOML; `None` where that depends on other keys.
    pub default: Option<String>,
}

/// Which values a key takes.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A finite number.
    Number(RangeInclusive<f64>),
    /// An angle in degrees, which is in radians in the scene.
    Degrees(RangeInclusive<f64>),
    /// As `Degrees`, of any size: whole turns count for nothing.
    Turn,
    /// A whole number.
    Whole(RangeInclusive<i64>),
    /// A whole number that is a power of two.
    PowerOfTwo(RangeInclusive<i64>),
    /// One of the first words; the second ones are known but not built.
    Word(Vec<&'static str>, &'static [&'static str]),
    /// One of a few words, or a value of another kind.
    WordOr(Vec<&'static str>, Box<Kind>),
    /// A text that passes a test.
    Text {
        /// Which ones do.
        expected: &'static str,
        /// What is wrong with others.
        refusal: &'static str,
        /// The test.
        fits: fn(&str) -> bool,
    },
    /// Three numbers, a place.
    Position,
    /// Three numbers, a direction of any length.
    Direction,
    /// A direction that is a unit vector in the scene.
    UnitDirection,
    /// So many values of one kind, with a name for them all.
    Array(&'static str, Box<Kind>, RangeInclusive<usize>),
    /// A table in braces.
    Table(Vec<Key>),
}

impl Kind {
    /// Two numbers, as in `[x, z]`.
    pub(super) fn pair(names: &'static str, range: RangeInclusive<f64>) -> Self {
        Self::Array(names, Box::new(Self::Number(range)), 2..=2)
    }

    /// sRGB bytes.
    pub(super) fn color() -> Self {
        Self::Array("[red, green, blue]", Box::new(Self::Whole(0..=255)), 3..=3)
    }

    /// Several colours.
    pub(super) fn colors(counts: RangeInclusive<usize>) -> Self {
        Self::Array("colours", Box::new(Self::color()), counts)
    }

    /// Which values are legal, in the words of messages: "a number from 0 to 1".
    pub fn expected(&self) -> String {
        let quoted = |words: &[&str]| -> Vec<String> {
            words.iter().map(|word| format!("\"{word}\"")).collect()
        };
        match self {
            Self::Number(range) => format!("a number{}", in_words(range)),
            Self::Degrees(range) => format!("an angle in degrees{}", in_words(range)),
            Self::Turn => "an angle in degrees".to_owned(),
            Self::Whole(range) if *range.end() == i64::MAX => {
                format!("a whole number from {}", range.start())
            }
            Self::Whole(range) => {
                format!("a whole number from {} to {}", range.start(), range.end())
            }
            Self::PowerOfTwo(range) => {
                format!("a power of two from {} to {}", range.start(), range.end())
            }
            Self::Word(words, _) => {
                format!("one of {}", list(quoted(words).iter().map(String::as_str)))
            }
            Self::WordOr(words, other) => {
                format!("{} or {}", quoted(words).join(", "), other.expected())
            }
            Self::Text { expected, .. } => (*expected).to_owned(),
            Self::Position => "three numbers [x, y, z] no farther than 1e9 from the origin".into(),
            Self::Direction | Self::UnitDirection => {
                "three numbers [x, y, z], not all 0, of a length up to 1e9".into()
            }
            Self::Array(names, of, counts) => match (&**of, counts.start() == counts.end()) {
                (Self::Array(..), true) => format!("an array of {} {names}", counts.end()),
                (Self::Array(..), false) => {
                    format!("an array of {} to {} {names}", counts.start(), counts.end())
                }
                (of, _) => format!("{names}, each {}", of.expected()),
            },
            Self::Table(keys) => format!("a table of {}", list(keys.iter().map(|key| key.name))),
        }
    }
}

fn in_words(range: &RangeInclusive<f64>) -> String {
    let brief = |value: &f64| shown(*value).trim_end_matches(".0").to_owned();
    let (least, most) = (brief(range.start()), brief(range.end()));
    match *range.start() {
        f64::MIN => String::new(),
        SMALLEST => format!(" above 0 (from {least} to {most})"),
        _ => format!(" from {least} to {most}"),
    }
}
