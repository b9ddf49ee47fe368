//! A folder of files that appears whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::SinkError;

/// A folder in the making: a temporary folder beside its target, which takes the target's name
/// when the last file is written, and is removed if it never comes to that.
#[derive(Debug)]
pub struct NewFolder {
    target: PathBuf,
    temporary: PathBuf,
    renamed: bool,
}

impl NewFolder {
    /// Checks that a folder of this name can be made.
    ///
    /// # Errors
    /// If something of this name exists already, or the folder around it is missing.
    #[cfg(feature = "cli")]
    pub fn check(target: &Path) -> Result<(), SinkError> {
        around(target).map(|_| ())
    }

    /// Begins a folder.
    ///
    /// # Errors
    /// As [`NewFolder::check`], or if the folder around it cannot be written.
    pub fn begin(target: &Path) -> Result<Self, SinkError> {
        let folder = around(target)?;
        let mut number = 0;
        let temporary = loop {
            let path = folder.join(format!(".terraline-{}-{number}.part", std::process::id()));
            match fs::create_dir(&path) {
                Ok(()) => break path,
                // Left behind by a process that was killed.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
                Err(error) => return Err(SinkError::Io { path: target.to_owned(), error }),
            }
        };
        Ok(Self { target: target.to_owned(), temporary, renamed: false })
    }

    /// Where files are written meanwhile.
    pub fn path(&self) -> &Path {
        &self.temporary
    }

    /// The error of a file in it.
    pub fn error(&self, file: &str, error: io::Error) -> SinkError {
        SinkError::Io { path: self.target.join(file), error }
    }

    /// Gives the folder its name.
    ///
    /// # Errors
    /// If the operating system refuses.
    pub fn finish(mut self) -> Result<(), SinkError> {
        fs::rename(&self.temporary, &self.target)
            .map_err(|error| SinkError::Io { path: self.target.clone(), error })?;
        self.renamed = true;
        Ok(())
    }
}

impl Drop for NewFolder {
    fn drop(&mut self) {
        if !self.renamed {
            // Nothing can be done about a failure here; the first error is the one to report.
            let _ = fs::remove_dir_all(&self.temporary);
        }
    }
}

/// The folder around a target that does not exist yet.
fn around(target: &Path) -> Result<PathBuf, SinkError> {
    let path = target.to_owned();
    if fs::symlink_metadata(target).is_ok() {
        return Err(SinkError::Occupied { path });
    }
    let folder = match target.parent() {
        Some(folder) if folder != Path::new("") => folder.to_owned(),
        Some(_) if target.file_name().is_some() => PathBuf::from("."),
        _ => return Err(SinkError::Occupied { path }),
    };
    match fs::metadata(&folder) {
        Ok(there) if there.is_dir() => Ok(folder),
        Ok(_) => Err(SinkError::NotAFolder { path, folder }),
        Err(error) => Err(match error.kind() {
            io::ErrorKind::NotFound => SinkError::NoFolder { path, folder },
            io::ErrorKind::NotADirectory => SinkError::NotAFolder { path, folder },
            _ => SinkError::Io { path, error },
        }),
    }
}
