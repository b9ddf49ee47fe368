//! The sweep world: equal to the stock world in the stock formats, and drawn alike by both engines
//! in any formats that wrap.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use proptest::collection::vec;
use proptest::prelude::*;
use terraline::engine::{Engine, FixedWorld, Machine, Memories};
use terraline::plan::Plan;
use terraline::scene::{FormatRequest, Overflow, Rounding, Scene, WordSize};
use terraline::setup::formats::sweep_of;
use terraline::word::sweep::Sweep;

use super::support::formats::requests;
use super::support::recipe::recipes;
use super::support::{assert_same, both, builtin, difference, drawn, is_under_ground, runner};

/// The machine of a scene in a sweep, where what fits the stock words fits.
fn in_sweep<'a>(sweep: Sweep, scene: &'a Scene, plan: &'a Plan) -> Machine<'a> {
    let world = FixedWorld::Sweep(sweep);
    Machine::in_world(world, scene, plan, &Memories::default()).expect("what fits stock fits here")
}

#[test]
fn stock_words_are_a_sweep_at_the_stock_formats() {
    for name in super::support::SCENES {
        for words in [WordSize::Narrow, WordSize::Wide] {
            let mut scene = builtin(name, 48, 36);
            scene.machine.words = words;
            let plan = super::support::plan(&scene);
            let sweep = sweep_of(plan.words(), &[], scene.seed).expect("stock formats");
            assert!(sweep.wraps());
            let stock = drawn(&scene, &plan).expect("a frame");
            let swept = in_sweep(sweep, &scene, &plan);
            for engine in [Engine::Processor, Engine::Fast] {
                assert_same(name, &stock, &swept.frame(engine, true).expect("a frame"));
            }
        }
    }
}

#[test]
fn random_scenes_are_the_same_in_a_sweep_at_the_stock_formats() {
    let compared = AtomicUsize::new(0);
    let result = runner(60).run(&recipes(), |recipe| {
        let mut scene = recipe.scene();
        for words in [WordSize::Narrow, WordSize::Wide] {
            scene.machine.words = words;
            let Ok(plan) = Plan::new(&scene, None, false) else { continue };
            let Ok(stock) = drawn(&scene, &plan) else { continue };
            let sweep = sweep_of(plan.words(), &[], scene.seed).expect("stock formats");
            let swept = in_sweep(sweep, &scene, &plan).frame(Engine::Processor, true);
            let swept = swept.expect("a frame");
            compared.fetch_add(1, Relaxed);
            if let Some(difference) = difference(&stock, &swept) {
                let words = plan.words().name;
                return Err(TestCaseError::fail(format!("stock and sweep, {words}: {difference}")));
            }
        }
        Ok(())
    });
    result.unwrap();
    assert!(compared.load(Relaxed) > 60, "{compared:?} frames");
}

#[test]
fn sweeps_that_wrap_are_drawn_alike() {
    let (frames, refused) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let strategy = (recipes(), vec(requests(), 1..=3));
    let result = runner(120).run(&strategy, |(recipe, formats)| {
        let mut scene = recipe.scene();
        scene.formats = formats;
        let Ok(plan) = Plan::new(&scene, None, false) else {
            refused.fetch_add(1, Relaxed);
            return Ok(());
        };
        // Coarse registers may put the eye under the ground or not hold the map at all.
        let Ok((processor, fast)) = both(&scene, &plan) else {
            refused.fetch_add(1, Relaxed);
            return Ok(());
        };
        frames.fetch_add(1, Relaxed);
        match difference(&processor, &fast) {
            None => Ok(()),
            Some(difference) => Err(TestCaseError::fail(difference)),
        }
    });
    result.unwrap();
    println!("{frames:?} drawn, {refused:?} refused");
    assert!(frames.load(Relaxed) > refused.load(Relaxed), "{refused:?} sweeps are refused");
}

#[test]
fn sweeps_that_saturate_are_drawn() {
    let frames = AtomicUsize::new(0);
    let strategy = (recipes(), vec(requests(), 1..=3));
    let result = runner(60).run(&strategy, |(recipe, mut formats)| {
        for (_, request) in &mut formats {
            request.overflow = Overflow::Saturate;
        }
        let mut scene = recipe.scene();
        scene.formats = formats;
        let Ok(plan) = Plan::new(&scene, None, false) else { return Ok(()) };
        prop_assert!(!FixedWorld::of(&scene, &plan).is_ok_and(|world| world.wraps()));
        if drawn(&scene, &plan).is_ok() {
            frames.fetch_add(1, Relaxed);
        }
        Ok(())
    });
    result.unwrap();
    assert!(frames.load(Relaxed) > 30, "{frames:?} frames");
}

#[test]
fn coarse_formats_draw_the_built_in_scenes_alike() {
    let formats = [
        ("ground", 24, 8, Rounding::Floor),
        ("ground", 40, 12, Rounding::Stochastic),
        ("height", 26, 6, Rounding::TowardZero),
        ("weight", 9, 5, Rounding::NearestEven),
        ("view", 14, 12, Rounding::Nearest),
        ("tone", 16, 4, Rounding::Stochastic),
    ];
    for name in super::support::SCENES {
        let whole = {
            let scene = builtin(name, 40, 30);
            super::support::drawn(&scene, &super::support::plan(&scene)).expect("a frame")
        };
        for (class, width, point, rounding) in formats {
            let mut scene = builtin(name, 40, 30);
            let request = FormatRequest { width, point, rounding, overflow: Overflow::Wrap };
            scene.formats = vec![(class.to_owned(), request)];
            let plan = super::support::plan(&scene);
            let (processor, fast) = match both(&scene, &plan) {
                Ok(frames) => frames,
                Err(error) if is_under_ground(&error) => continue,
                Err(error) => panic!("{name}, {class}: {error}"),
            };
            assert_same(&format!("{name}, {class}"), &processor, &fast);
            // What was made coarse is coarse: the frame is another one.
            if class == "view" || class == "ground" {
                assert!(difference(&whole, &processor).is_some(), "{name}, {class}");
            }
        }
    }
}

#[test]
fn saturating_formats_are_told_apart() {
    let mut scene = builtin("flight", 8, 8);
    let request = FormatRequest {
        width: 32,
        point: 20,
        rounding: Rounding::Nearest,
        overflow: Overflow::Saturate,
    };
    scene.formats = vec![("ground".to_owned(), request)];
    let plan = super::support::plan(&scene);
    let world = FixedWorld::of(&scene, &plan).expect("a sweep");
    assert!(!world.wraps());
    // Nothing saturates in registers that the plan has proved wide enough.
    let saturated = drawn(&scene, &plan).expect("a frame");
    scene.formats.clear();
    assert_same("flight", &drawn(&scene, &plan).expect("a frame"), &saturated);
}
