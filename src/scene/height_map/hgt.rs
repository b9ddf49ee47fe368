//! SRTM `.hgt`: a square of big-endian 16-bit heights in metres, one degree wide, corner nodes
//! included; also inside a `.zip`.

use std::io::{Cursor, Read};

use glam::DVec2;
use zip::ZipArchive;

use super::error::{DEFLATE_RATIO, MAX_NODES, MapError, check_size};
use super::found::{Found, HeightFile, Storage};
use super::georeference::{Coordinates, Georeference, PixelIs};
use crate::scene::shown::one_line;

/// What marks a node without data.
const VOID: i16 = i16::MIN;

/// A zip file of one tile has few entries; a directory of more is not walked.
const MAX_ENTRIES: usize = 1000;

/// The square root of a length in samples, if there is one.
fn side(bytes: usize) -> Option<usize> {
    let samples = bytes / 2;
    let side = samples.isqrt();
    (bytes.is_multiple_of(2) && side > 1 && side * side == samples).then_some(side)
}

/// Whether a file of this length may be taken for a tile without its name saying so.
pub(super) fn usual_size(bytes: usize) -> bool {
    matches!(side(bytes), Some(1201 | 3601))
}

/// Decodes a tile; the name gives its place.
pub(super) fn decode(bytes: &[u8], name: &str) -> Result<HeightFile, MapError> {
    let Some(side) = side(bytes.len()) else {
        return Err(MapError::new(
            name,
            format!("{} bytes are not a square of 16-bit heights", bytes.len()),
            "download the tile again: 1201 x 1201 heights are 2884802 bytes, 3601 x 3601 are \
             25934402",
        ));
    };
    check_size(name, side as u64, side as u64)?;
    let (pairs, _) = bytes.as_chunks::<2>();
    let samples = pairs
        .iter()
        .map(|&pair| match i16::from_be_bytes(pair) {
            VOID => f32::NAN,
            height => f32::from(height),
        })
        .collect();
    let cell = 1.0 / (side as f64 - 1.0);
    let mut notes = Vec::new();
    let origin = corner(name).map(|corner| corner + DVec2::new(0.0, 1.0));
    if origin.is_none() {
        notes.push(
            "the name is not that of a tile, as in N36W085.hgt, so the place is not known: cells \
             are taken as on the equator"
                .to_owned(),
        );
    }
    if !matches!(side, 1201 | 3601) {
        notes.push(format!(
            "{side} x {side} is no usual size; the tile is taken as one degree wide"
        ));
    }
    let georeference = Georeference {
        coordinates: Coordinates::Degrees,
        epsg: Some(4326),
        citation: Some("WGS 84".to_owned()),
        // Without a name, the middle of the tile is put on the equator.
        origin: Some(origin.unwrap_or(DVec2::new(0.0, 0.5))),
        cell: Some(DVec2::splat(cell)),
        height_unit_m: Some(1.0),
        pixel_is: Some(PixelIs::Point),
    };
    let storage = Storage {
        format: "SRTM HGT",
        sample: "int16",
        compression: None,
        layout: None,
        byte_order: Some("big-endian"),
    };
    Found { columns: side, rows: side, samples, storage, georeference }.finish(
        name,
        Some(f64::from(VOID)),
        notes,
    )
}

/// The south-west corner (east, north) in degrees that a tile is named after.
fn corner(name: &str) -> Option<DVec2> {
    let file = name.rsplit(['/', '\\', ':']).next()?;
    let tile = file.as_bytes().get(..7)?.to_ascii_uppercase();
    let degrees = |digits: &[u8]| -> Option<f64> {
        digits.iter().try_fold(0.0, |sum, digit| {
            digit.is_ascii_digit().then(|| sum * 10.0 + f64::from(digit - b'0'))
        })
    };
    // What follows the name is an ending or another name, never more digits.
    if file.as_bytes().get(7).is_some_and(u8::is_ascii_alphanumeric) {
        return None;
    }
    let (north, east) = (degrees(&tile[1..3])?, degrees(&tile[4..7])?);
    let north = match tile[0] {
        b'N' => north,
        b'S' => -north,
        _ => return None,
    };
    let east = match tile[3] {
        b'E' => east,
        b'W' => -east,
        _ => return None,
    };
    ((-90.0..90.0).contains(&north) && east.abs() <= 180.0).then_some(DVec2::new(east, north))
}

/// Decodes the one tile of a zip file.
pub(super) fn unzip(bytes: &[u8], name: &str) -> Result<HeightFile, MapError> {
    let damaged = |reason: &str| {
        MapError::new(
            name,
            format!("the zip file is damaged: {}", one_line(reason)),
            "download the file again",
        )
    };
    let mut archive =
        ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error.to_string()))?;
    if archive.len() > MAX_ENTRIES {
        return Err(MapError::new(
            name,
            format!("the zip file has {} entries", archive.len()),
            "unpack it and give the height file itself",
        ));
    }
    let tiles: Vec<String> = archive
        .file_names()
        .filter_map(|entry| entry.ok().map(|entry| entry.into_owned()))
        .filter(|entry| entry.to_lowercase().ends_with(".hgt"))
        .collect();
    let [tile] = tiles.as_slice() else {
        return Err(MapError::new(
            name,
            match tiles.len() {
                0 => "the zip file holds no .hgt file".to_owned(),
                count => format!("the zip file holds {count} .hgt files"),
            },
            "unpack it and give a height file",
        ));
    };
    let entry = archive.by_name(tile).map_err(|error| damaged(&error.to_string()))?;
    let limit = 2 * MAX_NODES;
    // What an entry claims to unpack to is checked against what its bytes can hold.
    let honest = (bytes.len() as u64).saturating_mul(DEFLATE_RATIO);
    if entry.size() > limit || entry.size() > honest {
        return Err(MapError::new(
            name,
            format!("its entry claims to unpack to {} bytes", entry.size()),
            "download the file again: a tile of 3601 x 3601 heights has 25934402",
        ));
    }
    let size = entry.size();
    let mut unpacked = Vec::with_capacity(size as usize);
    entry.take(size + 1).read_to_end(&mut unpacked).map_err(|error| damaged(&error.to_string()))?;
    if unpacked.len() as u64 != size {
        return Err(damaged("its entry is not as long as it claims"));
    }
    let mut file = decode(&unpacked, &format!("{name}:{tile}"))?;
    file.storage.format = "SRTM HGT in ZIP";
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_are_named_after_their_corners() {
        assert_eq!(corner("N36W085.hgt"), Some(DVec2::new(-85.0, 36.0)));
        assert_eq!(corner("some/s01e010.HGT"), Some(DVec2::new(10.0, -1.0)));
        assert_eq!(corner("x.zip:d/N53E028.SRTMGL1.hgt"), Some(DVec2::new(28.0, 53.0)));
        for name in ["", "N36", "tile.hgt", "N3AW085.hgt", "N36X085.hgt", "N36W0851.hgt"] {
            assert_eq!(corner(name), None, "{name}");
        }
        assert_eq!(corner("N91E000.hgt"), None);
        assert_eq!(corner("N36W085ä.hgt"), Some(DVec2::new(-85.0, 36.0)));
    }
}
