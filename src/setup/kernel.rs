//! Finite functions and their derivatives in `f64`, for the kernel ROM (equations 12, 16 and 17;
//! thesis 2.42 to 2.46, 2.59 to 2.61, 2.63).

use crate::scene::KernelShape;

/// f(t) of a basic shape; even, 1 at 0, 0 from |t| = 1 on.
pub fn value(shape: KernelShape, t: f64) -> f64 {
    let t = t.abs();
    if t >= 1.0 {
        return 0.0;
    }
    match shape {
        KernelShape::Cosine => (libm::cos(std::f64::consts::PI * t) + 1.0) / 2.0,
        KernelShape::Parabola if t < 0.5 => 1.0 - 2.0 * t * t,
        KernelShape::Parabola => 2.0 * (1.0 - t) * (1.0 - t),
        KernelShape::Exponential if t < 0.5 => libm::exp2(-4.0 * t * t),
        KernelShape::Exponential => 1.0 - libm::exp2(-(2.0 - 2.0 * t) * (2.0 - 2.0 * t)),
        KernelShape::Hat => 1.0 - t,
    }
}

/// f′(t) of a basic shape; odd.
pub fn slope(shape: KernelShape, t: f64) -> f64 {
    use std::f64::consts::{LN_2, PI};
    let (sign, t) = (if t < 0.0 { -1.0 } else { 1.0 }, t.abs());
    if t > 1.0 {
        return 0.0;
    }
    sign * match shape {
        KernelShape::Cosine => -PI / 2.0 * libm::sin(PI * t),
        KernelShape::Parabola if t < 0.5 => -4.0 * t,
        KernelShape::Parabola => -4.0 * (1.0 - t),
        KernelShape::Exponential if t < 0.5 => -8.0 * LN_2 * t * libm::exp2(-4.0 * t * t),
        KernelShape::Exponential => {
            let s = 1.0 - t;
            -8.0 * LN_2 * s * libm::exp2(-4.0 * s * s)
        }
        KernelShape::Hat => -1.0,
    }
}

/// Largest |f′| of a basic shape.
pub fn steepest(shape: KernelShape) -> f64 {
    match shape {
        KernelShape::Hat => 1.0,
        KernelShape::Cosine | KernelShape::Parabola => -slope(shape, 0.5),
        // On either side of the middle, where the two halves meet less steeply.
        KernelShape::Exponential => -slope(shape, libm::sqrt(1.0 / (8.0 * std::f64::consts::LN_2))),
    }
}

/// Bound of |f″| of a basic shape where it exists; f′ is continuous but for the hat's nodes.
pub fn most_curved(shape: KernelShape) -> f64 {
    use std::f64::consts::{LN_2, PI};
    match shape {
        KernelShape::Cosine => PI * PI / 2.0,
        KernelShape::Parabola => 4.0,
        // At the nodes: f″(0) = −8 ln 2.
        KernelShape::Exponential => 8.0 * LN_2,
        KernelShape::Hat => 0.0,
    }
}

/// Outer weights of deformation 1, `α · ⅔ f(⅔t)` on (−3/2, 3/2), with `α = ¾ / f(⅓)` so that the
/// patches around neighbouring nodes meet half-way between them (equation 17; thesis 2.63); α = 1
/// for the cosine.
pub fn stretched(shape: KernelShape, t: f64) -> f64 {
    meeting(shape) * (2.0 / 3.0) * value(shape, 2.0 / 3.0 * t)
}

/// Derivative of [`stretched`] by t.
pub fn stretched_slope(shape: KernelShape, t: f64) -> f64 {
    meeting(shape) * (4.0 / 9.0) * slope(shape, 2.0 / 3.0 * t)
}

fn meeting(shape: KernelShape) -> f64 {
    0.75 / value(shape, 1.0 / 3.0)
}
