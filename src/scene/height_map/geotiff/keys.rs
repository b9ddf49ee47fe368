//! GeoKeys: what a GeoTIFF says of its coordinates (GeoTIFF 1.1, OGC 19-008r4).

use std::collections::BTreeMap;

use super::directory::{Directory, Tiff, tag};

/// Numbers of the keys that are read.
pub(super) mod key {
    pub const MODEL_TYPE: u16 = 1024;
    pub const RASTER_TYPE: u16 = 1025;
    pub const CITATION: u16 = 1026;
    pub const GEODETIC_CRS: u16 = 2048;
    pub const GEODETIC_CITATION: u16 = 2049;
    pub const ANGULAR_UNITS: u16 = 2054;
    pub const ANGULAR_UNIT_SIZE: u16 = 2055;
    pub const SEMI_MAJOR: u16 = 2057;
    pub const SEMI_MINOR: u16 = 2058;
    pub const INVERSE_FLATTENING: u16 = 2059;
    pub const PROJECTED_CRS: u16 = 3072;
    pub const PROJECTED_CITATION: u16 = 3073;
    pub const METHOD: u16 = 3075;
    pub const LINEAR_UNITS: u16 = 3076;
    pub const LINEAR_UNIT_SIZE: u16 = 3077;
    pub const STANDARD_PARALLEL: u16 = 3078;
    pub const SECOND_PARALLEL: u16 = 3079;
    pub const ORIGIN_LATITUDE: u16 = 3081;
    pub const FALSE_NORTHING: u16 = 3083;
    pub const CENTER_LATITUDE: u16 = 3089;
    pub const SCALE_AT_ORIGIN: u16 = 3092;
    pub const VERTICAL_CRS: u16 = 4096;
    pub const VERTICAL_CITATION: u16 = 4097;
    pub const VERTICAL_UNITS: u16 = 4099;
}

/// Stands for "described by other keys" where a code is expected.
pub(super) const USER_DEFINED: u16 = 32767;

/// A key's value.
#[derive(Clone, Debug)]
enum Value {
    Code(u16),
    Number(f64),
    Text(String),
}

pub(super) struct Keys(BTreeMap<u16, Value>);

impl Keys {
    pub(super) fn read(tiff: &Tiff<'_>, directory: &Directory) -> Result<Self, String> {
        let mut keys = BTreeMap::new();
        let length = tiff.count(directory, tag::GEO_KEYS).min(u64::from(u16::MAX));
        let list = tiff.first_unsigned(directory, tag::GEO_KEYS, length)?.unwrap_or_default();
        let doubles = tiff.doubles(directory, tag::GEO_DOUBLES)?.unwrap_or_default();
        let texts = tiff.texts(directory, tag::GEO_TEXTS)?.unwrap_or_default();
        // A header of four numbers, whose last is the number of keys, then four numbers a key.
        let count = list.get(3).copied().unwrap_or(0) as usize;
        let (entries, _) = list.get(4..).unwrap_or_default().as_chunks::<4>();
        for &[id, location, length, value] in entries.iter().take(count) {
            let at = value as usize;
            let read = match location {
                0 => Some(Value::Code(value as u16)),
                l if l == u64::from(tag::GEO_DOUBLES) => {
                    doubles.get(at).map(|&number| Value::Number(number))
                }
                l if l == u64::from(tag::GEO_TEXTS) => {
                    let text = at.checked_add(length as usize).and_then(|end| texts.get(at..end));
                    text.map(|text| Value::Text(plain(text)))
                }
                _ => None,
            };
            if let Some(read) = read {
                keys.insert(id as u16, read);
            }
        }
        Ok(Self(keys))
    }

    pub(super) fn code(&self, key: u16) -> Option<u16> {
        match self.0.get(&key) {
            Some(Value::Code(code)) => Some(*code),
            _ => None,
        }
    }

    /// A code of the EPSG register.
    pub(super) fn epsg(&self, key: u16) -> Option<u16> {
        self.code(key).filter(|&code| code != 0 && code != USER_DEFINED)
    }

    pub(super) fn number(&self, key: u16) -> Option<f64> {
        match self.0.get(&key) {
            Some(Value::Number(number)) if number.is_finite() => Some(*number),
            _ => None,
        }
    }

    /// A size, which is above 0.
    pub(super) fn size(&self, key: u16) -> Option<f64> {
        self.number(key).filter(|&size| size > 0.0)
    }

    pub(super) fn text(&self, key: u16) -> Option<&str> {
        match self.0.get(&key) {
            Some(Value::Text(text)) if !text.is_empty() => Some(text),
            _ => None,
        }
    }

    /// Whether samples stand for areas, and their tie points for corners.
    pub(super) fn area(&self) -> bool {
        self.code(key::RASTER_TYPE) != Some(2)
    }
}

/// A text of a file without its end marks.
fn plain(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    text.trim_matches(|c: char| c == '|' || c == '\0' || c.is_whitespace()).to_owned()
}
