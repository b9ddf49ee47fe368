//! The shader against the emulator's, in every bit and cycle: real frames of many lights and ramps,
//! and corner cases of coefficients and items within the ranges that the modules state; light and
//! ramp by themselves as well, up to the wires between them and the mixer.
#![cfg(rtl)]

mod elastic;
mod random;
mod stock;

use std::sync::Arc;

use elastic::Pace;
use random::Random;
use stock::{SHADING, Stock, bits, packed, word};
use terraline::engine::Memories;
use terraline::frame::Hit;
use terraline::plan::Plan;
use terraline::processor::Processor;
use terraline::scene::load;
use terraline::unit::Line;
use terraline::unit::light::Light;
use terraline::unit::mixer::Mixer;
use terraline::unit::pixel::Pixel;
use terraline::unit::ramp::Ramp;
use terraline::unit::shader::Shader;
use terraline::word::stock::{Narrow, Wide};
use terraline::word::{Cell, Lane, Register, Table};
use terraline_hdl::Model;

/// Entries per unit of the table, as a power of two.
const RSQRT_LOG2: u32 = 10;
const TAG: u64 = 0xffff;

/// Writes words to a table, address by address, under a strobe.
fn write(rtl: &mut Model, strobe: &str, words: impl Iterator<Item = (usize, i64)>) {
    let [strobe, address, data] = [strobe, "load_address", "load_data"].map(|name| rtl.port(name));
    rtl.set(strobe, 1);
    for (at, word) in words {
        rtl.set(address, at as u64);
        rtl.set_signed(data, word);
        rtl.edge();
    }
    rtl.set(strobe, 0);
}

/// Drives the light's coefficient ports and fills its table.
fn load_light<W: Stock>(rtl: &mut Model, light: Option<&Light<W>>, strobe: &str) {
    let mut set = |name: &str, value: i64| rtl.set_signed(rtl.port(name), value);
    set("lit", light.is_some().into());
    if let Some(light) = light {
        assert_eq!(light.rsqrt.log2(), RSQRT_LOG2);
        for (name, toward) in ["toward_x", "toward_y", "toward_z"].into_iter().zip(light.toward) {
            set(name, bits(toward));
        }
        set("ambient", bits(light.ambient));
        write(rtl, strobe, light.rsqrt.entries().iter().map(|&entry| bits(entry)).enumerate());
    }
}

/// The same of the ramp.
fn load_ramp<W: Stock>(rtl: &mut Model, ramp: &Ramp<W>, strobe: &str) {
    let mut set = |name: &str, value: i64| rtl.set_signed(rtl.port(name), value);
    set("ramp_exponent", ramp.exponent.clamp(-128, 127).into());
    set("ramp_gain", bits(ramp.gain));
    set("ramp_last", ramp.segments.len() as i64 - 1);
    let words = ramp.segments.iter().enumerate().flat_map(|(segment, channels)| {
        channels.iter().enumerate().flat_map(move |(channel, &(start, rise))| {
            let at = segment * 8 + channel * 2;
            [(at, bits(start)), (at + 1, bits(rise))]
        })
    });
    write(rtl, strobe, words);
}

/// Drives the coefficient ports of the whole and fills its tables.
fn load_coefficients<W: Stock>(rtl: &mut Model, shader: &Shader<W>) {
    let mut set = |name: &str, value: i64| rtl.set_signed(rtl.port(name), value);
    set("sky_color", packed(shader.pixel.sky) as i64);
    set("out_of_range_color", packed(shader.pixel.out_of_range) as i64);
    set("side_color", packed(shader.pixel.side) as i64);
    load_light(rtl, shader.light.as_ref(), "load_rsqrt");
    load_ramp(rtl, &shader.ramp, "load_ramp");
}

/// Runs the items of a line, whose colours the emulator has computed, through the module.
fn compare<W: Stock>(rtl: &mut Model, line: &Line<W>, random: &mut Random) {
    let pace = Pace::random(random, line.len());
    let [hit, surface] = ["in_hit", "in_surface"].map(|name| rtl.port(name));
    let [slope_x, slope_z] = ["in_slope_x", "in_slope_z"].map(|name| rtl.port(name));
    let in_tag = rtl.port("in_tag");
    let [out_color, out_hit, out_tag] =
        ["out_color", "out_hit", "out_tag"].map(|name| rtl.port(name));
    elastic::run(
        rtl,
        &pace,
        SHADING,
        |rtl, item| {
            let Some(i) = item else {
                rtl.set(hit, random.bits() & 3);
                rtl.set(surface, random.bits() >> (64 - W::WIDTH));
                return;
            };
            rtl.set(hit, line.hit[i] as u64);
            rtl.set_signed(surface, bits(line.surface[i]));
            rtl.set_signed(slope_x, bits(line.slope_x[i]));
            rtl.set_signed(slope_z, bits(line.slope_z[i]));
            rtl.set(in_tag, i as u64 & TAG);
        },
        |rtl, i| {
            assert_eq!(rtl.get(out_tag), i as u64 & TAG);
            assert_eq!(rtl.get(out_hit), line.hit[i] as u64);
            assert_eq!(
                rtl.get(out_color),
                packed(line.color[i]),
                "item {i}: {:?}, surface {:?}, slopes {:?} {:?}",
                line.hit[i],
                line.surface[i],
                line.slope_x[i],
                line.slope_z[i]
            );
        },
    );
}

/// A direction of the light, an ambient share and a ramp, as a scene file gives them.
fn looks(random: &mut Random) -> Vec<String> {
    let mut axis = || random.within(-100, 100) as f64 / 100.0;
    let (x, y, z) = (axis(), axis(), axis());
    let ambient = [0.0, 0.3, 0.95, 1.0][random.within(0, 3) as usize];
    let byte = |random: &mut Random| [0, 255, random.within(0, 255)][random.within(0, 2) as usize];
    let colors: Vec<String> = (0..random.within(2, 16))
        .map(|_| format!("[{}, {}, {}]", byte(random), byte(random), byte(random)))
        .collect();
    vec![
        format!("light.direction=[{x}, {y}, {z}]"),
        format!("light.ambient={ambient}"),
        format!("color.ramp=[{}]", colors.join(", ")),
    ]
}

fn real_frames<W: Stock>(world: W, seed: u64) {
    let mut random = Random(seed);
    let mut rtl = Model::new(&format!("shader_{}", W::NAME));
    // The eye would be under ground that is raised.
    let grounds: [(&[&str], f64); 3] = [
        (&[], 0.0),
        (&["kernel.deformation=1", "kernel.shape=hat"], 0.0),
        (&["surface.height.scale=0.4"], 120.0),
    ];
    for name in ["overview", "flight", "valley"] {
        for (ground, up) in grounds {
            let mut sets = looks(&mut random);
            sets.extend(ground.iter().map(ToString::to_string));
            let mut scene = load(Some(name), &sets).expect("a scene");
            scene.machine.words = W::WORDS;
            scene.screens[0] = scene.screens[0].resized(64, 48);
            scene.camera.position.y += up;
            let plan = Plan::new(&scene, None, false).expect("a plan");
            let setup = Memories::default().set_up(world, &scene, &plan).expect("a set-up");
            let units = setup.surfaces[0].back.terrain().expect("a height map");
            load_coefficients(&mut rtl, &units.shader);
            let mut processor = Processor::new(&setup);
            let mut line = processor.wires();
            let mut met = 0;
            while processor.run_line(&mut line) {
                compare(&mut rtl, &line, &mut random);
                met += line.hit.iter().filter(|&&hit| hit == Hit::Surface).count();
            }
            assert!(met > 1000, "{name} {ground:?}: {met} pixels meet the ground");
        }
    }
}

#[test]
fn real_frames_narrow() {
    real_frames(Narrow, 1);
}

#[test]
fn real_frames_wide() {
    real_frames(Wide, 2);
}

/// Coefficients anywhere in their ranges.
fn corner_case_shader<W: Stock>(world: W, random: &mut Random) -> Shader<W> {
    let one = 1_i64 << W::Tone::FRACTION;
    let toward = |random: &mut Random| match random.within(0, 5) {
        0 => one,
        1 => -one,
        2 => [0, 1, -1, one - 1][random.within(0, 3) as usize],
        _ => random.within(-one, one),
    };
    let ambient = [0, 1, one, random.within(0, one)][random.within(0, 3) as usize];
    let largest = [one, 2 * one][random.within(0, 1) as usize];
    let rsqrt = (0..=4 << RSQRT_LOG2).map(|_| word(random.within(0, largest))).collect();
    let light = Light {
        toward: std::array::from_fn(|_| word(toward(random))),
        ambient: word(ambient),
        one: word(one),
        rsqrt: Arc::new(Table::new(RSQRT_LOG2, rsqrt)),
        normal_format: world.tone(Register::Normal),
    };
    let color = |random: &mut Random| {
        let byte =
            |random: &mut Random| [0, 255, random.within(0, 255)][random.within(0, 2) as usize];
        [byte(random), byte(random), byte(random)]
    };
    let bytes = |random: &mut Random| color(random).map(|byte| byte as u8);
    let colors: Vec<_> = (0..random.within(2, 16)).map(|_| color(random)).collect();
    let segments = colors
        .windows(2)
        .map(|pair| {
            std::array::from_fn(|at| {
                (word(pair[0][at] * one), word((pair[1][at] - pair[0][at]) * one))
            })
        })
        .collect();
    let exponents = [(-128, 127), (-70, 30), (-12, 0), (0, 22)][random.within(0, 3) as usize];
    let pixel = Pixel { sky: bytes(random), out_of_range: bytes(random), side: bytes(random) };
    let shaded = random.is(230);
    Shader {
        light: shaded.then_some(light),
        mixer: Mixer { shaded },
        pixel,
        ramp: Ramp {
            exponent: random.within(exponents.0, exponents.1) as i32,
            gain: word(match random.within(0, 5) {
                0 => 0,
                1 => 30 * one,
                _ => random.within(0, 30 * one),
            }),
            segments,
            format: world.tone(Register::Ramp),
        },
    }
}

/// A height that comes to a value in [-2, 2) on its way to the ramp.
fn corner_case_height<W: Stock>(exponent: i32, random: &mut Random) -> i64 {
    let two = 2_i128 << W::Tone::FRACTION;
    let shifted = match random.within(0, 5) {
        0 => [0, 1, -1, two / 2, two - 1, -two][random.within(0, 5) as usize],
        _ => i128::from(random.within(-(two as i64), two as i64 - 1)),
    };
    let height = if exponent >= 0 {
        shifted / (1 << exponent.min(100))
    } else {
        let places = (-exponent).min(90);
        let low = i128::from(random.bits()) & ((1 << places.min(64)) - 1);
        (shifted << places) + low - (1 << (places - 1))
    };
    let limit = i64::MAX >> (64 - W::WIDTH);
    let height = height.clamp(i128::from(-limit - 1), limit.into()) as i64;
    // The roundings upward at the upper end.
    let up = if exponent < 0 { 1_i128 << (-exponent - 1).min(100) } else { 0 };
    let over = (i128::from(height) + up) >> (-exponent).clamp(0, 100);
    if over < two { height } else { 0 }
}

/// Whether a channel is so near to half a level that an error in the last bit of light or place,
/// times a colour, may move it to the other byte.
fn is_near_rounding<W: Stock>(lit: [W::Tone; 3], within: i64) -> bool {
    let half = 1_i64 << (W::Tone::FRACTION - 1);
    lit.iter().any(|&channel| (bits(channel.fraction()) - half).abs() < within)
}

fn corner_cases<W: Stock>(world: W, seed: u64) {
    const ITEMS: u32 = 2000;
    let mut random = Random(seed);
    let mut rtl = Model::new(&format!("shader_{}", W::NAME));
    for _ in 0..40 {
        let shader = corner_case_shader(world, &mut random);
        load_coefficients(&mut rtl, &shader);
        let mut line = Line::new(&world, 0..ITEMS);
        let mut tried = Line::new(&world, [0]);
        let flat = random.within(0, 1) * 3;
        for i in 0..line.len() {
            // Every other set of items is mostly surface.
            line.hit[i] = match random.within(0, 3 + flat) {
                0 => Hit::Sky,
                2 => Hit::Side,
                3 => Hit::OutOfRange,
                _ => Hit::Surface,
            };
            // Last bits show where a channel is about to round the other way.
            let (within, trials) = [(1, 600), (16, 200), (256, 200)][random.within(0, 2) as usize];
            tried.hit[0] = line.hit[i];
            for _ in 0..trials {
                tried.surface[0] = word(match line.hit[i] {
                    Hit::Surface => corner_case_height::<W>(shader.ramp.exponent, &mut random),
                    _ => random.word(W::WIDTH),
                });
                tried.slope_x[0] = word(random.word(W::WIDTH));
                tried.slope_z[0] = word(random.word(W::WIDTH));
                shader.units().for_each(|unit| unit.run(&mut tried));
                if line.hit[i] != Hit::Surface || is_near_rounding::<W>(tried.lit[0], within) {
                    break;
                }
            }
            line.surface[i] = tried.surface[0];
            (line.slope_x[i], line.slope_z[i]) = (tried.slope_x[0], tried.slope_z[0]);
        }
        shader.units().for_each(|unit| unit.run(&mut line));
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

/// Shade and albedo out of light and ramp alone, eleven cycles behind slopes and height.
fn parts<W: Stock>(world: W, seed: u64) {
    const ITEMS: usize = 2000;
    const LATENCY: usize = 11;
    let mut random = Random(seed);
    let [mut light, mut ramp] =
        ["light", "ramp"].map(|part| Model::new(&format!("{part}_{}", W::NAME)));
    let [slope_x, slope_z, shade] = ["slope_x", "slope_z", "shade"].map(|name| light.port(name));
    let [surface, albedo] = ["surface", "albedo"].map(|name| ramp.port(name));
    for _ in 0..40 {
        let shader = corner_case_shader(world, &mut random);
        load_light(&mut light, shader.light.as_ref(), "load");
        load_ramp(&mut ramp, &shader.ramp, "load");
        let mut line = Line::new(&world, 0..ITEMS as u32);
        line.hit.fill(Hit::Surface);
        for i in 0..ITEMS {
            line.surface[i] = word(corner_case_height::<W>(shader.ramp.exponent, &mut random));
            line.slope_x[i] = word(random.word(W::WIDTH));
            line.slope_z[i] = word(random.word(W::WIDTH));
        }
        shader.units().for_each(|unit| unit.run(&mut line));
        for cycle in 0..ITEMS + LATENCY {
            if cycle < ITEMS {
                light.set_signed(slope_x, bits(line.slope_x[cycle]));
                light.set_signed(slope_z, bits(line.slope_z[cycle]));
                ramp.set_signed(surface, bits(line.surface[cycle]));
            }
            light.settle();
            ramp.settle();
            if let Some(i) = cycle.checked_sub(LATENCY) {
                let full = 1 << W::Tone::FRACTION;
                let expected = if shader.mixer.shaded { bits(line.shade[i]) } else { full };
                assert_eq!(light.get(shade) as i64, expected, "shade of {i}");
                let count = W::Tone::FRACTION + 9;
                let channels = [0, 1, 2].map(|at| ramp.bits(albedo, at * count, count) as i64);
                assert_eq!(channels, line.albedo[i].map(bits), "albedo of {i}");
            }
            light.edge();
            ramp.edge();
        }
    }
}

#[test]
fn shade_and_albedo_narrow() {
    parts(Narrow, 5);
}

#[test]
fn shade_and_albedo_wide() {
    parts(Wide, 6);
}
