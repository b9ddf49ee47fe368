//! Random register formats.

use proptest::prelude::*;
use proptest::sample::select;
use terraline::scene::{FormatRequest, Overflow, Rounding};
use terraline::setup::formats::follows;
use terraline::word::{Class, Register};

/// A number of bits, mostly below `usual`, at times up to `most`.
fn bits(usual: u32, most: u32) -> BoxedStrategy<u32> {
    prop_oneof![4 => 0..usual, 1 => usual..=most].boxed()
}

/// A wrapping format of a register or of a class, wide enough for the formats' own check.
pub fn requests() -> BoxedStrategy<(String, FormatRequest)> {
    let classes = [Class::View, Class::Ground, Class::Height, Class::Weight, Class::Tone];
    let class = select(classes.to_vec()).prop_map(|class| (class.name(), class));
    let leaders: Vec<Register> =
        Register::ALL.iter().copied().filter(|r| follows(*r).is_none()).collect();
    let register = select(leaders).prop_map(|register| (register.name(), register.class()));
    let rounding = select(vec![
        Rounding::Floor,
        Rounding::TowardZero,
        Rounding::Nearest,
        Rounding::NearestEven,
        Rounding::Stochastic,
    ]);
    (prop_oneof![2 => class, 1 => register], bits(12, 40), bits(30, 58), rounding)
        .prop_map(|((name, class), integer, point, rounding)| {
            let least = match class {
                Class::View => 1,
                Class::Ground | Class::Height | Class::Weight => 3,
                Class::Tone => 10,
            };
            let integer = (least + integer).min(60);
            let point = point.clamp(1, 62 - integer);
            let width = integer + point;
            let request = FormatRequest { width, point, rounding, overflow: Overflow::Wrap };
            (name.to_owned(), request)
        })
        .boxed()
}
