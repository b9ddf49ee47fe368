//! Files that a command writes: their names are checked before anything is read or drawn.

use std::path::{Path, PathBuf};

use super::Stop;
use crate::scene::quote;
use crate::sink;

/// An option and the file that it names.
pub type Named<'a> = (&'a str, &'a Path);

/// The form that each option writes, which is the ending of its file.
const ENDINGS: [(&str, &str); 4] = [
    ("--output", "png"),
    ("--screenshot", "png"),
    ("--buffers", "npz"),
    ("--scene-out", "toml"),
];

/// Refuses a file whose ending promises another form than the option writes. A name without an
/// ending promises nothing.
pub fn check_endings<'a>(outputs: impl IntoIterator<Item = Named<'a>>) -> Result<(), Stop> {
    for (option, path) in outputs {
        let Some((_, ending)) = ENDINGS.iter().find(|(known, _)| *known == option) else { continue };
        let Some(found) = path.extension() else { continue };
        if !found.eq_ignore_ascii_case(ending) {
            return Err(Stop::BadInput(format!(
                "{option} {}: .{ending} files are written, not .{}; give {option} {}",
                path.display(),
                found.to_string_lossy(),
                quote(&path.with_extension(ending).to_string_lossy())
            )));
        }
    }
    Ok(())
}

/// Refuses outputs that cannot be written, and two options that name one file.
pub fn check<'a>(outputs: impl IntoIterator<Item = Named<'a>>) -> Result<(), Stop> {
    let mut before: Vec<(&str, PathBuf)> = Vec::new();
    for (option, path) in outputs {
        sink::check_writable(path)?;
        let Some(place) = place(path) else { continue };
        if let Some((other, _)) = before.iter().find(|(_, other)| *other == place) {
            return Err(Stop::BadInput(format!(
                "{option} {}: {other} writes the same file; give two names",
                path.display()
            )));
        }
        before.push((option, place));
    }
    Ok(())
}

/// One name for a file that may not exist yet, whatever path leads to it.
fn place(path: &Path) -> Option<PathBuf> {
    if let Ok(real) = std::fs::canonicalize(path) {
        return Some(real);
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = std::fs::canonicalize(folder.unwrap_or(Path::new("."))).ok()?;
    Some(folder.join(path.file_name()?))
}

/// Refuses to write to a file that is read.
pub fn keep_inputs<'a>(
    outputs: impl IntoIterator<Item = Named<'a>>,
    inputs: &[PathBuf],
) -> Result<(), Stop> {
    for (_, output) in outputs {
        // A file that does not exist is no input.
        let Ok(real) = std::fs::canonicalize(output) else { continue };
        if inputs.iter().any(|input| std::fs::canonicalize(input).is_ok_and(|i| i == real)) {
            return Err(Stop::BadInput(format!(
                "{}: this file is read, it would be overwritten; give another name for the output",
                output.display()
            )));
        }
    }
    Ok(())
}
