//! Set-up: the one door from `f64` to words. Coefficients are computed in `f64` once per frame and
//! quantised into the registers of the units that the plan fits.

pub mod coefficients;
pub mod kernel;
pub mod memory;
mod plane;
mod surface;
pub mod table;
mod terrain;

use crate::plan::{Plan, PlanError};
use crate::scene::Scene;
use crate::unit::Unit;
use crate::unit::coefficient::{Bank, Coefficient};
use crate::word::{Complete, Register, World};

pub use memory::Memory;
pub use surface::{Back, SurfaceUnits};
pub use terrain::TerrainUnits;

/// Why registers cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// A plan that does not hold.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// Registers that the fast engine cannot draw.
    #[error(
        "format: saturating registers cannot be entered at any step, as the fast engine does; draw \
         them with --engine processor"
    )]
    Saturating,
    /// A value outside its register.
    #[error(
        "format: {value} does not fit register {register}; widen it or leave its format to the plan"
    )]
    Register {
        /// The register that cannot hold it.
        register: Register,
        /// The value that does not fit, in the register's unit.
        value: f64,
    },
}

/// All registers of a machine, loaded.
#[derive(Clone, Debug)]
pub struct Setup<W: World> {
    /// The number world whose words the coefficients are.
    pub world: W,
    /// Pixels across.
    pub columns: u32,
    /// Scan lines.
    pub lines: u32,
    /// The units of each surface of the scene.
    pub surfaces: Vec<SurfaceUnits<W>>,
    /// Cycles from an address to the memory's answer.
    pub memory_latency: u32,
}

impl<W: Complete> Setup<W> {
    /// Loads the registers of one frame. There is a memory for each surface; none where it has no map.
    ///
    /// # Errors
    /// If the eye is under the ground, or a value does not fit a register of a sweep.
    pub fn new(
        world: W,
        scene: &Scene,
        plan: &Plan,
        memories: &[Option<Memory<W>>],
    ) -> Result<Self, SetupError> {
        let units = |(at, memory)| SurfaceUnits::new(&world, scene, plan, at, memory);
        Ok(Self {
            world,
            columns: plan.geometry.columns,
            lines: plan.geometry.lines,
            surfaces: memories.iter().enumerate().map(units).collect::<Result<_, _>>()?,
            memory_latency: scene.machine.memory_latency,
        })
    }

    /// Puts in all coefficients: the screen's, the memory's, and those of every unit.
    pub fn coefficients(&self, bank: &mut Bank<W>) {
        bank.number(Coefficient::Columns, self.columns);
        bank.number(Coefficient::Lines, self.lines);
        bank.number(Coefficient::MemoryLatency, self.memory_latency);
        self.chain().iter().for_each(|unit| unit.coefficients(bank));
    }

    /// All units in the order of the data flow, surface after surface.
    pub fn chain(&self) -> Vec<&dyn Unit<W>> {
        self.surfaces.iter().flat_map(SurfaceUnits::chain).collect()
    }
}
