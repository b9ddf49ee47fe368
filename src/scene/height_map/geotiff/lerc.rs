//! Strips and tiles packed by LERC, ESRI's Limited Error Raster Compression, which are unpacked
//! whole.

use std::io::Read;

use lerc::SampleData;

use super::compression::{Compression, Packed};
use super::unpack;

/// The samples of a block, which are handed out row by row.
pub(super) struct Rows {
    data: SampleData,
    /// Whether a pixel has data; `None` where all have.
    valid: Option<Vec<bool>>,
    /// Samples are stored with their bytes turned round: in big-endian files.
    swapped: bool,
    columns: usize,
    next: usize,
}

impl Rows {
    /// Decodes a block of so many columns and, but for the last strip, rows.
    pub(super) fn decode(
        packed: &[u8],
        on_top: Packed,
        (columns, rows): (usize, usize),
        swapped: bool,
    ) -> Result<Self, String> {
        // A sample takes 8 bytes at most, and what LERC makes of samples is hardly larger.
        let limit = 16 * (columns * rows) as u64 + 4096;
        let mut unpacked = Vec::new();
        let on_top = match on_top {
            Packed::Plain => None,
            Packed::Deflate => Some(Compression::Deflate),
            Packed::Zstandard => Some(Compression::Zstandard),
        };
        let blob = match on_top {
            None => packed,
            Some(compression) => {
                let stream = unpack::stream(packed, compression)?;
                stream.take(limit).read_to_end(&mut unpacked).map_err(|e| e.to_string())?;
                &unpacked
            }
        };
        // The header's claims are compared with the block before anything is allocated for them.
        let info = lerc::decode_info(blob).map_err(|error| error.to_string())?;
        let (width, height) = (info.width as usize, info.height as usize);
        if width != columns || height == 0 || height > rows || info.bands != 1 || info.depth != 1 {
            return Err(format!(
                "it holds {width} x {height} samples of {} bands",
                info.bands.saturating_mul(info.depth)
            ));
        }
        let image = lerc::decode(blob).map_err(|error| error.to_string())?;
        let valid = (!image.all_valid()).then(|| {
            let mask = image.mask();
            (0..width * height).map(|at| mask.is_none_or(|mask| mask.is_valid(at))).collect()
        });
        Ok(Self { data: image.data, valid, swapped, columns, next: 0 })
    }

    /// Hands out the samples of the next row, NaN where they are masked.
    pub(super) fn next(&mut self, mut put: impl FnMut(f64)) -> Result<(), String> {
        let range = self.next * self.columns..(self.next + 1) * self.columns;
        self.next += 1;
        let valid = self.valid.as_ref().map(|valid| &valid[range.start.min(valid.len())..]);
        let mut at = 0;
        let mut sample = |value: f64| {
            let is_valid = valid.is_none_or(|valid| valid.get(at).copied().unwrap_or(false));
            at += 1;
            put(if is_valid { value } else { f64::NAN });
        };
        let swapped = self.swapped;
        macro_rules! each {
            ($samples:expr, $type:ty) => {
                for &value in $samples.get(range).ok_or("it has too few rows")? {
                    let mut bytes = value.to_ne_bytes();
                    if swapped {
                        bytes.reverse();
                    }
                    sample(f64::from(<$type>::from_ne_bytes(bytes)));
                }
            };
        }
        match &self.data {
            SampleData::I8(samples) => each!(samples, i8),
            SampleData::U8(samples) => each!(samples, u8),
            SampleData::I16(samples) => each!(samples, i16),
            SampleData::U16(samples) => each!(samples, u16),
            SampleData::I32(samples) => each!(samples, i32),
            SampleData::U32(samples) => each!(samples, u32),
            SampleData::F32(samples) => each!(samples, f32),
            SampleData::F64(samples) => each!(samples, f64),
        }
        Ok(())
    }
}
