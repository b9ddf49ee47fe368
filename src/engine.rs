//! The engines by name, and the number worlds by a plan's choice.

use crate::fast::enter::Enterable;
use crate::frame::Frame;
use crate::oracle::Oracle;
use crate::plan::Plan;
use crate::processor::{self, Processor};
use crate::readout::FrameBuilder;
use crate::scene::Scene;
use crate::setup::{Memory, Setup, SetupError, formats};
use crate::unit::Line;
use crate::word::real::Real;
use crate::word::stock::{Narrow, Wide};
use crate::word::sweep::Sweep;
use crate::word::{Complete, Register};

/// Who draws the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Engine {
    /// Line by line, units in their order.
    Processor,
    /// Threads, direct entry, vectorised loops; the same frame.
    Fast,
    /// The processor's units in f64.
    Real,
    /// Closed form in f64.
    Oracle,
}

impl Engine {
    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Processor => "processor",
            Self::Fast => "fast",
            Self::Real => "real",
            Self::Oracle => "oracle",
        }
    }
}

/// The fixed-point world of a scene.
#[derive(Clone, Copy, Debug)]
pub enum FixedWorld {
    /// 32-bit stock words.
    Narrow(Narrow),
    /// 64-bit stock words.
    Wide(Wide),
    /// Formats of the scene's own.
    Sweep(Sweep),
}

/// Work that is generic over the fixed-point world.
pub trait InFixedWorld {
    /// Result.
    type Output;
    /// Does the work in a world.
    fn run<W: Complete>(self, world: W) -> Self::Output;
}

/// Work that the fast engine has a part in.
pub trait InFastWorld {
    /// Result.
    type Output;
    /// Does the work in a world.
    fn run<W: Enterable>(self, world: W) -> Self::Output;
}

impl FixedWorld {
    /// The world that a plan and the scene's `[format]` ask for.
    ///
    /// # Errors
    /// If `[format]` names a register that does not exist or cannot have its format.
    pub fn of(scene: &Scene, plan: &Plan) -> Result<Self, SetupError> {
        Ok(if !scene.formats.is_empty() {
            Self::Sweep(formats::sweep(scene, plan)?)
        } else if plan.words() == crate::plan::WordClass::NARROW {
            Self::Narrow(Narrow)
        } else {
            Self::Wide(Wide)
        })
    }

    /// Runs generic work in this world.
    pub fn run<J: InFixedWorld>(&self, work: J) -> J::Output {
        match self {
            Self::Narrow(world) => work.run(*world),
            Self::Wide(world) => work.run(*world),
            Self::Sweep(world) => work.run(*world),
        }
    }

    /// Runs work that the fast engine has a part in.
    pub fn run_fast<J: InFastWorld>(&self, work: J) -> J::Output {
        match self {
            Self::Narrow(world) => work.run(*world),
            Self::Wide(world) => work.run(*world),
            Self::Sweep(world) => work.run(*world),
        }
    }

    /// Name for reports: of the stock word size, or `sweep`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Narrow(_) => "stock narrow",
            Self::Wide(_) => "stock wide",
            Self::Sweep(_) => "sweep",
        }
    }

    /// Whether registers may overflow: in stock worlds the plan has proved that none does.
    pub fn can_overflow(&self) -> bool {
        matches!(self, Self::Sweep(_))
    }

    /// Whether the recurrences may be entered anywhere: the fast engine draws such worlds only.
    pub fn wraps(&self) -> bool {
        match self {
            Self::Narrow(_) | Self::Wide(_) => true,
            Self::Sweep(world) => world.wraps(),
        }
    }
}

/// Draws a frame with the line-by-line processor and shows every finished line to `look`.
pub fn draw_by_lines<W: Complete>(
    setup: &Setup<W>,
    plan: &Plan,
    buffers: bool,
    mut look: impl FnMut(&Line<W>),
) -> Frame {
    let mut frame = FrameBuilder::new(plan, setup.lines as usize, buffers, true);
    let mut line = Processor::new(setup).wires();
    processor::run_lines(setup, &mut line, 0..setup.lines, |line| {
        frame.push(line);
        look(line);
    });
    frame.finish()
}

/// Draws a frame with the real engine, from its memories.
///
/// # Errors
/// If the scene cannot be set up.
pub fn draw_real(
    scene: &Scene,
    plan: &Plan,
    memory: Option<&Memory<Real>>,
    buffers: bool,
) -> Result<Frame, SetupError> {
    let setup = Setup::new(Real, scene, plan, memory)?;
    Ok(draw_by_lines(&setup, plan, buffers, |_| {}))
}

/// Draws a frame with the oracle.
pub fn draw_oracle(scene: &Scene, plan: &Plan) -> Frame {
    oracle(scene, plan).frame()
}

/// The oracle of a plan's screen. On maps without end it follows rays as far as a position
/// register reaches; the machine's walk may end before that, as `Far`.
pub fn oracle(scene: &Scene, plan: &Plan) -> Oracle {
    let oracle = Oracle::new(scene, &plan.screen);
    match &plan.ground {
        crate::plan::Ground::Terrain(walk) => oracle.with_reach_cells(walk.extreme),
        crate::plan::Ground::Plane(_) => oracle,
    }
}

/// Overflows of a sweep, counted and located at the wires.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Overflows {
    /// Register, pixels whose wire carries an overflow, the first of them as (line, column).
    pub registers: Vec<(Register, u64, (u32, u32))>,
}

impl Overflows {
    /// Looks at the wires of a finished line.
    pub fn inspect<W: Complete>(&mut self, line: &Line<W>) {
        for (register, count, first) in line.overflows() {
            match self.registers.iter_mut().find(|(known, ..)| *known == register) {
                Some((_, total, known)) => {
                    *total += count;
                    *known = (*known).min((line.number, first));
                }
                None => self.registers.push((register, count, (line.number, first))),
            }
        }
    }
}
