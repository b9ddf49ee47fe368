//! Whole frames: every output of every unit and every cycle against the emulator.
#![cfg(rtl)]

use terraline::clock::Taker;
use terraline::engine::{self, Memories, WithSetup};
use terraline::plan::Plan;
use terraline::scene::{self, Deformation, HeightMap, Outside};
use terraline::setup::Back;
use terraline::setup::Setup;
use terraline::word::Complete;
use terraline::word::Lane;
use terraline::word::stock::Narrow;
use terraline_hdl::cosim::{Outcome, compare, compare_with};
use terraline_hdl::rtl::Rtl;

struct Cosimulation {
    taker: Taker,
}

impl WithSetup for Cosimulation {
    type Output = Outcome;

    fn run<W: Complete>(self, setup: &Setup<W>) -> Outcome {
        compare(setup, self.taker, None).expect("a frame")
    }
}

fn assert_equal(name: &str, sets: &[&str], taker: Taker) {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    let scene = scene::load(Some(name), &sets).expect("a scene");
    let plan = Plan::new(&scene, None, false).expect("a plan");
    let machine = engine::Machine::new(&scene, &plan, &Memories::default()).expect("a set-up");
    let outcome = machine.run(Cosimulation { taker });
    assert!(
        outcome.is_equal(),
        "{name} {sets:?} {taker:?}: {} differences, {} cycles for {}\n{}",
        outcome.differences,
        outcome.cycles,
        outcome.expected_cycles,
        outcome.described.join("\n")
    );
}

const BUSY: Taker = Taker::Busy { seed: 11, of_256: 120 };

#[test]
fn planes() {
    for set in ["machine.words=narrow", "machine.words=wide"] {
        for taker in [Taker::Ready, BUSY] {
            assert_equal("plane", &["screen.size=[160, 120]", set], taker);
            let sets = ["screen.size=[160, 120]", set, "machine.ratio=serial"];
            assert_equal("plane", &sets, taker);
            let sets = ["screen.size=[160, 120]", set, "camera.pitch=-35", "camera.roll=25"];
            assert_equal("plane", &sets, taker);
        }
    }
}

#[test]
fn terrain() {
    for name in ["overview", "flight", "valley"] {
        for latency in ["machine.memory_latency=1", "machine.memory_latency=2"] {
            assert_equal(name, &["screen.size=[160, 120]", latency], Taker::Ready);
        }
        assert_equal(name, &["screen.size=[160, 120]", "machine.memory_latency=5"], BUSY);
    }
}

#[test]
fn other_machines_for_height_maps() {
    for sets in [
        // The other word size, the other kernels, the other divider, the other stepper.
        &["machine.words=wide"][..],
        &["kernel.deformation=1"],
        &["kernel.deformation=1", "machine.words=wide", "machine.memory_latency=5"],
        &["machine.ratio=serial"],
        &["stepper.mode=plain"],
        &["kernel.shape=hat", "stepper.halvings=0"],
        &["kernel.deformation=0", "kernel.table=65536", "stepper.fineness=0"],
        &["surface.outside=clamp", "stepper.fineness=6"],
        &["light.ambient=1", "machine.memory_latency=64"],
        &["surface.cell=[1.5, 0.75]", "machine.memory_latency=1"],
    ] {
        for name in ["overview", "flight"] {
            let sets: Vec<&str> = [&["screen.size=[40, 30]"], sets].concat();
            assert_equal(name, &sets, BUSY);
        }
    }
}

#[test]
fn maps_of_one_row_or_column() {
    for (columns, rows) in [(1, 9), (9, 1), (1, 1), (2, 9), (9, 2)] {
        let samples = (0..columns * rows).map(|at| (at * 3 % 5) as f32).collect();
        for outside in [Outside::Sky, Outside::Clamp] {
            for deformation in [Deformation::None, Deformation::Stretch] {
                let sets = [
                    "screen.size=[20, 15]",
                    "camera.position=[-3, 4, -2]",
                    "camera.forward=[1, -0.8, 0.9]",
                ];
                let mut scene =
                    scene::load(Some("flight"), &sets.map(str::to_owned)).expect("a scene");
                let terrain = scene.terrain_mut().expect("a height map");
                terrain.map = HeightMap::new(columns, rows, Vec::clone(&samples)).into();
                (terrain.offset, terrain.scale, terrain.outside) = (0.0, 0.5, outside);
                scene.kernel.deformation = deformation;
                let plan = Plan::new(&scene, None, false).expect("a plan");
                let machine = engine::Machine::new(&scene, &plan, &Memories::default());
                let machine = machine.expect("a set-up");
                let outcome = machine.run(Cosimulation { taker: BUSY });
                let what = format!("{columns} x {rows}, {outside:?}, {deformation:?}");
                assert!(outcome.is_equal(), "{what}: {}", outcome.described.join("\n"));
            }
        }
    }
}

#[test]
fn fading_squares_show_every_rounding_of_the_contrast() {
    // Squares of about a pixel on the whole screen, in colours far apart: the last bit of a contrast
    // is 1e-4 levels, of which so many pixels have some at the edge of a level.
    let colors = "color.checker=[[0, 1, 254], [255, 254, 3]]";
    // With a roll every pixel has a contrast of its own.
    let place = ["camera.position=[0, 90, 0]", "camera.pitch=-70", "camera.roll=17"];
    let sets = [&["screen.size=[400, 300]", colors], &place[..]].concat();
    for square in ["surface.checker=0.6", "surface.checker=0.8"] {
        assert_equal(
            "plane",
            &[&sets[..], &[square, "machine.words=narrow"]].concat(),
            Taker::Ready,
        );
    }
}

/// Differences between the RTL of a set-up and the emulator of a changed one.
fn differences(change: impl Fn(&mut Setup<Narrow>)) -> (u64, String) {
    let sets = ["screen.size=[24, 18]".to_owned()];
    let scene = scene::load(Some("flight"), &sets).expect("a scene");
    let plan = Plan::new(&scene, None, false).expect("a plan");
    let setup = Memories::default().set_up(Narrow, &scene, &plan).expect("a set-up");
    let machine = Rtl::new(&setup).expect("a machine");
    let mut changed = setup.clone();
    change(&mut changed);
    let outcome = compare_with(machine, &changed, Taker::Ready, None).expect("a frame");
    (outcome.differences, outcome.described.join("\n"))
}

#[test]
fn the_smallest_difference_is_found() {
    assert_eq!(differences(|_| {}), (0, String::new()));
    let (count, first) = differences(|setup| {
        let start = &mut setup.surfaces[0].projector.x.start;
        *start = Lane::of_int(start.int() + 1);
    });
    assert!(count >= 24 * 18 && first.contains("line 0, column 0, projector: view_x"), "{first}");
    let (count, first) = differences(|setup| {
        let Back::Terrain(units) = &mut setup.surfaces[0].back else { panic!("a height map") };
        units.stepper.top = Lane::of_int(units.stepper.top.int() + (1 << 10));
    });
    assert!(count > 0 && first.contains("stepper"), "{first}");
    let (count, first) = differences(|setup| {
        let Back::Terrain(units) = &mut setup.surfaces[0].back else { panic!("a height map") };
        let light = units.shader.light.as_mut().expect("light");
        light.ambient = Lane::of_int(light.ambient.int() + 4096);
    });
    assert!(count > 0 && first.contains("shader: pixel_color"), "{first}");
    // Cycles alone: the emulator's memory takes one more.
    let (count, first) = differences(|setup| setup.memory_latency += 1);
    assert!(count > 0 && first.contains("takes it in cycle"), "{first}");
}
