//! The nodes of a height map as the fast engine reads them: all four of a cell side by side.

use rayon::prelude::*;

use crate::unit::height_memory::HeightMemory;

/// Nodes in pairs, each with its neighbour in the next row, row by row: the four nodes around a
/// cell are two pairs, side by side, and one load brings them. One row and column of cells beyond
/// each edge repeat the edge's nodes, so that an address is clamped once.
///
/// Twice the height memory, where the machine has four banks.
#[derive(Clone, Debug)]
pub struct Cells<T> {
    pairs: Vec<T>,
    /// Pairs of a row.
    pub stride: i32,
    /// Cells run from −1 to these, in x and z.
    pub last: (i32, i32),
}

impl<T: Copy + Send + Sync> Cells<T> {
    /// The cells of a map whose edge nodes go on beyond the edge.
    pub fn new(heights: &HeightMemory<T>) -> Self {
        let (columns, rows) = (heights.columns() as usize, heights.rows() as usize);
        let stride = columns + 2;
        let nodes = heights.nodes();
        let mut pairs = vec![nodes[0]; 2 * stride * (rows + 1)];
        pairs.par_chunks_exact_mut(2 * stride).enumerate().for_each(|(row, pairs)| {
            let above = &nodes[row.saturating_sub(1) * columns..][..columns];
            let below = &nodes[row.min(rows - 1) * columns..][..columns];
            for (i, pair) in pairs.chunks_exact_mut(2).enumerate() {
                let i = i.saturating_sub(1).min(columns - 1);
                pair.copy_from_slice(&[above[i], below[i]]);
            }
        });
        Self { pairs, stride: stride as i32, last: (columns as i32 - 1, rows as i32 - 1) }
    }

    /// Nodes h1 to h4 of the cell at an address: (i, j), (i, j + 1), (i + 1, j), (i + 1, j + 1).
    #[inline(always)]
    pub fn at(&self, address: u32) -> [T; 4] {
        let from = 2 * address as usize;
        let nodes = &self.pairs[from..from + 4];
        [nodes[0], nodes[1], nodes[2], nodes[3]]
    }
}
