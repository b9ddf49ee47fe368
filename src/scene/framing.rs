//! A scene for a height file that has none: the whole map from above one of its sides.
//!
//! The scene is written as TOML and read like any other, so what [`Framing::file`] hands out draws
//! the same picture.

pub mod overlook;
pub mod ramp;
mod reason;
mod view;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::error::SceneError;
use super::file::{Document, parse_with};
use super::height_map::source::is_height_file;
use super::height_map::{
    CoordinateUnit, Encoding, Georeference, HeightFile, Interpretation, MAX_NODES, Thinning,
    available, in_words, mosaic, nodes_in, taken,
};
use super::maps::{MapSource, ReadMap};
use super::shown::shown_path;
use super::tables::Scene;
use super::{set, write};
#[cfg(feature = "cli")]
pub(crate) use reason::is_set;
pub use view::PITCH;
use view::View;

/// The raster of the screen where the user gives none.
const SIZE: (u32, u32) = (1280, 800);

/// Maps that take more bytes say so.
const WORTH_SAYING: u64 = 500_000_000;

/// A height file with a scene that looks over it.
#[derive(Clone, Debug)]
pub struct Framing {
    /// The scene, `--set` options applied.
    pub scene: Scene,
    /// Where the map lies, as far as its file says.
    pub georeference: Georeference,
    /// What was chosen and assumed, a sentence each.
    pub chosen: Vec<String>,
    /// The camera is not the chosen one.
    own_camera: bool,
    /// Where the paths in the scene start.
    folder: PathBuf,
}

/// Whether a scene's name means a height file: by its ending, or else by what the file holds.
pub fn applies(name: &str) -> bool {
    is_height_file(Path::new(name))
}

/// What a user wants of the scene that is chosen for a height file.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wishes {
    /// Columns and lines of the screen.
    pub size: Option<(u32, u32)>,
    /// What the coordinates of the file count.
    pub unit: Option<CoordinateUnit>,
    /// Metres per unit of height.
    pub height_unit_m: Option<f64>,
    /// How many times life size heights are drawn.
    pub exaggeration: Option<f64>,
    /// Bytes that the map may take; of a larger file every n-th node is read.
    pub memory: Option<u64>,
}

/// Reads a height file, or several that make one map, and chooses a scene for it.
///
/// Camera, exaggeration, unless it is asked for as times life size, and colours are chosen before the
/// `--set` options are applied.
///
/// # Errors
/// If a file is no height map, the files do not fit, the heights are too large for a scene, or an option does
/// not fit.
pub fn read(paths: &[&Path], sets: &[String], wishes: &Wishes) -> Result<Framing, SceneError> {
    let unreadable = |file: &Path, reason: String, remedy: String| SceneError::Unreadable {
        file: shown_path(file),
        reason,
        remedy,
    };
    let Some(&path) = paths.first() else {
        let remedy = "give a height file".to_owned();
        return Err(unreadable(Path::new(""), "there is no file".to_owned(), remedy));
    };
    if let Some(missing) = paths.iter().find(|path| !path.exists()) {
        return Err(unreadable(
            missing,
            "there is no such file".to_owned(),
            "give a height file or a scene file that exists, or the name of a built-in scene"
                .to_owned(),
        ));
    }
    let asked = interpretation(sets, wishes);
    let files: Vec<PathBuf> = paths.iter().map(|&path| path.to_owned()).collect();
    let file = mosaic::read(&files, &asked).map_err(|error| SceneError::Unreadable {
        file: error.file,
        reason: error.reason,
        remedy: error.remedy,
    })?;
    let name = path.file_name().and_then(|name| name.to_str());
    let tiles = paths[1..].iter().map(|tile| relative(tile, path)).collect::<Option<Vec<_>>>();
    let (Some(name), Some(tiles)) = (name, tiles) else {
        return Err(unreadable(
            path,
            "its name is not UTF-8 text, which a scene has to be".to_owned(),
            "rename the file".to_owned(),
        ));
    };
    let HeightFile { map, georeference, every, mut notes, .. } = file;
    let bytes = taken(map.samples().len() as u64);
    if bytes > WORTH_SAYING {
        notes.push(format!(
            "the map takes about {} of memory (--memory limits it)",
            in_words(bytes)
        ));
    }
    let size = wishes.size.unwrap_or(SIZE);
    let view = View::new(&map, &georeference, size, wishes.exaggeration)
        .map_err(|(reason, remedy)| unreadable(path, reason, remedy))?;
    if reason::is_set(sets, "surface.map") {
        // Another map is drawn: nothing that was found or chosen is about it.
        notes.clear();
    } else {
        let reasons = view.reasons.iter().filter(|reason| reason.holds(sets));
        notes.extend(reasons.map(|reason| reason.text.clone()));
    }
    let source = MapSource {
        file: name.to_owned(),
        tiles,
        encoding: asked.encoding,
        nodata_value: asked.nodata,
        thin: every as u32,
    };
    let known = ReadMap { source, map: Arc::new(map) };
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let folder = path.parent().unwrap_or(Path::new(""));
    let document = Document {
        name: stem.as_deref().unwrap_or("map"),
        file: &format!("the scene chosen for {}", shown_path(path)),
        folder,
        text: &write::toml(&view.scene(&known), name),
    };
    let scene = parse_with(&document, sets, Some(&known))?;
    let own_camera = reason::is_set(sets, "camera");
    Ok(Framing { scene, georeference, chosen: notes, own_camera, folder: folder.to_owned() })
}

impl Framing {
    /// What became of the scene, as a file at `target` with the map's path relative to it.
    ///
    /// # Errors
    /// If no path leads from there to the map.
    pub fn file(&self, scene: &Scene, target: &Path) -> Result<String, SceneError> {
        let view = if self.own_camera {
            "with another camera"
        } else {
            "the whole map from above one of its sides"
        };
        let mut top = vec![format!("Chosen by terraline for a height file: {view}. {UNITS}")];
        top.extend(self.chosen.iter().map(|reason| format!("Note: {reason}.")));
        written(scene, &self.folder, target, &top)
    }
}

/// A scene with its options, as a file at `target` that draws the same picture. Relative paths in the
/// scene start at `folder`.
///
/// # Errors
/// If no path leads from the target to the map.
pub fn file(scene: &Scene, folder: &Path, target: &Path) -> Result<String, SceneError> {
    let top = format!("Written by terraline, with the options of its command. {UNITS}");
    written(scene, folder, target, &[top])
}

const UNITS: &str = "Lengths in scene units, angles in degrees; x east, y up, z south.";

fn written(
    scene: &Scene,
    folder: &Path,
    target: &Path,
    top: &[String],
) -> Result<String, SceneError> {
    let map = match scene.terrain() {
        Some(terrain) if !terrain.source.is_built_in() => {
            let map = folder.join(&terrain.source.file);
            relative(&map, target).ok_or_else(|| SceneError::Unreadable {
                file: shown_path(target),
                reason: format!("no path of UTF-8 text leads from here to {}", shown_path(&map)),
                remedy: "write the scene into the folder of the height file".to_owned(),
            })?
        }
        _ => String::new(),
    };
    Ok(write::commented(scene, &map, top))
}

/// How the file is to be read: the map is read before the options are applied. Values that make no
/// sense are refused with the other options.
fn interpretation(sets: &[String], wishes: &Wishes) -> Interpretation {
    let asked = |key: &str| {
        sets.iter().rev().find_map(|option| {
            let (path, value) = set::split(option).ok()?;
            let of_surface = path.strip_prefix("surface.")?;
            let is_key = of_surface.strip_prefix("0.").unwrap_or(of_surface) == key;
            is_key.then(|| value.trim_matches(['"', '\'']))
        })
    };
    let nodes = wishes.memory.or_else(available).map_or(MAX_NODES, nodes_in);
    let thin = asked("thin").and_then(|value| value.parse().ok()).filter(|&every| every > 0);
    Interpretation {
        encoding: asked("encoding").and_then(Encoding::named).unwrap_or_default(),
        nodata: asked("nodata_value").and_then(|value| value.parse().ok()),
        unit: wishes.unit,
        height_unit_m: wishes.height_unit_m,
        thinning: thin.map_or(Thinning::Fit(nodes), Thinning::Every),
    }
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
