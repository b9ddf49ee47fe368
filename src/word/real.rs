//! The real world: the same units in `f64`. Oracle minus real is the algorithm's own error, real
//! minus fixed is the quantisation.

use std::ops::{Add, Neg, Sub};

use super::{
    Cell, Divide, Fixed, Load, Multiply, Ratio, Readout, Register, Rescale, Site, Table, Word,
    World,
};

/// An `f64` without multiplication. The field is private, so that no unit can reach it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RealWord(f64);

impl Add for RealWord {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for RealWord {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Neg for RealWord {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

fn power(exponent: i32) -> f64 {
    libm::exp2(f64::from(exponent))
}

impl Word for RealWord {
    type Format = ();

    #[inline(always)]
    fn zero((): ()) -> Self {
        Self(0.0)
    }

    fn shift_floor(self, places: u32) -> Self {
        Self(self.0 / power(places as i32))
    }

    fn shift_toward_zero(self, places: u32) -> Self {
        self.shift_floor(places)
    }

    fn shift_left(self, places: u32) -> Self {
        Self(self.0 * power(places as i32))
    }

    fn magnitude(self) -> Self {
        Self(self.0.abs())
    }

    fn is_below(self, other: Self, _: Site) -> bool {
        self.0 < other.0
    }

    fn is_positive(self, _: Site) -> bool {
        self.0 > 0.0
    }

    fn is_negative(self, _: Site) -> bool {
        self.0 < 0.0
    }

    fn leading_one(self, _: Site) -> i32 {
        // frexp gives a mantissa in [1/2, 1); zero has no leading one.
        if self.0 == 0.0 { -2000 } else { libm::frexp(self.0.abs()).1 - 1 }
    }

    fn lesser(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    fn greater(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    fn is_exactly_zero(self) -> bool {
        self.0 == 0.0
    }
}

impl Rescale<RealWord> for RealWord {
    fn rescale(self, exponent: i32, (): (), _: Site) -> RealWord {
        Self(self.0 * power(exponent))
    }
}

impl Cell for RealWord {
    fn cell(self, _: Site) -> i32 {
        self.0.floor() as i32
    }

    fn fraction(self) -> Self {
        Self(self.0 - self.0.floor())
    }

    fn nearest(self, _: Site) -> i32 {
        (self.0 + 0.5).floor() as i32
    }

    fn fraction_from_midpoint(self) -> Self {
        Self(self.0 + 0.5).fraction()
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

impl RealWord {
    /// Of the entry nearest to this argument.
    fn address(self, log2: u32) -> usize {
        (self.0 * power(log2 as i32) + 0.5).floor() as usize
    }
}

impl Multiply<RealWord> for RealWord {
    fn multiply(self, by: Self, _: Site) -> Self {
        Self(self.0 * by.0)
    }

    fn multiply_two(self, by: Self, other: Self, other_by: Self, _: Site) -> Self {
        Self(self.0 * by.0 + other.0 * other_by.0)
    }
}

impl Divide<RealWord> for RealWord {
    fn divide_array(self, denominator: Self, ratio: Ratio<()>, _: Site) -> Option<Self> {
        let quotient = self.0 / denominator.0 * power(ratio.exponent);
        let limit = power(ratio.range as i32);
        (-limit <= quotient && quotient < limit).then_some(Self(quotient))
    }
}

impl Load for RealWord {
    fn load(value: f64, (): ()) -> Option<Self> {
        value.is_finite().then_some(Self(value))
    }

    fn load_raw(_: i64, (): ()) -> Option<Self> {
        None
    }
}

impl Readout for RealWord {
    fn value(self) -> f64 {
        self.0
    }

    fn raw(self) -> Option<i64> {
        None
    }
}

/// The world of [`RealWord`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Real;

impl World for Real {
    type View = RealWord;
    type Ground = RealWord;
    type Height = RealWord;
    type Weight = RealWord;
    type Tone = RealWord;

    fn name(&self) -> &'static str {
        "real"
    }
    fn view(&self, _: Register) {}
    fn ground(&self, _: Register) {}
    fn height(&self, _: Register) {}
    fn weight(&self, _: Register) {}
    fn tone(&self, _: Register) {}
    fn fixed(&self, _: Register) -> Option<Fixed> {
        None
    }
}
