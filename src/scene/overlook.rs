//! A scene for a height file that has none: the whole map from above one of its sides.
//!
//! The scene is written as TOML and read like any other, so what [`Overlook::file`] hands out draws
//! the same picture.

mod ramp;
mod text;
mod view;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::file::{Document, parse_with};
use super::height_map::shown_path;
use super::height_map::source::{self, is_height_file};
use super::set;
use super::surface::ReadMap;
use super::{Encoding, HeightFile, HeightMap, Scene, SceneError};
use view::View;

/// The raster of the screen where the user gives none.
const SIZE: (u32, u32) = (1280, 800);

/// A height file with a scene that looks over it.
#[derive(Clone, Debug)]
pub struct Overlook {
    /// The scene, `--set` options applied.
    pub scene: Scene,
    /// What was chosen and assumed, a sentence each.
    pub chosen: Vec<String>,
    path: PathBuf,
    encoding: Encoding,
    view: View,
    sets: Vec<String>,
}

/// Whether a scene's name means a height file: by its ending, or else by what the file holds.
pub fn applies(name: &str) -> bool {
    is_height_file(Path::new(name))
}

/// Reads a height file and chooses a scene for it, for a screen of `size` columns and lines.
///
/// Camera, exaggeration and colours are chosen before the `--set` options are applied.
///
/// # Errors
/// If the file is no height map, its heights are too large for a scene, or an option does not fit.
pub fn read(
    path: &Path,
    sets: &[String],
    size: Option<(u32, u32)>,
) -> Result<Overlook, SceneError> {
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
    let view = View::new(&map, &georeference, size.unwrap_or(SIZE))
        .map_err(|(reason, remedy)| unreadable(path, reason, remedy))?;
    notes.extend(view.reasons.iter().cloned());
    let known = ReadMap { source: name.to_owned(), encoding, map: Arc::new(map) };
    let text = text::write(&view, name, encoding);
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let document = Document {
        name: stem.as_deref().unwrap_or("map"),
        file: &format!("the scene chosen for {}", shown_path(path)),
        folder: path.parent().unwrap_or(Path::new("")),
        text: &text,
    };
    let scene = parse_with(&document, sets, Some(&known))?;
    Ok(Overlook {
        scene,
        chosen: notes,
        path: path.to_owned(),
        encoding,
        view,
        sets: sets.to_vec(),
    })
}

impl Overlook {
    /// The scene as a file at `target`, with the options applied and the map's path relative to it.
    ///
    /// # Errors
    /// If no path leads from there to the map, or an option cannot be written.
    pub fn file(&self, target: &Path) -> Result<String, SceneError> {
        let map = relative(&self.path, target).ok_or_else(|| SceneError::Unreadable {
            file: shown_path(target),
            reason: format!("no path of UTF-8 text leads from here to {}", shown_path(&self.path)),
            remedy: "write the scene into the folder of the height file".to_owned(),
        })?;
        text::with_sets(&text::write(&self.view, &map, self.encoding), &self.sets)
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

/// Nodes of a map that make a scene's sides.
fn cells(map: &HeightMap) -> (f64, f64) {
    ((map.columns() - 1) as f64, (map.rows() - 1) as f64)
}
