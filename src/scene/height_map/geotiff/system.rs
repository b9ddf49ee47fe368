//! The coordinate system of a GeoTIFF: what its coordinates and heights count, in any of the ways
//! in which a file may state it.

use super::super::epsg;
use super::super::georeference::{Coordinates, Georeference, PixelIs};
use super::super::projection::{Cylindrical, Ellipsoid, Method, Projection};
use super::super::unit;
use super::super::wkt::{self, System};
use super::keys::{Keys, USER_DEFINED, key};
use super::metadata::Metadata;
use crate::scene::shown::shorten;

/// Reads what is known without the grid.
///
/// An error is a reason.
pub(super) fn read(
    keys: &Keys,
    metadata: &Metadata,
    notes: &mut Vec<String>,
) -> Result<(Georeference, f64), String> {
    let citations =
        [key::PROJECTED_CITATION, key::CITATION, key::GEODETIC_CITATION, key::VERTICAL_CITATION];
    let texts: Vec<&str> = citations.iter().filter_map(|&key| keys.text(key)).collect();
    let text = texts.iter().find_map(|text| wkt::read(text)).unwrap_or_default();
    let described = Described { keys, text: &text };
    let (coordinates, factor) = described.coordinates(notes)?;
    let epsg = keys.epsg(key::PROJECTED_CRS).or_else(|| keys.epsg(key::GEODETIC_CRS));
    let citation = citations[..3].iter().find_map(|&key| keys.text(key));
    let citation = if text.name.is_empty() { citation } else { Some(text.name.as_str()) };
    let georeference = Georeference {
        coordinates,
        projection: described.projection(),
        ellipsoid: described.ellipsoid(),
        epsg,
        citation: citation.map(shorten),
        height_unit_m: described.height_unit_m(metadata, notes),
        pixel_is: Some(if keys.area() { PixelIs::Area } else { PixelIs::Point }),
        ..Georeference::unknown()
    };
    Ok((georeference, factor))
}

struct Described<'a> {
    keys: &'a Keys,
    /// The system as text, as far as there is one.
    text: &'a System,
}

/// Kinds of coordinates (key 1024).
enum Model {
    Projected,
    Geographic,
    Geocentric,
    Unknown,
}

impl Described<'_> {
    /// As stated, or as the other keys have it.
    fn model(&self) -> Model {
        let keys = self.keys;
        match keys.code(key::MODEL_TYPE) {
            Some(1) => Model::Projected,
            Some(2) => Model::Geographic,
            Some(3) => Model::Geocentric,
            _ if keys.code(key::PROJECTED_CRS).is_some()
                || keys.code(key::LINEAR_UNITS).is_some()
                || self.text.length_m.is_some() =>
            {
                Model::Projected
            }
            _ if keys.epsg(key::GEODETIC_CRS).is_some_and(epsg::is_geographic)
                || keys.code(key::ANGULAR_UNITS).is_some()
                || self.text.angle_deg.is_some() =>
            {
                Model::Geographic
            }
            _ => Model::Unknown,
        }
    }

    /// What coordinates count, and the factor that makes them degrees where they are angles.
    fn coordinates(&self, notes: &mut Vec<String>) -> Result<(Coordinates, f64), String> {
        match self.model() {
            Model::Projected => {
                let unit_m = self.length_unit_m().unwrap_or_else(|| {
                    let code = self.keys.epsg(key::LINEAR_UNITS);
                    notes.push(match code {
                        Some(code) => format!(
                            "its unit of length has the EPSG code {code}, which is not known here: \
                             metres are assumed (--unit settles it)"
                        ),
                        None => "the unit of the projected coordinates is not stated: metres are \
                                 assumed (--unit settles it)"
                            .to_owned(),
                    });
                    1.0
                });
                Ok((Coordinates::Lengths { unit_m }, 1.0))
            }
            Model::Geographic => {
                let factor = self.angle_unit_deg().unwrap_or_else(|| {
                    notes.push(
                        "its unit of angles is not known here: degrees are assumed".to_owned(),
                    );
                    1.0
                });
                Ok((Coordinates::Degrees, factor))
            }
            Model::Geocentric => Err("its coordinates are geocentric".to_owned()),
            Model::Unknown => Ok((Coordinates::Unknown, 1.0)),
        }
    }

    fn length_unit_m(&self) -> Option<f64> {
        let keys = self.keys;
        let stated = keys.code(key::LINEAR_UNITS).filter(|&code| code != USER_DEFINED && code != 0);
        let by_text = || {
            let named = [key::PROJECTED_CITATION, key::CITATION];
            let named = named.iter().filter_map(|&key| keys.text(key));
            self.text.length_m.or_else(|| named.map(unit_of_plan).find_map(|unit| unit))
        };
        match stated {
            Some(code) => epsg::metres(code).or_else(|| keys.size(key::LINEAR_UNIT_SIZE)),
            None => keys
                .size(key::LINEAR_UNIT_SIZE)
                .or_else(|| keys.epsg(key::PROJECTED_CRS).and_then(epsg::projected_unit_m))
                .or_else(by_text),
        }
    }

    fn angle_unit_deg(&self) -> Option<f64> {
        let keys = self.keys;
        let size = || keys.size(key::ANGULAR_UNIT_SIZE).map(f64::to_degrees);
        match keys.code(key::ANGULAR_UNITS).filter(|&code| code != 0) {
            Some(code) => epsg::degrees(code).or_else(size).or(self.text.angle_deg),
            None => {
                let code = keys.epsg(key::GEODETIC_CRS).map(epsg::geographic_unit);
                size().or(code).or(self.text.angle_deg).or(Some(1.0))
            }
        }
    }

    fn ellipsoid(&self) -> Ellipsoid {
        let keys = self.keys;
        let stated = keys.size(key::SEMI_MAJOR).and_then(|semi_major_m| {
            let by_minor = || {
                let minor = keys.size(key::SEMI_MINOR).filter(|&minor| minor < semi_major_m);
                minor.map_or(0.0, |minor| semi_major_m / (semi_major_m - minor))
            };
            let inverse = keys.number(key::INVERSE_FLATTENING).unwrap_or_else(by_minor);
            wkt::ellipsoid(semi_major_m, inverse)
        });
        stated.or(self.text.ellipsoid).unwrap_or(Ellipsoid::WGS84)
    }

    /// How lengths relate to lengths on the ground.
    fn projection(&self) -> Projection {
        let keys = self.keys;
        if let Some(code) = keys.epsg(key::PROJECTED_CRS) {
            return epsg::projection(code);
        }
        if let Some(projection) = &self.text.projection {
            return projection.clone();
        }
        // Methods by their numbers in GeoTIFF.
        let method = match keys.code(key::METHOD) {
            Some(7) => Method::Mercator,
            Some(17) => Method::Equirectangular,
            Some(8) if self.has_wide_parallels() => {
                return Projection::Distorted("Lambert conic of wide parallels".to_owned());
            }
            Some(other) => {
                let name = match other {
                    10 => "Lambert azimuthal equal-area",
                    11 => "Albers equal-area",
                    12 => "azimuthal equidistant",
                    13 => "equidistant conic",
                    14 | 15 => "polar stereographic",
                    19 => "gnomonic",
                    20 => "Miller cylindrical",
                    21 => "orthographic",
                    22 => "polyconic",
                    23 => "Robinson",
                    24 => "sinusoidal",
                    25 => "Van der Grinten",
                    28 => "cylindrical equal-area",
                    _ => return Projection::TrueToScale,
                };
                return Projection::Distorted(name.to_owned());
            }
            None => return Projection::TrueToScale,
        };
        let unit = self.angle_unit_deg().unwrap_or(1.0);
        let degrees = |key| keys.number(key).map(|angle| angle * unit);
        // Mercator's latitude of origin is that of true scale, as other readers have it.
        let latitude = degrees(key::ORIGIN_LATITUDE).or_else(|| degrees(key::CENTER_LATITUDE));
        Projection::Cylindrical(Cylindrical {
            method,
            scale: keys.size(key::SCALE_AT_ORIGIN).unwrap_or(1.0),
            standard_parallel: degrees(key::STANDARD_PARALLEL)
                .or_else(|| latitude.filter(|_| method == Method::Mercator))
                .unwrap_or(0.0),
            origin_latitude: latitude.unwrap_or(0.0),
            false_northing: keys.number(key::FALSE_NORTHING).unwrap_or(0.0)
                * self.length_unit_m().unwrap_or(1.0),
        })
    }

    /// Whether the standard parallels of a conic lie far apart.
    fn has_wide_parallels(&self) -> bool {
        let keys = self.keys;
        let unit = self.angle_unit_deg().unwrap_or(1.0);
        let first = keys.number(key::STANDARD_PARALLEL);
        let apart = first.zip(keys.number(key::SECOND_PARALLEL)).map(|(a, b)| (a - b).abs() * unit);
        apart.is_some_and(|apart| apart > wkt::WIDE_PARALLELS)
    }

    /// Metres of the unit of heights: of the band, of the vertical system, or as text.
    fn height_unit_m(&self, metadata: &Metadata, notes: &mut Vec<String>) -> Option<f64> {
        let keys = self.keys;
        let code = keys.epsg(key::VERTICAL_CRS);
        let vertical = code.and_then(epsg::vertical);
        if let (Some(code), Some(true)) = (code, vertical.as_ref().map(|found| found.is_depth)) {
            notes.push(format!(
                "its vertical system EPSG:{code} counts downwards: where the samples are depths, \
                 the relief is upside down"
            ));
        }
        let stated = keys.epsg(key::VERTICAL_UNITS);
        if let Some(code) = stated.filter(|&code| epsg::metres(code).is_none()) {
            notes.push(format!(
                "its unit of heights has the EPSG code {code}, which is not known here: \
                 --height-unit settles it"
            ));
        }
        let by_keys = stated
            .and_then(epsg::metres)
            .or_else(|| vertical.map(|found| found.unit_m))
            .or(self.text.height_m)
            .or_else(|| keys.text(key::VERTICAL_CITATION).and_then(unit_in_brackets))
            .or_else(|| keys.text(key::CITATION).and_then(unit_of_heights))
            .or_else(|| {
                let codes = [keys.epsg(key::GEODETIC_CRS), code];
                let solid = codes.into_iter().flatten().any(epsg::has_heights);
                solid.then_some(1.0)
            });
        let by_band = metadata.unit.as_deref().and_then(unit::metres);
        if let (Some(band), Some(system)) = (by_band, by_keys)
            && (band / system - 1.0).abs() > 1e-5
        {
            notes.push(format!(
                "the band states {} as the unit of heights, the coordinate system {}: the band's \
                 counts (--height-unit settles it)",
                unit::name(band),
                unit::name(system)
            ));
        }
        by_band.or(by_keys)
    }
}

/// The unit of the plan in a citation: `LUnits = foot` of ERDAS and GDAL, or in brackets at the
/// end of the name, as the EPSG register has it.
fn unit_of_plan(citation: &str) -> Option<f64> {
    let units = citation.split(['|', '\n']).find_map(|part| {
        let (name, value) = part.split_once('=')?;
        matches!(name.trim(), "LUnits" | "Units").then(|| value.trim())
    });
    let plan = citation.split(" + ").next()?;
    units.and_then(unit::metres).or_else(|| unit_in_brackets(plan))
}

/// The unit of heights in the name of a compound system.
fn unit_of_heights(citation: &str) -> Option<f64> {
    unit_in_brackets(citation.split_once(" + ")?.1)
}

fn unit_in_brackets(name: &str) -> Option<f64> {
    let (_, unit) = name.trim().strip_suffix(')')?.rsplit_once('(')?;
    unit::metres(unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_in_citations() {
        let foot = unit::metres("us-ft");
        assert_eq!(unit_of_plan("NAD83 / California zone 3 (ftUS)"), foot);
        assert_eq!(unit_of_plan("PCS Name = x|LUnits = U.S. survey foot"), foot);
        assert_eq!(unit_of_plan("IMAGINE GeoTIFF Support\nUnits = US Survey Feet\nx"), foot);
        assert_eq!(unit_of_plan("A (m) + NAVD88 height (ftUS)"), Some(1.0));
        assert_eq!(unit_of_heights("A (m) + NAVD88 height (ftUS)"), foot);
        assert_eq!(unit_of_heights("NAVD88 height (ftUS)"), None);
        assert_eq!(unit_of_plan("NAD83(2011) / UTM zone 13N"), None);
    }
}
