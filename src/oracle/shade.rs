//! Colours: the ramp over heights, the light, and the colours of what is not terrain.

use glam::DVec3;

use super::camera::Ray;
use super::plane::checker_parity;
use crate::frame::Hit;
use crate::scene::{Colors, Light, Plane};

/// Colour on the ramp at t in \[0, 1\], evenly spaced colours joined linearly in sRGB values,
/// 0..=255, not rounded.
#[must_use]
pub fn ramp_color(ramp: &[[u8; 3]], t: f64) -> DVec3 {
    let Some(last) = ramp.len().checked_sub(1) else {
        return DVec3::ZERO;
    };
    let place = t.clamp(0.0, 1.0) * last as f64;
    let index = (place.floor() as usize).min(last.saturating_sub(1));
    let (low, high) = (bytes_to_vector(ramp[index]), bytes_to_vector(ramp[(index + 1).min(last)]));
    low + (high - low) * (place - index as f64)
}

/// Share of light on a surface with unit normal n, L the unit direction of the light:
/// `ambient + (1 − ambient) max(0, n·L)`.
#[must_use]
pub fn shade(light: &Light, normal: DVec3) -> f64 {
    light.ambient + (1.0 - light.ambient) * normal.dot(light.direction).max(0.0)
}

/// Colour of terrain at height y, where the map's nodes reach from `range.0` to `range.1`, all in
/// scene units. A flat map has the first colour of the ramp.
#[must_use]
pub fn terrain_color(
    colors: &Colors,
    light: &Light,
    range: (f64, f64),
    y: f64,
    normal: DVec3,
) -> [u8; 3] {
    let (low, high) = range;
    let t = if high > low { (y - low) / (high - low) } else { 0.0 };
    let lit = ramp_color(&colors.ramp, t) * shade(light, normal);
    lit.to_array().map(|channel| channel.round().clamp(0.0, 255.0) as u8)
}

/// Colour of the checkered plane at a point of it, unshaded: the square's colour at full contrast,
/// the mean of both at none.
#[must_use]
pub fn plane_color(colors: &Colors, plane: &Plane, point: DVec3, contrast: f64) -> [u8; 3] {
    let [even, odd] = colors.checker.map(bytes_to_vector);
    let mean = (even + odd) / 2.0;
    let own = if checker_parity(plane, point) == 0 { even } else { odd };
    (mean + (own - mean) * contrast).to_array().map(|channel| channel.round() as u8)
}

/// Contrast of the squares, `clamp(G/g − 1, 0, 1)` with `G = |n·V|` and
/// `g = sqrt(|F| · grain / square)`: the pixel covers one square along the view where G = g and a
/// quarter of one at 2g. `grain` is the larger pixel pitch times the screen's distance.
#[must_use]
pub fn plane_contrast(plane: &Plane, ray: &Ray, grain: f64) -> f64 {
    let f = plane.distance - plane.normal.dot(ray.eye);
    let g = (f.abs() * grain / plane.checker).sqrt();
    (plane.normal.dot(ray.direction).abs() / g - 1.0).clamp(0.0, 1.0)
}

/// Colour of an outcome that is not the surface; `None` for the surface.
#[must_use]
pub fn outcome_color(colors: &Colors, hit: Hit) -> Option<[u8; 3]> {
    match hit {
        Hit::Surface => None,
        Hit::Sky => Some(colors.sky),
        Hit::Side => Some(colors.side),
        Hit::OutOfRange => Some(colors.far),
    }
}

fn bytes_to_vector(color: [u8; 3]) -> DVec3 {
    DVec3::from_array(color.map(f64::from))
}
