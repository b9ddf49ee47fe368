//! Bounds of blocks, looked up for a packet of rays.

use fearless_simd::prelude::*;
use fearless_simd::{i16x16, i32x16, mask32x16, u32x16};

use super::words::lanes;
use crate::setup::maxima::Maxima;

impl Maxima {
    /// Addresses of the blocks of a level that hold cells (i, j), and where there is such a block;
    /// elsewhere the address is that of any.
    #[inline(always)]
    pub fn addresses<S: Simd>(
        &self,
        level: u32x16<S>,
        i: i32x16<S>,
        j: i32x16<S>,
    ) -> (u32x16<S>, mask32x16<S>) {
        let simd = level.token();
        let places = level.bitcast::<i32x16<S>>();
        let (last_i, last_j) = (self.cells.0 - 1, self.cells.1 - 1);
        let (i, j) = if self.ends { (i, j) } else { (i.max(0).min(last_i), j.max(0).min(last_j)) };
        let (i, j) = (i >> places, j >> places);
        let block = |last: i32| i32x16::simd_from(simd, last) >> places;
        let within = |at: i32x16<S>, last: i32x16<S>| {
            at.bitcast::<u32x16<S>>().simd_le(last.bitcast::<u32x16<S>>())
        };
        let held = within(i, block(last_i)) & within(j, block(last_j));
        let first_row = 2 * self.rows - block(2 * self.rows) + places;
        let address = (first_row + j) * self.stride + i;
        (held.select(address, i32x16::simd_from(simd, 0)).bitcast(), held)
    }

    /// The bounds at addresses.
    #[inline(always)]
    pub fn bounds<S: Simd>(&self, addresses: u32x16<S>) -> i32x16<S> {
        let at = addresses.to_array();
        let bounds = lanes!(lane => self.bounds[at[lane] as usize]);
        let (low, high) = i16x16::simd_from(addresses.token(), bounds).widen();
        low.combine(high)
    }
}
