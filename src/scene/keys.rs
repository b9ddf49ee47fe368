//! All keys of a scene file as their declarations say, for documents and tests.

use std::fmt::Write as _;

pub use super::kind::{Key, Kind};
pub use super::tables::{Section, sections};

/// Text of docs/scene-keys.md.
pub fn markdown() -> String {
    let mut page = String::from(
        "# The keys of a scene file\n\n\
         Generated from the declarations in `src/scene/`. Lengths are in scene units, angles in\n\
         degrees; x is east, y up, z south. A key that is left out has its default; where none is\n\
         given here, the meaning says what counts. Unknown keys are errors.\n",
    );
    for Section { head, keys, .. } in sections() {
        // Writing to a string cannot fail.
        let _ = write!(
            page,
            "\n## {head}\n\n| key | default | values | meaning |\n|---|---|---|---|\n"
        );
        for Key { name, meaning, kind, default } in keys {
            let default = default.map_or_else(String::new, |default| format!("`{default}`"));
            let _ = writeln!(page, "| `{name}` | {default} | {} | {meaning} |", kind.expected());
        }
    }
    page
}
