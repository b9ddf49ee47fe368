//! A planned surface: what the rest of the program asks of it, whatever its kind.

use super::fitted::UnitFit;
use super::formats::Formats;
use super::geometry::{Geometry, LinearScalar, LinearVector};
use super::plane::PlanePlan;
use super::proof::{Proof, Refusal};
use super::terrain::TerrainPlan;
use super::words::WordClass;
use crate::scene::{Scene, Surface};

/// A planned surface, by its kind.
#[derive(Clone, Debug)]
pub enum SurfacePlan {
    /// A height map, walked over by rays.
    Terrain(Box<TerrainPlan>),
    /// A plane, met by one ratio.
    Plane(PlanePlan),
}

/// The lines of sight as a surface's registers take them, and the plane of its ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// V along the axes of the registers, in their units.
    pub view: LinearVector,
    /// `G = n·V` (equation 8; thesis 2.15).
    pub g: LinearScalar,
    /// `F = d − n·r_h`, in the units of G.
    pub f: f64,
    /// The eye along the axes of the ratio, in their units.
    pub eye: [f64; 2],
    /// Quotients lie within ±2^range of these units.
    pub range: u32,
    /// Whether the ratio is taken: the divider is fitted.
    pub divides: bool,
    /// Whether rays are stepped, which takes the third component of V.
    pub steps: bool,
}

/// What a kind of surface answers.
pub(super) trait Planned {
    /// What the machine counts in and no format can mend.
    fn check_counters(&self) -> Result<(), Refusal>;

    /// Ranges and roundings in registers of these formats.
    fn proof(&self, geometry: &Geometry, formats: &Formats<'_>) -> Proof;

    /// Its projection.
    fn projection(&self, geometry: &Geometry) -> Projection;

    /// Its units in the order of the data flow, with those that it does without: idle in a full
    /// machine.
    fn units(&self, geometry: &Geometry, full: bool) -> Vec<UnitFit>;
}

impl SurfacePlan {
    /// Plans a surface in words of a size, proved or not; with everything fitted if `full`.
    pub(super) fn new(
        surface: &Surface,
        scene: &Scene,
        geometry: &Geometry,
        words: WordClass,
        full: bool,
    ) -> Self {
        match surface {
            Surface::Terrain(terrain) => {
                Self::Terrain(Box::new(TerrainPlan::new(terrain, scene, geometry, words, full)))
            }
            Surface::Plane(plane) => Self::Plane(PlanePlan::new(plane, geometry, words)),
        }
    }

    pub(super) fn planned(&self) -> &dyn Planned {
        match self {
            Self::Terrain(terrain) => &**terrain,
            Self::Plane(plane) => plane,
        }
    }

    /// The lines of sight as its registers take them.
    pub fn projection(&self, geometry: &Geometry) -> Projection {
        self.planned().projection(geometry)
    }

    /// The walk over a height map, of a surface that is one.
    pub fn terrain(&self) -> Option<&TerrainPlan> {
        if let Self::Terrain(terrain) = self { Some(terrain) } else { None }
    }
}
