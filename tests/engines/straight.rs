//! Between two samples above the surface it may bulge up to the ray: how far, equation 33 bounds, and
//! the fast engine counts on it. Over the hat it bulges as far as that.

use glam::DVec3;
use terraline::frame::Hit;
use terraline::scene::{Attitude, Deformation, Kernel, KernelShape, Outside, Scene, WordSize};

use super::support::{assert_same, both, count, map, over, plan, terrain};

/// Rays between half and all of the height of the bulges that they run along.
fn along_bulges(shape: KernelShape, forward: DVec3, fineness: u32) -> Scene {
    let height = |i: usize, j: usize| match forward.z {
        // Along the diagonals of a chequered map: hills of half a square's height in the middle of a
        // cell, and nothing at its corners.
        z if z > 0.0 => (4 * ((i + j) % 2)) as f32,
        // Along rows, from column to column.
        _ => (2 * (i % 2)) as f32,
    };
    let mut scene = over(map(12, 12, height), 32, 24);
    terrain(&mut scene).outside = Outside::Clamp;
    scene.kernel = Kernel { shape, deformation: Deformation::None, table: 4096 };
    scene.stepper.fineness = fineness;
    let across = if forward.z > 0.0 { 2.0 } else { 5.0 };
    scene.camera.position = DVec3::new(2.0, 2.05, across);
    scene.camera.attitude = Attitude::Directions { forward, up: DVec3::Y };
    scene.screens[0].extent = terraline::scene::Extent::FieldOfView(0.2);
    scene
}

#[test]
fn a_surface_that_bulges_between_two_clear_samples_is_met() {
    let mut hits = 0;
    for forward in [DVec3::new(1.0, -0.05, 1.0), DVec3::new(1.0, -0.05, 0.0)] {
        for shape in [KernelShape::Hat, KernelShape::Parabola, KernelShape::Cosine] {
            for fineness in [1, 3, 6] {
                for words in [WordSize::Narrow, WordSize::Wide] {
                    let mut scene = along_bulges(shape, forward, fineness);
                    scene.machine.words = words;
                    let what = format!("{shape:?} along {forward}, fineness {fineness}, {words:?}");
                    let (processor, fast) = both(&scene, &plan(&scene)).expect("frames");
                    assert_same(&what, &processor, &fast);
                    hits += count(&processor, Hit::Surface);
                }
            }
        }
    }
    assert!(hits > 10_000, "{hits} hits");
}
