//! Words that flow through the projector and the stepper have no multiplication and no division, and
//! no comparison without a place: writing one does not compile.

use std::ops::{
    Add, AddAssign, BitAnd, BitOr, BitXor, Div, DivAssign, Mul, MulAssign, Neg, Not, Rem,
    RemAssign, Shl, Shr, Sub,
};

use static_assertions::{assert_impl_all, assert_not_impl_any};
use terraline::word::real::{Real, RealWord};
use terraline::word::stock::{
    Ground32, Ground64, Height32, Height64, Narrow, Tone32, Tone64, View32, View64, Weight32,
    Weight64, Wide,
};
use terraline::word::sweep::{Sweep, SweepWord};
use terraline::word::tally::{Tally, TallyWord};
use terraline::word::{
    Complete, Divide, Enter, Interpolating, Load, Multiply, Shading, Site, Word, World,
};

macro_rules! additions_only {
    ($($word:ty),* $(,)?) => {
        $(
            assert_impl_all!($word: Copy, Add, Sub, Neg);
            // What a word decides, it decides at a named place.
            assert_not_impl_any!($word: PartialOrd, PartialOrd<f64>, PartialOrd<i32>, Ord);
            assert_not_impl_any!(
                $word: Mul<$word>, MulAssign<$word>, Div<$word>, DivAssign<$word>, Rem<$word>,
                RemAssign<$word>, AddAssign<$word>, BitAnd<$word>, BitOr<$word>, BitXor<$word>,
                Not, Shl<u32>, Shr<u32>
            );
            // Nor by a number, nor by a way around through one.
            assert_not_impl_any!(
                $word: Mul<f64>, Mul<f32>, Mul<i32>, Mul<u32>, Mul<i64>, Mul<u64>, Mul<i128>,
                Div<f64>, Div<i32>, Div<u32>, Div<i64>, Div<u64>, Rem<i32>, Rem<i64>
            );
            assert_not_impl_any!(
                $word: Into<f64>, Into<f32>, Into<i32>, Into<i64>, Into<i128>, From<f64>,
                From<i32>, From<i64>, std::iter::Product<$word>, std::ops::Deref
            );
            assert_not_impl_any!(f64: Mul<$word>, Div<$word>);
            assert_not_impl_any!(i64: Mul<$word>, Div<$word>);
        )*
    };
}

additions_only! {
    View32, Ground32, Height32, Weight32, Tone32, View64, Ground64, Height64, Weight64, Tone64,
    RealWord, SweepWord, TallyWord<View32>, TallyWord<Ground64>, TallyWord<RealWord>,
    TallyWord<SweepWord>,
}

// Worlds for the complete processor; the real one is entered in order only.
assert_impl_all!(Narrow: Complete);
assert_impl_all!(Wide: Complete);
assert_impl_all!(Real: Complete);
assert_impl_all!(Sweep: Complete);
assert_impl_all!(Tally<Narrow>: Complete);
assert_impl_all!(Tally<Sweep>: Interpolating, Shading);
assert_not_impl_any!(RealWord: Enter);
assert_not_impl_any!(TallyWord<View32>: Enter);

// Ratios are taken of views only, and words of two sizes do not meet.
assert_not_impl_any!(Ground32: Divide<Ground32>, Divide<View32>);
assert_not_impl_any!(Height32: Divide<Ground32>, Divide<Height32>);
assert_not_impl_any!(View32: Divide<Ground64>, Multiply<View64>);
assert_not_impl_any!(Height64: Multiply<Weight32>, Add<Height32>, Add<Ground64>);
assert_not_impl_any!(Height32: Add<Ground32>, Sub<Weight32>, Add<i32>, Add<f64>);

/// What every unit may do, for contrast with the files in `ui`.
fn a_unit<W: World>(x: W::View, dx: W::View, site: Site) -> bool {
    (-(x + dx - x)).is_below(x, site)
}

#[test]
fn adding_compiles() {
    let one = View32::load(1.0, ()).expect("one fits");
    assert!(!a_unit::<Narrow>(-one, one.shift_floor(1), Site::pixel(0, 0)));
}

#[test]
fn multiplying_does_not_compile() {
    let cases = trybuild::TestCases::new();
    cases.compile_fail("tests/ui/multiply_in_projector.rs");
    cases.compile_fail("tests/ui/multiply_in_stepper.rs");
}

#[test]
fn comparing_without_a_place_does_not_compile() {
    trybuild::TestCases::new().compile_fail("tests/ui/compare_without_a_place.rs");
}
