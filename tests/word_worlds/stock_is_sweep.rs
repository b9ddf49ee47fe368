//! Stock words and sweep words of equal format agree in every bit of every operation.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use terraline::word::stock::{
    Ground32, Ground64, Height32, Height64, Tone32, Tone64, View32, View64, Weight32, Weight64,
};
use terraline::word::sweep::{SweepFormat, SweepWord};
use terraline::word::{
    Cell, Divide, Enter, Load, Multiply, Overflow, Ratio, Readout, Rescale, Rounding, Word,
};

use super::{bits, entry_of, format, site, sweep, word};

/// A stock word and the format of a sweep word that is its twin.
trait Stock: Word<Format = ()> + Load + Readout + Cell + Enter {
    const WIDTH: u32;
    const POINT: u32;

    fn of(bits: i64) -> Self {
        word(bits, Self::POINT, ())
    }
}

macro_rules! stock {
    ($($word:ty: $width:literal, $point:literal;)*) => {
        $(impl Stock for $word {
            const WIDTH: u32 = $width;
            const POINT: u32 = $point;
        })*
    };
}

stock! {
    View32: 32, 30; Ground32: 32, 20; Height32: 32, 20; Weight32: 32, 20; Tone32: 32, 20;
    View64: 64, 38; Ground64: 64, 24; Height64: 64, 24; Weight64: 64, 24; Tone64: 64, 24;
}

fn twin<T: Stock>() -> SweepFormat {
    format(T::WIDTH, T::POINT, Rounding::Nearest, Overflow::Wrap)
}

fn pair<T: Stock>(bits: i64) -> (T, SweepWord) {
    let pair = (T::of(bits), sweep(bits, twin::<T>()));
    assert_eq!((pair.0.raw(), pair.1.raw()), (Some(bits), Some(bits)));
    pair
}

/// Runs the same expression on both and compares what comes out.
macro_rules! same {
    ($pair:expr, $t:ident => $value:expr) => {
        prop_assert_eq!(
            {
                let $t = $pair.0;
                $value
            },
            {
                let $t = $pair.1;
                $value
            },
            "{} of {:?}",
            stringify!($value),
            $pair.0
        )
    };
    ($a:expr, $b:expr, $s:ident, $t:ident => $value:expr) => {
        prop_assert_eq!(
            {
                let ($s, $t) = ($a.0, $b.0);
                $value
            },
            {
                let ($s, $t) = ($a.1, $b.1);
                $value
            },
            "{} of {:?} and {:?}",
            stringify!($value),
            $a.0,
            $b.0
        )
    };
}

fn alone<T: Stock>(a: i64, places: u32, log2: u32) -> TestCaseResult {
    let a = pair::<T>(a);
    same!(a, a => (-a).raw());
    same!(a, a => a.shift_floor(places).raw());
    same!(a, a => a.shift_toward_zero(places).raw());
    same!(a, a => a.shift_left(places % T::WIDTH).raw());
    same!(a, a => a.magnitude().raw());
    same!(a, a => (a.is_negative(site()), a.is_positive(site()), a.is_exactly_zero()));
    same!(a, a => a.leading_one(site()));
    same!(a, a => a.value());
    same!(a, a => a.cell(site()));
    same!(a, a => a.fraction().raw());
    same!(a, a => a.fraction_from_midpoint().raw());
    same!(a, a => entry_of(a.fraction(), log2));
    same!(a, a => entry_of(a.fraction_from_midpoint(), log2));
    prop_assert!(!a.0.overflowed());
    prop_assert_eq!(T::zero(()).raw(), SweepWord::zero(twin::<T>()).raw());
    Ok(())
}

fn node<T: Stock>(a: i64) -> TestCaseResult {
    let a = pair::<T>(a);
    same!(a, a => a.nearest(site()));
    Ok(())
}

fn together<T: Stock>(a: i64, b: i64, k: u32) -> TestCaseResult {
    let (a, b) = (pair::<T>(a), pair::<T>(b));
    same!(a, b, a, b => (a + b).raw());
    same!(a, b, a, b => (a - b).raw());
    same!(a, b, a, b => a.is_below(b, site()));
    same!(a, b, a, b => (a.lesser(b).raw(), a.greater(b).raw()));
    same!(a, b, a, b => a.after(b, k).raw());
    // Entering at k is k additions.
    let (stock, sweep) = (0..k % 300).fold((a.0, a.1), |at, _| (at.0 + b.0, at.1 + b.1));
    prop_assert_eq!(a.0.after(b.0, k % 300).raw(), stock.raw());
    prop_assert_eq!(a.1.after(b.1, k % 300).raw(), sweep.raw());
    Ok(())
}

fn rescaled<T: Stock + Rescale<To>, To: Stock>(a: i64, by: i32) -> TestCaseResult {
    let a = pair::<T>(a);
    let stock: To = a.0.rescale(by, (), site());
    let sweep: SweepWord = a.1.rescale(by, twin::<To>(), site());
    prop_assert_eq!(stock.raw(), sweep.raw(), "{:?} times 2^{}", a.0, by);
    Ok(())
}

fn multiplied<T: Stock + Multiply<By>, By: Stock>([a, b, c, d]: [i64; 4]) -> TestCaseResult {
    let (a, b, c, d) = (pair::<T>(a), pair::<By>(b), pair::<T>(c), pair::<By>(d));
    same!(a, b, a, b => a.multiply(b, site()).raw());
    let stock = a.0.multiply_two(b.0, c.0, d.0, site());
    let sweep = a.1.multiply_two(b.1, c.1, d.1, site());
    prop_assert_eq!(stock.raw(), sweep.raw(), "{:?} {:?} {:?} {:?}", a.0, b.0, c.0, d.0);
    Ok(())
}

fn divided<T: Stock + Divide<To>, To: Stock>(n: i64, d: i64, e: i32, range: u32) -> TestCaseResult {
    let d = if d > 0 { d } else { !d }.max(1);
    let (n, d) = (pair::<T>(n), pair::<T>(d));
    let stock = Ratio { exponent: e, range, format: () };
    let sweep = Ratio { exponent: e, range, format: twin::<To>() };
    let array: Option<To> = n.0.divide_array(d.0, stock, site());
    let direct: Option<To> = n.0.divide_direct(d.0, stock, site());
    let swept: Option<SweepWord> = n.1.divide_array(d.1, sweep, site());
    let swept_direct: Option<SweepWord> = n.1.divide_direct(d.1, sweep, site());
    let [array, direct] = [array, direct].map(|ratio| ratio.and_then(Readout::raw));
    let [swept, swept_direct] = [swept, swept_direct].map(|ratio| ratio.and_then(Readout::raw));
    prop_assert_eq!(array, direct);
    prop_assert_eq!(swept, swept_direct);
    prop_assert_eq!(array, swept);
    Ok(())
}

fn loaded<T: Stock>(value: f64) -> TestCaseResult {
    let stock = T::load(value, ()).and_then(Readout::raw);
    prop_assert_eq!(stock, SweepWord::load(value, twin::<T>()).and_then(Readout::raw), "{}", value);
    Ok(())
}

macro_rules! each {
    ($check:ident $arguments:tt: $($word:ty),*) => { $($check::<$word> $arguments?;)* };
}

/// Values around the range of a format and around halves of its last bit.
fn values(width: u32, point: u32) -> impl Strategy<Value = f64> {
    let ulps = move |bits: i64, quarters: i32| {
        libm::scalbn(bits as f64 + f64::from(quarters) / 4.0, -(point as i32))
    };
    prop_oneof![
        (bits(width.min(48)), -4..=4_i32).prop_map(move |(bits, by)| ulps(bits, by)),
        (bits(width), -4..=4_i32).prop_map(move |(bits, by)| ulps(bits, by)),
        (-3.0..3.0_f64).prop_map(move |by| by * libm::exp2(f64::from(width - point))),
        any::<f64>(),
        Just(f64::NAN),
        Just(f64::INFINITY),
        Just(f64::NEG_INFINITY),
        Just(-0.0),
    ]
}

fn four(width: u32) -> impl Strategy<Value = [i64; 4]> {
    [bits(width), bits(width), bits(width), bits(width)]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2048, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn alone_narrow(a in bits(32), places in 0..32_u32, log2 in 0..=16_u32) {
        each!(alone(a, places, log2): View32, Ground32, Height32, Weight32, Tone32);
    }

    #[test]
    fn alone_wide(a in bits(64), places in 0..64_u32, log2 in 0..=16_u32) {
        each!(alone(a, places, log2): View64, Ground64, Height64, Weight64, Tone64);
    }

    #[test]
    fn shifts_by_the_width_and_more(a in bits(32), b in bits(64), places in 32..=127_u32) {
        let (a, b) = (pair::<Weight32>(a), pair::<Weight64>(b));
        same!(a, a => a.shift_floor(places).raw());
        prop_assert_eq!(a.0.shift_toward_zero(places).raw(), Some(0));
        prop_assert_eq!(a.1.shift_toward_zero(places).raw(), Some(0));
        same!(b, b => b.shift_floor(places.max(64)).raw());
        prop_assert_eq!(b.0.shift_toward_zero(places.max(64)).raw(), Some(0));
        prop_assert_eq!(b.1.shift_toward_zero(places.max(64)).raw(), Some(0));
    }

    #[test]
    fn nearest_nodes(a in bits(32), b in bits(64)) {
        each!(node(a): View32, Ground32, Height32, Weight32, Tone32);
        each!(node(b): View64, Ground64, Height64, Weight64, Tone64);
    }

    #[test]
    fn together_narrow(a in bits(32), b in bits(32), k in any::<u32>()) {
        each!(together(a, b, k): View32, Ground32, Height32, Weight32, Tone32);
    }

    #[test]
    fn together_wide(a in bits(64), b in bits(64), k in any::<u32>()) {
        each!(together(a, b, k): View64, Ground64, Height64, Weight64, Tone64);
    }

    #[test]
    fn rescale_narrow(a in bits(32), by in -20..=4_i32) {
        rescaled::<View32, Ground32>(a, by)?;
        rescaled::<View32, Height32>(a, by)?;
        rescaled::<View32, Tone32>(a, by)?;
        rescaled::<Ground32, Weight32>(a, by)?;
        rescaled::<Height32, Tone32>(a, by)?;
        rescaled::<Ground32, View32>(a, by)?;
    }

    #[test]
    fn rescale_wide(a in bits(64), by in -20..=4_i32) {
        rescaled::<View64, Ground64>(a, by)?;
        rescaled::<View64, Height64>(a, by)?;
        rescaled::<View64, Tone64>(a, by)?;
        rescaled::<Ground64, Weight64>(a, by)?;
        rescaled::<Height64, Tone64>(a, by)?;
        rescaled::<Ground64, View64>(a, by)?;
    }

    #[test]
    fn rescale_by_the_width_and_more(a in bits(32), b in bits(64), by in -90..=-20_i32) {
        rescaled::<View32, Ground32>(a, by)?;
        rescaled::<View64, Ground64>(b, by)?;
    }

    #[test]
    fn multiply_narrow(four in four(32)) {
        multiplied::<Height32, Weight32>(four)?;
        multiplied::<Tone32, Tone32>(four)?;
        multiplied::<Ground32, View32>(four)?;
    }

    #[test]
    fn multiply_wide(four in four(64)) {
        multiplied::<Height64, Weight64>(four)?;
        multiplied::<Tone64, Tone64>(four)?;
        multiplied::<Ground64, View64>(four)?;
    }

    #[test]
    fn divide_narrow(n in bits(32), d in bits(32), e in -40..=40_i32, range in 0..=11_u32) {
        divided::<View32, Ground32>(n, d, e, range)?;
    }

    #[test]
    fn divide_wide(n in bits(64), d in bits(64), e in -36..=30_i32, range in 0..=23_u32) {
        divided::<View64, Ground64>(n, d, e, range)?;
    }

    #[test]
    fn load(v32 in values(32, 30), g32 in values(32, 20), v64 in values(64, 38), g64 in values(64, 24)) {
        loaded::<View32>(v32)?;
        each!(loaded(g32): Ground32, Height32, Weight32, Tone32);
        loaded::<View64>(v64)?;
        each!(loaded(g64): Ground64, Height64, Weight64, Tone64);
    }
}
