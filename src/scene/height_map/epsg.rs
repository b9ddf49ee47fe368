//! What a code of the EPSG register implies where a file gives the code alone: the unit of its
//! coordinates or heights, and whether its lengths are lengths on the ground.

mod table;

use super::projection::{Cylindrical, Projection};

/// Metres of a unit of length.
pub(super) fn metres(unit: u16) -> Option<f64> {
    table::LENGTHS.iter().find(|(code, _)| *code == unit).map(|(_, metres)| *metres)
}

/// Degrees of a unit of angle.
pub(super) fn degrees(unit: u16) -> Option<f64> {
    Some(match unit {
        9101 => 1.0_f64.to_degrees(),
        9102 | 9122 => 1.0,
        9103 => 1.0 / 60.0,
        9104 => 1.0 / 3600.0,
        9105 | 9106 => 0.9,
        9109 => 1e-6_f64.to_degrees(),
        _ => return None,
    })
}

/// The value of the range that holds a code.
fn among<T: Copy>(ranges: &[(u16, u16, T)], code: u16) -> Option<T> {
    ranges.iter().find(|(first, last, _)| (*first..=*last).contains(&code)).map(|range| range.2)
}

fn is_among(ranges: &[(u16, u16)], code: u16) -> bool {
    ranges.iter().any(|(first, last)| (*first..=*last).contains(&code))
}

/// Codes of projected systems lie between these.
const PROJECTED: std::ops::RangeInclusive<u16> = 2000..=32766;

/// Metres of the unit of a projected system; `None` of a code that is none.
pub(super) fn projected_unit_m(code: u16) -> Option<f64> {
    let unit = among(table::PROJECTED_UNITS, code).and_then(metres);
    unit.or(PROJECTED.contains(&code).then_some(1.0))
}

/// How lengths of a projected system relate to lengths on the ground.
pub(super) fn projection(code: u16) -> Projection {
    if let Some(name) = among(table::DISTORTED, code) {
        return Projection::Distorted(name.to_owned());
    }
    let found = table::CYLINDRICAL.iter().find(|(other, ..)| *other == code);
    found.map_or(Projection::TrueToScale, |&(_, method, scale, standard_parallel, northing)| {
        Projection::Cylindrical(Cylindrical {
            method,
            scale,
            standard_parallel,
            origin_latitude: 0.0,
            false_northing: northing,
        })
    })
}

/// What a vertical system counts.
pub(super) struct Vertical {
    /// Metres of its unit.
    pub(super) unit_m: f64,
    /// Whether it counts downwards.
    pub(super) is_depth: bool,
}

/// A vertical system; `None` for other codes, such as those of datums.
pub(super) fn vertical(code: u16) -> Option<Vertical> {
    is_among(table::VERTICAL, code).then(|| Vertical {
        unit_m: table::VERTICAL_UNITS
            .iter()
            .find(|(other, _)| *other == code)
            .and_then(|(_, unit)| metres(*unit))
            .unwrap_or(1.0),
        is_depth: is_among(table::DEPTHS, code),
    })
}

/// Whether a code is that of a geographic system.
pub(super) fn is_geographic(code: u16) -> bool {
    is_among(table::GEOGRAPHIC, code)
}

/// Whether a geographic system has heights, which are metres; or the code is one of the first
/// GeoTIFF for heights above an ellipsoid.
pub(super) fn has_heights(code: u16) -> bool {
    is_among(table::SOLID, code) || (5001..=5033).contains(&code)
}

/// Degrees of the unit of a geographic system.
pub(super) fn geographic_unit(code: u16) -> f64 {
    if table::GRADS.contains(&code) { 0.9 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_imply_what_the_register_says() {
        const SURVEY_FOOT: f64 = 1200.0 / 3937.0;
        for (code, unit_m) in [
            (32613, 1.0),        // UTM zone 13N
            (2227, SURVEY_FOOT), // California zone 3
            (6529, SURVEY_FOOT), // New Mexico Central
            (2222, 0.3048),      // Arizona East
            (27700, 1.0),        // British National Grid
        ] {
            assert!((projected_unit_m(code).unwrap() / unit_m - 1.0).abs() < 1e-12, "{code}");
        }
        for (code, unit_m, is_depth) in [
            (5703, 1.0, false),
            (6360, SURVEY_FOOT, false),
            (8228, 0.3048, false),
            (5715, 1.0, true),
        ] {
            let found = vertical(code).unwrap();
            assert!((found.unit_m / unit_m - 1.0).abs() < 1e-12, "{code}");
            assert_eq!(found.is_depth, is_depth, "{code}");
        }
        // The datum NAVD88 is no vertical system, and says nothing about units.
        assert!(vertical(5103).is_none());
        assert!(is_geographic(4326) && is_geographic(4807) && !is_geographic(32613));
        assert_eq!((geographic_unit(4326), geographic_unit(4807)), (1.0, 0.9));
        assert_eq!(projected_unit_m(40_000), None);
        assert!(matches!(projection(3347), Projection::Distorted(_)));
        assert!(has_heights(5030) && has_heights(4979) && !has_heights(4326));
        assert_eq!(projection(32613), Projection::TrueToScale);
        assert!(matches!(projection(5070), Projection::Distorted(name) if name.contains("Albers")));
        assert!(matches!(projection(3857), Projection::Cylindrical(_)));
        assert_eq!(metres(9036), Some(1000.0));
        assert_eq!(metres(9999), None);
    }
}
