//! Derived error bounds and measured errors of registers: no measurement is above its bound.

#[path = "bounds/directions.rs"]
mod directions;
mod scenes;
mod support;
#[path = "bounds/walks.rs"]
mod walks;
#[path = "bounds/weights.rs"]
mod weights;

use std::collections::BTreeMap;
use std::sync::Mutex;

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use support::recipe::recipes;
use support::{builtin, runner};
use terraline::plan::Plan;
use terraline::scene::{Angles, Attitude, Extent, Scene, WordSize};
use terraline::study::bounds;
use terraline::study::error::Sample;
use terraline::study::explain::Explanation;
use terraline::word::Fixed;
use terraline::word::format::hash;

/// Measurements of one register.
#[derive(Clone, Copy, Debug, Default)]
struct Measured {
    rows: usize,
    largest: f64,
    /// Largest error over its own bound.
    ratio: f64,
}

/// Measurements by what they measure.
#[derive(Debug, Default)]
struct Measurements {
    pixels: usize,
    by_name: BTreeMap<String, Measured>,
    above: Vec<String>,
}

impl Measurements {
    fn take(&mut self, scene: &str, explanation: &Explanation) {
        self.pixels += 1;
        for row in &explanation.rows {
            let Some(bound) = row.bound else { continue };
            // Against the units in f64, and where there is one against the closed form.
            let closed = row.oracle.filter(|_| !row.what.starts_with("last sample"));
            let closed = closed.map(|oracle| row.value - oracle);
            for error in [row.error, closed].into_iter().flatten() {
                let measured = self.by_name.entry(row.what.clone()).or_default();
                measured.rows += 1;
                measured.largest = measured.largest.max(error.abs());
                measured.ratio = measured.ratio.max(error.abs() / bound);
                // `f64` itself is not exact: the real world drifts by a few of its own bits.
                if error.is_nan() || error.abs() > bound * (1.0 + 1e-6) {
                    self.above.push(format!(
                        "{scene}, column {}, line {}: {} is off by {error:e}, bound {bound:e}",
                        explanation.column, explanation.line, row.what
                    ));
                }
            }
        }
    }

    /// Whether every bounded row of an explanation keeps its bound.
    fn keeps(explanation: &Explanation) -> bool {
        let mut measurements = Self::default();
        measurements.take("", explanation);
        measurements.above.is_empty()
    }

    /// Prints every register, and fails where one is above its bound or was hardly measured.
    fn finish(&self, what: &str, names: &[&str], least: usize) {
        println!("{what}: {} pixels", self.pixels);
        for (name, m) in &self.by_name {
            println!(
                "  {name:<16} {:>6} rows, max {:.3e}, {:.3} of the bound",
                m.rows, m.largest, m.ratio
            );
        }
        let first = &self.above[..self.above.len().min(10)];
        assert!(self.above.is_empty(), "{} above:\n{}", self.above.len(), first.join("\n"));
        for name in names {
            let rows = self.by_name.get(*name).map_or(0, |measured| measured.rows);
            assert!(rows >= least, "{what}: {name} was measured {rows} times");
        }
    }
}

const VIEW: [&str; 3] = ["view_x", "view_y", "view_z"];
const LAST: [&str; 3] = ["last sample, x", "last sample, y", "last sample, z"];
const ENTRY: [&str; 3] = ["denominator", "entry_x", "entry_z"];

fn measure(scene: &Scene, side: u32, measurements: &mut Measurements) {
    let plan = support::plan(scene);
    let machine = support::machine(scene, &plan).expect("a machine");
    let sample = Sample::strips(&plan, side, scene.seed);
    for &line in &sample.lines {
        for &column in &sample.columns {
            let explanation = machine.explain(column, line).expect("a pixel");
            measurements.take(&scene.name, &explanation);
        }
    }
}

#[test]
fn built_in_scenes_keep_their_bounds() {
    for (name, names) in [
        ("overview", [VIEW, LAST, ENTRY].concat()),
        ("flight", [VIEW, LAST, ENTRY].concat()),
        ("valley", [VIEW, LAST].concat()),
        ("plane", vec!["view_x", "view_z", "denominator", "entry_x", "entry_z"]),
    ] {
        for words in [WordSize::Narrow, WordSize::Wide] {
            let mut scene = builtin(name, 1024, 1024);
            scene.machine.words = words;
            let mut measurements = Measurements::default();
            measure(&scene, 12, &mut measurements);
            measurements.finish(&format!("{name} {words:?}"), &names, 40);
        }
    }
}

#[test]
fn random_attitudes_keep_their_bounds() {
    let mut measurements = Measurements::default();
    for name in support::SCENES {
        for turn in 0..8_u64 {
            let mut scene = builtin(name, 640, 480);
            let angle = |at: u64| hash(turn, at) as f64 / u64::MAX as f64;
            scene.camera.attitude = Attitude::Angles(Angles {
                heading: 400.0 * angle(0) - 200.0,
                pitch: -0.6 * angle(1),
                roll: 6.4 * angle(2),
            });
            scene.name = format!("{name}, turn {turn}");
            measure(&scene, 3, &mut measurements);
        }
    }
    measurements.finish("random attitudes", &[&VIEW[..], &LAST, &ENTRY].concat(), 60);
    // Bounds are about as large as they must be: one that nothing comes near would bound nothing.
    for (name, measured) in &measurements.by_name {
        assert!(measured.ratio > 0.4, "{name}: {} of the bound", measured.ratio);
    }
}

#[test]
fn random_scenes_keep_their_bounds() {
    let measurements = Mutex::new(Measurements::default());
    let strategy = (recipes(), prop::collection::vec((any::<u16>(), any::<u16>()), 8));
    let result = runner(80).run(&strategy, |(recipe, pixels)| {
        let scene = recipe.scene();
        let Ok(plan) = Plan::new(&scene, None, false) else { return Ok(()) };
        let Ok(machine) = support::machine(&scene, &plan) else { return Ok(()) };
        for (column, line) in pixels {
            let column = u32::from(column) % plan.geometry.columns;
            let line = u32::from(line) % plan.geometry.lines;
            let Ok(explanation) = machine.explain(column, line) else { break };
            measurements.lock().expect("one thread").take(&format!("{recipe:?}"), &explanation);
        }
        Ok(())
    });
    result.unwrap();
    let measurements = measurements.into_inner().expect("one thread");
    measurements.finish("random scenes", &[&VIEW[..], &LAST, &ENTRY].concat(), 100);
}

#[test]
fn an_explanation_is_of_its_pixel() {
    let scene = builtin("flight", 64, 48);
    let plan = support::plan(&scene);
    let machine = support::machine(&scene, &plan).expect("a machine");
    let frame = support::drawn(&scene, &plan).expect("a frame");
    let buffers = frame.buffers.as_ref().expect("asked for");
    let mut skip_tests = 0;
    for at in (0..frame.hit.len()).step_by(37) {
        let found = machine.explain((at % 64) as u32, (at / 64) as u32).expect("a pixel");
        assert_eq!((found.hit, found.color), (frame.hit[at].name(), frame.color[at]), "{at}");
        assert_eq!(found.skip_tests, buffers.trials[at], "{at}");
        if found.hit == "surface" {
            assert_eq!(found.steps, buffers.steps[at], "{at}");
            skip_tests += found.skip_tests;
        }
    }
    assert!(skip_tests > 100, "{skip_tests} skip tests");
}

#[test]
fn a_bound_that_is_too_small_fails() {
    let scene = builtin("flight", 1024, 1024);
    let plan = support::plan(&scene);
    let machine = support::machine(&scene, &plan).expect("a machine");
    let explanation = machine.explain(700, 800).expect("a pixel");
    assert!(Measurements::keeps(&explanation));
    let bounded = |row: &&terraline::study::explain::Row| row.bound.is_some();
    assert!(explanation.rows.iter().filter(bounded).count() >= 6);
    // Row by row, a bound just under the error is found out, and so is an error that is no number.
    let mut found = 0;
    for at in 0..explanation.rows.len() {
        let row = &explanation.rows[at];
        let (Some(error), Some(_)) = (row.error, row.bound) else { continue };
        let mut wrong = explanation.clone();
        wrong.rows[at].error = Some(f64::NAN);
        assert!(!Measurements::keeps(&wrong), "{}", row.what);
        if error != 0.0 {
            wrong = explanation.clone();
            wrong.rows[at].bound = Some(error.abs() * 0.999);
            assert!(!Measurements::keeps(&wrong), "{}", row.what);
            found += 1;
        }
    }
    assert!(found >= 5, "{found} rows with an error");
}

#[test]
fn bounds_follow_their_equations() {
    let format = Fixed { width: 32, point: 20 };
    let ulp = format.ulp();
    assert_eq!(bounds::view(format, 0, 0), ulp / 2.0);
    assert_eq!(bounds::view(format, 10, 5), 8.0 * ulp);
    assert_eq!(bounds::ray(format, ulp, 0, 1.0, 0), ulp);
    assert_eq!(bounds::ray(format, ulp, 4, ulp, -1), ulp + 4.0 * ulp);
    // An exact numerator over an exact denominator is floored, and the eye rounded.
    assert_eq!(bounds::entry(format, 3.0, 0.5, 2, 0.0, 0.0), 1.5 * ulp);
    assert_eq!(bounds::entry(format, -3.0, 0.5, 1, ulp, 0.0), 5.5 * ulp);
    // The finest angle of a screen is that of a pixel in its farthest corner.
    let half = 30_f64.to_radians().tan();
    let corner = DVec3::new(1.0, half * 639.0 / 640.0 + 0.2, half * 639.0 / 640.0 + 0.1);
    let finest = 2.0 * half / 640.0 / corner.length();
    let mut scene = builtin("plane", 640, 640);
    scene.screens[0].extent = Extent::FieldOfView(60_f64.to_radians());
    scene.screens[0].center = DVec2::new(0.2, 0.1);
    let angle = support::plan(&scene).geometry.finest_angle;
    assert!((angle / finest - 1.0).abs() < 1e-12, "{angle} {finest}");
    // A denominator that may be zero has no bound.
    assert_eq!(bounds::entry(format, 3.0, ulp, 2, 0.0, ulp), f64::INFINITY);
}
