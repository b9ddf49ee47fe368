//! Kernel weights, at every place within a cell, against the finite functions themselves.

use terraline::oracle::kernel::Finite;
use terraline::plan::WordClass;
use terraline::plan::formats::Formats;
use terraline::scene::{Deformation, Kernel, KernelShape, WordSize};
use terraline::study::bounds;
use terraline::word::sweep::{Sweep, SweepFormat};
use terraline::word::{Class, Fixed, Load as _, Readout as _, Register, Site, World as _};

use crate::scenes::{DEFORMATIONS, interpolator, terrain, terrain_scene};
use crate::support::SHAPES;

/// The stock world with positions and weights of so many bits after the point.
fn world(place_point: u32, weight_point: u32) -> Sweep {
    let stock = Formats::stock(WordClass::NARROW).sweep(0).expect("stock formats");
    Sweep::new(|register| SweepFormat {
        point: match register.class() {
            Class::Ground => place_point as u8,
            Class::Weight => weight_point as u8,
            _ => stock.format(register).point,
        },
        ..stock.format(register)
    })
}

/// Largest error of the weight and of its derivative over all places, each over its bound.
fn shares_of_bounds(kernel: Kernel, place_point: u32, weight_point: u32) -> [f64; 2] {
    let world = world(place_point, weight_point);
    let map = terrain(2, 2, vec![0.0, 1.0, 2.0, 3.0]);
    let unit = interpolator(world, &terrain_scene(map, kernel, WordSize::Narrow), false);
    let exact = Finite::new(kernel);
    let format = Fixed { width: 32, point: weight_point };
    let bounds =
        [bounds::weight(&kernel, format, place_point), bounds::weight_slope(&kernel, format)];
    let mut largest = [0.0_f64; 2];
    for bits in 0..1 << place_point {
        let place = world.ground(Register::GroundX);
        let place = terraline::word::sweep::SweepWord::load_raw(bits, place).expect("a fraction");
        let arm = unit.arm(place, Site::pixel(0, 0));
        let t = place.value();
        largest[0] = largest[0].max((arm.weight.value() - exact.value(t)).abs());
        largest[1] = largest[1].max((arm.slope.value() - exact.slope(t)).abs());
    }
    [0, 1].map(|at| largest[at] / bounds[at])
}

/// All kernels over 2×2 nodes whose weights are not the hat's.
fn kernels(table: u32) -> impl Iterator<Item = Kernel> {
    let shapes = SHAPES.into_iter().filter(|&shape| shape != KernelShape::Hat);
    let of = move |shape| {
        let deformations = DEFORMATIONS.into_iter().filter(|&d| d != Deformation::Stretch);
        deformations.map(move |deformation| Kernel { shape, deformation, table })
    };
    shapes.flat_map(of)
}

#[test]
fn weights_keep_their_bounds_at_every_place() {
    for kernel in kernels(1024) {
        let mut largest = [0.0_f64; 2];
        for (place_point, weight_point) in [(12, 12), (14, 8), (12, 14), (16, 6), (13, 11)] {
            let shares = shares_of_bounds(kernel, place_point, weight_point);
            for (of, share) in [0, 1].map(|at| (["weight", "slope"][at], shares[at])) {
                let name = format!("{kernel:?}: {of} of {weight_point} bits at {place_point}");
                // `f64` itself is not exact.
                assert!(share < 1.0 + 1e-9, "{name}: {share} of the bound");
            }
            largest = [0, 1].map(|at| largest[at].max(shares[at]));
        }
        // A difference that is shifted further has too few bits to lose a whole one.
        if !matches!(kernel.deformation, Deformation::TowardHat { weight_shift: 3.. }) {
            assert!(largest.iter().all(|&share| share > 0.85), "{kernel:?}: {largest:?}");
        }
    }
}

#[test]
fn all_errors_of_a_weight_may_meet() {
    // With 8 bits after the point and a quarter of the shape: 1.25 ulp, and little from the table.
    let deformation = Deformation::TowardHat { weight_shift: 2 };
    let kernel = Kernel { shape: KernelShape::Cosine, deformation, table: 4096 };
    let bound = bounds::weight(&kernel, Fixed { width: 32, point: 8 }, 20) * 256.0;
    assert!((1.25..1.27).contains(&bound), "{bound} ulp");
    let [weight, slope] = shares_of_bounds(kernel, 20, 8);
    assert!((0.97..1.0).contains(&weight), "{weight} of the bound");
    assert!((0.9..1.0).contains(&slope), "{slope} of the bound");
}
