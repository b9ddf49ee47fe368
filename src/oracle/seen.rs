//! What a ray sees of one surface, whatever its kind.

mod plane;
mod terrain;

use std::fmt::Debug;

use glam::DVec3;

use super::camera::Ray;
use super::shade;
use crate::frame::Hit;
use crate::scene::{Colors, Light};

/// What the colour of a pixel depends on besides its surface, and how far rays are followed.
#[derive(Clone, Debug)]
pub(crate) struct Look {
    pub(crate) light: Light,
    pub(crate) colors: Colors,
    pub(crate) reach_cells: f64,
    /// Larger pixel pitch times the screen's distance: the grain of a plane's contrast.
    pub(crate) grain: f64,
}

/// A surface as rays see it by itself, whatever its kind.
pub(crate) trait Seen: Debug + Send + Sync {
    /// What a ray sees of it, and whether the ray's points at other λ are on the sheet that it
    /// sees. NaN is on none.
    fn sight_beside(&self, ray: &Ray, look: &Look, others: [f64; 2]) -> (Sighting, [bool; 2]);

    /// What a ray sees of it.
    fn sight(&self, ray: &Ray, look: &Look) -> Sighting {
        self.sight_beside(ray, look, [f64::NAN; 2]).0
    }

    /// How often a ray crosses it strictly between two λ, in ascending order.
    fn crossings(&self, ray: &Ray, from: f64, to: f64) -> usize;

    /// Its height over (x, z), scene units, where it has one.
    fn height(&self, x: f64, z: f64) -> Option<f64>;

    /// Its unit normal over (x, z), where it has one.
    fn normal(&self, x: f64, z: f64) -> Option<DVec3>;
}

/// What a pixel sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting {
    /// What the pixel sees, or why nothing.
    pub hit: Hit,
    /// λ of `r_p = r_h + λ V`; NaN on a miss.
    pub lambda: f64,
    /// Ground point, scene units; y is the height of the surface at (x, z), which for a side of
    /// the map is its rim above the point seen. NaN on a miss.
    pub point: DVec3,
    /// Unit normal of the surface at (x, z); for a plane, the plane's own. NaN on a miss.
    pub normal: DVec3,
    /// sRGB bytes.
    pub color: [u8; 3],
    /// The surface that is seen, by its place in the scene; on a miss the one that says why.
    pub surface: usize,
    /// The ray comes closer to the surface somewhere up to its hit than rounding can tell: the
    /// outcome may rightly be another one.
    pub tangent: bool,
}

impl Sighting {
    /// Nothing of a surface, and why.
    fn miss(colors: &Colors, hit: Hit, tangent: bool) -> Self {
        Self {
            hit,
            lambda: f64::NAN,
            point: DVec3::NAN,
            normal: DVec3::NAN,
            color: shade::outcome_color(colors, hit).unwrap_or(colors.sky),
            surface: 0,
            tangent,
        }
    }

    /// Whether a pixel that may show either shows this one: the nearer surface, else what is out of
    /// range rather than sky.
    pub(super) fn is_before(&self, other: &Self) -> bool {
        let rank = |hit| match hit {
            Hit::Surface | Hit::Side => 0,
            Hit::OutOfRange => 1,
            Hit::Sky => 2,
        };
        match (rank(self.hit), rank(other.hit)) {
            (0, 0) => self.lambda < other.lambda,
            (own, its) => own < its,
        }
    }
}
