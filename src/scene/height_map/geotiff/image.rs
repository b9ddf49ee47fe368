//! What a directory says about its image, compared with what the file can hold.

use std::ops::Range;

use super::super::error::{DEFLATE_RATIO, MAX_SIDE, MapError, check_size};
use super::directory::{Directory, Tiff, tag};

/// Type of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sample {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    F32,
    F64,
}

impl Sample {
    fn of(format: u64, bits: u64) -> Option<Self> {
        Some(match (format, bits) {
            (1, 8) => Self::U8,
            (1, 16) => Self::U16,
            (1, 32) => Self::U32,
            (2, 8) => Self::I8,
            (2, 16) => Self::I16,
            (2, 32) => Self::I32,
            (3, 32) => Self::F32,
            (3, 64) => Self::F64,
            _ => return None,
        })
    }

    /// Name for reports.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::U8 => "uint8",
            Self::I8 => "int8",
            Self::U16 => "uint16",
            Self::I16 => "int16",
            Self::U32 => "uint32",
            Self::I32 => "int32",
            Self::F32 => "float32",
            Self::F64 => "float64",
        }
    }

    pub(super) fn bytes(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    fn is_float(self) -> bool {
        matches!(self, Self::F32 | Self::F64)
    }

    /// Whether a sample of this type can have a value.
    pub(super) fn can_be(self, value: f64) -> bool {
        let (low, high) = match self {
            Self::F32 | Self::F64 => return true,
            Self::U8 => (0.0, f64::from(u8::MAX)),
            Self::I8 => (f64::from(i8::MIN), f64::from(i8::MAX)),
            Self::U16 => (0.0, f64::from(u16::MAX)),
            Self::I16 => (f64::from(i16::MIN), f64::from(i16::MAX)),
            Self::U32 => (0.0, f64::from(u32::MAX)),
            Self::I32 => (f64::from(i32::MIN), f64::from(i32::MAX)),
        };
        value.fract() == 0.0 && (low..=high).contains(&value)
    }
}

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

/// How strips and tiles are compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compression {
    None,
    Lzw,
    Deflate,
    PackBits,
}

impl Compression {
    /// By its number; the error names a method that is not supported.
    fn of(number: u64) -> Result<Self, &'static str> {
        match number {
            1 => Ok(Self::None),
            5 => Ok(Self::Lzw),
            8 | 32946 => Ok(Self::Deflate),
            32773 => Ok(Self::PackBits),
            2..=4 => Err("fax"),
            6 | 7 => Err("JPEG"),
            34712 => Err("JPEG 2000"),
            34887 => Err("LERC"),
            34925 => Err("LZMA"),
            50000 => Err("Zstandard"),
            50001 => Err("WebP"),
            50002 => Err("JPEG XL"),
            _ => Err("an unknown method"),
        }
    }

    /// The most bytes that one byte can stand for.
    fn ratio(self) -> u64 {
        match self {
            Self::None => 1,
            // A code of at least 9 bits stands for at most 4096 bytes.
            Self::Lzw => 4096,
            Self::Deflate => DEFLATE_RATIO,
            Self::PackBits => 64,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::None => "uncompressed",
            Self::Lzw => "LZW",
            Self::Deflate => "deflate",
            Self::PackBits => "PackBits",
        }
    }
}

impl Image {
    /// Reads and checks what the decoder will rely on; `length` is that of the file.
    pub(super) fn read(
        tiff: &Tiff<'_>,
        directory: &Directory,
        name: &str,
        length: usize,
    ) -> Result<Self, MapError> {
        let damaged = |reason: String| {
            MapError::new(
                name,
                format!("the TIFF cannot be used: {reason}"),
                "download or write the file again",
            )
        };
        let unfit = |reason: String, remedy: &str| Err(MapError::new(name, reason, remedy));
        let one = |tag, default| tiff.one(directory, tag, default).map_err(damaged);

        let (columns, rows) = (one(tag::WIDTH, 0)?, one(tag::LENGTH, 0)?);
        check_size(name, columns, rows)?;
        let bands = one(tag::SAMPLES_PER_PIXEL, 1)?;
        if bands != 1 {
            return unfit(
                format!("it has {bands} bands, and heights have one"),
                "take one band out, for example with gdal_translate -b 1 IN OUT.tif",
            );
        }
        match tiff.unsigned(directory, tag::PHOTOMETRIC).map_err(damaged)?.as_deref() {
            Some([1]) => {}
            Some([0]) => {
                return unfit(
                    "its samples are inverted (white is zero)".to_owned(),
                    "rewrite it with gdal_translate -co PHOTOMETRIC=MINISBLACK IN OUT.tif",
                );
            }
            Some([3]) => {
                return unfit(
                    "it is a palette image, whose values are places in a list of colours"
                        .to_owned(),
                    "give the elevation model itself, not a picture of it",
                );
            }
            Some(_) => {
                return unfit(
                    "it is a colour image".to_owned(),
                    "give the elevation model itself, not a picture of it",
                );
            }
            None => return Err(damaged("it does not say how samples are meant (tag 262)".into())),
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
                "rewrite it as one of int8 to int32, uint8 to uint32, float32 and float64, for \
                 example with gdal_translate -ot Float32 IN OUT.tif",
            );
        };
        let number = one(tag::COMPRESSION, 1)?;
        let compression = match Compression::of(number) {
            Ok(compression) => compression,
            Err(method) => {
                return unfit(
                    format!("it is compressed by {method} (number {number})"),
                    "rewrite it with gdal_translate -co COMPRESS=DEFLATE IN OUT.tif",
                );
            }
        };
        let predictor = one(tag::PREDICTOR, 1)?;
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
            tiled: tiff.count(directory, tag::TILE_OFFSETS) > 0,
            block: (0, 0),
            blocks: Vec::new(),
        };
        image.read_blocks(tiff, directory, length as u64).map_err(damaged)?;
        Ok(image)
    }

    /// Strips or tiles: their size, their number, and that each can hold what it claims.
    fn read_blocks(
        &mut self,
        tiff: &Tiff<'_>,
        directory: &Directory,
        length: u64,
    ) -> Result<(), String> {
        let (columns, rows) = (self.columns as u64, self.rows as u64);
        let (offsets, counts, width, height) = if self.tiled {
            let side = |tag| -> Result<u64, String> {
                let side = tiff.one(directory, tag, 0)?;
                if side == 0 || side > u64::from(MAX_SIDE) {
                    return Err(format!("it claims tiles with a side of {side} pixels"));
                }
                Ok(side)
            };
            (
                tag::TILE_OFFSETS,
                tag::TILE_BYTE_COUNTS,
                side(tag::TILE_WIDTH)?,
                side(tag::TILE_LENGTH)?,
            )
        } else {
            let height = tiff.one(directory, tag::ROWS_PER_STRIP, rows)?;
            if height == 0 {
                return Err("it claims strips without rows".to_owned());
            }
            (tag::STRIP_OFFSETS, tag::STRIP_BYTE_COUNTS, columns, height.min(rows))
        };
        self.block = (width as usize, height as usize);
        let blocks = columns.div_ceil(width) * rows.div_ceil(height);
        // The lists are read only when they are as long as they must be.
        for tag in [offsets, counts] {
            let found = tiff.count(directory, tag);
            if found != blocks {
                return Err(format!("{blocks} strips or tiles need as many offsets, not {found}"));
            }
        }
        let list = |tag| -> Result<Vec<u64>, String> {
            tiff.unsigned(directory, tag)?.ok_or_else(|| format!("tag {tag} is missing"))
        };
        let (offsets, counts) = (list(offsets)?, list(counts)?);
        self.blocks.reserve_exact(offsets.len());
        for (index, (&at, &bytes)) in offsets.iter().zip(&counts).enumerate() {
            // GDAL leaves out tiles without data: offset 0, no bytes.
            if at == 0 || bytes == 0 {
                self.blocks.push(None);
                continue;
            }
            if at.checked_add(bytes).is_none_or(|end| end > length) {
                return Err(format!(
                    "it is cut short: strip or tile {index} lies at {at}, {bytes} bytes long, in a \
                     file of {length}"
                ));
            }
            let first_row = index as u64 / columns.div_ceil(width) * height;
            let claimed = width * height.min(rows - first_row) * self.sample.bytes() as u64;
            if claimed > bytes.saturating_mul(self.compression.ratio()) {
                return Err(format!(
                    "strip or tile {index} is {bytes} bytes long, which cannot hold the {claimed} \
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
