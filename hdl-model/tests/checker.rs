//! The checker against the emulator's, in every bit and cycle: real planes, and corner cases of
//! coefficients and items within the ranges that the module states.
#![cfg(rtl)]

mod elastic;
mod random;
mod stock;

use elastic::Pace;
use random::Random;
use stock::{SHADING, Stock, bits, packed, word};
use terraline::engine::Memories;
use terraline::plan::Plan;
use terraline::processor::Processor;
use terraline::scene::load;
use terraline::setup::Back;
use terraline::unit::checker::Checker;
use terraline::unit::line::Entry;
use terraline::unit::pixel::Pixel;
use terraline::unit::{Line, Unit as _};
use terraline::word::stock::{Narrow, Wide};
use terraline::word::{Cell, Lane, Multiply, Register, Site, Word};
use terraline_hdl::Model;

const TAG: u64 = 0xffff;

/// Drives the coefficient ports.
fn load_coefficients<W: Stock>(rtl: &mut Model, checker: &Checker<W>) {
    let mut set = |name: &str, value: i64| rtl.set_signed(rtl.port(name), value);
    set("sky_color", packed(checker.pixel.sky) as i64);
    set("out_of_range_color", packed(checker.pixel.out_of_range) as i64);
    for (at, channel) in ["red", "green", "blue"].into_iter().enumerate() {
        set(&format!("mean_{channel}"), bits(checker.mean[at]));
        set(&format!("swing_{channel}"), bits(checker.swing[at]));
    }
    set("contrast_exponent", checker.contrast_exponent.clamp(-128, 127).into());
    set("contrast_gain", bits(checker.contrast_gain));
    set("full_from", checker.full_from.map_or(0, bits));
    set("full_from_fitted", checker.full_from.is_some().into());
}

/// Runs the items of a line, whose colours the emulator has computed, through the module.
fn compare<W: Stock>(rtl: &mut Model, line: &Line<W>, random: &mut Random) {
    let pace = Pace::random(random, line.len());
    let [entry, denominator] = ["in_entry", "in_denominator"].map(|name| rtl.port(name));
    let [ground_x, ground_z] = ["in_ground_x", "in_ground_z"].map(|name| rtl.port(name));
    let in_tag = rtl.port("in_tag");
    let [out_color, out_hit, out_tag] =
        ["out_color", "out_hit", "out_tag"].map(|name| rtl.port(name));
    elastic::run(
        rtl,
        &pace,
        SHADING,
        |rtl, item| {
            let Some(i) = item else {
                rtl.set(entry, random.bits() & 3);
                rtl.set(denominator, random.bits() >> (64 - W::WIDTH));
                return;
            };
            rtl.set(entry, line.entry[i] as u64);
            rtl.set_signed(denominator, bits(line.denominator[i]));
            rtl.set_signed(ground_x, bits(line.entry_x[i]));
            rtl.set_signed(ground_z, bits(line.entry_z[i]));
            rtl.set(in_tag, i as u64 & TAG);
        },
        |rtl, i| {
            assert_eq!(rtl.get(out_tag), i as u64 & TAG);
            assert_eq!(rtl.get(out_hit), line.hit[i] as u64);
            assert_eq!(
                rtl.get(out_color),
                packed(line.color[i]),
                "item {i}: {:?}, denominator {:?}, place {:?} {:?}",
                line.entry[i],
                line.denominator[i],
                line.entry_x[i],
                line.entry_z[i]
            );
        },
    );
}

/// A plane, its colours and where it is seen from, as a scene file gives them.
fn views(random: &mut Random) -> Vec<String> {
    let mut between = |low, high| random.within(low, high) as f64;
    let normal = [between(-30, 30) / 100.0, 1.0, between(-30, 30) / 100.0];
    let (height, pitch, roll) = (between(1, 400) / 10.0, between(-60, 5), between(-40, 40));
    let square = [0.25, 1.0, 8.0, 300.0][between(0, 3) as usize];
    let mut color = || [(); 3].map(|()| between(0, 255));
    let (even, odd) = (color(), color());
    vec![
        format!("surface.normal={normal:?}"),
        format!("surface.checker={square}"),
        format!("camera.position=[0.0, {height}, 0.0]"),
        format!("camera.pitch={pitch}"),
        format!("camera.roll={roll}"),
        format!(
            "color.checker=[{:?}, {:?}]",
            even.map(|byte| byte as u8),
            odd.map(|byte| byte as u8)
        ),
    ]
}

fn real_frames<W: Stock>(world: W, seed: u64) {
    let mut random = Random(seed);
    let mut rtl = Model::new(&format!("checkers_{}", W::NAME));
    let mut met = 0;
    for _ in 0..16 {
        let sets = views(&mut random);
        let mut scene = load(Some("plane"), &sets).expect("a scene");
        scene.machine.words = W::WORDS;
        scene.screens[0] = scene.screens[0].resized(64, 48);
        // Some planes have positions too fine for the smaller words.
        let Ok(plan) = Plan::new(&scene, None, false) else { continue };
        let setup = Memories::default().set_up(world, &scene, &plan).expect("a set-up");
        let Back::Plane(checker) = &setup.surfaces[0].back else { panic!("a plane") };
        load_coefficients(&mut rtl, checker);
        let mut processor = Processor::new(&setup);
        let mut line = processor.wires();
        while processor.run_line(&mut line) {
            compare(&mut rtl, &line, &mut random);
            met += line.entry.iter().filter(|&&entry| entry == Entry::Met).count();
        }
    }
    assert!(met > 10_000, "{met} pixels meet a plane");
}

#[test]
fn real_frames_narrow() {
    real_frames(Narrow, 1);
}

#[test]
fn real_frames_wide() {
    real_frames(Wide, 2);
}

/// Coefficients anywhere in their ranges, and the largest denominator below full contrast.
fn corner_case_checker<W: Stock>(world: W, random: &mut Random) -> (Checker<W>, i64) {
    let one = 1_i64 << W::Tone::FRACTION;
    let largest = i64::MAX >> (64 - W::WIDTH);
    let byte = |random: &mut Random| [0, 255, random.within(0, 255)][random.within(0, 2) as usize];
    let mut color = || [byte(random), byte(random), byte(random)];
    let (even, odd) = (color(), color());
    let pixel = Pixel {
        sky: color().map(|byte| byte as u8),
        out_of_range: color().map(|byte| byte as u8),
        side: [0; 3],
    };
    let half = |levels: i64| word(levels * (one / 2));
    let exponents = [(-128, 127), (-30, 40), (-3, 3)][random.within(0, 2) as usize];
    let exponent = random.within(exponents.0, exponents.1) as i32;
    // What the exponent leaves at most at 2.
    let two = 2_i128 << W::View::FRACTION;
    let limit = if exponent >= 0 { two >> exponent.min(100) } else { two << (-exponent).min(60) };
    let limit = limit.min(largest.into()) as i64;
    let full = if limit < largest || random.is(128) {
        Some(match random.within(0, 2) {
            0 | 1 => limit,
            _ => random.within(0, limit),
        })
    } else {
        None
    };
    let gain = match random.within(0, 7) {
        0 => 0,
        1 | 2 => one,
        3 => 2 * one,
        4 => random.within(0, one),
        _ => random.within(one, 2 * one),
    };
    let checker = Checker {
        pixel,
        mean: std::array::from_fn(|at| half(even[at] + odd[at])),
        swing: std::array::from_fn(|at| half(even[at] - odd[at])),
        contrast_exponent: exponent,
        contrast_gain: word(gain),
        one: word(one),
        full_from: full.map(word),
        format: world.tone(Register::Shade),
    };
    (checker, full.map_or(limit, |full| (full - 1).max(0)))
}

/// Whether a channel is so near to half a level that an error in the contrast's last bit, times the
/// swing, may move it to the other byte.
fn is_near_rounding<W: Stock>(checker: &Checker<W>, denominator: W::View, within: i64) -> bool {
    let half = 1_i64 << (W::Tone::FRACTION - 1);
    let site = Site::pixel(0, 0);
    let contrast = checker.contrast(denominator, site);
    // Means may be half levels themselves.
    let fades = contrast.is_positive(site) && contrast.is_below(checker.one, site);
    let mut channels = checker.mean.iter().zip(&checker.swing);
    fades
        && channels.any(|(&mean, &swing)| {
            let channel = mean + swing.multiply(contrast, site);
            (bits(channel.fraction()) - half).abs() < within
        })
}

/// A denominator whose contrast c, where gain is one, brings a channel to half a level by the
/// rounding of its product alone: an odd swing s, counted in half levels, with s·c = −1 modulo two
/// levels.
fn tie<W: Stock>(checker: &Checker<W>, channel: usize) -> i64 {
    let point = W::Tone::FRACTION;
    let swing = bits(checker.swing[channel]) >> (point - 1);
    // Newton's iteration doubles the right bits of the reciprocal modulo a power of two.
    let mut reciprocal = swing;
    for _ in 0..6 {
        let error = 2_i64.wrapping_sub(swing.wrapping_mul(reciprocal));
        reciprocal = reciprocal.wrapping_mul(error);
    }
    let contrast = reciprocal.wrapping_neg() & ((2 << point) - 1);
    let scaled = (1 << point) + contrast;
    scaled << (W::View::FRACTION - point) >> checker.contrast_exponent.clamp(0, 40)
}

fn corner_cases<W: Stock>(world: W, seed: u64) {
    const ITEMS: u32 = 2000;
    /// Items tried for one near a rounding.
    const TRIALS: u32 = 200;
    let mut random = Random(seed);
    let mut rtl = Model::new(&format!("checkers_{}", W::NAME));
    let largest = i64::MAX >> (64 - W::WIDTH);
    for _ in 0..60 {
        let (checker, below) = corner_case_checker(world, &mut random);
        load_coefficients(&mut rtl, &checker);
        let mut line = Line::new(&world, 0..ITEMS);
        for i in 0..line.len() {
            line.entry[i] = match random.within(0, 7) {
                0 => Entry::Sky,
                1 => Entry::OutOfRange,
                _ => Entry::Met,
            };
            let full = checker.full_from.map_or(0, bits);
            // Last bits show where a channel is about to round the other way.
            let within = [1, 8, 128][random.within(0, 2) as usize];
            for _ in 0..TRIALS {
                line.denominator[i] = word(match line.entry[i] {
                    Entry::Met => match random.within(0, 9) {
                        0 => below,
                        1 if checker.full_from.is_some() => full,
                        2 if checker.full_from.is_some() => random.within(full, largest),
                        3 => (below / 2 + random.within(-1, 1)).clamp(0, below),
                        4 => random.within(0, below) >> random.within(0, 40),
                        5 => tie(&checker, random.within(0, 2) as usize).clamp(0, below),
                        _ => random.within(0, below),
                    },
                    _ => random.word(W::WIDTH),
                });
                if line.entry[i] != Entry::Met
                    || is_near_rounding(&checker, line.denominator[i], within)
                {
                    break;
                }
            }
            line.entry_x[i] = word(random.word(W::WIDTH));
            line.entry_z[i] = word(random.word(W::WIDTH));
        }
        checker.run(&mut line);
        compare(&mut rtl, &line, &mut random);
    }
}

#[test]
fn corner_cases_in_narrow_words() {
    corner_cases(Narrow, 3);
}

#[test]
fn corner_cases_in_wide_words() {
    corner_cases(Wide, 4);
}
