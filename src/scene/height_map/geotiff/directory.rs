//! The directories of a TIFF file. Whatever they claim is compared with the file, so that nothing is
//! allocated for a claim that cannot be true.

use std::collections::{BTreeMap, HashSet};

/// Directories are followed so far; a file of more pages is no height map.
const MAX_DIRECTORIES: usize = 4096;

/// Entries of all directories: some fifteen each, a hundred in files full of metadata.
const MAX_ENTRIES: usize = 1 << 18;

/// Numbers of a list that describes the georeference: a file of more is no height map.
const MAX_NUMBERS: u64 = 1 << 16;

/// Tags that are read, by their numbers in TIFF 6.0, GeoTIFF 1.1 and GDAL's documentation.
pub mod tag {
    pub const SUBFILE_TYPE: u16 = 254;
    pub const WIDTH: u16 = 256;
    pub const LENGTH: u16 = 257;
    pub const BITS_PER_SAMPLE: u16 = 258;
    pub const COMPRESSION: u16 = 259;
    pub const PHOTOMETRIC: u16 = 262;
    pub const FILL_ORDER: u16 = 266;
    pub const STRIP_OFFSETS: u16 = 273;
    pub const SAMPLES_PER_PIXEL: u16 = 277;
    pub const ROWS_PER_STRIP: u16 = 278;
    pub const STRIP_BYTE_COUNTS: u16 = 279;
    pub const PLANAR: u16 = 284;
    pub const PREDICTOR: u16 = 317;
    pub const TILE_WIDTH: u16 = 322;
    pub const TILE_LENGTH: u16 = 323;
    pub const TILE_OFFSETS: u16 = 324;
    pub const TILE_BYTE_COUNTS: u16 = 325;
    pub const SAMPLE_FORMAT: u16 = 339;
    pub const PIXEL_SCALE: u16 = 33550;
    pub const TIE_POINTS: u16 = 33922;
    pub const TRANSFORMATION: u16 = 34264;
    pub const GEO_KEYS: u16 = 34735;
    pub const GEO_DOUBLES: u16 = 34736;
    pub const GEO_TEXTS: u16 = 34737;
    pub const GDAL_METADATA: u16 = 42112;
    pub const GDAL_NODATA: u16 = 42113;
    pub const LERC_PARAMETERS: u16 = 50674;
}

/// A TIFF file in memory.
pub(super) struct Tiff<'a> {
    bytes: &'a [u8],
    pub(super) big_endian: bool,
    /// BigTIFF: offsets of 64 bits.
    pub(super) big: bool,
}

/// An entry of a directory: type, number of values, and where they lie.
#[derive(Clone, Copy, Debug)]
struct TagEntry {
    kind: u16,
    count: u64,
    at: u64,
}

/// A directory: one image.
#[derive(Debug, Default)]
pub(super) struct Directory {
    entries: BTreeMap<u16, TagEntry>,
}

/// Why directories cannot be read.
pub(super) type Reason = String;

fn outside() -> Reason {
    "its directory points outside the file".to_owned()
}

/// Bytes of one value of a type.
fn width(kind: u16) -> Option<u64> {
    match kind {
        1 | 2 | 6 | 7 => Some(1),
        3 | 8 => Some(2),
        4 | 9 | 11 | 13 => Some(4),
        5 | 10 | 12 | 16 | 17 | 18 => Some(8),
        _ => None,
    }
}

impl<'a> Tiff<'a> {
    /// Reads the header. The first bytes are known to be one of [`super::MAGIC`].
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let big = matches!(bytes.get(2..4), Some([43, 0] | [0, 43]));
        Self { bytes, big_endian: bytes.first() == Some(&b'M'), big }
    }

    fn slice(&self, at: u64, length: u64) -> Option<&'a [u8]> {
        let start = usize::try_from(at).ok()?;
        self.bytes.get(start..start.checked_add(usize::try_from(length).ok()?)?)
    }

    /// An unsigned number of 1 to 8 bytes in the file's byte order.
    fn unsigned_at(&self, at: u64, width: u64) -> Option<u64> {
        let bytes = self.slice(at, width)?;
        let fold = |sum: u64, byte: &u8| (sum << 8) | u64::from(*byte);
        Some(if self.big_endian {
            bytes.iter().fold(0, fold)
        } else {
            bytes.iter().rev().fold(0, fold)
        })
    }

    /// All directories in their order.
    pub(super) fn directories(&self) -> Result<Vec<Directory>, Reason> {
        let (at, width) = if self.big { (8, 8) } else { (4, 4) };
        let mut next = self.unsigned_at(at, width).ok_or("it ends within its header")?;
        let mut seen = HashSet::new();
        let mut directories = Vec::new();
        let mut entries = 0;
        while next != 0 {
            if !seen.insert(next) {
                return Err("its directories run in a circle".to_owned());
            }
            if seen.len() > MAX_DIRECTORIES {
                return Err(format!("it has more than {MAX_DIRECTORIES} images"));
            }
            let (directory, after) = self.directory(next)?;
            entries += directory.entries.len();
            if entries > MAX_ENTRIES {
                return Err(format!("its directories have more than {MAX_ENTRIES} entries"));
            }
            directories.push(directory);
            next = after;
        }
        Ok(directories)
    }

    fn directory(&self, at: u64) -> Result<(Directory, u64), Reason> {
        let (count_width, entry_width, inline) = if self.big { (8, 20, 8) } else { (2, 12, 4) };
        let count = self.unsigned_at(at, count_width).ok_or_else(outside)?;
        // The number of a tag has 16 bits, and every tag stands once.
        if count > 65536 {
            return Err(format!("a directory claims {count} entries"));
        }
        let first = at + count_width;
        self.slice(first, count * entry_width).ok_or_else(outside)?;
        let mut directory = Directory::default();
        for index in 0..count {
            let entry = first + index * entry_width;
            let field = |offset, width| self.unsigned_at(entry + offset, width).ok_or_else(outside);
            let (tag, kind) = (field(0, 2)? as u16, field(2, 2)? as u16);
            let count = field(4, inline)?;
            let Some(width) = width(kind) else { continue };
            let value = 4 + inline;
            let at = if count.saturating_mul(width) <= inline {
                entry + value
            } else {
                field(value, inline)?
            };
            directory.entries.insert(tag, TagEntry { kind, count, at });
        }
        let next = self.unsigned_at(first + count * entry_width, inline).ok_or_else(outside)?;
        Ok((directory, next))
    }

    /// Where the values of a tag lie: type, number and offset, inside the file.
    fn entry(&self, directory: &Directory, tag: u16) -> Result<Option<(TagEntry, u64)>, Reason> {
        let Some(&entry) = directory.entries.get(&tag) else { return Ok(None) };
        let width = width(entry.kind).unwrap_or(1);
        let inside = self.slice(entry.at, entry.count.saturating_mul(width)).is_some();
        if inside { Ok(Some((entry, width))) } else { Err(outside()) }
    }

    /// How many values a tag has, whatever lies there.
    pub(super) fn count(&self, directory: &Directory, tag: u16) -> u64 {
        directory.entries.get(&tag).map_or(0, |entry| entry.count)
    }

    /// The unsigned values of a tag.
    pub(super) fn unsigned(
        &self,
        directory: &Directory,
        tag: u16,
    ) -> Result<Option<Vec<u64>>, Reason> {
        let Some((entry, width)) = self.entry(directory, tag)? else { return Ok(None) };
        if !matches!(entry.kind, 1 | 3 | 4 | 13 | 16 | 18) {
            return Err(format!("tag {tag} holds no unsigned numbers"));
        }
        let value = |index| self.unsigned_at(entry.at + index * width, width).ok_or_else(outside);
        (0..entry.count).map(value).collect::<Result<_, _>>().map(Some)
    }

    /// The first values of a tag that has at least so many.
    pub(super) fn first_unsigned(
        &self,
        directory: &Directory,
        tag: u16,
        count: u64,
    ) -> Result<Option<Vec<u64>>, Reason> {
        let Some(entry) = directory.entries.get(&tag) else { return Ok(None) };
        let shorter = TagEntry { count, ..*entry };
        let one = Directory { entries: BTreeMap::from([(tag, shorter)]) };
        self.unsigned(&one, tag)
    }

    /// The only value of a tag, or a default where the tag is missing.
    pub(super) fn one(&self, directory: &Directory, tag: u16, default: u64) -> Result<u64, Reason> {
        match self.unsigned(directory, tag)?.as_deref() {
            None => Ok(default),
            Some([value, rest @ ..]) if rest.iter().all(|other| other == value) => Ok(*value),
            Some(_) => Err(format!("tag {tag} holds no one number")),
        }
    }

    /// The values of a tag that holds numbers of any type.
    pub(super) fn doubles(
        &self,
        directory: &Directory,
        tag: u16,
    ) -> Result<Option<Vec<f64>>, Reason> {
        let Some((entry, width)) = self.entry(directory, tag)? else { return Ok(None) };
        if entry.count > MAX_NUMBERS {
            return Err(format!("tag {tag} holds {} numbers", entry.count));
        }
        let number = |at, width| self.unsigned_at(at, width).ok_or_else(outside);
        let value = |index| -> Result<f64, Reason> {
            let at = entry.at + index * width;
            let bits = number(at, width)?;
            Ok(match entry.kind {
                1 | 3 | 4 | 16 => bits as f64,
                6 => f64::from(bits as i8),
                8 => f64::from(bits as i16),
                9 => f64::from(bits as i32),
                17 => bits as i64 as f64,
                5 => number(at, 4)? as f64 / number(at + 4, 4)? as f64,
                11 => f64::from(f32::from_bits(bits as u32)),
                12 => f64::from_bits(bits),
                _ => return Err(format!("tag {tag} holds no numbers")),
            })
        };
        (0..entry.count).map(value).collect::<Result<_, _>>().map(Some)
    }

    /// The text of a tag, up to its end.
    pub(super) fn text(&self, directory: &Directory, tag: u16) -> Result<Option<&'a [u8]>, Reason> {
        let text = self.texts(directory, tag)?;
        Ok(text.and_then(|text| text.split(|&byte| byte == 0).next()))
    }

    /// All bytes of a tag that holds one or more texts.
    pub(super) fn texts(
        &self,
        directory: &Directory,
        tag: u16,
    ) -> Result<Option<&'a [u8]>, Reason> {
        let Some((entry, _)) = self.entry(directory, tag)? else { return Ok(None) };
        if entry.kind != 2 {
            return Err(format!("tag {tag} holds no text"));
        }
        self.slice(entry.at, entry.count).ok_or_else(outside).map(Some)
    }
}
