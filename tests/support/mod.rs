//! Scenes built by hand, frames drawn from them, and frames compared bit by bit.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod formats;
pub mod recipe;

use std::fmt::Debug;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use proptest::test_runner::{Config, RngSeed, TestRunner};
use terraline::engine::{FixedWorld, InFastWorld, InFixedWorld, draw_by_lines, draw_real};
use terraline::fast::{self, enter::Enterable};
use terraline::frame::{Frame, Hit};
use terraline::oracle::Oracle;
use terraline::plan::{Plan, PlanError};
use terraline::scene::{
    Attitude, Camera, Colors, Deformation, Encoding, Extent, Halvings, HeightMap, Kernel,
    KernelShape, Light, Machine, NoData, Outside, RatioForm, Scene, Screen, Stepper, StepperMode,
    Surface, Terrain, WordSize, load,
};
use terraline::setup::{Memory, Setup, SetupError};
use terraline::word::Complete;
use terraline::word::real::Real;

/// Names of the built-in scenes with a height map.
pub const TERRAINS: [&str; 3] = ["overview", "flight", "valley"];
/// Names of all built-in scenes.
pub const SCENES: [&str; 4] = ["overview", "flight", "valley", "plane"];
/// All shapes of the finite function.
pub const SHAPES: [KernelShape; 4] =
    [KernelShape::Cosine, KernelShape::Parabola, KernelShape::Exponential, KernelShape::Hat];

/// A built-in scene in another raster.
pub fn builtin(name: &str, columns: u32, lines: u32) -> Scene {
    let mut scene = load(Some(name), &[]).expect("a built-in scene");
    for screen in &mut scene.screens {
        *screen = screen.resized(columns, lines);
    }
    scene
}

/// A scene over a map of square cells of side one, samples as heights, seen from above its middle.
pub fn over(map: HeightMap, columns: u32, lines: u32) -> Scene {
    let (width, depth) = ((map.columns() - 1) as f64, (map.rows() - 1) as f64);
    let highest = f64::from(map.range().1);
    Scene {
        name: "hand".into(),
        unit_m: 1.0,
        seed: 1,
        camera: Camera {
            position: DVec3::new(width / 2.0, highest + 0.6 * width.max(depth), -depth / 4.0),
            offset: DVec3::ZERO,
            attitude: Attitude::Directions {
                forward: DVec3::new(0.0, -1.0, 1.0),
                up: DVec3::new(0.0, 1.0, 0.0),
            },
        },
        screens: vec![Screen {
            name: "front".into(),
            columns,
            lines,
            extent: Extent::FieldOfView(60_f64.to_radians()),
            center: DVec2::ZERO,
            mount: Default::default(),
        }],
        surface: Surface::Terrain(Terrain {
            source: "hand".into(),
            map: Arc::new(map),
            encoding: Encoding::Stored,
            cell: DVec2::ONE,
            offset: 0.0,
            scale: 1.0,
            outside: Outside::Sky,
            nodata: NoData::Hole,
            base_depth: None,
        }),
        kernel: Kernel {
            shape: KernelShape::Cosine,
            deformation: Deformation::Blend { weight_shift: 2 },
            table: 4096,
        },
        stepper: Stepper {
            mode: StepperMode::Skipping,
            fineness: 3,
            halvings: Halvings::Footprint,
        },
        light: Light { direction: DVec3::new(-1.0, 1.5, -1.0).normalize(), ambient: 0.3 },
        color: Colors {
            ramp: vec![[0, 0, 255], [255, 0, 0]],
            sky: [160, 190, 220],
            far: [1, 2, 3],
            side: [96, 82, 64],
            checker: [[200, 200, 190], [70, 90, 70]],
        },
        machine: Machine {
            clock_mhz: 100.0,
            memory_latency: 2,
            words: WordSize::Auto,
            ratio: RatioForm::Array,
        },
        formats: Vec::new(),
    }
}

/// A map from a function of column and row.
pub fn map(columns: usize, rows: usize, height: impl Fn(usize, usize) -> f32) -> HeightMap {
    let samples = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    HeightMap::new(columns, rows, samples.map(|(i, j)| height(i, j)).collect())
}

/// The terrain of a scene that has one.
pub fn terrain(scene: &mut Scene) -> &mut Terrain {
    match &mut scene.surface {
        Surface::Terrain(terrain) => terrain,
        Surface::Plane(_) => panic!("a scene with a terrain"),
    }
}

/// The pruned plan of a scene's first screen, which must exist.
pub fn plan(scene: &Scene) -> Plan {
    Plan::new(scene, None, false).unwrap_or_else(|error| panic!("{}: {error}", scene.name))
}

/// A random test of `cases` cases. Seeds are fixed, so that every run tests the same cases;
/// `PROPTEST_RNG_SEED` and `PROPTEST_CASES` ask for others.
pub fn runner(cases: u32) -> TestRunner {
    let default = Config::default();
    TestRunner::new(Config {
        cases: if std::env::var_os("PROPTEST_CASES").is_some() { default.cases } else { cases },
        rng_seed: match default.rng_seed {
            RngSeed::Random => RngSeed::Fixed(0x7e55_a11e),
            fixed @ RngSeed::Fixed(_) => fixed,
        },
        failure_persistence: None,
        ..default
    })
}

/// Draws with the line-by-line processor.
pub fn processor<W: Complete>(world: W, scene: &Scene, plan: &Plan) -> Result<Frame, SetupError> {
    let memory = Memory::new(&world, scene, plan)?;
    let setup = Setup::new(world, scene, plan, memory.as_ref())?;
    Ok(draw_by_lines(&setup, plan, true, |_| {}))
}

/// Draws with the fast engine.
pub fn fast<W: Enterable>(world: W, scene: &Scene, plan: &Plan) -> Result<Frame, SetupError> {
    let memory = Memory::new(&world, scene, plan)?;
    let setup = Setup::new(world, scene, plan, memory.as_ref())?;
    let map = fast::Map::new(&world, scene, plan, memory.as_ref());
    Ok(fast::render(&setup, map.as_ref(), plan, true))
}

/// Draws with both engines in a scene's fixed-point world: processor, fast.
pub fn both(scene: &Scene, plan: &Plan) -> Result<(Frame, Frame), SetupError> {
    struct Both<'a>(&'a Scene, &'a Plan);
    impl InFastWorld for Both<'_> {
        type Output = Result<(Frame, Frame), SetupError>;
        fn run<W: Enterable>(self, world: W) -> Self::Output {
            Ok((processor(world, self.0, self.1)?, fast(world, self.0, self.1)?))
        }
    }
    FixedWorld::of(scene, plan)?.run_fast(Both(scene, plan))
}

/// Draws with the fast engine at every SIMD level that there is.
pub fn at_every_level(scene: &Scene, plan: &Plan) -> Result<Vec<Frame>, SetupError> {
    struct Levels<'a>(&'a Scene, &'a Plan);
    impl InFastWorld for Levels<'_> {
        type Output = Result<Vec<Frame>, SetupError>;
        fn run<W: Enterable>(self, world: W) -> Self::Output {
            let Self(scene, plan) = self;
            let memory = Memory::new(&world, scene, plan)?;
            let setup = Setup::new(world, scene, plan, memory.as_ref())?;
            let map = fast::Map::new(&world, scene, plan, memory.as_ref());
            let draw = |level| fast::render_at(level, &setup, map.as_ref(), plan, true);
            Ok(fast::levels().into_iter().map(draw).collect())
        }
    }
    FixedWorld::of(scene, plan)?.run_fast(Levels(scene, plan))
}

/// Draws with the processor in a scene's fixed-point world.
pub fn drawn(scene: &Scene, plan: &Plan) -> Result<Frame, SetupError> {
    struct One<'a>(&'a Scene, &'a Plan);
    impl InFixedWorld for One<'_> {
        type Output = Result<Frame, SetupError>;
        fn run<W: Complete>(self, world: W) -> Self::Output {
            processor(world, self.0, self.1)
        }
    }
    FixedWorld::of(scene, plan)?.run(One(scene, plan))
}

/// Whether a set-up error says that the eye is under the ground.
pub fn is_under_ground(error: &SetupError) -> bool {
    matches!(error, SetupError::Plan(PlanError::EyeUnderGround { .. }))
}

/// Pixels of an outcome.
pub fn count(frame: &Frame, hit: Hit) -> usize {
    frame.hit.iter().filter(|h| **h == hit).count()
}

/// The first pixel at which two frames differ in any buffer but `trials`, floats compared bit by
/// bit; `None` where they are equal.
pub fn difference(a: &Frame, b: &Frame) -> Option<String> {
    if (a.columns, a.lines) != (b.columns, b.lines) {
        return Some(format!("{}x{} against {}x{}", a.columns, a.lines, b.columns, b.lines));
    }
    let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    let (p, q) = (a.buffers.as_ref()?, b.buffers.as_ref()?);
    let vectors = |normal: &[[f64; 3]]| normal.iter().map(|n| n.map(f64::to_bits)).collect();
    let (n, m): (Vec<[u64; 3]>, Vec<[u64; 3]>) = (vectors(&p.normal), vectors(&q.normal));
    let float = |name, p: &[f64], q: &[f64]| {
        let at = first(name, &bits(p), &bits(q), a.columns)?;
        Some(format!("{at} (as bits of f64)"))
    };
    first("hit", &a.hit, &b.hit, a.columns)
        .or_else(|| first("steps", &p.steps, &q.steps, a.columns))
        .or_else(|| float("ground_x", &p.ground_x, &q.ground_x))
        .or_else(|| float("ground_z", &p.ground_z, &q.ground_z))
        .or_else(|| float("height", &p.height, &q.height))
        .or_else(|| float("lambda", &p.lambda, &q.lambda))
        .or_else(|| first("normal", &n, &m, a.columns))
        .or_else(|| first("color", &a.color, &b.color, a.columns))
}

fn first<T: PartialEq + Debug>(name: &str, a: &[T], b: &[T], columns: usize) -> Option<String> {
    if a.len() != b.len() {
        return Some(format!("{name}: {} values against {}", a.len(), b.len()));
    }
    let at = a.iter().zip(b).position(|(a, b)| a != b)?;
    let differ = a.iter().zip(b).filter(|(a, b)| a != b).count();
    Some(format!(
        "{name} at column {}, line {}: {:?} against {:?}; {differ} of {} pixels differ",
        at % columns,
        at / columns,
        a[at],
        b[at],
        a.len()
    ))
}

/// Fails where two frames differ.
#[track_caller]
pub fn assert_same(what: &str, a: &Frame, b: &Frame) {
    assert!(a.buffers.is_some() && b.buffers.is_some(), "{what}: both have buffers");
    if let Some(difference) = difference(a, b) {
        panic!("{what}: {difference}");
    }
}

/// Height of the surface under the eye of a scene with a terrain, by the oracle.
pub fn ground_under(scene: &Scene, x: f64, z: f64) -> Option<f64> {
    Oracle::new(scene, &scene.screens[0]).surface_height(x, z)
}

/// A frame of the real world, with buffers.
pub fn draw_in_real(scene: &Scene, plan: &Plan) -> Result<Frame, SetupError> {
    let memory = Memory::new(&Real, scene, plan)?;
    draw_real(scene, plan, memory.as_ref(), true)
}
