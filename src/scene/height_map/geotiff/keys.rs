//! GeoKeys, tie points and scales: where a GeoTIFF lies (GeoTIFF 1.1, OGC 19-008r4).

use std::collections::BTreeMap;

use glam::DVec2;

use super::super::error::MapError;
use super::super::georeference::{Coordinates, Georeference, PixelIs};
use super::directory::{Directory, Tiff, tag};
use super::image::Image;

/// Numbers of the keys that are read.
mod key {
    pub const MODEL_TYPE: u16 = 1024;
    pub const RASTER_TYPE: u16 = 1025;
    pub const CITATION: u16 = 1026;
    pub const GEODETIC_CRS: u16 = 2048;
    pub const GEODETIC_CITATION: u16 = 2049;
    pub const ANGULAR_UNITS: u16 = 2054;
    pub const ANGULAR_UNIT_SIZE: u16 = 2055;
    pub const PROJECTED_CRS: u16 = 3072;
    pub const PROJECTED_CITATION: u16 = 3073;
    pub const LINEAR_UNITS: u16 = 3076;
    pub const LINEAR_UNIT_SIZE: u16 = 3077;
    pub const VERTICAL_UNITS: u16 = 4099;
}

/// Stands for "described by other keys" where a code is expected.
const USER_DEFINED: u16 = 32767;

/// A key's value.
#[derive(Clone, Debug)]
enum Value {
    Code(u16),
    Number(f64),
    Text(String),
}

struct Keys(BTreeMap<u16, Value>);

impl Keys {
    fn read(tiff: &Tiff<'_>, directory: &Directory) -> Result<Self, String> {
        let mut keys = BTreeMap::new();
        let list = tiff.unsigned(directory, tag::GEO_KEYS)?.unwrap_or_default();
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

    fn code(&self, key: u16) -> Option<u16> {
        match self.0.get(&key) {
            Some(Value::Code(code)) => Some(*code),
            _ => None,
        }
    }

    /// A code of the EPSG register.
    fn epsg(&self, key: u16) -> Option<u16> {
        self.code(key).filter(|&code| code != 0 && code != USER_DEFINED)
    }

    fn number(&self, key: u16) -> Option<f64> {
        match self.0.get(&key) {
            Some(Value::Number(number)) if number.is_finite() && *number > 0.0 => Some(*number),
            _ => None,
        }
    }

    fn text(&self, key: u16) -> Option<&str> {
        match self.0.get(&key) {
            Some(Value::Text(text)) if !text.is_empty() => Some(text),
            _ => None,
        }
    }
}

/// A text of a file, safe to show on one line.
fn plain(text: &[u8]) -> String {
    const LONGEST: usize = 120;
    let text = String::from_utf8_lossy(text);
    let text = text.trim_matches(|c: char| c == '|' || c == '\0' || c.is_whitespace());
    text.chars().take(LONGEST).flat_map(char::escape_debug).collect()
}

/// Metres of a unit of length by its EPSG code.
fn metres(code: u16) -> Option<f64> {
    Some(match code {
        9001 => 1.0,
        9002 => 0.3048,
        9003 => 1200.0 / 3937.0,
        9005 => 0.304_797_265_4,
        9036 => 1000.0,
        9093 => 1609.344,
        _ => return None,
    })
}

/// Degrees of a unit of angle by its EPSG code.
fn degrees(code: u16) -> Option<f64> {
    Some(match code {
        9101 => 1.0_f64.to_degrees(),
        9102 => 1.0,
        9103 => 1.0 / 60.0,
        9104 => 1.0 / 3600.0,
        9105 | 9106 => 0.9,
        _ => return None,
    })
}

/// The raster's grid in its coordinates.
struct Grid {
    /// Coordinates of the corner (area) or the node (point) at raster (0, 0).
    tie: DVec2,
    /// Eastward and northward step of a column and a row; the second is negative in most files.
    step: DVec2,
}

/// The georeference, and whether the rows run north and have to be turned over.
pub(super) fn read(
    tiff: &Tiff<'_>,
    directory: &Directory,
    name: &str,
    image: &Image,
    notes: &mut Vec<String>,
) -> Result<(Georeference, bool), MapError> {
    let damaged = |reason: String| {
        MapError::new(
            name,
            format!("its georeference cannot be used: {reason}"),
            "write the file again, for example with gdal_translate IN OUT.tif",
        )
    };
    let keys = Keys::read(tiff, directory).map_err(damaged)?;
    let grid = grid(tiff, directory, name, notes)?;
    let area = keys.code(key::RASTER_TYPE) != Some(2);
    let (coordinates, factor) = coordinates(&keys, notes).map_err(damaged)?;
    let height_unit_m = keys.code(key::VERTICAL_UNITS).and_then(metres);
    if let Some(code) = keys.code(key::VERTICAL_UNITS)
        && height_unit_m.is_none()
    {
        notes.push(format!("left out: the unit of heights with EPSG code {code}"));
    }
    let citation =
        [key::PROJECTED_CITATION, key::CITATION, key::GEODETIC_CITATION].map(|key| keys.text(key));
    let mut georeference = Georeference {
        coordinates,
        epsg: keys.epsg(key::PROJECTED_CRS).or_else(|| keys.epsg(key::GEODETIC_CRS)),
        citation: citation.into_iter().flatten().next().map(str::to_owned),
        height_unit_m,
        pixel_is: Some(if area { PixelIs::Area } else { PixelIs::Point }),
        ..Georeference::unknown()
    };
    let Some(grid) = grid else { return Ok((georeference, false)) };
    let (mut tie, step) = (grid.tie * factor, grid.step * factor);
    // Nodes are the centres of samples.
    if area {
        tie += step / 2.0;
    }
    let south_up = step.y > 0.0;
    if south_up {
        tie.y += step.y * (image.rows as f64 - 1.0);
        notes.push("the rows run from south to north: turned over".to_owned());
    }
    let cell = step.abs();
    georeference.origin = Some(tie);
    georeference.cell = Some(cell);
    if let Some(reason) = georeference.nonsense(image.columns, image.rows) {
        return Err(damaged(reason));
    }
    notes.extend(georeference.assume(image.columns, image.rows));
    Ok((georeference, south_up))
}

/// What coordinates count, and the factor that makes them degrees where they are angles.
fn coordinates(keys: &Keys, notes: &mut Vec<String>) -> Result<(Coordinates, f64), String> {
    match keys.code(key::MODEL_TYPE) {
        Some(1) => {
            let code = keys.code(key::LINEAR_UNITS);
            let unit_m = match code {
                None => {
                    notes.push(
                        "the unit of the projected coordinates is not stated: metres are assumed"
                            .to_owned(),
                    );
                    1.0
                }
                Some(code) => {
                    metres(code).or_else(|| keys.number(key::LINEAR_UNIT_SIZE)).ok_or_else(
                        || format!("its unit of length has the unknown EPSG code {code}"),
                    )?
                }
            };
            Ok((Coordinates::Lengths { unit_m }, 1.0))
        }
        Some(2) => {
            let factor = match keys.code(key::ANGULAR_UNITS) {
                None => 1.0,
                Some(code) => degrees(code)
                    .or_else(|| keys.number(key::ANGULAR_UNIT_SIZE).map(f64::to_degrees))
                    .ok_or_else(|| {
                        format!("its unit of angles has the unknown EPSG code {code}")
                    })?,
            };
            Ok((Coordinates::Degrees, factor))
        }
        Some(3) => Err("its coordinates are geocentric".to_owned()),
        Some(_) | None => Ok((Coordinates::Unknown, 1.0)),
    }
}

/// Tie point and scale, or the transformation that stands for both.
fn grid(
    tiff: &Tiff<'_>,
    directory: &Directory,
    name: &str,
    notes: &mut Vec<String>,
) -> Result<Option<Grid>, MapError> {
    let damaged = |reason: String| {
        MapError::new(
            name,
            format!("its georeference cannot be used: {reason}"),
            "write the file again, for example with gdal_translate IN OUT.tif",
        )
    };
    let list = |tag| tiff.doubles(directory, tag).map_err(damaged);
    if let Some(matrix) = list(tag::TRANSFORMATION)? {
        let [a, b, _, d, e, f, _, h, ..] = matrix.as_slice() else {
            return Err(damaged("its transformation has fewer than 16 numbers".to_owned()));
        };
        if *b != 0.0 || *e != 0.0 || *a <= 0.0 {
            return Err(MapError::new(
                name,
                "its raster is rotated, sheared or mirrored against its coordinates",
                "resample it to rows that run east, for example with gdalwarp IN OUT.tif",
            ));
        }
        return Ok(Some(Grid { tie: DVec2::new(*d, *h), step: DVec2::new(*a, *f) }));
    }
    let (scale, ties) = (list(tag::PIXEL_SCALE)?, list(tag::TIE_POINTS)?);
    let (Some(scale), Some(ties)) = (&scale, &ties) else {
        if scale.is_some() || ties.is_some() {
            notes.push(
                "left out: tie points without a scale, or a scale without a tie point".to_owned(),
            );
        }
        return Ok(None);
    };
    let ([x_scale, y_scale, ..], [column, row, _, x, y, ..]) = (scale.as_slice(), ties.as_slice())
    else {
        return Err(damaged("its tie point or scale has too few numbers".to_owned()));
    };
    if *y_scale < 0.0 || *x_scale < 0.0 {
        return Err(MapError::new(
            name,
            "its scale is negative, which some programs read as south-up or mirrored, and others \
             as a slip",
            "write it with rows from north to south, for example with gdalwarp IN OUT.tif",
        ));
    }
    if ties.len() > 6 {
        notes.push("left out: all tie points but the first".to_owned());
    }
    // Row 0 lies `row` rows north of the tie point's row.
    let step = DVec2::new(*x_scale, -*y_scale);
    Ok(Some(Grid { tie: DVec2::new(*x, *y) - DVec2::new(*column, *row) * step, step }))
}
