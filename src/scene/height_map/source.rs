//! A height file of any format: which format it is, and what is known beside the samples.

use std::path::Path;

use super::encoding::Encoding;
use super::error::{MAX_NODES, MapError, gdal};
use super::file::{file_reason, read_limited};
use super::found::HeightFile;
use super::interpretation::Interpretation;
use super::map::HeightMap;
use super::{archive, ascii, geotiff, hgt, png};
use crate::scene::shown::shown_path;

/// The largest file worth reading: text needs some twenty bytes a node, `float64` eight.
const MAX_FILE_BYTES: u64 = 24 * MAX_NODES;

impl HeightMap {
    /// Reads a height file of any format, samples as stored, and leaves its georeference aside.
    ///
    /// # Errors
    /// As [`read`].
    pub fn read(path: &Path) -> Result<Self, MapError> {
        read(path, &Interpretation::default()).map(|file| file.map)
    }

    /// Decodes an 8- or 16-bit greyscale PNG held in memory; `name` is what messages call it.
    ///
    /// # Errors
    /// If it is no such PNG, is cut short, or claims more than [`super::MAX_SIDE`] nodes in one direction
    /// or [`MAX_NODES`] in all. There is no partial map.
    pub fn from_png(bytes: &[u8], name: &str) -> Result<Self, MapError> {
        png::decode(bytes, name, &Interpretation::default()).map(|file| file.map)
    }
}

/// Formats told apart by their first bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Tiff,
    Zip,
    Gzip,
    Ascii,
    Hgt,
}

fn format(bytes: &[u8], name: &str) -> Option<Format> {
    let begins = |magic: &[u8]| bytes.starts_with(magic);
    if begins(b"\x89PNG") {
        Some(Format::Png)
    } else if geotiff::MAGIC.iter().any(|magic| begins(magic)) {
        Some(Format::Tiff)
    } else if begins(b"PK\x03\x04") || begins(b"PK\x07\x08PK\x03\x04") {
        Some(Format::Zip)
    } else if begins(b"\x1f\x8b") {
        Some(Format::Gzip)
    } else if ascii::begins(bytes) {
        Some(Format::Ascii)
    } else if has_ending(name, "hgt") || hgt::usual_size(bytes.len()) {
        Some(Format::Hgt)
    } else {
        None
    }
}

/// Whether the name ends so, in capitals or not.
fn has_ending(name: &str, ending: &str) -> bool {
    Path::new(name).extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

/// Whether a path is a height file by its ending, or else by the first bytes of the file.
///
/// A file that cannot be opened is judged by its ending alone.
pub fn is_height_file(path: &Path) -> bool {
    use std::io::Read as _;
    const ENDINGS: [&str; 9] = ["tif", "tiff", "gtiff", "hgt", "zip", "gz", "asc", "png", "dem"];
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if ENDINGS.contains(&ending.as_str()) {
        return true;
    }
    // A pipe or a device is never opened: it may not answer.
    if ending == "toml" || !path.is_file() {
        return false;
    }
    let mut head = Vec::new();
    let read = std::fs::File::open(path).and_then(|file| file.take(64).read_to_end(&mut head));
    read.is_ok() && format(&head, "").is_some()
}

/// Reads a height file as the user says; the first bytes decide which format it is, not its name.
///
/// # Errors
/// If the file is missing, is of none of the formats, is damaged or cut short, claims more nodes
/// than [`super::MAX_SIDE`] in one direction, than [`MAX_NODES`] in all or than it can hold, or
/// has no data at all. There is no partial map.
pub fn read(path: &Path, asked: &Interpretation) -> Result<HeightFile, MapError> {
    let name = shown_path(path);
    let bytes = read_limited(path, MAX_FILE_BYTES).map_err(|error| {
        let remedy = match error.kind() {
            std::io::ErrorKind::NotFound => {
                "check the name; a relative path starts at the folder of the scene file, and \
                 builtin:jacksboro is always there"
            }
            _ => "give a height file that can be read",
        };
        MapError::new(&name, file_reason(&error), remedy)
    })?;
    decode(&bytes, &name, asked)
}

/// Decodes a height file held in memory; `name` is what messages call it, and what an `.hgt` file
/// has its place from.
///
/// # Errors
/// As [`read`], but for the file itself.
pub fn decode(bytes: &[u8], name: &str, asked: &Interpretation) -> Result<HeightFile, MapError> {
    let found = format(bytes, name);
    let unpacked = match found {
        Some(Format::Zip) => archive::unzip(bytes, name, MAX_FILE_BYTES)?,
        Some(Format::Gzip) => archive::gunzip(bytes, name, MAX_FILE_BYTES)?,
        _ => return decode_plain(found, bytes, name, asked),
    };
    // A file in a file is plain: what is packed twice is no height file.
    let inner = format(&unpacked.bytes, &unpacked.name);
    let mut file = decode_plain(inner, &unpacked.bytes, &unpacked.name, asked)?;
    file.storage.packed = Some(if found == Some(Format::Zip) { "zip" } else { "gzip" });
    Ok(file)
}

fn decode_plain(
    format: Option<Format>,
    bytes: &[u8],
    name: &str,
    asked: &Interpretation,
) -> Result<HeightFile, MapError> {
    if asked.encoding != Encoding::Stored && format != Some(Format::Png) {
        return Err(MapError::new(
            name,
            format!(
                "heights packed as \"{}\" are kept in PNG files, and this is none",
                asked.encoding.name()
            ),
            "leave the encoding out",
        ));
    }
    match format {
        Some(Format::Png) => png::decode(bytes, name, asked),
        Some(Format::Tiff) => geotiff::decode(bytes, name, asked),
        Some(Format::Ascii) => ascii::decode(bytes, name, asked),
        Some(Format::Hgt) => hgt::decode(bytes, name, asked),
        Some(Format::Zip | Format::Gzip) | None => Err(unknown(bytes, name)),
    }
}

/// The message for a file of no known format, with a guess at what it is.
fn unknown(bytes: &[u8], name: &str) -> MapError {
    const FORMATS: &str = "give a greyscale PNG, a GeoTIFF, an SRTM .hgt or an ESRI ASCII grid, also in a .zip or .gz";
    let convert = format!("convert it: {}", gdal("gdal_translate", name));
    let (reason, remedy) = if bytes.is_empty() {
        ("the file is empty", FORMATS.to_owned())
    } else if bytes.starts_with(b"PK\x05\x06") {
        ("this is a zip file without any file in it", FORMATS.to_owned())
    } else if bytes.starts_with(b"\x1f\x8b") || bytes.starts_with(b"PK\x03\x04") {
        ("this is a packed file in a packed file", format!("unpack it and {FORMATS}"))
    } else if bytes.starts_with(b"\xff\xd8\xff") {
        ("this is a JPEG picture, which holds no heights", FORMATS.to_owned())
    } else if bytes.starts_with(b"\x89HDF") {
        ("this is an HDF5 or netCDF file", convert)
    } else if bytes.starts_with(b"CDF") {
        ("this is a netCDF file", convert)
    } else if has_ending(name, "dem") {
        ("this looks like a USGS DEM", convert)
    } else if has_ending(name, "png") {
        ("this is not a PNG file, whatever its name says", FORMATS.to_owned())
    } else if has_ending(name, "tif") || has_ending(name, "tiff") {
        ("this is not a TIFF file, whatever its name says", FORMATS.to_owned())
    } else if has_ending(name, "asc") {
        ("this does not begin as an ESRI ASCII grid does, with ncols", FORMATS.to_owned())
    } else {
        ("this is a file of no known format", FORMATS.to_owned())
    };
    MapError::new(name, reason, remedy)
}
