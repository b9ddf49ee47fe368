//! Samples that all rays of a tile have above the surface: a common start.
//!
//! The k-th samples of neighbouring rays lie in a box, whose sides move with k as straight lines.
//! Between two indices the boxes lie in the box around both, so that no ray of the tile hits there
//! if the lowest of its rays is at or above the highest node of the blocks around that box. All of
//! it is exact: places and steps are integers, and samples of a ray lie on a line (equation 34).

use fearless_simd::prelude::*;

use super::land::Land;
use super::rays::{Tile, any_walks};
use super::words::{Packed, Words};
use crate::word::Lane as _;

/// The samples of a tile's rays, index by index.
struct Beam {
    /// Least x and z at the first sample, and their least steps.
    low: [Side; 2],
    /// Greatest x and z, and their greatest steps.
    high: [Side; 2],
    /// Least y.
    floor: Side,
}

/// A side of the box, on its way.
#[derive(Clone, Copy)]
struct Side {
    from: i64,
    step: i64,
}

impl Side {
    #[inline(always)]
    fn at(self, k: i64) -> i64 {
        self.from + k * self.step
    }
}

/// Cells that a beam goes on at first, as a power of two.
const START_LEVEL: u32 = 4;

/// Moves the rays of a tile, all of which stand at the same sample, on to one that no ray hits
/// before.
#[inline(always)]
pub fn skip<W: Packed, S: Simd>(land: &Land<'_, W, S>, tile: &mut Tile<W, S>) {
    let Some(beam) = Beam::around(tile) else { return };
    let clear = beam.clear(land);
    for rays in tile {
        rays.skip(clear);
    }
}

impl Beam {
    /// The beam of the rays that walk, if any does.
    #[inline(always)]
    fn around<W: Packed, S: Simd>(tile: &Tile<W, S>) -> Option<Self> {
        if !any_walks(tile) {
            return None;
        }
        let (x, y, z) = (extent(tile, 0), extent(tile, 1), extent(tile, 2));
        Some(Self { low: [x.0, z.0], high: [x.1, z.1], floor: y.0 })
    }

    /// So many samples on, every sample of every ray is clear.
    #[inline(always)]
    fn clear<W: Packed, S: Simd>(&self, land: &Land<'_, W, S>) -> u32 {
        let (stepper, maxima) = (land.stepper, &land.map.maxima);
        let point = W::Words::<S>::POINT;
        // Beside the map, a ray under its base is over: a beam does not pass there.
        let base = if stepper.sides { stepper.base.int().into() } else { i64::MIN };
        let last = i64::from(stepper.last) - 1;
        let mut level = START_LEVEL;
        let mut k = 0;
        loop {
            let next = (k + (1 << (level + stepper.fineness))).min(last);
            let lowest = self.floor.at(k).min(self.floor.at(next));
            let [x, z] = [0, 1].map(|axis: usize| {
                let (low, high) = (self.low[axis], self.high[axis]);
                (low.at(k).min(low.at(next)) >> point, high.at(k).max(high.at(next)) >> point)
            });
            let clear =
                lowest >= base && lowest >> maxima.places() >= i64::from(maxima.around(x, z));
            match (clear, level) {
                (true, _) if next > k => (k, level) = (next, level + 1),
                (false, 1..) => level -= 1,
                _ => return k as u32,
            }
        }
    }
}

/// Least and greatest places of an axis, with least and greatest steps.
#[inline(always)]
fn extent<W: Packed, S: Simd>(tile: &Tile<W, S>, axis: usize) -> (Side, Side) {
    let (mut low, mut high) =
        (Side { from: i64::MAX, step: i64::MAX }, Side { from: i64::MIN, step: i64::MIN });
    for rays in tile {
        if rays.walks.any_true() {
            let (least, most) = rays.place[axis].range(rays.walks);
            (low.from, high.from) = (low.from.min(least), high.from.max(most));
            let (least, most) = rays.step[axis].range(rays.walks);
            (low.step, high.step) = (low.step.min(least), high.step.max(most));
        }
    }
    (low, high)
}
