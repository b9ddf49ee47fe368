//! Damage to scene files.

use proptest::prelude::*;
use proptest::sample::{Index, select};

use super::support::keys::{numbers_in, scale_number};
use super::wild::{edge, number, numbers};

/// Texts that mean something in a scene file.
const TOKENS: &str = "= . , [ ] [[ ]] { } \" ' # \\ \"\"\" - e9 e-9 0 9 nan \u{feff} \u{0} \u{85} ü \
                      [camera]\n [[screen]]\n [[surface]]\n [format]\n \nkind=\"plane\"\n \n";

/// One change of a text.
#[derive(Clone, Debug)]
pub enum Damage {
    /// So many characters become a text.
    Characters(Index, usize, String),
    /// The value of a line becomes another.
    Value(Index, String),
    /// A number becomes another.
    Number(Index, String),
    /// A number is multiplied; a whole one stays whole.
    Scale(Index, f64),
    /// A line goes.
    Drop(Index),
    /// A line is repeated at another place.
    Repeat(Index, Index),
    /// The text ends.
    Cut(Index),
}

/// Damage to any text.
pub fn damages() -> BoxedStrategy<Damage> {
    let any_index = any::<Index>;
    let token = prop_oneof![3 => select(TOKENS.split(' ').collect::<Vec<_>>()).prop_map(str::to_owned), 1 => edge(), 1 => "\\PC{0,3}"];
    let sound = prop_oneof![number(-20.0..400.0), number(0.0..4.0)];
    let factor = prop_oneof![
        Just(-1.0),
        Just(0.5),
        0.8..1.25,
        0.1..10.0,
        (-6.0..6.0_f64).prop_map(|e| 10.0_f64.powf(e))
    ];
    let damage = prop_oneof![
        2 => (any_index(), 0..8_usize, token).prop_map(|(at, n, text)| Damage::Characters(at, n, text)),
        2 => (any_index(), edge()).prop_map(|(at, text)| Damage::Value(at, text)),
        1 => (any_index(), numbers::<3>(-20.0..400.0)).prop_map(|(at, text)| Damage::Value(at, text)),
        20 => (any_index(), factor).prop_map(|(at, factor)| Damage::Scale(at, factor)),
        2 => (any_index(), sound).prop_map(|(at, text)| Damage::Number(at, text)),
        2 => (any_index(), edge()).prop_map(|(at, text)| Damage::Number(at, text)),
        2 => any_index().prop_map(Damage::Drop),
        1 => (any_index(), any_index()).prop_map(|(from, to)| Damage::Repeat(from, to)),
        1 => any_index().prop_map(Damage::Cut),
    ];
    damage.boxed()
}

impl Damage {
    /// The text after the damage.
    pub fn to(&self, text: &str) -> String {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        if lines.is_empty() {
            return String::new();
        }
        match self {
            Self::Characters(at, count, insert) => {
                let chars: Vec<char> = text.chars().collect();
                let at = at.index(chars.len());
                let end = (at + count).min(chars.len());
                return chars[..at]
                    .iter()
                    .copied()
                    .chain(insert.chars())
                    .chain(chars[end..].iter().copied())
                    .collect();
            }
            Self::Value(at, value) => {
                let values: Vec<usize> = (0..lines.len())
                    .filter(|&line| lines[line].contains(" = ") && !lines[line].starts_with('#'))
                    .collect();
                if !values.is_empty() {
                    let line = &mut lines[values[at.index(values.len())]];
                    let key = line.split(" = ").next().unwrap_or_default();
                    *line = format!("{key} = {value}");
                }
            }
            Self::Scale(at, factor) => return scale_number(text, at.index(1 << 16), *factor),
            Self::Number(at, new) => {
                let numbers = numbers_in(text);
                if let Some(place) = numbers.get(at.index(numbers.len().max(1))) {
                    return format!("{}{new}{}", &text[..place.start], &text[place.end..]);
                }
            }
            Self::Drop(at) => drop(lines.remove(at.index(lines.len()))),
            Self::Repeat(from, to) => {
                let line = lines[from.index(lines.len())].clone();
                lines.insert(to.index(lines.len()), line);
            }
            Self::Cut(at) => {
                let chars: Vec<char> = text.chars().collect();
                return chars[..at.index(chars.len())].iter().collect();
            }
        }
        lines.join("\n")
    }
}
