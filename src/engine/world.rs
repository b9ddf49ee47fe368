//! The fixed-point world of a scene, by its plan's choice.

use crate::plan::{Plan, WordClass, formats};
use crate::scene::Scene;
use crate::setup::SetupError;
use crate::word::Complete;
use crate::word::stock::{Narrow, Wide};
use crate::word::sweep::Sweep;

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

impl FixedWorld {
    /// The world that a plan and the scene's `[format]` ask for.
    ///
    /// # Errors
    /// If `[format]` gives a register a format that it cannot have.
    pub fn of(scene: &Scene, plan: &Plan) -> Result<Self, SetupError> {
        Ok(if !scene.formats.is_empty() {
            Self::Sweep(formats::sweep(scene, plan)?)
        } else if plan.words == WordClass::NARROW {
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
