//! Errors of the machine against the oracle, on stated samples: the units in fixed point, and the
//! same units in `f64`.

mod support;

#[path = "accuracy/exact.rs"]
mod exact;
#[path = "accuracy/steep.rs"]
mod steep;

use glam::{DVec2, DVec3};
use support::recipe::{Eye, recipes};
use support::{SHAPES, builtin, loaded, machine, map, over, runner, terrain};
use terraline::engine::Engine;
use terraline::frame::{Buffers, Hit};
use terraline::plan::Plan;
use terraline::scene::{Bisection, Deformation, Extent, Scene, WordSize};
use terraline::study::error::{ErrorReport, PixelError, Sample, Sheet, Spread};

fn errors(scene: &Scene, strips: u32) -> ErrorReport {
    let plan = support::plan(scene);
    let machine = machine(scene, &plan).expect("a machine");
    let sample = Sample::strips(&plan, strips, scene.seed);
    let side = strips.min(plan.geometry.lines) as usize;
    assert_eq!(sample.lines.len(), side);
    let pixels = machine.errors(&sample).expect("errors");
    let report = ErrorReport::new(&sample, &pixels, scene.unit_m);
    println!(
        "{} {}x{} {}: {} same sheet, {} lost, total {:.6} {:.6} {:.6}, algorithm {:.6} \
         {:.6} {:.6}, colour {:.5}",
        scene.name,
        plan.geometry.columns,
        plan.geometry.lines,
        machine.world().name(),
        report.counts.same_sheet,
        report.counts.lost.total,
        report.total_px.expect("pixels").median,
        report.total_px.expect("pixels").p999,
        report.total_px.expect("pixels").max,
        report.algorithm_px.expect("pixels").median,
        report.algorithm_px.expect("pixels").p999,
        report.algorithm_px.expect("pixels").max,
        report.color_within_2,
    );
    report
}

#[track_caller]
fn within(what: &str, spread: Option<Spread>, median: f64, p999: f64) {
    let spread = spread.expect("pixels on the same sheet");
    assert!(spread.max > 0.0, "{what}: nothing was measured");
    assert!(spread.median <= median, "{what}: median {}", spread.median);
    assert!(spread.p999 <= p999, "{what}: 99.9 % within {}", spread.p999);
}

/// What every scene must keep, fixed point and the algorithm by itself. Limits are about twice what
/// is measured, which is printed.
#[track_caller]
fn keeps(report: &ErrorReport, same_sheet: f64, silhouettes: f64) {
    let counts = &report.counts;
    let share = |count: usize| count as f64 / counts.pixels as f64;
    assert!(share(counts.same_sheet) > same_sheet, "{counts:?}");
    assert!(share(counts.lost.total + counts.ghosts.total) < silhouettes, "{counts:?}");
    assert!(report.color_within_2 >= 0.999, "colours within 2: {}", report.color_within_2);
}

#[test]
fn terrains_keep_their_bounds() {
    for (name, same_sheet) in [("overview", 0.5), ("flight", 0.5), ("valley", 0.4)] {
        let report = errors(&builtin(name, 1024, 1024), 128);
        keeps(&report, same_sheet, 0.001);
        within("total", report.total_px, 0.006, 0.02);
        within("algorithm", report.algorithm_px, 0.0025, 0.013);
    }
}

#[test]
fn wide_words_keep_the_bounds_of_narrow_ones() {
    for name in support::TERRAINS {
        let mut scene = builtin(name, 1024, 1024);
        scene.machine.words = WordSize::Wide;
        let report = errors(&scene, 64);
        keeps(&report, 0.4, 0.002);
        within("total", report.total_px, 0.0025, 0.015);
        // What is left is the algorithm's own error.
        assert!(
            report.quantisation_px.expect("pixels").median
                < report.algorithm_px.expect("pixels").median
        );
    }
}

#[test]
fn the_largest_screens_keep_a_fifteenth_of_a_pixel() {
    for name in support::TERRAINS {
        let report = errors(&builtin(name, 8192, 8192), 64);
        keeps(&report, 0.4, 0.002);
        within("total", report.total_px, 0.007, 1.0 / 15.0);
        within("algorithm", report.algorithm_px, 0.007, 1.0 / 15.0);
    }
}

#[test]
fn planes_keep_their_bounds() {
    for (side, strips, median, p999) in [(1024, 128, 6e-4, 0.002), (8192, 64, 3e-4, 8e-4)] {
        let report = errors(&builtin("plane", side, side), strips);
        keeps(&report, 0.5, 0.001);
        // A square's border may fall on either side of a pixel's centre.
        within("total", report.total_px, median, p999);
        assert!(report.algorithm_px.expect("pixels").max < 1e-6, "a ratio in f64 is exact");
    }
    // Squares fade by the larger side of a pixel and the distance of the screen.
    let mut scene = builtin("plane", 1024, 1024);
    let pixel = DVec2::new(0.0004, 0.0008);
    scene.screens[0].extent = Extent::Pitch { distance: 0.5, pixel };
    keeps(&errors(&scene, 128), 0.4, 0.001);
}

/// Where both see ground, or both a side of the map: the readout and the oracle's own.
#[test]
fn buffers_are_those_of_the_oracle() {
    let beside = "camera.position=[172, 20, -20]";
    for (name, set, kind) in [
        ("overview", "seed=0", Hit::Surface),
        ("overview", beside, Hit::Side),
        ("valley", "seed=0", Hit::Surface),
        ("plane", "seed=0", Hit::Surface),
    ] {
        let scene = loaded(name, &["screen.size=[160, 120]", set]);
        let plan = support::plan(&scene);
        let machine = machine(&scene, &plan).expect("a machine");
        let [ours, theirs] = [Engine::Processor, Engine::Oracle]
            .map(|engine| machine.frame(engine, true).expect("a frame"));
        let both: Vec<usize> = (0..ours.hit.len())
            .filter(|&at| (ours.hit[at], theirs.hit[at]) == (kind, kind))
            .collect();
        assert!(both.len() > 500, "{name} {set}: {} pixels", both.len());
        let [a, b] = [ours, theirs].map(|frame| frame.buffers.expect("asked for"));
        let keeps = |what: &str, median: f64, p999: f64, apart: &dyn Fn(usize) -> f64| {
            let spread = Spread::of(both.iter().map(|&at| apart(at))).expect("pixels");
            println!("{name} {set}, {what}: {spread:?}");
            assert!(spread.median <= median && spread.p999 <= p999, "{name} {set}, {what}");
        };
        // As shares of the distance, in screens; normals are unit vectors.
        keeps("lambda", 7e-5, 3e-4, &|at| (a.lambda[at] / b.lambda[at] - 1.0).abs());
        keeps("place", 6e-5, 3e-4, &|at| a.point(at).distance(b.point(at)) / b.lambda[at]);
        let normal = |of: &Buffers, at: usize| DVec3::from(of.normal[at]);
        keeps("normal", 1.3e-3, 0.5, &|at| normal(&a, at).distance(normal(&b, at)));
    }
}

#[test]
fn eyes_just_above_the_highest_node_keep_their_bounds() {
    for up in [1e-12, 1.0 / 300.0, 1.0 / 200.0] {
        let hills = map(40, 40, |i, j| ((i * 7 + j * 13) % 19) as f32 / 8.0);
        let mut scene = over(hills, 320, 240);
        scene.camera.position = DVec3::new(20.3, terrain(&mut scene).range().1 + up, 3.2);
        // Where the layer is thin, rays start at the eye.
        let plan = support::plan(&scene);
        let fitted = &plan.surfaces[0].terrain().expect("a height map").fitted;
        assert_eq!(fitted.divider.fitted, up > 1.0 / 256.0);
        let machine = machine(&scene, &plan).expect("a machine");
        let found = machine.errors(&Sample::strips(&plan, 64, scene.seed)).expect("errors");
        let count = |sheet| found.iter().filter(|pixel| pixel.sheet == sheet).count();
        let (same, lost) = (count(Sheet::Same), count(Sheet::Lost));
        assert!(same > 2000 && lost < same / 200, "{same} on the same sheet, {lost} lost");
        // Ridges one behind the other: of the lost pixels, which are limited above, none counts below.
        let total = found.iter().map(|pixel| pixel.total_px).filter(|error| error.is_finite());
        within("total", Spread::of(total), 0.006, 0.035);
    }
}

#[test]
fn every_kernel_keeps_its_bounds() {
    for deformation in [Deformation::None, Deformation::Stretch] {
        for shape in SHAPES {
            let mut scene = builtin("flight", 512, 512);
            scene.kernel.shape = shape;
            scene.kernel.deformation = deformation;
            scene.name = format!("{shape:?} {deformation:?}");
            let report = errors(&scene, 128);
            keeps(&report, 0.5, 0.002);
            within("total", report.total_px, 0.0035, 0.02);
            within("algorithm", report.algorithm_px, 0.0035, 0.02);
        }
    }
}

#[test]
fn random_scenes_keep_their_bounds() {
    let all = std::sync::Mutex::new(Vec::<PixelError>::new());
    let result = runner(220).run(&recipes(), |mut recipe| {
        // The machine's own refinement, with steps that lose few ridges, and slopes that do not
        // turn a small error along the ray into a large one across it.
        recipe.bisection = Bisection::Footprint;
        recipe.fineness = 4;
        recipe.kernel.table = 4096;
        recipe.steepness = recipe.steepness.min(2.0);
        match &mut recipe.eye {
            Eye::Inside { up, .. } | Eye::Above { up, .. } => *up = up.max(0.1),
            Eye::Beside { .. } => {}
        }
        let scene = recipe.scene();
        let Ok(plan) = Plan::new(&scene, None, false) else { return Ok(()) };
        let errors = machine(&scene, &plan).and_then(|machine| machine.errors(&Sample::all(&plan)));
        if let Ok(found) = errors {
            all.lock().expect("one thread").extend(found);
        }
        Ok(())
    });
    result.unwrap();
    let all = all.into_inner().expect("one thread");
    let count = |sheet| all.iter().filter(|p| p.sheet == sheet).count();
    let same = count(Sheet::Same);
    let silhouettes = count(Sheet::Lost) + count(Sheet::Ghost);
    // Lost pixels, whose share has a limit of its own, apart.
    let total = Spread::of(all.iter().map(|p| p.total_px).filter(|error| error.is_finite()));
    // Out of range and sky have colours of their own here, which the oracle parts elsewhere.
    let met = || all.iter().filter(|p| !matches!(p.sheet, Sheet::Empty | Sheet::Flip));
    let close = met().filter(|p| p.color <= 2).count() as f64 / met().count() as f64;
    println!("{same} same sheet, {silhouettes} silhouettes, {total:?}, colour {close:.5}");
    assert!(same > 20_000, "{same} pixels on the same sheet");
    assert!((silhouettes as f64) < 0.005 * all.len() as f64, "{silhouettes} silhouettes");
    within("total", total, 0.0025, 0.13);
    assert!(close > 0.99, "colours within 2: {close}");
}
