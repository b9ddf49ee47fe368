//! Vectors of 64-bit words.

use std::ops::{Add, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{i32x16, i64x4, i64x8, mask32x16, u32x16, u64x8};

use super::words::{LANES, Packed, Words, lanes, transposed};
use crate::word::stock::Wide;
use crate::word::{Lane as _, World};

impl Packed for Wide {
    type Int = i64;
    type Words<S: Simd> = Pair<S>;
}

/// Sixteen words of 64 bits.
#[derive(Clone, Copy)]
pub struct Pair<S: Simd>(i64x8<S>, i64x8<S>);

impl<S: Simd> Add for Pair<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl<S: Simd> Sub for Pair<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }
}

/// Two times four words side by side.
#[inline(always)]
fn two<S: Simd>(simd: S, first: [i64; 4], second: [i64; 4]) -> i64x8<S> {
    i64x4::simd_from(simd, first).combine(i64x4::simd_from(simd, second))
}

/// Half of [`Words::load_four`].
#[inline(always)]
fn four<S: Simd>(simd: S, words: &[[i64; 4]; LANES], from: usize) -> [i64x8<S>; 4] {
    transposed([
        two(simd, words[from], words[from + 1]),
        two(simd, words[from + 2], words[from + 3]),
        two(simd, words[from + 4], words[from + 5]),
        two(simd, words[from + 6], words[from + 7]),
    ])
}

/// Half of [`Words::steps_within`].
#[inline(always)]
fn steps_within<S: Simd>(
    word: i64x8<S>,
    step: i64x8<S>,
    level: u64x8<S>,
    inverse: u32,
) -> u64x8<S> {
    const POINT: u32 = <Wide as World>::Ground::FRACTION;
    let block = u64x8::simd_from(word.token(), u64::MAX) >> (64 - u64::from(POINT) - level);
    let left = (word ^ !(step >> 63)).bitcast::<u64x8<S>>() & block;
    (left * u64::from(inverse)) >> (POINT + 20)
}

/// Half of [`Words::scaled_down`].
#[inline(always)]
fn scaled_down<S: Simd>(words: i64x8<S>, places: i64x8<S>) -> i64x8<S> {
    let halves = words >> (places.max(1) - 1);
    places.simd_gt(0).select((halves >> 1) + (halves & 1), words << (-places).max(0))
}

impl<S: Simd> Pair<S> {
    #[inline(always)]
    fn magnitude(self) -> Self {
        Self(self.0.max(-self.0), self.1.max(-self.1))
    }
}

impl<S: Simd> Words<S> for Pair<S> {
    type Int = i64;
    const POINT: u32 = <Wide as World>::Ground::FRACTION;

    #[inline(always)]
    fn load(simd: S, words: [i64; LANES]) -> Self {
        let (low, high) = words.split_at(LANES / 2);
        Self(i64x8::from_slice(simd, low), i64x8::from_slice(simd, high))
    }
    #[inline(always)]
    fn load_four(simd: S, words: [[i64; 4]; LANES]) -> [Self; 4] {
        let [a, b, c, d] = four(simd, &words, 0);
        let [e, f, g, h] = four(simd, &words, LANES / 2);
        [Self(a, e), Self(b, f), Self(c, g), Self(d, h)]
    }
    #[inline(always)]
    fn splat(simd: S, word: i64) -> Self {
        let words = i64x8::simd_from(simd, word);
        Self(words, words)
    }
    #[inline(always)]
    fn store(self) -> [i64; LANES] {
        let mut words = [0; LANES];
        let (low, high) = words.split_at_mut(LANES / 2);
        self.0.store_slice(low);
        self.1.store_slice(high);
        words
    }
    #[inline(always)]
    fn select(mask: mask32x16<S>, yes: Self, no: Self) -> Self {
        let (low, high) = mask.widen();
        Self(low.select(yes.0, no.0), high.select(yes.1, no.1))
    }
    #[inline(always)]
    fn less(self, than: Self) -> mask32x16<S> {
        self.0.simd_lt(than.0).narrow(self.1.simd_lt(than.1))
    }
    #[inline(always)]
    fn range(self, of: mask32x16<S>) -> (i64, i64) {
        let simd = self.0.token();
        let least = Self::select(of, self, Self::splat(simd, i64::MAX));
        let most = Self::select(of, self, Self::splat(simd, i64::MIN));
        (least.0.min(least.1).reduce_min(), most.0.max(most.1).reduce_max())
    }
    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        Self(self.0.min(other.0), self.1.min(other.1))
    }
    #[inline(always)]
    fn after(self, step: Self, k: u32x16<S>) -> Self {
        let (low, high) = k.widen();
        Self(
            self.0 + step.0 * low.bitcast::<i64x8<S>>(),
            self.1 + step.1 * high.bitcast::<i64x8<S>>(),
        )
    }
    #[inline(always)]
    fn halved(self, times: u32) -> Self {
        Self(self.0 >> times.min(63), self.1 >> times.min(63))
    }
    #[inline(always)]
    fn halved_each(self, times: u32x16<S>) -> Self {
        let (low, high) = times.min(63).widen();
        Self(self.0 >> low.bitcast::<i64x8<S>>(), self.1 >> high.bitcast::<i64x8<S>>())
    }
    #[inline(always)]
    fn cell(self) -> i32x16<S> {
        (self.0 >> Self::POINT).narrow(self.1 >> Self::POINT)
    }
    #[inline(always)]
    fn leading_one(of: [Self; 3]) -> i32x16<S> {
        let simd = of[0].0.token();
        let [x, y, z] = of;
        let (x, y, z) = (x.magnitude(), y.magnitude(), z.magnitude());
        let bits = Self(x.0 | y.0 | z.0, x.1 | y.1 | z.1).store();
        let zeros = lanes!(lane => bits[lane].leading_zeros() as i32);
        63 - Self::POINT as i32 - i32x16::simd_from(simd, zeros)
    }
    #[inline(always)]
    fn fraction(self) -> i32x16<S> {
        self.0.narrow(self.1) & ((1 << Self::POINT) - 1)
    }
    #[inline(always)]
    fn coarse(self, places: u32) -> i32x16<S> {
        (self.0 >> places).saturating_narrow(self.1 >> places)
    }
    #[inline(always)]
    fn coarse_magnitude(self, places: u32) -> u32x16<S> {
        let Self(low, high) = self.magnitude();
        (low >> places).saturating_narrow(high >> places).bitcast()
    }
    #[inline(always)]
    fn steps_within(self, step: Self, level: u32x16<S>, inverse: u32) -> u32x16<S> {
        let (low, high) = level.widen();
        steps_within(self.0, step.0, low, inverse)
            .narrow(steps_within(self.1, step.1, high, inverse))
    }
    #[inline(always)]
    fn weighted(self, weight: i32x16<S>) -> Self {
        let (low, high) = weight.widen();
        let half = 1_i64 << (Self::POINT - 1);
        Self((self.0 * low + half) >> Self::POINT, (self.1 * high + half) >> Self::POINT)
    }
    #[inline(always)]
    fn rescaled(self, exponent: i32) -> Self {
        if exponent >= 64 {
            return Self::splat(self.0.token(), 0);
        }
        if exponent >= 0 {
            return Self(self.0 << exponent as u32, self.1 << exponent as u32);
        }
        let places = exponent.unsigned_abs().min(64) - 1;
        let (low, high) = (self.0 >> places, self.1 >> places);
        Self((low >> 1) + (low & 1), (high >> 1) + (high & 1))
    }
    #[inline(always)]
    fn reduced(self, places: u32x16<S>) -> i32x16<S> {
        let (low, high) = (places - 1).widen();
        let low = self.0 >> low.bitcast::<i64x8<S>>();
        let high = self.1 >> high.bitcast::<i64x8<S>>();
        ((low >> 1) + (low & 1)).narrow((high >> 1) + (high & 1))
    }
    #[inline(always)]
    fn scaled_down(self, places: i32x16<S>) -> Self {
        let (low, high) = places.widen();
        Self(scaled_down(self.0, low), scaled_down(self.1, high))
    }
    #[inline(always)]
    fn widened(words: i32x16<S>) -> Self {
        let (low, high) = words.widen();
        Self(low, high)
    }
}
