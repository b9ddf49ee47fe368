//! The sweep world: any width, point, rounding and overflow per register, chosen at run time.
//!
//! Words are left-aligned in 64 bits, so that a wrapping addition of the containers *is* an
//! addition modulo 2^width and keeps order. Each word carries its format, and a flag that stays
//! set once its value, or one it was made from, has overflowed: the processor counts and locates
//! those at the wires.

use std::cmp::Ordering;
use std::ops::{Add, Neg, Sub};

use super::format::hash;
use super::{
    Cell, Divide, Enter, Fixed, Load, Multiply, Overflow, Ratio, Readout, Register, Rescale,
    Rounding, Site, Table, Word, World, array,
};

/// Format of a sweep register.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SweepFormat {
    /// Bits in all, sign included, 2..=64.
    pub width: u8,
    /// Bits after the point, at most `width`.
    pub point: u8,
    /// Rounding of results that have more bits.
    pub rounding: Rounding,
    /// What happens to results that are too large.
    pub overflow: Overflow,
    /// Seed of stochastic rounding.
    pub seed: u32,
}

/// A left-aligned word that carries its format.
#[derive(Clone, Copy, Debug)]
pub struct SweepWord {
    aligned: i64,
    format: SweepFormat,
    overflowed: bool,
}

impl SweepFormat {
    fn spare(self) -> u32 {
        64 - u32::from(self.width)
    }

    /// The word of an integer number of last bits, wrapped or saturated into the width.
    fn word(self, bits: i128, overflowed: bool) -> SweepWord {
        let limit = 1_i128 << (self.width - 1);
        let fits = (-limit..limit).contains(&bits);
        let kept = match self.overflow {
            Overflow::Saturate => bits.clamp(-limit, limit - 1),
            Overflow::Wrap => bits,
        };
        SweepWord {
            aligned: (kept << self.spare()) as i64,
            format: self,
            overflowed: overflowed || !fits,
        }
    }

    /// Random bits of a place.
    fn random(self, site: Site) -> u64 {
        let place = u64::from(site.line) << 32 | u64::from(site.column);
        let operation = u64::from(site.operation) << 8 | site.register as u64;
        hash(hash(u64::from(self.seed), place), operation)
    }

    fn rounded(self, value: i128, places: u32, site: Site, overflowed: bool) -> SweepWord {
        let bits = self.rounding.shift_right(value, places, || self.random(site));
        self.word(bits, overflowed)
    }
}

impl SweepWord {
    fn bits(self) -> i128 {
        i128::from(self.aligned >> self.format.spare())
    }

    fn point(self) -> u32 {
        u32::from(self.format.point)
    }

    fn with(self, bits: i128) -> Self {
        self.format.word(bits, self.overflowed)
    }

    fn sum(self, other: Self, bits: i128) -> Self {
        // Registers that meet in an adder have one binary point; the wider one takes the result.
        debug_assert_eq!(self.format.point, other.format.point);
        self.format.word(bits, self.overflowed || other.overflowed)
    }

    /// Registers of different points are compared with their points aligned.
    fn order(self, other: Self) -> Ordering {
        let point = self.point().max(other.point());
        let align = |word: Self| word.bits() << (point - word.point());
        align(self).cmp(&align(other))
    }

    /// Of the entry nearest to this argument.
    fn address(self, log2: u32) -> usize {
        let places = self.point() as i32 - log2 as i32;
        let bits = self.bits().max(0);
        if places <= 0 {
            (bits << -places) as usize
        } else {
            ((bits + (1 << (places - 1))) >> places) as usize
        }
    }
}

impl Add for SweepWord {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.sum(other, self.bits() + other.bits())
    }
}

impl Sub for SweepWord {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.sum(other, self.bits() - other.bits())
    }
}

impl Neg for SweepWord {
    type Output = Self;
    fn neg(self) -> Self {
        self.with(-self.bits())
    }
}

impl Word for SweepWord {
    type Format = SweepFormat;

    fn zero(format: SweepFormat) -> Self {
        format.word(0, false)
    }

    fn shift_floor(self, places: u32) -> Self {
        self.with(self.bits() >> places.min(126))
    }

    fn shift_toward_zero(self, places: u32) -> Self {
        let bits = Rounding::TowardZero.shift_right(self.bits(), places, || 0);
        self.with(bits)
    }

    fn shift_left(self, places: u32) -> Self {
        self.with(self.bits() << places.min(63))
    }

    fn magnitude(self) -> Self {
        self.with(self.bits().abs())
    }

    fn is_below(self, other: Self, _: Site) -> bool {
        self.order(other).is_lt()
    }

    fn is_positive(self, _: Site) -> bool {
        self.aligned > 0
    }

    fn is_negative(self, _: Site) -> bool {
        self.aligned < 0
    }

    fn lesser(self, other: Self) -> Self {
        if other.order(self).is_lt() { other } else { self }
    }

    fn greater(self, other: Self) -> Self {
        if other.order(self).is_gt() { other } else { self }
    }

    fn is_exactly_zero(self) -> bool {
        self.aligned == 0
    }

    fn leading_one(self, _: Site) -> i32 {
        127 - self.bits().unsigned_abs().leading_zeros() as i32 - self.point() as i32
    }

    fn overflowed(self) -> bool {
        self.overflowed
    }
}

impl Rescale<SweepWord> for SweepWord {
    fn rescale(self, exponent: i32, format: SweepFormat, site: Site) -> SweepWord {
        let places = self.point() as i32 - i32::from(format.point) - exponent;
        if places >= 0 {
            format.rounded(self.bits(), places as u32, site, self.overflowed)
        } else {
            format.word(self.bits() << (-places).min(63), self.overflowed)
        }
    }

    fn rescale_nearest(self, exponent: i32, format: SweepFormat, site: Site) -> SweepWord {
        let nearest = SweepFormat { rounding: Rounding::Nearest, ..format };
        let word = self.rescale(exponent, nearest, site);
        SweepWord { format, ..word }
    }
}

impl Cell for SweepWord {
    fn cell(self, _: Site) -> i32 {
        (self.bits() >> self.point()) as i32
    }

    fn fraction(self) -> Self {
        // The value one is not a word of a register without integer bits, its fraction is.
        self.with(self.bits() & ((1 << self.point()) - 1))
    }

    fn nearest(self, _: Site) -> i32 {
        ((self.bits() + ((1 << self.point()) >> 1)) >> self.point()) as i32
    }

    fn fraction_from_midpoint(self) -> Self {
        self.with((self.bits() + ((1 << self.point()) >> 1)) & ((1 << self.point()) - 1))
    }

    fn look_up<T: Word>(self, table: &Table<T>, _: Site) -> T {
        table.at(self.address(table.log2()))
    }

    fn look_up_mirrored<T: Word, const N: usize>(
        self,
        tables: [&Table<T>; N],
        _: Site,
    ) -> [[T; 2]; N] {
        tables.map(|table| table.both_ways(self.address(table.log2())))
    }
}

impl Multiply<SweepWord> for SweepWord {
    fn multiply(self, by: Self, site: Site) -> Self {
        let overflowed = self.overflowed || by.overflowed;
        self.format.rounded(self.bits() * by.bits(), by.point(), site, overflowed)
    }

    fn multiply_two(self, by: Self, other: Self, other_by: Self, site: Site) -> Self {
        let overflowed =
            self.overflowed || by.overflowed || other.overflowed || other_by.overflowed;
        let product = (self.bits() * by.bits()).wrapping_add(other.bits() * other_by.bits());
        self.format.rounded(product, by.point(), site, overflowed)
    }
}

impl Divide<SweepWord> for SweepWord {
    fn divide_array(
        self,
        denominator: Self,
        ratio: Ratio<SweepFormat>,
        _: Site,
    ) -> Option<SweepWord> {
        let point = u32::from(ratio.format.point);
        let shift =
            ratio.exponent + point as i32 + denominator.point() as i32 - self.point() as i32;
        let bits = ratio.range + point + 1;
        let overflowed = self.overflowed || denominator.overflowed;
        let quotient = array::non_restoring(self.bits(), denominator.bits(), shift, bits);
        quotient.map(|quotient| ratio.format.word(quotient, overflowed))
    }
}

impl Load for SweepWord {
    fn load(value: f64, format: SweepFormat) -> Option<Self> {
        // Exact in f64: a power of two; ties to even, as stock registers are loaded.
        let bits = libm::rint(libm::scalbn(value, i32::from(format.point)));
        let limit = libm::exp2(f64::from(format.width) - 1.0);
        (-limit <= bits && bits < limit).then(|| format.word(bits as i128, false))
    }

    fn load_raw(bits: i64, format: SweepFormat) -> Option<Self> {
        let limit = 1_i128 << (format.width - 1);
        let bits = i128::from(bits);
        (-limit..limit).contains(&bits).then(|| format.word(bits, false))
    }
}

impl Readout for SweepWord {
    fn value(self) -> f64 {
        libm::scalbn(self.bits() as f64, -i32::from(self.format.point))
    }

    fn raw(self) -> Option<i64> {
        Some(self.bits() as i64)
    }
}

impl Enter for SweepWord {
    /// Equal to k additions where the format wraps; saturating sweeps have no direct entry.
    fn after(self, step: Self, k: u32) -> Self {
        self.sum(step, self.bits() + step.bits() * i128::from(k))
    }
}

/// The world of [`SweepWord`]: one format per register.
#[derive(Clone, Copy, Debug)]
pub struct Sweep {
    formats: [SweepFormat; Register::COUNT],
}

impl Sweep {
    /// A sweep world from the format of each register.
    pub fn new(format: impl Fn(Register) -> SweepFormat) -> Self {
        Self { formats: std::array::from_fn(|at| format(Register::ALL[at])) }
    }

    /// Format of a register.
    pub fn format(&self, register: Register) -> SweepFormat {
        self.formats[register as usize]
    }

    /// Whether every register wraps, so that recurrences may be entered anywhere.
    pub fn wraps(&self) -> bool {
        self.formats.iter().all(|format| format.overflow == Overflow::Wrap)
    }
}

impl World for Sweep {
    type View = SweepWord;
    type Ground = SweepWord;
    type Height = SweepWord;
    type Weight = SweepWord;
    type Tone = SweepWord;

    fn name(&self) -> &'static str {
        "sweep"
    }
    fn view(&self, register: Register) -> SweepFormat {
        self.format(register)
    }
    fn ground(&self, register: Register) -> SweepFormat {
        self.format(register)
    }
    fn height(&self, register: Register) -> SweepFormat {
        self.format(register)
    }
    fn weight(&self, register: Register) -> SweepFormat {
        self.format(register)
    }
    fn tone(&self, register: Register) -> SweepFormat {
        self.format(register)
    }
    fn fixed(&self, register: Register) -> Option<Fixed> {
        let format = self.format(register);
        Some(Fixed { width: format.width.into(), point: format.point.into() })
    }
}
