//! What packets need to know of the map and the machine.

use fearless_simd::prelude::*;
use fearless_simd::{i32x16, mask32x16, u32x16};

use super::map::Map;
use super::maxima::NOTHING;
use crate::unit::interpolator::Interpolator;
use crate::unit::stepper::Stepper;
use crate::word::World;

/// The map, and the units whose work packets do.
pub struct Land<'a, W: World, S> {
    /// SIMD level of this computer.
    pub simd: S,
    /// The machine's stepper: coefficients of the walk.
    pub stepper: &'a Stepper<W>,
    /// The machine's interpolator: form and formats of the surface.
    pub surface: &'a Interpolator<W>,
    /// The copy of the map that packets read.
    pub map: &'a Map<W>,
}

impl<W: World, S: Simd> Land<'_, W, S> {
    /// Where there is a surface in cell (i, j).
    #[inline(always)]
    pub fn inside(&self, i: i32x16<S>, j: i32x16<S>) -> mask32x16<S> {
        let finest = u32x16::simd_from(self.simd, 0);
        let maxima = &self.map.maxima;
        let (addresses, held) = maxima.addresses(finest, i, j);
        if self.surface.heights.has_voids() {
            held & maxima.bounds(addresses).simd_ne(i32::from(NOTHING))
        } else {
            held
        }
    }
}
