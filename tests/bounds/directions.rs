//! Steps of rays in the registers, against the directions of the oracle: on the screen, in pixels.

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use terraline::plan::formats::Formats;
use terraline::plan::{Plan, SurfacePlan};
use terraline::scene::{Angles, Attitude, Scene, WordSize};
use terraline::study::bounds;
use terraline::word::Register;

use crate::scenes::{terrain, terrain_scene};
use crate::support::{self, runner};

/// A map of cells with these sides, seen from above by a screen of `size` pixels a side.
fn scene(cell: DVec2, size: u32, angles: Angles, words: WordSize) -> Scene {
    let mut map = terrain(9, 9, (0..81).map(|at| (at * at % 23) as f32 / 8.0).collect());
    map.cell = cell;
    let kernel = terraline::scene::Kernel::default();
    let mut scene = terrain_scene(map, kernel, words);
    scene.camera.position = DVec3::new(4.0 * cell.x, 3.0 * cell.max_element() + 4.0, 4.0 * cell.y);
    scene.camera.attitude = Attitude::Angles(angles);
    (scene.screens[0].columns, scene.screens[0].lines) = (size, size);
    scene
}

/// Pixels by which the step of a pixel's ray is off on the screen, over the bound of the plan; none
/// where no ray is stepped.
fn share_of_bound(scene: &Scene, plan: &Plan, column: u32, line: u32) -> Option<f64> {
    let SurfacePlan::Terrain(walk) = &plan.surfaces[0] else { panic!("a height map") };
    let machine = support::machine(scene, plan).expect("a machine");
    let explanation = machine.explain(column, line).expect("a pixel");
    let value =
        |what: &str| explanation.rows.iter().find(|row| row.what == what).map(|row| row.value);
    let step = DVec3::new(value("step, x")?, value("step, y")?, value("step, z")?) * walk.lengths;
    let geometry = &plan.geometry;
    let exact = machine.oracle().direction(line.into(), column.into());
    let on_screen = |ray: DVec3| {
        let along = geometry.axes.transpose() * ray;
        DVec2::new(along.z, along.y) / along.x
    };
    let distance = exact.dot(geometry.axes.x_axis);
    let off = (on_screen(step) - on_screen(exact)) * distance / geometry.pitch;
    let formats = Formats::stock(plan.words);
    let view = bounds::view(formats.fixed(Register::ViewX), line, column);
    let bound = walk.step_rounding(geometry, &formats) + walk.drift_in_pixels(geometry, view);
    Some(off.length() / bound)
}

#[test]
fn steps_are_off_by_no_more_than_the_plan_says() {
    let side = || (-5.0..10.0_f64).prop_map(f64::exp2);
    let turn = -3.0..3.0_f64;
    let strategy = (
        (side(), side()),
        2..700_u32,
        (turn.clone(), -1.5..0.3_f64, turn),
        any::<bool>(),
        prop::collection::vec((any::<u16>(), any::<u16>()), 6),
    );
    let found = std::sync::Mutex::new((0_usize, 0.0_f64));
    let result =
        runner(400).run(&strategy, |((x, z), size, (heading, pitch, roll), wide, pixels)| {
            let words = if wide { WordSize::Wide } else { WordSize::Narrow };
            let scene = scene(DVec2::new(x, z), size, Angles { heading, pitch, roll }, words);
            let Ok(plan) = Plan::new(&scene, None, false) else { return Ok(()) };
            for (column, line) in pixels {
                let (column, line) = (u32::from(column) % size, u32::from(line) % size);
                let Some(share) = share_of_bound(&scene, &plan, column, line) else { continue };
                // The bound is of first order.
                prop_assert!(share < 1.01, "column {column}, line {line}: {share} of the bound");
                let mut found = found.lock().expect("one thread");
                *found = (found.0 + 1, found.1.max(share));
            }
            Ok(())
        });
    result.unwrap();
    let (measured, largest) = found.into_inner().expect("one thread");
    println!("{measured} steps, {largest} of the bound");
    assert!(measured > 300, "{measured} steps");
    assert!(largest > 0.6, "{largest} of the bound, which is too large");
}

#[test]
fn long_cells_have_wide_words() {
    let angles = Angles { heading: 0.2, pitch: -0.4, roll: 0.0 };
    let words = |cell| {
        let scene = scene(cell, 512, angles, WordSize::Auto);
        let plan = Plan::new(&scene, None, false).expect("a plan");
        (plan.words.name, plan.words_why)
    };
    assert_eq!(words(DVec2::new(1.0, 1.0)).0, "narrow");
    let (name, why) = words(DVec2::new(1.0, 200.0));
    assert_eq!(name, "wide", "{why}");
    assert!(why.contains("32 bits are not enough: the rounding of a step is"), "{why}");
}
