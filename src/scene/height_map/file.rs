//! Files read whole, and why they cannot be.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The whole of a regular file, unless it is larger than `limit`.
pub(in crate::scene) fn read_limited(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    // A pipe or a device may never end, so it is refused before it is opened.
    let metadata = std::fs::metadata(path)?;
    if !metadata.is_file() {
        let what = if metadata.is_dir() { "is a folder" } else { "is not a regular file" };
        return Err(io::Error::other(what));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        return Err(io::Error::other(format!("is larger than {limit} bytes")));
    }
    Ok(bytes)
}

/// Why a file cannot be read, without the error number of the system.
pub(in crate::scene) fn file_reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "the file may not be read by you".to_owned(),
        _ => format!("the file cannot be read: {error}"),
    }
}
