//! The real world is `f64`.

use proptest::prelude::*;
use terraline::word::real::{Real, RealWord};
use terraline::word::{
    Cell, Divide, Load, Multiply, Ratio, Readout, Register, Rescale, Word, World,
};

use super::{entry_of, site};

fn real(value: f64) -> RealWord {
    RealWord::load(value, ()).expect("a finite number")
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        -1e6..1e6_f64,
        -1.0..1.0_f64,
        Just(0.0),
        (-40..40_i32).prop_map(|e| (e as f64).exp2())
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2048, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn operations([a, b, c, d] in [number(), number(), number(), number()], places in 0..40_i32) {
        let (wa, wb, wc, wd) = (real(a), real(b), real(c), real(d));
        let power = 2_f64.powi(places);
        prop_assert_eq!((wa + wb).value(), a + b);
        prop_assert_eq!((wa - wb).value(), a - b);
        prop_assert_eq!((-wa).value(), -a);
        prop_assert_eq!(wa.is_below(wb, site()), a < b);
        prop_assert_eq!(wa.shift_floor(places as u32).value(), a / power);
        prop_assert_eq!(wa.shift_toward_zero(places as u32).value(), a / power);
        prop_assert_eq!(wa.shift_left(places as u32).value(), a * power);
        prop_assert_eq!(wa.magnitude().value(), a.abs());
        prop_assert_eq!((wa.is_negative(site()), wa.is_positive(site())), (a < 0.0, a > 0.0));
        prop_assert_eq!((wa.lesser(wb).value(), wa.greater(wb).value()), (a.min(b), a.max(b)));
        prop_assert_eq!(wa.is_exactly_zero(), a == 0.0);
        let scaled: RealWord = wa.rescale(-places, (), site());
        prop_assert_eq!(scaled.value(), a / power);
        prop_assert_eq!(wa.multiply(wb, site()).value(), a * b);
        prop_assert_eq!(wa.multiply_two(wb, wc, wd, site()).value(), a * b + c * d);
        prop_assert_eq!(wa.raw(), None);
        prop_assert!(!wa.overflowed());
        if a != 0.0 {
            let e = wa.leading_one(site());
            prop_assert!(2_f64.powi(e) <= a.abs() && a.abs() < 2_f64.powi(e + 1));
        }
    }

    #[test]
    fn cells(a in -1e6..1e6_f64, t in 0.0..=1.0_f64, log2 in 0..=16_u32) {
        let word = real(a);
        prop_assert_eq!(f64::from(word.cell(site())), a.floor());
        prop_assert_eq!(word.fraction().value(), a - a.floor());
        prop_assert_eq!(f64::from(word.nearest(site())), (a + 0.5).floor());
        prop_assert_eq!(word.fraction_from_midpoint().value(), (a + 0.5) - (a + 0.5).floor());
        let entry = (t * 2_f64.powi(log2 as i32) + 0.5).floor();
        prop_assert_eq!(entry_of(real(t), log2) as f64, entry);
    }

    #[test]
    fn ratios(n in number(), d in 1e-6..1e6_f64, exponent in -8..=12_i32, range in 0..=11_u32) {
        let ratio = Ratio { exponent, range, format: () };
        let found: Option<RealWord> = real(n).divide_array(real(d), ratio, site());
        let quotient = n / d * 2_f64.powi(exponent);
        let limit = 2_f64.powi(range as i32);
        let expected = (-limit..limit).contains(&quotient).then_some(quotient);
        prop_assert_eq!(found.map(Readout::value), expected);
        let direct: Option<RealWord> = real(n).divide_direct(real(d), ratio, site());
        prop_assert_eq!(direct.map(Readout::value), expected);
    }
}

#[test]
fn zero_and_what_is_not_finite() {
    assert_eq!(RealWord::zero(()).value(), 0.0);
    assert!(RealWord::zero(()).leading_one(site()) < -1100);
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(RealWord::load(value, ()).is_none());
    }
    assert!(Register::ALL.iter().all(|&register| Real.fixed(register).is_none()));
}
