//! Random texts, damaged scenes and odd options end in a scene or in a message, never in a panic.

use proptest::prelude::*;
use terraline::scene::keys::{Section, sections};

use super::{EVERY_TABLE, try_scene};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn random_texts_never_panic(text in "\\PC*", set in "[a-z.0-9]{0,12}=\\PC{0,8}") {
        let _ = try_scene(&text, &[]);
        let _ = try_scene("", &[&set, &text]);
    }

    #[test]
    fn mutations_of_a_scene_never_panic(
        at in 0_usize..1000, length in 0_usize..8, insert in "[\\PC\\n]{0,3}|nan|1e99|-1|\\[\\]|\"",
    ) {
        let chars: Vec<char> = EVERY_TABLE.chars().collect();
        let at = at % chars.len();
        let end = (at + length).min(chars.len());
        let text: String =
            chars[..at].iter().copied().chain(insert.chars()).chain(chars[end..].iter().copied()).collect();
        if let Err(error) = try_scene(&text, &[]) {
            prop_assert_eq!(error.to_string().lines().count(), 1);
        }
    }

    #[test]
    fn options_of_any_value_never_panic(
        key in prop::sample::select(option_paths()),
        value in "[0-9.e\\[\\],{}=\"a-z-]{0,12}|-?[0-9]{1,12}e-?[0-9]{1,3}|\\[-?[0-9]{1,9}e-?[0-9]{1,3}, ?[0-9]{1,9}(, 0)?\\]",
    ) {
        if let Err(error) = try_scene(EVERY_TABLE, &[&format!("{key}={value}")]) {
            prop_assert_eq!(error.to_string().lines().count(), 1);
        }
    }
}

/// Every key and table, and some elements of arrays.
fn option_paths() -> Vec<String> {
    let sections = sections();
    let keys = sections.iter().flat_map(|Section { path, keys, .. }| {
        keys.iter()
            .map(move |key| format!("{path}.{}", key.name).trim_start_matches('.').to_owned())
    });
    let tables =
        sections.iter().map(|section| section.path.clone()).filter(|path| !path.is_empty());
    let elements = ["screen.0.fov", "screen.1.pixel", "color.ramp.0", "format.view"];
    keys.chain(tables).chain(elements.map(str::to_owned)).collect()
}
