//! GeoTIFF: one band of integers or floats with its georeference.
//!
//! What the file claims is compared with the file before anything is allocated for it
//! ([`directory`], [`image`]); strips and tiles are unpacked row by row ([`unpack`]). The decoder
//! of the `tiff` crate (0.11.3) is not used: it refuses LZW tiles that are sound (its issue 395),
//! and takes memory for whatever a directory claims before limits can be set.

mod compression;
mod directory;
mod grid;
mod image;
mod keys;
mod lerc;
mod metadata;
mod predictor;
mod sample;
mod samples;
mod system;
mod unpack;

use super::error::{MapError, gdal};
use super::found::{Found, HeightFile, Storage};
use super::interpretation::Interpretation;
use super::marks::Conversion;
use super::unit;
use crate::scene::shown::{one_line, shorten, shown};
use directory::{Directory, Tiff, tag};
use image::{Image, unusable};
use metadata::Metadata;

/// What a TIFF or BigTIFF file begins with, in either byte order.
pub(super) const MAGIC: [&[u8]; 4] = [b"II\x2A\0", b"MM\0\x2A", b"II\x2B\0", b"MM\0\x2B"];

/// Decodes a GeoTIFF file.
pub(super) fn decode(
    bytes: &[u8],
    name: &str,
    asked: &Interpretation,
) -> Result<HeightFile, MapError> {
    let damaged = |reason: String| unusable(name, &one_line(&reason));
    let tiff = Tiff::new(bytes);
    let directories = tiff.directories().map_err(damaged)?;
    let mut notes = Vec::new();
    let Images { heights, mask } = choose(&tiff, &directories, &mut notes).map_err(damaged)?;
    let image = Image::read(&tiff, heights, name, bytes.len(), &mut notes)?;
    let every = asked.every(name, image.columns as u64, image.rows as u64)?;
    let metadata = metadata::read(&tiff, heights);
    let keys = keys::Keys::read(&tiff, heights).map_err(damaged)?;
    let (mut georeference, factor) =
        system::read(&keys, &metadata, &mut notes).map_err(|reason| {
            MapError::new(
                name,
                format!("its georeference cannot be used: {reason}"),
                format!("project it first: {}", gdal("gdalwarp -t_srs EPSG:4326", name)),
            )
        })?;
    let grid = grid::read(&tiff, heights, name, &image, &mut notes)?;
    let turned_over = grid.is_some_and(|grid| grid.step.y > 0.0);
    if let Some(grid) = grid {
        grid.place(factor, image.rows, &mut georeference);
    }
    let nodata = nodata(&tiff, heights, &image, &mut notes).map_err(damaged)?;
    let conversion = conversion(&image, nodata, asked, &metadata, &mut notes);
    // Blocks that are not stored hold the no-data value, or 0 where none is declared.
    let absent = if nodata.is_some() { f64::NAN } else { 0.0 };
    let mut samples =
        samples::read(bytes, &image, every, &conversion, absent, &mut notes).map_err(damaged)?;
    if let Some(mask) = mask {
        let mask = Image::read(&tiff, mask, name, bytes.len(), &mut Vec::new())?;
        if (mask.columns, mask.rows) == (image.columns, image.rows) {
            samples::mask(bytes, &mask, every, &mut samples).map_err(damaged)?;
            notes.push("nodes are without data where the file's mask says so".to_owned());
        } else {
            notes.push(format!(
                "left out: a mask of {} x {} pixels, which is not the size of the image",
                mask.columns, mask.rows
            ));
        }
    }
    if turned_over {
        turn_over(&mut samples, image.columns.div_ceil(every));
        notes.push("the rows run from south to north: turned over".to_owned());
    }
    let storage = Storage {
        compression: Some(image.compression_name()),
        layout: Some(image.layout_name()),
        byte_order: Some(if tiff.big_endian { "big-endian" } else { "little-endian" }),
        ..Storage::of(if tiff.big { "BigTIFF" } else { "GeoTIFF" }, image.sample.name())
    };
    let (columns, rows) = (image.columns, image.rows);
    Found { columns, rows, samples, storage, georeference, nodata, turned_over, conversion, notes }
        .finish(name, every, asked)
}

/// Swaps the rows end for end.
fn turn_over(samples: &mut [f32], columns: usize) {
    let rows = samples.len() / columns;
    for row in 0..rows / 2 {
        let (north, south) = samples.split_at_mut((rows - 1 - row) * columns);
        north[row * columns..(row + 1) * columns].swap_with_slice(&mut south[..columns]);
    }
}

/// The images of a file that are read.
struct Images<'a> {
    heights: &'a Directory,
    mask: Option<&'a Directory>,
}

/// The first image of full resolution that is no mask, and its mask; the others are reported.
fn choose<'a>(
    tiff: &Tiff<'_>,
    directories: &'a [Directory],
    notes: &mut Vec<String>,
) -> Result<Images<'a>, String> {
    const REDUCED: u64 = 1;
    const MASK: u64 = 4;
    let mut kinds = Vec::with_capacity(directories.len());
    for directory in directories {
        kinds.push(tiff.one(directory, tag::SUBFILE_TYPE, 0)?);
    }
    let first = directories.first().ok_or("it holds no image")?;
    let of_kind = |wanted: u64| kinds.iter().position(|kind| kind & (REDUCED | MASK) == wanted);
    let chosen = of_kind(0).unwrap_or(0);
    let mask = of_kind(MASK).filter(|&mask| mask != chosen);
    let left = |test: &dyn Fn(u64) -> bool| {
        let other = |index: usize| index != chosen && Some(index) != mask;
        kinds.iter().enumerate().filter(|&(index, &kind)| other(index) && test(kind)).count()
    };
    for (found, what) in [
        (left(&|kind| kind & (REDUCED | MASK) == MASK), "further mask"),
        (left(&|kind| kind & REDUCED != 0), "image of lower resolution"),
        (left(&|kind| kind & (REDUCED | MASK) == 0), "further image"),
    ] {
        if found > 0 {
            notes.push(format!("left out: {found} x {what}"));
        }
    }
    Ok(Images {
        heights: directories.get(chosen).unwrap_or(first),
        mask: mask.and_then(|mask| directories.get(mask)),
    })
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
        if !text.is_empty() {
            notes.push(format!(
                "left out: the no-data value `{}`, which is not a number",
                shorten(text)
            ));
        }
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

/// What stored samples mean.
fn conversion(
    image: &Image,
    nodata: Option<f64>,
    asked: &Interpretation,
    metadata: &Metadata,
    notes: &mut Vec<String>,
) -> Conversion {
    let conversion = if image.sample.is_float() {
        Conversion::of_floats(nodata, asked.nodata)
    } else {
        Conversion::of_integers(nodata, asked.nodata)
    };
    let (scale, offset) = (metadata.scale.unwrap_or(1.0), metadata.offset.unwrap_or(0.0));
    if scale == 0.0 {
        notes.push("left out: the scale 0 of the file's metadata".to_owned());
        return conversion;
    }
    let conversion = conversion.scaled(scale, offset);
    if conversion.is_scaled() {
        notes.push(format!(
            "heights are the samples times {} plus {}, as the file's metadata say",
            shown(scale),
            shown(offset)
        ));
    }
    if let Some(name) = metadata.unit.as_deref().filter(|name| unit::metres(name).is_none()) {
        notes.push(format!(
            "the file states `{}` as the unit of heights, which is not known here: --height-unit \
             settles it",
            shorten(name)
        ));
    }
    conversion
}
