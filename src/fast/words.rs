//! Vectors of sixteen words of a stock world, one per ray of a packet.
//!
//! Explicit vectors, where most loops of this project leave them to the compiler: it unrolls loops
//! over so few lanes before it would vectorise them.

use std::ops::{Add, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{i32x4, i32x16, i64x4, i64x8, mask32x16, u32x16, u64x8};

use crate::word::stock::{Narrow, Wide};
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

impl Packed for Narrow {
    type Int = i32;
    type Words<S: Simd> = i32x16<S>;
}

impl Packed for Wide {
    type Int = i64;
    type Words<S: Simd> = Pair<S>;
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
    /// The same, so many times per lane.
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
        let q = [four(simd, &w, 0), four(simd, &w, 4), four(simd, &w, 8), four(simd, &w, 12)];
        let (even, odd) = (q[0].unzip_low(q[1]), q[0].unzip_high(q[1]));
        let (later_even, later_odd) = (q[2].unzip_low(q[3]), q[2].unzip_high(q[3]));
        [
            even.unzip_low(later_even),
            odd.unzip_low(later_odd),
            even.unzip_high(later_even),
            odd.unzip_high(later_odd),
        ]
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
fn transposed<S: Simd>(simd: S, words: &[[i64; 4]; LANES], from: usize) -> [i64x8<S>; 4] {
    let q = [
        two(simd, words[from], words[from + 1]),
        two(simd, words[from + 2], words[from + 3]),
        two(simd, words[from + 4], words[from + 5]),
        two(simd, words[from + 6], words[from + 7]),
    ];
    let (even, odd) = (q[0].unzip_low(q[1]), q[0].unzip_high(q[1]));
    let (later_even, later_odd) = (q[2].unzip_low(q[3]), q[2].unzip_high(q[3]));
    [
        even.unzip_low(later_even),
        odd.unzip_low(later_odd),
        even.unzip_high(later_even),
        odd.unzip_high(later_odd),
    ]
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
        let [a, b, c, d] = transposed(simd, &words, 0);
        let [e, f, g, h] = transposed(simd, &words, LANES / 2);
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
