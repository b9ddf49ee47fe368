//! The five roundings against fractions of integers.

use proptest::prelude::*;
use terraline::word::sweep::SweepWord;
use terraline::word::{Multiply, Overflow, Readout, Register, Registers, Rescale, Rounding, Site};

use super::{bits, floor, format, nearest, site, sweep};

/// `numerator / denominator` rounded by definition; the two neighbours for stochastic rounding.
fn rounded(rounding: Rounding, numerator: i128, denominator: i128) -> Vec<i128> {
    let below = floor(numerator, denominator);
    let above = -floor(-numerator, denominator);
    let nearest = nearest(numerator, denominator);
    let tie = 2 * (numerator - below * denominator) == denominator;
    match rounding {
        Rounding::Floor => vec![below],
        Rounding::TowardZero => vec![if numerator < 0 { above } else { below }],
        Rounding::Nearest => vec![nearest],
        Rounding::NearestEven if tie => vec![if below % 2 == 0 { below } else { above }],
        Rounding::NearestEven => vec![nearest],
        Rounding::Stochastic => vec![below, above],
    }
}

fn place(line: u32, column: u32, operation: u32) -> Site {
    Site { register: Register::Surface, line, column, operation }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2048, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn shifts(value in bits(64), places in 0..=60_u32, random in any::<u64>()) {
        let value = i128::from(value);
        for rounding in Rounding::ALL {
            let found = rounding.shift_right(value, places, || random);
            let expected = rounded(rounding, value, 1 << places);
            prop_assert!(expected.contains(&found), "{rounding:?}: {found}, not {expected:?}");
        }
    }

    #[test]
    fn shifts_beyond_every_bit(value in bits(64), places in 65..=400_u32) {
        let value = i128::from(value);
        let shift = |rounding: Rounding| rounding.shift_right(value, places, || 0);
        prop_assert_eq!(shift(Rounding::Floor), -i128::from(value < 0));
        prop_assert_eq!(shift(Rounding::TowardZero), 0);
        prop_assert_eq!(shift(Rounding::Nearest), 0);
        prop_assert_eq!(shift(Rounding::NearestEven), 0);
    }

    #[test]
    fn registers_feeding_registers(
        value in bits(40), point in 0..=30_u32, to in 0..=30_u32, exponent in -20..=4_i32,
        line in any::<u32>(), column in any::<u32>(),
    ) {
        for rounding in Rounding::ALL {
            let from = sweep(value, format(40, point, Rounding::Floor, Overflow::Wrap));
            let target = format(64, to, rounding, Overflow::Wrap);
            let word: SweepWord = from.rescale(exponent, target, place(line, column, 0));
            // value · 2^(to + exponent − point), as a fraction.
            let scale = to as i32 + exponent - point as i32;
            let numerator = i128::from(value) << scale.max(0);
            let expected = rounded(rounding, numerator, 1 << (-scale).max(0));
            let found = word.raw().map(i128::from).unwrap();
            let kept = expected.iter().any(|&e| super::wrapped(e, 64) == found);
            prop_assert!(kept, "{rounding:?}: {found}, not {expected:?}");
        }
    }

    #[test]
    fn products_round_once(four in [bits(31), bits(31), bits(31), bits(31)], point in 1..=20_u32) {
        let [a, b, c, d] = four;
        for rounding in Rounding::ALL {
            let heights = format(60, 20, rounding, Overflow::Wrap);
            // The format of the other factor has its own rounding, which does not matter.
            let weights = format(32, point, Rounding::Floor, Overflow::Saturate);
            let (wa, wb) = (sweep(a, heights), sweep(b, weights));
            let (wc, wd) = (sweep(c, heights), sweep(d, weights));
            let (a, b, c, d) = (i128::from(a), i128::from(b), i128::from(c), i128::from(d));
            let one = wa.multiply(wb, site()).raw().map(i128::from).unwrap();
            let two = wa.multiply_two(wb, wc, wd, site()).raw().map(i128::from).unwrap();
            let contains = |exact: i128, found: i128| {
                let expected = rounded(rounding, exact, 1 << point);
                expected.iter().any(|&e| super::wrapped(e, 60) == found)
            };
            prop_assert!(contains(a * b, one), "{rounding:?}");
            prop_assert!(contains(a * b + c * d, two), "{rounding:?}");
        }
    }
}

/// A stochastic register of 8 fraction bits that takes words with 24.
fn draw(value: i64, seed: u32, at: Site) -> i64 {
    let from = sweep(value, format(40, 24, Rounding::Floor, Overflow::Wrap));
    let mut target = format(32, 8, Rounding::Stochastic, Overflow::Wrap);
    target.seed = seed;
    let word: SweepWord = from.rescale(0, target, at);
    word.raw().expect("bits")
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_draw_is_a_function_of_its_place(
        value in bits(40), seed in any::<u32>(), places in proptest::collection::vec(any::<[u32; 3]>(), 1..20),
    ) {
        let at = |&[line, column, operation]: &[u32; 3]| {
            draw(value, seed, place(line, column, operation))
        };
        let forward: Vec<i64> = places.iter().map(at).collect();
        let mut backward: Vec<i64> = places.iter().rev().map(at).collect();
        backward.reverse();
        prop_assert_eq!(&forward, &backward);
        // On other threads as well.
        let elsewhere = std::thread::scope(|scope| {
            scope.spawn(|| places.iter().map(at).collect::<Vec<_>>()).join().unwrap()
        });
        prop_assert_eq!(forward, elsewhere);
    }

    #[test]
    fn exact_values_stay(value in bits(31), seed in any::<u32>(), at in any::<[u32; 3]>()) {
        let site = place(at[0], at[1], at[2]);
        prop_assert_eq!(draw(value >> 8 << 16, seed, site), value >> 8);
    }
}

/// Draws are Bernoulli trials with the dropped fraction p, so among n of them the number that go
/// up has mean n·p and variance n·p·(1−p). Five standard deviations are left for chance: one in
/// 1.7 million, and seeds are fixed.
fn check_unbiased(value: i64, n: u32, draws: impl Iterator<Item = i64>) {
    let below = value >> 16;
    let p = (value - (below << 16)) as f64 / 65536.0;
    let mut ups = 0;
    for draw in draws {
        assert!(draw == below || draw == below + 1, "{value}: {draw}");
        ups += u32::from(draw > below);
    }
    let (mean, variance) = (f64::from(n) * p, f64::from(n) * p * (1.0 - p));
    let off = (f64::from(ups) - mean).abs();
    assert!(off <= 5.0 * variance.sqrt(), "{value}: {ups} of {n} went up, expected {mean}");
}

const FRACTIONS: [i64; 9] = [0, 1 << 8, 1 << 12, 1 << 14, 20_000, 1 << 15, 3 << 14, 65_000, 65_535];

#[test]
fn draws_are_unbiased_over_every_part_of_their_place() {
    const N: u32 = 20_000;
    for seed in [0, 1, 0xdead_beef] {
        for fraction in FRACTIONS {
            for value in [fraction, (37 << 16) + fraction, (-1000 << 16) + fraction] {
                let check = |at: fn(u32) -> Site| {
                    check_unbiased(value, N, (0..N).map(|i| draw(value, seed, at(i))));
                };
                check(|i| place(i, 9, 4));
                check(|i| place(9, i, 4));
                check(|i| place(9, 4, i));
                check(|i| place(i / 141, i % 141, 1 << 31));
            }
        }
    }
}

#[test]
fn every_part_of_the_place_and_the_seed_changes_draws() {
    const N: u32 = 4096;
    let half = 1 << 15;
    let draws = |seed, at: &dyn Fn(u32) -> Site| -> Vec<i64> {
        (0..N).map(|i| draw(half, seed, at(i))).collect()
    };
    let base = draws(1, &|i| place(i / 64, i % 64, 0));
    let others = [
        draws(2, &|i| place(i / 64, i % 64, 0)),
        draws(1, &|i| place(i / 64 + 64, i % 64, 0)),
        draws(1, &|i| place(i / 64, i % 64 + 64, 0)),
        draws(1, &|i| place(i / 64, i % 64, 1)),
        draws(1, &|i| place(i / 64, i % 64, 0).at(Register::SlopeX)),
        // Line and column are not interchangeable.
        draws(1, &|i| place(i % 64, i / 64, 0)),
    ];
    for other in others {
        // Independent fair draws differ in half of the places: 2048 ± 5 · 32.
        let differ = base.iter().zip(&other).filter(|(a, b)| a != b).count();
        assert!((1888..=2208).contains(&differ), "{differ} of {N} differ");
    }
}

#[test]
fn names_are_told_apart_and_read_back() {
    for rounding in Rounding::ALL {
        assert_eq!(Rounding::from_name(rounding.name()), Some(rounding));
    }
    for overflow in Overflow::ALL {
        assert_eq!(Overflow::from_name(overflow.name()), Some(overflow));
    }
    for registers in Registers::all() {
        // `weight` is a class and its leader: the same registers.
        let read = Registers::from_name(registers.name()).expect("a name");
        assert!(Register::ALL.iter().all(|&r| read.contains(r) == registers.contains(r)));
    }
    assert_eq!((Rounding::from_name("up"), Overflow::from_name("")), (None, None));
    assert_eq!(Registers::from_name("View"), None);
}
