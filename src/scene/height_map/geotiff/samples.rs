//! The samples of a checked image, strip by strip or tile by tile.

use std::io::Cursor;

use tiff::decoder::{Decoder, Limits};

use super::image::{Image, Sample};

/// What the decoder may allocate for a list of values: 16384 x 4096 strips and tiles at the worst,
/// of which it holds 32 bytes each.
const LIST_BYTES: usize = 64 << 20;

/// What the conversion of samples found.
#[derive(Default)]
struct Found {
    /// A sample is not exact in 32 bits.
    rounded: bool,
}

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
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let mut limits = Limits::default();
    limits.decoding_buffer_size = LIST_BYTES.max(block_columns * block_rows * 8);
    limits.intermediate_buffer_size = bytes.len();
    limits.ifd_value_size = LIST_BYTES;
    decoder = decoder.with_limits(limits);

    // Blocks that are not stored hold the no-data value, or 0 where none is declared.
    let absent = if nodata.is_some() { f32::NAN } else { 0.0 };
    let mut samples = vec![absent; columns * rows];
    let mut found = Found::default();
    let mut block = Vec::new();
    let across = columns.div_ceil(block_columns);
    for (index, _) in image.stored.iter().enumerate().filter(|(_, stored)| **stored) {
        let number = index as u32;
        let layout =
            decoder.image_chunk_buffer_layout(number).map_err(|error| error.to_string())?;
        let (column, row) = (index % across * block_columns, index / across * block_rows);
        let used = block_columns.min(columns - column);
        let used_rows = block_rows.min(rows - row);
        if layout.len != used * used_rows * image.sample.bytes() {
            return Err(format!("strip or tile {index} has an unexpected size"));
        }
        block.resize(layout.len, 0);
        decoder.read_chunk_bytes(number, &mut block).map_err(|error| located(index, &error))?;
        for (line, raw) in block.chunks_exact(used * image.sample.bytes()).enumerate() {
            let to = (row + line) * columns + column;
            convert(image.sample, raw, &mut samples[to..to + used], nodata, &mut found);
        }
    }
    if south_up {
        for row in 0..rows / 2 {
            let (north, south) = samples.split_at_mut((rows - 1 - row) * columns);
            north[row * columns..(row + 1) * columns].swap_with_slice(&mut south[..columns]);
        }
    }
    let absent = image.stored.iter().filter(|stored| !**stored).count();
    if absent > 0 {
        let value = if nodata.is_some() { "nodes without data" } else { "height 0" };
        notes.push(format!("{absent} strips or tiles are not stored: {value}"));
    }
    if found.rounded {
        notes.push("heights were rounded to 32-bit floats, which hold 7 digits".to_owned());
    }
    Ok(samples)
}

fn located(index: usize, error: &tiff::TiffError) -> String {
    format!("strip or tile {index} cannot be unpacked ({error})")
}

/// Converts a row of samples in the byte order of this machine.
fn convert(sample: Sample, raw: &[u8], to: &mut [f32], nodata: Option<f64>, found: &mut Found) {
    let mut values = Values { raw, to, nodata, found };
    match sample {
        Sample::U8 => values.convert(|[byte]| f64::from(byte)),
        Sample::I8 => values.convert(|bytes| f64::from(i8::from_ne_bytes(bytes))),
        Sample::U16 => values.convert(|bytes| f64::from(u16::from_ne_bytes(bytes))),
        Sample::I16 => values.convert(|bytes| f64::from(i16::from_ne_bytes(bytes))),
        Sample::U32 => values.convert(|bytes| f64::from(u32::from_ne_bytes(bytes))),
        Sample::I32 => values.convert(|bytes| f64::from(i32::from_ne_bytes(bytes))),
        Sample::F32 => {
            // The mark is written in decimal digits: in 32 bits it is what they round to.
            values.nodata = nodata.map(|mark| f64::from(mark as f32));
            values.convert(|bytes| f64::from(f32::from_ne_bytes(bytes)));
        }
        Sample::F64 => values.convert(f64::from_ne_bytes),
    }
}

struct Values<'a> {
    raw: &'a [u8],
    to: &'a mut [f32],
    nodata: Option<f64>,
    found: &'a mut Found,
}

impl Values<'_> {
    fn convert<const N: usize>(&mut self, value: impl Fn([u8; N]) -> f64) {
        let (values, _) = self.raw.as_chunks::<N>();
        for (to, &bytes) in self.to.iter_mut().zip(values) {
            let value = value(bytes);
            if self.nodata == Some(value) {
                *to = f32::NAN;
            } else {
                *to = value as f32;
                self.found.rounded |= value.is_finite() && f64::from(*to) != value;
            }
        }
    }
}
