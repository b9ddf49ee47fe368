//! Limits of a walk: the most bisection steps (equation 22), and the reach of maps without end
//! (equation 32).

use terraline::plan::{Plan, SurfacePlan};
use terraline::scene::{Kernel, Outside, Scene, WordSize};
use terraline::unit::stepper::{BisectionRule, Place};
use terraline::word::stock::{Narrow, Wide};
use terraline::word::{Complete, Load, Readout as _, Register, Site};

use crate::scenes::{terrain, terrain_scene, units, with_outside};

fn scene(words: WordSize, fineness: u32) -> Scene {
    let map = terrain(5, 5, (0..25).map(|at| (at % 7) as f32 / 8.0).collect());
    let mut scene = terrain_scene(map, Kernel::default(), words);
    scene.stepper.fineness = fineness;
    scene
}

/// At the eye the bisection goes on to the last step that has a bit, and no further.
fn a_step_keeps_one_bit<W: Complete>(world: W, words: WordSize, point: u32) {
    for fineness in 0..=6 {
        let stepper = units(world, &scene(words, fineness), false).stepper;
        let BisectionRule::Footprint { cap, .. } = stepper.bisection else { panic!("a footprint") };
        assert_eq!(cap, point - fineness - 1, "{words:?}, fineness {fineness}");
        assert_eq!(stepper.bisection_steps_at(stepper.eye(), Site::pixel(0, 0)), cap);
        let ground = |value| W::Ground::load(value, world.ground(Register::GroundX)).expect("fits");
        let height = W::Height::load(0.0, world.height(Register::RayY)).expect("fits");
        let shortest = ground((-f64::from(fineness) - 1.0).exp2());
        let step = Place::<W> { x: shortest, y: height, z: ground(0.0) };
        assert_eq!(step.halved(cap).x.raw(), Some(1));
        assert_eq!(step.halved(cap + 1).x.raw(), Some(0));
    }
}

#[test]
fn bisection_ends_at_the_last_bit() {
    a_step_keeps_one_bit(Narrow, WordSize::Narrow, 20);
    a_step_keeps_one_bit(Wide, WordSize::Wide, 24);
}

#[test]
fn maps_without_end_are_walked_four_times_their_size() {
    for outside in [Outside::Clamp, Outside::Wrap] {
        for (columns, rows, reach) in
            [(5, 5, 256.0), (64, 7, 256.0), (65, 7, 260.0), (7, 300, 1200.0), (1025, 2, 4096.0)]
        {
            let map = terrain(columns, rows, vec![1.0; columns * rows]);
            let map = with_outside(map, outside);
            let mut scene = terrain_scene(map, Kernel::default(), WordSize::Wide);
            scene.stepper.fineness = 2;
            let plan = Plan::new(&scene, None, false).expect("a plan");
            let SurfacePlan::Terrain(walk) = &plan.surfaces[0] else { panic!("a height map") };
            let found = (walk.reach, walk.last);
            assert_eq!(found, (reach, 8 * reach as u32), "{columns} x {rows}, {outside:?}");
        }
    }
}
