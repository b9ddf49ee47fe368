//! The skip pyramid: for every block of every level, a bound that no surface within a jump's
//! reach exceeds.
//!
//! *In hardware*: one memory with its own port, one read per skip test. Level m has blocks of 2^m
//! cells. The bound of block b holds for every place that a ray in the block can reach with a jump
//! of up to 2^m cells per axis: it is the highest of the nodes with index in
//! `[(b−1)·2^m − r, (b+2)·2^m + r]`, r = 0 for kernels over 2×2 nodes and 1 over 3×3 (equation 21
//! of docs/mathematics.md). Every kernel here is a convex combination of its nodes, so the
//! highest node bounds the surface.
//!
//! Blocks outside the map but next to it carry real bounds; farther ones have none: there is
//! nothing to meet.

use std::ops::Range;

use rayon::prelude::*;

use super::height_memory::{Edge, HeightMemory};
use crate::word::Word;

/// What a block is bounded by: a word, or a height in the coarse steps of the fast engine.
pub trait Bound: Copy + Send + Sync {
    /// The higher of two.
    #[must_use]
    fn higher(self, other: Self) -> Self;
}

impl<T: Word> Bound for T {
    #[inline(always)]
    fn higher(self, other: Self) -> Self {
        self.greater(other)
    }
}

impl Bound for i16 {
    #[inline(always)]
    fn higher(self, other: Self) -> Self {
        self.max(other)
    }
}

/// Bounds of all levels, finest first.
#[derive(Clone, Debug)]
pub struct Pyramid<T> {
    levels: Levels,
    top: u32,
    /// Bounds of all levels, one after the other.
    bounds: Vec<T>,
    edge: Edge,
    columns: i32,
    rows: i32,
}

/// Room for levels: more than any map has.
const LEVELS: usize = 32;

/// Where the bounds of each level are.
#[derive(Clone, Copy, Debug, Default)]
struct Levels {
    offset: [i32; LEVELS],
    columns: [i32; LEVELS],
    rows: [i32; LEVELS],
}

/// How the blocks of one axis and level gather the blocks around them.
struct Axis {
    /// Blocks that hold nodes.
    blocks: i32,
    /// Index of the first stored bound: −1 where the map ends, 0 elsewhere.
    first: i32,
    /// Bounds stored per axis.
    stored: i32,
    edge: Edge,
}

impl Axis {
    fn new(nodes: i32, level: u32, edge: Edge) -> Self {
        let blocks = ((nodes - 1) >> level) + 1;
        match edge {
            // A ray left of block −1 or right of the last stored block cannot reach the map.
            Edge::Ends => {
                let last = (nodes - 1 + (1 << level) - 1) >> level;
                Self { blocks, first: -1, stored: last + 2, edge }
            }
            Edge::Clamps | Edge::Wraps => Self { blocks, first: 0, stored: blocks, edge },
        }
    }

    /// Blocks whose nodes the bound of stored entry `at` takes in.
    fn reach(&self, at: i32) -> impl Iterator<Item = usize> + '_ {
        let block = at + self.first;
        // When the map repeats, its last block may be a part of one, and a jump over it reaches
        // two blocks on.
        let wide = if self.edge == Edge::Wraps { 2 } else { 1 };
        (block - wide..=block + wide).filter_map(|b| match self.edge {
            Edge::Ends | Edge::Clamps => (0..self.blocks).contains(&b).then_some(b as usize),
            Edge::Wraps => Some(b.rem_euclid(self.blocks) as usize),
        })
    }
}

impl<T: Bound> Pyramid<T> {
    /// The pyramid of a height memory for kernels of radius `1 + r` nodes, built by maxima of
    /// maxima. Levels go up to the first block that covers the map; where the map repeats, blocks
    /// stay within its size.
    pub fn new(heights: &HeightMemory<T>, r: i32) -> Self {
        let (columns, rows, edge) = (heights.columns(), heights.rows(), heights.edge());
        let mut level = 0;
        // Nodes b·2^m − r ..= (b+1)·2^m + r of each block.
        let cells = cell_maxima(heights, r);
        let mut maxima = None;
        let (mut width, mut height) = (columns, rows);
        let mut levels = Levels::default();
        let mut bounds = Vec::new();
        loop {
            let (x, z) = (Axis::new(columns, level, edge), Axis::new(rows, level, edge));
            levels.offset[level as usize] = bounds.len() as i32;
            levels.columns[level as usize] = x.stored;
            levels.rows[level as usize] = z.stored;
            let finer = maxima.as_deref().unwrap_or(&cells[..]);
            gather(finer, width as usize, &x, &z, &mut bounds);
            let size = 1 << (level + 1);
            let enough = match edge {
                Edge::Ends | Edge::Clamps => width == 1 && height == 1,
                Edge::Wraps => size > columns || size > rows,
            };
            if enough || level == 20 {
                break;
            }
            level += 1;
            let (w, h) = ((width + 1) / 2, (height + 1) / 2);
            maxima = Some(halve(finer, width as usize, height as usize));
            (width, height) = (w, h);
        }
        Self { levels, top: level, bounds, edge, columns, rows }
    }

    /// The highest level that is stored.
    pub fn top(&self) -> u32 {
        self.top
    }

    /// Bounds stored in all levels.
    pub fn stored_bounds(&self) -> usize {
        self.bounds.len()
    }

    /// The bound for a ray in cell (i, j) that jumps at most 2^level cells per axis; `None` where
    /// it cannot reach the map.
    #[inline(always)]
    pub fn bound(&self, level: u32, i: i32, j: i32) -> Option<T> {
        let (stored, address) = self.address(level, i, j);
        stored.then(|| self.bounds[address as usize])
    }

    /// Whether there is such a bound, and where.
    #[inline(always)]
    pub fn address(&self, level: u32, i: i32, j: i32) -> (bool, i32) {
        let at = level as usize % LEVELS;
        let (columns, rows) = (self.levels.columns[at], self.levels.rows[at]);
        let (i, j) = match self.edge {
            Edge::Ends => ((i >> level) + 1, (j >> level) + 1),
            Edge::Clamps => ((i >> level).clamp(0, columns - 1), (j >> level).clamp(0, rows - 1)),
            Edge::Wraps => (i.rem_euclid(self.columns) >> level, j.rem_euclid(self.rows) >> level),
        };
        let stored = ((i as u32) < columns as u32) & ((j as u32) < rows as u32);
        (stored, self.levels.offset[at].wrapping_add(j.wrapping_mul(columns)).wrapping_add(i))
    }

    /// Where a level's bounds are: address of its first one, columns and rows of blocks. Column 0
    /// is block -1 where the map ends at its edge, block 0 elsewhere.
    pub fn level(&self, level: u32) -> (i32, i32, i32) {
        let at = level as usize % LEVELS;
        (self.levels.offset[at], self.levels.columns[at], self.levels.rows[at])
    }

    /// The bound at an address.
    #[inline(always)]
    pub fn at(&self, address: i32) -> T {
        self.bounds[address as usize]
    }
}

/// Per cell, the highest of nodes i−r ..= i+1+r and j−r ..= j+1+r.
pub fn cell_maxima<T: Bound>(heights: &HeightMemory<T>, r: i32) -> Vec<T> {
    let nodes = heights.nodes();
    let width = heights.columns() as usize;
    let mut out = vec![nodes[0]; nodes.len()];
    out.par_chunks_exact_mut(width).enumerate().for_each_init(Vec::new, |tallest, (j, out)| {
        let rows = (-r..=1 + r).map(|offset| {
            let from = heights.row(j as i32 + offset) * width;
            &nodes[from..from + width]
        });
        highest_of(rows, tallest);
        out.copy_from_slice(tallest);
        for offset in (-r..=1 + r).filter(|&offset| offset != 0) {
            let inside = shifted(width, offset);
            raise(&mut out[inside.clone()], &tallest[offset_by(&inside, offset)]);
            // Columns whose neighbour is beyond the edge.
            for i in (0..inside.start).chain(inside.end..width) {
                out[i] = out[i].higher(tallest[heights.column(i as i32 + offset)]);
            }
        }
    });
    out
}

/// Column by column, the highest of some rows.
fn highest_of<'a, T: Bound + 'a>(rows: impl IntoIterator<Item = &'a [T]>, tallest: &mut Vec<T>) {
    tallest.clear();
    for row in rows {
        if tallest.is_empty() {
            tallest.extend_from_slice(row);
        } else {
            raise(tallest, row);
        }
    }
}

/// Indices i with both i and i + offset in `0..size`.
fn shifted(size: usize, offset: i32) -> Range<usize> {
    let size = size as i32;
    let (start, end) = ((-offset).clamp(0, size), (size - offset).clamp(0, size));
    start as usize..end.max(start) as usize
}

fn offset_by(range: &Range<usize>, offset: i32) -> Range<usize> {
    let at = |i: usize| (i as i32 + offset) as usize;
    if range.is_empty() { 0..0 } else { at(range.start)..at(range.end) }
}

/// Element by element, the higher of two rows.
fn raise<T: Bound>(row: &mut [T], by: &[T]) {
    for (bound, &other) in row.iter_mut().zip(by) {
        *bound = bound.higher(other);
    }
}

/// Maxima of 2×2 blocks; the last one of an odd size stands alone.
fn halve<T: Bound>(maxima: &[T], width: usize, height: usize) -> Vec<T> {
    let half = width.div_ceil(2);
    let mut out = vec![maxima[0]; half * height.div_ceil(2)];
    out.par_chunks_exact_mut(half).zip(maxima.par_chunks(2 * width)).for_each(|(out, pair)| {
        let (above, below) = pair.split_at(width);
        halve_rows(above, if below.is_empty() { above } else { below }, out);
    });
    out
}

/// The same for the first `width` columns and `height` rows of a grid whose rows are `stride`
/// apart, into another one of that stride.
pub fn halve_into<T: Bound>(
    maxima: &[T],
    stride: usize,
    (width, height): (usize, usize),
    out: &mut [T],
) {
    let pairs = maxima[..height * stride].par_chunks(2 * stride);
    out.par_chunks_exact_mut(stride).zip(pairs).for_each(|(out, pair)| {
        let above = &pair[..width];
        let below = pair.get(stride..stride + width).unwrap_or(above);
        halve_rows(above, below, &mut out[..width.div_ceil(2)]);
    });
}

/// Maxima of pairs of columns of two rows.
fn halve_rows<T: Bound>(above: &[T], below: &[T], out: &mut [T]) {
    for (o, (a, b)) in out.iter_mut().zip(above.chunks(2).zip(below.chunks(2))) {
        let last = a.len() - 1;
        *o = a[0].higher(a[last]).higher(b[0].higher(b[last]));
    }
}

/// Appends the bounds of one level, made from its blocks' maxima.
fn gather<T: Bound>(maxima: &[T], width: usize, x: &Axis, z: &Axis, bounds: &mut Vec<T>) {
    let stored = x.stored as usize;
    let from = bounds.len();
    bounds.resize(from + z.stored as usize * stored, maxima[0]);
    let rows = bounds[from..].par_chunks_exact_mut(stored).enumerate();
    rows.for_each_init(Vec::new, |tallest, (at, out)| {
        // Every stored block has a block with nodes in reach.
        let blocks = z.reach(at as i32).map(|row| &maxima[row * width..(row + 1) * width]);
        highest_of(blocks, tallest);
        let lead = (1 - x.first) as usize;
        let plain = x.edge != Edge::Wraps && width >= 3;
        let middle = if plain { lead..lead + width - 2 } else { 0..0 };
        for (o, w) in out[middle.clone()].iter_mut().zip(tallest.windows(3)) {
            *o = w[0].higher(w[1]).higher(w[2]);
        }
        for i in (0..middle.start).chain(middle.end..stored) {
            let reached = x.reach(i as i32).map(|b| tallest[b]).reduce(Bound::higher);
            out[i] = reached.unwrap_or(tallest[0]);
        }
    });
}
