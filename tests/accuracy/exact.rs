//! Surfaces whose every height is exact: constant maps under all kernels, tilted ones under the
//! hat.

use glam::DVec3;
use terraline::frame::{Frame, Hit};
use terraline::scene::{Attitude, Deformation, Kernel, KernelShape, Outside, Scene, WordSize};

use super::support::{SHAPES, count, drawn, map, over, plan, terrain};

/// Both word sizes' frames, each with many pixels on the surface.
fn frames(scene: &Scene) -> Vec<Frame> {
    [WordSize::Narrow, WordSize::Wide]
        .map(|words| {
            let mut scene = scene.clone();
            scene.machine.words = words;
            let frame = drawn(&scene, &plan(&scene)).expect("a frame");
            assert!(count(&frame, Hit::Surface) > 250, "{} hits", count(&frame, Hit::Surface));
            frame
        })
        .into()
}

/// Every surface pixel's (x, z), height and normal.
fn hits(frame: &Frame) -> impl Iterator<Item = (f64, f64, f64, [f64; 3])> + '_ {
    let buffers = frame.buffers.as_ref().expect("buffers");
    (0..frame.hit.len())
        .filter(|&i| frame.hit[i] == Hit::Surface)
        .map(|i| (buffers.ground_x[i], buffers.ground_z[i], buffers.height[i], buffers.normal[i]))
}

#[test]
fn constant_maps_are_exact_under_every_kernel() {
    let mut deformations = vec![Deformation::None, Deformation::Stretch];
    deformations.extend([0, 1, 5, 40].map(|weight_shift| Deformation::TowardHat { weight_shift }));
    for height in [0.0, 7.25, -3.625, 1.0 / 3.0] {
        for shape in SHAPES {
            for &deformation in &deformations {
                let mut scene = over(map(20, 30, |_, _| height), 48, 40);
                scene.kernel = Kernel { shape, deformation, table: 256 };
                for full in [false, true] {
                    let plan = terraline::plan::Plan::new(&scene, None, full).expect("a plan");
                    let frame = drawn(&scene, &plan).expect("a frame");
                    assert!(count(&frame, Hit::Surface) > 800);
                    for (x, z, y, normal) in hits(&frame) {
                        assert_eq!(y, f64::from(height), "{shape:?} {deformation:?} at {x}, {z}");
                        assert_eq!(normal, [0.0, 1.0, 0.0], "{shape:?} {deformation:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn full_light_is_the_colour_of_the_ramp() {
    let mut scene = over(map(20, 30, |_, _| 3.0), 48, 40);
    (scene.light.direction, scene.light.ambient) = (DVec3::Y, 0.0);
    scene.color.ramp[0] = [255, 128, 1];
    for frame in frames(&scene) {
        let lit = (0..frame.hit.len()).filter(|&at| frame.hit[at] == Hit::Surface);
        assert!(lit.into_iter().all(|at| frame.color[at] == [255, 128, 1]));
    }
}

#[test]
fn tilted_maps_are_exact_under_the_hat() {
    for (rise_x, rise_z) in [(2.0, 0.0), (0.0, -3.0), (1.0, 2.0), (-2.0, -1.0)] {
        for (outside, above) in [(Outside::Sky, 15.0), (Outside::Sky, 40.0), (Outside::Clamp, 15.0)]
        {
            let plane = |x: f64, z: f64| 0.625 + rise_x * x + rise_z * z;
            let mut scene = over(map(21, 21, |i, j| plane(i as f64, j as f64) as f32), 48, 40);
            terrain(&mut scene).outside = outside;
            scene.kernel =
                Kernel { shape: KernelShape::Hat, deformation: Deformation::None, table: 16 };
            scene.camera.position = DVec3::new(10.25, plane(10.25, 9.5) + above, 9.5);
            scene.camera.attitude =
                Attitude::Directions { forward: DVec3::NEG_Y, up: DVec3::new(1.0, 0.0, 3.0) };
            for frame in frames(&scene) {
                let normal = DVec3::new(-rise_x, 1.0, -rise_z).normalize().to_array();
                let inside = |p: f64| (0.0..20.0).contains(&p);
                let mut seen = 0;
                for (x, z, y, n) in hits(&frame).filter(|(x, z, ..)| inside(*x) && inside(*z)) {
                    assert_eq!(y, plane(x, z), "at {x}, {z}");
                    assert_eq!(n, normal, "at {x}, {z}");
                    seen += 1;
                }
                assert!(seen > 250, "{seen} pixels of the slope ({rise_x}, {rise_z})");
            }
        }
    }
}

#[test]
fn gentle_slopes_are_within_a_bit_under_the_hat() {
    // Rises that are not whole bits a cell: two roundings of half a bit, and exact slopes.
    let (rise_x, rise_z) = (0.125, -0.375);
    let plane = |x: f64, z: f64| 8.0 + rise_x * x + rise_z * z;
    let mut scene = over(map(21, 21, |i, j| plane(i as f64, j as f64) as f32), 48, 40);
    scene.kernel = Kernel {
        shape: KernelShape::Hat,
        deformation: Deformation::TowardHat { weight_shift: 3 },
        table: 16,
    };
    let ulps = [2_f64.powi(-20), 2_f64.powi(-24)];
    for (frame, ulp) in frames(&scene).iter().zip(ulps) {
        let mut inexact = 0;
        for (x, z, y, normal) in hits(frame) {
            let off = (y - plane(x, z)).abs();
            assert!(off <= ulp, "at {x}, {z}: {} ulp", off / ulp);
            inexact += usize::from(off > 0.0);
            assert_eq!(normal, DVec3::new(-rise_x, 1.0, -rise_z).normalize().to_array());
        }
        assert!(inexact > 100, "the rounding is seen: {inexact}");
    }
}

#[test]
fn a_large_weight_shift_is_the_hat() {
    let bumps = || map(15, 12, |i, j| ((i * 7 + j * 5) % 11) as f32 / 4.0);
    for shape in SHAPES {
        let mut shifted = over(bumps(), 40, 30);
        shifted.kernel =
            Kernel { shape, deformation: Deformation::TowardHat { weight_shift: 64 }, table: 64 };
        let mut hat = shifted.clone();
        hat.kernel = Kernel { shape: KernelShape::Hat, deformation: Deformation::None, table: 64 };
        for (a, b) in frames(&shifted).iter().zip(&frames(&hat)) {
            super::support::assert_same("shifted and hat", a, b);
        }
    }
}
