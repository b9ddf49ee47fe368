//! Wrap and saturate against integers of 128 bits, and the flag that stays set.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use terraline::word::sweep::{SweepFormat, SweepWord};
use terraline::word::{
    Cell, Divide, Enter, Load, Multiply, Overflow, Ratio, Readout, Rescale, Rounding, Word,
};

use super::{entry_of, floor, format, is_normal, kept, nearest, overflows, site, sweep};

const OVERFLOWS: [Overflow; 2] = [Overflow::Wrap, Overflow::Saturate];

/// The result of an operation whose exact integer is known.
fn check(word: SweepWord, exact: i128, format: SweepFormat, what: &str) -> TestCaseResult {
    let width = format.width.into();
    let expected = kept(exact, width, format.overflow);
    prop_assert_eq!(word.raw().map(i128::from), Some(expected), "{} in {:?}", what, format);
    prop_assert_eq!(word.overflowed(), overflows(exact, width), "{} in {:?}", what, format);
    Ok(())
}

/// A format and words of it.
fn words() -> impl Strategy<Value = (u32, u32, i64, i64)> {
    (2..=62_u32, any::<u32>(), any::<i64>(), any::<i64>(), 0..64_u32).prop_map(
        |(width, point, a, b, small)| {
            let fit = |value: i64| value >> (64 - width);
            (width, point % (width + 1), fit(a), fit(b) >> small.min(width - 1))
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4096, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn sums_shifts_and_products(
        (width, point, a, b) in words(), places in 0..=63_u32, k in any::<u32>(),
    ) {
        for overflow in OVERFLOWS {
            let format = format(width, point, Rounding::Nearest, overflow);
            let (wa, wb) = (sweep(a, format), sweep(b, format));
            prop_assert!(is_normal(wa) && is_normal(wb));
            let (a, b) = (i128::from(a), i128::from(b));
            check(wa + wb, a + b, format, "a sum")?;
            check(wa - wb, a - b, format, "a difference")?;
            check(-wa, -a, format, "a negation")?;
            check(wa.magnitude(), a.abs(), format, "a magnitude")?;
            check(wa.shift_left(places), a << places, format, "a shift left")?;
            check(wa.shift_floor(places), a >> places, format, "a shift right")?;
            check(wa.shift_toward_zero(places), a / (1 << places), format, "a truncation")?;
            let one = 1_i128 << point;
            check(wa.multiply(wb, site()), nearest(a * b, one), format, "a product")?;
            let two = wa.multiply_two(wb, wb, wb, site());
            check(two, nearest(a * b + b * b, one), format, "two products")?;
            if overflow == Overflow::Wrap {
                check(wa.after(wb, k), a + b * i128::from(k), format, "an entry")?;
            }
        }
    }

    #[test]
    fn a_wider_register_feeds_a_narrower_one(
        (width, point, a, _) in words(), to in 2..=62_u32, exponent in -20..=4_i32,
    ) {
        for overflow in OVERFLOWS {
            let from = sweep(a, format(width, point, Rounding::Floor, Overflow::Wrap));
            let target = format(to, point.min(to), Rounding::Nearest, overflow);
            let scale = i32::from(target.point) - point as i32 + exponent;
            let exact = nearest(i128::from(a) << scale.max(0), 1 << (-scale).max(0));
            check(from.rescale(exponent, target, site()), exact, target, "a rescale")?;
        }
    }

    #[test]
    fn places_in_cells((width, point, a, _) in words(), log2 in 0..=12_u32) {
        let word = sweep(a, format(width, point, Rounding::Floor, Overflow::Wrap));
        let (a, one) = (i128::from(a), 1_i128 << point);
        prop_assert_eq!(word.cell(site()), floor(a, one) as i32);
        prop_assert_eq!(word.nearest(site()), nearest(a, one) as i32);
        if point < width - 1 {
            // With a bit before the point a fraction is a word.
            let fraction = a - floor(a, one) * one;
            check(word.fraction(), fraction, format(width, point, Rounding::Floor, Overflow::Wrap), "a fraction")?;
            let from_midpoint = (2 * a + one - 2 * nearest(a, one) * one) / 2;
            // Without bits after the point there is no midpoint.
            prop_assert_eq!(
                word.fraction_from_midpoint().raw().map(i128::from),
                Some(if point == 0 { 0 } else { from_midpoint })
            );
            let entry = nearest(fraction << log2, one);
            prop_assert_eq!(entry_of(word.fraction(), log2), entry);
        }
    }

    #[test]
    fn ratios_are_floors(
        (width, point, n, d) in words(), quotient in 2..=60_u32, places in any::<u32>(),
        exponent in -12..=12_i32,
    ) {
        let d = d.checked_abs().unwrap_or(1).max(1).min(i64::MAX >> (64 - width));
        let view = format(width, point, Rounding::Floor, Overflow::Wrap);
        let target = format(quotient, places % quotient, Rounding::Floor, Overflow::Wrap);
        let range = u32::from(target.width - target.point - 1);
        let ratio = Ratio { exponent, range, format: target };
        let found: Option<SweepWord> = sweep(n, view).divide_array(sweep(d, view), ratio, site());
        let shift = exponent + i32::from(target.point);
        let exact = floor(i128::from(n) << shift.max(0), i128::from(d) << (-shift).max(0));
        let expected = (!overflows(exact, quotient)).then_some(exact);
        prop_assert_eq!(found.and_then(Readout::raw).map(i128::from), expected);
        prop_assert!(found.is_none_or(is_normal));
    }

    #[test]
    fn the_flag_stays_set((width, point, a, b) in words(), places in 0..=63_u32) {
        for overflow in OVERFLOWS {
            let format = format(width, point, Rounding::Nearest, overflow);
            let largest = sweep(i64::MAX >> (64 - width), format);
            let smallest_bit = sweep(1, format);
            let flagged = largest + smallest_bit;
            prop_assert!(flagged.overflowed() && is_normal(largest));
            // Back in range by value, but made from a word that was not.
            let back = flagged - smallest_bit;
            let (a, b) = (sweep(a, format), sweep(b, format));
            let ratio = Ratio { exponent: 0, range: width - 1, format: super::format(62, 0, Rounding::Floor, overflow) };
            let mut ratios: Vec<Option<SweepWord>> = Vec::new();
            for (numerator, denominator) in [(back, smallest_bit), (smallest_bit, back)] {
                if denominator.is_positive(site()) {
                    ratios.push(numerator.divide_array(denominator, ratio, site()));
                }
            }
            let made = [
                back, a + back, back + a, a - back, back - a, -back, back.magnitude(),
                back.shift_left(places), back.shift_floor(places), back.shift_toward_zero(places),
                back.multiply(a, site()), a.multiply(back, site()),
                back.multiply_two(a, b, a, site()), a.multiply_two(back, b, a, site()),
                a.multiply_two(b, back, a, site()), a.multiply_two(b, a, back, site()),
                back.rescale(-1, format, site()), back.rescale(1, format, site()),
                back.after(a, 3), a.after(back, 0), back.fraction(), back.fraction_from_midpoint(),
            ];
            for (at, word) in made.into_iter().enumerate() {
                prop_assert!(word.overflowed(), "word {} in {:?}", at, format);
            }
            // The first quotient is that of a word by its own last bit, which 62 bits hold.
            prop_assert!(ratios.iter().any(Option::is_some), "{:?}", format);
            for word in ratios.into_iter().flatten() {
                prop_assert!(word.overflowed());
            }
        }
    }

    #[test]
    fn loads_fit_or_fail((width, point, a, _) in words(), quarters in -3..=3_i32) {
        let format = format(width, point, Rounding::Floor, Overflow::Saturate);
        // Loads round to even whatever the register's rounding, and never saturate.
        let a = a >> 12;
        let value = libm::scalbn(a as f64 + f64::from(quarters) / 4.0, -(point as i32));
        let exact = match quarters {
            2 if a % 2 == 0 => a,
            -2 if a % 2 != 0 => a - 1,
            2 => a + 1,
            -2 => a,
            3 => a + 1,
            -3 => a - 1,
            _ => a,
        };
        let expected = (!overflows(exact.into(), width)).then_some(exact);
        prop_assert_eq!(SweepWord::load(value, format).and_then(Readout::raw), expected);
        let limit = libm::exp2(f64::from(width) - 1.0 - f64::from(point));
        prop_assert!(SweepWord::load(limit, format).is_none());
        prop_assert_eq!(SweepWord::load(-limit, format).unwrap().value(), -limit);
    }
}
