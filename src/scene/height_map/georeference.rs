//! Where a map lies on the Earth, and how large its cells are.

use glam::DVec2;

use super::interpretation::{CoordinateUnit, Interpretation};
use super::projection::{Ellipsoid, Projection};
use super::unit;
use crate::scene::shown::shown;

/// Nearer to a pole than this latitude, a degree of longitude says nothing about a whole map.
const POLAR: f64 = 89.9;

/// Cells of level ground are taken for degrees below this size, where a file does not say.
const LARGEST_DEGREES: f64 = 0.5;

/// Cells at an edge that differ from those in the middle by more than this share are mentioned.
const UNEVEN: f64 = 0.05;

/// What the coordinates of a map count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coordinates {
    /// Degrees of longitude and latitude.
    Degrees,
    /// Lengths on a projected plane, with the metres of one unit.
    Lengths {
        /// Metres per unit.
        unit_m: f64,
    },
    /// The file does not say.
    Unknown,
}

/// What the tie point of a raster is tied to. Nodes lie at sample centres either way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelIs {
    /// Samples stand for areas; the tie point is a corner of one.
    Area,
    /// Samples stand for points.
    Point,
}

impl PixelIs {
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Area => "area",
            Self::Point => "point",
        }
    }
}

/// Place and cell of a map, as far as its file says.
#[derive(Clone, Debug, PartialEq)]
pub struct Georeference {
    /// What the coordinates count.
    pub coordinates: Coordinates,
    /// How lengths of the coordinates relate to lengths on the ground.
    pub projection: Projection,
    /// The body that the map is of.
    pub ellipsoid: Ellipsoid,
    /// EPSG code of the coordinate reference system.
    pub epsg: Option<u16>,
    /// Name of the coordinate reference system.
    pub citation: Option<String>,
    /// Coordinates (east, north) of node (0, 0), the north-west one.
    pub origin: Option<DVec2>,
    /// Size of a cell (eastward, southward) in units of the coordinates, both positive.
    pub cell: Option<DVec2>,
    /// Metres per unit of height.
    pub height_unit_m: Option<f64>,
    /// What samples stand for.
    pub pixel_is: Option<PixelIs>,
}

impl Georeference {
    /// Of a file that says nothing.
    pub fn unknown() -> Self {
        Self {
            coordinates: Coordinates::Unknown,
            projection: Projection::TrueToScale,
            ellipsoid: Ellipsoid::WGS84,
            epsg: None,
            citation: None,
            origin: None,
            cell: None,
            height_unit_m: None,
            pixel_is: None,
        }
    }

    /// Why a map cannot lie there, where it cannot: places and cells that are no numbers, or that are
    /// nowhere on the Earth.
    pub(super) fn nonsense(&self, columns: usize, rows: usize) -> Option<String> {
        let (origin, far, cell) = (self.origin?, self.far_corner(columns, rows)?, self.cell?);
        let metres = match self.coordinates {
            Coordinates::Lengths { unit_m } => cell * unit_m,
            Coordinates::Degrees | Coordinates::Unknown => cell,
        };
        let are_numbers = origin.is_finite() && far.is_finite() && metres.is_finite();
        if !are_numbers || cell.min_element() <= 0.0 {
            return Some("it puts nodes beyond all numbers".to_owned());
        }
        if self.coordinates != Coordinates::Degrees {
            return None;
        }
        if cell.x > 360.0 {
            return Some(format!("it claims cells of {} degrees", shown(cell.x)));
        }
        // A hair beyond a pole is the half cell by which areas reach over.
        let (north, south) = (shown(origin.y), shown(far.y));
        (origin.y > 91.0 || far.y < -91.0)
            .then(|| format!("it claims latitudes from {south} to {north} degrees"))
    }

    /// Settles what the file leaves open: as the user says, or else by a guess that is told.
    ///
    /// `relief` is the difference of the highest and the lowest sample.
    pub(super) fn settle(
        &mut self,
        (columns, rows): (usize, usize),
        relief: f64,
        asked: &Interpretation,
        notes: &mut Vec<String>,
    ) {
        if let Some(unit) = asked.unit {
            let before = self.coordinates;
            self.coordinates = match unit {
                CoordinateUnit::Degrees => Coordinates::Degrees,
                CoordinateUnit::Length(unit_m) => Coordinates::Lengths { unit_m },
            };
            if before != Coordinates::Unknown && before != self.coordinates {
                notes.push(format!(
                    "coordinates are taken as {}, as asked for; the file has {}",
                    counted(self.coordinates),
                    counted(before)
                ));
            }
        } else if self.coordinates == Coordinates::Unknown {
            notes.extend(self.guess(columns, rows, relief));
        }
        if let Some(unit_m) = asked.height_unit_m {
            if let Some(before) = self.height_unit_m.filter(|&before| before != unit_m) {
                notes.push(format!(
                    "heights are taken as {}, as asked for; the file has {}",
                    unit::name(unit_m),
                    unit::name(before)
                ));
            }
            self.height_unit_m = Some(unit_m);
        }
        notes.extend(self.ground_remark(columns, rows));
    }

    /// The sentence for a file that does not state the unit of heights.
    pub fn height_unit_remark(&self) -> Option<String> {
        let plan = match self.coordinates {
            Coordinates::Lengths { unit_m } if unit_m != 1.0 => {
                format!(", though coordinates are {}", unit::name(unit_m))
            }
            _ => String::new(),
        };
        self.height_unit_m.is_none().then(|| {
            format!(
                "the unit of heights is not stated: metres are assumed{plan} (--height-unit ft, or \
                 another, settles it)"
            )
        })
    }

    /// Where the file gives a grid but not what its coordinates count: what is likelier of degrees
    /// and metres. Returns the sentence that says so.
    ///
    /// Ground that rises by more than its own width is none, and a degree is some 100 km wide: so
    /// samples in metres rise by more units than a map has degrees, and by fewer than it has metres.
    fn guess(&mut self, columns: usize, rows: usize, relief: f64) -> Option<String> {
        let (origin, far, cell) = (self.origin?, self.far_corner(columns, rows)?, self.cell?);
        let on_the_globe = origin.x.abs().max(far.x.abs()) <= 360.0
            && origin.y.abs().max(far.y.abs()) <= 90.0
            && (origin - far).abs().x <= 360.0;
        let longer = (origin - far).abs().max_element() + cell.max_element();
        let too_steep = relief > longer;
        let level = relief <= 0.0 && cell.max_element() < LARGEST_DEGREES;
        let (coordinates, what) = if on_the_globe && (too_steep || level) {
            (Coordinates::Degrees, "they and the relief look like degrees, which are assumed")
        } else {
            (Coordinates::Lengths { unit_m: 1.0 }, "metres are assumed")
        };
        self.coordinates = coordinates;
        Some(format!(
            "the file does not say what its coordinates count: {what} (--unit deg, m or ft settles it)"
        ))
    }

    /// What there is to say of lengths on the ground.
    pub(super) fn ground_remark(&self, columns: usize, rows: usize) -> Option<String> {
        let lengths = matches!(self.coordinates, Coordinates::Lengths { .. });
        if let (true, Projection::Distorted(name)) = (lengths, &self.projection) {
            return Some(format!(
                "lengths of its projection ({name}) are not lengths on the ground, which cells are \
                 taken for: they may be off by some per cent; gdalwarp -t_srs with a local \
                 projection such as UTM makes them true"
            ));
        }
        let body = (!self.ellipsoid.is_earth()).then(|| {
            format!(
                "the map is not of the Earth: its body has a radius of {} km",
                shown(self.ellipsoid.semi_major_m / 1e3)
            )
        });
        let (north, south) = (self.origin?.y, self.far_corner(columns, rows)?.y);
        let middle = self.cell_at_m((north + south) / 2.0)?;
        let off = |northing: f64| {
            let cell = self.cell_at_m(northing).unwrap_or(DVec2::ZERO);
            let off = cell / middle - 1.0;
            if off.x.abs() > off.y.abs() { off.x } else { off.y }
        };
        let (north, south) = (off(north), off(south));
        let uneven = (north.abs().max(south.abs()) > UNEVEN).then(|| {
            format!(
                "cells are taken as in the middle of the map; on the ground they are {} at its \
                 north edge and {} at its south edge",
                compared(north),
                compared(south)
            )
        });
        let remarks: Vec<String> = body.into_iter().chain(uneven).collect();
        (!remarks.is_empty()).then(|| remarks.join("; "))
    }

    /// Coordinates (east, north) of the last node, the south-east one.
    pub fn far_corner(&self, columns: usize, rows: usize) -> Option<DVec2> {
        let cell = self.cell?;
        let cells = DVec2::new(columns as f64 - 1.0, 1.0 - rows as f64);
        Some(self.origin? + cell * cells)
    }

    /// Latitude of the middle of a map in degrees, where cells depend on it.
    pub fn middle_latitude(&self, columns: usize, rows: usize) -> Option<f64> {
        self.latitude((self.origin?.y + self.far_corner(columns, rows)?.y) / 2.0)
    }

    /// Latitude of a northing in degrees, where the coordinates tell it.
    fn latitude(&self, northing: f64) -> Option<f64> {
        match (self.coordinates, &self.projection) {
            (Coordinates::Degrees, _) => Some(northing),
            (Coordinates::Lengths { unit_m }, Projection::Cylindrical(projection)) => {
                Some(projection.latitude(northing * unit_m, self.ellipsoid))
            }
            _ => None,
        }
    }

    /// Size of a cell (eastward, southward) in metres on the ground; where it depends on the
    /// latitude, in the middle of the map.
    ///
    /// `None` where the file does not say, or so near to a pole that it means nothing.
    pub fn cell_m(&self, columns: usize, rows: usize) -> Option<DVec2> {
        match (self.coordinates, &self.projection) {
            (
                Coordinates::Lengths { unit_m },
                Projection::TrueToScale | Projection::Distorted(_),
            ) => Some(self.cell? * unit_m),
            _ => self.cell_at_m((self.origin?.y + self.far_corner(columns, rows)?.y) / 2.0),
        }
    }

    /// Size of a cell at a northing, where it depends on it.
    fn cell_at_m(&self, northing: f64) -> Option<DVec2> {
        let (cell, latitude) = (self.cell?, self.latitude(northing)?);
        let metres = match (self.coordinates, &self.projection) {
            (Coordinates::Lengths { unit_m }, Projection::Cylindrical(projection)) => {
                unit_m * projection.ground(latitude, self.ellipsoid)
            }
            _ => self.ellipsoid.degree_m(latitude),
        };
        (latitude.abs() <= POLAR).then(|| cell * metres)
    }
}

/// What coordinates count, in words.
fn counted(coordinates: Coordinates) -> String {
    match coordinates {
        Coordinates::Degrees => "degrees".to_owned(),
        Coordinates::Lengths { unit_m } => unit::name(unit_m),
        Coordinates::Unknown => "nothing".to_owned(),
    }
}

/// "12 % smaller".
fn compared(off: f64) -> String {
    format!("{:.0} % {}", 100.0 * off.abs(), if off < 0.0 { "smaller" } else { "larger" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_in_metres() {
        let mut georeference = Georeference {
            coordinates: Coordinates::Lengths { unit_m: 0.5 },
            origin: Some(DVec2::new(10.0, 89.0)),
            cell: Some(DVec2::new(2.0, 1.0)),
            ..Georeference::unknown()
        };
        assert_eq!(georeference.cell_m(3, 2), Some(DVec2::new(1.0, 0.5)));
        assert_eq!(georeference.far_corner(3, 2), Some(DVec2::new(14.0, 88.0)));
        georeference.coordinates = Coordinates::Degrees;
        assert_eq!(georeference.middle_latitude(3, 2), Some(88.5));
        assert_eq!(
            georeference.cell_m(3, 2),
            Some(DVec2::new(2.0, 1.0) * Ellipsoid::WGS84.degree_m(88.5))
        );
        georeference.origin = Some(DVec2::new(10.0, 90.45));
        assert_eq!(georeference.cell_m(3, 2), None);
    }
}
