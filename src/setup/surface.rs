//! The units of one surface, loaded, from its projector to its colour.

use super::coefficients::Coefficients;
use super::terrain::TerrainUnits;
use super::{Memory, SetupError, plane};
use crate::plan::{Plan, SurfacePlan};
use crate::scene::Scene;
use crate::unit::checker::Checker;
use crate::unit::depth::Depth;
use crate::unit::divider::Divider;
use crate::unit::projector::Projector;
use crate::unit::{Idle, Unit, interpolator, stepper};
use crate::word::{Complete, Interpolating, Shading, World};

/// The units of one surface.
#[derive(Clone, Debug)]
pub struct SurfaceUnits<W: World> {
    /// Gives the view vectors by additions.
    pub projector: Projector<W>,
    /// Gives the place where rays meet a plane; absent where not fitted.
    pub divider: Option<Divider<W>>,
    /// The units behind the divider, by the kind of surface.
    pub back: Back<W>,
    /// Units of another kind of surface that a full machine has before the last ones.
    idle: &'static [Idle],
    /// The register by which it competes with other surfaces.
    pub depth: Option<Depth>,
}

/// The units behind the divider.
#[derive(Clone, Debug)]
pub enum Back<W: World> {
    /// Stepper, interpolator, shader of a height map.
    Terrain(Box<TerrainUnits<W>>),
    /// Checker of a plane.
    Plane(Checker<W>),
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

/// The depth register of the surface with this index; a single surface needs none.
fn depth(plan: &Plan, at: usize) -> Option<Depth> {
    if plan.surfaces.len() < 2 {
        return None;
    }
    // 1/λ is the denominator without its scale; the register holds the greatest of all surfaces. One
    // that is seen edge-on has no denominator and no scale.
    let scale = |surface: &SurfacePlan| {
        let coefficients = Coefficients::new(surface, &plan.geometry);
        (coefficients.projection.f != 0.0).then_some(coefficients.denominator_exponent)
    };
    let coarsest = plan.surfaces.iter().filter_map(scale).min();
    let own = scale(&plan.surfaces[at]);
    let shift = own.zip(coarsest).map_or(0, |(own, coarsest)| own.abs_diff(coarsest));
    Some(Depth { surface: at as u32, last: at + 1 == plan.surfaces.len(), shift })
}

impl<W: Complete> SurfaceUnits<W> {
    /// Loads the units of the surface with this index.
    pub(super) fn new(
        world: &W,
        scene: &Scene,
        plan: &Plan,
        at: usize,
        memory: &Option<Memory<W>>,
    ) -> Result<Self, SetupError> {
        let surface = &plan.surfaces[at];
        let coefficients = Coefficients::new(surface, &plan.geometry);
        let (back, idle) = match (surface, memory) {
            (SurfacePlan::Terrain(walk), Some(memory)) => {
                let units = TerrainUnits::new(world, scene, plan, walk, memory)?;
                (Back::Terrain(Box::new(units)), &[][..])
            }
            (SurfacePlan::Plane(plane), _) => {
                let checker = plane::checker(world, scene, plan, plane, &coefficients)?;
                (Back::Plane(checker), if plan.full { &IDLE[..] } else { &[] })
            }
            (SurfacePlan::Terrain(_), None) => unreachable!("a height map has its memory"),
        };
        let steps = coefficients.projection.steps || !idle.is_empty();
        Ok(Self {
            projector: coefficients.projector(world, at, steps)?,
            divider: coefficients.divider(world, scene)?,
            back,
            idle,
            depth: depth(plan, at),
        })
    }

    /// The units in the order of the data flow.
    pub fn chain(&self) -> Vec<&dyn Unit<W>> {
        let mut units: Vec<&dyn Unit<W>> = vec![&self.projector];
        units.extend(self.divider.iter().map(|divider| divider as &dyn Unit<W>));
        units.extend(self.idle.iter().map(|unit| unit as &dyn Unit<W>));
        units.extend(self.back.units());
        units.extend(self.depth.iter().map(|depth| depth as &dyn Unit<W>));
        units
    }

    /// Whether it has units of another kind of surface, idle.
    pub fn has_idle_units(&self) -> bool {
        !self.idle.is_empty()
    }
}

impl<W: Interpolating + Shading> Back<W> {
    /// The units in the order of the data flow.
    pub fn units(&self) -> Vec<&dyn Unit<W>> {
        match self {
            Self::Terrain(units) => units.units(),
            Self::Plane(checker) => vec![checker],
        }
    }

    /// The units of a height map, if they are.
    pub fn terrain(&self) -> Option<&TerrainUnits<W>> {
        if let Self::Terrain(units) = self { Some(units) } else { None }
    }
}
