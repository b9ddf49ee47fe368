//! The finite functions, their slopes and the bounds on their derivatives.
//!
//! A finite function f is even, zero for |t| ≥ 1 and has f(0) = 1 and f(t) + f(t−1) = 1 on
//! \[0, 1\], so that the values at two neighbouring nodes are mixed with weights that sum to one.
//! Everything here is the exact function; there are no tables.

use std::f64::consts::{LN_2, PI};

use crate::scene::{Deformation, Kernel, KernelShape};

/// A finite function on [−1, 1], after deformation 2 where there is one:
/// `f² = f₂ + a (f − f₂)`, f₂ the hat. Dimensionless; t in cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finite {
    shape: KernelShape,
    /// a: the share of the shape against the hat; 1 without deformation 2.
    share: f64,
}

impl Finite {
    /// The basic function of a kernel, deformation 2 included, deformation 1 left out.
    #[must_use]
    pub fn new(kernel: Kernel) -> Self {
        let share = match kernel.deformation {
            Deformation::None | Deformation::Stretch => 1.0,
            // Beyond the exponents of f64 the share is zero and the function is the hat.
            Deformation::TowardHat { weight_shift } => {
                0.5f64.powi(i32::try_from(weight_shift).unwrap_or(i32::MAX))
            }
        };
        Self { shape: kernel.shape, share }
    }

    /// f(t).
    #[must_use]
    pub fn value(&self, t: f64) -> f64 {
        let t = t.abs();
        if t >= 1.0 {
            return 0.0;
        }
        let hat = 1.0 - t;
        hat + self.share * (self.shape_value(t) - hat)
    }

    /// f′(t), per cell. At the kinks of the hat: the slope towards larger |t| at t = 0 (seen from
    /// the right), and the slope towards smaller |t| at |t| = 1.
    #[must_use]
    pub fn slope(&self, t: f64) -> f64 {
        let distance = t.abs();
        if distance > 1.0 {
            return 0.0;
        }
        let slope = -1.0 + self.share * (self.shape_slope(distance) + 1.0);
        if t < 0.0 { -slope } else { slope }
    }

    /// A bound of |f′|, reached for every shape without deformation.
    #[must_use]
    pub fn slope_bound(&self) -> f64 {
        let shape = match self.shape {
            KernelShape::Cosine => PI / 2.0,
            KernelShape::Parabola => 2.0,
            // 8 ln2 t 2^(−4t²) at t² = 1/(8 ln2).
            KernelShape::Exponential => (8.0 * LN_2).sqrt() * (-0.5f64).exp(),
            KernelShape::Hat => 1.0,
        };
        1.0 + self.share * (shape - 1.0)
    }

    /// A bound of the Lipschitz constant of f′ between two nodes.
    #[must_use]
    pub fn curvature_bound(&self) -> f64 {
        let shape = match self.shape {
            KernelShape::Cosine => PI * PI / 2.0,
            KernelShape::Parabola => 4.0,
            KernelShape::Exponential => 8.0 * LN_2,
            KernelShape::Hat => 0.0,
        };
        self.share * shape
    }

    /// The shape for 0 ≤ t ≤ 1.
    fn shape_value(&self, t: f64) -> f64 {
        let s = 1.0 - t;
        match self.shape {
            KernelShape::Cosine => ((PI * t).cos() + 1.0) / 2.0,
            KernelShape::Parabola if t < 0.5 => 1.0 - 2.0 * t * t,
            KernelShape::Parabola => 2.0 * s * s,
            KernelShape::Exponential if t < 0.5 => (-4.0 * t * t).exp2(),
            KernelShape::Exponential => 1.0 - (-4.0 * s * s).exp2(),
            KernelShape::Hat => s,
        }
    }

    /// The slope of the shape for 0 ≤ t ≤ 1.
    fn shape_slope(&self, t: f64) -> f64 {
        let s = 1.0 - t;
        match self.shape {
            KernelShape::Cosine => -PI / 2.0 * (PI * t).sin(),
            KernelShape::Parabola => -4.0 * t.min(s),
            KernelShape::Exponential => {
                let t = t.min(s);
                -8.0 * LN_2 * t * (-4.0 * t * t).exp2()
            }
            KernelShape::Hat => -1.0,
        }
    }
}

/// Weights of the nodes along one axis at a point of a patch, and their slopes per cell.
///
/// The weight of the pivot node is implicit, `1 − a − b`: a constant map comes out exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// Weight of the node before the pivot; falls with the coordinate.
    pub a: f64,
    /// Weight of the node after the pivot; grows with the coordinate; 0 over two nodes.
    pub b: f64,
    /// Slope of `a`, never positive.
    pub da: f64,
    /// Slope of `b`, never negative.
    pub db: f64,
}

/// Which nodes an axis mixes, and how.
///
/// The axis is cut into unit patches, inside which the surface is smooth. Over two nodes a patch
/// lies between neighbouring nodes, its pivot is the node at its end, and `a = f(p)` for
/// p in \[0, 1\]. Under deformation 1 a patch lies around its nearest node, the pivot, and with
/// t = p − ½, g(x) = ⅔ f(⅔x): `a = α g(t + 1)`, `b = α g(t − 1)`, with α = ¾ / f(⅓), so that
/// neighbouring patches meet half-way between their pivots; it is 1 for the cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stencil {
    finite: Finite,
    stretched: bool,
    /// α; unused over two nodes.
    meeting: f64,
}

impl Stencil {
    /// The stencil of a kernel.
    #[must_use]
    pub fn new(kernel: Kernel) -> Self {
        let finite = Finite::new(kernel);
        let stretched = kernel.deformation == Deformation::Stretch;
        Self { finite, stretched, meeting: 0.75 / finite.value(1.0 / 3.0) }
    }

    /// The weights at p in \[0, 1\] of a patch.
    #[must_use]
    pub fn weights(&self, p: f64) -> Weights {
        const STRETCH: f64 = 2.0 / 3.0;
        let f = &self.finite;
        if self.stretched {
            let (before, after) = (STRETCH * (p + 0.5), STRETCH * (p - 1.5));
            Weights {
                a: self.meeting * STRETCH * f.value(before),
                b: self.meeting * STRETCH * f.value(after),
                da: self.meeting * STRETCH * STRETCH * f.slope(before),
                db: self.meeting * STRETCH * STRETCH * f.slope(after),
            }
        } else {
            Weights { a: f.value(p), b: 0.0, da: f.slope(p), db: 0.0 }
        }
    }

    /// Where patch 0 begins: at node 0, or half a cell before it under deformation 1.
    #[must_use]
    pub fn shift(&self) -> f64 {
        if self.stretched { 0.5 } else { 0.0 }
    }

    /// Nodes of patch 0 in the order pivot, before, after. Over two nodes the third repeats the
    /// pivot and has weight 0.
    #[must_use]
    pub fn nodes(&self) -> [i64; 3] {
        if self.stretched { [0, -1, 1] } else { [1, 0, 1] }
    }

    /// A bound of |da| and |db|, per cell.
    #[must_use]
    pub fn slope_bound(&self) -> f64 {
        let factor = if self.stretched { self.meeting * 4.0 / 9.0 } else { 1.0 };
        factor * self.finite.slope_bound()
    }

    /// A bound of the Lipschitz constants of da and db inside a patch, per cell squared.
    #[must_use]
    pub fn curvature_bound(&self) -> f64 {
        let factor = if self.stretched { self.meeting * 8.0 / 27.0 } else { 1.0 };
        factor * self.finite.curvature_bound()
    }
}
