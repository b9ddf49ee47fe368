//! The height memory: nodes of the map, and what lies beyond its edge.
//!
//! *In hardware*: four banks by `(i & 1, j & 1)`, so that any 2×2 block is read in one cycle and a
//! 3×3 block in four. Where the map has holes, every node has one more bit, which marks it as one
//! without data and is read with it. *Never*: reads outside the map; addresses are clamped, or
//! wrapped by subtracting the size.

use super::coefficient::{Bank, Coefficient as C};
use crate::word::World;

/// What the address unit does beyond the edge nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// The map ends there.
    Ends,
    /// The edge nodes go on.
    Clamps,
    /// The map repeats in both directions.
    Wraps,
}

/// Nodes of the map, row by row.
#[derive(Clone, Debug)]
pub struct HeightMemory<T> {
    nodes: Vec<T>,
    /// The bits that mark nodes without data, where they are fitted.
    voids: Option<Vec<bool>>,
    columns: i32,
    rows: i32,
    edge: Edge,
}

impl<T: Copy> HeightMemory<T> {
    /// A memory of `columns · rows` nodes.
    ///
    /// # Panics
    /// If the number of nodes differs or is zero: set-up has checked it.
    pub fn new(nodes: Vec<T>, columns: usize, rows: usize, edge: Edge) -> Self {
        assert!(!nodes.is_empty() && nodes.len() == columns * rows);
        Self { nodes, voids: None, columns: columns as i32, rows: rows as i32, edge }
    }

    /// The memory with a bit per node that marks those without data; what their words hold is
    /// never drawn.
    ///
    /// # Panics
    /// If there is not one bit per node.
    #[must_use]
    pub fn with_voids(self, voids: Vec<bool>) -> Self {
        assert!(voids.len() == self.nodes.len());
        Self { voids: Some(voids), ..self }
    }

    /// The same map with other words.
    ///
    /// # Panics
    /// If there is not one word per node.
    pub fn with_words<U>(&self, nodes: Vec<U>) -> HeightMemory<U> {
        assert!(nodes.len() == self.nodes.len());
        let Self { ref voids, columns, rows, edge, .. } = *self;
        HeightMemory { nodes, voids: voids.clone(), columns, rows, edge }
    }

    /// Nodes in x.
    pub fn columns(&self) -> i32 {
        self.columns
    }

    /// Nodes in z.
    pub fn rows(&self) -> i32 {
        self.rows
    }

    /// What lies beyond the edge of the map.
    pub fn edge(&self) -> Edge {
        self.edge
    }

    /// Puts in size and edge.
    pub fn coefficients<W: World>(&self, bank: &mut Bank<W>) {
        bank.number(C::MapColumns, self.columns);
        bank.number(C::MapRows, self.rows);
        bank.number(C::MapEdge, self.edge as i64);
        bank.number(C::VoidBits, self.has_voids());
    }

    /// All nodes, row by row.
    pub fn nodes(&self) -> &[T] {
        &self.nodes
    }

    /// Whether nodes may have no data: the memory has the bits that say so.
    #[inline(always)]
    pub fn has_voids(&self) -> bool {
        self.voids.is_some()
    }

    /// Whether one of the `count` × `count` nodes from (i, j) on has no data.
    #[inline(always)]
    pub fn any_void(&self, i: i32, j: i32, count: i32) -> bool {
        let Some(voids) = &self.voids else { return false };
        (j..j + count).any(|j| {
            let row = self.row(j) * self.columns as usize;
            (i..i + count).any(|i| voids[row + self.column(i)])
        })
    }

    /// Whether the map covers the cell whose corner is node (i, j).
    #[inline(always)]
    pub fn contains(&self, i: i32, j: i32) -> bool {
        self.edge != Edge::Ends || self.is_cell(i, j)
    }

    /// Whether nodes (i, j) to (i+1, j+1) are all nodes of the map: one unsigned comparison per axis.
    #[inline(always)]
    fn is_cell(&self, i: i32, j: i32) -> bool {
        ((i as u32) < (self.columns - 1) as u32) & ((j as u32) < (self.rows - 1) as u32)
    }

    /// Nodes (i, j), (i, j+1), (i+1, j), (i+1, j+1).
    #[inline(always)]
    pub fn corners(&self, i: i32, j: i32) -> [T; 4] {
        if self.is_cell(i, j) {
            // Nothing to clamp, and one test of the address for all four.
            let columns = self.columns as usize;
            let rows = &self.nodes[j as usize * columns + i as usize..][..columns + 2];
            return [rows[0], rows[columns], rows[1], rows[columns + 1]];
        }
        let (west, east) = (self.column(i), self.column(i + 1));
        let (north, south) = (self.row(j), self.row(j + 1));
        [self.at(west, north), self.at(west, south), self.at(east, north), self.at(east, south)]
    }

    /// Column address of index i.
    #[inline(always)]
    pub fn column(&self, i: i32) -> usize {
        address(i, self.columns, self.edge)
    }

    /// Row address of index j.
    #[inline(always)]
    pub fn row(&self, j: i32) -> usize {
        address(j, self.rows, self.edge)
    }

    /// The node at a column and row address.
    #[inline(always)]
    pub fn at(&self, column: usize, row: usize) -> T {
        self.nodes[row * self.columns as usize + column]
    }
}

#[inline(always)]
fn address(index: i32, size: i32, edge: Edge) -> usize {
    (match edge {
        Edge::Ends | Edge::Clamps => index.clamp(0, size - 1),
        Edge::Wraps => index.rem_euclid(size),
    }) as usize
}
