//! A grid of height samples, row 0 north, and its reader for 8- and 16-bit PNG.

use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::Path;

use image::codecs::png::PngDecoder;
use image::error::ImageError;
use image::{ColorType, ImageDecoder, Limits};
use thiserror::Error;

/// A map has at most this many nodes in each direction.
pub const MAX_SIDE: u32 = 16384;

/// A map has at most this many nodes.
pub const MAX_NODES: u64 = 1 << 26;

/// Two bytes a node and some more: PNG stores what it cannot compress almost as it is.
const MAX_FILE_BYTES: u64 = 2 * MAX_NODES + (16 << 20);

/// What the decoder may allocate beside the samples: a few rows, text and profiles.
const DECODER_BYTES: u64 = 64 << 20;

/// Deflate makes at most 1032 bytes out of one, so a larger claim cannot be true.
const DEFLATE_RATIO: u64 = 1032;

/// The last chunk of every PNG file.
const END_CHUNK: [u8; 12] = *b"\0\0\0\0IEND\xAE\x42\x60\x82";

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
        Self { columns, rows, samples, range }
    }

    /// Reads an 8- or 16-bit greyscale PNG file.
    ///
    /// # Errors
    /// If the file is missing, is no such PNG, is cut short, or claims more than [`MAX_SIDE`]
    /// nodes in one direction or [`MAX_NODES`] in all. There is no partial map.
    pub fn read(path: &Path) -> Result<Self, MapError> {
        let name = path.display().to_string();
        let bytes = read_limited(path, MAX_FILE_BYTES).map_err(|error| {
            let remedy = match error.kind() {
                io::ErrorKind::NotFound => {
                    "check the name; a relative path starts at the folder of the scene file, and \
                     builtin:jacksboro is always there"
                }
                _ => "give a greyscale PNG file that can be read",
            };
            MapError::new(&name, file_reason(&error), remedy)
        })?;
        Self::from_png(&bytes, &name)
    }

    /// Decodes an 8- or 16-bit greyscale PNG held in memory; `name` is what messages call it.
    ///
    /// # Errors
    /// As [`HeightMap::read`], but for the file itself.
    pub fn from_png(bytes: &[u8], name: &str) -> Result<Self, MapError> {
        let decode_error = |error: ImageError| decode_error(name, bytes, &error);
        // The decoder checks the sides as soon as it has the header, before any allocation.
        let mut limits = Limits::no_limits();
        limits.max_image_width = Some(MAX_SIDE);
        limits.max_image_height = Some(MAX_SIDE);
        limits.max_alloc = Some(DECODER_BYTES);
        let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(decode_error)?;

        let (columns, rows) = decoder.dimensions();
        if u64::from(columns) * u64::from(rows) > MAX_NODES {
            return Err(too_large(name, &format!("the header claims {columns} x {rows} nodes")));
        }
        let color = decoder.color_type();
        refuse_color(name, bytes, color)?;
        // A file that claims more than it can hold is refused before its claim is allocated.
        let honest = (bytes.len() as u64).saturating_mul(DEFLATE_RATIO);
        if decoder.total_bytes() > honest || !ends(bytes) {
            return Err(cut_short(name));
        }
        let length = usize::try_from(decoder.total_bytes())
            .map_err(|_| too_large(name, "the map does not fit into memory"))?;
        let mut raw = vec![0; length];
        decoder.read_image(&mut raw).map_err(decode_error)?;
        let samples = if color == ColorType::L16 {
            let (pairs, _) = raw.as_chunks::<2>();
            pairs.iter().map(|&pair| f32::from(u16::from_ne_bytes(pair))).collect()
        } else {
            raw.iter().map(|&byte| f32::from(byte)).collect()
        };
        Ok(Self::new(columns as usize, rows as usize, samples))
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
        self.samples.iter().filter(|sample| sample.is_nan()).count()
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

/// Whether the last chunk is there. Something may follow it, as some programs append their own.
fn ends(bytes: &[u8]) -> bool {
    bytes.windows(END_CHUNK.len()).rev().any(|window| window == END_CHUNK)
}

/// Heights have one sample a node, and its bits are its value.
fn refuse_color(name: &str, bytes: &[u8], color: ColorType) -> Result<(), MapError> {
    // The decoder spreads 1-, 2- and 4-bit grey over 0..=255 and palettes over RGB; what the
    // file held stands at bytes 24 and 25, at the same place in every PNG.
    let depth = bytes.get(24).copied().unwrap_or(0);
    let palette = bytes.get(25) == Some(&3);
    let found = match color {
        _ if palette => "it is a palette PNG, whose values are places in a list of colours",
        ColorType::L8 if depth < 8 => "it has fewer than 8 bits a sample",
        ColorType::L8 | ColorType::L16 => return Ok(()),
        ColorType::La8 | ColorType::La16 => "it has transparency",
        _ => "it is a colour PNG",
    };
    Err(MapError::new(
        name,
        found,
        "heights need a greyscale PNG of 8 or 16 bits without transparency: convert it",
    ))
}

fn too_large(name: &str, reason: &str) -> MapError {
    MapError::new(
        name,
        reason,
        format!("crop or thin the map to at most {MAX_SIDE} nodes a side and {MAX_NODES} in all"),
    )
}

fn cut_short(name: &str) -> MapError {
    MapError::new(
        name,
        "the PNG is cut short: it ends before its last sample",
        "copy or download the file again",
    )
}

fn decode_error(name: &str, bytes: &[u8], error: &ImageError) -> MapError {
    const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";
    if matches!(error, ImageError::Limits(_)) {
        let reason = match (be_u32(bytes, 16), be_u32(bytes, 20)) {
            (Some(columns), Some(rows)) => format!("the header claims {columns} x {rows} nodes"),
            _ => "the header claims too many nodes".to_owned(),
        };
        return too_large(name, &reason);
    }
    if bytes.is_empty() {
        return MapError::new(name, "the file is empty", "give a greyscale PNG file");
    }
    if !bytes.starts_with(&SIGNATURE[..bytes.len().min(8)]) {
        return MapError::new(
            name,
            "this is not a PNG file, whatever its name says",
            "give an 8- or 16-bit greyscale PNG file",
        );
    }
    if !ends(bytes) {
        return cut_short(name);
    }
    MapError::new(
        name,
        format!("the PNG is damaged: {}", one_line(&error.to_string())),
        "write or download the file again",
    )
}

fn be_u32(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at + 4)?;
    Some(u32::from_be_bytes(four.try_into().ok()?))
}

/// A message of a library, with its line breaks taken out.
pub(super) fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}
