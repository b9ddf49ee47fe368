//! Cliffs: λ of a hit is the ray's, and the bisection follows the slope.

use glam::DVec3;
use proptest::prelude::*;
use terraline::engine::Engine;
use terraline::frame::Hit;
use terraline::plan::{Plan, SurfacePlan};
use terraline::scene::{Attitude, Bisection, Scene, WordSize};

use super::errors;
use crate::support::{self, builtin, map, over, runner};

/// A cliff from near 0 to `top` across a map of 24 × 24 nodes, and an eye before it.
fn cliff(top: f32) -> Scene {
    let height = move |i, j| if i >= 12 { top } else { ((i * 7 + j * 5) % 9) as f32 / 4.0 };
    let mut scene = over(map(24, 24, height), 320, 240);
    scene.camera.position = DVec3::new(-40.0, f64::from(top) / 2.0, 12.0);
    scene.camera.attitude =
        Attitude::Directions { forward: DVec3::new(1.0, -0.3, 0.05), up: DVec3::Y };
    scene
}

#[test]
fn the_bisection_follows_the_slope() {
    let scene = cliff(6000.0);
    let report = errors(&scene, 40);
    assert!(report.counts.same_sheet > 500);
    let total = report.total_px.expect("pixels");
    // A step to 1/64 of a pixel alone, without regard to the slope, is 12 pixels off in the median.
    assert!(total.median < 1.5 && total.max < 4.0, "{total:?}");
    let why = support::plan(&scene).words_why;
    assert!(why.contains("slopes of up to 12000 take 10 more bisection steps"), "{why}");
    // Not where a scene gives the number, and not on gentle maps.
    let mut fixed = scene;
    fixed.stepper.halvings = Bisection::Fixed(4);
    for scene in [fixed, cliff(5.0), builtin("overview", 64, 48), builtin("valley", 64, 48)] {
        let why = support::plan(&scene).words_why;
        assert!(!why.contains("bisection"), "{why}");
    }
}

/// Steps of the machine on a ray, in λ: at most.
fn step(scene: &Scene, plan: &Plan, line: f64, column: f64) -> f64 {
    let SurfacePlan::Terrain(walk) = &plan.surfaces[0] else { panic!("a height map") };
    let view = plan.geometry.view.at(line, column) / walk.lengths;
    (-f64::from(scene.stepper.fineness)).exp2() / view.abs().max_element()
}

#[test]
fn lambda_is_the_rays_on_steep_ground() {
    let strategy = (
        prop::collection::vec(prop_oneof![0.0..4.0_f32, 100.0..3000.0_f32], 144),
        (0..=3_u32, 0..6_u32),
        (-8.0..20.0_f64, 0.3..1.3_f64, -8.0..20.0_f64),
        (-1.0..1.0_f64, -1.2..0.2_f64, -1.0..1.0_f64),
        any::<bool>(),
    );
    let seen = std::sync::Mutex::new([0_usize; 2]);
    let result = runner(60).run(&strategy, |(nodes, (fineness, times), eye, forward, wide)| {
        let highest = f64::from(nodes.iter().copied().fold(0.0, f32::max));
        let mut scene = over(map(12, 12, |i, j| nodes[12 * j + i]), 32, 24);
        scene.camera.position = DVec3::new(eye.0, eye.1 * highest + 1.0, eye.2);
        let forward = DVec3::new(forward.0, forward.1, forward.2 + 0.01);
        scene.camera.attitude = Attitude::Directions { forward, up: DVec3::new(0.01, 1.0, 0.0) };
        scene.stepper.fineness = fineness;
        scene.stepper.halvings = Bisection::Fixed(times);
        scene.machine.words = if wide { WordSize::Wide } else { WordSize::Auto };
        let Ok(plan) = Plan::new(&scene, None, false) else { return Ok(()) };
        let Ok(machine) = support::machine(&scene, &plan) else { return Ok(()) };
        let [ours, theirs] = [Engine::Fast, Engine::Oracle]
            .map(|engine| machine.frame(engine, true).expect("a frame"));
        let lambda = |frame: &terraline::frame::Frame, at: usize| {
            frame.buffers.as_ref().expect("asked for").lambda[at]
        };
        let mut seen = seen.lock().expect("one thread");
        for (at, hit) in ours.hit.iter().enumerate() {
            if !matches!(hit, Hit::Surface | Hit::Side) {
                continue;
            }
            let found = lambda(&ours, at);
            prop_assert!(found > 0.0, "pixel {at}: λ = {found}");
            if *hit == Hit::Surface && theirs.hit[at] == Hit::Surface {
                let step = step(&scene, &plan, (at / 32) as f64, (at % 32) as f64);
                // A coarse walk may miss a thin peak, and see what lies behind it.
                seen[usize::from((found - lambda(&theirs, at)).abs() > 1.5 * step)] += 1;
            }
        }
        Ok(())
    });
    result.unwrap();
    let [near, far] = seen.into_inner().expect("one thread");
    println!("{near} within a step and a half of the oracle's λ, {far} not");
    assert!(near > 3000 && far * 12 < near, "{near} near, {far} far");
}
