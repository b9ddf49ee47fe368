//! Random numbers of tests that are the same in every run (splitmix64).
#![allow(dead_code)] // No test uses all of it.

/// The state.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// Any word.
    pub fn word(&mut self) -> i64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ z >> 31) as i64
    }

    /// From 0 to below a limit that is positive.
    pub fn below(&mut self, limit: i64) -> i64 {
        (self.word() as u64 % limit as u64) as i64
    }

    /// One of some.
    pub fn among<T: Copy>(&mut self, some: &[T]) -> T {
        some[self.below(some.len() as i64) as usize]
    }
}
