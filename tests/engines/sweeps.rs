//! The sweep world: equal to the stock world in the stock formats, and drawn alike by both engines
//! in any formats that wrap.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use proptest::collection::vec;
use proptest::prelude::*;
use terraline::engine::{Engine, FixedWorld, Machine, Memories, Overflows, Wanted};
use terraline::plan::formats::Formats;
use terraline::plan::{Plan, WordClass};
use terraline::scene::{FormatRequest, Scene, WordSize};
use terraline::setup::SetupError;
use terraline::word::sweep::Sweep;
use terraline::word::{Class, Fixed, Overflow, Register, Registers, Rounding};

use super::support::formats::requests;
use super::support::recipe::recipes;
use super::support::{assert_same, both, builtin, difference, drawn, runner};

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
            let sweep = Formats::stock(plan.words).sweep(scene.seed).expect("stock formats");
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
            let sweep = Formats::stock(plan.words).sweep(scene.seed).expect("stock formats");
            let swept = in_sweep(sweep, &scene, &plan).frame(Engine::Processor, true);
            let swept = swept.expect("what fits stock fits here");
            compared.fetch_add(1, Relaxed);
            if let Some(difference) = difference(&stock, &swept) {
                let words = plan.words.name;
                return Err(TestCaseError::fail(format!("stock and sweep, {words}: {difference}")));
            }
        }
        Ok(())
    });
    result.unwrap();
    assert!(compared.load(Relaxed) > 60, "{compared:?} frames");
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
fn saturating_formats_are_told_apart() {
    let mut scene = builtin("flight", 8, 8);
    let request = FormatRequest {
        width: 32,
        point: 20,
        rounding: Rounding::Nearest,
        overflow: Overflow::Saturate,
    };
    scene.formats = vec![(Registers::Class(Class::Ground), request)];
    let plan = super::support::plan(&scene);
    let world = FixedWorld::of(&scene, &plan).expect("a sweep");
    assert!(!world.wraps());
    let machine = super::support::machine(&scene, &plan).expect("a machine");
    assert!(matches!(machine.frame(Engine::Fast, false), Err(SetupError::Saturating)));
    // Nothing saturates in registers that the plan has proved wide enough.
    let saturated = drawn(&scene, &plan).expect("a frame");
    scene.formats.clear();
    assert_same("flight", &drawn(&scene, &plan).expect("a frame"), &saturated);
}

/// Every class and every register that leads, in its stock format and nothing else said.
fn stock_requests(words: WordClass) -> impl Iterator<Item = (Registers, FormatRequest)> {
    Registers::all().filter_map(move |registers| {
        let register = match registers {
            Registers::Class(class) => *Register::ALL.iter().find(|r| r.class() == class)?,
            Registers::One(register) if register.follows().is_some() => return None,
            Registers::One(register) => register,
        };
        let Fixed { width, point } = words.fixed(register);
        let (rounding, overflow) = (Rounding::default(), Overflow::default());
        Some((registers, FormatRequest { width, point, rounding, overflow }))
    })
}

#[test]
fn a_stock_format_that_is_asked_for_changes_nothing() {
    for name in super::support::SCENES {
        for words in [WordSize::Narrow, WordSize::Wide] {
            let mut scene = builtin(name, 24, 18);
            scene.machine.words = words;
            let stock_plan = super::support::plan(&scene);
            let stock = drawn(&scene, &stock_plan).expect("a frame");
            for request in stock_requests(stock_plan.words) {
                scene.formats = vec![request];
                let what = format!("{name}, {}", request.0.name());
                let plan = super::support::plan(&scene);
                assert_eq!(plan.not_proved, [""; 0], "{what}");
                let (processor, fast) = both(&scene, &plan).expect("what fits stock fits here");
                assert_same(&what, &stock, &processor);
                assert_same(&what, &stock, &fast);
            }
        }
    }
}

/// The plan of a built-in scene at its own size, with formats of bits before and after the point.
fn told(name: &str, formats: &[(&str, u32, u32)]) -> (String, Vec<String>) {
    let mut scene = terraline::scene::load(Some(name), &[]).expect("a built-in scene");
    let request = |&(name, integer, point): &(&str, u32, u32)| {
        let registers = Registers::from_name(name).expect("registers");
        let (rounding, overflow) = (Rounding::default(), Overflow::default());
        (registers, FormatRequest { width: integer + point, point, rounding, overflow })
    };
    scene.formats = formats.iter().map(request).collect();
    let plan = super::support::plan(&scene);
    (plan.words_why, plan.not_proved)
}

#[test]
fn the_plan_speaks_of_the_formats_in_use() {
    let (stock, nothing) = told("overview", &[]);
    assert_eq!(stock, "positions reach 1060 of 2048 cells, a step's rounding is 1/74 pixel");
    assert!(nothing.is_empty());
    assert_eq!(told("overview", &[("ground", 12, 20), ("ray_y", 12, 20)]), (stock, nothing));

    // 8 bits for 20: a rounding 4096 times as large.
    let coarse = "a step's rounding is 49.77 pixels";
    let (why, open) = told("overview", &[("ground", 24, 8)]);
    assert!(why.starts_with("positions reach 1060 of 8388608 cells, heights"), "{why}");
    assert!(why.ends_with(coarse), "{why}");
    let claim = "the rounding of a step is 49.77 pixel, more than 1/32 (ground_x Q24.8)";
    assert_eq!(open, [claim]);
    // Each register counts by itself, and the coarsest is to blame.
    let (why, open) = told("overview", &[("ground", 12, 30), ("ground_z", 24, 8)]);
    assert!(
        why.starts_with("positions reach 1060 of 2048 cells") && why.ends_with("32.90 pixels"),
        "{why}"
    );
    assert_eq!(open, [claim.replace("49.77", "32.90").replace("ground_x", "ground_z")]);

    let claims = |name, format| told(name, &[format]).1.join("; ");
    for (name, format, part) in [
        (
            "overview",
            ("ground", 9, 20),
            "positions reach 1060 cells, the registers hold 256 (ground_x Q9.20)",
        ),
        ("overview", ("ray_y", 10, 20), "heights of rays reach"),
        ("overview", ("view", 2, 18), "roundings of the view coefficients"),
        (
            "overview",
            ("view_z", 1, 30),
            "the view may reach 2, the registers hold 1 (view_z Q1.30)",
        ),
        ("overview", ("node", 5, 20), "heights with three bits to spare reach"),
        ("flight", ("node", 5, 20), "(node Q5.20)"),
        (
            "plane",
            ("ground", 8, 20),
            "positions reach 1024 squares, the registers hold 128 (ground_x Q8.20)",
        ),
        ("plane", ("ground_z", 12, 4), "(ground_z Q12.4)"),
        ("plane", ("denominator", 2, 12), "(denominator Q2.12)"),
    ] {
        let found = claims(name, format);
        assert!(found.contains(part), "{name}, {format:?}: {found}");
    }
    // The last bits that are fine enough, and the first that are not.
    for (register, integer, point, part) in [
        ("view", 2, 28, "roundings of the view coefficients"),
        ("ground", 12, 18, "the rounding of a step is 0.05 pixel"),
    ] {
        let found = claims("overview", (register, integer, point));
        assert!(found.contains(part), "{register}: {found}");
        assert_eq!(claims("overview", (register, integer, point + 1)), "", "{register}");
    }
    // Rays that start at the eye use no denominator.
    assert_eq!(claims("valley", ("denominator", 2, 8)), "");
    assert_ne!(claims("flight", ("denominator", 2, 8)), "");
}

#[test]
fn formats_that_are_proved_do_not_overflow() {
    let (proved, open) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let strategy = (recipes(), vec(requests(), 1..=2), 0..=12_u32);
    let result = runner(200).run(&strategy, |(recipe, mut formats, more)| {
        for (_, request) in &mut formats {
            // Mostly wide and fine enough for a proof.
            let integer = (request.width - request.point + more).min(38);
            request.point = request.point.clamp(22, 62 - integer);
            request.width = integer + request.point;
        }
        let mut scene = recipe.scene();
        scene.formats = formats;
        let Ok(plan) = Plan::new(&scene, None, false) else { return Ok(()) };
        let memories = Memories::default();
        let Ok(machine) = Machine::new(&scene, &plan, &memories) else { return Ok(()) };
        let scan = machine.scan(Engine::Processor, Wanted::default()).expect("no other world");
        let overflows = scan.finish().overflows;
        if plan.not_proved.is_empty() {
            proved.fetch_add(1, Relaxed);
            prop_assert_eq!(overflows, Overflows::default(), "{:?}", scene.formats);
        } else {
            open.fetch_add(1, Relaxed);
        }
        Ok(())
    });
    result.unwrap();
    println!("{proved:?} proved, {open:?} not");
    assert!(proved.load(Relaxed) > 30 && open.load(Relaxed) > 5, "{proved:?} {open:?}");
}
