//! The skip pyramid: for every block of every level, a bound that no surface within a jump's
//! reach exceeds.
//!
//! *In hardware*: one memory with its own port, one read per trial. Level m has blocks of 2^m
//! cells. The bound of block b holds for every place that a ray in the block can reach with a jump
//! of up to 2^m cells per axis: it is the highest of the nodes with index in
//! `[(b−1)·2^m − r, (b+2)·2^m + r]`, r = 0 for kernels over 2×2 nodes and 1 over 3×3 (equation 21
//! of docs/mathematics.md). Every kernel here is a convex combination of its nodes, so the
//! highest node bounds the surface.
//!
//! Blocks outside the map but next to it carry real bounds; farther ones have none: there is
//! nothing to meet.

use super::height_memory::{Edge, HeightMemory};

/// Bounds of all levels, finest first.
#[derive(Clone, Debug)]
pub struct Pyramid<T> {
    levels: [Level; LEVELS],
    top: u32,
    /// Bounds of all levels, one after the other.
    bounds: Vec<T>,
    /// Per cell of the map, the highest of the nodes that its surface depends on.
    cells: Vec<T>,
    edge: Edge,
    columns: i32,
    rows: i32,
}

/// Most levels: blocks of 2^20 cells, more than any map.
const LEVELS: usize = 32;

/// Where the bounds of a level are.
#[derive(Clone, Copy, Debug, Default)]
struct Level {
    offset: i32,
    columns: i32,
    rows: i32,
}

/// How the blocks of one axis and level gather the blocks around them.
struct Axis {
    /// Blocks that hold nodes.
    blocks: i32,
    /// Index of the first stored bound: −1 where the map ends, 0 elsewhere.
    first: i32,
    /// Stored bounds.
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

impl<T: Copy + PartialOrd> Pyramid<T> {
    /// The pyramid of a height memory for kernels of radius `1 + r` nodes, built by maxima of
    /// maxima. Levels go up to the first block that covers the map; where the map repeats, blocks
    /// stay within its size.
    pub fn new(heights: &HeightMemory<T>, r: i32) -> Self {
        let (columns, rows, edge) = (heights.columns(), heights.rows(), heights.edge());
        let mut level = 0;
        // Nodes b·2^m − r ..= (b+1)·2^m + r of each block.
        let cells = finest(heights, r);
        let mut maxima = cells.clone();
        let (mut width, mut height) = (columns, rows);
        let mut levels = [Level::default(); LEVELS];
        let mut bounds = Vec::new();
        loop {
            let (x, z) = (Axis::new(columns, level, edge), Axis::new(rows, level, edge));
            levels[level as usize] =
                Level { offset: bounds.len() as i32, columns: x.stored, rows: z.stored };
            gather(&maxima, width as usize, &x, &z, &mut bounds);
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
            maxima = halve(&maxima, width as usize, height as usize);
            (width, height) = (w, h);
        }
        Self { levels, top: level, bounds, cells, edge, columns, rows }
    }

    /// Highest level.
    pub fn top(&self) -> u32 {
        self.top
    }

    /// Bounds stored in all levels.
    pub fn len(&self) -> usize {
        self.bounds.len()
    }

    /// Never: a map has at least one node.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A bound of the surface in the cell at a column and row address of the height memory.
    #[inline(always)]
    pub fn cell(&self, column: usize, row: usize) -> T {
        self.cells[row * self.columns as usize + column]
    }

    /// The bound for a ray in cell (i, j) that jumps at most 2^level cells per axis; `None` where
    /// it cannot reach the map.
    #[inline(always)]
    pub fn bound(&self, level: u32, i: i32, j: i32) -> Option<T> {
        self.address(level, i, j).map(|address| self.bounds[address])
    }

    /// Where that bound is stored.
    #[inline(always)]
    pub fn address(&self, level: u32, i: i32, j: i32) -> Option<usize> {
        let at = self.levels[level as usize % LEVELS];
        let (i, j) = match self.edge {
            Edge::Ends => ((i >> level) + 1, (j >> level) + 1),
            Edge::Clamps => {
                ((i >> level).clamp(0, at.columns - 1), (j >> level).clamp(0, at.rows - 1))
            }
            Edge::Wraps => (i.rem_euclid(self.columns) >> level, j.rem_euclid(self.rows) >> level),
        };
        let stored = ((i as u32) < at.columns as u32) & ((j as u32) < at.rows as u32);
        stored.then(|| (at.offset + j * at.columns + i) as usize)
    }

    /// The bound at an address.
    #[inline(always)]
    pub fn at(&self, address: usize) -> T {
        self.bounds[address]
    }
}

fn higher<T: Copy + PartialOrd>(a: T, b: T) -> T {
    if b > a { b } else { a }
}

/// Per cell, the highest of nodes i−r ..= i+1+r and j−r ..= j+1+r.
fn finest<T: Copy + PartialOrd>(heights: &HeightMemory<T>, r: i32) -> Vec<T> {
    let (columns, rows) = (heights.columns(), heights.rows());
    let width = columns as usize;
    let mut across = Vec::with_capacity(heights.nodes().len());
    for row in heights.nodes().chunks_exact(width) {
        let inner = r as usize..width.saturating_sub(1 + r as usize).max(r as usize);
        let at = |i: i32| {
            (i - r..=i + 1 + r).map(|i| row[heights.column(i)]).reduce(higher).unwrap_or(row[0])
        };
        across.extend((0..inner.start.min(width)).map(|i| at(i as i32)));
        if r == 0 {
            across.extend(row.windows(2).take(inner.len()).map(|w| higher(w[0], w[1])));
        } else {
            across.extend(
                row.windows(4)
                    .take(inner.len())
                    .map(|w| higher(higher(w[0], w[1]), higher(w[2], w[3]))),
            );
        }
        across.extend((inner.end.max(inner.start.min(width))..width).map(|i| at(i as i32)));
    }
    let mut out = Vec::with_capacity(across.len());
    for j in 0..rows {
        let start = out.len();
        let first = heights.row(j - r) * width;
        out.extend_from_slice(&across[first..first + width]);
        for k in j - r + 1..=j + 1 + r {
            let from = heights.row(k) * width;
            for (o, &a) in out[start..].iter_mut().zip(&across[from..from + width]) {
                *o = higher(*o, a);
            }
        }
    }
    out
}

/// Maxima of 2×2 blocks; the last one of an odd size stands alone.
fn halve<T: Copy + PartialOrd>(maxima: &[T], width: usize, height: usize) -> Vec<T> {
    let mut out = Vec::with_capacity(width.div_ceil(2) * height.div_ceil(2));
    for pair in maxima.chunks(2 * width) {
        let (above, below) = pair.split_at(width);
        let below = if below.is_empty() { above } else { below };
        out.extend(above.chunks(2).zip(below.chunks(2)).map(|(a, b)| {
            let last = a.len() - 1;
            higher(higher(a[0], a[last]), higher(b[0], b[last]))
        }));
    }
    out
}

/// The bounds of one level from its blocks' maxima.
fn gather<T: Copy + PartialOrd>(
    maxima: &[T],
    width: usize,
    x: &Axis,
    z: &Axis,
    bounds: &mut Vec<T>,
) {
    let stored = x.stored as usize;
    // Every stored block has a node in reach, so the fold's start is always replaced or equalled.
    let mut across = Vec::with_capacity(z.blocks as usize * stored);
    for row in maxima.chunks_exact(width) {
        let at = |at: i32| x.reach(at).map(|b| row[b]).reduce(higher).unwrap_or(row[0]);
        if x.edge == Edge::Wraps || width < 3 {
            across.extend((0..x.stored).map(at));
        } else {
            let lead = 1 - x.first;
            across.extend((0..lead).map(at));
            across.extend(row.windows(3).map(|w| higher(higher(w[0], w[1]), w[2])));
            across.extend((lead + width as i32 - 2..x.stored).map(at));
        }
    }
    bounds.reserve(z.stored as usize * stored);
    for at in 0..z.stored {
        let start = bounds.len();
        for row in z.reach(at) {
            let from = &across[row * stored..(row + 1) * stored];
            if bounds.len() == start {
                bounds.extend_from_slice(from);
            } else {
                for (bound, &other) in bounds[start..].iter_mut().zip(from) {
                    *bound = higher(*bound, other);
                }
            }
        }
    }
}
