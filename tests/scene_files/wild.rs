//! Random scene files and options: sound values, and now and then a wild one.

use proptest::collection::vec;
use proptest::option::weighted;
use proptest::prelude::*;
use proptest::sample::select;
use terraline::scene::keys::{Key, Section, sections};

use super::support::keys::{Text, sound};

/// Maps that the fuzzed scenes find in their folder, beside the built-in ones; the last is missing.
pub const MAPS: [&str; 12] = [
    "hills.asc",
    "hills.asc",
    "hills.asc",
    "holes.asc",
    "flat.asc",
    "cliffs.png",
    "row.asc",
    "one.asc",
    "packed.png",
    "builtin:jacksboro@2",
    "builtin:jacksboro@61",
    "missing\\nfile.asc",
];

/// Values at an end of some range, or beyond.
const EDGES: &str = r#"
    0;-0.0;1;-1;2;16;62;63;64;65;0.5;1e-9;0.99e-9;1e9;-1e9;1.01e9;175;176;360;1e-300;5e-324;1e308;
    -1e308;1e999;nan;-inf;9223372036854775807;-9223372036854775808;9223372036854775808;0x7fff_ffff;
    true;"";"footprint";[];[[]];{};[0, 0];[0, 0, 0];1979-05-27T07:32:00Z;"\u0000\n\u202e""#;

/// A value at an end of some range, or beyond.
pub fn edge() -> Text {
    let exponent = (prop::bool::ANY, -12.0..12.0_f64)
        .prop_map(|(minus, e)| if minus { -10.0_f64.powf(e) } else { 10.0_f64.powf(e) });
    prop_oneof![
        3 => select(EDGES.split(';').map(str::trim).collect::<Vec<_>>()).prop_map(str::to_owned),
        3 => exponent.prop_map(|number| format!("{number:?}")),
        1 => any::<f64>().prop_map(|number| format!("{number:?}").to_lowercase()),
        1 => any::<i64>().prop_map(|number| number.to_string()),
        1 => "\\PC{0,12}".prop_map(|text| toml::Value::from(text).to_string()),
    ]
    .boxed()
}

/// Mostly the sound values, now and then a wild one.
fn or_wild(sound: impl Strategy<Value = String> + 'static) -> Text {
    prop_oneof![200 => sound, 1 => edge()].boxed()
}

/// A number, wild at times.
pub fn number(range: std::ops::Range<f64>) -> Text {
    or_wild(range.prop_map(|number| format!("{number:?}")))
}

/// An array of numbers.
pub fn numbers<const N: usize>(range: std::ops::Range<f64>) -> Text {
    list((0..N).map(|_| number(range.clone())).collect())
}

fn list(elements: Vec<Text>) -> Text {
    or_wild(elements.prop_map(|elements| format!("[{}]", elements.join(", "))))
}

fn word(words: &[&str]) -> Text {
    let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
    or_wild(select(words))
}

/// Values of a key that fit the maps of the folder.
fn values(path: &str, key: &Key) -> Text {
    match (path, key.name) {
        ("camera", "position") => {
            list(vec![number(-20.0..60.0), number(0.0..40.0), number(-20.0..60.0)])
        }
        ("camera", "heading" | "pitch" | "roll") => number(-400.0..400.0),
        ("camera", "forward" | "up") => numbers::<3>(-3.0..3.0),
        ("screen", "distance") => number(0.1..9.0),
        ("screen", "pixel") => numbers::<2>(0.0001..0.5),
        ("screen", "mount") => number(-100.0..100.0)
            .prop_map(|angle| format!("{{ heading = {angle}, roll = 9.5 }}"))
            .boxed(),
        ("surface", "map") => word(&MAPS),
        ("surface", "encoding") => or_wild(Just("\"stored\"".to_owned())),
        _ => or_wild(sound(key)),
    }
}

/// Keys of a table that say the same thing as the first ones: either stand there, and then all.
const FORMS: [(&str, &[&str], &[&str]); 2] = [
    ("camera", &["heading", "pitch", "roll"], &["forward", "up"]),
    ("screen", &["fov"], &["distance", "pixel"]),
];

/// A table with some of its keys.
fn table(head: &'static str, section: &Section, name: Option<&'static str>) -> Text {
    let (first, second) = FORMS
        .into_iter()
        .find(|(path, ..)| *path == section.path)
        .map_or((&[][..], &[][..]), |(_, first, second)| (first, second));
    let name = name.map_or_else(String::new, |name| format!("name = \"{name}\"\n"));
    let keys = |leave: &[&str], always: &[&str]| -> Text {
        let line = |key: &Key| {
            let name = key.name;
            let line =
                values(&section.path, key).prop_map(move |value| format!("{name} = {value}\n"));
            if always.contains(&name) {
                line.prop_map(Some).boxed()
            } else {
                weighted(0.6, line).boxed()
            }
        };
        let keys = section.keys.iter();
        let keys = keys.filter(|key| ![leave, &["kind", "name"]].concat().contains(&key.name));
        let lines: Vec<_> = keys.map(line).collect();
        let top = format!("{head}\n{name}");
        lines
            .prop_map(move |lines| top.clone() + &lines.into_iter().flatten().collect::<String>())
            .boxed()
    };
    prop_oneof![2 => keys(second, &["map"]), 1 => keys(first, &[second, &["map"]].concat())].boxed()
}

fn format() -> Text {
    let rounding = word(&["floor", "toward_zero", "nearest", "nearest_even", "stochastic"]);
    let width = prop_oneof![14..=62_u32, 28..=62_u32];
    let format = (width, 0..=40_u32, rounding, word(&["wrap", "saturate"])).prop_map(
        |(width, point, rounding, overflow)| {
            let point = point.min(width - 10);
            format!("{{ width = {width}, point = {point}, rounding = {rounding}, overflow = {overflow} }}")
        },
    );
    or_wild(format)
}

fn formats() -> Text {
    let odd = ["\"\"", "\"a\\nb\"", "grund", "slope_x"];
    let names = vec![
        select(vec!["view", "denominator", "view_x"]),
        select(vec!["ground", "ground_x", "ground_z"]),
        select(vec!["height", "ray_y", "node"]),
        select([&["weight", "tone"].repeat(20)[..], &odd].concat()),
    ];
    (names, vec(weighted(0.5, format()), 4))
        .prop_map(|(names, formats)| {
            let line =
                |(name, format): (_, Option<String>)| Some(format!("{name} = {}\n", format?));
            let lines: Vec<String> = names.into_iter().zip(formats).filter_map(line).collect();
            format!("[format]\n{}", lines.concat())
        })
        .boxed()
}

/// The text of a scene: most are sound.
pub fn scenes() -> BoxedStrategy<String> {
    let all = sections();
    let named = |path: &str| all.iter().find(|section| section.path == path).expect("a section");
    let surfaces: Vec<&Section> = all.iter().filter(|section| section.path == "surface").collect();
    let front = table("[[screen]]", named("screen"), Some("front"));
    let second = weighted(0.5, table("[[screen]]", named("screen"), Some("über")));
    let surface = prop_oneof![
        4 => table("[[surface]]\nkind = \"terrain\"", surfaces[0], None),
        1 => table("[[surface]]\nkind = \"plane\"", surfaces[1], None),
    ];
    let machine = vec![
        table("[kernel]", named("kernel"), None),
        table("[stepper]", named("stepper"), None),
        table("[light]", named("light"), None),
        table("[color]", named("color"), None),
        table("[machine]", named("machine"), None),
        prop_oneof![2 => Just(String::new()), 1 => formats()].boxed(),
    ];
    let first = (table("", named(""), None), table("[camera]", named("camera"), None));
    (first, (front, second), surface, machine)
        .prop_map(|((head, camera), screens, surface, machine)| {
            let screens = screens.0 + &screens.1.unwrap_or_default();
            format!("{head}{camera}{screens}{surface}{}", machine.concat())
        })
        .boxed()
}

/// A `--set` option: most are sound by themselves.
pub fn options() -> BoxedStrategy<String> {
    let named = || -> Vec<(String, Text)> {
        let mut named = vec![
            ("camera.position.1".to_owned(), number(0.0..50.0)),
            ("screen.1.fov".to_owned(), number(0.1..175.0)),
            ("screen.0.pixel.1".to_owned(), number(0.001..1.0)),
            ("color.ramp.0".to_owned(), "\\[[0-9]{2}, 1?[0-9]{2}, 2\\]".boxed()),
            ("format.ground".to_owned(), format()),
            ("format.view".to_owned(), format()),
            ("format.ground.width".to_owned(), (20..=62_u32).prop_map(|n| n.to_string()).boxed()),
            ("format.a\nb".to_owned(), format()),
        ];
        for section in sections().iter().filter(|section| section.path != "format.NAME") {
            for key in &section.keys {
                let path = format!("{}.{}", section.path, key.name);
                named.push((path.trim_start_matches('.').to_owned(), values(&section.path, key)));
            }
        }
        named
    };
    let keys: Vec<String> = named().into_iter().map(|(key, _)| key).collect();
    let fit = proptest::strategy::Union::new(
        named().into_iter().map(|(key, value)| (Just(key), value).boxed()),
    );
    prop_oneof![5 => fit, 1 => (select(keys), edge())]
        .prop_map(|(key, value)| format!("{key}={value}"))
        .boxed()
}
