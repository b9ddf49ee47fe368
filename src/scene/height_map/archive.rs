//! Height files inside others: gzip, and zip files that hold one.

use std::io::{Cursor, Read};
use std::path::Path;

use flate2::bufread::GzDecoder;
use zip::ZipArchive;

use super::error::{DEFLATE_RATIO, MAX_NODES, MapError};
use crate::scene::shown::one_line;

/// A zip file of one map has few entries; a directory of more is not walked.
const MAX_ENTRIES: usize = 1000;

/// What a member of a gzip file begins with.
const GZIP: &[u8] = b"\x1f\x8b";

/// Endings of the height files that are looked for.
const ENDINGS: [&str; 6] = [".hgt", ".tif", ".tiff", ".asc", ".png", ".gtiff"];

/// A file that was unpacked.
pub(super) struct Unpacked {
    pub(super) bytes: Vec<u8>,
    /// Its name, behind that of what it was in.
    pub(super) name: String,
}

/// Unpacks a gzip file.
pub(super) fn gunzip(bytes: &[u8], name: &str, limit: u64) -> Result<Unpacked, MapError> {
    let limit = limit_of(name.trim_end_matches(".gz"), limit);
    let honest = (bytes.len() as u64).saturating_mul(DEFLATE_RATIO).min(limit);
    let mut unpacked = Vec::new();
    let mut rest = bytes;
    // One member after another; what follows the last one, as some programs pad it, is none.
    while rest.starts_with(GZIP) && unpacked.len() as u64 <= honest {
        let left = honest + 1 - unpacked.len() as u64;
        let mut member = GzDecoder::new(rest).take(left);
        member
            .read_to_end(&mut unpacked)
            .map_err(|error| broken(name, "gzip", &error.to_string()))?;
        rest = member.into_inner().into_inner();
    }
    if unpacked.len() as u64 > limit {
        return Err(too_much(name, unpacked.len() as u64));
    }
    let inner = Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
    Ok(Unpacked { bytes: unpacked, name: format!("{name}:{inner}") })
}

/// Unpacks the one height file of a zip file.
pub(super) fn unzip(bytes: &[u8], name: &str, limit: u64) -> Result<Unpacked, MapError> {
    let damaged = |reason: &str| broken(name, "zip", reason);
    let mut archive =
        ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error.to_string()))?;
    if archive.len() > MAX_ENTRIES {
        return Err(MapError::new(
            name,
            format!("the zip file has {} entries", archive.len()),
            "unpack it and give the height file itself",
        ));
    }
    let maps: Vec<String> = archive
        .file_names()
        .filter_map(|entry| entry.ok().map(|entry| entry.into_owned()))
        .filter(|entry| is_map(entry))
        .collect();
    let [map] = maps.as_slice() else {
        return Err(MapError::new(
            name,
            match maps.len() {
                0 => "the zip file holds no height file".to_owned(),
                count => format!("the zip file holds {count} height files"),
            },
            "unpack it and give a height file",
        ));
    };
    let entry = archive.by_name(map).map_err(|error| damaged(&error.to_string()))?;
    let (size, limit) = (entry.size(), limit_of(map, limit));
    // What an entry claims to unpack to is checked against what its bytes can hold.
    let honest = (bytes.len() as u64).saturating_mul(DEFLATE_RATIO);
    if size > limit || size > honest {
        return Err(too_much(name, size));
    }
    let mut unpacked = Vec::with_capacity(size as usize);
    entry.take(size + 1).read_to_end(&mut unpacked).map_err(|error| damaged(&error.to_string()))?;
    if unpacked.len() as u64 != size {
        return Err(damaged("its entry is not as long as it claims"));
    }
    Ok(Unpacked { bytes: unpacked, name: format!("{name}:{map}") })
}

/// Whether an entry is a height file by its name, and no remark of an operating system on one.
fn is_map(entry: &str) -> bool {
    let small = entry.to_lowercase();
    let hidden = small.split(['/', '\\']).any(|part| part == "__macosx" || part.starts_with('.'));
    !hidden && ENDINGS.iter().any(|ending| small.ends_with(ending))
}

/// The most bytes of a file: a tile has two bytes a height.
fn limit_of(name: &str, limit: u64) -> u64 {
    if name.to_lowercase().ends_with(".hgt") { limit.min(2 * MAX_NODES) } else { limit }
}

fn broken(name: &str, kind: &str, reason: &str) -> MapError {
    MapError::new(
        name,
        format!("the {kind} file cannot be unpacked: {}", one_line(reason)),
        "where other programs unpack it, give the height file that is in it",
    )
}

fn too_much(name: &str, size: u64) -> MapError {
    MapError::new(
        name,
        format!("its entry claims to unpack to {size} bytes"),
        "give the height file that is in it",
    )
}
