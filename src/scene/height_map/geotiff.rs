//! GeoTIFF: one band of integers or floats with its georeference.
//!
//! What the file claims is compared with the file before anything is allocated for it
//! ([`directory`], [`image`]); strips and tiles are unpacked row by row ([`unpack`]). The decoder
//! of the `tiff` crate (0.11.3) is not used: it refuses LZW tiles that are sound (its issue 395),
//! and takes memory for whatever a directory claims before limits can be set.

mod directory;
mod image;
mod keys;
mod samples;
mod unpack;

use super::error::MapError;
use super::found::{Found, HeightFile, Storage};
use crate::scene::shown::{one_line, shown};
use directory::{Directory, Tiff, tag};
use image::Image;

/// What a TIFF or BigTIFF file begins with, in either byte order.
pub(super) const MAGIC: [&[u8]; 4] = [b"II\x2A\0", b"MM\0\x2A", b"II\x2B\0", b"MM\0\x2B"];

/// Decodes a GeoTIFF file.
pub(super) fn decode(bytes: &[u8], name: &str) -> Result<HeightFile, MapError> {
    let damaged = |reason: String| {
        MapError::new(
            name,
            format!("the TIFF cannot be used: {}", one_line(&reason)),
            "download or write the file again; gdal_translate IN OUT.tif rewrites what it can read",
        )
    };
    let tiff = Tiff::new(bytes);
    let directories = tiff.directories().map_err(damaged)?;
    let mut notes = Vec::new();
    let chosen = choose(&tiff, &directories, &mut notes).map_err(damaged)?;
    let image = Image::read(&tiff, chosen, name, bytes.len())?;
    let (georeference, south_up) = keys::read(&tiff, chosen, name, &image, &mut notes)?;
    let nodata = nodata(&tiff, chosen, &image, &mut notes).map_err(damaged)?;
    metadata(&tiff, chosen, &mut notes);
    let storage = Storage {
        format: if tiff.big { "BigTIFF" } else { "GeoTIFF" },
        sample: image.sample.name(),
        compression: Some(image.compression_name()),
        layout: Some(image.layout_name()),
        byte_order: Some(if tiff.big_endian { "big-endian" } else { "little-endian" }),
    };
    let samples = samples::read(bytes, &image, nodata, south_up, &mut notes).map_err(damaged)?;
    Found { columns: image.columns, rows: image.rows, samples, storage, georeference }
        .finish(name, nodata, notes)
}

/// The first image of full resolution that is no mask; the others are reported.
fn choose<'a>(
    tiff: &Tiff<'_>,
    directories: &'a [Directory],
    notes: &mut Vec<String>,
) -> Result<&'a Directory, String> {
    const REDUCED: u64 = 1;
    const MASK: u64 = 4;
    let mut kinds = Vec::with_capacity(directories.len());
    for directory in directories {
        kinds.push(tiff.one(directory, tag::SUBFILE_TYPE, 0)?);
    }
    let first = directories.first().ok_or("it holds no image")?;
    let chosen = kinds.iter().position(|kind| kind & (REDUCED | MASK) == 0).unwrap_or(0);
    let count = |test: &dyn Fn(u64) -> bool| {
        kinds.iter().enumerate().filter(|&(index, &kind)| index != chosen && test(kind)).count()
    };
    for (found, what) in [
        (count(&|kind| kind & MASK != 0), "mask image"),
        (count(&|kind| kind & (REDUCED | MASK) == REDUCED), "overview of lower resolution"),
        (count(&|kind| kind & (REDUCED | MASK) == 0), "further image"),
    ] {
        if found > 0 {
            notes.push(format!("left out: {found} x {what}"));
        }
    }
    Ok(directories.get(chosen).unwrap_or(first))
}

/// The declared mark of nodes without data.
fn nodata(
    tiff: &Tiff<'_>,
    directory: &Directory,
    image: &Image,
    notes: &mut Vec<String>,
) -> Result<Option<f64>, String> {
    let Some(text) = tiff.text(directory, tag::GDAL_NODATA)? else { return Ok(None) };
    let text = String::from_utf8_lossy(text);
    let text = text.trim();
    let Ok(value) = text.parse::<f64>() else {
        let shown: String = text.chars().take(20).flat_map(char::escape_debug).collect();
        notes.push(format!("left out: the no-data value `{shown}`, which is not a number"));
        return Ok(None);
    };
    if !image.sample.can_be(value) {
        notes.push(format!(
            "the no-data value {} cannot occur among {} samples",
            shown(value),
            image.sample.name()
        ));
    }
    Ok(Some(value))
}

/// What GDAL's own metadata say about the samples, none of which is applied.
fn metadata(tiff: &Tiff<'_>, directory: &Directory, notes: &mut Vec<String>) {
    let Ok(Some(text)) = tiff.text(directory, tag::GDAL_METADATA) else { return };
    let text = String::from_utf8_lossy(text);
    for role in ["scale", "offset"] {
        let after = text.split_once(&format!("role=\"{role}\"")).map(|(_, after)| after);
        let value = after.and_then(|after| after.split_once('>')).map(|(_, value)| value);
        let value = value.and_then(|value| value.split('<').next()).map(str::trim);
        let neutral = if role == "scale" { 1.0 } else { 0.0 };
        if let Some(value) = value.and_then(|value| value.parse::<f64>().ok())
            && value != neutral
        {
            notes.push(format!(
                "left out: the {role} {} of GDAL's metadata; samples are taken as stored, \
                 surface.height can apply it",
                shown(value)
            ));
        }
    }
}
