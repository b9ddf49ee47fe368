//! Outcomes with known answers: sides, the base, reach, touching rays, whole frames.

use glam::{DVec2, DVec3};

use super::{kernel, kernels, oracle, rough_map, scene, terrain};
use crate::frame::Hit;
use crate::oracle::{Oracle, Sighting};
use crate::scene::{Deformation, HeightMap, KernelShape, Outside, Surface, Terrain};

/// The sighting along one direction.
fn sight(terrain: &Terrain, kernel: crate::scene::Kernel, eye: DVec3, to: DVec3) -> Sighting {
    let mut scene = scene(Surface::Terrain(terrain.clone()), kernel, eye, to - eye);
    (scene.screens[0].columns, scene.screens[0].lines) = (3, 3);
    oracle(&scene).with_reach_cells(100.0).pixel(1.0, 1.0)
}

fn flat(outside: Outside) -> Terrain {
    let mut terrain = terrain(HeightMap::new(11, 11, vec![60.0; 121]), outside);
    (terrain.cell, terrain.offset, terrain.scale) = (DVec2::ONE, 50.0, 0.1);
    terrain
}

#[test]
fn a_flat_map_is_a_plane() {
    for kernel in kernels() {
        let to = DVec3::new(3.3, 1.0, 4.4);
        let seen = sight(&flat(Outside::Sky), kernel, DVec3::new(-5.0, 7.0, -9.0), to);
        assert_eq!(seen.hit, Hit::Surface, "{kernel:?}");
        assert!(seen.point.abs_diff_eq(to, 1e-13), "{:?}", seen.point);
        assert_eq!(seen.normal, DVec3::Y);
    }
}

#[test]
fn straight_down_hits_what_is_there() {
    for outside in [Outside::Sky, Outside::Clamp, Outside::Wrap] {
        let terrain = terrain(rough_map(9, 7, 4), outside);
        for kernel in kernels() {
            let mut scene = scene(
                Surface::Terrain(terrain.clone()),
                kernel,
                DVec3::new(5.3, 30.0, 2.9),
                DVec3::NEG_Y,
            );
            scene.camera.attitude =
                crate::scene::Attitude::Directions { forward: DVec3::NEG_Y, up: DVec3::X };
            (scene.screens[0].columns, scene.screens[0].lines) = (3, 3);
            let oracle = oracle(&scene);
            let seen = oracle.pixel(1.0, 1.0);
            let height = oracle.surface_height(5.3, 2.9).unwrap();
            assert_eq!(seen.hit, Hit::Surface);
            assert!((seen.lambda - (30.0 - height)).abs() < 1e-12);
            // And straight up from there is sky.
            scene.camera.position.y = height + 0.01;
            scene.camera.attitude =
                crate::scene::Attitude::Directions { forward: DVec3::Y, up: DVec3::X };
            assert_eq!(Oracle::new(&scene, &scene.screens[0]).pixel(1.0, 1.0).hit, Hit::Sky);
        }
    }
}

#[test]
fn sides_and_base() {
    // Surface at 1, base at −1 (depth 2 under the lowest node).
    let map = flat(Outside::Sky);
    for kernel in kernels() {
        let eye = DVec3::new(-5.0, 3.0, 5.0);
        let at = |y| sight(&map, kernel, eye, DVec3::new(0.0, y, 5.0));
        assert_eq!(at(1.01).hit, Hit::Surface);
        let side = at(0.5);
        assert_eq!((side.hit, side.color), (Hit::Side, [90, 70, 50]));
        assert!(side.point.abs_diff_eq(DVec3::new(0.0, 1.0, 5.0), 1e-12));
        assert_eq!(at(-0.99).hit, Hit::Side);
        assert_eq!(at(-1.01).hit, Hit::Sky);
        // From the far edges as well, and from below upwards.
        let east = DVec3::new(15.0, 3.0, 5.0);
        assert_eq!(sight(&map, kernel, east, DVec3::new(10.0, 0.5, 5.0)).hit, Hit::Side);
        assert_eq!(sight(&map, kernel, east, DVec3::new(10.0, 1.1, 5.0)).hit, Hit::Surface);
        let deep = DVec3::new(5.0, -9.0, 15.0);
        assert_eq!(sight(&map, kernel, deep, DVec3::new(5.0, -3.0, 10.0)).hit, Hit::Side);
        // Past the corner, and over the map.
        assert_eq!(sight(&map, kernel, eye, DVec3::new(0.0, 0.0, 11.0)).hit, Hit::Sky);
        assert_eq!(sight(&map, kernel, eye, DVec3::new(10.0, 1.5, 5.0)).hit, Hit::Sky);
    }
}

#[test]
fn a_hole_has_sides_and_no_floor() {
    // Surface at 1, base at −1; node (5, 5) has no data.
    for outside in [Outside::Sky, Outside::Clamp, Outside::Wrap] {
        for kernel in kernels() {
            let mut samples = vec![60.0; 121];
            samples[5 * 11 + 5] = f32::NAN;
            let mut map = flat(outside);
            map.map = std::sync::Arc::new(HeightMap::new(11, 11, samples));
            // Cells 4 and 5, or one more half at either end where nine nodes are mixed.
            let reach = if kernel.deformation == Deformation::Stretch { 1.5 } else { 1.0 };
            let (west, east) = (5.0 - reach, 5.0 + reach);
            let eye = DVec3::new(2.0, 3.0, 5.0);
            let at = |x, y| sight(&map, kernel, eye, DVec3::new(x, y, 5.0));
            assert_eq!(at(west - 0.01, 1.0).hit, Hit::Surface);
            assert_eq!(at(east + 0.01, 1.0).hit, Hit::Surface);
            let side = at(east, 0.5);
            assert_eq!((side.hit, side.color), (Hit::Side, [90, 70, 50]));
            assert!(side.point.abs_diff_eq(DVec3::new(east, 1.0, 5.0), 1e-12), "{side:?}");
            let down = DVec3::new(0.2, -1.0, 0.0);
            let steep = DVec3::new(west + 0.01, 1.0, 5.0);
            assert_eq!(sight(&map, kernel, steep - down, steep + down).hit, Hit::Sky);
            // An eye in the hole, under the ground around it.
            let inside = |to| sight(&map, kernel, DVec3::new(5.0, -0.5, 5.0), to);
            assert_eq!(inside(DVec3::new(east, -0.9, 5.0)).hit, Hit::Side);
            assert_eq!(inside(DVec3::new(east, -1.1, 5.0)).hit, Hit::Sky);
            assert_eq!(inside(DVec3::new(5.0, 2.0, 5.5)).hit, Hit::Sky);
            let scene = scene(Surface::Terrain(map.clone()), kernel, eye, DVec3::X);
            let oracle = oracle(&scene);
            assert_eq!(oracle.surface_height(5.0, 5.0), None);
            assert_eq!(oracle.surface_height(west + 1e-9, 5.0), None);
            assert_eq!(oracle.surface_height(west - 1e-9, 5.0), Some(1.0));
            assert_eq!(oracle.surface_normal(5.2, 4.8), None);
        }
    }
}

#[test]
fn maps_without_end_have_a_reach() {
    for outside in [Outside::Clamp, Outside::Wrap] {
        for kernel in kernels() {
            let map = flat(outside);
            let eye = DVec3::new(5.0, 3.0, 5.0);
            let seen = |x| sight(&map, kernel, eye, DVec3::new(x, 1.0, 5.0));
            assert_eq!(seen(104.0).hit, Hit::Surface);
            assert!((seen(-80.0).point.x + 80.0).abs() < 1e-11);
            assert_eq!((seen(106.0).hit, seen(106.0).color), (Hit::OutOfRange, [200, 210, 220]));
            let over = sight(&map, kernel, eye, DVec3::new(50.0, 3.1, 5.0));
            assert_eq!(over.hit, Hit::Sky);
        }
    }
}

#[test]
fn a_wrapped_map_has_the_period_of_its_nodes() {
    let map = terrain(rough_map(9, 7, 4), Outside::Wrap);
    for kernel in kernels() {
        let (eye, to) = (DVec3::new(1.0, 9.0, 2.0), DVec3::new(9.0, 0.0, 5.0));
        let here = sight(&map, kernel, eye, to);
        let shift = DVec3::new(-3.0 * 9.0 * 1.5, 0.0, 2.0 * 7.0 * 0.75);
        let there = sight(&map, kernel, eye + shift, to + shift);
        assert!((here.lambda - there.lambda).abs() < 1e-11);
        assert!(here.point.abs_diff_eq(there.point - shift, 1e-11));
    }
}

#[test]
fn a_grazing_ray_is_called_tangent() {
    // One high node; the cosine is level over it, and the ray just touches it.
    let mut samples = vec![50.0; 121];
    samples[5 * 11 + 5] = 60.0;
    let mut map = flat(Outside::Sky);
    map.map = std::sync::Arc::new(HeightMap::new(11, 11, samples));
    let cosine = kernel(KernelShape::Cosine, Deformation::None);
    let over = |y: f64| sight(&map, cosine, DVec3::new(-3.0, y, 5.0), DVec3::new(5.0, y, 5.0));
    assert!(over(1.0 - 1e-15).tangent);
    assert_eq!(over(1.0 - 1e-9).hit, Hit::Surface);
    assert!(!over(1.0 - 1e-9).tangent);
    assert_eq!((over(1.0 + 1e-9).hit, over(1.0 + 1e-9).tangent), (Hit::Sky, false));
}

#[test]
fn frames_hold_their_pixels() {
    let kernel = kernel(KernelShape::Cosine, Deformation::TowardHat { weight_shift: 2 });
    let terrain = terrain(rough_map(20, 20, 4), Outside::Sky);
    let (eye, forward) = (DVec3::new(-3.0, 2.0, 7.0), DVec3::new(1.0, -0.5, 0.0));
    let oracle = oracle(&scene(Surface::Terrain(terrain), kernel, eye, forward));
    let frame = oracle.frame();
    let buffers = frame.buffers.unwrap();
    assert_eq!((frame.columns, frame.lines, frame.hit.len()), (64, 48, 64 * 48));
    for (line, column) in [(0, 0), (20, 31), (30, 60), (47, 63)] {
        let index = line * 64 + column;
        let pixel = oracle.pixel(line as f64, column as f64);
        assert_eq!((frame.hit[index], frame.color[index]), (pixel.hit, pixel.color));
        assert_eq!(buffers.lambda[index].to_bits(), pixel.lambda.to_bits());
        assert_eq!(buffers.height[index].to_bits(), pixel.point.y.to_bits());
    }
    assert!(frame.hit.contains(&Hit::Surface) && frame.hit.contains(&Hit::Side));
    assert!(buffers.steps.iter().all(|&steps| steps == 0) && buffers.trials.is_empty());
}
