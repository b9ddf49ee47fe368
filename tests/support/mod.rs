//! Scenes built by hand, frames drawn from them, and frames compared bit by bit.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod formats;
pub mod keys;
pub mod recipe;

use std::sync::Arc;

use glam::{DVec2, DVec3};
use proptest::test_runner::{Config, RngSeed, TestRunner};
use terraline::engine::{Engine, Machine, Memories};
use terraline::frame::{BufferRow, Frame, Giver, Hit};
use terraline::oracle::Oracle;
use terraline::plan::{Plan, PlanError};
use terraline::scene::{
    Attitude, Camera, Colors, Encoding, HeightMap, KernelShape, NoData, Outside, Scene, Screen,
    Surface, Terrain, load,
};
use terraline::setup::SetupError;

/// Names of the built-in scenes with a height map.
pub const TERRAINS: [&str; 3] = ["overview", "flight", "valley"];
/// Names of all built-in scenes.
pub const SCENES: [&str; 4] = ["overview", "flight", "valley", "plane"];
/// All shapes of the finite function.
pub const SHAPES: [KernelShape; 4] =
    [KernelShape::Cosine, KernelShape::Parabola, KernelShape::Exponential, KernelShape::Hat];

/// A built-in scene with options.
pub fn loaded(name: &str, sets: &[&str]) -> Scene {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    load(Some(name), &sets).unwrap_or_else(|error| panic!("{error}"))
}

/// A built-in scene in another raster.
pub fn builtin(name: &str, columns: u32, lines: u32) -> Scene {
    let mut scene = loaded(name, &[]);
    for screen in &mut scene.screens {
        *screen = screen.resized(columns, lines);
    }
    scene
}

/// Ground of square cells of side one, samples as heights.
pub fn land(map: HeightMap) -> Terrain {
    Terrain {
        source: "hand".into(),
        map: Arc::new(map),
        encoding: Encoding::Stored,
        cell: DVec2::ONE,
        offset: 0.0,
        scale: 1.0,
        outside: Outside::Sky,
        nodata: NoData::Hole,
        base_depth: None,
    }
}

/// A scene over such ground, seen from above its middle.
pub fn over(map: HeightMap, columns: u32, lines: u32) -> Scene {
    let (width, depth) = ((map.columns() - 1) as f64, (map.rows() - 1) as f64);
    let highest = f64::from(map.range().1);
    let surface = Surface::Terrain(land(map));
    Scene {
        name: "hand".into(),
        unit_m: 1.0,
        camera: Camera {
            position: DVec3::new(width / 2.0, highest + 0.6 * width.max(depth), -depth / 4.0),
            attitude: Attitude::Directions {
                forward: DVec3::new(0.0, -1.0, 1.0),
                up: DVec3::new(0.0, 1.0, 0.0),
            },
            ..Camera::default()
        },
        screens: vec![Screen { columns, lines, ..Screen::default() }],
        color: Colors { far: [1, 2, 3], ..Colors::default() },
        ..Scene::of(surface)
    }
}

/// A map from a function of column and row.
pub fn map(columns: usize, rows: usize, height: impl Fn(usize, usize) -> f32) -> HeightMap {
    let samples = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    HeightMap::new(columns, rows, samples.map(|(i, j)| height(i, j)).collect())
}

/// The terrain of a scene that has one.
pub fn terrain(scene: &mut Scene) -> &mut Terrain {
    scene.terrain_mut().expect("a scene with a terrain")
}

/// All of a scene but the samples of its map, in every bit.
pub fn described(scene: &Scene) -> String {
    let mut scene = scene.clone();
    if let Some(terrain) = scene.terrain_mut() {
        terrain.map = Arc::new(HeightMap::new(1, 1, vec![0.0]));
    }
    format!("{:#?}", Scene { name: String::new(), ..scene })
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

/// The machine of a scene, in its fixed-point world.
pub fn machine<'a>(scene: &'a Scene, plan: &'a Plan) -> Result<Machine<'a>, SetupError> {
    Machine::new(scene, plan, &Memories::default())
}

/// Draws with both engines in a scene's fixed-point world: processor, fast.
pub fn both(scene: &Scene, plan: &Plan) -> Result<(Frame, Frame), SetupError> {
    let machine = machine(scene, plan)?;
    Ok((machine.frame(Engine::Processor, true)?, machine.frame(Engine::Fast, true)?))
}

/// Draws with the fast engine at every SIMD level that there is.
pub fn at_every_level(scene: &Scene, plan: &Plan) -> Result<Vec<Frame>, SetupError> {
    Ok(machine(scene, plan)?.frames_at_every_level(true))
}

/// Draws with the processor in a scene's fixed-point world.
pub fn drawn(scene: &Scene, plan: &Plan) -> Result<Frame, SetupError> {
    machine(scene, plan)?.frame(Engine::Processor, true)
}

/// Whether a set-up error says that the eye is under the ground.
pub fn is_under_ground(error: &SetupError) -> bool {
    matches!(error, SetupError::Plan(PlanError::EyeUnderGround { .. }))
}

/// Pixels of an outcome.
pub fn count(frame: &Frame, hit: Hit) -> usize {
    frame.hit.iter().filter(|h| **h == hit).count()
}

/// The first pixel at which two frames differ in any array that all engines give, bit by bit;
/// `None` where they are equal.
pub fn difference(a: &Frame, b: &Frame) -> Option<String> {
    if (a.columns, a.lines) != (b.columns, b.lines) {
        return Some(format!("{}x{} against {}x{}", a.columns, a.lines, b.columns, b.lines));
    }
    let of_all = |(row, _): &(&BufferRow, _)| row.giver == Giver::Engines;
    let (mut ours, mut theirs) = (a.arrays().filter(of_all), b.arrays().filter(of_all));
    loop {
        match (ours.next(), theirs.next()) {
            (None, None) => return None,
            (Some((row, p)), Some((other, q))) if row.name == other.name => {
                let pixel = row.components;
                if p.pieces(1 << 14).eq(q.pieces(1 << 14)) {
                    continue;
                }
                let pairs = p.pieces(pixel).zip(q.pieces(pixel)).enumerate();
                let differ: Vec<_> = pairs.filter(|(_, (p, q))| p != q).collect();
                let (at, (p, q)) = differ.first()?;
                return Some(format!(
                    "{} at column {}, line {}: bytes {p:02x?} against {q:02x?}; {} of {} pixels \
                     differ",
                    row.name,
                    at % a.columns,
                    at / a.columns,
                    differ.len(),
                    a.hit.len()
                ));
            }
            _ => return Some("one has arrays that the other lacks".into()),
        }
    }
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
    machine(scene, plan)?.frame(Engine::Real, true)
}
