//! Derived error bounds of registers (equations 29 to 31 and 35 of docs/mathematics.md).

use crate::scene::{Deformation, Kernel};
use crate::setup::kernel::{most_curved, steepest};
use crate::word::Fixed;

/// Bound of a view accumulator at a pixel: every coefficient is half a bit from its exact value
/// (equation 29).
pub fn view(format: Fixed, line: u32, column: u32) -> f64 {
    (1.0 + f64::from(line) + f64::from(column)) * format.ulp() / 2.0
}

/// Bound of `eye + numerator/denominator · 2^exponent` (equation 30), in the unit of the quotient.
///
/// `numerator_bound` and `denominator_bound` are those of the accumulators; the quotient is
/// floored and the eye rounded to nearest.
pub fn entry(
    format: Fixed,
    quotient: f64,
    denominator: f64,
    exponent: i32,
    numerator_bound: f64,
    denominator_bound: f64,
) -> f64 {
    let rest = denominator - denominator_bound;
    if rest <= 0.0 {
        return f64::INFINITY;
    }
    let scale = libm::scalbn(1.0, exponent);
    (numerator_bound * scale + quotient.abs() * denominator_bound) / rest + 1.5 * format.ulp()
}

/// Bound of a ray's position after `index` steps (equation 31): each step is half a bit and the
/// view's bound away from its exact value.
pub fn ray(format: Fixed, start_bound: f64, index: u32, view_bound: f64, exponent: i32) -> f64 {
    let step = format.ulp() / 2.0 + libm::scalbn(view_bound, exponent);
    start_bound + f64::from(index) * step
}

/// Bound of a weight over 2×2 nodes, at a place whose register has `place_point` bits after the point
/// (equation 35).
#[cfg_attr(not(feature = "parts"), expect(dead_code, reason = "only parts are measured"))]
pub fn weight(kernel: &Kernel, format: Fixed, place_point: u32) -> f64 {
    // The hat is one minus the fraction, which is rounded where the weight has fewer bits.
    let hat = if place_point > format.point { 0.5 } else { 0.0 };
    mixed(kernel, format, hat, steepest(kernel.shape))
}

/// Bound of the derivative of that weight (equation 35).
#[cfg_attr(not(feature = "parts"), expect(dead_code, reason = "only parts are measured"))]
pub fn weight_slope(kernel: &Kernel, format: Fixed) -> f64 {
    mixed(kernel, format, 0.0, most_curved(kernel.shape))
}

/// Bound of a mix of the hat, off by `hat` ulps, and a table whose entries change by no more than
/// `rate` per cell.
fn mixed(kernel: &Kernel, format: Fixed, hat: f64, rate: f64) -> f64 {
    let share = match kernel.deformation {
        // The table of the stretched kernel is flatter.
        Deformation::None | Deformation::Stretch => 1.0,
        Deformation::TowardHat { weight_shift } => libm::scalbn(1.0, -(weight_shift as i32)),
    };
    // Half an entry away, and half a bit off.
    let table = rate / f64::from(kernel.table) / 2.0 + format.ulp() / 2.0;
    // A shift toward zero loses less than a bit, and at most the share that it takes away.
    share * table + (1.0 - share) * (hat + 1.0) * format.ulp()
}
