//! Where a map lies on the Earth, and how large its cells are.

use glam::DVec2;

use crate::scene::shown::shown;

/// Semi-major axis of the WGS84 ellipsoid in metres.
const SEMI_MAJOR_M: f64 = 6_378_137.0;

/// Flattening of the WGS84 ellipsoid.
const FLATTENING: f64 = 1.0 / 298.257_223_563;

/// Nearer to a pole than this latitude, a degree of longitude says nothing about a whole map.
const POLAR: f64 = 89.9;

/// Cells of this size and more are no degrees, where a file does not say what they are.
const LARGEST_DEGREES: f64 = 0.5;

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

    /// Where the file gives a grid but not what its coordinates count: degrees if they look like
    /// degrees, metres otherwise. Returns the sentence that says so.
    pub(super) fn assume(&mut self, columns: usize, rows: usize) -> Option<String> {
        let (origin, far) = (self.origin?, self.far_corner(columns, rows)?);
        if self.coordinates != Coordinates::Unknown {
            return None;
        }
        let degrees = origin.x.abs().max(far.x.abs()) <= 360.0
            && origin.y.abs().max(far.y.abs()) <= 90.0
            && self.cell?.max_element() < LARGEST_DEGREES;
        let (coordinates, what) = if degrees {
            (Coordinates::Degrees, "they and the cells look like degrees, which are assumed")
        } else {
            (Coordinates::Lengths { unit_m: 1.0 }, "metres are assumed")
        };
        self.coordinates = coordinates;
        Some(format!("the file does not say what its coordinates count: {what}"))
    }

    /// Coordinates (east, north) of the last node, the south-east one.
    pub fn far_corner(&self, columns: usize, rows: usize) -> Option<DVec2> {
        let cell = self.cell?;
        let cells = DVec2::new(columns as f64 - 1.0, 1.0 - rows as f64);
        Some(self.origin? + cell * cells)
    }

    /// Latitude of the middle of a map in degrees.
    pub fn middle_latitude(&self, columns: usize, rows: usize) -> Option<f64> {
        if self.coordinates != Coordinates::Degrees {
            return None;
        }
        Some((self.origin?.y + self.far_corner(columns, rows)?.y) / 2.0)
    }

    /// Size of a cell (eastward, southward) in metres; of degrees, at the map's middle latitude.
    ///
    /// `None` where the file does not say, or so near to a pole that it means nothing.
    pub fn cell_m(&self, columns: usize, rows: usize) -> Option<DVec2> {
        let cell = self.cell?;
        match self.coordinates {
            Coordinates::Degrees => {
                let latitude = self.middle_latitude(columns, rows)?;
                (latitude.abs() <= POLAR).then(|| cell * degree_m(latitude))
            }
            Coordinates::Lengths { unit_m } => Some(cell * unit_m),
            Coordinates::Unknown => None,
        }
    }
}

/// Metres of a degree of longitude and of latitude at a latitude in degrees, on WGS84.
///
/// With e² = f(2 - f) and s = sin φ, the meridian's radius of curvature is
/// M = a(1 - e²)/(1 - e²s²)^(3/2), that of the prime vertical N = a/√(1 - e²s²), and a circle of
/// latitude has the radius N cos φ.
pub fn degree_m(latitude: f64) -> DVec2 {
    let e2 = FLATTENING * (2.0 - FLATTENING);
    let (sin, cos) = (libm::sin(latitude.to_radians()), libm::cos(latitude.to_radians()));
    let w = 1.0 - e2 * sin * sin;
    let meridian = SEMI_MAJOR_M * (1.0 - e2) / (w * w.sqrt());
    let parallel = SEMI_MAJOR_M / w.sqrt() * cos;
    DVec2::new(parallel, meridian) * 1.0_f64.to_radians()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_are_as_long_as_tables_say() {
        // Published lengths in km, to the metre.
        for (latitude, up, along) in [
            (0.0, 110_574.0, 111_320.0),
            (15.0, 110_649.0, 107_551.0),
            (30.0, 110_852.0, 96_486.0),
            (45.0, 111_132.0, 78_847.0),
            (60.0, 111_412.0, 55_800.0),
            (75.0, 111_618.0, 28_902.0),
            (90.0, 111_694.0, 0.0),
        ] {
            let degree = degree_m(latitude);
            assert!((degree.x - along).abs() < 0.6, "{latitude}: {degree}");
            assert!((degree.y - up).abs() < 0.6, "{latitude}: {degree}");
            assert_eq!(degree_m(-latitude), degree);
        }
    }

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
        assert_eq!(georeference.cell_m(3, 2), Some(DVec2::new(2.0, 1.0) * degree_m(88.5)));
        georeference.origin = Some(DVec2::new(10.0, 90.45));
        assert_eq!(georeference.cell_m(3, 2), None);
    }
}
