//! PNG: greyscale samples as they are, or heights packed into the bytes of a colour picture.

use std::io::Cursor;

use image::codecs::png::PngDecoder;
use image::error::ImageError;
use image::{ColorType, ImageDecoder, Limits};

use super::encoding::Encoding;
use super::error::{DEFLATE_RATIO, MAX_SIDE, MapError, check_size, gdal, too_large};
use super::found::{Found, HeightFile, Storage, thinned};
use super::georeference::Georeference;
use super::interpretation::Interpretation;
use super::marks::Conversion;
use crate::scene::shown::one_line;

/// What the decoder may allocate beside the samples: a few rows, text and profiles.
const DECODER_BYTES: u64 = 64 << 20;

/// The last chunk of every PNG file.
const END_CHUNK: [u8; 12] = *b"\0\0\0\0IEND\xAE\x42\x60\x82";

/// Decodes a PNG held in memory; `name` is what messages call it.
pub(super) fn decode(
    bytes: &[u8],
    name: &str,
    asked: &Interpretation,
) -> Result<HeightFile, MapError> {
    let encoding = asked.encoding;
    let decode_error = |error: ImageError| decode_error(name, bytes, &error);
    // The decoder checks the sides as soon as it has the header, before any allocation.
    let mut limits = Limits::no_limits();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(DECODER_BYTES);
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(decode_error)?;

    let (columns, rows) = decoder.dimensions();
    check_size(name, u64::from(columns), u64::from(rows))?;
    let color = decoder.color_type();
    check_color(name, bytes, color, encoding)?;
    // A file that claims more than it can hold is refused before its claim is allocated.
    let honest = (bytes.len() as u64).saturating_mul(DEFLATE_RATIO);
    if decoder.total_bytes() > honest || !ends(bytes) {
        return Err(cut_short(name));
    }
    let length = usize::try_from(decoder.total_bytes())
        .map_err(|_| too_large(name, "the map does not fit into memory"))?;
    let mut raw = vec![0; length];
    decoder.read_image(&mut raw).map_err(decode_error)?;
    let conversion = match encoding {
        Encoding::Stored => Conversion::of_integers(None, asked.nodata),
        Encoding::TerrainRgb | Encoding::Terrarium => Conversion::of_floats(None, asked.nodata),
    };
    let height = |sample: f64| conversion.height(sample).0;
    let (samples, sample): (Vec<f32>, _) = match (encoding, color) {
        (Encoding::Stored, ColorType::L16) => {
            let (pairs, _) = raw.as_chunks::<2>();
            let sample = |&pair: &[u8; 2]| height(f64::from(u16::from_ne_bytes(pair)));
            (pairs.iter().map(sample).collect(), "uint16")
        }
        (Encoding::Stored, _) => {
            (raw.iter().map(|&byte| height(f64::from(byte))).collect(), "uint8")
        }
        (_, ColorType::Rgba8) => {
            let (pixels, _) = raw.as_chunks::<4>();
            // A transparent pixel of an elevation tile holds no height.
            let height = |&[r, g, b, a]: &[u8; 4]| {
                if a == 0 { f32::NAN } else { height(packed(encoding, [r, g, b])) }
            };
            (pixels.iter().map(height).collect(), "uint8 x 4")
        }
        (_, _) => {
            let (pixels, _) = raw.as_chunks::<3>();
            (pixels.iter().map(|&pixel| height(packed(encoding, pixel))).collect(), "uint8 x 3")
        }
    };
    let format = match encoding {
        Encoding::Stored => "PNG",
        Encoding::TerrainRgb => "PNG, Terrain-RGB",
        Encoding::Terrarium => "PNG, Terrarium",
    };
    let storage = Storage::of(format, sample);
    let mut georeference = Georeference::unknown();
    if encoding != Encoding::Stored {
        georeference.height_unit_m = Some(1.0);
    }
    let every = asked.every(name, u64::from(columns), u64::from(rows))?;
    Found {
        columns: columns as usize,
        rows: rows as usize,
        samples: thinned(samples, columns as usize, every),
        storage,
        georeference,
        nodata: None,
        turned_over: false,
        conversion,
        notes: Vec::new(),
    }
    .finish(name, every, asked)
}

/// Metres packed into three bytes.
fn packed(encoding: Encoding, [r, g, b]: [u8; 3]) -> f64 {
    let [r, g, b] = [f64::from(r), f64::from(g), f64::from(b)];
    match encoding {
        Encoding::Terrarium => r * 256.0 + g + b / 256.0 - 32768.0,
        // In tenths, which are exact, and then divided once.
        _ => ((r * 65536.0 + g * 256.0 + b) - 100_000.0) / 10.0,
    }
}

/// Whether the last chunk is there. Something may follow it, as some programs append their own.
fn ends(bytes: &[u8]) -> bool {
    bytes.windows(END_CHUNK.len()).rev().any(|window| window == END_CHUNK)
}

/// Heights have one sample a node, and its bits are its value; packed heights have three bytes.
fn check_color(
    name: &str,
    bytes: &[u8],
    color: ColorType,
    encoding: Encoding,
) -> Result<(), MapError> {
    // The decoder spreads 1-, 2- and 4-bit grey over 0..=255 and palettes over RGB; what the
    // file held stands at bytes 24 and 25, at the same place in every PNG.
    let depth = bytes.get(24).copied().unwrap_or(0);
    let palette = bytes.get(25) == Some(&3);
    if encoding != Encoding::Stored {
        // A palette holds the same colours in fewer bytes, and the decoder puts them back.
        if palette && !has_sound_palette(bytes) {
            return Err(MapError::new(
                name,
                "the PNG is damaged: its palette is no list of colours",
                "where other programs read it, write it again from one of them",
            ));
        }
        if matches!(color, ColorType::Rgb8 | ColorType::Rgba8) {
            return Ok(());
        }
        return Err(MapError::new(
            name,
            format!("heights packed as \"{}\" need 8 bits of red, green and blue", encoding.name()),
            "give the tile as it was published, or leave the encoding out for a greyscale PNG",
        ));
    }
    let found = match color {
        _ if palette => "it is a palette PNG, whose values are places in a list of colours",
        ColorType::L8 if depth < 8 => "it has fewer than 8 bits a sample",
        ColorType::L8 | ColorType::L16 => return Ok(()),
        ColorType::La8 | ColorType::La16 => "it has transparency",
        _ => "it is a colour PNG",
    };
    let remedy = format!(
        "heights need a greyscale PNG of 8 or 16 bits without transparency: {} takes one channel",
        gdal("gdal_translate -b 1", name)
    );
    let tile = matches!(color, ColorType::Rgb8 | ColorType::Rgba8);
    let remedy = if tile {
        format!(
            "where its colours are packed heights, add --encoding terrain-rgb or --encoding terrarium \
             (surface.encoding in a scene); else {remedy}"
        )
    } else {
        remedy
    };
    Err(MapError::new(name, found, remedy))
}

/// Whether the palette has whole colours, 256 at most: on others the `png` crate (0.18.1) panics.
fn has_sound_palette(bytes: &[u8]) -> bool {
    const SIGNATURE: usize = 8;
    let mut at = SIGNATURE;
    while let Some(length) = be_u32(bytes, at) {
        match bytes.get(at + 4..at + 8) {
            Some(b"PLTE") => return length % 3 == 0 && (3..=768).contains(&length),
            Some(b"IDAT") | None => return false,
            // Length, name and checksum take 12 bytes.
            Some(_) => at = at.saturating_add(length as usize).saturating_add(12),
        }
    }
    false
}

fn cut_short(name: &str) -> MapError {
    MapError::new(
        name,
        "the PNG is cut short: it ends before its last sample",
        "give the whole file",
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
        "where other programs read it, write it again from one of them",
    )
}

fn be_u32(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_be_bytes(four.try_into().ok()?))
}
