//! Values for every key of a scene file, from the keys' own declarations.

use proptest::prelude::*;
use proptest::sample::select;
use terraline::scene::keys::{Key, Kind, Section};

/// A TOML value, or a part of a scene file.
pub type Text = BoxedStrategy<String>;

/// Keys that must stand beside another, each with what stands there.
const BESIDE: [(&str, &str); 7] = [
    ("screen.distance", "pixel = [1, 1]"),
    ("screen.pixel", "distance = 1"),
    ("format.NAME.width", "point = 1"),
    ("format.NAME.point", "width = 62"),
    ("format.NAME.rounding", "width = 30, point = 9"),
    ("format.NAME.overflow", "width = 30, point = 9"),
    ("camera.up", "forward = [1, 0, 0]"),
];

/// A file in which the key has this value, on the last line but for what it needs beside it.
pub fn file_with(section: &Section, key: &Key, value: &str) -> String {
    let mut keys = vec![format!("{} = {value}", key.name)];
    let is_plane = section.keys.iter().any(|key| key.name == "normal");
    keys.extend((is_plane && key.name != "kind").then(|| "kind = \"plane\"".to_owned()));
    let path = format!("{}.{}", section.path, key.name);
    let beside = BESIDE.iter().find(|(key, _)| *key == path);
    keys.extend(beside.map(|(_, beside)| (*beside).to_owned()));
    let braces = keys.join(", ");
    let lines = keys.join("\n");
    match section.path.split_once('.') {
        Some(("format", _)) => format!("[format]\nview = {{ {braces} }}"),
        Some((table, inner)) => format!("[[{table}]]\n{inner} = {{ {braces} }}"),
        None if section.path.is_empty() => format!("\n{lines}"),
        None if ["screen", "surface"].contains(&section.path.as_str()) => {
            format!("[[{}]]\n{lines}", section.path)
        }
        None => format!("[{}]\n{lines}", section.path),
    }
}

/// Values at the ends of what a key takes, all words among them. No two mean the same.
pub fn legal(key: &Key) -> Vec<String> {
    match &key.kind {
        // What a map of the program cannot be.
        _ if ["encoding", "tiles", "thin"].contains(&key.name) => {
            key.default.iter().cloned().collect()
        }
        Kind::Text { .. } => key.default.iter().cloned().collect(),
        kind => legal_of(kind),
    }
}

fn quoted(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| format!("\"{word}\"")).collect()
}

fn legal_of(kind: &Kind) -> Vec<String> {
    match kind {
        // Farther out, a map would be too large.
        Kind::Number(range) | Kind::Degrees(range) => [range.start(), range.end(), &0.3]
            .map(|number| format!("{:?}", number.clamp(-1e6, 1e6)))
            .to_vec(),
        Kind::Turn => vec!["-7.5".to_owned(), "30".to_owned()],
        Kind::Whole(range) | Kind::PowerOfTwo(range) => {
            vec![range.start().to_string(), range.end().to_string()]
        }
        Kind::Word(words, _) => quoted(words),
        Kind::WordOr(words, other) => [quoted(words), legal_of(other)].concat(),
        Kind::Position | Kind::Direction | Kind::UnitDirection => vec!["[1, 2, -3]".to_owned()],
        Kind::Array(_, of, counts) => {
            let element = |at: usize| match **of {
                Kind::Number(_) | Kind::Whole(_) => (at + 1).to_string(),
                ref of => legal_of(of).swap_remove(0),
            };
            let array = |count: usize| (0..count).map(element).collect::<Vec<_>>().join(", ");
            let ends = [*counts.start(), *counts.end()].map(|count| format!("[{}]", array(count)));
            ends[usize::from(counts.start() == counts.end())..].to_vec()
        }
        Kind::Text { .. } | Kind::Table(_) => vec!["{}".to_owned()],
    }
}

/// Values that a key does not take: of other types, and beyond its ends.
pub fn illegal(kind: &Kind) -> Vec<String> {
    const NO_NUMBERS: &str = "nan inf -inf 1e999 99999999999999999999 true [] {} 1979-05-27 \"zz\"";
    let no_numbers = || NO_NUMBERS.split(' ').map(str::to_owned);
    let texts = |texts: &[&str]| texts.iter().map(|&text| text.to_owned()).collect::<Vec<_>>();
    match kind {
        Kind::Number(range) | Kind::Degrees(range) => {
            let beyond = |end: f64, sign: f64| match end * (1.0 + sign * end.signum() / 100.0) {
                0.0 => sign / 100.0,
                beyond => beyond,
            };
            let ends = [beyond(*range.start(), -1.0), beyond(*range.end(), 1.0)];
            let ends = ends.iter().filter(|end| end.is_finite());
            ends.map(|end| format!("{end:?}")).chain(no_numbers()).collect()
        }
        Kind::Turn => no_numbers().collect(),
        Kind::Whole(range) | Kind::PowerOfTwo(range) => {
            let ends = [range.start().checked_sub(1), range.end().checked_add(1)];
            let ends = ends.into_iter().flatten().map(|end| end.to_string());
            ends.chain(["1.0".to_owned()]).chain(no_numbers()).collect()
        }
        Kind::Word(_, unbuilt) => [quoted(unbuilt), texts(&["\"zz\"", "\"\"", "3", "[]"])].concat(),
        Kind::WordOr(_, other) => illegal(other),
        Kind::Text { .. } => texts(&["3", "\"\"", "[\"a\"]"]),
        Kind::Table(_) => texts(&["3", "[]", "{ zzz = 1 }"]),
        Kind::Position => texts(&["[1, 2]", "[1, 2, 3, 4]", "7", "[0, nan, 0]", "[0, 1e10, 0]"]),
        Kind::Direction | Kind::UnitDirection => {
            [illegal(&Kind::Position), texts(&["[0, 0, 0]", "[0, 1e-10, 0]"])].concat()
        }
        Kind::Array(_, of, counts) => {
            let array = |count: usize, last: Option<&String>| {
                let mut all = vec![legal_of(of).swap_remove(0); count];
                all.extend(last.cloned());
                format!("[{}]", all.join(", "))
            };
            let short = counts.start().checked_sub(1);
            let counts = [short, Some(counts.end() + 1)].into_iter().flatten();
            let counts = counts.map(|count| array(count, None)).chain(["7".to_owned()]);
            let bad = illegal(of);
            let bad = bad.iter().map(|bad| array(short.unwrap_or(0), Some(bad)));
            counts.chain(bad).collect()
        }
    }
}

/// Values like a key's default or at the ends of what it takes: most scenes of such can be drawn.
pub fn sound(key: &Key) -> Text {
    let at_ends = select(legal(key)).boxed();
    let Some(default) = key.default.clone() else { return at_ends };
    match key.kind {
        Kind::Word(..) | Kind::WordOr(..) | Kind::Whole(_) | Kind::PowerOfTwo(_) => {
            prop_oneof![at_ends, Just(default)].boxed()
        }
        Kind::Text { .. } => Just(default).boxed(),
        _ => {
            let factors = prop::array::uniform3(0.3..1.0_f64);
            let scaled = factors.prop_map(move |factors| {
                (0..3).fold(default.clone(), |text, at| scale_number(&text, at, factors[at]))
            });
            prop_oneof![9 => scaled, 1 => at_ends].boxed()
        }
    }
}

/// A text with one of its numbers, counted round and round, multiplied; a whole one stays whole.
pub fn scale_number(text: &str, at: usize, factor: f64) -> String {
    let numbers = numbers_in(text);
    if numbers.is_empty() {
        return text.to_owned();
    }
    let place = numbers[at % numbers.len()].clone();
    let old = &text[place.clone()];
    let new = match (old.parse::<i64>(), old.parse::<f64>()) {
        (Ok(whole), _) => ((whole as f64 * factor) as i64).to_string(),
        (_, Ok(number)) => format!("{:?}", number * factor),
        _ => old.to_owned(),
    };
    format!("{}{new}{}", &text[..place.start], &text[place.end..])
}

/// Where the numbers of a text are, but for those in comments and names.
pub fn numbers_in(text: &str) -> Vec<std::ops::Range<usize>> {
    let mut numbers: Vec<std::ops::Range<usize>> = Vec::new();
    let (mut before, mut comment) = ('\n', false);
    for (at, c) in text.char_indices() {
        comment = c == '#' || (comment && c != '\n');
        let inside = numbers.last().is_some_and(|number| number.end == at);
        if !comment && inside && (c.is_ascii_digit() || "_.e-".contains(c)) {
            if let Some(number) = numbers.last_mut() {
                number.end = at + 1;
            }
        } else if !comment && (c.is_ascii_digit() || c == '-') && "\n [".contains(before) {
            numbers.push(at..at + 1);
        }
        before = c;
    }
    numbers
}
