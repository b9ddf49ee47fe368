//! The samples of a checked image, row by row of each strip or tile.

use std::io::Read;

use super::image::{Image, Sample};
use super::unpack;

/// Decodes all samples, row 0 north; nodes with the value `nodata` become NaN.
pub(super) fn read(
    bytes: &[u8],
    image: &Image,
    nodata: Option<f64>,
    south_up: bool,
    notes: &mut Vec<String>,
) -> Result<Vec<f32>, String> {
    let (columns, rows) = (image.columns, image.rows);
    let (block_columns, block_rows) = image.block;
    // Blocks that are not stored hold the no-data value, or 0 where none is declared.
    let absent = if nodata.is_some() { f32::NAN } else { 0.0 };
    let mut samples = vec![absent; columns * rows];
    let width = image.sample.bytes();
    let mut raw = vec![0; block_columns * width];
    let mut unshuffled = Vec::new();
    let mut rounded = false;
    let mut missing = 0;
    let across = columns.div_ceil(block_columns);
    for (index, block) in image.blocks.iter().enumerate() {
        let Some(range) = block else {
            missing += 1;
            continue;
        };
        let packed = bytes.get(range.clone()).ok_or("a strip or tile lies outside the file")?;
        let mut stream = unpack::stream(packed, image.compression);
        let (column, row) = (index % across * block_columns, index / across * block_rows);
        let used = block_columns.min(columns - column);
        for line in row..rows.min(row + block_rows) {
            stream
                .read_exact(&mut raw)
                .map_err(|error| format!("strip or tile {index} cannot be unpacked: {error}"))?;
            // What predictor 3 leaves is big-endian whatever the file's order.
            let big_endian = match image.predictor {
                2 => {
                    undo_differences(&mut raw, width, image.big_endian);
                    image.big_endian
                }
                3 => {
                    unshuffle(&mut raw, width, &mut unshuffled);
                    true
                }
                _ => image.big_endian,
            };
            let to = &mut samples[line * columns + column..][..used];
            let row = Row { raw: &raw, big_endian, nodata };
            rounded |= row.convert(image.sample, to);
        }
    }
    if south_up {
        for row in 0..rows / 2 {
            let (north, south) = samples.split_at_mut((rows - 1 - row) * columns);
            north[row * columns..(row + 1) * columns].swap_with_slice(&mut south[..columns]);
        }
    }
    if missing > 0 {
        let value = if nodata.is_some() { "nodes without data" } else { "height 0" };
        notes.push(format!("{missing} strips or tiles are not stored: {value}"));
    }
    if rounded {
        notes.push("heights were rounded to 32-bit floats, which hold 7 digits".to_owned());
    }
    Ok(samples)
}

/// Predictor 2: every sample is the difference to the one before, as integers that wrap.
fn undo_differences(raw: &mut [u8], width: usize, big_endian: bool) {
    for at in (width..raw.len()).step_by(width) {
        // Byte by byte from the lowest, with a carry.
        let mut carry = false;
        for place in 0..width {
            let byte = at + if big_endian { width - 1 - place } else { place };
            let (sum, over) = raw[byte].overflowing_add(raw[byte - width]);
            let (sum, over_again) = sum.overflowing_add(u8::from(carry));
            raw[byte] = sum;
            carry = over || over_again;
        }
    }
}

/// Predictor 3: bytes are differences, and the row holds the highest bytes of all samples, then the
/// next ones, and so on.
fn unshuffle(raw: &mut [u8], width: usize, row: &mut Vec<u8>) {
    for at in 1..raw.len() {
        raw[at] = raw[at].wrapping_add(raw[at - 1]);
    }
    row.clear();
    row.extend_from_slice(raw);
    let count = raw.len() / width;
    for (index, sample) in raw.chunks_exact_mut(width).enumerate() {
        for (place, byte) in sample.iter_mut().enumerate() {
            *byte = row[place * count + index];
        }
    }
}

/// A row of samples as bytes.
struct Row<'a> {
    raw: &'a [u8],
    big_endian: bool,
    nodata: Option<f64>,
}

impl Row<'_> {
    /// Converts as many samples as there is room for; true if one had to be rounded.
    fn convert(mut self, sample: Sample, to: &mut [f32]) -> bool {
        match sample {
            Sample::U8 => self.each(to, |[byte]| f64::from(byte)),
            Sample::I8 => self.each(to, |bytes| f64::from(i8::from_le_bytes(bytes))),
            Sample::U16 => self.each(to, |bytes| f64::from(u16::from_le_bytes(bytes))),
            Sample::I16 => self.each(to, |bytes| f64::from(i16::from_le_bytes(bytes))),
            Sample::U32 => self.each(to, |bytes| f64::from(u32::from_le_bytes(bytes))),
            Sample::I32 => self.each(to, |bytes| f64::from(i32::from_le_bytes(bytes))),
            Sample::F32 => {
                // The mark is written in decimal digits: in 32 bits it is what they round to.
                self.nodata = self.nodata.map(|mark| f64::from(mark as f32));
                self.each(to, |bytes| f64::from(f32::from_le_bytes(bytes)))
            }
            Sample::F64 => self.each(to, f64::from_le_bytes),
        }
    }

    fn each<const N: usize>(&self, to: &mut [f32], value: impl Fn([u8; N]) -> f64) -> bool {
        let mut rounded = false;
        let (samples, _) = self.raw.as_chunks::<N>();
        for (to, &bytes) in to.iter_mut().zip(samples) {
            let mut bytes = bytes;
            if self.big_endian {
                bytes.reverse();
            }
            let value = value(bytes);
            if self.nodata == Some(value) {
                *to = f32::NAN;
            } else {
                *to = value as f32;
                rounded |= value.is_finite() && f64::from(*to) != value;
            }
        }
        rounded
    }
}
