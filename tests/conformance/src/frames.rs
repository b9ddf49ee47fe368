//! Frames drawn and compared, bit by bit.

use proptest::test_runner::{Config, RngSeed, TestRunner};
use terraline::engine::{Engine, Machine, Memories};
use terraline::frame::{BufferRow, Frame, Giver, Hit};
use terraline::plan::{Plan, PlanError};
use terraline::scene::Scene;
use terraline::setup::SetupError;

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

/// A frame of the real world, with buffers.
pub fn draw_in_real(scene: &Scene, plan: &Plan) -> Result<Frame, SetupError> {
    machine(scene, plan)?.frame(Engine::Real, true)
}
