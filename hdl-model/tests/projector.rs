//! The projector against the emulator's unit: accumulators that wrap, on rasters of any shape.
#![cfg(rtl)]

mod random;

use random::Random;
use terraline::clock::Taker;
use terraline::unit::projector::{Linear, Projector};
use terraline::unit::{Line, Unit as _};
use terraline::word::stock::{Narrow, Wide};
use terraline::word::{Lane, World};
use terraline_hdl::Model;

const QUANTITIES: [&str; 4] = ["view_x", "view_y", "view_z", "denominator"];

/// Draws frames with random coefficients, wraps included, under back-pressure.
fn compare<W: World<View: Lane>>(
    world: W,
    model: &str,
    width: u32,
    word: impl Fn(i64) -> W::View,
    bits: impl Fn(W::View) -> i64,
    pixels: u64,
) {
    let mut rtl = Model::new(model);
    let [reset, start, running, last_column, step, valid, ready] =
        ["reset", "start", "running", "last_column", "step", "out_valid", "out_ready"]
            .map(|name| rtl.port(name));
    let outputs = QUANTITIES.map(|name| rtl.port(&format!("out_{name}")));
    let (mut drawn, mut frame) = (0, 0);
    while drawn < pixels {
        frame += 1;
        let mut random = Random(frame << 20);
        let (columns, lines) = (1 + random.below(400) as u32, 1 + random.below(40) as u32);
        let mut linear = |name: &str| {
            let mut coefficient = |part: &str| {
                let value = random.word(width);
                let port = rtl.port(&format!("{name}_{part}"));
                rtl.set_signed(port, value);
                word(value)
            };
            Linear {
                start: coefficient("start"),
                per_line: coefficient("per_line"),
                per_column: coefficient("per_column"),
            }
        };
        let unit: Projector<W> = Projector {
            surface: 0,
            x: linear("view_x"),
            y: Some(linear("view_y")),
            z: linear("view_z"),
            denominator: Some(linear("denominator")),
        };
        let mut expected = Vec::new();
        let mut line = Line::new(&world, 0..columns);
        let mut first = unit.first_line();
        for _ in 0..lines {
            line.start = vec![first];
            unit.run(&mut line);
            for i in 0..columns as usize {
                let wires = [line.view_x[i], line.view_y[i], line.view_z[i], line.denominator[i]];
                expected.push(wires.map(&bits));
            }
            unit.next_line(&mut first);
        }
        let taker = Taker::Busy { seed: frame, of_256: (frame % 3 * 100) as u8 };
        rtl.set(reset, 1);
        rtl.set(running, 0);
        rtl.edge();
        rtl.set(reset, 0);
        rtl.set(start, 1);
        rtl.edge();
        rtl.set(start, 0);
        let (mut taken, mut left, mut cycle) = (0, 0, 0);
        while left < expected.len() {
            rtl.set(running, (taken < expected.len()).into());
            rtl.set(last_column, (taken as u32 % columns == columns - 1).into());
            let is_ready = taker.is_ready(cycle);
            rtl.set(ready, is_ready.into());
            rtl.settle();
            taken += usize::from(rtl.is(step));
            if is_ready && rtl.is(valid) {
                let found = outputs.map(|port| rtl.signed(port));
                assert_eq!(found, expected[left], "{columns} x {lines}, pixel {left}");
                left += 1;
            }
            rtl.edge();
            cycle += 1;
            assert!(cycle < 1000 + 10 * expected.len() as u64, "the projector is stuck");
        }
        drawn += expected.len() as u64;
    }
}

#[test]
fn narrow_words() {
    let bits = |word: <Narrow as World>::View| word.int().into();
    compare(Narrow, "projector_narrow", 32, |w| Lane::of_int(w as i32), bits, 800_000);
}

#[test]
fn wide_words() {
    compare(Wide, "projector_wide", 64, Lane::of_int, Lane::int, 400_000);
}
