//! A scene's machine, set up.

use std::sync::OnceLock;
use std::time::Instant;

use super::list::Engine;
use super::memories::{Memories, Ready, SetUpTime};
use super::world::FixedWorld;
use crate::oracle::Oracle;
use crate::plan::{Plan, SurfacePlan};
use crate::scene::Scene;
use crate::setup::{Setup, SetupError};
use crate::word::Complete;
use crate::word::real::Real;
use crate::word::stock::{Narrow, Wide};
use crate::word::sweep::Sweep;

/// A planned scene, set up in its fixed-point world; the same units in f64 and the oracle are set
/// up when they are first asked for.
pub struct Machine<'a> {
    pub(super) scene: &'a Scene,
    pub(super) plan: &'a Plan,
    world: FixedWorld,
    memories: Memories,
    pub(super) fixed: Fixed,
    real: OnceLock<Ready<Real>>,
    oracle: OnceLock<(Oracle, SetUpTime)>,
}

/// The set-up in its world.
pub(super) enum Fixed {
    Narrow(Ready<Narrow>),
    Wide(Ready<Wide>),
    Sweep(Box<Ready<Sweep>>),
}

/// The same code for each world that a set-up may be in.
macro_rules! in_fixed {
    ($fixed:expr, $ready:ident => $work:expr) => {
        match $fixed {
            $crate::engine::machine::Fixed::Narrow($ready) => $work,
            $crate::engine::machine::Fixed::Wide($ready) => $work,
            $crate::engine::machine::Fixed::Sweep($ready) => $work,
        }
    };
}
pub(super) use in_fixed;

/// Work that is generic over the fixed-point world, on a machine's set-up in it.
pub trait WithSetup {
    /// Result.
    type Output;
    /// Does the work.
    fn run<W: Complete>(self, setup: &Setup<W>) -> Self::Output;
}

impl<'a> Machine<'a> {
    /// Sets up a scene in the fixed-point world of its plan.
    ///
    /// # Errors
    /// If the eye is under the ground, a register of `[format]` does not exist or cannot have its
    /// format, or a value does not fit it.
    pub fn new(scene: &'a Scene, plan: &'a Plan, memories: &Memories) -> Result<Self, SetupError> {
        Self::in_world(FixedWorld::of(scene, plan)?, scene, plan, memories)
    }

    /// Sets up a scene in a fixed-point world that may be another than that of its plan.
    ///
    /// # Errors
    /// As [`Machine::new`].
    pub fn in_world(
        world: FixedWorld,
        scene: &'a Scene,
        plan: &'a Plan,
        memories: &Memories,
    ) -> Result<Self, SetupError> {
        let fixed = match world {
            FixedWorld::Narrow(world) => Fixed::Narrow(memories.load(world, scene, plan)?),
            FixedWorld::Wide(world) => Fixed::Wide(memories.load(world, scene, plan)?),
            FixedWorld::Sweep(world) => Fixed::Sweep(Box::new(memories.load(world, scene, plan)?)),
        };
        let (memories, real, oracle) = (memories.clone(), OnceLock::new(), OnceLock::new());
        Ok(Self { scene, plan, world, memories, fixed, real, oracle })
    }

    /// The scene that it draws.
    #[must_use]
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// The plan that it was set up by.
    #[must_use]
    pub fn plan(&self) -> &'a Plan {
        self.plan
    }

    /// The fixed-point world that it is set up in.
    #[must_use]
    pub fn world(&self) -> FixedWorld {
        self.world
    }

    /// Runs generic work on the set-up in the fixed-point world.
    pub fn run<J: WithSetup>(&self, work: J) -> J::Output {
        in_fixed!(&self.fixed, ready => work.run(&ready.setup))
    }

    /// The same units in f64.
    ///
    /// # Errors
    /// If the eye is under the ground there.
    pub fn real(&self) -> Result<&Setup<Real>, SetupError> {
        Ok(&self.ready_real()?.setup)
    }

    fn ready_real(&self) -> Result<&Ready<Real>, SetupError> {
        if let Some(real) = self.real.get() {
            return Ok(real);
        }
        let real = self.memories.load(Real, self.scene, self.plan)?;
        Ok(self.real.get_or_init(|| real))
    }

    /// The oracle of the plan's screen. On maps without end it follows rays as far as a position
    /// register reaches; the machine's walk may end before that, as out of range.
    #[must_use]
    pub fn oracle(&self) -> &Oracle {
        &self.timed_oracle().0
    }

    fn timed_oracle(&self) -> &(Oracle, SetUpTime) {
        self.oracle.get_or_init(|| {
            let start = Instant::now();
            let mut oracle = Oracle::new(self.scene, &self.plan.screen);
            if let Some(walk) = self.plan.surfaces.iter().find_map(SurfacePlan::terrain) {
                oracle = oracle.with_reach_cells(walk.extreme);
            }
            (oracle, SetUpTime { coefficients: start.elapsed(), ..SetUpTime::default() })
        })
    }

    /// How long an engine took to set up, which is done now if nobody has asked for it before.
    ///
    /// # Errors
    /// If it cannot be set up.
    pub fn set_up_time(&self, engine: Engine) -> Result<SetUpTime, SetupError> {
        Ok(match engine {
            Engine::Processor => in_fixed!(&self.fixed, ready => ready.time()),
            Engine::Fast => {
                in_fixed!(&self.fixed, ready => ready.fast_time(self.scene, self.plan))
            }
            Engine::Real => self.ready_real()?.time(),
            Engine::Oracle => self.timed_oracle().1,
        })
    }
}
