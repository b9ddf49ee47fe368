//! The kernel ROM: tables of a finite function's weight and of its derivative.
//!
//! *In hardware*: two read-only tables of 2^t + 1 entries over the unit interval, read at the
//! nearest entry (one addition of half an entry), two read ports. *Never*: floored, which would
//! double the error of a weight (equation 13).

use crate::word::{Table, Word};

/// Cycles from a place to the weights of its nodes: kernel ROM and hat weight. They pass beside the
/// memory's own; one that is faster waits for them.
pub const LATENCY: u32 = 2;

/// Weights f and slopes f′ at the entries `t / 2^log2`, t = 0 ..= 2^log2.
///
/// Over 2×2 nodes the argument is the fraction within the cell. Over 3×3 nodes it is the place
/// between the midpoints around the nearest node, and the weight is that of the node before it;
/// the node after it has the mirrored entry.
#[derive(Clone, Debug)]
pub struct KernelRom<T> {
    weights: Table<T>,
    slopes: Table<T>,
}

impl<T: Word> KernelRom<T> {
    /// A ROM from its tables.
    ///
    /// # Panics
    /// If a table has not 2^log2 + 1 entries.
    pub fn new(log2: u32, weights: Vec<T>, slopes: Vec<T>) -> Self {
        let entries = (1 << log2) + 1;
        assert!(weights.len() == entries && slopes.len() == entries);
        Self { weights: Table::new(log2, weights), slopes: Table::new(log2, slopes) }
    }

    /// Entries per unit, as a power of two.
    pub fn log2(&self) -> u32 {
        self.weights.log2()
    }

    /// Weights by entry, from 0 to 1.
    #[inline(always)]
    pub fn weights(&self) -> &Table<T> {
        &self.weights
    }

    /// Derivatives of the weights by entry, per cell.
    #[inline(always)]
    pub fn slopes(&self) -> &Table<T> {
        &self.slopes
    }
}
