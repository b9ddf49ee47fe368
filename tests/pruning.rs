//! Units that a scene does not need are left out, with a reason, and the frame stays the same.

mod support;

use glam::{DVec2, DVec3};
use support::{assert_same, both, builtin, count, drawn, machine, map, over, terrain};
use terraline::engine::FixedWorld;
use terraline::frame::Hit;
use terraline::plan::Plan;
use terraline::plan::UnitPlan;
use terraline::scene::{
    Angles, Attitude, Deformation, FormatRequest, HeightMap, Kernel, KernelShape, Overflow,
    Registers, Rounding, Scene, StepperMode, WordSize,
};
use terraline::study::cost::Cost;
use terraline::study::error::Sample;
use terraline::word::Class;

/// One pruning: a scene, and what must be left out of it, with a word of the reason.
struct Case {
    name: &'static str,
    scene: Scene,
    left_out: Vec<(&'static str, &'static str)>,
}

fn hills() -> Scene {
    over(map(23, 17, |i, j| ((i * 7 + j * 13) % 19) as f32 / 4.0), 40, 30)
}

/// A map with a few nodes without data.
fn holed(height: impl Fn(usize, usize) -> f32) -> HeightMap {
    map(23, 17, |i, j| if (i + 5 * j).is_multiple_of(31) { f32::NAN } else { height(i, j) })
}

fn kernel(shape: KernelShape, deformation: Deformation) -> Kernel {
    Kernel { shape, deformation, table: 4096 }
}

fn changed(change: impl Fn(&mut Scene)) -> Scene {
    let mut scene = hills();
    change(&mut scene);
    scene
}

/// All cases; the maps of most have no holes.
fn cases() -> Vec<Case> {
    let mut cases = own_cases();
    for case in &mut cases {
        if !matches!(case.name, "plane" | "holes" | "holes in a constant map, stretched") {
            case.left_out.push(("void_bits", "every node has data"));
        }
    }
    cases
}

fn own_cases() -> Vec<Case> {
    let inside = |scene: &mut Scene| {
        let ground = support::ground_under(scene, 8.3, 6.1).expect("on the map");
        scene.camera.position = DVec3::new(8.3, ground + 0.2, 6.1);
        scene.camera.attitude =
            Attitude::Directions { forward: DVec3::new(1.0, -0.2, 0.6), up: DVec3::Y };
    };
    let square = ("slope_scale", "square");
    vec![
        Case { name: "hills", scene: hills(), left_out: vec![square] },
        Case {
            name: "eye inside the slab",
            scene: changed(inside),
            left_out: vec![("divider", "below the highest node"), square],
        },
        Case {
            name: "hat kernel",
            scene: changed(|scene| scene.kernel = kernel(KernelShape::Hat, Deformation::None)),
            left_out: vec![("kernel_rom", "hat"), square],
        },
        Case {
            name: "hat kernel, deformed",
            scene: changed(|scene| {
                scene.kernel = kernel(KernelShape::Hat, Deformation::TowardHat { weight_shift: 1 });
            }),
            left_out: vec![("kernel_rom", "hat"), square],
        },
        Case {
            name: "weight shift beyond the width",
            scene: changed(|scene| {
                scene.kernel =
                    kernel(KernelShape::Parabola, Deformation::TowardHat { weight_shift: 64 });
            }),
            left_out: vec![("kernel_rom", "no bit"), square],
        },
        Case {
            name: "weight shift of the width less one",
            scene: changed(|scene| {
                scene.kernel =
                    kernel(KernelShape::Exponential, Deformation::TowardHat { weight_shift: 31 });
                scene.machine.words = WordSize::Narrow;
            }),
            left_out: vec![("kernel_rom", "no bit"), square],
        },
        Case {
            name: "stretched hat",
            scene: changed(|scene| scene.kernel = kernel(KernelShape::Hat, Deformation::Stretch)),
            left_out: vec![square],
        },
        Case {
            name: "plain kernel",
            scene: changed(|scene| {
                scene.kernel = kernel(KernelShape::Exponential, Deformation::None);
            }),
            left_out: vec![square],
        },
        Case {
            name: "constant map",
            scene: {
                let mut scene = over(map(23, 17, |_, _| 2.5), 40, 30);
                terrain(&mut scene).cell = DVec2::new(1.0, 2.0);
                scene
            },
            left_out: vec![("kernel_rom", "one height"), ("slope_scale", "one height")],
        },
        Case {
            name: "constant map, stretched",
            scene: {
                let mut scene = over(map(23, 17, |_, _| -1.0 / 3.0), 40, 30);
                scene.kernel = kernel(KernelShape::Parabola, Deformation::Stretch);
                scene
            },
            left_out: vec![("kernel_rom", "one height"), square],
        },
        Case {
            name: "holes",
            scene: over(holed(|i, j| ((i * 7 + j * 13) % 19) as f32 / 4.0), 40, 30),
            left_out: vec![square],
        },
        Case {
            name: "holes in a constant map, stretched",
            scene: {
                let mut scene = over(holed(|_, _| 2.5), 40, 30);
                scene.kernel = kernel(KernelShape::Cosine, Deformation::Stretch);
                scene
            },
            left_out: vec![square],
        },
        Case {
            name: "ambient light alone",
            scene: changed(|scene| scene.light.ambient = 1.0),
            left_out: vec![("light", "ambient"), square],
        },
        Case {
            name: "cells that are not square",
            scene: changed(|scene| {
                terrain(scene).cell = DVec2::new(0.5, 2.0);
                scene.camera.position = DVec3::new(5.5, 9.0, -4.0);
            }),
            left_out: vec![],
        },
        Case {
            name: "no roll",
            scene: changed(|scene| {
                let down = -40_f64.to_radians();
                scene.camera.attitude =
                    Attitude::Angles(Angles { heading: -1.6, pitch: down, roll: 0.0 });
            }),
            left_out: vec![square],
        },
        Case {
            name: "plain stepper",
            scene: changed(|scene| scene.stepper.mode = StepperMode::Plain),
            left_out: vec![("pyramid", "plain"), square],
        },
        Case {
            name: "everything at once",
            scene: changed(|scene| {
                inside(scene);
                scene.kernel = kernel(KernelShape::Hat, Deformation::None);
                scene.light.ambient = 1.0;
                scene.stepper.mode = StepperMode::Plain;
            }),
            left_out: vec![
                ("divider", "below"),
                ("pyramid", "plain"),
                ("kernel_rom", "hat"),
                ("light", "ambient"),
                square,
            ],
        },
        Case {
            name: "plane",
            scene: builtin("plane", 48, 36),
            left_out: ["stepper", "pyramid", "kernel_rom", "interpolator", "light"]
                .map(|unit| (unit, "no height map"))
                .into(),
        },
    ]
}

fn planned(scene: &Scene, full: bool) -> Plan {
    Plan::new(scene, None, full).expect("a plan")
}

fn described(scene: &Scene, plan: &Plan) -> Vec<UnitPlan> {
    FixedWorld::of(scene, plan).expect("a world").units(plan)
}

fn cost(scene: &Scene, plan: &Plan) -> Cost {
    let all = Sample::all(plan);
    machine(scene, plan).and_then(|machine| machine.cost(&all, &all)).expect("a cost")
}

fn assert_pruning_keeps(name: &str, scene: &Scene, least: usize) {
    let pruned = drawn(scene, &planned(scene, false)).expect("a frame");
    let full = drawn(scene, &planned(scene, true)).expect("a frame");
    let hits = count(&pruned, Hit::Surface);
    assert!(hits > least, "{name}: {hits} pixels of surface");
    assert_same(name, &pruned, &full);
}

#[test]
fn pruned_and_full_machines_draw_one_frame() {
    for case in cases() {
        for words in [WordSize::Narrow, WordSize::Wide] {
            let mut scene = case.scene.clone();
            scene.machine.words = words;
            assert_pruning_keeps(case.name, &scene, 200);
        }
    }
    for name in support::SCENES {
        assert_pruning_keeps(name, &builtin(name, 120, 90), 2000);
    }
}

#[test]
fn pruned_and_full_machines_draw_one_frame_of_random_scenes() {
    use proptest::test_runner::TestCaseError;
    let compared = std::sync::atomic::AtomicUsize::new(0);
    let result = support::runner(120).run(&support::recipe::recipes(), |recipe| {
        let scene = recipe.scene();
        let Ok(plan) = Plan::new(&scene, None, false) else { return Ok(()) };
        let Ok(pruned) = drawn(&scene, &plan) else { return Ok(()) };
        let full = both(&scene, &planned(&scene, true));
        let (full, fast) = full.map_err(|error| TestCaseError::fail(error.to_string()))?;
        compared.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        let differs = support::difference(&pruned, &full);
        match differs.or_else(|| support::difference(&full, &fast)) {
            None => Ok(()),
            Some(difference) => Err(TestCaseError::fail(difference)),
        }
    });
    result.unwrap();
    assert!(compared.into_inner() >= 100);
}

#[test]
fn pruned_and_full_machines_draw_one_frame_in_sweeps() {
    use proptest::collection::vec;
    use proptest::test_runner::TestCaseError;
    let compared = std::sync::atomic::AtomicUsize::new(0);
    let strategy = (support::recipe::recipes(), vec(support::formats::requests(), 1..=2));
    let result = support::runner(60).run(&strategy, |(recipe, formats)| {
        let mut scene = recipe.scene();
        scene.formats = formats;
        let Ok(plan) = Plan::new(&scene, None, false) else { return Ok(()) };
        let Ok(pruned) = drawn(&scene, &plan) else { return Ok(()) };
        let full = drawn(&scene, &planned(&scene, true));
        let full = full.map_err(|error| TestCaseError::fail(error.to_string()))?;
        compared.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        match support::difference(&pruned, &full) {
            None => Ok(()),
            Some(difference) => Err(TestCaseError::fail(difference)),
        }
    });
    result.unwrap();
    assert!(compared.into_inner() >= 30);
}

#[test]
fn a_full_machine_takes_every_format_that_a_pruned_one_does() {
    let mut all = cases();
    // Factors of slopes that a weight of three bits before the point does not hold.
    let mut scene = over(map(23, 17, |_, _| 2.5), 40, 30);
    terrain(&mut scene).cell = DVec2::new(3.0, 0.05);
    scene.camera.position = DVec3::new(30.0, 9.0, 0.4);
    all.push(Case { name: "constant map of long cells", scene, left_out: vec![] });
    let mut both_drew = 0;
    for Case { name, mut scene, .. } in all {
        for (class, width, point) in
            [(Class::View, 19, 18), (Class::Weight, 12, 9), (Class::Tone, 20, 10)]
        {
            let (rounding, overflow) = (Rounding::Nearest, Overflow::Wrap);
            let request = FormatRequest { width, point, rounding, overflow };
            scene.formats = vec![(Registers::Class(class), request)];
            let what = format!("{name}, {class:?}");
            let Ok(pruned) = drawn(&scene, &planned(&scene, false)) else { continue };
            let full = drawn(&scene, &planned(&scene, true));
            assert_same(&what, &pruned, &full.unwrap_or_else(|e| panic!("{what}: {e}")));
            both_drew += 1;
        }
    }
    assert!(both_drew > 50, "{both_drew} of 57");
}

#[test]
fn what_is_left_out_is_named_with_its_reason() {
    for case in cases() {
        let plan = planned(&case.scene, false);
        let units = described(&case.scene, &plan);
        let left_out: Vec<&str> = units.iter().filter(|u| !u.fitted).map(|u| u.name).collect();
        let mut expected: Vec<&str> = case.left_out.iter().map(|(name, _)| *name).collect();
        expected.sort_by_key(|name| units.iter().position(|unit| unit.name == *name));
        assert_eq!(left_out, expected, "{}", case.name);
        for unit in &units {
            assert!(!unit.why.is_empty(), "{}: {} has a reason", case.name, unit.name);
            assert_eq!(unit.fitted, unit.saves.is_none(), "{}: {}", case.name, unit.name);
            assert!(unit.fitted || unit.widths.is_empty(), "{}: {}", case.name, unit.name);
        }
        for (name, reason) in case.left_out {
            let unit = units.iter().find(|unit| unit.name == name).expect("a unit");
            assert!(unit.why.contains(reason), "{}: {name}: {}", case.name, unit.why);
        }
    }
}

#[test]
fn the_full_machine_says_what_it_does_not_need() {
    for case in cases() {
        let units = described(&case.scene, &planned(&case.scene, true));
        for (name, reason) in case.left_out {
            let unit = units.iter().find(|unit| unit.name == name).expect("a unit");
            // A stepper without skipping has no use for a pyramid, not even an idle one.
            if name == "pyramid" && reason == "plain" {
                continue;
            }
            assert!(unit.fitted, "{}: {name}", case.name);
            assert!(unit.why.contains("--full; not needed"), "{}: {}", case.name, unit.why);
            assert!(unit.why.contains(reason), "{}: {}", case.name, unit.why);
        }
    }
}

#[test]
fn an_increment_of_zero_has_no_adder() {
    let cases = cases();
    let level = cases.iter().find(|case| case.name == "no roll").expect("a case");
    let why = |scene: &Scene| described(scene, &planned(scene, false))[0].why.clone();
    assert!(why(&level.scene).contains("no column adder for view_y"), "{}", why(&level.scene));
    let mut rolled = level.scene.clone();
    rolled.camera.attitude = Attitude::Angles(Angles { heading: -1.6, pitch: -0.7, roll: 0.3 });
    assert!(!why(&rolled).contains("no column adder"), "{}", why(&rolled));
}

#[test]
fn pruning_never_costs_anything() {
    for case in cases() {
        let pruned = cost(&case.scene, &planned(&case.scene, false));
        let full = cost(&case.scene, &planned(&case.scene, true));
        let name = case.name;
        assert!(pruned.cycles > 0 && pruned.additions > 0, "{name}");
        assert!(pruned.cycles <= full.cycles, "{name}: {} > {}", pruned.cycles, full.cycles);
        let (a, b) = (pruned.additions, full.additions);
        assert!(a <= b, "{name}: {a} additions pruned, {b} full");
        // Only the pyramid and idle units of a plane save no additions.
        let saves = case
            .left_out
            .iter()
            .any(|(unit, _)| ["divider", "kernel_rom", "slope_scale", "light"].contains(unit));
        if saves && name != "plane" {
            assert!(a < b, "{name}: {a} additions pruned, {b} full");
        }
    }
}

#[test]
fn skipping_saves_cycles() {
    for name in support::TERRAINS {
        let mut scene = builtin(name, 64, 48);
        let skipping = cost(&scene, &planned(&scene, false));
        scene.stepper.mode = StepperMode::Plain;
        let plain = cost(&scene, &planned(&scene, false));
        assert!(2 * skipping.cycles < plain.cycles, "{name}: {} {}", skipping.cycles, plain.cycles);
        assert!(2 * skipping.additions < plain.additions, "{name}");
    }
}
