//! Scenes and maps inside the program, and the one door to any scene: [`load`].

use std::path::{Path, is_separator};
use std::sync::{Arc, OnceLock};

use super::Scene;
use super::error::{SceneError, list, nearest};
use super::file::{self, Document};
use super::height_map::{HeightMap, MapError};
use super::overlook;

/// A scene inside the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltinScene {
    /// What the command line calls it.
    pub name: &'static str,
    /// What it shows, in one line.
    pub description: &'static str,
    /// The scene file; written to a folder of the user's, it renders as it is.
    pub toml: &'static str,
}

/// The built-in scenes; the first is the default.
pub const SCENES: [BuiltinScene; 4] = [
    BuiltinScene {
        name: "overview",
        description: "the whole Jacksboro map from above its north edge",
        toml: include_str!("builtin/overview.toml"),
    },
    BuiltinScene {
        name: "flight",
        description: "over the Jacksboro fault, looking north-west",
        toml: include_str!("builtin/flight.toml"),
    },
    BuiltinScene {
        name: "valley",
        description: "just above the ground of a valley, with ridges up to the horizon",
        toml: include_str!("builtin/valley.toml"),
    },
    BuiltinScene {
        name: "plane",
        description: "an endless checkered plane, which needs no map and no stepper",
        toml: include_str!("builtin/plane.toml"),
    },
];

/// Names of the built-in maps, as in `builtin:jacksboro`.
pub const MAPS: [&str; 1] = ["jacksboro"];

static JACKSBORO: &[u8] = include_bytes!("../../assets/jacksboro.png");

/// The built-in scene of that name.
pub fn find(name: &str) -> Option<&'static BuiltinScene> {
    SCENES.iter().find(|scene| scene.name == name)
}

/// The built-in map of that name, decoded once; `None` if there is none.
pub fn map(name: &str) -> Option<Result<Arc<HeightMap>, MapError>> {
    static DECODED: OnceLock<Result<Arc<HeightMap>, MapError>> = OnceLock::new();
    (name == MAPS[0]).then(|| {
        DECODED
            .get_or_init(|| HeightMap::from_png(JACKSBORO, "builtin:jacksboro").map(Arc::new))
            .clone()
    })
}

/// Loads a scene, with `--set` options applied: a built-in one by its name, a file, or a height
/// file, which gets a scene that looks over it.
///
/// An argument with a path separator or the ending `.toml` is a file; without an argument the
/// default scene is loaded.
///
/// # Errors
/// If there is no such scene, or as [`file::read`], [`file::parse`] and [`overlook::read`].
pub fn load(name_or_path: Option<&str>, sets: &[String]) -> Result<Scene, SceneError> {
    let name = name_or_path.unwrap_or(SCENES[0].name);
    if let Some(scene) = find(name) {
        return file::parse(
            &Document {
                name: scene.name,
                file: &format!("builtin:{}", scene.name),
                folder: Path::new(""),
                text: scene.toml,
            },
            sets,
        );
    }
    if overlook::applies(name) {
        return overlook::read(Path::new(name), sets, None).map(|overlook| overlook.scene);
    }
    let names = || SCENES.iter().map(|scene| scene.name);
    if name.contains(is_separator) || name.ends_with(".toml") {
        return file::read(Path::new(name), sets).map_err(|error| match error {
            SceneError::Unreadable { file, reason, .. } if !Path::new(name).exists() => {
                let stem = Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
                let guess = nearest(&stem, names())
                    .map_or_else(String::new, |guess| format!(", did you mean `{guess}`?"));
                let remedy = format!(
                    "give a scene file that exists or a built-in scene: {}{guess}",
                    list(names())
                );
                SceneError::Unreadable { file, reason, remedy }
            }
            other => other,
        });
    }
    Err(unknown(name))
}

/// The error for a name that no built-in scene has.
pub fn unknown(name: &str) -> SceneError {
    let names = || SCENES.iter().map(|scene| scene.name);
    SceneError::UnknownScene {
        name: super::tree::shorten(name),
        suggestion: nearest(name, names()).map(str::to_owned),
        known: list(names()),
    }
}
