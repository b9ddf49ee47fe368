//! The reader of scene files: TOML text and `--set` options to a checked [`Scene`].
//!
//! Every key has a default, angles are in degrees, unknown keys are errors. A [`SceneError`] names
//! the file, the line, the field, what is wrong with it and what to do.

use std::path::Path;

use toml::de::DeTable;

use super::error::{Place, SceneError};
use super::field::{Context, Fields};
use super::height_map::file::{file_reason, read_limited};
use super::maps::{Maps, ReadMap};
use super::set;
use super::shown::{one_line, shown_path};
use super::tables::{Scene, paths};
use super::tree::Node;

/// A scene file is a few hundred bytes; what is much larger was given by mistake.
const MAX_FILE_BYTES: u64 = 1 << 20;

/// The text of a scene and where it comes from.
#[derive(Clone, Copy, Debug)]
pub struct Document<'a> {
    /// Name of the scene, for reports.
    pub name: &'a str,
    /// What messages call the file.
    pub file: &'a str,
    /// Folder where relative paths in the scene start.
    pub folder: &'a Path,
    /// The text of the file, TOML.
    pub text: &'a str,
}

/// Reads a scene file and applies the `--set` options.
///
/// # Errors
/// If the file cannot be read or [`parse`] fails.
pub fn read(path: &Path, sets: &[String]) -> Result<Scene, SceneError> {
    let file = shown_path(path);
    let unreadable = |reason: String, remedy: &str| SceneError::Unreadable {
        file: file.clone(),
        reason,
        remedy: remedy.to_owned(),
    };
    let bytes = read_limited(path, MAX_FILE_BYTES).map_err(|error| {
        unreadable(file_reason(&error), "give a scene file (TOML) or the name of a built-in scene")
    })?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = 1 + error.as_bytes()[..at].iter().filter(|&&byte| byte == b'\n').count();
        unreadable(
            format!("line {line} is not UTF-8 text"),
            "give a scene file, which is TOML text in UTF-8, or a height file that \
             `terraline info` understands",
        )
    })?;
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    parse(
        &Document {
            name: stem.as_deref().unwrap_or("scene"),
            file: &file,
            folder: path.parent().unwrap_or(Path::new("")),
            text: &text,
        },
        sets,
    )
}

/// Parses the text of a scene and applies the `--set` options.
///
/// # Errors
/// If the text is not TOML, a field is unknown or wrong, or the height map cannot be used.
///
/// # Examples
/// ```
/// use std::path::Path;
/// use terraline::scene::file::{Document, parse};
///
/// let text = "[camera]\nposition = [0, 12, 0]\nheading = 450";
/// let document = Document { name: "mine", file: "mine.toml", folder: Path::new(""), text };
/// let scene = parse(&document, &["screen.size=[64, 48]".to_owned()])?;
/// assert_eq!((scene.screens[0].columns, scene.screens[0].lines), (64, 48));
///
/// let error = parse(&document, &["camera.hedding=3".to_owned()]).unwrap_err();
/// assert!(error.to_string().contains("did you mean `camera.heading`?"));
/// # Ok::<(), terraline::scene::SceneError>(())
/// ```
pub fn parse(document: &Document<'_>, sets: &[String]) -> Result<Scene, SceneError> {
    parse_with(document, sets, None)
}

/// As [`parse`], with a map that was read before.
pub(super) fn parse_with(
    document: &Document<'_>,
    sets: &[String],
    known: Option<&ReadMap>,
) -> Result<Scene, SceneError> {
    let table = DeTable::parse(document.text).map_err(|error| syntax(document, &error))?;
    let mut root = Node::document(table);
    let options = set::apply(&mut root, sets)?;
    let Document { file, text, folder, .. } = *document;
    let context = Context { file, text, options, maps: Maps { folder, known }, paths };
    Scene::read(document.name, &Fields::root(&context, &root)?)
}

fn syntax(document: &Document<'_>, error: &toml::de::Error) -> SceneError {
    // Without a span the text ended too early.
    let offset = error.span().map_or(document.text.len(), |span| span.start);
    SceneError::Syntax {
        place: Place::in_text(document.file, document.text, offset),
        reason: one_line(error.message()),
        remedy: "correct this line; `terraline scenes overview` prints a scene to compare with"
            .to_owned(),
    }
}
