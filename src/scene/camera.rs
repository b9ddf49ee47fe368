//! `[camera]`: where the craft is and how it is turned.

use glam::DVec3;

use super::error::SceneError;
use super::field::Fields;
use super::form::{Form, one_form};
use super::kind::{Key, Kind};
use super::table::{Table, keys_of_other_form, table};
use super::writer::Writer;

/// Sine of the angle between forward and up below which they say nothing about roll.
const PARALLEL: f64 = 1e-9;

table! {
    /// The craft: position `r_0`, offset `h` of the centre of projection, attitude.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Camera {
        /// Where the craft is, `r_0` in the ground frame.
        position: DVec3 = DVec3::new(300.0, 30.0, 330.0), Kind::Position;
        /// The eye in the craft, `h`: forward, up and to the right.
        offset: DVec3 = DVec3::ZERO, Kind::Position;
        /// Orientation of the craft.
        attitude: Attitude = Attitude::default();
    }
}

/// Orientation of the craft, by angles or by directions.
#[derive(Clone, Debug, PartialEq)]
pub enum Attitude {
    /// `A = R_Y(heading) R_Z(pitch) R_X(roll)`.
    Angles(Angles),
    /// Forward direction and a hint of up; neither needs unit length, they are not parallel.
    Directions {
        /// Direction of u in the ground frame.
        forward: DVec3,
        /// v lies in the plane of `forward` and `up`, on the side of `up`.
        up: DVec3,
    },
}

table! {
    /// Heading, pitch and roll in radians.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Angles {
        /// About Y; 0 looks along +x (east), 90 degrees along -z (north).
        heading: f64 = 0.0, Kind::Turn;
        /// Nose up positive.
        pitch: f64 = 0.0, Kind::Turn;
        /// Right wing down positive.
        roll: f64 = 0.0, Kind::Turn;
    }
}

table! {
    struct Directions {
        /// Where the craft looks, in place of the three angles.
        forward: DVec3 = DVec3::X, Kind::Direction;
        /// A direction above the craft; [0, 1, 0] where it is left out.
        up: DVec3 = DVec3::Y, Kind::Direction;
    }
}

impl Directions {
    /// Reads directions that are complete and not parallel.
    fn checked(fields: &Fields<'_>) -> Result<Self, SceneError> {
        let directions: Self = Table::read(fields, Self::default())?;
        let Some(field) = fields.get("forward") else {
            let reason = "`up` alone does not say where the craft looks";
            let remedy = "give camera.forward as well, or use heading, pitch and roll";
            return Err(match fields.get("up") {
                Some(field) => field.error(reason, remedy),
                None => fields.error("forward", reason, remedy),
            });
        };
        let Self { forward, up } = directions;
        if forward.normalize().cross(up.normalize()).length() < PARALLEL {
            let remedy = "give another camera.up, for example [1, 0, 0], or turn forward a little";
            return Err(field.error("it is parallel to `up`, which leaves roll undefined", remedy));
        }
        Ok(directions)
    }
}

impl Default for Attitude {
    fn default() -> Self {
        Self::Angles(Angles {
            heading: 126.87_f64.to_radians(),
            pitch: (-12.0_f64).to_radians(),
            roll: 0.0,
        })
    }
}

impl Table for Attitude {
    fn keys(default: &Self) -> Vec<Key> {
        [Angles::keys(&default.angles()), keys_of_other_form::<Directions>()].concat()
    }

    fn read(fields: &Fields<'_>, default: Self) -> Result<Self, SceneError> {
        let form = one_form::<Angles, Directions>(fields)?;
        if form != Form::Second && fields.get("forward").is_none() {
            return Table::read(fields, default.angles()).map(Self::Angles);
        }
        let Directions { forward, up } = Directions::checked(fields)?;
        let directions = Self::Directions { forward, up };
        if form == Form::Second {
            return Ok(directions);
        }
        // An angle set over a scene that gives directions turns the craft from there.
        Table::read(fields, directions.angles()).map(Self::Angles)
    }

    fn write(&self, out: &mut Writer) {
        match *self {
            Self::Angles(angles) => {
                Table::write(&angles, out);
                out.aside(|out| Table::write(&Directions::default(), out));
            }
            Self::Directions { forward, up } => {
                Table::write(&Directions { forward, up }, out);
                out.aside(|out| Table::write(&self.angles(), out));
            }
        }
    }
}

impl Attitude {
    /// Heading, pitch and roll, radians; of directions, the angles that turn the craft as they do.
    #[must_use]
    pub fn angles(&self) -> Angles {
        match *self {
            Self::Angles(angles) => angles,
            Self::Directions { forward, up } => angles_of(forward, up),
        }
    }
}

/// The angles that turn the craft as two directions do.
fn angles_of(forward: DVec3, up: DVec3) -> Angles {
    let u = forward.normalize();
    let w = u.cross(up).normalize();
    let v = w.cross(u);
    let level = libm::hypot(u.x, u.z);
    let pitch = libm::atan2(u.y, level);
    if level < PARALLEL {
        // Straight up or down, heading and roll turn about one axis: call it heading.
        return Angles { heading: libm::atan2(w.x, w.z), pitch, roll: 0.0 };
    }
    Angles { heading: libm::atan2(-u.z, u.x), pitch, roll: libm::atan2(-w.y, v.y) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_turn_as_their_directions_do() {
        for (heading, pitch, roll) in [(0.3, -0.2, 0.0), (-2.9, 1.1, 0.7), (1.6, 0.0, -2.8)] {
            let (sh, ch) = f64::sin_cos(heading);
            let (sp, cp) = f64::sin_cos(pitch);
            let (sr, cr) = f64::sin_cos(roll);
            let forward = DVec3::new(ch * cp, sp, -sh * cp);
            let up = DVec3::new(sh * sr - ch * sp * cr, cp * cr, ch * sr + sh * sp * cr);
            let angles = angles_of(forward * 3.0, up + forward * 0.4);
            assert!((angles.heading - heading).abs() < 1e-12);
            assert!((angles.pitch - pitch).abs() < 1e-12);
            assert!((angles.roll - roll).abs() < 1e-12);
        }
        let down = angles_of(-DVec3::Y, DVec3::X);
        assert!((down.heading, down.roll) == (0.0, 0.0) && down.pitch < -1.57);
    }
}
