//! The kernel ROM: tables of a finite function's weight and of its derivative.
//!
//! *In hardware*: two read-only tables of 2^t + 1 entries over the unit interval, read at the
//! nearest entry (one addition of half an entry), two read ports. *Never*: floored, which would
//! double the error of a weight (equation 13).

use crate::word::{Cell, Word};

/// Cycles from a place to the weights of its nodes: kernel ROM and blend. They pass beside the
/// memory's own; one that is faster waits for them.
pub const LATENCY: u32 = 2;

/// Weights f and slopes f′ at the entries `t / 2^log2`, t = 0 ..= 2^log2.
///
/// Over 2×2 nodes the argument is the fraction within the cell. Over 3×3 nodes it is the place
/// between the midpoints around the nearest node, and the weight is that of the node before it;
/// the node after it has the mirrored entry.
#[derive(Clone, Debug)]
pub struct KernelRom<T> {
    log2: u32,
    weight: Vec<T>,
    slope: Vec<T>,
}

impl<T: Word> KernelRom<T> {
    /// A ROM from its tables.
    ///
    /// # Panics
    /// If a table has not 2^log2 + 1 entries.
    pub fn new(log2: u32, weight: Vec<T>, slope: Vec<T>) -> Self {
        let entries = (1 << log2) + 1;
        assert!(weight.len() == entries && slope.len() == entries);
        Self { log2, weight, slope }
    }

    /// Entries per unit, as a power of two.
    pub fn log2(&self) -> u32 {
        self.log2
    }

    /// The entry nearest to an argument in `[0, 1]`.
    #[inline(always)]
    pub fn entry(&self, argument: impl Cell) -> usize {
        argument.entry(self.log2)
    }

    /// The entry of one minus the argument.
    #[inline(always)]
    pub fn mirrored(&self, entry: usize) -> usize {
        self.weight.len() - 1 - entry
    }

    /// Weight at an entry.
    #[inline(always)]
    pub fn weight(&self, entry: usize) -> T {
        self.weight[entry]
    }

    /// Slope at an entry.
    #[inline(always)]
    pub fn slope(&self, entry: usize) -> T {
        self.slope[entry]
    }
}
