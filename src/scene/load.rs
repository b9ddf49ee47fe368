//! The one door to any scene.

use std::path::{Path, is_separator};

use super::error::{SceneError, list, nearest};
use super::file::{self, Document};
use super::tables::Scene;
use super::{builtin, framing};

/// Loads a scene, with `--set` options applied: a built-in one by its name, a file, or a height
/// file, which gets a scene that looks over it.
///
/// An argument with a path separator or the ending `.toml`, or that exists as a file, is a file; without an argument the
/// default scene is loaded.
///
/// # Errors
/// If there is no such scene, or as [`file::read`], [`file::parse`] and [`framing::read`].
pub fn load(name_or_path: Option<&str>, sets: &[String]) -> Result<Scene, SceneError> {
    let name = name_or_path.unwrap_or(builtin::SCENES[0].name);
    if let Some(scene) = builtin::find(name) {
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
    if framing::applies(name) {
        return framing::read(Path::new(name), sets, None, None).map(|framing| framing.scene);
    }
    let names = || builtin::SCENES.iter().map(|scene| scene.name);
    let path = Path::new(name);
    if name.contains(is_separator) || name.ends_with(".toml") || path.exists() {
        return file::read(path, sets).map_err(|error| match error {
            SceneError::Unreadable { file, reason, .. } if !path.exists() => {
                let stem = path.file_stem().unwrap_or_default().to_string_lossy();
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
    Err(builtin::unknown(name))
}
