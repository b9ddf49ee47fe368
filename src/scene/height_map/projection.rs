//! How lengths of a projection relate to lengths on the ground.

use glam::DVec2;

/// An ellipsoid of revolution: the figure of the Earth, or of another body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// Radius of the equator in metres.
    pub semi_major_m: f64,
    /// (a − b)/a; 0 of a sphere.
    pub flattening: f64,
}

impl Ellipsoid {
    /// Of the World Geodetic System 1984.
    pub const WGS84: Self = Self { semi_major_m: 6_378_137.0, flattening: 1.0 / 298.257_223_563 };

    /// The square of the eccentricity, e² = f(2 − f).
    fn eccentricity_squared(self) -> f64 {
        self.flattening * (2.0 - self.flattening)
    }

    /// Metres of a radian of longitude and of latitude, at a latitude in radians.
    ///
    /// With s = sin φ, the meridian's radius of curvature is M = a(1 − e²)/(1 − e²s²)^(3/2), that
    /// of the prime vertical N = a/√(1 − e²s²), and a circle of latitude has the radius N cos φ.
    fn radian_m(self, latitude: f64) -> DVec2 {
        let e2 = self.eccentricity_squared();
        let sin = libm::sin(latitude);
        let w = 1.0 - e2 * sin * sin;
        let meridian = self.semi_major_m * (1.0 - e2) / (w * w.sqrt());
        let parallel = self.semi_major_m / w.sqrt() * libm::cos(latitude);
        DVec2::new(parallel, meridian)
    }

    /// Metres of a degree of longitude and of latitude, at a latitude in degrees.
    pub fn degree_m(self, latitude: f64) -> DVec2 {
        self.radian_m(latitude.to_radians()) * 1.0_f64.to_radians()
    }

    /// Whether it is of the size of the Earth, within 1 %.
    pub(super) fn is_earth(self) -> bool {
        (self.semi_major_m / Self::WGS84.semi_major_m - 1.0).abs() < 0.01
    }
}

/// How lengths of a projection relate to lengths on the ground.
#[derive(Clone, Debug, PartialEq)]
pub enum Projection {
    /// They are the same within a few per mille, where such a projection is used.
    TrueToScale,
    /// They differ with the latitude, by a formula.
    Cylindrical(Cylindrical),
    /// They differ, nobody says here how much; the name of the projection.
    Distorted(String),
}

/// Methods of [`Cylindrical`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Conformal.
    Mercator,
    /// The formulas of the sphere for geodetic latitudes, as web maps have it.
    SphericalMercator,
    /// Latitudes at equal distances, also called plate carrée.
    Equirectangular,
}

/// A cylindrical projection along the equator (IOGP Guidance Note 7-2, 3.5.1 and 3.2.5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylindrical {
    /// Which one.
    pub method: Method,
    /// Scale at the equator, k₀.
    pub scale: f64,
    /// Latitude that is true to scale where it is not the equator, in degrees.
    pub standard_parallel: f64,
    /// Latitude at which northings count from `false_northing`, of equirectangular projections, in
    /// degrees; of others it is the equator.
    pub origin_latitude: f64,
    /// Northing there in metres.
    pub false_northing: f64,
}

impl Cylindrical {
    /// The latitude of a northing in metres, in degrees.
    pub fn latitude(&self, northing: f64, ellipsoid: Ellipsoid) -> f64 {
        let a = ellipsoid.semi_major_m;
        let y = northing - self.false_northing;
        if self.method == Method::Equirectangular {
            return self.origin_latitude + (y / a).to_degrees();
        }
        let e = if self.method == Method::Mercator {
            ellipsoid.eccentricity_squared().sqrt()
        } else {
            0.0
        };
        // tan(π/4 + φ/2)·((1 − e sin φ)/(1 + e sin φ))^(e/2) = exp(y/ak₀), by iteration.
        let t = libm::exp(-y / (a * self.equator_scale(ellipsoid)));
        let mut latitude = 0.0_f64;
        for _ in 0..8 {
            let sin = e * libm::sin(latitude);
            let bend = libm::pow((1.0 - sin) / (1.0 + sin), e / 2.0);
            latitude = std::f64::consts::FRAC_PI_2 - 2.0 * libm::atan(t * bend);
        }
        latitude.to_degrees()
    }

    /// Scale at the equator, from the standard parallel where there is one.
    fn equator_scale(&self, ellipsoid: Ellipsoid) -> f64 {
        let parallel = ellipsoid.radian_m(self.standard_parallel.to_radians()).x;
        match self.method {
            Method::Mercator => self.scale * parallel / ellipsoid.semi_major_m,
            _ => self.scale * libm::cos(self.standard_parallel.to_radians()),
        }
    }

    /// Metres on the ground of a metre of the projection, eastward and northward, at a latitude in
    /// degrees.
    pub fn ground(&self, latitude: f64, ellipsoid: Ellipsoid) -> DVec2 {
        let latitude = latitude.to_radians();
        let ground = ellipsoid.radian_m(latitude);
        let equator = ellipsoid.semi_major_m * self.equator_scale(ellipsoid);
        // Metres of the projection for a radian of longitude and of latitude.
        let projected = match self.method {
            Method::Mercator => DVec2::new(equator, equator * ground.y / ground.x),
            Method::SphericalMercator => DVec2::new(equator, equator / libm::cos(latitude)),
            Method::Equirectangular => DVec2::new(equator, ellipsoid.semi_major_m),
        };
        ground / projected
    }
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
            let degree = Ellipsoid::WGS84.degree_m(latitude);
            assert!((degree.x - along).abs() < 0.6, "{latitude}: {degree}");
            assert!((degree.y - up).abs() < 0.6, "{latitude}: {degree}");
            assert_eq!(Ellipsoid::WGS84.degree_m(-latitude), degree);
        }
        let moon = Ellipsoid { semi_major_m: 1_737_400.0, flattening: 0.0 }.degree_m(60.0);
        assert!((moon - DVec2::new(15_161.68, 30_323.35)).length() < 0.01, "{moon}");
    }

    fn cylindrical(method: Method) -> Cylindrical {
        Cylindrical {
            method,
            scale: 1.0,
            standard_parallel: 0.0,
            origin_latitude: 0.0,
            false_northing: 0.0,
        }
    }

    #[test]
    fn northings_of_known_places() {
        // Northings of 60° N by PROJ 9.5.
        for (method, northing) in [
            (Method::SphericalMercator, 8_399_737.889_818_36),
            (Method::Mercator, 8_362_698.548_500_751),
            (Method::Equirectangular, 6_679_169.447_596_414),
        ] {
            let latitude = cylindrical(method).latitude(northing, Ellipsoid::WGS84);
            assert!((latitude - 60.0).abs() < 1e-9, "{method:?}: {latitude}");
        }
        // The Moon's south, in a system of its own.
        let moon = Ellipsoid { semi_major_m: 1_737_400.0, flattening: 0.0 };
        let polar = Cylindrical {
            standard_parallel: -80.0,
            origin_latitude: -80.0,
            ..cylindrical(Method::Equirectangular)
        };
        assert_eq!(polar.latitude(0.0, moon), -80.0);
        assert!((polar.ground(-80.0, moon) - DVec2::ONE).length() < 1e-12);
        // New Zealand's Mercator 41: true at 41° S.
        let south = Cylindrical { standard_parallel: -41.0, ..cylindrical(Method::Mercator) };
        let true_to_scale = south.ground(-41.0, Ellipsoid::WGS84);
        assert!((true_to_scale - DVec2::ONE).length() < 1e-12, "{true_to_scale}");
    }

    #[test]
    fn cells_of_mercator_shrink_to_the_poles() {
        for method in [Method::Mercator, Method::SphericalMercator] {
            let of = |latitude| cylindrical(method).ground(latitude, Ellipsoid::WGS84);
            assert!((of(0.0).x - 1.0).abs() < 1e-12);
            // cos 60° of the sphere, within the flattening.
            assert!((of(60.0) - DVec2::splat(0.5)).abs().max_element() < 2e-3, "{}", of(60.0));
        }
        let flat = cylindrical(Method::Equirectangular).ground(60.0, Ellipsoid::WGS84);
        assert!((flat.x - 0.5).abs() < 2e-3 && (flat.y - 1.0).abs() < 2e-3, "{flat}");
        // Exactly so on a sphere.
        let sphere = Ellipsoid { semi_major_m: 1e6, flattening: 0.0 };
        let ball = cylindrical(Method::Mercator).ground(60.0, sphere);
        assert!((ball - DVec2::splat(0.5)).abs().max_element() < 1e-15, "{ball}");
    }
}
