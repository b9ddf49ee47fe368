//! One answer: every engine, and every form of the machine, gives the frame of the line-by-line
//! processor, bit for bit, in every buffer.

mod support;

#[path = "engines/straight.rs"]
mod straight;
#[path = "engines/sweeps.rs"]
mod sweeps;

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use glam::DVec3;
use proptest::test_runner::TestCaseError;
use support::recipe::{Recipe, recipes};
use support::{
    assert_same, at_every_level, builtin, count, difference, draw_in_real, drawn, is_under_ground,
    map, over, plan, runner, terrain,
};
use terraline::engine::{Engine, Machine};
use terraline::frame::{Frame, Hit};
use terraline::plan::{Plan, SurfacePlan, WordClass};
use terraline::scene::{Scene, StepperMode, Surface, WordSize};
use terraline_conformance::{corner_cases, random};

terraline_conformance::conforms!(fast, by_fast_engine);
terraline_conformance::conforms!(plain_stepper, without_skipping);
terraline_conformance::conforms!(fast_with_plain_stepper, by_fast_engine_without_skipping);
terraline_conformance::conforms!(full_machine, with_everything_fitted);

fn by_fast_engine(machine: &Machine<'_>) -> Option<Frame> {
    Some(machine.frame(Engine::Fast, true).expect("a frame"))
}

fn without_skipping(machine: &Machine<'_>) -> Option<Frame> {
    plain(machine, Engine::Processor)
}

fn by_fast_engine_without_skipping(machine: &Machine<'_>) -> Option<Frame> {
    plain(machine, Engine::Fast)
}

fn with_everything_fitted(machine: &Machine<'_>) -> Option<Frame> {
    redrawn(machine.scene(), true, Engine::Processor)
}

/// A scene's frame in a machine of its own, pruned or full.
fn redrawn(scene: &Scene, full: bool, engine: Engine) -> Option<Frame> {
    let plan = Plan::new(scene, None, full).expect("what one machine proves the other does");
    let machine = support::machine(scene, &plan).expect("the same registers");
    Some(machine.frame(engine, true).expect("a frame"))
}

/// The frame of a machine without skipping, unless its walks are too long for that.
fn plain(machine: &Machine<'_>, engine: Engine) -> Option<Frame> {
    let plan = machine.plan();
    let steps = plan.surfaces.iter().filter_map(SurfacePlan::terrain).map(|walk| walk.last);
    let pixels = u64::from(plan.screen.columns) * u64::from(plan.screen.lines);
    if u64::from(steps.max().unwrap_or(0)) * pixels > 1 << 29 {
        return None;
    }
    let mut scene = machine.scene().clone();
    scene.stepper.mode = StepperMode::Plain;
    redrawn(&scene, plan.full, engine)
}

#[test]
#[should_panic(expected = "4 failures")]
fn an_engine_with_another_bit_in_one_scene_does_not_conform() {
    random::built_in_scenes(&|machine| {
        let mut frame = by_fast_engine(machine)?;
        if machine.scene().name == "flight" {
            frame.color.last_mut()?[2] ^= 1;
        }
        Some(frame)
    });
}

#[test]
#[should_panic(expected = "10 of 10 frames are not drawn")]
fn an_engine_that_draws_nothing_does_not_conform() {
    random::built_in_scenes(&|_| None);
}

/// What a random test has seen, so that none passes without having tested anything.
#[derive(Debug, Default)]
struct Seen {
    scenes: AtomicUsize,
    refused: AtomicUsize,
    narrow: AtomicUsize,
    surface: AtomicUsize,
    side: AtomicUsize,
    sky: AtomicUsize,
    out_of_range: AtomicUsize,
}

impl Seen {
    fn frame(&self, frame: &Frame) {
        self.surface.fetch_add(count(frame, Hit::Surface), Relaxed);
        self.side.fetch_add(count(frame, Hit::Side), Relaxed);
        self.sky.fetch_add(count(frame, Hit::Sky), Relaxed);
        self.out_of_range.fetch_add(count(frame, Hit::OutOfRange), Relaxed);
    }

    /// Most scenes were drawn, and every outcome was among their pixels.
    fn assert_enough(&self) {
        println!("{self:?}");
        let scenes = self.scenes.load(Relaxed);
        assert!(self.refused.load(Relaxed) * 10 < scenes, "too many scenes are refused: {self:?}");
        assert!(self.narrow.load(Relaxed) * 2 > scenes, "too few narrow machines: {self:?}");
        assert!(self.surface.load(Relaxed) > 50 * scenes, "too few pixels hit: {self:?}");
        for outcome in [&self.side, &self.sky, &self.out_of_range] {
            assert!(outcome.load(Relaxed) > scenes, "an outcome is missing: {self:?}");
        }
    }
}

/// The scene's plans in both word sizes, as far as they can be proved.
fn planned(recipe: &Recipe, seen: &Seen) -> Vec<(Scene, Plan)> {
    let mut scene = recipe.scene();
    seen.scenes.fetch_add(1, Relaxed);
    let mut plans = Vec::new();
    for words in [WordSize::Narrow, WordSize::Wide] {
        scene.machine.words = words;
        match Plan::new(&scene, None, false) {
            Ok(plan) => {
                seen.narrow.fetch_add(usize::from(words == WordSize::Narrow), Relaxed);
                plans.push((scene.clone(), plan));
            }
            Err(_) if words == WordSize::Wide => {
                seen.refused.fetch_add(1, Relaxed);
            }
            Err(_) => {}
        }
    }
    plans
}

fn fail(what: &str, plan: &Plan, difference: Option<String>) -> Result<(), TestCaseError> {
    match difference {
        None => Ok(()),
        Some(difference) => {
            Err(TestCaseError::fail(format!("{what}, {}: {difference}", plan.words.name)))
        }
    }
}

#[test]
fn every_simd_level_draws_alike() {
    let levels = terraline::fast::levels().len();
    println!("{levels} SIMD levels");
    for name in support::SCENES {
        for words in [WordSize::Narrow, WordSize::Wide] {
            let mut scene = builtin(name, 120, 90);
            scene.machine.words = words;
            let plan = support::plan(&scene);
            let frames = at_every_level(&scene, &plan).expect("frames");
            let processor = drawn(&scene, &plan).expect("a frame");
            assert_eq!(frames.len(), levels);
            frames.iter().for_each(|frame| assert_same(name, &processor, frame));
        }
    }
    let seen = Seen::default();
    let result = runner(60).run(&recipes(), |recipe| {
        for (scene, plan) in planned(&recipe, &seen) {
            let Ok(frames) = at_every_level(&scene, &plan) else { continue };
            for frame in &frames[1..] {
                seen.frame(frame);
                fail("two SIMD levels", &plan, difference(&frames[0], frame))?;
            }
        }
        Ok(())
    });
    result.unwrap();
    if levels > 1 {
        seen.assert_enough();
    }
}

#[test]
fn the_real_world_sees_what_the_fixed_one_sees() {
    let (seen, pixels, differ) = (Seen::default(), AtomicUsize::new(0), AtomicUsize::new(0));
    let result = runner(150).run(&recipes(), |recipe| {
        for (scene, plan) in planned(&recipe, &seen) {
            let Ok(fixed) = drawn(&scene, &plan) else { continue };
            let real = draw_in_real(&scene, &plan);
            let real = real.map_err(|error| TestCaseError::fail(error.to_string()))?;
            seen.frame(&real);
            pixels.fetch_add(real.hit.len(), Relaxed);
            let other = fixed.hit.iter().zip(&real.hit).filter(|(a, b)| a != b).count();
            differ.fetch_add(other, Relaxed);
        }
        Ok(())
    });
    result.unwrap();
    seen.assert_enough();
    let share = differ.load(Relaxed) as f64 / pixels.load(Relaxed) as f64;
    println!("other outcomes on {:.4} % of {} pixels", 100.0 * share, pixels.load(Relaxed));
    // Other seeds measure up to 7e-5.
    assert!(share < 2e-4, "other outcomes on {share} of the pixels");
}

#[test]
fn the_word_sizes_are_what_was_asked_for() {
    let mut scene = builtin("flight", 8, 8);
    assert_eq!(plan(&scene).words, WordClass::NARROW);
    scene.machine.words = WordSize::Wide;
    assert_eq!(plan(&scene).words, WordClass::WIDE);
    // Left to the plan: squares so large that the last bit of a place is a tenth of a pixel.
    let mut scene = builtin("plane", 1024, 1024);
    assert_eq!(plan(&scene).words, WordClass::NARROW);
    let Surface::Plane(plane) = &mut scene.surfaces[0] else { panic!("a plane") };
    plane.checker = 800.0;
    assert_eq!(plan(&scene).words, WordClass::WIDE);
    // Cells so narrow that slopes are beyond the shorter words: 12 · 9/4 over 1/100.
    let mut scene = over(map(12, 9, |i, j| (12 * (i % 2 * j % 2)) as f32), 19, 13);
    terrain(&mut scene).cell = (0.01, 100.0).into();
    scene.camera.position = DVec3::new(0.06, 30.0, -50.0);
    let found = plan(&scene);
    assert_eq!(found.words, WordClass::WIDE);
    assert!(found.words_why.contains("slopes reach 2700"), "{}", found.words_why);
}

#[test]
fn what_is_refused_names_the_field_to_change() {
    let mut wrong = Vec::new();
    let mut refused = 0;
    for (name, scene) in corner_cases::scenes() {
        let Err(error) = Plan::new(&scene, None, false) else { continue };
        refused += 1;
        let message = error.to_string();
        // The part of the scene that is out of bounds; moving the eye would not help the others.
        let field = match name.split(' ').next() {
            Some("cells" | "heights" | "base") => "surface.",
            _ if name.ends_with("degrees") => "screen.",
            Some("pixels" | "screen") => "screen.",
            _ => "camera.position",
        };
        if message.contains('\n') || !message.starts_with(field) {
            wrong.push(format!("{name} (expected {field}): {message}"));
        }
    }
    // Within the places that are counted, but not within the steps.
    let mut far = corner_cases::hills();
    far.camera.position.x += 1e6;
    far.stepper.fineness = 6;
    let message = Plan::new(&far, None, false).expect_err("a long walk").to_string();
    assert!(message.contains("2^26 are counted"), "{message}");
    assert!(refused > 10, "{refused} scenes are refused");
    assert!(wrong.is_empty(), "{} failures:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn corner_cases_are_drawn_in_the_real_world() {
    let mut drawn = 0;
    for (name, scene) in corner_cases::scenes() {
        let Ok(plan) = Plan::new(&scene, None, false) else { continue };
        let pixels = plan.screen.columns * plan.screen.lines;
        match draw_in_real(&scene, &plan) {
            Ok(frame) => assert_eq!(frame.hit.len(), pixels as usize, "{name}"),
            Err(error) => assert!(is_under_ground(&error), "{name}: {error}"),
        }
        drawn += 1;
    }
    assert!(drawn > 30, "{drawn} corner cases are planned");
}
