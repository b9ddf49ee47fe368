//! Heights, normals and bounds of the terrain against an independent surface.

use glam::{DVec2, DVec3};

use super::{Dice, Naive, kernel, kernels, oracle, rough_map, scene, terrain};
use crate::oracle::kernel::Stencil;
use crate::oracle::patch::Patch;
use crate::oracle::shade;
use crate::scene::{Deformation, HeightMap, KernelShape, Outside, Surface, Terrain};

const EYE: DVec3 = DVec3::new(0.0, 9.0, 0.0);

fn of(terrain: &Terrain, kernel: crate::scene::Kernel) -> crate::oracle::Oracle {
    oracle(&scene(Surface::Terrain(terrain.clone()), kernel, EYE, DVec3::X))
}

#[test]
fn heights_match_the_definition() {
    for outside in [Outside::Sky, Outside::Clamp, Outside::Wrap] {
        let terrain = terrain(rough_map(9, 7, 3), outside);
        for kernel in kernels() {
            let oracle = of(&terrain, kernel);
            let naive = Naive { terrain: &terrain, kernel };
            let mut dice = Dice(17);
            for _ in 0..2000 {
                let (x, z) = (dice.between(-30.0, 30.0), dice.between(-15.0, 15.0));
                let height = oracle.surface_height(x, z);
                assert_eq!(height.is_some(), naive.is_over(x, z));
                if let Some(height) = height {
                    assert!((height - naive.height(x, z)).abs() < 1e-13, "{kernel:?} {x} {z}");
                }
            }
        }
    }
}

#[test]
fn two_by_two_kernels_interpolate_the_nodes() {
    let terrain = terrain(rough_map(9, 7, 8), Outside::Sky);
    for kernel in kernels() {
        if kernel.deformation == Deformation::Stretch {
            continue;
        }
        let oracle = of(&terrain, kernel);
        for (i, j) in (0..8).flat_map(|i| (0..6).map(move |j| (i, j))) {
            let height = oracle.surface_height(i as f64 * 1.5, j as f64 * 0.75).unwrap();
            assert!((height - terrain.node(i, j)).abs() < 1e-15);
        }
        // The far edge is outside.
        assert!(oracle.surface_height(8.0 * 1.5, 1.0).is_none());
        assert!(oracle.surface_height(1.0, 6.0 * 0.75).is_none());
    }
}

#[test]
fn normals_match_differences() {
    let h = 1e-6;
    let terrain = terrain(rough_map(9, 7, 21), Outside::Wrap);
    for kernel in kernels() {
        let oracle = of(&terrain, kernel);
        let mut dice = Dice(4);
        for _ in 0..500 {
            let (x, z) = (dice.between(-20.0, 20.0), dice.between(-9.0, 9.0));
            // Off the borders, where slopes may jump.
            let near = |p: f64| (2.0 * p - (2.0 * p).round()).abs() < 1e-4;
            if near(x / 1.5) || near(z / 0.75) {
                continue;
            }
            let y = |x, z| oracle.surface_height(x, z).unwrap();
            let dx = (y(x + h, z) - y(x - h, z)) / (2.0 * h);
            let dz = (y(x, z + h) - y(x, z - h)) / (2.0 * h);
            let normal = oracle.surface_normal(x, z).unwrap();
            let expected = DVec3::new(-dx, 1.0, -dz).normalize();
            assert!(normal.abs_diff_eq(expected, 1e-7), "{kernel:?} {x} {z}");
        }
    }
}

#[test]
fn a_constant_map_is_exact() {
    for outside in [Outside::Sky, Outside::Clamp, Outside::Wrap] {
        let mut terrain = terrain(HeightMap::new(5, 4, vec![61.0; 20]), outside);
        terrain.scale = 0.1;
        for kernel in kernels() {
            let oracle = of(&terrain, kernel);
            for n in 0..50 {
                let (x, z) = (f64::from(n) * 0.11, f64::from(n) * 0.04);
                assert_eq!(oracle.surface_height(x, z), Some((61.0 - 50.0) * 0.1));
                assert_eq!(oracle.surface_normal(x, z), Some(DVec3::Y));
            }
        }
    }
}

#[test]
fn the_hat_keeps_a_tilted_map() {
    let samples = (0..30).map(|n| (3 * (n % 6) + 5 * (n / 6)) as f32).collect();
    let mut terrain = terrain(HeightMap::new(6, 5, samples), Outside::Sky);
    terrain.cell = DVec2::new(2.0, 0.5);
    let oracle = of(&terrain, kernel(KernelShape::Hat, Deformation::None));
    let mut dice = Dice(2);
    for _ in 0..1000 {
        let (x, z) = (dice.between(0.0, 10.0), dice.between(0.0, 2.0));
        let expected = (3.0 * x / 2.0 + 5.0 * z / 0.5 - 50.0) * 0.03;
        assert!((oracle.surface_height(x, z).unwrap() - expected).abs() < 1e-12);
        let normal = DVec3::new(-0.03 * 1.5, 1.0, -0.03 * 10.0).normalize();
        assert!(oracle.surface_normal(x, z).unwrap().abs_diff_eq(normal, 1e-12));
    }
}

#[test]
fn rates_hold_inside_a_patch() {
    let mut dice = Dice(77);
    for kernel in kernels() {
        for _ in 0..20 {
            let stencil = Stencil::new(kernel);
            let mut nodes = [[0.0; 3]; 3].map(|row| row.map(|_: f64| dice.between(-1.0, 1.0)));
            if kernel.deformation != Deformation::Stretch {
                nodes.iter_mut().for_each(|row| row[2] = row[0]);
                nodes[2] = nodes[0];
            }
            let patch = Patch::new(stencil, nodes);
            let (dx, dz) = (dice.between(-1.0, 1.0), dice.between(-1.0, 1.0));
            let rates = patch.rates(dx, dz);
            let (low, high) = patch.range();
            for _ in 0..200 {
                let (px, pz) = (dice.between(0.001, 0.999), dice.between(0.001, 0.999));
                let at = |step: f64| patch.height(px + step * dx, pz + step * dz);
                let rate = |step| at(step).dx * dx + at(step).dz * dz;
                assert!(at(0.0).y >= low - 1e-15 && at(0.0).y <= high + 1e-15);
                assert!(rate(0.0) >= rates.low - 1e-12 && rate(0.0) <= rates.high + 1e-12);
                let h = 1e-4 * dice.roll();
                assert!((rate(h) - rate(0.0)).abs() <= rates.bend * h + 1e-12, "{kernel:?}");
            }
        }
    }
}

#[test]
fn the_ramp_is_linear_and_shaded() {
    let ramp = [[0, 0, 255], [0, 100, 0], [255, 0, 0]];
    assert_eq!(shade::ramp_color(&ramp, 0.0), DVec3::new(0.0, 0.0, 255.0));
    assert_eq!(shade::ramp_color(&ramp, 0.25), DVec3::new(0.0, 50.0, 127.5));
    assert_eq!(shade::ramp_color(&ramp, 1.0), DVec3::new(255.0, 0.0, 0.0));
    let scene = scene(
        Surface::Terrain(terrain(rough_map(3, 3, 1), Outside::Sky)),
        kernel(KernelShape::Hat, Deformation::None),
        EYE,
        DVec3::X,
    );
    let color = |normal| shade::terrain_color(&scene.color, &scene.light, (1.0, 5.0), 2.0, normal);
    // A quarter up from blue to red, in full light and in none.
    assert_eq!(color(scene.light.direction), [64, 0, 191]);
    assert_eq!(color(-scene.light.direction), [19, 0, 57]);
    let flat =
        shade::terrain_color(&scene.color, &scene.light, (5.0, 5.0), 5.0, scene.light.direction);
    assert_eq!(flat, [0, 0, 255]);
}
