//! Lowest and highest node over square blocks of patches, in a few sizes, so that a ray passes
//! over the blocks it cannot touch.

use super::kernel::Stencil;
use crate::scene::{Outside, Terrain};

/// Patches along the side of the smallest block, and between one size and the next.
const FACTOR: usize = 8;

/// One axis of the patch grid: how many nodes there are and what lies beyond them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    nodes: i64,
    wraps: bool,
}

/// A run of patches, as indices of its first patch and of the first patch behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Index of the first patch.
    pub first: i64,
    /// First patch behind the run.
    pub end: i64,
}

/// Farther than any traversal: the end of a run that never ends.
const OPEN: i64 = 1 << 48;

impl Axis {
    /// An axis of `nodes` nodes.
    #[must_use]
    pub fn new(nodes: usize, outside: Outside) -> Self {
        Self { nodes: i64::try_from(nodes).unwrap_or(OPEN), wraps: outside == Outside::Wrap }
    }

    /// The node of the map that stands for node i of the endless grid.
    #[must_use]
    pub fn node(&self, i: i64) -> usize {
        let i = if self.wraps { i.rem_euclid(self.nodes) } else { i.clamp(0, self.nodes - 1) };
        usize::try_from(i).unwrap_or(0)
    }

    /// The block of `size` patches that holds a patch: its index, and how far its bounds hold.
    fn block(&self, patch: i64, size: i64) -> (usize, Span) {
        let inside =
            if self.wraps { patch.rem_euclid(self.nodes) } else { patch.clamp(0, self.nodes - 1) };
        let shift = if self.wraps { patch - inside } else { 0 };
        let block = inside / size;
        let mut first = block * size;
        let mut end = ((block + 1) * size).min(self.nodes);
        // The edge nodes go on: no new heights lie beyond.
        if !self.wraps && first == 0 {
            first = -OPEN;
        }
        if !self.wraps && end == self.nodes {
            end = OPEN;
        }
        let span = Span { first: first + shift, end: end + shift };
        (usize::try_from(block).unwrap_or(0), span)
    }

    /// How far a patch reaches: one cell, or without end where the edge node goes on.
    #[must_use]
    pub fn patch_span(&self, patch: i64) -> Span {
        let mut span = Span { first: patch, end: patch + 1 };
        if !self.wraps && patch < 0 {
            (span.first, span.end) = (-OPEN, 0);
        }
        if !self.wraps && patch >= self.nodes {
            (span.first, span.end) = (self.nodes, OPEN);
        }
        span
    }
}

/// All blocks of one size.
#[derive(Clone, Debug)]
struct Level {
    size: i64,
    columns: usize,
    rows: usize,
    /// Lowest and highest surface height in scene units, row by row.
    ranges: Vec<(f64, f64)>,
    /// Whether some patch touches a node without data, row by row.
    holes: Vec<bool>,
}

/// Bounds of the surface over blocks, coarse to fine.
#[derive(Clone, Debug)]
pub struct Extrema {
    levels: Vec<Level>,
}

/// Where a block lies and how low and high the surface gets in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Indices of its patches in x.
    pub x: Span,
    /// Indices of its patches in z.
    pub z: Span,
    /// Lowest and highest surface height, scene units.
    pub range: (f64, f64),
    /// Whether it has holes.
    pub holed: bool,
}

impl Extrema {
    /// The blocks of a terrain.
    #[must_use]
    pub fn new(terrain: &Terrain, stencil: Stencil, axes: (Axis, Axis)) -> Self {
        let map = &terrain.map;
        let mut finest = Level::empty(FACTOR, map.columns(), map.rows());
        let touched = |axis: Axis, block: usize| {
            let first = (block * FACTOR) as i64;
            let last = ((first + FACTOR as i64).min(axis.nodes)) - 1;
            let [c, a, b] = stencil.nodes();
            (first + c.min(a).min(b)..=last + c.max(a).max(b)).map(move |i| axis.node(i))
        };
        for row in 0..finest.rows {
            for column in 0..finest.columns {
                let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
                let mut holed = false;
                for j in touched(axes.1, row) {
                    for i in touched(axes.0, column) {
                        let sample = map.sample(i, j);
                        // NaN, no data, is neither.
                        (low, high) = (low.min(sample), high.max(sample));
                        holed |= sample.is_nan();
                    }
                }
                let (low, high) = (terrain.height(low), terrain.height(high));
                finest.ranges.push((low, high));
                finest.holes.push(holed);
            }
        }
        let mut levels = vec![finest];
        while let Some(coarser) = levels[0].coarser(map.columns(), map.rows()) {
            levels.insert(0, coarser);
        }
        Self { levels }
    }

    /// The blocks that hold patch (x, z), coarse to fine.
    pub fn blocks(&self, axes: (Axis, Axis), x: i64, z: i64) -> impl Iterator<Item = Block> + '_ {
        self.levels.iter().map(move |level| {
            let (column, span_x) = axes.0.block(x, level.size);
            let (row, span_z) = axes.1.block(z, level.size);
            let index = row * level.columns + column;
            let (range, holed) = (level.ranges[index], level.holes[index]);
            Block { x: span_x, z: span_z, range, holed }
        })
    }
}

impl Level {
    fn empty(size: usize, columns: usize, rows: usize) -> Self {
        Self {
            size: size as i64,
            columns: columns.div_ceil(size),
            rows: rows.div_ceil(size),
            ranges: Vec::new(),
            holes: Vec::new(),
        }
    }

    /// The next size up; `None` where one block would hold the whole map.
    fn coarser(&self, columns: usize, rows: usize) -> Option<Self> {
        if self.columns.max(self.rows) <= FACTOR {
            return None;
        }
        let size = usize::try_from(self.size).ok()? * FACTOR;
        let mut level = Self::empty(size, columns, rows);
        level.ranges = vec![(f64::INFINITY, f64::NEG_INFINITY); level.columns * level.rows];
        level.holes = vec![false; level.ranges.len()];
        for (index, &(low, high)) in self.ranges.iter().enumerate() {
            let (row, column) = (index / self.columns, index % self.columns);
            let at = row / FACTOR * level.columns + column / FACTOR;
            let range = &mut level.ranges[at];
            *range = (range.0.min(low), range.1.max(high));
            level.holes[at] |= self.holes[index];
        }
        Some(level)
    }
}
