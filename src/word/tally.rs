//! The tally world: any other world, with its operations counted.
//!
//! Counts are kept per thread; [`counted`] runs a piece of work and returns what it did.

use std::cell::Cell as Counter;
use std::ops::{Add, Neg, Sub};

use super::{
    Cell, Divide, Fixed, Load, Multiply, Ratio, Readout, Register, Rescale, Site, Table, Word,
    World,
};

/// Operations of some work. Subtractions, negations and comparisons are additions to hardware.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Adders, subtractors, conditional negations and comparators used.
    pub additions: u64,
    /// Products, each by a shift-and-add multiplier.
    pub products: u64,
    /// Ratios, each by a divider array.
    pub ratios: u64,
    /// Shifts by a number of places that is not known at set-up.
    pub shifts: u64,
}

impl std::ops::AddAssign for Operations {
    fn add_assign(&mut self, other: Self) {
        self.additions += other.additions;
        self.products += other.products;
        self.ratios += other.ratios;
        self.shifts += other.shifts;
    }
}

thread_local! {
    static COUNTS: Counter<Operations> = const { Counter::new(Operations {
        additions: 0, products: 0, ratios: 0, shifts: 0,
    }) };
}

fn count(change: impl FnOnce(&mut Operations)) {
    let mut counts = COUNTS.get();
    change(&mut counts);
    COUNTS.set(counts);
}

fn count_addition() {
    count(|c| c.additions += 1);
}

/// Runs `work` on this thread and returns its result and the operations on tally words in it.
pub fn counted<T>(work: impl FnOnce() -> T) -> (T, Operations) {
    let before = COUNTS.replace(Operations::default());
    let result = work();
    (result, COUNTS.replace(before))
}

/// A word whose operations are counted.
#[derive(Clone, Copy, Debug)]
pub struct TallyWord<T>(T);

impl<T: Word> Add for TallyWord<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        count_addition();
        Self(self.0 + other.0)
    }
}

impl<T: Word> Sub for TallyWord<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        count_addition();
        Self(self.0 - other.0)
    }
}

impl<T: Word> Neg for TallyWord<T> {
    type Output = Self;
    fn neg(self) -> Self {
        count_addition();
        Self(-self.0)
    }
}

impl<T: Word> Word for TallyWord<T> {
    type Format = T::Format;

    fn zero(format: T::Format) -> Self {
        Self(T::zero(format))
    }
    fn shift_floor(self, places: u32) -> Self {
        count(|c| c.shifts += 1);
        Self(self.0.shift_floor(places))
    }
    fn shift_toward_zero(self, places: u32) -> Self {
        // The truncation of negative values costs an adder.
        count(|c| {
            c.shifts += 1;
            c.additions += 1;
        });
        Self(self.0.shift_toward_zero(places))
    }
    fn shift_left(self, places: u32) -> Self {
        count(|c| c.shifts += 1);
        Self(self.0.shift_left(places))
    }
    fn magnitude(self) -> Self {
        count_addition();
        Self(self.0.magnitude())
    }
    fn is_below(self, other: Self, site: Site) -> bool {
        count_addition();
        self.0.is_below(other.0, site)
    }
    fn is_positive(self, site: Site) -> bool {
        self.0.is_positive(site)
    }
    fn is_negative(self, site: Site) -> bool {
        self.0.is_negative(site)
    }
    fn leading_one(self, site: Site) -> i32 {
        self.0.leading_one(site)
    }
    fn lesser(self, other: Self) -> Self {
        count_addition();
        Self(self.0.lesser(other.0))
    }
    fn greater(self, other: Self) -> Self {
        count_addition();
        Self(self.0.greater(other.0))
    }
    fn is_exactly_zero(self) -> bool {
        self.0.is_exactly_zero()
    }
    fn hull(self, other: Self) -> Self {
        Self(self.0.hull(other.0))
    }
    fn overflowed(self) -> bool {
        self.0.overflowed()
    }
}

impl<T: Rescale<U>, U: Word> Rescale<TallyWord<U>> for TallyWord<T> {
    fn rescale(self, exponent: i32, format: U::Format, site: Site) -> TallyWord<U> {
        // The rounding's half bit is an addition.
        count(|c| {
            c.shifts += 1;
            c.additions += 1;
        });
        TallyWord(self.0.rescale(exponent, format, site))
    }

    fn rescale_nearest(self, exponent: i32, format: U::Format, site: Site) -> TallyWord<U> {
        count(|c| {
            c.shifts += 1;
            c.additions += 1;
        });
        TallyWord(self.0.rescale_nearest(exponent, format, site))
    }
}

impl<T: Cell> Cell for TallyWord<T> {
    fn cell(self, site: Site) -> i32 {
        self.0.cell(site)
    }
    fn fraction(self) -> Self {
        Self(self.0.fraction())
    }
    fn nearest(self, site: Site) -> i32 {
        count_addition();
        self.0.nearest(site)
    }
    fn fraction_from_midpoint(self) -> Self {
        Self(self.0.fraction_from_midpoint())
    }
    fn look_up<U: Word>(self, table: &Table<U>, site: Site) -> U {
        count_addition();
        self.0.look_up(table, site)
    }
    fn look_up_mirrored<U: Word, const N: usize>(
        self,
        tables: [&Table<U>; N],
        site: Site,
    ) -> [[U; 2]; N] {
        count_addition();
        self.0.look_up_mirrored(tables, site)
    }
}

impl<T: Multiply<U>, U: Word> Multiply<TallyWord<U>> for TallyWord<T> {
    fn multiply(self, by: TallyWord<U>, site: Site) -> Self {
        count(|c| c.products += 1);
        Self(self.0.multiply(by.0, site))
    }
    fn multiply_two(
        self,
        by: TallyWord<U>,
        other: Self,
        other_by: TallyWord<U>,
        site: Site,
    ) -> Self {
        count(|c| {
            c.products += 2;
            c.additions += 1;
        });
        Self(self.0.multiply_two(by.0, other.0, other_by.0, site))
    }
}

impl<T: Divide<Q>, Q: Word> Divide<TallyWord<Q>> for TallyWord<T> {
    fn divide_array(
        self,
        denominator: Self,
        ratio: Ratio<Q::Format>,
        site: Site,
    ) -> Option<TallyWord<Q>> {
        count(|c| c.ratios += 1);
        self.0.divide_array(denominator.0, ratio, site).map(TallyWord)
    }
}

impl<T: Load> Load for TallyWord<T> {
    fn load(value: f64, format: T::Format) -> Option<Self> {
        T::load(value, format).map(Self)
    }
    fn load_raw(bits: i64, format: T::Format) -> Option<Self> {
        T::load_raw(bits, format).map(Self)
    }
}

impl<T: Readout> Readout for TallyWord<T> {
    fn value(self) -> f64 {
        self.0.value()
    }
    fn raw(self) -> Option<i64> {
        self.0.raw()
    }
}

/// A world whose words count their operations.
#[derive(Clone, Copy, Debug)]
pub struct Tally<W>(pub W);

impl<W: World> World for Tally<W> {
    type View = TallyWord<W::View>;
    type Ground = TallyWord<W::Ground>;
    type Height = TallyWord<W::Height>;
    type Weight = TallyWord<W::Weight>;
    type Tone = TallyWord<W::Tone>;

    fn name(&self) -> &'static str {
        "tally"
    }
    fn view(&self, register: Register) -> <W::View as Word>::Format {
        self.0.view(register)
    }
    fn ground(&self, register: Register) -> <W::Ground as Word>::Format {
        self.0.ground(register)
    }
    fn height(&self, register: Register) -> <W::Height as Word>::Format {
        self.0.height(register)
    }
    fn weight(&self, register: Register) -> <W::Weight as Word>::Format {
        self.0.weight(register)
    }
    fn tone(&self, register: Register) -> <W::Tone as Word>::Format {
        self.0.tone(register)
    }
    fn fixed(&self, register: Register) -> Option<Fixed> {
        self.0.fixed(register)
    }
}
