//! Scenes for the benchmarks.

use terraline::plan::Plan;
use terraline::scene::{self, Scene};

/// A built-in scene at a raster of its own, with its plan.
pub fn planned(name: &str, columns: u32, lines: u32) -> (Scene, Plan) {
    let mut scene = scene::load(Some(name), &[]).expect("a built-in scene");
    scene.screens[0] = scene.screens[0].resized(columns, lines);
    let plan = Plan::new(&scene, None, false).expect("a built-in scene has a plan");
    (scene, plan)
}
