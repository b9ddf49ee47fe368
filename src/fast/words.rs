//! Vectors of sixteen words of a stock world, one per ray of a packet.
//!
//! Explicit vectors, where most loops of this project leave them to the compiler: it unrolls loops
//! over so few lanes before it would vectorise them.

use std::ops::{Add, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{i32x16, mask32x16, u32x16};

use crate::word::{Interpolating, Lane, Shading, World};

/// Rays of a packet.
pub const LANES: usize = 16;

/// One value per lane. A loop, and no closure: what the compiler does not inline into a vectorised
/// function it compiles without vectors.
macro_rules! lanes {
    ($lane:ident => $value:expr) => {{
        let mut values = [Default::default(); $crate::fast::words::LANES];
        for $lane in 0..$crate::fast::words::LANES {
            values[$lane] = $value;
        }
        values
    }};
}
pub(super) use lanes;

/// A world whose words are plain integers with one binary point: the stock worlds.
pub trait Packed:
    Interpolating
    + Shading
    + World<
        View: Lane<Int = Self::Int>,
        Ground: Lane<Int = Self::Int>,
        Height: Lane<Int = Self::Int>,
        Weight: Lane<Int = Self::Int>,
        Tone: Lane<Int = Self::Int>,
    >
{
    /// The integer under ground, height and weight words.
    type Int: Copy + Default + Into<i64>;
    /// Sixteen of them.
    type Words<S: Simd>: Words<S, Int = Self::Int>;
}

/// Sixteen words.
pub trait Words<S: Simd>: Copy + Add<Output = Self> + Sub<Output = Self> {
    /// One word.
    type Int: Copy + Default;
    /// Fraction bits.
    const POINT: u32;

    /// From one word per lane.
    fn load(simd: S, words: [Self::Int; LANES]) -> Self;
    /// From four words per lane: the first ones, the second ones, and so on.
    fn load_four(simd: S, words: [[Self::Int; 4]; LANES]) -> [Self; 4];
    /// One word in all lanes.
    fn splat(simd: S, word: Self::Int) -> Self;
    /// One word per lane.
    fn store(self) -> [Self::Int; LANES];
    /// Lane by lane, `yes` where the mask is set.
    fn select(mask: mask32x16<S>, yes: Self, no: Self) -> Self;
    /// Where words are less.
    fn less(self, than: Self) -> mask32x16<S>;
    /// Least and greatest of the words where the mask is set.
    fn range(self, of: mask32x16<S>) -> (i64, i64);
    /// The lesser words.
    fn lesser(self, other: Self) -> Self;
    /// `self + k·step`.
    fn after(self, step: Self, k: u32x16<S>) -> Self;
    /// Shifted right, rounded down.
    fn halved(self, times: u32) -> Self;
    /// The same, this many times per lane.
    fn halved_each(self, times: u32x16<S>) -> Self;
    /// Floor.
    fn cell(self) -> i32x16<S>;
    /// Place of the leading one of the largest of three magnitudes, as `Word::leading_one`.
    fn leading_one(of: [Self; 3]) -> i32x16<S>;
    /// Bits behind the point.
    fn fraction(self) -> i32x16<S>;
    /// The bits shifted right, rounded down, within 32 bits.
    fn coarse(self, places: u32) -> i32x16<S>;
    /// Bits of the magnitude shifted right, rounded down, within 31 bits.
    fn coarse_magnitude(self, places: u32) -> u32x16<S>;
    /// How many more steps stay within the block of 2^level cells: too few if `inverse` is that of
    /// a longer step, never too many; `inverse` is 2^(POINT + 20) over the step, rounded down.
    fn steps_within(self, step: Self, level: u32x16<S>, inverse: u32) -> u32x16<S>;
    /// `self · weight`, weights with the words' point, rounded to nearest, ties upward.
    fn weighted(self, weight: i32x16<S>) -> Self;
    /// `self · 2^exponent`, rounded to nearest, ties upward.
    fn rescaled(self, exponent: i32) -> Self;
    /// `self / 2^places` per lane, at least one place, rounded to nearest, ties upward; the outcome
    /// has 32 bits.
    fn reduced(self, places: u32x16<S>) -> i32x16<S>;
    /// `self / 2^places` per lane, places of either sign, rounded to nearest, ties upward.
    fn scaled_down(self, places: i32x16<S>) -> Self;
    /// Words of 32 bits.
    fn widened(words: i32x16<S>) -> Self;
}

/// Four words per lane, side by side over four vectors, as a vector of first ones, one of second
/// ones, and so on.
#[inline(always)]
pub fn transposed<S: Simd, V: SimdBase<S>>(rows: [V; 4]) -> [V; 4] {
    let (even, odd) = (rows[0].unzip_low(rows[1]), rows[0].unzip_high(rows[1]));
    let (later_even, later_odd) = (rows[2].unzip_low(rows[3]), rows[2].unzip_high(rows[3]));
    [
        even.unzip_low(later_even),
        odd.unzip_low(later_odd),
        even.unzip_high(later_even),
        odd.unzip_high(later_odd),
    ]
}
