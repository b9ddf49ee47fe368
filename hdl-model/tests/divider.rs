//! The divider against the emulator's unit: outcomes, quotients and cycles.
#![cfg(rtl)]

mod elastic;
mod random;

use elastic::{Pace, Timing};
use random::Random;
use terraline::unit::divider::{Divider, ENDS as DIVIDER_ENDS};
use terraline::unit::line::Entry;
use terraline::unit::{Line, Unit as _};
use terraline::word::stock::{Narrow, Wide};
use terraline::word::{Dividing, Lane, Ratio};
use terraline_hdl::Model;

/// A word size.
trait Size: Dividing<View: Lane, Ground: Lane> + Default {
    const NAME: &'static str;
    const WIDTH: u32;
    const POINT: u32;
    const STAGES: u32;
    fn view_word(bits: i64) -> Self::View;
    fn ground_word(bits: i64) -> Self::Ground;
    fn bits(word: Self::Ground) -> i64;
    fn ratio(exponent: i32, range: u32) -> Ratio<<Self::Ground as terraline::word::Word>::Format>;
}

macro_rules! size {
    ($world:ident, $int:ident, $name:literal, $width:literal, $point:literal, $stages:literal) => {
        impl Size for $world {
            const NAME: &'static str = $name;
            const WIDTH: u32 = $width;
            const POINT: u32 = $point;
            const STAGES: u32 = $stages;
            fn view_word(bits: i64) -> Self::View {
                Lane::of_int(bits as $int)
            }
            fn ground_word(bits: i64) -> Self::Ground {
                Lane::of_int(bits as $int)
            }
            fn bits(word: Self::Ground) -> i64 {
                word.int().into()
            }
            fn ratio(exponent: i32, range: u32) -> Ratio<()> {
                Ratio { exponent, range, format: () }
            }
        }
    };
}

size!(Narrow, i32, "narrow", 32, 20, 32);
size!(Wide, i64, "wide", 64, 24, 49);

/// Numerators and a denominator: of any size, or with a ratio near the ends of the range.
fn item<S: Size>(random: &mut Random, shift: i32, bits: u32) -> [i64; 3] {
    let denominator = match random.below(6) {
        0 => 1 + random.below(4),
        _ => random.word(S::WIDTH),
    };
    let numerator = |random: &mut Random| {
        if random.below(3) > 0 {
            return random.word(S::WIDTH);
        }
        // denominator · 2^(bits-1-shift), give or take.
        let exact = (i128::from(denominator) << (bits - 1)) >> shift.clamp(-60, 60).max(0);
        let near = exact + i128::from(random.below(5)) - 2;
        let near = if random.below(2) == 0 { near } else { -near };
        let spare = 64 - S::WIDTH;
        (near as i64) << spare >> spare
    };
    let (x, z) = (numerator(random), numerator(random));
    [x, z, denominator]
}

fn compare<S: Size>(serial: bool, rounds: u64, count: usize) {
    let name = if serial { "divider_serial_" } else { "divider_" }.to_owned() + S::NAME;
    let mut rtl = Model::new(&name);
    let inputs = ["in_view_x", "in_view_z", "in_denominator"].map(|name| rtl.port(name));
    let [entry, ground_x, ground_z] =
        ["out_entry", "out_ground_x", "out_ground_z"].map(|name| rtl.port(name));
    for round in 0..rounds {
        let mut random = Random(round << 32);
        let range = random.below(i64::from(S::STAGES - S::POINT)) as u32;
        let bits = range + S::POINT + 1;
        let shift = random.below(i64::from(S::WIDTH + bits + 50)) as i32 - 50;
        let (eye_x, eye_z) = (random.word(S::WIDTH), random.word(S::WIDTH));
        let ratio = S::ratio(shift - S::POINT as i32, range);
        let unit: Divider<S> = Divider {
            eye_x: S::ground_word(eye_x),
            eye_z: S::ground_word(eye_z),
            ratio_x: ratio,
            ratio_z: ratio,
            shifts: [shift; 2],
            bits: [bits; 2],
            serial,
        };
        let items: Vec<_> = (0..count).map(|_| item::<S>(&mut random, shift, bits)).collect();
        let mut line = Line::new(&S::default(), 0..count as u32);
        for (i, item) in items.iter().enumerate() {
            line.view_x[i] = S::view_word(item[0]);
            line.view_z[i] = S::view_word(item[1]);
            line.denominator[i] = S::view_word(item[2]);
        }
        unit.run(&mut line);
        let mut set = |name, value| rtl.set_signed(rtl.port(name), value);
        set("eye_x", eye_x);
        set("eye_z", eye_z);
        // As set-up loads it.
        set("ratio_shift", shift.min((S::WIDTH + bits) as i32 - 2).into());
        set("ratio_bits", bits.into());
        let cycles = u64::from(bits + DIVIDER_ENDS);
        let timing = if serial {
            Timing { work: cycles, latency: 1, depth: 2 }
        } else {
            Timing { work: 1, latency: cycles, depth: cycles as usize + 1 }
        };
        let pace = Pace::random(&mut random, count);
        let put = |rtl: &mut Model, at: Option<usize>| {
            let words = at.map_or_else(|| [(); 3].map(|()| random.word(S::WIDTH)), |at| items[at]);
            inputs.iter().zip(words).for_each(|(&port, word)| rtl.set_signed(port, word));
        };
        let check = |rtl: &Model, i: usize| {
            let item = items[i];
            assert_eq!(
                rtl.get(entry),
                line.entry[i] as u64,
                "{item:?}, shift {shift}, {bits} bits"
            );
            if line.entry[i] == Entry::Met {
                let found = [ground_x, ground_z].map(|port| rtl.signed(port));
                let expected = [S::bits(line.entry_x[i]), S::bits(line.entry_z[i])];
                assert_eq!(found, expected, "{item:?}, shift {shift}, {bits} bits");
            }
        };
        elastic::run(&mut rtl, &pace, timing, put, check);
    }
}

#[test]
fn narrow_array() {
    compare::<Narrow>(false, 300, 2500);
}

#[test]
fn wide_array() {
    compare::<Wide>(false, 125, 2000);
}

#[test]
fn narrow_serial() {
    compare::<Narrow>(true, 60, 200);
}

#[test]
fn wide_serial() {
    compare::<Wide>(true, 60, 200);
}
