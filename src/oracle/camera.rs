//! The camera: craft axes, centre of projection, and the rays through the pixels.

use glam::{DMat3, DVec3};

use crate::scene::{Angles, Attitude, Camera, Screen};

/// `A = R_Y(ψ) R_Z(ϑ) R_X(γ)`, its columns u, v and w in the ground frame:
///
/// ```text
///          u              v                          w
///     x    cosψ cosϑ      sinψ sinγ − cosψ sinϑ cosγ   sinψ cosγ + cosψ sinϑ sinγ
///     y    sinϑ           cosϑ cosγ                  −cosϑ sinγ
///     z   −sinψ cosϑ      cosψ sinγ + sinψ sinϑ cosγ   cosψ cosγ − sinψ sinϑ sinγ
/// ```
///
/// ψ = heading, ϑ = pitch, γ = roll, radians.
#[must_use]
pub fn axes_of_angles(angles: Angles) -> DMat3 {
    let (sin_h, cos_h) = angles.heading.sin_cos();
    let (sin_p, cos_p) = angles.pitch.sin_cos();
    let (sin_r, cos_r) = angles.roll.sin_cos();
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

/// Craft axes of an attitude. From directions: u = forward, v = the part of up at right angles to
/// u, both brought to unit length, and w = u × v.
#[must_use]
pub fn axes_of_attitude(attitude: &Attitude) -> DMat3 {
    match *attitude {
        Attitude::Angles(angles) => axes_of_angles(angles),
        Attitude::Directions { forward, up } => {
            let u = forward.normalize();
            let v = (up - u * up.dot(u)).normalize();
            DMat3::from_cols(u, v, u.cross(v))
        }
    }
}

/// A ray `r = eye + λ direction`, scene units; λ has no unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Centre of projection.
    pub eye: DVec3,
    /// V, of the screen's length, not normalised.
    pub direction: DVec3,
}

impl Ray {
    /// The point at λ.
    #[must_use]
    pub fn at(&self, lambda: f64) -> DVec3 {
        self.eye + self.direction * lambda
    }
}

/// Centre of projection and raster of one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    eye: DVec3,
    /// `A A_mount`.
    axes: DMat3,
    distance: f64,
    /// V_v of line 0 and V_w of column 0, at the pixel centres.
    first: (f64, f64),
    /// (δy down, δz across).
    pitch: (f64, f64),
}

impl View {
    /// The channel `screen` of `camera`.
    ///
    /// `r_h = r_0 + A h`: the mount turns the screen, not the offset of the eye.
    #[must_use]
    pub fn new(camera: &Camera, screen: &Screen) -> Self {
        let craft = axes_of_attitude(&camera.attitude);
        let pitch = screen.pitch();
        let half_lines = f64::from(screen.lines) / 2.0;
        let half_columns = f64::from(screen.columns) / 2.0;
        Self {
            eye: camera.position + craft * camera.offset,
            axes: craft * axes_of_angles(screen.mount),
            distance: screen.distance(),
            first: (
                screen.center.x + (half_lines - 0.5) * pitch.y,
                screen.center.y + (0.5 - half_columns) * pitch.x,
            ),
            pitch: (pitch.y, pitch.x),
        }
    }

    /// r_h in the ground frame, scene units.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// `A A_mount`, columns u, v, w in the ground frame.
    #[must_use]
    pub fn axes(&self) -> DMat3 {
        self.axes
    }

    /// `V = A A_mount (U1, Ve + (Ny − ½ − j) δy, We + (k + ½ − Nz) δz)` at line j, column k.
    #[must_use]
    pub fn direction(&self, line: f64, column: f64) -> DVec3 {
        self.axes
            * DVec3::new(
                self.distance,
                self.first.0 - line * self.pitch.0,
                self.first.1 + column * self.pitch.1,
            )
    }

    /// The ray through line j, column k.
    #[must_use]
    pub fn ray(&self, line: f64, column: f64) -> Ray {
        Ray { eye: self.eye, direction: self.direction(line, column) }
    }

    /// The (line, column) at which a point of the ground frame is seen, whole numbers at pixel
    /// centres; `None` for a point that is not in front of the centre of projection.
    #[must_use]
    pub fn project(&self, point: DVec3) -> Option<(f64, f64)> {
        let local = self.axes.transpose() * (point - self.eye);
        if local.x.is_nan() || local.x <= 0.0 {
            return None;
        }
        let foot = local * (self.distance / local.x);
        Some(((self.first.0 - foot.y) / self.pitch.0, (foot.z - self.first.1) / self.pitch.1))
    }
}
