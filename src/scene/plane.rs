//! `[[surface]]` with `kind = "plane"`: an infinite checkered plane.

use glam::DVec3;

use super::error::SceneError;
use super::field::Fields;
use super::kind::{FARTHEST, Kind, LENGTH};
use super::table::{Table, table};
use super::writer::is_unit;

table! {
    /// A checkered plane `n·r = d`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Plane {
        /// Normal n of the plane n.r = d, of any length.
        ///
        /// A unit vector in the scene.
        normal: DVec3 = DVec3::Y, Kind::Direction;
        /// d in n.r = d.
        ///
        /// In scene units, as the normal is a unit vector.
        distance: f64 = 0.0, Kind::Number(f64::MIN..=f64::MAX);
        /// Side of a checker square.
        checker: f64 = 8.0, LENGTH;
    }
}

impl Plane {
    /// Reads a plane and brings its normal to unit length.
    pub(super) fn normalised(fields: &Fields<'_>) -> Result<Self, SceneError> {
        let Self { normal, distance, checker } = Table::read(fields, Self::default())?;
        // n·r = d holds for any length of n if d grows with it.
        let length = if is_unit(normal) { 1.0 } else { normal.length() };
        let distance = distance / length;
        match fields.get("distance") {
            Some(field) if distance.abs() > FARTHEST => {
                Err(field.expected("a number no farther than 1e9 from 0 along the unit normal"))
            }
            _ => Ok(Self { normal: normal / length, distance, checker }),
        }
    }
}
