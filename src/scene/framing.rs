//! A scene for a height file that has none: the whole map from above one of its sides.
//!
//! The scene is written as TOML and read like any other, so what [`Framing::file`] hands out draws
//! the same picture.

pub mod overlook;
pub mod ramp;
mod view;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::error::SceneError;
use super::file::{Document, parse_with};
use super::height_map::source::{self, is_height_file};
use super::height_map::{Encoding, Georeference, HeightFile};
use super::maps::ReadMap;
use super::shown::shown_path;
use super::tables::Scene;
use super::{set, write};
pub use view::PITCH;
use view::View;

/// The raster of the screen where the user gives none.
const SIZE: (u32, u32) = (1280, 800);

/// A height file with a scene that looks over it.
#[derive(Clone, Debug)]
pub struct Framing {
    /// The scene, `--set` options applied.
    pub scene: Scene,
    /// What was chosen and assumed, a sentence each.
    pub chosen: Vec<String>,
    /// Where the file says that its map lies.
    pub georeference: Georeference,
    /// Where the paths in the scene start.
    folder: PathBuf,
}

/// Whether a scene's name means a height file: by its ending, or else by what the file holds.
pub fn applies(name: &str) -> bool {
    is_height_file(Path::new(name))
}

/// Reads a height file and chooses a scene for it, for a screen of `size` columns and lines.
///
/// Camera, exaggeration, unless it is asked for as times life size, and colours are chosen before the
/// `--set` options are applied.
///
/// # Errors
/// If the file is no height map, its heights are too large for a scene, or an option does not fit.
pub fn read(
    path: &Path,
    sets: &[String],
    size: Option<(u32, u32)>,
    exaggeration: Option<f64>,
) -> Result<Framing, SceneError> {
    let encoding = encoding(sets);
    let unreadable = |file: &Path, reason: String, remedy: String| SceneError::Unreadable {
        file: shown_path(file),
        reason,
        remedy,
    };
    if !path.exists() {
        return Err(unreadable(
            path,
            "there is no such file".to_owned(),
            "give a height file or a scene file that exists, or the name of a built-in scene"
                .to_owned(),
        ));
    }
    let file = source::read(path, encoding).map_err(|error| SceneError::Unreadable {
        file: error.file,
        reason: error.reason,
        remedy: error.remedy,
    })?;
    let Some(name) = path.file_name().and_then(|name| name.to_str()) else {
        return Err(unreadable(
            path,
            "its name is not UTF-8 text, which a scene has to be".to_owned(),
            "rename the file".to_owned(),
        ));
    };
    let HeightFile { map, georeference, mut notes, .. } = file;
    let view = View::new(&map, &georeference, size.unwrap_or(SIZE), exaggeration)
        .map_err(|(reason, remedy)| unreadable(path, reason, remedy))?;
    notes.extend(view.reasons.iter().cloned());
    let known = ReadMap { source: name.to_owned(), encoding, map: Arc::new(map) };
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let folder = path.parent().unwrap_or(Path::new(""));
    let document = Document {
        name: stem.as_deref().unwrap_or("map"),
        file: &format!("the scene chosen for {}", shown_path(path)),
        folder,
        text: &write::toml(&view.scene(&known), name),
    };
    let scene = parse_with(&document, sets, Some(&known))?;
    Ok(Framing { scene, chosen: notes, georeference, folder: folder.to_owned() })
}

impl Framing {
    /// What became of the scene, as a file at `target` with the map's path relative to it.
    ///
    /// # Errors
    /// If no path leads from there to the map.
    pub fn file(&self, scene: &Scene, target: &Path) -> Result<String, SceneError> {
        let mut top = vec![
            "Chosen by terraline for a height file: the whole map from above one of its sides. \
             Lengths in scene units, angles in degrees; x east, y up, z south."
                .to_owned(),
        ];
        top.extend(self.chosen.iter().map(|reason| format!("Note: {reason}.")));
        let map = match scene.terrain() {
            Some(terrain) if !terrain.is_built_in() => {
                let map = self.folder.join(&terrain.source);
                relative(&map, target).ok_or_else(|| SceneError::Unreadable {
                    file: shown_path(target),
                    reason: format!(
                        "no path of UTF-8 text leads from here to {}",
                        shown_path(&map)
                    ),
                    remedy: "write the scene into the folder of the height file".to_owned(),
                })?
            }
            _ => String::new(),
        };
        Ok(write::commented(scene, &map, &top))
    }
}

/// The encoding that an option asks for: the map is read before the options are applied. An
/// unknown one is refused with the other options.
fn encoding(sets: &[String]) -> Encoding {
    let asked = sets.iter().rev().find_map(|option| {
        let (path, value) = set::split(option).ok()?;
        matches!(path, "surface.encoding" | "surface.0.encoding").then_some(value)
    });
    let asked = asked.unwrap_or_default().trim_matches(['"', '\'']);
    Encoding::NAMES
        .iter()
        .find(|(name, _)| *name == asked)
        .map_or(Encoding::Stored, |(_, encoding)| *encoding)
}

/// The path of a file from the folder of another, with slashes.
fn relative(file: &Path, from: &Path) -> Option<String> {
    let file = std::fs::canonicalize(file).ok()?;
    let folder = from.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = std::fs::canonicalize(folder.unwrap_or(Path::new("."))).ok()?;
    let shared = file.components().zip(folder.components()).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        return None;
    }
    let up = folder.components().skip(shared).map(|_| Some(".."));
    let down = file.components().skip(shared).map(|part| part.as_os_str().to_str());
    let parts: Option<Vec<&str>> = up.chain(down).collect();
    Some(parts?.join("/"))
}
