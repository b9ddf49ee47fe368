//! One suite for every fixed world that wraps.

use terraline::word::stock::{Narrow, Wide};
use terraline::word::sweep::{Sweep, SweepFormat};
use terraline::word::tally::Tally;
use terraline::word::{Complete, Fixed, Load, Overflow, Readout, Register, Rounding, Word};

use super::{site, wrapped};

/// Any fixed world with wrapping registers passes.
fn conforms<W: Complete>(world: W) {
    for &register in Register::ALL {
        let fixed = world.fixed(register).expect("a fixed world");
        assert!(fixed.width <= 64 && fixed.point <= fixed.width);
        let name = format!("{} {register}", world.name());
        use terraline::word::Class;
        match register.class() {
            Class::View => word_conforms::<W::View>(world.view(register), fixed, &name),
            Class::Ground => word_conforms::<W::Ground>(world.ground(register), fixed, &name),
            Class::Height => word_conforms::<W::Height>(world.height(register), fixed, &name),
            Class::Weight => word_conforms::<W::Weight>(world.weight(register), fixed, &name),
            Class::Tone => word_conforms::<W::Tone>(world.tone(register), fixed, &name),
        }
    }
}

/// Bits near zero, near the ends, near powers of two, and some in between.
fn samples(width: u32) -> Vec<i64> {
    let (low, high) = (i64::MIN >> (64 - width), i64::MAX >> (64 - width));
    let mut samples = vec![low, low + 1, high - 1, high, -1, 0, 1];
    samples.extend((0..width - 1).step_by(3).flat_map(|place| {
        let power = 1_i64 << place;
        [power - 1, power, -power, -power - 1]
    }));
    let mut state = 0x1234_5678_9abc_def0_u64;
    samples.extend((0..12).map(|_| {
        state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        state as i64 >> (64 - width)
    }));
    samples.sort_unstable();
    samples.dedup();
    samples
}

fn word_conforms<T: Load + Readout>(format: T::Format, fixed: Fixed, name: &str) {
    let of = |bits: i64| super::word::<T>(bits, fixed.point, format);
    let raw = |word: T| i128::from(word.raw().expect("bits"));
    let zero = T::zero(format);
    assert_eq!(raw(zero), 0, "{name}");
    let samples = samples(fixed.width);
    for &a in &samples {
        let word = of(a);
        assert_eq!(raw(word), i128::from(a), "{name}");
        one_word(word, i128::from(a), fixed, &raw, name);
        assert_eq!(raw(word + zero), i128::from(a), "{name}: {a} + 0");
        assert_eq!(raw(word + -word), 0, "{name}: {a} + -{a}");
        for &b in &samples {
            let other = of(b);
            assert_eq!(
                raw(word + other),
                wrapped(i128::from(a) + i128::from(b), fixed.width),
                "{name}: {a} + {b}"
            );
            assert_eq!(raw(word + other), raw(other + word), "{name}: {a} + {b}");
            assert_eq!(raw(word - other), raw(word + -other), "{name}: {a} - {b}");
            assert_eq!(raw(word - other + other), i128::from(a), "{name}: {a} - {b} + {b}");
            let (least, most) = (i128::from(a.min(b)), i128::from(a.max(b)));
            assert_eq!(word.is_below(other, site()), a < b, "{name}: {a} below {b}");
            assert_eq!(raw(word.lesser(other)), least, "{name}: {a} and {b}");
            assert_eq!(raw(word.greater(other)), most, "{name}: {a} and {b}");
            assert_eq!(raw(word.hull(other)), i128::from(a), "{name}: {a} or {b}");
            for places in [0, 1, fixed.width - 1] {
                let share = wrapped(i128::from(b) - i128::from(a), fixed.width) / (1 << places);
                let toward = wrapped(i128::from(a) + share, fixed.width);
                assert_eq!(raw(word.toward(other, places)), toward, "{name}: {a} to {b}");
            }
            for &c in samples.iter().step_by(9) {
                let third = of(c);
                let (left, right) = (word + other + third, word + (other + third));
                assert_eq!(raw(left), raw(right), "{name}: {a} + {b} + {c}");
            }
        }
    }
}

fn one_word<T: Word>(word: T, a: i128, fixed: Fixed, raw: &dyn Fn(T) -> i128, name: &str) {
    let keeps = |value: i128| wrapped(value, fixed.width);
    assert_eq!(raw(-word), keeps(-a), "{name}: -{a}");
    assert_eq!(raw(word.magnitude()), keeps(a.abs()), "{name}: |{a}|");
    assert_eq!(word.is_positive(site()), a > 0, "{name}: sign of {a}");
    assert_eq!(word.is_negative(site()), a < 0, "{name}: sign of {a}");
    assert_eq!(word.is_exactly_zero(), a == 0, "{name}: {a} is zero");
    assert_eq!(raw(word.shift_left(1)), raw(word + word), "{name}: {a} << 1");
    for places in 0..fixed.width {
        let power = 1_i128 << places;
        assert_eq!(raw(word.shift_left(places)), keeps(a * power), "{name}: {a} << {places}");
        let floor = word.shift_floor(places);
        assert_eq!(raw(floor), a.div_euclid(power), "{name}: {a} >> {places}");
        let truncated = word.shift_toward_zero(places);
        assert_eq!(raw(truncated), a / power, "{name}: {a} / 2^{places}");
        // Two shifts are one.
        assert_eq!(
            raw(word.shift_floor(places / 2).shift_floor(places - places / 2)),
            raw(floor),
            "{name}: {a} >> {places}"
        );
    }
    assert_eq!(raw(word.shift_toward_zero(fixed.width)), 0, "{name}: {a} / 2^{}", fixed.width);
    // 2^e <= |value| < 2^(e+1), in last bits; zero is one place below the last bit.
    let place = word.leading_one(site()) + fixed.point as i32;
    if a == 0 {
        assert_eq!(place, -1, "{name}");
    } else {
        assert!(1 << place <= a.abs() && a.abs() < 1 << (place + 1), "{name}: {a} at {place}");
    }
}

fn swept(format: impl Fn(Register) -> (u8, u8), rounding: Rounding) -> Sweep {
    Sweep::new(|register| {
        let (width, point) = format(register);
        SweepFormat { width, point, rounding, overflow: Overflow::Wrap, seed: 3 }
    })
}

#[test]
fn narrow_conforms() {
    conforms(Narrow);
}

#[test]
fn wide_conforms() {
    conforms(Wide);
}

#[test]
fn sweeps_conform() {
    for rounding in Rounding::ALL {
        conforms(swept(|_| (2, 0), rounding));
        conforms(swept(|_| (2, 2), rounding));
        conforms(swept(|_| (64, 64), rounding));
        // Every register its own format.
        conforms(swept(|register| (5 + 3 * register as u8, register as u8), rounding));
    }
}

#[test]
fn tallies_conform() {
    conforms(Tally(Narrow));
    conforms(Tally(swept(|_| (24, 8), Rounding::Stochastic)));
}
