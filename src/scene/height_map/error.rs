//! What maps may be, and the message for those that are not.

use std::path::Path;

use thiserror::Error;

use crate::scene::shown::quote;

/// A map has at most this many nodes in each direction.
pub const MAX_SIDE: u32 = 16384;

/// A map has at most this many nodes.
pub const MAX_NODES: u64 = 1 << 26;

/// Deflate makes at most 1032 bytes out of one, so a larger claim cannot be true.
pub(super) const DEFLATE_RATIO: u64 = 1032;

/// Why a height map cannot be used. Its `Display` is one line that starts with the file.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{file}: {reason}; {remedy}")]
pub struct MapError {
    /// Path of the map, or `builtin:NAME`.
    pub file: String,
    /// What is wrong with the file.
    pub reason: String,
    /// What the user can do about it.
    pub remedy: String,
}

impl MapError {
    pub(in crate::scene) fn new(
        file: &str,
        reason: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self { file: file.to_owned(), reason: reason.into(), remedy: remedy.into() }
    }
}

/// A header that claims more nodes than this in one direction is not believed.
const LARGEST_CLAIM: u64 = 1 << 20;

/// Nor one that claims more in all: the largest grids of the whole Earth have fewer.
const MOST_CLAIMED: u64 = 1 << 32;

/// Refuses a map of no nodes, and claims that no file can keep.
pub(super) fn check_sides(name: &str, columns: u64, rows: u64) -> Result<(), MapError> {
    if columns == 0 || rows == 0 {
        return Err(MapError::new(
            name,
            format!("the header claims {columns} x {rows} nodes"),
            "give a file that holds a map",
        ));
    }
    if columns.max(rows) > LARGEST_CLAIM || columns * rows > MOST_CLAIMED {
        return Err(too_large(name, &format!("the header claims {columns} x {rows} nodes")));
    }
    Ok(())
}

/// Refuses more nodes than a map may have, and no nodes at all.
pub(super) fn check_size(name: &str, columns: u64, rows: u64) -> Result<(), MapError> {
    check_sides(name, columns, rows)?;
    if columns.max(rows) > u64::from(MAX_SIDE) || columns * rows > MAX_NODES {
        return Err(too_large(name, &format!("the header claims {columns} x {rows} nodes")));
    }
    Ok(())
}

/// The least n for which every n-th of every n-th row makes a map of so many nodes at most.
pub(super) fn least_thinning(columns: u64, rows: u64, nodes: u64) -> u64 {
    let fits = |every: &u64| {
        let (columns, rows) = (columns.div_ceil(*every), rows.div_ceil(*every));
        columns.max(rows) <= u64::from(MAX_SIDE) && columns * rows <= nodes.max(1)
    };
    // One node is left at last.
    (1..=columns.max(rows)).find(fits).unwrap_or(1)
}

/// The message for more nodes than a map may have.
pub(super) fn too_large(name: &str, reason: &str) -> MapError {
    MapError::new(
        name,
        reason,
        format!(
            "a map has at most {MAX_SIDE} nodes a side and {MAX_NODES} in all; {} halves its sides",
            gdal("gdal_translate -outsize 50% 50% -r average", name)
        ),
    )
}

/// A command that makes a GeoTIFF of a file: `command IN OUT.tif`.
pub(super) fn gdal(command: &str, name: &str) -> String {
    // GDAL's own names for files inside others.
    let (outer, inner) = name.rsplit_once(".zip:").unwrap_or(("", name));
    let file = match name.split_once(".gz:") {
        Some((packed, _)) => format!("/vsigzip/{packed}.gz"),
        None if outer.is_empty() => name.to_owned(),
        None => format!("/vsizip/{outer}.zip/{inner}"),
    };
    let inner = inner.rsplit_once(".gz:").map_or(inner, |(_, inner)| inner);
    let stem = Path::new(inner).file_stem().unwrap_or_default().to_string_lossy();
    format!("{command} {} {}", quote(&file), quote(&format!("{stem}-new.tif")))
}
