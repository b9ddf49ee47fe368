//! What a directory says about its image, compared with what the file can hold.

use std::ops::Range;

use super::super::error::{MapError, check_sides, gdal};
use super::compression::Compression;
use super::directory::{Directory, Tiff, tag};
use super::sample::Sample;

/// An image that the decoder may be trusted with.
pub(super) struct Image {
    pub(super) columns: usize,
    pub(super) rows: usize,
    pub(super) sample: Sample,
    pub(super) big_endian: bool,
    pub(super) compression: Compression,
    /// 1 none, 2 differences, 3 differences of the bytes of floats.
    pub(super) predictor: u64,
    tiled: bool,
    /// Columns and rows of a strip or tile.
    pub(super) block: (usize, usize),
    /// Where each strip or tile lies in the file; `None` where it is not stored.
    pub(super) blocks: Vec<Option<Range<usize>>>,
}

/// What an image shows (tag 262).
mod photometric {
    pub const WHITE_IS_ZERO: u64 = 0;
    pub const BLACK_IS_ZERO: u64 = 1;
    pub const PALETTE: u64 = 3;
    pub const MASK: u64 = 4;
}

impl Image {
    /// Reads and checks what the decoder will rely on; `length` is that of the file.
    pub(super) fn read(
        tiff: &Tiff<'_>,
        directory: &Directory,
        name: &str,
        length: usize,
        notes: &mut Vec<String>,
    ) -> Result<Self, MapError> {
        let damaged = |reason: String| unusable(name, &reason);
        let unfit = |reason: String, remedy: String| Err(MapError::new(name, reason, remedy));
        let one = |tag, default| tiff.one(directory, tag, default).map_err(damaged);

        let (columns, rows) = (one(tag::WIDTH, 0)?, one(tag::LENGTH, 0)?);
        check_sides(name, columns, rows)?;
        let bands = one(tag::SAMPLES_PER_PIXEL, 1)?;
        if bands != 1 {
            return unfit(
                format!("it has {bands} bands, and heights have one"),
                format!("take one band out: {}", gdal("gdal_translate -b 1", name)),
            );
        }
        let shows = tiff.unsigned(directory, tag::PHOTOMETRIC).map_err(damaged)?;
        match shows.as_deref() {
            Some([photometric::BLACK_IS_ZERO | photometric::MASK]) => {}
            Some([photometric::WHITE_IS_ZERO]) => notes.push(
                "the file says that its samples are inverted (white is zero), which heights are \
                 not: they are read as stored"
                    .to_owned(),
            ),
            None => notes.push(
                "the file does not say what its samples show (tag 262): they are taken for heights"
                    .to_owned(),
            ),
            Some(other) => {
                let what = if *other == [photometric::PALETTE] {
                    "a palette image, whose values are places in a list of colours"
                } else {
                    "a colour image"
                };
                return unfit(
                    format!("it is {what}"),
                    "give the elevation model itself, not a picture of it".to_owned(),
                );
            }
        }
        let (format, bits) = (one(tag::SAMPLE_FORMAT, 1)?, one(tag::BITS_PER_SAMPLE, 1)?);
        let Some(sample) = Sample::of(format, bits) else {
            let kind = match format {
                1 => "unsigned integers",
                2 => "integers",
                3 => "floats",
                5 | 6 => "complex numbers",
                _ => "values of no stated type",
            };
            return unfit(
                format!("its samples are {kind} of {bits} bits"),
                format!(
                    "write them as 32-bit floats: {}",
                    gdal("gdal_translate -ot Float32", name)
                ),
            );
        };
        let number = one(tag::COMPRESSION, 1)?;
        let lerc = tiff.unsigned(directory, tag::LERC_PARAMETERS).map_err(damaged)?;
        let compression = match Compression::of(number, &lerc.unwrap_or_default()) {
            Ok(compression) => compression,
            Err(method) => {
                return unfit(
                    format!("it is compressed by {method} (number {number})"),
                    format!(
                        "pack it by deflate: {}",
                        gdal("gdal_translate -co COMPRESS=DEFLATE", name)
                    ),
                );
            }
        };
        if one(tag::FILL_ORDER, 1)? != 1 {
            return unfit(
                "its bits are stored from the lowest to the highest (fill order 2)".to_owned(),
                format!("write them the usual way: {}", gdal("gdal_translate", name)),
            );
        }
        // Predictors belong to methods that gain by them; elsewhere the tag means nothing.
        let predictor = match compression {
            Compression::None | Compression::PackBits | Compression::Lerc(_) => 1,
            _ => one(tag::PREDICTOR, 1)?,
        };
        if !matches!(predictor, 1..=3) || (predictor == 3 && !sample.is_float()) {
            return Err(damaged(format!(
                "predictor {predictor} does not fit {} samples",
                sample.name()
            )));
        }
        let planar = one(tag::PLANAR, 1)?;
        if !matches!(planar, 1 | 2) {
            return Err(damaged(format!("its planes are ordered in the unknown way {planar}")));
        }
        let mut image = Self {
            columns: columns as usize,
            rows: rows as usize,
            sample,
            big_endian: tiff.big_endian,
            compression,
            predictor,
            tiled: tiff.count(directory, tag::TILE_WIDTH) > 0,
            block: (0, 0),
            blocks: Vec::new(),
        };
        image.read_blocks(tiff, directory, length as u64, notes).map_err(damaged)?;
        Ok(image)
    }

    /// Strips or tiles: their size, their number, and that each can hold what it claims.
    fn read_blocks(
        &mut self,
        tiff: &Tiff<'_>,
        directory: &Directory,
        length: u64,
        notes: &mut Vec<String>,
    ) -> Result<(), String> {
        let (columns, rows) = (self.columns as u64, self.rows as u64);
        let (width, height) = if self.tiled {
            let side = |tag| -> Result<u64, String> {
                let side = tiff.one(directory, tag, 0)?;
                if side == 0 || side > LARGEST_TILE {
                    return Err(format!("it claims tiles with a side of {side} pixels"));
                }
                Ok(side)
            };
            (side(tag::TILE_WIDTH)?, side(tag::TILE_LENGTH)?)
        } else {
            let height = tiff.one(directory, tag::ROWS_PER_STRIP, rows)?;
            // Some writers mean "all rows" by 0.
            (columns, if height == 0 { rows } else { height.min(rows) })
        };
        self.block = (width as usize, height as usize);
        let count = columns.div_ceil(width) * rows.div_ceil(height);
        // Tiles may stand under the tags of strips, and the other way round.
        let list = |tags: [u16; 2]| -> Result<Option<Vec<u64>>, String> {
            let tag = tags.into_iter().find(|&tag| tiff.count(directory, tag) > 0);
            let Some(tag) = tag else { return Ok(None) };
            let found = tiff.count(directory, tag);
            if found < count {
                return Err(format!("{count} strips or tiles need as many offsets, not {found}"));
            }
            // Entries beyond the last block mean nothing; a longer list is not read.
            tiff.first_unsigned(directory, tag, count)
        };
        let (strips, tiles) = (
            (tag::STRIP_OFFSETS, tag::STRIP_BYTE_COUNTS),
            (tag::TILE_OFFSETS, tag::TILE_BYTE_COUNTS),
        );
        let (own, other) = if self.tiled { (tiles, strips) } else { (strips, tiles) };
        let offsets = list([own.0, other.0])?.ok_or("it does not say where its samples are")?;
        let counts = list([own.1, other.1])?;
        // Lengths of nothing but 0 beside offsets are no lengths.
        let counts = counts
            .filter(|counts| offsets.iter().zip(counts).any(|(&at, &bytes)| at != 0 && bytes != 0));
        if counts.is_none() && offsets.iter().any(|&at| at != 0) {
            notes.push(
                "the file does not say how long its strips or tiles are: each goes on as far as it \
                 can"
                    .to_owned(),
            );
        }
        let mut sorted = Vec::new();
        if counts.is_none() {
            sorted.clone_from(&offsets);
            sorted.sort_unstable();
        }
        // Bytes from an offset to the next block, or to the end of the file.
        let up_to_next = |at: u64| {
            let next = sorted.get(sorted.partition_point(|&other| other <= at));
            next.copied().unwrap_or(length).min(length).saturating_sub(at)
        };
        self.blocks.reserve_exact(offsets.len());
        for (index, &at) in offsets.iter().enumerate() {
            // GDAL leaves out blocks without data: offset 0, no bytes.
            let stated = counts.as_ref().map(|counts| counts[index]);
            if at == 0 || stated == Some(0) {
                self.blocks.push(None);
                continue;
            }
            let first_row = index as u64 / columns.div_ceil(width) * height;
            let stored_rows = if self.tiled { height } else { height.min(rows - first_row) };
            let row_bytes = self.sample.row_bytes(self.block.0) as u64;
            let claimed = row_bytes * stored_rows;
            // A last tile may end with the last row.
            let least = row_bytes * height.min(rows - first_row);
            let bytes = match (self.compression, stated) {
                // What is stored as it is is as long as it must be, whatever the file says.
                (Compression::None, _) => claimed.min(length.saturating_sub(at)).max(least),
                (_, Some(bytes)) => bytes,
                (_, None) => up_to_next(at),
            };
            let last = index + 1 == offsets.len();
            let there = length.saturating_sub(at);
            let bytes = match self.compression {
                Compression::None => bytes,
                // A last strip that claims more than there is may still be whole.
                _ if last => bytes.min(there),
                _ => bytes,
            };
            if bytes > there || bytes == 0 {
                return Err(format!(
                    "it is cut short: strip or tile {index} lies at {at}, {bytes} bytes long, in a \
                     file of {length}"
                ));
            }
            if least > bytes.saturating_mul(self.compression.ratio()) {
                return Err(format!(
                    "strip or tile {index} is {bytes} bytes long, which cannot hold the {least} \
                     bytes it stands for"
                ));
            }
            self.blocks.push(Some(at as usize..(at + bytes) as usize));
        }
        if self.blocks.iter().all(Option::is_none) {
            return Err("none of its strips or tiles is stored".to_owned());
        }
        Ok(())
    }

    /// Compression and predictor for reports.
    pub(super) fn compression_name(&self) -> String {
        let name = self.compression.name();
        match self.predictor {
            1 => name.to_owned(),
            number => format!("{name} with predictor {number}"),
        }
    }

    /// Strips or tiles for reports.
    pub(super) fn layout_name(&self) -> String {
        let (width, height) = self.block;
        if self.tiled {
            format!("tiles of {width} x {height}")
        } else if height == 1 {
            "strips of 1 row".to_owned()
        } else {
            format!("strips of {height} rows")
        }
    }
}

/// A tile has at most this many pixels a side.
const LARGEST_TILE: u64 = 16384;

/// The message for a TIFF file that this program cannot read. Others may be able to.
pub(super) fn unusable(name: &str, reason: &str) -> MapError {
    MapError::new(
        name,
        format!("the TIFF cannot be used: {reason}"),
        format!(
            "where other programs read it, let one write it anew: {}",
            gdal("gdal_translate", name)
        ),
    )
}
