//! Random numbers of tests that are the same in every run.
#![allow(dead_code)] // No test uses all of it.

/// Random numbers from a seed (SplitMix64).
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    /// A number from `low` to `high`, both included.
    pub fn within(&mut self, low: i64, high: i64) -> i64 {
        let count = (i128::from(high) - i128::from(low) + 1) as u128;
        (i128::from(low) + (u128::from(self.bits()) % count) as i128) as i64
    }

    /// Whether one of `chance` cases of 256 comes up.
    pub fn is(&mut self, chance: i64) -> bool {
        self.within(0, 255) < chance
    }

    /// A signed word that is a corner case more often than not: ends, small values, powers of two
    /// and their neighbours, or random bits below a random leading one.
    pub fn word(&mut self, width: u32) -> i64 {
        let (low, high) = (i64::MIN >> (64 - width), i64::MAX >> (64 - width));
        let magnitude = 1_i64 << self.within(0, i64::from(width) - 2);
        let word = match self.within(0, 7) {
            0 => *[low, low + 1, high, high - 1, 0, 1, -1, -2]
                .get(self.within(0, 7) as usize)
                .unwrap_or(&0),
            1 | 2 => magnitude + self.within(-1, 1),
            _ => magnitude | self.within(0, magnitude - 1),
        };
        if word != low && self.is(128) { -word } else { word }
    }

    /// From 0 to below a limit that is positive.
    pub fn below(&mut self, limit: i64) -> i64 {
        (self.bits() % limit as u64) as i64
    }

    /// One of some.
    pub fn among<T: Copy>(&mut self, some: &[T]) -> T {
        some[self.below(some.len() as i64) as usize]
    }
}
