//! Several surfaces compete by the depth register: every engine shows the nearest, and a surface that
//! does not show changes no bit.

mod support;

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use glam::DVec3;
use proptest::prelude::*;
use support::{
    assert_same, at_every_level, builtin, difference, draw_in_real, machine, plan, runner,
};
use terraline::engine::Engine;
use terraline::frame::Hit;
use terraline::oracle::Oracle;
use terraline::plan::{Plan, PlanError};
use terraline::scene::{FormatRequest, Plane, Scene, Surface, WordSize};
use terraline::study::error::{ErrorReport, Sample};
use terraline::word::{Class, Overflow, Registers, Rounding};

fn plane(normal: DVec3, distance: f64, checker: f64) -> Surface {
    Surface::Plane(Plane { normal: normal.normalize(), distance, checker })
}

/// The built-in plane's camera before other surfaces.
fn scene(surfaces: Vec<Surface>, words: WordSize) -> Scene {
    let mut scene = builtin("plane", 40, 30);
    scene.machine.words = words;
    scene.surfaces = surfaces;
    scene
}

/// The frames of both scenes are equal in every bit, with the processor and with the fast engine.
#[track_caller]
fn assert_alike(what: &str, a: Vec<Surface>, b: Vec<Surface>) {
    for words in [WordSize::Narrow, WordSize::Wide] {
        let (a, b) = (scene(a.clone(), words), scene(b.clone(), words));
        for engine in [Engine::Processor, Engine::Fast, Engine::Real] {
            let frame = |scene: &Scene| {
                let plan = plan(scene);
                machine(scene, &plan).and_then(|m| m.frame(engine, true)).expect("a frame")
            };
            let (a, b) = (frame(&a), frame(&b));
            assert!(support::count(&a, Hit::Surface) > 200, "{what}: most of the ground is seen");
            assert_same(what, &a, &b);
        }
    }
}

#[test]
fn the_nearest_plane_hides_the_others() {
    let floor = plane(DVec3::Y, 0.0, 8.0);
    let cellar = plane(DVec3::Y, -7.0, 3.0);
    let behind = plane(DVec3::X, -50.0, 8.0);
    let edge_on = plane(DVec3::Y, 10.0, 8.0);
    for others in [vec![cellar.clone()], vec![behind, edge_on, cellar]] {
        for at in 0..=others.len() {
            let mut all = others.clone();
            all.insert(at, floor.clone());
            assert_alike("the floor alone", all, vec![floor.clone()]);
        }
    }
}

#[test]
fn of_equally_near_planes_the_first_shows() {
    let (coarse, fine) = (plane(DVec3::Y, 0.0, 8.0), plane(DVec3::Y, 0.0, 2.0));
    assert_alike("coarse", vec![coarse.clone(), fine.clone()], vec![coarse.clone()]);
    assert_alike("fine", vec![fine.clone(), coarse], vec![fine]);
}

#[test]
fn a_height_map_does_not_compete_yet() {
    let mut scene = builtin("overview", 8, 8);
    scene.surfaces.push(plane(DVec3::Y, 0.0, 8.0));
    refused(&scene, "height map");
}

#[test]
fn several_surfaces_have_stock_formats() {
    let planes = vec![plane(DVec3::Y, 0.0, 8.0), plane(DVec3::X, 60.0, 8.0)];
    let mut scene = scene(planes, WordSize::Auto);
    assert!(Plan::new(&scene, None, false).is_ok());
    let (rounding, overflow) = (Rounding::default(), Overflow::default());
    let request = FormatRequest { width: 24, point: 8, rounding, overflow };
    scene.formats = vec![(Registers::Class(Class::Ground), request)];
    refused(&scene, "overflows");
}

fn refused(scene: &Scene, word: &str) {
    let error = Plan::new(scene, None, false).expect_err("refused");
    assert!(
        matches!(error, PlanError::SeveralSurfaces(reason) if reason.contains(word)),
        "{error}"
    );
}

/// Two to four planes around the camera of the built-in plane, at least a unit away from the eye.
fn planes() -> impl Strategy<Value = Vec<Surface>> {
    let normal = (-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64)
        .prop_map(|(x, y, z)| DVec3::new(x, y, z))
        .prop_filter("long enough", |normal| normal.length() > 0.2);
    let away = prop_oneof![1.0..60.0_f64, -60.0..-1.0_f64];
    let one = (normal, away, 2.0..10.0_f64).prop_map(|(normal, away, checker)| {
        let normal = normal.normalize();
        plane(normal, normal.dot(DVec3::new(0.0, 10.0, 0.0)) + away, checker)
    });
    prop::collection::vec(one, 2..=4)
}

#[test]
fn random_planes_are_drawn_alike_and_as_the_oracle_says() {
    let (pixels, missed, later) = (AtomicUsize::new(0), AtomicUsize::new(0), AtomicUsize::new(0));
    let run = |(surfaces, wide): (Vec<Surface>, bool)| {
        let words = if wide { WordSize::Wide } else { WordSize::Narrow };
        let scene = scene(surfaces, words);
        let plan = plan(&scene);
        let machine = machine(&scene, &plan).expect("a machine");
        let processor = machine.frame(Engine::Processor, true).expect("a frame");
        let mut others = at_every_level(&scene, &plan).expect("frames");
        others.push(machine.frame(Engine::Fast, true).expect("a frame"));
        for fast in others {
            if let Some(difference) = difference(&processor, &fast) {
                return Err(TestCaseError::fail(difference));
            }
        }
        let real = draw_in_real(&scene, &plan).expect("a frame");
        let oracle = Oracle::new(&scene, &plan.screen);
        let first = Scene { surfaces: vec![scene.surfaces[0].clone()], ..scene.clone() };
        let first = Oracle::new(&first, &plan.screen);
        for at in 0..real.hit.len() {
            let (line, column) = ((at / 40) as f64, (at % 40) as f64);
            let seen = oracle.pixel(line, column);
            let lambda = |frame: &terraline::frame::Frame| {
                frame.buffers.as_ref().expect("buffers").lambda[at]
            };
            let alike = |frame: &terraline::frame::Frame, share: f64| {
                frame.hit[at] == seen.hit
                    && (seen.hit != Hit::Surface
                        || (lambda(frame) / seen.lambda - 1.0).abs() < share)
            };
            // Near its horizon a plane is out of range for the registers, and not for the oracle.
            if processor.hit[at] == Hit::OutOfRange {
                continue;
            }
            prop_assert!(alike(&real, 1e-9), "pixel {at}: {:?} {seen:?}", lambda(&real));
            pixels.fetch_add(1, Relaxed);
            missed.fetch_add(usize::from(!alike(&processor, 1e-3)), Relaxed);
            later.fetch_add(usize::from(first.pixel(line, column) != seen), Relaxed);
        }
        Ok(())
    };
    runner(60).run(&(planes(), any::<bool>()), run).unwrap();
    let [pixels, missed, later] = [pixels, missed, later].map(|count| count.load(Relaxed));
    println!("{pixels} pixels, {missed} not as the oracle says, {later} of a later plane");
    assert!(pixels > 40_000 && later > pixels / 10);
    assert!(missed * 10_000 < pixels, "{missed} of {pixels} pixels are not as the oracle says");
}

#[test]
fn studies_follow_the_surface_that_shows() {
    let (wall, floor) = (plane(DVec3::X, 60.0, 8.0), plane(DVec3::Y, 0.0, 8.0));
    let scene = scene(vec![wall.clone(), floor.clone()], WordSize::Narrow);
    let plan = plan(&scene);
    let machine = machine(&scene, &plan).expect("a machine");

    // Every surface has its stages, and none is counted twice.
    let all = Sample::all(&plan);
    let cost = machine.cost(&all, &all).expect("a cost");
    let names: Vec<_> = cost.units.iter().map(|unit| unit.name).collect();
    let each = ["projector", "divider", "shader", "depth"];
    assert_eq!(names, [&each[..], &each[..], &["frame"]].concat());
    let projectors: Vec<f64> = [0, 4].map(|at| cost.units[at].additions_per_pixel).into();
    // One accumulator changes along a line: 39 additions on 40 columns.
    assert_eq!(projectors, [0.975, 0.975]);
    // The comparison, where both planes show.
    let compared = cost.units[7].additions_per_pixel;
    assert!(
        cost.units[3].additions_per_pixel == 0.0 && (0.2..1.0).contains(&compared),
        "{compared}"
    );

    let errors = machine.errors(&all).expect("errors");
    let report = ErrorReport::new(&all, &errors, scene.unit_m);
    let total = report.total_px.expect("pixels");
    assert!(total.max < 0.5, "{total:?}");

    // The columns in the middle see the wall over the floor.
    let frame = machine.frame(Engine::Processor, true).expect("a frame");
    let normals = &frame.buffers.as_ref().expect("buffers").normal;
    let mut seen = [0, 0];
    for at in (0..frame.hit.len()).filter(|&at| frame.hit[at] == Hit::Surface).step_by(7) {
        let found = machine.explain((at % 40) as u32, (at / 40) as u32).expect("a pixel");
        let along = usize::from(normals[at] == [0.0, 1.0, 0.0]);
        seen[along] += 1;
        assert_eq!((found.hit, found.color), ("surface", frame.color[at]));
        for what in ["view_x", "denominator", "entry_x", "entry_z"] {
            let row = found.rows.iter().find(|row| row.what == what).expect(what);
            let oracle = row.oracle.expect("a closed form");
            let apart = (row.value - oracle).abs();
            assert!(apart <= 1e-3 * oracle.abs().max(1.0), "{what}: {} {oracle}", row.value);
        }
    }
    assert!(seen.iter().all(|&pixels| pixels > 10), "{seen:?} pixels of wall and floor");
}
