//! Tables of words, read through an operation of the word that addresses them.

/// A function at the arguments t / 2^log2, t = 0, 1, …: what `Cell::look_up` reads.
///
/// A word reads the entry nearest to it. Which others it may mean is known to its world alone: one of
/// bounds widens what it reads over all of them ([`Word::hull`](super::Word::hull)).
#[derive(Clone, Debug)]
pub struct Table<T> {
    log2: u32,
    entries: Vec<T>,
    last: T,
}

impl<T: Copy> Table<T> {
    /// A table from its entries.
    ///
    /// # Panics
    /// If there is none: set-up makes no such table.
    pub fn new(log2: u32, entries: Vec<T>) -> Self {
        let last = entries[entries.len() - 1];
        Self { log2, entries, last }
    }

    /// Entries per unit of the argument, as a power of two.
    #[inline(always)]
    pub fn log2(&self) -> u32 {
        self.log2
    }

    /// All entries, that of zero first.
    pub fn entries(&self) -> &[T] {
        &self.entries
    }

    /// The entry at an address; the last one beyond it.
    #[inline(always)]
    pub fn at(&self, address: usize) -> T {
        self.entries.get(address).copied().unwrap_or(self.last)
    }

    /// The entry at an address, and the one as far from the table's end.
    #[inline(always)]
    pub fn both_ways(&self, address: usize) -> [T; 2] {
        let mirrored = (self.entries.len() - 1).saturating_sub(address);
        [self.at(address), self.at(mirrored)]
    }
}
