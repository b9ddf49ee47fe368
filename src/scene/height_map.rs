//! A grid of height samples, row 0 north. [`source`] reads it from files of several formats.

mod ascii;
pub mod georeference;
mod geotiff;
mod hgt;
mod png;
pub mod source;

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use thiserror::Error;

pub use georeference::Georeference;
pub use source::{Encoding, HeightFile};

/// A map has at most this many nodes in each direction.
pub const MAX_SIDE: u32 = 16384;

/// A map has at most this many nodes.
pub const MAX_NODES: u64 = 1 << 26;

/// Deflate makes at most 1032 bytes out of one, so a larger claim cannot be true.
const DEFLATE_RATIO: u64 = 1032;

/// Why a height map cannot be used. Its `Display` is one line that starts with the file.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{file}: {reason}; {remedy}")]
pub struct MapError {
    /// Path of the map, or `builtin:NAME`.
    pub file: String,
    /// Why.
    pub reason: String,
    /// What to do.
    pub remedy: String,
}

impl MapError {
    pub(super) fn new(file: &str, reason: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { file: file.to_owned(), reason: reason.into(), remedy: remedy.into() }
    }
}

/// A grid of height samples as the file holds them.
///
/// Samples are kept as `f32`: exact for every 8- and 16-bit value. A node without data is NaN.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    columns: usize,
    rows: usize,
    /// Row by row, row 0 north.
    samples: Vec<f32>,
    range: (f32, f32),
    voids: usize,
}

impl HeightMap {
    /// A map from its samples, row by row.
    ///
    /// # Panics
    /// If the number of samples is not `columns * rows`, if one is infinite, or if none has data:
    /// the readers have checked that.
    pub fn new(columns: usize, rows: usize, samples: Vec<f32>) -> Self {
        assert!(!samples.is_empty() && samples.len() == columns * rows);
        let range = samples
            .iter()
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &s| (low.min(s), high.max(s)));
        assert!(range.0.is_finite() && range.1.is_finite());
        let voids = samples.iter().filter(|sample| sample.is_nan()).count();
        Self { columns, rows, samples, range, voids }
    }

    /// Reads a height file of any format, samples as stored, and leaves its georeference aside.
    ///
    /// # Errors
    /// As [`source::read`].
    pub fn read(path: &Path) -> Result<Self, MapError> {
        source::read(path, Encoding::Stored).map(|file| file.map)
    }

    /// Decodes an 8- or 16-bit greyscale PNG held in memory; `name` is what messages call it.
    ///
    /// # Errors
    /// If it is no such PNG, is cut short, or claims more than [`MAX_SIDE`] nodes in one direction
    /// or [`MAX_NODES`] in all. There is no partial map.
    pub fn from_png(bytes: &[u8], name: &str) -> Result<Self, MapError> {
        png::decode(bytes, name, Encoding::Stored).map(|file| file.map)
    }

    /// Nodes in x.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Nodes in z.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Sample of node (column i, row j); NaN without data.
    pub fn sample(&self, i: usize, j: usize) -> f32 {
        self.samples[j * self.columns + i]
    }

    /// All samples, row by row; NaN without data.
    pub fn samples(&self) -> &[f32] {
        &self.samples
    }

    /// Nodes without data.
    pub fn voids(&self) -> usize {
        self.voids
    }

    /// Lowest and highest sample of the nodes with data.
    pub fn range(&self) -> (f32, f32) {
        self.range
    }
}

/// The whole of a regular file, unless it is larger than `limit`.
pub(super) fn read_limited(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
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
pub(super) fn file_reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "the file may not be read by you".to_owned(),
        _ => format!("the file cannot be read: {error}"),
    }
}

/// Refuses more nodes than a map may have, and no nodes at all.
fn check_size(name: &str, columns: u64, rows: u64) -> Result<(), MapError> {
    if columns == 0 || rows == 0 {
        return Err(MapError::new(
            name,
            format!("the header claims {columns} x {rows} nodes"),
            "give a file that holds a map",
        ));
    }
    let side = u64::from(MAX_SIDE);
    if columns > side || rows > side || columns * rows > MAX_NODES {
        return Err(too_large(name, &format!("the header claims {columns} x {rows} nodes")));
    }
    Ok(())
}

fn too_large(name: &str, reason: &str) -> MapError {
    MapError::new(
        name,
        reason,
        format!("crop or thin the map to at most {MAX_SIDE} nodes a side and {MAX_NODES} in all"),
    )
}

/// A path on one line.
pub(super) fn shown_path(path: &Path) -> String {
    let path = path.display().to_string();
    let escape = |c: char| if c.is_control() { c.escape_debug().to_string() } else { c.into() };
    if path.contains(char::is_control) { path.chars().map(escape).collect() } else { path }
}

/// A message of a library, with its line breaks taken out.
pub(super) fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}
