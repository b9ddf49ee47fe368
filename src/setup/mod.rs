//! Set-up: the one door from `f64` to words. Coefficients are computed in `f64` once per frame and
//! quantised into the registers of the units that the plan fits.

pub mod coefficients;
pub mod kernel;
pub mod memory;
pub mod table;

use crate::plan::ranges::TerrainPlan;
use crate::plan::{Plan, PlanError, SurfacePlan};
use crate::scene::{Scene, Surface};
use crate::unit::checker::Checker;
use crate::unit::coefficient::{Bank, Coefficient};
use crate::unit::divider::Divider;
use crate::unit::interpolator::Interpolator;
use crate::unit::projector::Projector;
use crate::unit::shader::Shader;
use crate::unit::stepper::Stepper;
use crate::unit::surface_unit::SurfaceUnit;
use crate::unit::{Idle, Unit, interpolator, stepper};
use crate::word::{
    Complete, Interpolating, Open, Readout, Register, Shading, Site, Word as _, World,
};

pub use memory::Memory;

/// Why registers cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// A plan that does not hold.
    #[error(transparent)]
    Plan(#[from] PlanError),
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

/// The units behind the divider.
#[derive(Clone, Debug)]
pub enum Back<W: World> {
    /// Stepper, interpolator, shader of a height map.
    Terrain(Box<TerrainUnits<W>>),
    /// Checker of a plane.
    Plane(Checker<W>),
}

/// The units that draw a height map.
#[derive(Clone, Debug)]
pub struct TerrainUnits<W: World> {
    /// Finds the first sample of a ray under the surface.
    pub stepper: Stepper<W>,
    /// Gives height and slopes at the hit.
    pub interpolator: Interpolator<W>,
    /// Light, ramp, mixer and pixel.
    pub shader: Shader<W>,
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
    /// Gives the view vectors by additions.
    pub projector: Projector<W>,
    /// Gives the place where rays meet a plane; absent where not fitted.
    pub divider: Option<Divider<W>>,
    /// The units behind the divider, by the kind of surface.
    pub back: Back<W>,
    /// Units of another kind of surface are fitted, and idle.
    pub idle: bool,
    /// Cycles from an address to the memory's answer.
    pub memory_latency: u32,
}

/// Units that a full machine has though a plane needs none of them.
const IDLE: [Idle; 2] = [
    Idle {
        description: &stepper::DESCRIPTION,
        timing: |latency| stepper::timing(1, false, latency),
    },
    Idle {
        description: &interpolator::DESCRIPTION,
        timing: |latency| interpolator::timing(1, latency),
    },
];

impl<W: Complete> Setup<W> {
    /// Loads the registers of one frame.
    ///
    /// # Errors
    /// If the eye is under the ground, or a value does not fit a register of a sweep.
    pub fn new(
        world: W,
        scene: &Scene,
        plan: &Plan,
        memory: Option<&Memory<W>>,
    ) -> Result<Self, SetupError> {
        let coefficients = coefficients::Coefficients::new(plan);
        let back = match (&scene.surface, &plan.surface, memory) {
            (Surface::Terrain(_), SurfacePlan::Terrain(walk), Some(memory)) => {
                let interpolator = coefficients::interpolator(&world, plan, walk, memory)?;
                let surface = interpolator.clone();
                let stepper = coefficients::stepper(&world, scene, walk, memory, surface)?;
                refuse_eye_under_ground(walk, &stepper)?;
                let shader = coefficients::shader(&world, scene, plan, walk, memory)?;
                Back::Terrain(Box::new(TerrainUnits { stepper, interpolator, shader }))
            }
            (Surface::Plane(plane), SurfacePlan::Plane(planned), _) => Back::Plane(
                coefficients::checker(&world, scene, plan, plane, planned, &coefficients)?,
            ),
            _ => unreachable!("a plan is of its scene, and a height map has its memory"),
        };
        Ok(Self {
            world,
            columns: plan.geometry.columns,
            lines: plan.geometry.lines,
            projector: coefficients.projector(&world, plan)?,
            divider: coefficients.divider(&world, scene, plan)?,
            back,
            idle: plan.fitted.idle,
            memory_latency: scene.machine.memory_latency,
        })
    }
}

impl<W: Complete> Setup<W> {
    /// Puts in all coefficients: the screen's, the memory's, and those of every unit.
    pub fn coefficients(&self, bank: &mut Bank<W>) {
        bank.number(Coefficient::Columns, self.columns);
        bank.number(Coefficient::Lines, self.lines);
        bank.number(Coefficient::MemoryLatency, self.memory_latency);
        self.chain().iter().for_each(|unit| unit.coefficients(bank));
    }

    /// All units in the order of the data flow.
    pub fn chain(&self) -> Vec<&dyn Unit<W>> {
        let mut units: Vec<&dyn Unit<W>> = vec![&self.projector];
        units.extend(self.divider.iter().map(|divider| divider as &dyn Unit<W>));
        units.extend(self.back.units(self.idle));
        units
    }
}

impl<W: Interpolating + Shading> TerrainUnits<W> {
    /// The units in the order of the data flow.
    pub fn units(&self) -> Vec<&dyn Unit<W>> {
        let mut units: Vec<&dyn Unit<W>> = vec![&self.stepper, &self.interpolator];
        units.extend(self.shader.units());
        units
    }
}

impl<W: Interpolating + Shading> Back<W> {
    /// The units behind the divider, with those that are idle.
    pub fn units(&self, idle: bool) -> Vec<&dyn Unit<W>> {
        match self {
            Self::Terrain(units) => units.units(),
            Self::Plane(checker) => {
                let idle = if idle { &IDLE[..] } else { &[] };
                idle.iter().map(|unit| unit as &dyn Unit<W>).chain([checker as _]).collect()
            }
        }
    }
}

fn refuse_eye_under_ground<W: Interpolating + Open>(
    walk: &TerrainPlan,
    stepper: &Stepper<W>,
) -> Result<(), PlanError> {
    let (eye, surface) = (stepper.eye(), &stepper.surface);
    let nowhere = Site::pixel(0, 0);
    if !surface.contains(eye.x, eye.z, nowhere) {
        return Ok(());
    }
    let ground = surface.height(eye.x, eye.z, nowhere);
    if eye.y.is_below(ground, nowhere.at(Register::Surface)) {
        return Err(PlanError::EyeUnderGround {
            eye: walk.scale.to_scene(eye.y.value()),
            ground: walk.scale.to_scene(ground.value()),
        });
    }
    Ok(())
}
