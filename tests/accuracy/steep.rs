//! Cliffs: the bisection follows the slope.

use glam::DVec3;
use terraline::scene::{Attitude, Bisection, Scene};

use super::errors;
use crate::support::{self, builtin, map, over};

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
    assert!(report.same_sheet > 500);
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
