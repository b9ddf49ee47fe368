//! Set-up: the one door from `f64` to words. Coefficients are computed in `f64` once per frame and
//! quantised into the registers of the units that the plan fits.

pub mod coefficients;
pub mod formats;
pub mod kernel;
pub mod memory;
pub mod table;

use crate::plan::ranges::WalkPlan;
use crate::plan::{Ground, Plan, PlanError};
use crate::scene::{Scene, Surface};
use crate::unit::checker::Checker;
use crate::unit::divider::Divider;
use crate::unit::interpolator::Interpolator;
use crate::unit::line::Line;
use crate::unit::projector::Projector;
use crate::unit::shader::Shader;
use crate::unit::stepper::{Stepper, SurfaceUnit};
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
        /// The register.
        register: Register,
        /// The value.
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
    /// Ray stepper.
    pub stepper: Stepper<W>,
    /// Interpolator.
    pub interpolator: Interpolator<W>,
    /// Shader.
    pub shader: Shader<W>,
}

/// All registers of a machine, loaded.
#[derive(Clone, Debug)]
pub struct Setup<W: World> {
    /// The number world.
    pub world: W,
    /// Pixels across.
    pub columns: u32,
    /// Scan lines.
    pub lines: u32,
    /// Projector.
    pub projector: Projector<W>,
    /// Divider, where fitted.
    pub divider: Option<Divider<W>>,
    /// What follows.
    pub back: Back<W>,
}

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
        let back = match (&scene.surface, &plan.ground, memory) {
            (Surface::Terrain(_), Ground::Terrain(walk), Some(memory)) => {
                let stepper = coefficients::stepper(&world, scene, walk, memory)?;
                let interpolator = coefficients::interpolator(&world, plan, walk, memory)?;
                refuse_eye_under_ground(walk, &stepper, &interpolator)?;
                let shader = coefficients::shader(&world, scene, plan, walk, memory)?;
                Back::Terrain(Box::new(TerrainUnits { stepper, interpolator, shader }))
            }
            (Surface::Plane(plane), Ground::Plane(planned), _) => Back::Plane(
                coefficients::checker(&world, scene, plan, plane, planned, &coefficients)?,
            ),
            _ => unreachable!("a plan is of its scene, and a height map has its memory"),
        };
        Ok(Self {
            world,
            columns: plan.geometry.columns,
            lines: plan.geometry.lines,
            projector: coefficients.projector(&world, plan)?,
            divider: coefficients.divider(&world, plan)?,
            back,
        })
    }
}

impl<W: Interpolating + Shading> TerrainUnits<W> {
    /// Runs the units behind the stepper on a line.
    pub fn shade(&self, line: &mut Line<W>) {
        self.interpolator.run(line);
        self.shader.run(line);
    }
}

impl<W: Interpolating + Shading> Setup<W> {
    /// Runs the units behind the divider on a line.
    pub fn run_back(&self, line: &mut Line<W>) {
        match &self.back {
            Back::Terrain(units) => {
                units.stepper.run(line, &units.interpolator);
                units.shade(line);
            }
            Back::Plane(checker) => checker.run(line),
        }
    }
}

fn refuse_eye_under_ground<W: Interpolating + Open>(
    walk: &WalkPlan,
    stepper: &Stepper<W>,
    interpolator: &Interpolator<W>,
) -> Result<(), PlanError> {
    let eye = stepper.eye();
    let nowhere = Site::pixel(0, 0);
    if !interpolator.contains(eye.x, eye.z, nowhere) {
        return Ok(());
    }
    let ground = interpolator.height(eye.x, eye.z, nowhere);
    if eye.y.is_below(ground, nowhere.at(Register::Surface)) {
        return Err(PlanError::EyeUnderGround {
            eye: walk.scale.to_scene(eye.y.value()),
            ground: walk.scale.to_scene(ground.value()),
        });
    }
    Ok(())
}
