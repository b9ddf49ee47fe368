//! Vectors of 32-bit words.

use std::ops::Add;

use fearless_simd::prelude::*;
use fearless_simd::{i32x4, i32x16, i64x8, mask32x16, u32x16, u64x8};

use super::words::{LANES, Packed, Words, lanes, transposed};
use crate::word::stock::Narrow;
use crate::word::{Lane as _, World};

impl Packed for Narrow {
    type Int = i32;
    type Words<S: Simd> = i32x16<S>;
}

/// Four times four words side by side.
#[inline(always)]
fn four<S: Simd>(simd: S, words: &[[i32; 4]; LANES], from: usize) -> i32x16<S> {
    let [a, b, c, d] = [words[from], words[from + 1], words[from + 2], words[from + 3]];
    let (a, b) = (i32x4::simd_from(simd, a), i32x4::simd_from(simd, b));
    let (c, d) = (i32x4::simd_from(simd, c), i32x4::simd_from(simd, d));
    a.combine(b).combine(c.combine(d))
}

impl<S: Simd> Words<S> for i32x16<S> {
    type Int = i32;
    const POINT: u32 = <Narrow as World>::Ground::FRACTION;

    #[inline(always)]
    fn load(simd: S, words: [i32; LANES]) -> Self {
        Self::simd_from(simd, words)
    }
    #[inline(always)]
    fn load_four(simd: S, w: [[i32; 4]; LANES]) -> [Self; 4] {
        transposed([four(simd, &w, 0), four(simd, &w, 4), four(simd, &w, 8), four(simd, &w, 12)])
    }
    #[inline(always)]
    fn splat(simd: S, word: i32) -> Self {
        Self::simd_from(simd, word)
    }
    #[inline(always)]
    fn store(self) -> [i32; LANES] {
        self.to_array()
    }
    #[inline(always)]
    fn select(mask: mask32x16<S>, yes: Self, no: Self) -> Self {
        mask.select(yes, no)
    }
    #[inline(always)]
    fn less(self, than: Self) -> mask32x16<S> {
        self.simd_lt(than)
    }
    #[inline(always)]
    fn range(self, of: mask32x16<S>) -> (i64, i64) {
        let all = |word: i32| Self::simd_from(self.token(), word);
        let least = of.select(self, all(i32::MAX)).reduce_min();
        let most = of.select(self, all(i32::MIN)).reduce_max();
        (least.into(), most.into())
    }
    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        self.min(other)
    }
    #[inline(always)]
    fn after(self, step: Self, k: u32x16<S>) -> Self {
        self + step * k.bitcast::<Self>()
    }
    #[inline(always)]
    fn halved(self, times: u32) -> Self {
        self >> times.min(31)
    }
    #[inline(always)]
    fn halved_each(self, times: u32x16<S>) -> Self {
        self >> times.min(31).bitcast::<Self>()
    }
    #[inline(always)]
    fn cell(self) -> i32x16<S> {
        self >> Self::POINT
    }
    #[inline(always)]
    fn leading_one(of: [Self; 3]) -> i32x16<S> {
        // The leading one of all bits together is that of the largest magnitude.
        let [x, y, z] = of;
        let (x, y, z) = (x.max(-x), y.max(-y), z.max(-z));
        let bits = (x | y | z).to_array();
        let zeros = lanes!(lane => bits[lane].leading_zeros() as i32);
        31 - Self::POINT as i32 - Self::simd_from(x.token(), zeros)
    }
    #[inline(always)]
    fn fraction(self) -> i32x16<S> {
        self & ((1 << Self::POINT) - 1)
    }
    #[inline(always)]
    fn coarse(self, places: u32) -> i32x16<S> {
        self >> places
    }
    #[inline(always)]
    fn coarse_magnitude(self, places: u32) -> u32x16<S> {
        self.max(-self).bitcast::<u32x16<S>>() >> places
    }
    #[inline(always)]
    fn steps_within(self, step: Self, level: u32x16<S>, inverse: u32) -> u32x16<S> {
        // What is left of the block ahead of the place is what is behind its mirror image.
        let simd = self.token();
        let mirror = !(step >> 31);
        let block = u32x16::simd_from(simd, u32::MAX) >> (31 - Self::POINT + 1 - level);
        let left = (self ^ mirror).bitcast::<u32x16<S>>() & block;
        let inverse = u64x8::simd_from(simd, u64::from(inverse));
        let left = left.bitcast::<u64x8<S>>();
        let (even, odd) = ((left & LOW) * inverse, (left >> 32) * inverse);
        ((even >> (Self::POINT + 20)) | ((odd >> (Self::POINT + 20)) << 32)).bitcast()
    }
    #[inline(always)]
    fn weighted(self, weight: i32x16<S>) -> Self {
        Products::of(self, weight).rounded(Self::POINT)
    }
    #[inline(always)]
    fn rescaled(self, exponent: i32) -> Self {
        if exponent >= 32 {
            return Self::simd_from(self.token(), 0);
        }
        if exponent >= 0 {
            return self << exponent as u32;
        }
        let halves = self >> (exponent.unsigned_abs().min(32) - 1);
        (halves >> 1) + (halves & 1)
    }
    #[inline(always)]
    fn reduced(self, places: u32x16<S>) -> i32x16<S> {
        let halves = self >> (places - 1).bitcast::<Self>();
        (halves >> 1) + (halves & 1)
    }
    #[inline(always)]
    fn scaled_down(self, places: i32x16<S>) -> Self {
        let down = self.reduced(places.max(1).bitcast());
        places.simd_gt(0).select(down, self << (-places).max(0))
    }
    #[inline(always)]
    fn widened(words: i32x16<S>) -> Self {
        words
    }
}

/// The lower half of a word of 64 bits.
const LOW: u64 = u32::MAX as u64;

/// Products of 32-bit words with all their bits: of the even lanes, and of the odd lanes. Even and
/// odd lanes need no moves between lanes, as lower and upper ones would.
#[derive(Clone, Copy)]
pub struct Products<S: Simd>(i64x8<S>, i64x8<S>);

impl<S: Simd> Products<S> {
    /// `a·b`.
    #[inline(always)]
    pub fn of(a: i32x16<S>, b: i32x16<S>) -> Self {
        let (a, b) = (a.bitcast::<i64x8<S>>(), b.bitcast::<i64x8<S>>());
        Self(((a << 32) >> 32) * ((b << 32) >> 32), (a >> 32) * (b >> 32))
    }

    /// Divided by 2^places, 1 to 32 places, rounded to nearest, ties upward; outcomes have 32 bits.
    #[inline(always)]
    pub fn rounded(self, places: u32) -> i32x16<S> {
        let half = 1_i64 << (places - 1);
        let even = ((self.0 + half) >> places).bitcast::<u64x8<S>>() & LOW;
        let odd = ((self.1 + half) << (32 - places)).bitcast::<u64x8<S>>() & !LOW;
        (even | odd).bitcast()
    }
}

impl<S: Simd> Add for Products<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}
