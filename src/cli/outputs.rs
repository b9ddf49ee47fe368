//! Files that a command writes: their names are checked before anything is read or drawn.

use std::path::{Path, PathBuf};

use super::Stop;
use crate::sink;

/// An option and the file that it names.
pub type Named<'a> = (&'a str, &'a Path);

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
