//! Random and damaged scene files: a frame that all engines can draw, or a message of one line;
//! never a panic, a wait or much memory.
//!
//! `TERRALINE_FUZZ_CASES` sets the number of cases of each test, `PROPTEST_RNG_SEED` a seed: without
//! it, every run takes a new one.

use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use proptest::bool::weighted;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::TestRunner;
use tempfile::TempDir;
use terraline::engine::{Engine, FixedWorld};
use terraline::frame::Frame;
use terraline::plan::{Plan, SurfacePlan};
use terraline::scene::file::{Document, parse};
use terraline::scene::{Scene, SceneError, builtin, framing, write};
use terraline::setup::SetupError;
use terraline::study::error::Sample;

use super::damage::damages;
use super::grids::grids;
use super::support::{both, described, difference, drawn, is_under_ground, machine};
use super::wild::{options, scenes};
use super::{EVERY_TABLE, PEAK};

/// No case takes longer, a busy machine included: most take milliseconds.
const LONGEST: Duration = Duration::from_secs(30);

/// No case takes more memory, other tests that run meanwhile included.
const MOST_BYTES: usize = 256 << 20;

/// Maps of more nodes are read but not drawn.
const MOST_NODES: usize = 1 << 20;

/// Scenes of longer walks are drawn with few pixels, of much longer ones not at all.
const MANY_STEPS: u32 = 1 << 16;
const MOST_STEPS: u32 = 1 << 20;

/// Maps that the scenes name.
static FOLDER: LazyLock<TempDir> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a folder");
    let grid = |name: &str, columns: usize, rows: usize, sample: &dyn Fn(usize, usize) -> i32| {
        let mut text = format!(
            "ncols {columns}\nnrows {rows}\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -1\n"
        );
        for j in 0..rows {
            let row: Vec<String> = (0..columns).map(|i| sample(i, j).to_string()).collect();
            text += &format!("{}\n", row.join(" "));
        }
        std::fs::write(folder.path().join(name), text).expect("a file");
    };
    let hills = |i: usize, j: usize| 236 + ((i * i + 7 * j * (i + 3)) % 97) as i32;
    grid("hills.asc", 24, 19, &hills);
    grid("holes.asc", 17, 33, &|i, j| if (i / 3 + j / 2) % 5 == 0 { -1 } else { hills(i, j) });
    grid("flat.asc", 9, 9, &|_, _| 300);
    grid("row.asc", 12, 1, &hills);
    grid("one.asc", 1, 1, &hills);
    let path = |name: &str| folder.path().join(name);
    image::ImageBuffer::from_fn(31, 20, |i, j| image::Luma([(i * j * 4001 % 65536) as u16]))
        .save(path("cliffs.png"))
        .expect("a file");
    image::ImageBuffer::from_fn(20, 20, |i, j| image::Rgb([128, i as u8 * 9, j as u8]))
        .save(path("packed.png"))
        .expect("a file");
    folder
});

/// How far the cases of a test came.
#[derive(Debug, Default)]
struct Seen {
    cases: AtomicUsize,
    read: AtomicUsize,
    planned: AtomicUsize,
    drawn: AtomicUsize,
}

/// What was refused, which is well, or what went wrong.
enum Stop {
    Refused(String),
    Wrong(String),
}

fn refused(error: impl std::fmt::Display) -> Stop {
    Stop::Refused(error.to_string())
}

/// Runs a test of many cases, each in a thread of its own, so that one that waits for ever is found;
/// `share` of them must be drawn.
fn fuzz<S: Strategy>(
    cases: S,
    share: f64,
    read: impl Fn(S::Value) -> Result<Scene, Stop> + Copy + Send + 'static,
) where
    S::Value: Clone + Send + 'static,
{
    let asked = std::env::var("TERRALINE_FUZZ_CASES").ok().and_then(|cases| cases.parse().ok());
    let config = ProptestConfig {
        cases: asked.unwrap_or(256),
        source_file: Some(file!()),
        // Milliseconds; a case that waits takes seconds.
        max_shrink_time: 120_000,
        ..ProptestConfig::default()
    };
    let seen = Seen::default();
    let result = TestRunner::new(config)
        .run(&cases, |values| try_one(move || read(values), &seen).map_err(TestCaseError::fail));
    println!("{seen:?}");
    result.unwrap_or_else(|error| panic!("{error}"));
    let (cases, drawn) = (seen.cases.load(Relaxed), seen.drawn.load(Relaxed));
    assert!(drawn as f64 > share * cases as f64, "too few are drawn: {seen:?}");
}

fn try_one(
    read: impl FnOnce() -> Result<Scene, Stop> + Send + 'static,
    seen: &Seen,
) -> Result<(), String> {
    seen.cases.fetch_add(1, Relaxed);
    let (sender, receiver) = channel();
    PEAK.reset_peak_usage();
    thread::spawn(move || {
        let stages = AtomicUsize::new(0);
        let result = read().and_then(|scene| draw(scene, &stages));
        // Nobody listens after the longest wait.
        let _ = sender.send((result, stages.into_inner()));
    });
    let (result, stages) = match receiver.recv_timeout(LONGEST) {
        Ok(done) => done,
        Err(RecvTimeoutError::Disconnected) => return Err("panicked".into()),
        Err(RecvTimeoutError::Timeout) => return Err(format!("takes longer than {LONGEST:?}")),
    };
    for (stage, count) in [&seen.read, &seen.planned, &seen.drawn].into_iter().enumerate() {
        count.fetch_add(usize::from(stages > stage), Relaxed);
    }
    if PEAK.peak_usage() > MOST_BYTES {
        return Err(format!("takes {} bytes", PEAK.peak_usage()));
    }
    match result {
        Ok(()) => Ok(()),
        Err(Stop::Wrong(what)) => Err(what),
        Err(Stop::Refused(message)) if message.contains(char::is_control) => {
            Err(format!("a message of several lines: {message:?}"))
        }
        Err(Stop::Refused(message)) if message.len() > 700 => {
            Err(format!("a long message: {message}"))
        }
        Err(Stop::Refused(_)) => Ok(()),
    }
}

fn parsed(text: &str, sets: &[String]) -> Result<Scene, SceneError> {
    parse(&Document { name: "my", file: "my.toml", folder: FOLDER.path(), text }, sets)
}

/// A scene from a text and options; what is written of it reads back.
fn from_text((text, sets): (String, Vec<String>)) -> Result<Scene, Stop> {
    let scene = parsed(&text, &sets).map_err(refused)?;
    reads_back(&scene, &written(&scene))?;
    Ok(scene)
}

/// The scene that is chosen for a height file; the file that is written for it reads back.
fn from_grid((grid, sets): (String, Vec<String>)) -> Result<Scene, Stop> {
    let path = FOLDER.path().join("grid.asc");
    std::fs::write(&path, grid).map_err(|error| Stop::Wrong(error.to_string()))?;
    let framing = framing::read(&path, &sets, Some((16, 12)), None).map_err(refused)?;
    let file = framing.file(&framing.scene, &FOLDER.path().join("grid.toml")).map_err(refused)?;
    reads_back(&framing.scene, &file)?;
    Ok(framing.scene)
}

/// Whether a text holds a scene: in every bit, but for angles that were made of directions.
fn reads_back(scene: &Scene, text: &str) -> Result<(), Stop> {
    match parsed(text, &[]) {
        Ok(again) => {
            let mut turned = again.clone();
            turned.camera.attitude.clone_from(&scene.camera.attitude);
            if written(&again) == written(scene) && described(&turned) == described(scene) {
                return Ok(());
            }
            Err(Stop::Wrong(format!("is another scene when read back:\n{text}")))
        }
        Err(error) => Err(Stop::Wrong(format!("does not read back: {error}\n{text}"))),
    }
}

/// Plans and draws a scene; `stages` counts how far it comes.
fn draw(mut scene: Scene, stages: &AtomicUsize) -> Result<(), Stop> {
    stages.store(1, Relaxed);
    if let Some(terrain) = scene.terrain()
        && terrain.map.samples().len() > MOST_NODES
    {
        return Ok(());
    }
    for screen in &mut scene.screens {
        *screen = screen.resized(16, 12);
    }
    let plan = Plan::new(&scene, None, false).map_err(refused)?;
    let steps = plan.surfaces.iter().filter_map(SurfacePlan::terrain).map(|walk| walk.last);
    let steps = steps.max().unwrap_or(0);
    // Rays that hardly move, or run along cliffs, take most of their steps.
    if steps > MOST_STEPS {
        return Ok(());
    }
    if steps > MANY_STEPS {
        for screen in &mut scene.screens {
            *screen = screen.resized(2, 2);
        }
    }
    let last = scene.screens.last().map(|screen| screen.name.clone());
    for (screen, full) in [(None, false), (last.as_deref(), true)] {
        let plan = Plan::new(&scene, screen, full).map_err(refused)?;
        let world = FixedWorld::of(&scene, &plan).map_err(refused)?;
        stages.fetch_max(2, Relaxed);
        // Registers that saturate are the processor's alone.
        let frame = if world.wraps() {
            let (frame, fast) = both(&scene, &plan).map_err(refused)?;
            if let Some(difference) = difference(&frame, &fast) {
                return Err(Stop::Wrong(format!("processor and fast, full {full}: {difference}")));
            }
            frame
        } else {
            drawn(&scene, &plan).map_err(refused)?
        };
        study(&scene, &plan, &frame)?;
        stages.store(3, Relaxed);
    }
    Ok(())
}

/// What the commands do with a scene that can be drawn: that must work.
fn study(scene: &Scene, plan: &Plan, frame: &Frame) -> Result<(), Stop> {
    let wrong = |error: &SetupError| {
        // In a coarse world the ground may be lower than it is.
        if is_under_ground(error) {
            refused(error)
        } else {
            Stop::Wrong(format!("drawn, but {error}"))
        }
    };
    let pixels = frame.hit.len();
    let machine = machine(scene, plan).map_err(|error| wrong(&error))?;
    let real = machine.frame(Engine::Real, true).map_err(|error| wrong(&error))?;
    let oracle = machine.frame(Engine::Oracle, true).map_err(|error| wrong(&error))?;
    if (real.hit.len(), oracle.hit.len()) != (pixels, pixels) {
        return Err(Stop::Wrong("frames of several sizes".into()));
    }
    let sample = Sample::strips(plan, 3, scene.seed);
    let errors = machine.errors(&sample).map_err(|error| wrong(&error))?;
    let explanation = machine.explain(1, 1).map_err(|error| wrong(&error))?;
    let cost = machine.cost(&sample, &sample).map_err(|error| wrong(&error))?;
    if errors.len() != sample.len() || explanation.rows.is_empty() || cost.cycles == 0 {
        return Err(Stop::Wrong("studies of nothing".into()));
    }
    Ok(())
}

fn written(scene: &Scene) -> String {
    write::toml(scene, scene.terrain().map_or("", |terrain| &terrain.source))
}

#[test]
fn random_scenes() {
    fuzz(scenes().prop_map(|text| (text, Vec::new())), 0.2, from_text);
}

#[test]
fn damaged_scenes() {
    let damaged = (scenes(), vec(damages(), 1..5)).prop_map(|(text, damages)| {
        (damages.iter().fold(text, |text, damage| damage.to(&text)), Vec::new())
    });
    fuzz(damaged, 0.05, from_text);
}

#[test]
fn scenes_with_options() {
    fuzz((scenes(), vec(options(), 1..4)), 0.1, from_text);
}

#[test]
fn damaged_built_in_scenes() {
    let mut texts: Vec<&str> = builtin::SCENES.iter().map(|scene| scene.toml).collect();
    texts.push(EVERY_TABLE);
    let damage = (select(texts), vec(damages(), 1..4), vec(options(), 0..2), weighted(0.8));
    let damaged = damage.prop_map(|(text, damages, sets, small)| {
        let text = damages.iter().fold(text.to_owned(), |text, damage| damage.to(&text));
        // Most of the time is spent on the map's memories.
        (if small { text.replace("jacksboro\"", "jacksboro@61\"") } else { text }, sets)
    });
    fuzz(damaged, 0.1, from_text);
}

#[test]
fn bare_height_files() {
    let no_map = |sets: &Vec<String>| sets.iter().all(|set| !set.contains(".map="));
    let sets = vec(options(), 0..2).prop_filter("the map is given", no_map);
    fuzz((grids(), sets), 0.4, from_grid);
}
