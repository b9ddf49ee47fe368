//! The highest node of every block of cells.
//!
//! The machine's pyramid bounds every place that a jump from anywhere in a block can reach, so that
//! a jump is a shift. Here a ray is followed to the very end of its block, which takes a
//! multiplication, and each block is bounded alone.

use fearless_simd::prelude::*;
use fearless_simd::{i16x16, i32x16, mask32x16, u32x16};

use super::words::lanes;
use crate::unit::height_memory::{Edge, HeightMemory};
use crate::unit::pyramid::{cell_maxima, halve_into};

/// Maxima of blocks of 2^level cells, finest first, in coarse steps of height.
#[derive(Clone, Debug)]
pub struct Maxima {
    /// All levels one under the other, in rows of equal length.
    bounds: Vec<i16>,
    stride: i32,
    /// Cells in x and z.
    cells: (i32, i32),
    /// First power of two that holds the cells in z: level m starts at row
    /// 2·rows − (2·rows >> m) + m, which leaves each level a row at least.
    rows: i32,
    top: u32,
    ends: bool,
    places: u32,
}

/// Bound of a cell that has no surface.
pub const NOTHING: i16 = i16::MIN;

/// More levels than any map has.
const LEVELS: u32 = 28;

/// Row of a level's first block.
#[inline(always)]
fn first_row(rows: usize, level: u32) -> usize {
    2 * rows - ((2 * rows) >> level) + level as usize
}

impl Maxima {
    /// The maxima of a map whose heights are given in coarse steps of 2^places bits, rounded up.
    /// Cells that touch a node without data have no surface.
    pub fn new(heights: &HeightMemory<i16>, radius: i32, places: u32) -> Self {
        let ends = heights.edge() == Edge::Ends;
        let cells = (heights.columns() - i32::from(ends), heights.rows() - i32::from(ends));
        let cells = (cells.0.max(1), cells.1.max(1));
        let stride = heights.columns() as usize;
        let rows = (cells.1 as u32).next_power_of_two() as usize;
        let mut bounds = cell_maxima(heights, radius);
        if heights.has_voids() {
            for (at, bound) in (0..).zip(&mut bounds) {
                if heights.any_void(at % heights.columns(), at / heights.columns(), 2) {
                    *bound = NOTHING;
                }
            }
        }
        bounds.resize(first_row(rows, LEVELS) * stride, NOTHING);
        let (mut width, mut height) = (cells.0 as usize, cells.1 as usize);
        let (mut level, mut from) = (0, 0);
        while width > 1 || height > 1 {
            let to = first_row(rows, level + 1);
            let (finer, coarser) = bounds.split_at_mut(to * stride);
            halve_into(&finer[from * stride..], stride, (width, height), coarser);
            (width, height) = (width.div_ceil(2), height.div_ceil(2));
            (level, from) = (level + 1, to);
        }
        Self { bounds, stride: stride as i32, cells, rows: rows as i32, top: level, ends, places }
    }

    /// Level of the one block that holds all cells.
    pub fn top(&self) -> u32 {
        self.top
    }

    /// Bits of a height below a coarse step.
    pub fn places(&self) -> u32 {
        self.places
    }

    /// At least the highest node of a box of cells, given by its first and last cell in x and z.
    pub fn around(&self, x: (i64, i64), z: (i64, i64)) -> i16 {
        // Blocks so large that the box lies in two of them at most, each way.
        let extent = (x.1 - x.0).max(z.1 - z.0);
        let level = i64::BITS - extent.leading_zeros();
        if level > self.top {
            return self.bounds[first_row(self.rows as usize, self.top) * self.stride as usize];
        }
        let (last_i, last_j) = (i64::from(self.cells.0) - 1, i64::from(self.cells.1) - 1);
        let first_row = first_row(self.rows as usize, level) as i64;
        let mut most = NOTHING;
        for j in [self.block(z.0, last_j, level), self.block(z.1, last_j, level)] {
            for i in [self.block(x.0, last_i, level), self.block(x.1, last_i, level)] {
                if (0..=last_i >> level).contains(&i) && (0..=last_j >> level).contains(&j) {
                    let address = (first_row + j) * i64::from(self.stride) + i;
                    most = most.max(self.bounds[address as usize]);
                }
            }
        }
        most
    }

    /// The block that a cell lies in, by row or column; beyond edges that go on, that of the edge.
    #[inline(always)]
    fn block(&self, cell: i64, last: i64, level: u32) -> i64 {
        (if self.ends { cell } else { cell.clamp(0, last) }) >> level
    }

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
