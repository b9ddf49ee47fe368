//! The fixed-point world of a scene, by its plan's choice.

use crate::plan::units::units;
use crate::plan::{Plan, UnitPlan, WordClass, formats};
use crate::scene::Scene;
use crate::setup::SetupError;
use crate::word::stock::{Narrow, Wide};
use crate::word::sweep::Sweep;
use crate::word::{Fixed, Register, World as _};

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

    /// All units of a plan, in this world's formats.
    pub fn units(&self, plan: &Plan) -> Vec<UnitPlan> {
        match self {
            Self::Narrow(world) => units(plan, world),
            Self::Wide(world) => units(plan, world),
            Self::Sweep(world) => units(plan, world),
        }
    }

    /// Format of a register.
    pub fn fixed(&self, register: Register) -> Option<Fixed> {
        match self {
            Self::Narrow(world) => world.fixed(register),
            Self::Wide(world) => world.fixed(register),
            Self::Sweep(world) => world.fixed(register),
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
