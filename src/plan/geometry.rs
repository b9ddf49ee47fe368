//! The camera in `f64`: axes, eye, and the view vector as a linear function of the screen.
//!
//! Sines, cosines and tangents come from `libm`, so that every platform loads the same
//! coefficients.

use glam::{DMat3, DVec2, DVec3};

use crate::scene::{Angles, Attitude, Camera, Screen};

/// A vector linear in the screen: `start + line·per_line + column·per_column`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearVector {
    /// At line 0, column 0.
    pub start: DVec3,
    /// Increment from a line to the next.
    pub per_line: DVec3,
    /// Increment from a column to the next.
    pub per_column: DVec3,
}

impl LinearVector {
    /// Value at a continuous line and column.
    pub fn at(&self, line: f64, column: f64) -> DVec3 {
        self.start + self.per_line * line + self.per_column * column
    }

    /// Componentwise product with constants.
    #[must_use]
    pub fn scaled(&self, by: DVec3) -> Self {
        Self {
            start: self.start * by,
            per_line: self.per_line * by,
            per_column: self.per_column * by,
        }
    }

    /// Scalar product with a constant vector.
    pub fn dot(&self, with: DVec3) -> LinearScalar {
        LinearScalar {
            start: self.start.dot(with),
            per_line: self.per_line.dot(with),
            per_column: self.per_column.dot(with),
        }
    }
}

/// A number linear in the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearScalar {
    /// At line 0, column 0.
    pub start: f64,
    /// Increment from a line to the next.
    pub per_line: f64,
    /// Increment from a column to the next.
    pub per_column: f64,
}

impl LinearScalar {
    /// Value at a continuous line and column.
    pub fn at(&self, line: f64, column: f64) -> f64 {
        self.start + self.per_line * line + self.per_column * column
    }

    /// Product with a constant.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Self {
        Self {
            start: self.start * by,
            per_line: self.per_line * by,
            per_column: self.per_column * by,
        }
    }
}

/// The camera of one channel.
#[derive(Clone, Debug)]
pub struct Geometry {
    /// Centre of projection r_h, ground frame, scene units (equation 3; thesis 2.16, 2.21).
    pub eye: DVec3,
    /// Columns u, v, w of the screen's axes in the ground frame (equation 2; thesis 2.38).
    pub axes: DMat3,
    /// View vector V of pixel (line, column), scene units (equation 4; thesis 2.34).
    pub view: LinearVector,
    /// Pixels across.
    pub columns: u32,
    /// Scan lines.
    pub lines: u32,
    /// Sides of a pixel on the screen, across and down, scene units.
    pub pitch: DVec2,
    /// Smaller side of a pixel over the longest view vector: the smallest angle between
    /// neighbouring pixels, up to the obliquity of the screen.
    pub finest_angle: f64,
}

impl Geometry {
    /// Camera and screen of a scene.
    pub fn new(camera: &Camera, screen: &Screen) -> Self {
        let craft = axes_of(&camera.attitude);
        let axes = craft * rotation(screen.mount);
        let pitch = screen.pitch();
        let half = |count: u32| f64::from(count) / 2.0;
        // Sampled at pixel centres, line 0 at the top, column 0 at the left (equation 4;
        // thesis 2.34).
        let view = LinearVector {
            start: axes
                * DVec3::new(
                    screen.distance(),
                    screen.center.x + (half(screen.lines) - 0.5) * pitch.y,
                    screen.center.y - (half(screen.columns) - 0.5) * pitch.x,
                ),
            // A single line or column is never left: its increment has no register to fit.
            per_line: if screen.lines > 1 { -axes.y_axis * pitch.y } else { DVec3::ZERO },
            per_column: if screen.columns > 1 { axes.z_axis * pitch.x } else { DVec3::ZERO },
        };
        let mut geometry = Self {
            eye: camera.position + craft * camera.offset,
            axes,
            view,
            columns: screen.columns,
            lines: screen.lines,
            pitch,
            finest_angle: 0.0,
        };
        let longest = geometry.corners().map(DVec3::length).into_iter().fold(0.0, f64::max);
        geometry.finest_angle = pitch.min_element() / longest;
        geometry
    }

    /// Pixels by which a ray moves on the screen, at most, where its direction is off by up to
    /// `errors` along the axes of the ground, in scene units beside the view vectors: to first order
    /// (equation 36).
    pub fn pixels_off(&self, errors: DVec3) -> f64 {
        let [forward, up, right] = [self.axes.x_axis, self.axes.y_axis, self.axes.z_axis];
        // The length is the largest of convex functions of the screen, so largest at a corner.
        let worst = |view: DVec3| {
            let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
            let moved = signs.map(|(y, z)| {
                let error = errors * DVec3::new(1.0, y, z);
                let ahead = error.dot(forward) / view.dot(forward);
                let along = |axis: DVec3| error.dot(axis) - view.dot(axis) * ahead;
                (DVec2::new(along(right), along(up)) / self.pitch).length()
            });
            moved.into_iter().fold(0.0, f64::max)
        };
        self.corners().map(worst).into_iter().fold(0.0, f64::max)
    }

    /// View vectors of the four corner pixels: components linear in the screen are extreme there.
    pub fn corners(&self) -> [DVec3; 4] {
        let (line, column) = (f64::from(self.lines - 1), f64::from(self.columns - 1));
        [(0.0, 0.0), (0.0, column), (line, 0.0), (line, column)].map(|(l, c)| self.view.at(l, c))
    }
}

/// Columns u, v, w of an attitude (equations 1 and 2; thesis 2.17, 2.38).
fn axes_of(attitude: &Attitude) -> DMat3 {
    match *attitude {
        Attitude::Angles(angles) => rotation(angles),
        Attitude::Directions { forward, up } => {
            let u = forward.normalize();
            let v = (up - u * u.dot(up)).normalize();
            DMat3::from_cols(u, v, u.cross(v))
        }
    }
}

/// `R_Y(heading) R_Z(pitch) R_X(roll)`, multiplied out (equation 2; thesis 2.38).
fn rotation(angles: Angles) -> DMat3 {
    let (sin_h, cos_h) = libm::sincos(angles.heading);
    let (sin_p, cos_p) = libm::sincos(angles.pitch);
    let (sin_r, cos_r) = libm::sincos(angles.roll);
    DMat3::from_cols(
        DVec3::new(cos_h * cos_p, sin_p, -sin_h * cos_p),
        DVec3::new(
            sin_h * sin_r - cos_h * sin_p * cos_r,
            cos_p * cos_r,
            cos_h * sin_r + sin_h * sin_p * cos_r,
        ),
        DVec3::new(
            sin_h * cos_r + cos_h * sin_p * sin_r,
            -cos_p * sin_r,
            cos_h * cos_r - sin_h * sin_p * sin_r,
        ),
    )
}
