//! Random scene files and options: sound values, and now and then a wild one.

use proptest::collection::vec;
use proptest::option::weighted;
use proptest::prelude::*;
use proptest::sample::select;

/// A TOML value, or a part of a scene file.
pub type Text = BoxedStrategy<String>;

/// Maps that the fuzzed scenes find in their folder, beside the built-in ones; the last is missing.
pub const MAPS: [&str; 9] = [
    "hills.asc",
    "hills.asc",
    "holes.asc",
    "flat.asc",
    "cliffs.png",
    "row.asc",
    "one.asc",
    "packed.png",
    "missing\\nfile.asc",
];

/// Values at an end of some range, or beyond.
const EDGES: [&str; 40] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "16",
    "62",
    "63",
    "64",
    "65",
    "0.5",
    "1e-9",
    "0.99e-9",
    "1e9",
    "-1e9",
    "1.01e9",
    "175",
    "176",
    "360",
    "1e-300",
    "5e-324",
    "1e308",
    "-1e308",
    "1e999",
    "nan",
    "-inf",
    "9223372036854775807",
    "-9223372036854775808",
    "9223372036854775808",
    "0x7fff_ffff",
    "true",
    "\"\"",
    "\"footprint\"",
    "[]",
    "[[]]",
    "{}",
    "[0, 0]",
    "[0, 0, 0]",
    "1979-05-27T07:32:00Z",
    "\"\\u0000\\n\\u202e\"",
];

/// A value at an end of some range, or beyond.
pub fn edge() -> Text {
    let exponent = (prop::bool::ANY, -12.0..12.0_f64)
        .prop_map(|(minus, e)| if minus { -10.0_f64.powf(e) } else { 10.0_f64.powf(e) });
    prop_oneof![
        3 => select(EDGES.to_vec()).prop_map(str::to_owned),
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

/// A number, whole at times.
pub fn number(range: std::ops::Range<f64>) -> Text {
    let ends = (range.start, range.end);
    or_wild((range, prop::bool::weighted(0.3)).prop_map(move |(number, whole)| {
        let rounded = number.round();
        if whole && (ends.0..ends.1).contains(&rounded) && rounded != 0.0 {
            format!("{rounded}")
        } else {
            format!("{number:?}")
        }
    }))
}

fn count(range: std::ops::RangeInclusive<u32>) -> Text {
    or_wild(range.prop_map(|count| count.to_string()))
}

fn word(words: &[&str]) -> Text {
    let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
    or_wild(select(words))
}

fn list(elements: Vec<Text>) -> Text {
    or_wild(elements.prop_map(|elements| format!("[{}]", elements.join(", "))))
}

/// An array of numbers.
pub fn numbers<const N: usize>(range: std::ops::Range<f64>) -> Text {
    list((0..N).map(|_| number(range.clone())).collect())
}

fn color() -> Text {
    list((0..3).map(|_| count(0..=255)).collect())
}

fn colors(counts: std::ops::RangeInclusive<usize>) -> Text {
    or_wild(vec(color(), counts).prop_map(|colors| format!("[{}]", colors.join(", "))))
}

/// `key = value`, of each key or none; keys that end in `!` are always there.
fn keys(keys: Vec<(&'static str, Text)>) -> BoxedStrategy<Vec<String>> {
    let line = |(key, value): (&'static str, Text)| {
        let always = key.ends_with('!');
        let key = key.trim_end_matches('!');
        let line = value.prop_map(move |value| format!("{key} = {value}"));
        if always { line.prop_map(Some).boxed() } else { weighted(0.6, line).boxed() }
    };
    let lines: Vec<_> = keys.into_iter().map(line).collect();
    lines.prop_map(|lines| lines.into_iter().flatten().collect()).boxed()
}

fn inline(all: Vec<(&'static str, Text)>) -> Text {
    or_wild(keys(all).prop_map(|keys| format!("{{ {} }}", keys.join(", "))))
}

fn table(head: &'static str, all: Vec<(&'static str, Text)>) -> Text {
    keys(all).prop_map(move |keys| format!("{head}\n{}\n", keys.join("\n"))).boxed()
}

fn camera() -> Text {
    let place = || {
        vec![
            ("position", list(vec![number(-20.0..60.0), number(0.0..40.0), number(-20.0..60.0)])),
            ("offset", numbers::<3>(-2.0..2.0)),
        ]
    };
    let angles = ["heading", "pitch", "roll"].map(|key| (key, number(-400.0..400.0)));
    let directions = ["forward!", "up!"].map(|key| (key, numbers::<3>(-3.0..3.0)));
    prop_oneof![
        table("[camera]", [place(), angles.to_vec()].concat()),
        table("[camera]", [place(), directions.to_vec()].concat()),
    ]
    .boxed()
}

fn screen(name: &'static str) -> Text {
    let common = || {
        let mount = ["heading", "pitch", "roll"].map(|key| (key, number(-100.0..100.0)));
        vec![
            ("name!", word(&[name])),
            ("size", list(vec![count(1..=3000), count(1..=3000)])),
            ("center", numbers::<2>(-1.0..1.0)),
            ("mount", inline(mount.to_vec())),
        ]
    };
    let view = vec![("fov", number(0.01..175.0))];
    let pitch = vec![("distance!", number(0.1..9.0)), ("pixel!", numbers::<2>(0.0001..0.5))];
    prop_oneof![
        2 => table("[[screen]]", [common(), view].concat()),
        1 => table("[[screen]]", [common(), pitch].concat()),
    ]
    .boxed()
}

fn surface() -> Text {
    let builtin = ["builtin:jacksboro", "builtin:jacksboro@2", "builtin:jacksboro@61"];
    let map = prop_oneof![9 => word(&MAPS), 1 => word(&builtin)];
    let height = vec![("offset", number(0.0..300.0)), ("scale", number(0.001..0.2))];
    let nodata = prop_oneof![word(&["hole", "nearest"]), number(0.0..400.0)];
    let terrain = vec![
        ("kind", word(&["terrain"])),
        ("cell", numbers::<2>(0.1..4.0)),
        ("height", inline(height)),
        ("outside", word(&["sky", "clamp", "wrap"])),
        ("nodata", nodata.boxed()),
        ("base_depth", number(0.01..9.0)),
        (
            "encoding",
            prop_oneof![9 => Just("\"stored\""), 1 => Just("\"terrarium\"")]
                .prop_map(str::to_owned)
                .boxed(),
        ),
    ];
    let plane = vec![
        ("normal", numbers::<3>(-2.0..2.0)),
        ("distance", number(-20.0..20.0)),
        ("checker", number(0.1..20.0)),
    ];
    prop_oneof![
        4 => (table("[[surface]]", terrain), map).prop_map(|(table, map)| format!("{table}map = {map}\n")),
        1 => table("[[surface]]\nkind = \"plane\"", plane),
    ]
    .boxed()
}

fn machine() -> Text {
    let stepper = vec![
        ("mode", word(&["skipping", "plain"])),
        ("fineness", count(0..=6)),
        ("halvings", prop_oneof![word(&["footprint"]), count(0..=20)].boxed()),
    ];
    let kernel = vec![
        ("shape", word(&["cosine", "parabola", "exponential", "hat"])),
        ("deformation", count(0..=2)),
        ("weight_shift", count(0..=64)),
        ("table", or_wild((4..=16_u32).prop_map(|bits| (1 << bits).to_string()))),
    ];
    let light = vec![("direction", numbers::<3>(-2.0..2.0)), ("ambient", number(0.0..1.0))];
    let color = vec![
        ("ramp", colors(2..=16)),
        ("sky", color()),
        ("far", color()),
        ("side", color()),
        ("checker", colors(2..=2)),
    ];
    let machine = vec![
        ("clock_mhz", number(0.1..1000.0)),
        ("memory_latency", count(1..=64)),
        ("words", word(&["auto", "narrow", "wide"])),
        ("ratio", word(&["array", "serial"])),
    ];
    let tables = vec![
        table("[stepper]", stepper),
        table("[kernel]", kernel),
        table("[light]", light),
        table("[color]", color),
        table("[machine]", machine),
        prop_oneof![2 => Just(String::new()), 1 => formats()].boxed(),
    ];
    tables.prop_map(|tables| tables.concat()).boxed()
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
    let head = keys(vec![("unit_m", number(0.1..100.0)), ("seed", count(0..=u32::MAX))]);
    (head, camera(), (screen("front"), prop::option::of(screen("über"))), surface(), machine())
        .prop_map(|(head, camera, screens, surface, machine)| {
            format!(
                "{}\n{camera}{}{surface}{machine}",
                head.join("\n"),
                screens.0 + &screens.1.unwrap_or_default()
            )
        })
        .boxed()
}

/// A `--set` option: most are sound by themselves.
pub fn options() -> BoxedStrategy<String> {
    let named = || -> Vec<(&'static str, Text)> {
        vec![
            ("unit_m", number(0.1..90.0)),
            ("seed", count(0..=u32::MAX)),
            ("camera.position", numbers::<3>(0.0..50.0)),
            ("camera.position.1", number(0.0..50.0)),
            ("camera.heading", number(-400.0..400.0)),
            ("camera.pitch", number(-90.0..90.0)),
            ("camera.roll", number(-180.0..180.0)),
            ("camera.forward", numbers::<3>(-2.0..2.0)),
            ("camera.up", numbers::<3>(-2.0..2.0)),
            ("screen.size", list(vec![count(1..=4000), count(1..=4000)])),
            ("screen.fov", number(0.1..175.0)),
            ("screen.1.fov", number(0.1..175.0)),
            ("screen.0.pixel.1", number(0.001..1.0)),
            ("screen.center", numbers::<2>(-9.0..9.0)),
            ("screen.mount.roll", number(-180.0..180.0)),
            ("screen.name", word(&["left", "a b", "a\\nb"])),
            ("surface.kind", word(&["plane", "terrain"])),
            ("surface.map", word(&MAPS)),
            ("surface.cell", numbers::<2>(0.01..20.0)),
            ("surface.height.offset", number(-400.0..400.0)),
            ("surface.height.scale", number(0.0001..2.0)),
            ("surface.outside", word(&["wrap", "clamp", "sky"])),
            ("surface.nodata", number(-400.0..900.0)),
            ("surface.base_depth", number(0.001..99.0)),
            ("surface.encoding", word(&["terrarium", "terrain-rgb", "stored"])),
            ("kernel.shape", word(&["hat", "exponential"])),
            ("kernel.weight_shift", count(0..=64)),
            ("stepper.mode", word(&["plain", "skipping"])),
            ("stepper.fineness", count(0..=6)),
            ("stepper.halvings", count(0..=20)),
            ("light.direction", numbers::<3>(-1.0..1.0)),
            ("color.ramp.0", color()),
            ("color.checker", colors(2..=2)),
            ("machine.clock_mhz", number(0.1..99.0)),
            ("machine.words", word(&["wide", "narrow", "auto"])),
            ("format.ground", format()),
            ("format.view", format()),
            ("format.ground.width", count(20..=62)),
            ("format.a\nb", format()),
        ]
    };
    let keys: Vec<&str> = named().iter().map(|(key, _)| *key).collect();
    let fit = proptest::strategy::Union::new(
        named().into_iter().map(|(key, value)| (Just(key), value).boxed()),
    );
    prop_oneof![5 => fit, 1 => (select(keys), edge())]
        .prop_map(|(key, value)| format!("{key}={value}"))
        .boxed()
}
