//! Defining properties of the finite functions.

use super::{SHAPES, kernel, kernels};
use crate::oracle::kernel::{Finite, Stencil};
use crate::scene::{Deformation, KernelShape};

#[test]
fn finite_functions_keep_their_properties() {
    for k in kernels() {
        let f = Finite::new(k);
        assert_eq!(f.value(0.0), 1.0, "{k:?}");
        assert_eq!(f.value(1.0), 0.0);
        assert_eq!(f.value(-1.5), 0.0);
        for n in 0..=1000 {
            let t = f64::from(n) / 1000.0;
            assert!((f.value(t) + f.value(t - 1.0) - 1.0).abs() < 1e-15, "{k:?} {t}");
            assert_eq!(f.value(t), f.value(-t));
            assert!(f.slope(t).abs() <= f.slope_bound() * (1.0 + 1e-15), "{k:?} {t}");
        }
    }
}

#[test]
fn slopes_are_differences() {
    let h = 1e-6;
    for k in kernels() {
        let f = Finite::new(k);
        let mut curvature: f64 = 0.0;
        for n in -999..1000 {
            // Off the nodes and the joints.
            let t = f64::from(n) / 1000.0 + 0.0003;
            let difference = (f.value(t + h) - f.value(t - h)) / (2.0 * h);
            assert!((f.slope(t) - difference).abs() < 1e-8, "{k:?} {t}");
            curvature = curvature.max(((f.slope(t + h) - f.slope(t - h)) / (2.0 * h)).abs());
        }
        assert!(curvature <= f.curvature_bound() + 1e-6, "{k:?} {curvature}");
        assert!(curvature >= 0.99 * f.curvature_bound() - 1e-9, "{k:?} {curvature}");
    }
}

#[test]
fn smooth_shapes_are_level_at_nodes() {
    for shape in [KernelShape::Cosine, KernelShape::Parabola, KernelShape::Exponential] {
        let f = Finite::new(kernel(shape, Deformation::None));
        assert!(f.slope(0.0).abs() < 1e-15 && f.slope(1.0).abs() < 1e-15);
    }
}

#[test]
fn deformation_2_runs_from_the_shape_to_the_hat() {
    for shape in SHAPES {
        let plain = Finite::new(kernel(shape, Deformation::None));
        let hat = Finite::new(kernel(KernelShape::Hat, Deformation::None));
        let toward_hat =
            |weight_shift| Finite::new(kernel(shape, Deformation::TowardHat { weight_shift }));
        for n in 0..100 {
            let t = f64::from(n) / 100.0;
            assert!((toward_hat(0).value(t) - plain.value(t)).abs() < 1e-15);
            assert!((toward_hat(64).value(t) - hat.value(t)).abs() < 1e-16);
            assert_eq!(toward_hat(u32::MAX).value(t), hat.value(t));
            let quarter = 0.75 * hat.value(t) + 0.25 * plain.value(t);
            assert!((toward_hat(2).value(t) - quarter).abs() < 1e-15);
        }
    }
}

#[test]
fn stretched_weights_are_the_known_ones() {
    let at = |shape, t: f64| Stencil::new(kernel(shape, Deformation::Stretch)).weights(t + 0.5);
    // The cosine: ⅔ in the middle and 1/6 on either side, and ½ each on a border.
    let middle = at(KernelShape::Cosine, 0.0);
    assert!((middle.a - 1.0 / 6.0).abs() < 1e-15 && (middle.b - 1.0 / 6.0).abs() < 1e-15);
    let border = at(KernelShape::Cosine, 0.5);
    assert!(border.a.abs() < 1e-15 && (border.b - 0.5).abs() < 1e-15);
    for shape in SHAPES {
        for n in 0..=100 {
            let w = at(shape, f64::from(n) / 100.0 - 0.5);
            assert!(w.a >= 0.0 && w.b >= 0.0 && w.a + w.b <= 1.0, "{shape:?}");
            assert!(w.da <= 0.0 && w.db >= 0.0);
        }
        assert!((at(shape, 0.5).b - 0.5).abs() < 1e-15, "{shape:?} patches meet");
    }
}
