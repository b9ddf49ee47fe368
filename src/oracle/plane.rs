//! The checkered plane in closed form.

use glam::{DVec2, DVec3};

use super::camera::Ray;
use crate::scene::Plane;

/// Two unit vectors (e_s, e_t) in the plane with unit normal n, along which the checker runs:
/// e_s along n × z where |n_z| < 0.9 and along n × x elsewhere, e_t = e_s × n.
///
/// For n = +y they are +x and +z; for n = −y, −x and +z.
#[must_use]
pub fn checker_axes(normal: DVec3) -> (DVec3, DVec3) {
    let helper = if normal.z.abs() < 0.9 { DVec3::Z } else { DVec3::X };
    let s = normal.cross(helper).normalize();
    (s, s.cross(normal))
}

/// λ of the plane on a ray, `λ = (d − n·r_h)/(n·V)`, where it is positive and finite.
///
/// An eye in the plane sees it edge-on, as nothing.
#[must_use]
pub fn plane_lambda(plane: &Plane, ray: &Ray) -> Option<f64> {
    let above = plane.distance - plane.normal.dot(ray.eye);
    let lambda = above / plane.normal.dot(ray.direction);
    (lambda > 0.0 && lambda.is_finite()).then_some(lambda)
}

/// In-plane coordinates (s, t) of a point, scene units.
#[must_use]
pub fn checker_coordinates(plane: &Plane, point: DVec3) -> DVec2 {
    let (s, t) = checker_axes(plane.normal);
    DVec2::new(s.dot(point), t.dot(point))
}

/// Which of the two checker colours a point of the plane has: the parity of
/// `floor(s/checker) + floor(t/checker)`.
#[must_use]
pub fn checker_parity(plane: &Plane, point: DVec3) -> usize {
    let square = (checker_coordinates(plane, point) / plane.checker).floor();
    // The remainder of floats is exact, however far away the square is.
    usize::from((square.x.rem_euclid(2.0) + square.y.rem_euclid(2.0)) == 1.0)
}

/// y of the plane over (x, z), scene units; `None` for an upright plane.
#[must_use]
pub fn plane_height(plane: &Plane, x: f64, z: f64) -> Option<f64> {
    let n = plane.normal;
    let y = (plane.distance - n.x * x - n.z * z) / n.y;
    y.is_finite().then_some(y)
}
