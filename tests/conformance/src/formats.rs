//! Random register formats.

use proptest::prelude::*;
use proptest::sample::select;
use terraline::scene::FormatRequest;
use terraline::word::{Class, Overflow, Register, Registers, Rounding};

/// A number of bits, mostly below `usual`, at times up to `most`.
fn bits(usual: u32, most: u32) -> BoxedStrategy<u32> {
    prop_oneof![4 => 0..usual, 1 => usual..=most].boxed()
}

/// A wrapping format of a register or of a class, wide enough for the formats' own check.
pub fn requests() -> BoxedStrategy<(Registers, FormatRequest)> {
    let class = select(&Class::ALL[..]).prop_map(|class| (Registers::Class(class), class));
    let leaders: Vec<Register> =
        Register::ALL.iter().copied().filter(|r| r.follows().is_none()).collect();
    let register =
        select(leaders).prop_map(|register| (Registers::One(register), register.class()));
    let rounding = select(&Rounding::ALL[..]);
    (prop_oneof![2 => class, 1 => register], bits(12, 40), bits(30, 58), rounding)
        .prop_map(|((registers, class), integer, point, rounding)| {
            let least = match class {
                Class::View => 1,
                Class::Ground | Class::Height | Class::Weight => 3,
                Class::Tone => 10,
            };
            let integer = (least + integer).min(60);
            let point = point.clamp(1, 62 - integer);
            let width = integer + point;
            let rounding = if registers.are_rounded() { rounding } else { Rounding::Nearest };
            let request = FormatRequest { width, point, rounding, overflow: Overflow::Wrap };
            (registers, request)
        })
        .boxed()
}
