//! Number worlds: stock against sweep in every bit, roundings and overflow against their
//! definitions, and the laws that every fixed world keeps.

#[path = "word_worlds/conformance.rs"]
mod conformance;
#[path = "word_worlds/overflow.rs"]
mod overflow;
#[path = "word_worlds/real.rs"]
mod real;
#[path = "word_worlds/rounding.rs"]
mod rounding;
#[path = "word_worlds/stock_is_sweep.rs"]
mod stock_is_sweep;
#[path = "word_worlds/tally.rs"]
mod tally;

use std::sync::LazyLock;

use proptest::prelude::*;
use terraline::word::sweep::{SweepFormat, SweepWord};
use terraline::word::{
    Cell, Load, Overflow, Readout, Register, Rounding, Site, Table, Word, real::RealWord,
};

fn format(width: u32, point: u32, rounding: Rounding, overflow: Overflow) -> SweepFormat {
    SweepFormat { width: width as u8, point: point as u8, rounding, overflow, seed: 7 }
}

fn site() -> Site {
    Site { register: Register::Surface, line: 3, column: 5, operation: 2 }
}

/// The entry that an argument reads of a table whose entries are their own addresses.
fn entry_of(argument: impl Cell, log2: u32) -> i128 {
    static TABLES: LazyLock<Vec<Table<RealWord>>> = LazyLock::new(|| {
        let number = |at: i32| RealWord::load(at.into(), ()).expect("a number");
        (0..=16).map(|log2| Table::new(log2, (0..=1 << log2).map(number).collect())).collect()
    });
    let table = &TABLES[log2 as usize];
    let entry = argument.look_up(table, site()).value();
    let both = argument.look_up_mirrored([table], site()).map(|both| both.map(Readout::value));
    assert_eq!(both, [[entry, f64::from(1 << log2) - entry]]);
    entry as i128
}

/// The word with these bits: put together in two parts, since `f64` does not hold 64.
fn word<T: Load>(bits: i64, point: u32, format: T::Format) -> T {
    let part = |bits: i64| {
        T::load(libm::scalbn(bits as f64, -(point as i32)), format).expect("a word of this format")
    };
    let low = bits & 0x3fff_ffff;
    // The low part may be too large for a short word, which `f64` holds as a whole.
    if bits.unsigned_abs() < 1 << 53 { part(bits) } else { part(bits - low) + part(low) }
}

fn sweep(bits: i64, format: SweepFormat) -> SweepWord {
    word(bits, format.point.into(), format)
}

/// Any word, and often those near the ends, near zero and near powers of two.
fn bits(width: u32) -> impl Strategy<Value = i64> {
    let (low, high) = (i64::MIN >> (64 - width), i64::MAX >> (64 - width));
    prop_oneof![
        low..=high,
        (0..width - 1, -1..=1_i64).prop_map(|(place, by)| (1_i64 << place) + by),
        (0..width - 1, -1..=1_i64).prop_map(|(place, by)| -(1_i64 << place) + by),
        (0..=1_i64).prop_map(move |by| high - by),
        (0..=1_i64).prop_map(move |by| low + by),
        -1..=1_i64,
    ]
    .prop_map(move |value| value.clamp(low, high))
}

/// Modulo 2^width, between −2^(width−1) and 2^(width−1).
fn wrapped(value: i128, width: u32) -> i128 {
    let modulus = 1_i128 << width;
    let half = modulus / 2;
    (value + half).rem_euclid(modulus) - half
}

/// What the exact integer `value` becomes in a register.
fn kept(value: i128, width: u32, overflow: Overflow) -> i128 {
    match overflow {
        Overflow::Wrap => wrapped(value, width),
        Overflow::Saturate => value.max(-(1 << (width - 1))).min((1 << (width - 1)) - 1),
    }
}

/// Whether that changes it.
fn overflows(value: i128, width: u32) -> bool {
    value < -(1 << (width - 1)) || value >= 1 << (width - 1)
}

/// Floor of a fraction with positive denominator.
fn floor(numerator: i128, denominator: i128) -> i128 {
    numerator.div_euclid(denominator)
}

/// The integer nearest to a fraction, ties upward.
fn nearest(numerator: i128, denominator: i128) -> i128 {
    floor(2 * numerator + denominator, 2 * denominator)
}

fn is_normal<T: Word>(word: T) -> bool {
    !word.overflowed()
}
