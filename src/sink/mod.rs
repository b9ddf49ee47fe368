//! Where frames go, and how they come back for a comparison.
//!
//! A file is written whole or not at all: everything goes to a temporary file in the folder of
//! the target, which takes the target's name when the last byte is written.

pub mod folder;
pub mod npy;
pub mod npz;
pub mod picture;
pub mod png;
pub mod vectors;

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use thiserror::Error;

/// Why a file could not be written. The message names the file, the reason and the remedy.
#[derive(Debug, Error)]
pub enum SinkError {
    /// The folder of the target does not exist.
    #[error("cannot write {path}: there is no folder {folder}; create it or choose another path")]
    NoFolder {
        /// The file that was to be written.
        path: PathBuf,
        /// The folder that is missing.
        folder: PathBuf,
    },
    /// What should be the folder of the target is something else.
    #[error("cannot write {path}: {folder} is not a folder; choose another path")]
    NotAFolder {
        /// The file that was to be written.
        path: PathBuf,
        /// What stands in the place of its folder.
        folder: PathBuf,
    },
    /// The target is a folder, or has no file name.
    #[error("cannot write {path:?}: this is a folder; add a file name to it")]
    IsFolder {
        /// The file that was to be written.
        path: PathBuf,
    },
    /// The target exists and is read-only.
    #[error("cannot write {path}: the file is read-only; make it writable or choose another path")]
    ReadOnly {
        /// The file that was to be written.
        path: PathBuf,
    },
    /// A folder is to be made where something is.
    #[error("cannot write {path}: it exists already; remove it or choose another name")]
    Occupied {
        /// The folder that was to be made.
        path: PathBuf,
    },
    /// The operating system or the encoder refused.
    #[error("cannot write {path}: {error}; {}", remedy(error))]
    Io {
        /// The file that was to be written.
        path: PathBuf,
        /// What the system said.
        error: io::Error,
    },
    /// An array has not as many values as the frame has pixels.
    #[error(
        "cannot write {path}: `{array}` has {found} values for {columns} x {lines} pixels; \
         this is a fault of the program, please report it"
    )]
    Shape {
        /// The file that was to be written.
        path: PathBuf,
        /// Name of the array.
        array: &'static str,
        /// Pixels across.
        columns: usize,
        /// Scan lines.
        lines: usize,
        /// Number of values, one per pixel expected.
        found: usize,
    },
}

/// Why a file could not be read. The message names the file, the reason and the remedy.
#[derive(Debug, Error)]
#[error("cannot read {path}: {reason}; {remedy}")]
pub struct ReadError {
    /// The file that cannot be read.
    pub path: PathBuf,
    /// What is wrong with it.
    pub reason: String,
    /// What to do about it.
    pub remedy: &'static str,
}

impl ReadError {
    pub(crate) fn new(path: &Path, reason: impl ToString, remedy: &'static str) -> Self {
        Self { path: path.to_owned(), reason: reason.to_string(), remedy }
    }

    /// A file that could not be opened.
    pub(crate) fn open(path: &Path, error: &io::Error) -> Self {
        Self::new(path, error, "check the path and the permissions of the file")
    }
}

/// Advice for an error of the operating system.
fn remedy(error: &io::Error) -> &'static str {
    match error.kind() {
        ErrorKind::PermissionDenied => "make its folder writable or choose another path",
        ErrorKind::ReadOnlyFilesystem => "choose a path on another file system",
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "free some space or choose another path"
        }
        ErrorKind::InvalidFilename => "choose another file name",
        _ => "choose another path",
    }
}

/// Checks that `path` can be written, without leaving anything behind: for commands that work
/// for a long time before they write.
///
/// # Errors
/// As [`write_atomically`].
#[cfg(any(feature = "cli", feature = "parts"))]
pub fn check_writable(path: &Path) -> Result<(), SinkError> {
    match Target::resolve(path)? {
        Target::Direct => Ok(()),
        Target::Replace { folder, .. } => match Temporary::create(&folder) {
            Ok(_dropped) => Ok(()),
            Err(error) => Err(SinkError::Io { path: path.to_owned(), error }),
        },
    }
}

/// Writes a file whole or not at all.
///
/// `write` fills a temporary file in the folder of `path`, which then replaces `path` (the file
/// behind it, where `path` is a symbolic link). When `write` fails, the temporary file is removed
/// and what was at `path` stays. A `path` that exists and is no regular file, such as a device,
/// is written directly.
///
/// # Errors
/// [`SinkError`] when the folder is missing or not writable, when `path` is a folder or
/// read-only, or when `write` fails; never [`SinkError::Shape`].
pub fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), SinkError> {
    let target = Target::resolve(path)?;
    let done = match target {
        Target::Direct => OpenOptions::new().write(true).open(path).and_then(|file| {
            let mut out = BufWriter::new(file);
            write(&mut out)?;
            out.flush()
        }),
        Target::Replace { file, folder, permissions } => {
            replace(&file, &folder, permissions, write)
        }
    };
    done.map_err(|error| SinkError::Io { path: path.to_owned(), error })
}

/// Fills a temporary file and renames it to `target`.
fn replace(
    target: &Path,
    folder: &Path,
    permissions: Option<fs::Permissions>,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    let (mut temporary, file) = Temporary::create(folder)?;
    let mut out = BufWriter::new(file);
    write(&mut out)?;
    let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
    if let Some(permissions) = permissions {
        file.set_permissions(permissions)?;
    }
    drop(file);
    fs::rename(&temporary.path, target)?;
    temporary.renamed = true;
    Ok(())
}

/// How a path is to be written.
enum Target {
    /// A device or a pipe.
    Direct,
    /// A regular file, existing or not.
    Replace {
        /// The file behind symbolic links.
        file: PathBuf,
        folder: PathBuf,
        /// Those of the file that exists already.
        permissions: Option<fs::Permissions>,
    },
}

impl Target {
    fn resolve(path: &Path) -> Result<Self, SinkError> {
        let io = |error| SinkError::Io { path: path.to_owned(), error };
        let text = path.to_string_lossy();
        if path.file_name().is_none() || text.ends_with(std::path::is_separator) {
            return Err(SinkError::IsFolder { path: path.to_owned() });
        }
        let (file, permissions) = match fs::metadata(path) {
            Ok(there) if there.is_dir() => {
                return Err(SinkError::IsFolder { path: path.to_owned() });
            }
            Ok(there) if !there.is_file() => return Ok(Self::Direct),
            Ok(there) if there.permissions().readonly() => {
                return Err(SinkError::ReadOnly { path: path.to_owned() });
            }
            Ok(there) => (fs::canonicalize(path).map_err(io)?, Some(there.permissions())),
            // Nothing there, or no way there: the folder tells.
            Err(_) => (path.to_owned(), None),
        };
        let folder = match file.parent() {
            Some(folder) if folder != Path::new("") => folder.to_owned(),
            _ => PathBuf::from("."),
        };
        let path = path.to_owned();
        match fs::metadata(&folder) {
            Ok(there) if there.is_dir() => Ok(Self::Replace { file, folder, permissions }),
            Ok(_) => Err(SinkError::NotAFolder { path, folder }),
            Err(error) => Err(match error.kind() {
                ErrorKind::NotFound => SinkError::NoFolder { path, folder },
                ErrorKind::NotADirectory => SinkError::NotAFolder { path, folder },
                _ => SinkError::Io { path, error },
            }),
        }
    }
}

/// A temporary file that is removed unless it has been renamed.
struct Temporary {
    path: PathBuf,
    renamed: bool,
}

impl Temporary {
    fn create(folder: &Path) -> io::Result<(Self, File)> {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        loop {
            let number = NEXT.fetch_add(1, Ordering::Relaxed);
            let path = folder.join(format!(".terraline-{}-{number}.part", std::process::id()));
            match OpenOptions::new().write(true).create_new(true).open(&path) {
                Ok(file) => return Ok((Self { path, renamed: false }, file)),
                // Left behind by a process that was killed.
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if !self.renamed {
            // Nothing can be done about a failure here; the first error is the one to report.
            let _ = fs::remove_file(&self.path);
        }
    }
}
