//! PNG files: frames out, frames in for a comparison, height maps out.

use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;

use image::codecs::png::PngEncoder;
use image::error::LimitErrorKind;
use image::{
    ColorType, DynamicImage, ExtendedColorType, ImageEncoder, ImageError, ImageFormat,
    ImageReader, Limits,
};

use super::{ReadError, SinkError, write_atomically};

/// Largest number of columns and of lines that [`read`] accepts.
pub const MAX_SIDE: u32 = 16384;

/// Largest picture in memory: `MAX_SIDE` squared, four bytes a pixel.
const MAX_BYTES: u64 = 4 * (MAX_SIDE as u64) * (MAX_SIDE as u64);

/// A picture in memory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Image {
    /// Pixels across.
    pub columns: usize,
    /// Scan lines.
    pub lines: usize,
    /// sRGB bytes, `lines * columns`, line by line from the top.
    pub pixels: Vec<[u8; 3]>,
}

/// Writes 8-bit RGB, `lines * columns` pixels, line by line from the top.
///
/// The same pixels give the same bytes.
///
/// # Errors
/// [`SinkError`]; nothing is left half-written.
pub fn write(
    path: &Path,
    columns: usize,
    lines: usize,
    pixels: &[[u8; 3]],
) -> Result<(), SinkError> {
    check_size(path, columns, lines, pixels.len())?;
    write_atomically(path, |out| {
        PngEncoder::new(out)
            .write_image(
                pixels.as_flattened(),
                side(columns)?,
                side(lines)?,
                ExtendedColorType::Rgb8,
            )
            .map_err(into_io)
    })
}

/// Reads a PNG of 8 bits a channel: RGB, greyscale, indexed, or with an alpha channel that is
/// opaque everywhere.
///
/// # Errors
/// [`ReadError`] when the file is missing, is no PNG, is damaged or cut short, has more than
/// 16384 pixels on a side, has 16 bits a channel, or has transparent pixels.
pub fn read(path: &Path) -> Result<Image, ReadError> {
    let file = File::open(path).map_err(|error| ReadError::open(path, &error))?;
    let mut reader = ImageReader::with_format(BufReader::new(file), ImageFormat::Png);
    let mut limits = Limits::no_limits();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_BYTES);
    reader.limits(limits);
    let decoded = reader.decode().map_err(|error| match error {
        ImageError::Limits(limit) if limit.kind() == LimitErrorKind::DimensionError => {
            let reason = format!("it has more than {MAX_SIDE} columns or lines");
            ReadError::new(path, reason, "crop it or scale it down")
        }
        ImageError::Decoding(_) => {
            let reason = format!("it is no PNG file or is damaged ({error})");
            ReadError::new(path, reason, "give a whole PNG file")
        }
        ImageError::IoError(error) => {
            let reason = format!("it is cut short or unreadable ({error})");
            ReadError::new(path, reason, "give a whole PNG file")
        }
        other => ReadError::new(path, other, "save it as an 8-bit RGB PNG"),
    })?;
    let kind = decoded.color();
    if !matches!(kind, ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8) {
        let reason = "it has more than 8 bits a channel";
        return Err(ReadError::new(path, reason, "save it as an 8-bit RGB PNG"));
    }
    if !opaque(&decoded) {
        let reason = "it has transparent pixels, whose colour depends on what lies behind";
        return Err(ReadError::new(path, reason, "flatten it onto a background"));
    }
    let rgb = decoded.into_rgb8();
    let (columns, lines) = (rgb.width() as usize, rgb.height() as usize);
    let pixels = rgb.as_raw().as_chunks::<3>().0.to_vec();
    Ok(Image { columns, lines, pixels })
}

/// True if no pixel lets the background through.
fn opaque(image: &DynamicImage) -> bool {
    match image {
        DynamicImage::ImageLumaA8(pixels) => pixels.pixels().all(|pixel| pixel.0[1] == 255),
        DynamicImage::ImageRgba8(pixels) => pixels.pixels().all(|pixel| pixel.0[3] == 255),
        _ => true,
    }
}

fn check_size(path: &Path, columns: usize, lines: usize, found: usize) -> Result<(), SinkError> {
    if columns.checked_mul(lines) == Some(found) {
        return Ok(());
    }
    Err(SinkError::Shape { path: path.to_owned(), array: "color", columns, lines, found })
}

/// A side as the encoder wants it.
fn side(pixels: usize) -> io::Result<u32> {
    u32::try_from(pixels).map_err(|error| io::Error::new(io::ErrorKind::InvalidInput, error))
}

fn into_io(error: ImageError) -> io::Error {
    match error {
        ImageError::IoError(error) => error,
        other => io::Error::other(other),
    }
}
