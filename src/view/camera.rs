//! Moving the craft. Angles are kept in whole thousandths of a degree and lengths in decimals, so
//! that a scene that is copied out is short and gives the same frame.

use glam::DVec3;

use crate::scene::{Angles, Attitude, Camera, Extent, Screen};

/// Pitch beyond which the view would turn over, degrees.
const STEEPEST: f64 = 89.0;

/// Widest and narrowest field of view, degrees.
const FIELDS: (f64, f64) = (2.0, 150.0);

/// How one notch of the wheel changes the tangent of half the field.
const NOTCH: f64 = 0.88;

/// Heading, pitch and roll in degrees, heading and roll in -180..=180.
#[must_use]
pub fn degrees(camera: &Camera) -> [f64; 3] {
    let Angles { heading, pitch, roll } = camera.attitude.angles();
    let wrapped = |angle: f64| {
        let angle = angle.to_degrees().rem_euclid(360.0);
        if angle > 180.0 { angle - 360.0 } else { angle }
    };
    [wrapped(heading), wrapped(pitch), wrapped(roll)]
}

/// The compass course of a heading, degrees clockwise from north, and its point.
#[must_use]
pub fn compass(heading: f64) -> (f64, &'static str) {
    const POINTS: [&str; 8] = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"];
    let course = (90.0 - heading).rem_euclid(360.0);
    (course, POINTS[(course / 45.0).round() as usize % 8])
}

/// Turns the craft by degrees: heading to the left, nose up, right wing down.
pub fn turn(camera: &mut Camera, heading: f64, pitch: f64, roll: f64) {
    let [h, p, r] = degrees(camera);
    let radians = |degrees: f64| ((degrees * 1000.0).round() / 1000.0).to_radians();
    // A scene may start steeper; it then cannot get steeper still.
    let steepest = STEEPEST.max(p.abs());
    camera.attitude = Attitude::Angles(Angles {
        heading: radians((h + heading + 180.0).rem_euclid(360.0) - 180.0),
        pitch: radians((p + pitch).clamp(-steepest, steepest)),
        roll: radians((r + roll + 180.0).rem_euclid(360.0) - 180.0),
    });
}

/// Degrees that one pixel in the middle of the screen covers.
#[must_use]
pub fn degrees_per_pixel(screen: &Screen) -> f64 {
    (screen.pitch().x / screen.distance()).atan().to_degrees()
}

/// Narrows (positive) or widens the field of view by notches of the wheel.
pub fn zoom(screen: &mut Screen, notches: f64) {
    let factor = NOTCH.powf(notches);
    let half = |degrees: f64| (degrees / 2.0).to_radians().tan();
    screen.extent = match screen.extent {
        Extent::FieldOfView(fov) => {
            let fov = 2.0 * ((fov / 2.0).tan() * factor).atan().to_degrees();
            let fov = fov.clamp(FIELDS.0, FIELDS.1);
            Extent::FieldOfView(((fov * 1000.0).round() / 1000.0).to_radians())
        }
        Extent::Pitch { distance, pixel } => {
            let now = pixel.x * f64::from(screen.columns) / 2.0 / distance;
            let then = (now * factor).clamp(half(FIELDS.0), half(FIELDS.1));
            Extent::Pitch { distance, pixel: pixel * (then / now) }
        }
    };
}

/// A direction of flight: forward over the ground, to the right, up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Course {
    /// Along the heading, level.
    pub forward: f64,
    /// Across it, level.
    pub right: f64,
    /// Straight up.
    pub up: f64,
}

/// Flies a distance along a course in the frame of the heading; `grain` is the length of a map
/// cell, below which positions are rounded.
pub fn fly(camera: &mut Camera, course: Course, distance: f64, grain: f64) {
    let heading = camera.attitude.angles().heading;
    let (sin, cos) = heading.sin_cos();
    let ahead = DVec3::new(cos, 0.0, -sin);
    let right = DVec3::new(sin, 0.0, cos);
    let way = ahead * course.forward + right * course.right + DVec3::Y * course.up;
    camera.position = rounded(camera.position + way * distance, grain);
}

/// Moves a distance along the line of sight.
pub fn dolly(camera: &mut Camera, distance: f64, grain: f64) {
    let Angles { heading, pitch, .. } = camera.attitude.angles();
    let (sin, cos) = heading.sin_cos();
    let sight = DVec3::new(cos * pitch.cos(), pitch.sin(), -sin * pitch.cos());
    camera.position = rounded(camera.position + sight * distance, grain);
}

/// Rounded to a decimal unit of a ten-thousandth of the grain or so.
pub fn rounded(place: DVec3, grain: f64) -> DVec3 {
    let decimals = 4 - grain.log10().floor() as i32;
    if !(0..=9).contains(&decimals) {
        return place;
    }
    let unit = 10.0_f64.powi(decimals);
    DVec3::from_array(place.to_array().map(|c| (c * unit).round() / unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        let attitude = Attitude::Directions { forward: DVec3::new(0.0, 0.0, -2.0), up: DVec3::Y };
        Camera { position: DVec3::new(1.0, 2.0, 3.0), offset: DVec3::ZERO, attitude }
    }

    #[test]
    fn flight_is_in_the_frame_of_the_heading() {
        // Towards -z: north, compass 0, with east on the right.
        let mut craft = camera();
        assert_eq!(compass(degrees(&craft)[0]), (0.0, "N"));
        fly(&mut craft, Course { forward: 1.0, ..Course::default() }, 2.0, 1.0);
        assert_eq!(craft.position, DVec3::new(1.0, 2.0, 1.0));
        fly(&mut craft, Course { right: 1.0, ..Course::default() }, 2.0, 1.0);
        assert_eq!(craft.position, DVec3::new(3.0, 2.0, 1.0));
        turn(&mut craft, 0.0, -30.0, 0.0);
        fly(&mut craft, Course { forward: 1.0, ..Course::default() }, 1.0, 1.0);
        assert_eq!(craft.position, DVec3::new(3.0, 2.0, 0.0));
        dolly(&mut craft, 2.0, 1.0);
        assert_eq!(craft.position, DVec3::new(3.0, 1.0, -1.7321));
    }

    #[test]
    fn turning_wraps_headings_and_stops_before_the_zenith() {
        let mut craft = camera();
        turn(&mut craft, 100.0, 200.0, -10.0);
        let [heading, pitch, roll] = degrees(&craft);
        assert!((heading + 170.0).abs() < 1e-9 && (pitch - 89.0).abs() < 1e-9);
        assert!((roll + 10.0).abs() < 1e-9);
        assert_eq!(compass(heading).1, "W");
        turn(&mut craft, 0.0, -1000.0, 0.0);
        assert!((degrees(&craft)[1] + 89.0).abs() < 1e-9);
    }

    #[test]
    fn zoom_there_and_back_keeps_within_the_fields() {
        let mut screen = Screen {
            name: "front".into(),
            columns: 100,
            lines: 50,
            extent: Extent::FieldOfView(60.0_f64.to_radians()),
            center: glam::DVec2::ZERO,
            mount: Angles::default(),
        };
        let before = degrees_per_pixel(&screen);
        zoom(&mut screen, 3.0);
        assert!(degrees_per_pixel(&screen) < before * 0.75);
        zoom(&mut screen, -3.0);
        assert!((degrees_per_pixel(&screen) / before - 1.0).abs() < 1e-3);
        zoom(&mut screen, 1000.0);
        assert_eq!(screen.extent, Extent::FieldOfView(2.0_f64.to_radians()));

        let pixel = glam::DVec2::new(0.01, 0.02);
        screen.extent = Extent::Pitch { distance: 1.0, pixel };
        zoom(&mut screen, 1.0);
        let Extent::Pitch { pixel, .. } = screen.extent else { panic!("the form is kept") };
        assert!((pixel.x - 0.0088).abs() < 1e-12 && (pixel.y - 0.0176).abs() < 1e-12);
    }
}
