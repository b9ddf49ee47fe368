//! Number worlds. This module imports nothing of ours.
//!
//! A [`Word`] is what a register holds. It adds, subtracts, compares and shifts; it does not
//! multiply or divide, so a unit that is generic over words cannot either:
//!
//! ```compile_fail
//! fn a_multiplying_projector<W: terraline::word::World>(x: W::View, y: W::View) -> W::View {
//!     x * y // no `Mul` on a word
//! }
//! ```
//!
//! Nor does it decide anything without saying where: comparisons, leading ones, indices of cells and
//! look-ups in tables are named operations that take a [`Site`], so that a world which knows how far
//! its words may err sees every decision.
//!
//! What a unit may do beyond that is in its trait bounds, which are its bill of materials:
//!
//! | trait | who asks for it |
//! |---|---|
//! | [`Word`] | every unit |
//! | [`Rescale`] | units that pass values from one register to another of another class |
//! | [`Cell`] | units that address the map or a [`Table`] |
//! | [`Multiply`] | interpolator, light, ramp, mixer, checker (shift-and-add multipliers, counted) |
//! | [`Divide`] | divider (non-restoring array, counted) |
//! | [`Load`] | set-up only: the one door from `f64` |
//! | [`Readout`] | sinks and studies only: the way back |
//! | [`Enter`] | the fast engine only: `start + k·step` as one operation |
//!
//! A [`World`] is a value that names one word type per register class and the format of each
//! register. Worlds: [`real::Real`], [`stock::Narrow`] and [`stock::Wide`], [`sweep::Sweep`],
//! [`tally::Tally`] around any of them.

pub mod array;
pub mod format;
pub mod real;
pub mod register;
pub mod stock;
pub mod sweep;
mod table;
pub mod tally;

use std::fmt::Debug;
use std::ops::{Add, Neg, Sub};

pub use format::{Fixed, Overflow, Rounding};
pub use register::{Class, Register, Registers};
pub use table::Table;

/// What a register holds: a value with additions, comparisons and shifts, and nothing else.
pub trait Word:
    Copy + Add<Output = Self> + Sub<Output = Self> + Neg<Output = Self> + Debug + Send + Sync + 'static
{
    /// What is known of a register's format at run time: `()` where the type says it all.
    type Format: Copy + Debug + Send + Sync;

    /// Zero in a register of this format.
    fn zero(format: Self::Format) -> Self;

    /// Arithmetic shift right: bits that leave are dropped (floor).
    #[must_use]
    fn shift_floor(self, places: u32) -> Self;

    /// Shift right, rounded toward zero; zero once `places` reaches the width.
    #[must_use]
    fn shift_toward_zero(self, places: u32) -> Self;

    /// Shift left; what does not fit is lost as in an addition of the word to itself.
    #[must_use]
    fn shift_left(self, places: u32) -> Self;

    /// Absolute value (a conditional negation).
    #[must_use]
    fn magnitude(self) -> Self;

    /// `self + (to − self)/2^places`, the quotient rounded toward zero.
    #[inline(always)]
    #[must_use]
    fn toward(self, to: Self, places: u32) -> Self {
        self + (to - self).shift_toward_zero(places)
    }

    /// Whether this word is less than another one.
    fn is_below(self, other: Self, site: Site) -> bool;

    /// Whether it is greater than zero: the sign bit and a test for zero, no adder.
    fn is_positive(self, site: Site) -> bool;

    /// Whether it is less than zero: the sign bit.
    fn is_negative(self, site: Site) -> bool;

    /// Place of the leading one of the magnitude: e with `2^e <= |value| < 2^(e+1)`. For zero,
    /// one place below the last bit (very negative in the real world).
    fn leading_one(self, site: Site) -> i32;

    /// The lesser of two words: a clamp, which decides nothing.
    #[must_use]
    fn lesser(self, other: Self) -> Self;

    /// The greater of two words.
    #[must_use]
    fn greater(self, other: Self) -> Self;

    /// Whether it is zero and nothing else in its world's knowledge: then no adder is fitted for it.
    fn is_exactly_zero(self) -> bool;

    /// This word where it may also be another one. A world of bounds widens it; in all others a word
    /// is what it is.
    #[must_use]
    fn hull(self, _other: Self) -> Self {
        self
    }

    /// Whether this value, or one it was made from, has overflowed its register. Only worlds with
    /// run-time formats can: the ranges of stock registers are proved by the plan.
    fn overflowed(self) -> bool {
        false
    }
}

/// Where an operation happens: the address of its random bits under stochastic rounding, and the name
/// of a decision.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Site {
    /// The register that takes the result; of a decision, the one that it looks at, or whose value a
    /// position is compared with.
    pub register: Register,
    /// Scan line from the top.
    pub line: u32,
    /// Column from the left.
    pub column: u32,
    /// Which operation on that pixel: eight numbers for each sample of the ray and each bisection
    /// step.
    pub operation: u32,
}

impl Site {
    /// The pixel's first operation.
    #[inline(always)]
    pub fn pixel(line: u32, column: u32) -> Self {
        Self { register: Register::ViewX, line, column, operation: 0 }
    }

    /// The same place, another register.
    #[inline(always)]
    #[must_use]
    pub fn at(self, register: Register) -> Self {
        Self { register, ..self }
    }

    /// The same register, another operation.
    #[inline(always)]
    #[must_use]
    pub fn step(self, operation: u32) -> Self {
        Self { operation, ..self }
    }
}

/// A register of one class feeding a register of another: `value · 2^exponent`, rounded.
pub trait Rescale<To: Word>: Word {
    /// The value times a power of two (wiring and a shift), rounded to the nearest word of `To`
    /// (ties upward in stock; as the format says in a sweep).
    fn rescale(self, exponent: i32, format: To::Format, site: Site) -> To;

    /// The same, rounded to nearest whatever the format says: where a bound of the result is part
    /// of the algorithm.
    fn rescale_nearest(self, exponent: i32, format: To::Format, site: Site) -> To {
        self.rescale(exponent, format, site)
    }
}

/// A position over a grid: integer part and fraction.
pub trait Cell: Word {
    /// Index of the cell: floor.
    fn cell(self, site: Site) -> i32;

    /// Value minus floor, in `[0, 1)`.
    #[must_use]
    fn fraction(self) -> Self;

    /// Index of the nearest node, ties upward: `floor(value + 1/2)`.
    fn nearest(self, site: Site) -> i32;

    /// `value + 1/2 − nearest`, in `[0, 1)`: the place between the midpoints around a node.
    #[must_use]
    fn fraction_from_midpoint(self) -> Self;

    /// The entry of a table nearest to this argument; of one beyond the table, the last.
    fn look_up<T: Word>(self, table: &Table<T>, site: Site) -> T;

    /// From each of some tables of one size over `[0, 1]` the entries nearest to this argument and to
    /// one minus it: one address, read forwards and backwards.
    fn look_up_mirrored<T: Word, const N: usize>(
        self,
        tables: [&Table<T>; N],
        site: Site,
    ) -> [[T; 2]; N];
}

/// A named multiplier made of shifts and adders; one rounding of the exact product.
///
/// What units make of it is an operation each, composed here for every world alike. A word that occurs
/// twice in one of them is the same word twice, which a world of bounds may use.
pub trait Multiply<By: Word>: Word {
    /// `self · by`, rounded into the format of `self`.
    #[must_use]
    fn multiply(self, by: By, site: Site) -> Self;

    /// `self · by + other · other_by`, rounded once into the format of `self`.
    #[must_use]
    fn multiply_two(self, by: By, other: Self, other_by: By, site: Site) -> Self;

    /// `self + (to − self)·weight`, rounded once: it stays between the two for weights in `[0, 1]`.
    #[inline(always)]
    #[must_use]
    fn lerp(self, to: Self, weight: By, site: Site) -> Self {
        self + (to - self).multiply(weight, site)
    }

    /// `self + (a − self)·weight_a + (b − self)·weight_b`, rounded once.
    #[inline(always)]
    #[must_use]
    fn lerp_two(self, [a, b]: [Self; 2], weights: [By; 2], site: Site) -> Self {
        self + (a - self).multiply_two(weights[0], b - self, weights[1], site)
    }

    /// `(self − other)·by`, rounded once.
    #[inline(always)]
    #[must_use]
    fn multiply_difference(self, other: Self, by: By, site: Site) -> Self {
        (self - other).multiply(by, site)
    }

    /// `(self − a)·by_a + (self − b)·by_b`, rounded once.
    #[inline(always)]
    #[must_use]
    fn multiply_differences(self, [a, b]: [Self; 2], by: [By; 2], site: Site) -> Self {
        (self - a).multiply_two(by[0], self - b, by[1], site)
    }

    /// Piecewise linear functions of a place, `start + rise·fraction` each, rounded once, by the
    /// starts and rises of all segments between whole numbers from zero on. From the end of the last
    /// segment on, they keep its end.
    #[inline(always)]
    fn piecewise_linear<const N: usize>(
        segments: &[[(Self, Self); N]],
        place: By,
        site: Site,
    ) -> [Self; N]
    where
        By: Cell,
    {
        let last = segments.len() as i32 - 1;
        let cell = place.cell(site);
        let segment = &segments[cell.clamp(0, last) as usize];
        std::array::from_fn(|at| {
            let (start, rise) = segment[at];
            if cell > last {
                start + rise
            } else {
                start + rise.multiply(place.fraction(), site.step(site.operation + at as u32))
            }
        })
    }
}

/// Exponent and range of a ratio `numerator / denominator · 2^exponent`.
#[derive(Clone, Copy, Debug)]
pub struct Ratio<F> {
    /// Power of two on the ratio.
    pub exponent: i32,
    /// Quotients q with `-2^range <= q < 2^range` are in range.
    pub range: u32,
    /// Format of the quotient.
    pub format: F,
}

/// The ratio unit's arithmetic: floor of the exact ratio, by two ways that agree in every bit.
pub trait Divide<Quotient: Word>: Word {
    /// By the non-restoring array, one quotient bit per stage. The denominator is positive.
    /// `None` where the quotient is out of range.
    fn divide_array(
        self,
        denominator: Self,
        ratio: Ratio<Quotient::Format>,
        site: Site,
    ) -> Option<Quotient>;

    /// The same result by the host's own division, for the fast engine.
    fn divide_direct(
        self,
        denominator: Self,
        ratio: Ratio<Quotient::Format>,
        site: Site,
    ) -> Option<Quotient> {
        self.divide_array(denominator, ratio, site)
    }
}

/// Set-up only: the one door from `f64` into a register.
pub trait Load: Word {
    /// The word nearest to a value (ties to even), or `None` where it does not fit or is not
    /// finite.
    fn load(value: f64, format: Self::Format) -> Option<Self>;

    /// The word of these bits, or `None` where the register has fewer bits, or none at all.
    fn load_raw(bits: i64, format: Self::Format) -> Option<Self>;
}

/// Sinks and studies only: what a register says.
pub trait Readout: Word {
    /// The value as `f64`; exact for words of up to 53 bits.
    fn value(self) -> f64;

    /// The register's bits as an integer, where there are bits.
    fn raw(self) -> Option<i64>;
}

/// The fast engine only: enter a recurrence at step k.
pub trait Enter: Word {
    /// `self + k·step`, which in wrapping fixed point *is* k additions.
    #[must_use]
    fn after(self, step: Self, k: u32) -> Self;
}

/// The fast engine only: a word as the integer that it is, for arithmetic on rays that the machine
/// does not have. Stock words have it.
pub trait Lane: Enter {
    /// The integer.
    type Int;
    /// Fraction bits.
    const FRACTION: u32;

    /// The word's bits.
    fn int(self) -> Self::Int;

    /// The word of these bits.
    fn of_int(int: Self::Int) -> Self;
}

/// A number world: a word type per register class, and the format of every register.
pub trait World: Copy + Debug + Send + Sync + 'static {
    /// View vectors and denominators: linear in the screen.
    type View: Word + Rescale<Self::Ground> + Rescale<Self::Height> + Rescale<Self::Tone>;
    /// Horizontal positions in cells.
    type Ground: Cell + Rescale<Self::Weight>;
    /// Heights.
    type Height: Word + Rescale<Self::Tone>;
    /// Kernel weights and slopes.
    type Weight: Word;
    /// Light and colour.
    type Tone: Cell;

    /// Short name for reports.
    fn name(&self) -> &'static str;
    /// Format of a register of class view.
    fn view(&self, register: Register) -> <Self::View as Word>::Format;
    /// Format of a register of class ground.
    fn ground(&self, register: Register) -> <Self::Ground as Word>::Format;
    /// Format of a register of class height.
    fn height(&self, register: Register) -> <Self::Height as Word>::Format;
    /// Format of a register of class weight.
    fn weight(&self, register: Register) -> <Self::Weight as Word>::Format;
    /// Format of a register of class tone.
    fn tone(&self, register: Register) -> <Self::Tone as Word>::Format;
    /// Width and point of a register, `None` where it is a floating-point number.
    fn fixed(&self, register: Register) -> Option<Fixed>;
}

/// A world whose heights can be interpolated: what the interpolator asks for.
pub trait Interpolating: World<Height: Multiply<Self::Weight>> {}
impl<W: World<Height: Multiply<W::Weight>>> Interpolating for W {}

/// A world whose colours can be mixed: what light, ramp, mixer and checker ask for.
pub trait Shading: World<Tone: Multiply<Self::Tone>> {}
impl<W: World<Tone: Multiply<W::Tone>>> Shading for W {}

/// A world with a ratio unit: what the divider asks for.
pub trait Dividing: World<View: Divide<Self::Ground>> {}
impl<W: World<View: Divide<W::Ground>>> Dividing for W {}

/// A world that can be loaded and read: what set-up, sinks and studies ask for.
pub trait Open:
    World<
        View: Load + Readout,
        Ground: Load + Readout,
        Height: Load + Readout,
        Weight: Load + Readout,
        Tone: Load + Readout,
    >
{
}
impl<W> Open for W where
    W: World<
            View: Load + Readout,
            Ground: Load + Readout,
            Height: Load + Readout,
            Weight: Load + Readout,
            Tone: Load + Readout,
        >
{
}

/// Everything that a complete processor asks of its world.
pub trait Complete: Interpolating + Shading + Dividing + Open {}
impl<W: Interpolating + Shading + Dividing + Open> Complete for W {}
