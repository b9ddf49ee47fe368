//! The kinds of planned surfaces.

use super::geometry::Geometry;
use super::plane::PlanePlan;
use super::planned::{Planned, Projection};
use super::terrain::TerrainPlan;
use super::word_class::WordClass;
use crate::scene::{Scene, Surface};

/// A planned surface, by its kind.
#[derive(Clone, Debug)]
pub enum SurfacePlan {
    /// A height map, walked over by rays.
    Terrain(Box<TerrainPlan>),
    /// A plane, met by one ratio.
    Plane(PlanePlan),
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
