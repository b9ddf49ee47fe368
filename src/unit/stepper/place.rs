//! Places on a ray, and steps along it.

use super::super::interpolator;
use super::super::surface_unit::SurfaceUnit;
use crate::word::{Register, Site, Word, World};

/// A place on the ray, or a step along it.
#[derive(Clone, Copy, Debug)]
pub struct Place<W: World> {
    /// x in cells.
    pub x: W::Ground,
    /// y in height units.
    pub y: W::Height,
    /// z in cells.
    pub z: W::Ground,
}

impl<W: World> Place<W> {
    /// The place a step further.
    #[inline(always)]
    #[must_use]
    pub fn plus(self, step: Self) -> Self {
        Self { x: self.x + step.x, y: self.y + step.y, z: self.z + step.z }
    }

    /// The place a step before.
    #[inline(always)]
    #[must_use]
    pub fn minus(self, step: Self) -> Self {
        Self { x: self.x - step.x, y: self.y - step.y, z: self.z - step.z }
    }

    /// Indices of the cell that it lies in.
    #[inline(always)]
    pub fn cell(self, site: Site) -> [i32; 2] {
        interpolator::cell::<W>(self.x, self.z, site)
    }

    /// Whether it is under the surface, where that exists: a hit is strictly below.
    #[inline(always)]
    pub fn is_under(self, surface: &impl SurfaceUnit<W>, site: Site) -> bool {
        let height = surface.height(self.x, self.z, site);
        self.y.is_below(height, site.at(Register::Surface))
    }

    /// A step halved this many times.
    #[inline(always)]
    #[must_use]
    pub fn halved(self, times: u32) -> Self {
        Self {
            x: self.x.shift_floor(times),
            y: self.y.shift_floor(times),
            z: self.z.shift_floor(times),
        }
    }

    /// A step doubled this many times.
    #[inline(always)]
    #[must_use]
    pub fn doubled(self, times: u32) -> Self {
        Self {
            x: self.x.shift_left(times),
            y: self.y.shift_left(times),
            z: self.z.shift_left(times),
        }
    }
}
