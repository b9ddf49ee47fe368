//! Derived error bounds of registers (equations 29 to 31 of docs/mathematics.md).

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
