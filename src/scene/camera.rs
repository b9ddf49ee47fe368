//! `[camera]`: where the craft is and how it is turned.

use glam::DVec3;

use super::error::SceneError;
use super::field::{Field, Fields};
use super::file::{Form, one_form};
use super::{Angles, Attitude, Camera};

const ANGLES: [&str; 3] = ["heading", "pitch", "roll"];
const DIRECTIONS: [&str; 2] = ["forward", "up"];

/// Sine of the angle between forward and up below which they say nothing about roll.
const PARALLEL: f64 = 1e-9;

pub(super) fn read(table: &Fields<'_>) -> Result<Camera, SceneError> {
    Ok(Camera {
        position: table.read("position", DVec3::new(300.0, 30.0, 330.0), Field::position)?,
        offset: table.read("offset", DVec3::ZERO, Field::position)?,
        attitude: attitude(table)?,
    })
}

/// Angles of a table in degrees, in radians; what is not given is as in `default`.
pub(super) fn angles(table: &Fields<'_>, default: Angles) -> Result<Angles, SceneError> {
    Ok(Angles {
        heading: table.read("heading", default.heading, Field::angle)?,
        pitch: table.read("pitch", default.pitch, Field::angle)?,
        roll: table.read("roll", default.roll, Field::angle)?,
    })
}

fn attitude(table: &Fields<'_>) -> Result<Attitude, SceneError> {
    let default =
        Angles { heading: 126.87_f64.to_radians(), pitch: (-12.0_f64).to_radians(), roll: 0.0 };
    let remedy = "keep either forward and up, or heading, pitch and roll";
    match one_form(table, &ANGLES, &DIRECTIONS, remedy)? {
        Form::Second => {
            let (forward, up) = directions(table)?;
            Ok(Attitude::Directions { forward, up })
        }
        // An angle set over a scene that gives directions turns the craft from there.
        Form::First if table.get("forward").is_some() => {
            let (forward, up) = directions(table)?;
            Ok(Attitude::Angles(angles(table, angles_of(forward, up))?))
        }
        Form::First | Form::Neither => Ok(Attitude::Angles(angles(table, default)?)),
    }
}

fn directions(table: &Fields<'_>) -> Result<(DVec3, DVec3), SceneError> {
    let up = table.read("up", DVec3::Y, Field::direction)?;
    let Some(field) = table.get("forward") else {
        let reason = "`up` alone does not say where the craft looks";
        let remedy = "give camera.forward as well, or use heading, pitch and roll";
        return Err(match table.get("up") {
            Some(field) => field.error(reason, remedy),
            None => table.error("forward", reason, remedy),
        });
    };
    let forward = field.direction()?;
    if forward.normalize().cross(up.normalize()).length() < PARALLEL {
        let remedy = "give another camera.up, for example [1, 0, 0], or turn forward a little";
        return Err(field.error("it is parallel to `up`, which leaves roll undefined", remedy));
    }
    Ok((forward, up))
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
