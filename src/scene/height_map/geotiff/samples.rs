//! The samples of a checked image, row by row of each strip or tile.

use std::io::Read;

use rayon::prelude::*;

use super::super::marks::Conversion;
use super::compression::Compression;
use super::image::Image;
use super::unpack;
use super::{lerc, predictor};

/// Decodes all samples that are kept, every n-th of every n-th row from the north-west; samples of
/// blocks that are not stored are `absent`. Notes say what is lost.
pub(super) fn read(
    bytes: &[u8],
    image: &Image,
    every: usize,
    conversion: &Conversion,
    absent: f64,
    notes: &mut Vec<String>,
) -> Result<Vec<f32>, String> {
    let mut heights = vec![0.0; image.columns.div_ceil(every) * image.rows.div_ceil(every)];
    let rounded = each(bytes, image, every, absent, &mut heights, |height, sample| {
        let rounded;
        (*height, rounded) = conversion.height(sample);
        rounded
    })?;
    let missing = image.blocks.iter().filter(|block| block.is_none()).count();
    if missing > 0 {
        let value = if absent.is_nan() {
            "nodes without data".to_owned()
        } else {
            format!("height {}", conversion.height(absent).0)
        };
        notes.push(format!("{missing} strips or tiles are not stored: {value}"));
    }
    if rounded {
        notes.push("heights were rounded to 32-bit floats, which hold 7 digits".to_owned());
    }
    Ok(heights)
}

/// Makes all heights nodes without data where a mask of the same size is 0.
pub(super) fn mask(
    bytes: &[u8],
    mask: &Image,
    every: usize,
    heights: &mut [f32],
) -> Result<(), String> {
    each(bytes, mask, every, 0.0, heights, |height, seen| {
        if seen == 0.0 {
            *height = f32::NAN;
        }
        false
    })
    .map(|_| ())
}

/// Hands every sample that is kept to `put`, with the height of its node; true if `put` ever is.
///
/// Rows of blocks are decoded side by side: each has its own part of the heights.
fn each(
    bytes: &[u8],
    image: &Image,
    every: usize,
    absent: f64,
    heights: &mut [f32],
    put: impl Fn(&mut f32, f64) -> bool + Sync,
) -> Result<bool, String> {
    let kept_columns = image.columns.div_ceil(every);
    let mut bands = Vec::new();
    let mut rest = heights;
    for first in (0..image.rows).step_by(image.block.1) {
        let end = image.rows.min(first + image.block.1);
        let kept = end.div_ceil(every) - first.div_ceil(every);
        let (part, after) = rest.split_at_mut(kept * kept_columns);
        bands.push((bands.len(), part));
        rest = after;
    }
    let across = image.columns.div_ceil(image.block.0);
    let band = |(band, heights): (usize, &mut [f32])| -> Result<bool, String> {
        let mut any = false;
        for at in 0..across {
            let (index, column) = (band * across + at, at * image.block.0);
            let (west, used) = (column.div_ceil(every), image.block.0.min(image.columns - column));
            let east = (column + used).div_ceil(every);
            let first = band * image.block.1;
            let mut decoder = Decoder::new(bytes, image, index, absent)?;
            for line in first..image.rows.min(first + image.block.1) {
                // Rows that are not kept are unpacked for those behind them.
                let kept = if line % every == 0 {
                    let row = line / every - first.div_ceil(every);
                    &mut heights[row * kept_columns..][west..east]
                } else {
                    &mut []
                };
                let mut to = kept.iter_mut();
                // Samples before the first one that is kept.
                let mut wait = west * every - column;
                decoder.row(|sample| {
                    if wait > 0 {
                        wait -= 1;
                    } else if let Some(height) = to.next() {
                        any |= put(height, sample);
                        wait = every - 1;
                    }
                })?;
            }
        }
        Ok(any)
    };
    bands.into_par_iter().map(band).try_reduce(|| false, |a, b| Ok(a || b))
}

/// A strip or tile that hands out its rows.
enum Decoder<'a> {
    /// Not stored: so many samples a row.
    Absent(usize, f64),
    Stream(Stream<'a>),
    Lerc(lerc::Rows),
}

struct Stream<'a> {
    image: &'a Image,
    index: usize,
    from: Box<dyn Read + 'a>,
    raw: Vec<u8>,
    spare: Vec<u8>,
}

impl<'a> Decoder<'a> {
    fn new(bytes: &'a [u8], image: &'a Image, index: usize, absent: f64) -> Result<Self, String> {
        let Some(range) = image.blocks[index].clone() else {
            return Ok(Self::Absent(image.block.0, absent));
        };
        let packed = bytes.get(range).ok_or("a strip or tile lies outside the file")?;
        let broken = |error: String| format!("strip or tile {index} cannot be unpacked: {error}");
        if let Compression::Lerc(on_top) = image.compression {
            return lerc::Rows::decode(packed, on_top, image.block, image.big_endian)
                .map(Self::Lerc)
                .map_err(broken);
        }
        Ok(Self::Stream(Stream {
            image,
            index,
            from: unpack::stream(packed, image.compression).map_err(broken)?,
            raw: vec![0; image.sample.row_bytes(image.block.0)],
            spare: Vec::new(),
        }))
    }

    /// Hands out the samples of the next row.
    fn row(&mut self, put: impl FnMut(f64)) -> Result<(), String> {
        match self {
            Self::Absent(columns, sample) => (0..*columns).map(|_| *sample).for_each(put),
            Self::Stream(stream) => stream.row(put)?,
            Self::Lerc(rows) => rows.next(put)?,
        }
        Ok(())
    }
}

impl Stream<'_> {
    fn row(&mut self, put: impl FnMut(f64)) -> Result<(), String> {
        let Self { image, index, from, raw, spare } = self;
        from.read_exact(raw)
            .map_err(|error| format!("strip or tile {index} cannot be unpacked: {error}"))?;
        let width = image.sample.bits() / 8;
        // What predictor 3 leaves is big-endian whatever the file's order.
        let big_endian = match image.predictor {
            2 if width > 0 => {
                predictor::undo_differences(raw, width, image.big_endian);
                image.big_endian
            }
            3 => {
                predictor::unshuffle(raw, width, spare);
                true
            }
            _ => image.big_endian,
        };
        image.sample.each(raw, big_endian, put);
        Ok(())
    }
}
