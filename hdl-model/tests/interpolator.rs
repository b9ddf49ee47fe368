//! The interpolator: every answer and its cycle, against the emulator's unit.
#![cfg(rtl)]

mod machines;
mod random;

use std::collections::VecDeque;
use std::sync::Arc;

use machines::{Bits, heights, place, raw, rom};
use random::Random;
use terraline::scene::KernelShape;
use terraline::unit::height_memory::Edge;
use terraline::unit::interpolator::{Form, Interpolator, LERP_LATENCY, SLOPE_LATENCY};
use terraline::unit::kernel_rom::LATENCY as KERNEL_LATENCY;
use terraline::unit::surface_unit::SurfaceUnit;
use terraline::word::stock::{Narrow, Wide};
use terraline::word::{Multiply, Register, Site};
use terraline_hdl::{Model, Port};

/// A token: a place that is read in R cycles, or left before.
#[derive(Clone, Copy, Debug)]
struct Token {
    x: i64,
    z: i64,
    tag: u64,
    /// Cycles that it is held; fewer than R where it is left.
    cycles: u32,
    /// Cycles without a request behind it.
    pause: u32,
}

/// What an answer must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Answer {
    exists: bool,
    surface: i64,
    slopes: [i64; 2],
    tag: u64,
}

struct Bench<W: Bits> {
    rtl: Model,
    emulator: Interpolator<W>,
    slopes: bool,
    random: Random,
}

impl<W: Bits> Bench<W> {
    fn new(rtl: Model, emulator: Interpolator<W>, slopes: bool, random: Random) -> Self {
        let mut bench = Self { rtl, emulator, slopes, random };
        bench.reset();
        bench.load();
        bench
    }

    fn set(&mut self, name: &str, value: i64) {
        let port = self.rtl.port(name);
        self.rtl.set_signed(port, value);
    }

    fn reset(&mut self) {
        for name in ["request_valid", "data_valid", "load_weight", "load_slope"] {
            self.set(name, 0);
        }
        self.set("reset", 1);
        self.rtl.edge();
        self.set("reset", 0);
    }

    /// Coefficients and tables.
    fn load(&mut self) {
        let (form, shift) = match self.emulator.form {
            Form::Plain => (0, 0),
            Form::TowardHat(shift) => (1, shift.min(63)),
            Form::Hat => (2, 0),
            Form::Stretch => (3, 0),
        };
        let heights = Arc::clone(&self.emulator.heights);
        self.set("form", form);
        self.set("deformation_shift", shift.into());
        self.set("map_columns", heights.columns().into());
        self.set("map_rows", heights.rows().into());
        self.set("map_ends", (heights.edge() == Edge::Ends).into());
        self.set("void_bits", heights.has_voids().into());
        self.set("slope_scaled", self.emulator.slope_scale.is_some().into());
        if let Some([x, z]) = self.emulator.slope_scale {
            self.set("slope_scale_x", raw(x));
            self.set("slope_scale_z", raw(z));
        }
        let Some(rom) = self.emulator.rom.clone() else { return };
        self.set("table_log2", rom.log2().into());
        for entry in 0..=1 << rom.log2() {
            self.set("load_address", entry as i64);
            for (strobe, word) in
                [("load_weight", rom.weights().at(entry)), ("load_slope", rom.slopes().at(entry))]
            {
                self.set("load_data", raw(word));
                self.set(strobe, 1);
                self.rtl.edge();
                self.set(strobe, 0);
            }
        }
    }

    fn expected(&self, token: Token) -> Answer {
        let (x, z) = (<W as Bits>::ground(token.x), <W as Bits>::ground(token.z));
        let site = Site::pixel(0, 0);
        let exists = self.emulator.contains(x, z, site);
        let surface = raw(self.emulator.height(x, z, site));
        let mut slopes = [0; 2];
        if self.slopes {
            let sample = self.emulator.sample(x, z, site);
            assert_eq!(raw(sample.surface), surface);
            let scaled = |slope: W::Height, axis: usize| {
                self.emulator
                    .slope_scale
                    .map_or(slope, |scale| slope.multiply(scale[axis], site.at(Register::SlopeX)))
            };
            slopes = [raw(scaled(sample.slope_x, 0)), raw(scaled(sample.slope_z, 1))];
        }
        Answer { exists, surface, slopes, tag: token.tag }
    }

    /// What the four banks answer to the addresses at the ports.
    fn nodes(&mut self) -> [(i64, bool); 4] {
        let heights = Arc::clone(&self.emulator.heights);
        let field = W::CELL - 1;
        let read = |rtl: &Model, name, bank: u32| bits_at(rtl, rtl.port(name), bank * field, field);
        [0, 1, 2, 3].map(|bank| {
            let column = 2 * read(&self.rtl, "read_column", bank) as usize + (bank & 1) as usize;
            let row = 2 * read(&self.rtl, "read_row", bank) as usize + (bank >> 1) as usize;
            let (columns, rows) = (heights.columns() as usize, heights.rows() as usize);
            if column < columns && row < rows {
                let void = heights.any_void(column as i32, row as i32, 1);
                return (raw(heights.at(column, row)), void);
            }
            // Only the bank of odd nodes of a single one, which is empty.
            assert!((columns == 1 && column == 1) || (rows == 1 && row == 1), "{column}, {row}");
            (self.random.bits() as i64, true)
        })
    }

    /// Streams tokens; requires every answer in its cycle, and no other one.
    fn stream(&mut self, tokens: &[Token], memory_latency: usize) -> usize {
        let reads = if self.emulator.form == Form::Stretch { 4 } else { 1 };
        let latency = LERP_LATENCY + if self.slopes { SLOPE_LATENCY } else { 0 };
        let rtl = &self.rtl;
        let [
            request_valid,
            request_first,
            request_x,
            request_z,
            request_tag,
            data_valid,
            data,
            void,
        ] = [
            "request_valid",
            "request_first",
            "request_x",
            "request_z",
            "request_tag",
            "data_valid",
            "data",
            "data_void",
        ]
        .map(|name| rtl.port(name));
        let [request_last, read, answer_valid] =
            ["request_last", "read", "answer_valid"].map(|name| rtl.port(name));
        let answers =
            ["answer_exists", "answer_surface", "answer_slope_x", "answer_slope_z", "answer_tag"]
                .map(|name| rtl.port(name));

        let mut memory = VecDeque::from(vec![None; memory_latency]);
        let mut due = VecDeque::new();
        let mut requests = tokens.iter().flat_map(|&token| {
            let held = (0..token.cycles).map(move |cycle| Some((token, cycle)));
            held.chain((0..token.pause).map(|_| None))
        });
        let mut answered = 0;
        let mut idle = 0;
        while idle < memory_latency + latency as usize + 2 {
            let request = requests.next();
            idle += usize::from(request.is_none());
            let request = request.flatten();
            self.rtl.set(request_valid, request.is_some().into());
            let (x, z, tag, first) = match request {
                Some((token, cycle)) => (token.x, token.z, token.tag, cycle == 0),
                None => (
                    self.random.bits() as i64,
                    self.random.bits() as i64,
                    0,
                    self.random.below(2) == 0,
                ),
            };
            self.rtl.set(request_first, first.into());
            self.rtl.set_signed(request_x, x);
            self.rtl.set_signed(request_z, z);
            self.rtl.set(request_tag, tag);
            let arrived: Option<[(i64, bool); 4]> = memory.pop_front().expect("as long as M");
            self.rtl.set(data_valid, arrived.is_some().into());
            let words =
                arrived.unwrap_or_else(|| [0; 4].map(|_| (self.random.bits() as i64, true)));
            set_words(&mut self.rtl, data, W::WIDTH, words.map(|(height, _)| height));
            let voids = words.iter().enumerate().map(|(bank, &(_, void))| u64::from(void) << bank);
            self.rtl.set(void, voids.sum());
            self.rtl.settle();

            assert_eq!(self.rtl.is(read), request.is_some());
            if let Some((token, cycle)) = request {
                assert_eq!(self.rtl.is(request_last), cycle + 1 == reads);
                if cycle + 1 == reads {
                    let nodes = KERNEL_LATENCY.max(memory_latency as u32);
                    let cycle = self.rtl.cycle() + u64::from(nodes + latency);
                    due.push_back((cycle, token));
                }
            }
            let nodes = request.map(|_| self.nodes());
            memory.push_back(nodes);

            let now = due.front().is_some_and(|&(cycle, _)| cycle == self.rtl.cycle());
            assert_eq!(self.rtl.is(answer_valid), now, "cycle {}", self.rtl.cycle());
            if now {
                let (_, token) = due.pop_front().expect("it was there");
                let [exists, surface, slope_x, slope_z, tag] = answers;
                let answer = Answer {
                    exists: self.rtl.is(exists),
                    surface: self.rtl.signed(surface),
                    slopes: [self.rtl.signed(slope_x), self.rtl.signed(slope_z)],
                    tag: self.rtl.get(tag),
                };
                let (form, scale) = (self.emulator.form, self.emulator.slope_scale);
                assert_eq!(answer, self.expected(token), "{form:?} {scale:?} {token:x?}");
                answered += 1;
            }
            self.rtl.edge();
        }
        assert!(due.is_empty());
        answered
    }
}

/// Bits of a port that may be wide.
fn bits_at(rtl: &Model, port: Port, from: u32, count: u32) -> u64 {
    let (word, shift) = (from / 64, from % 64);
    let mut bits = u128::from(rtl.part(port, word));
    if shift + count > 64 {
        bits |= u128::from(rtl.part(port, word + 1)) << 64;
    }
    (bits >> shift) as u64 & ((1 << count) - 1)
}

fn set_words(rtl: &mut Model, port: Port, width: u32, words: [i64; 4]) {
    if width == 64 {
        for (at, word) in (0..).zip(words) {
            rtl.set_part(port, at, word as u64);
        }
    } else {
        for (at, pair) in (0..).zip(words.chunks(2)) {
            rtl.set_part(port, at, (pair[1] as u64) << 32 | u64::from(pair[0] as u32));
        }
    }
}

/// Runs one model over random machines and places; returns the number of answers.
fn compare<W: Bits>(stretch: bool, slopes: bool, seed: u64) -> usize {
    const SHAPES: [Option<KernelShape>; 5] = [
        Some(KernelShape::Cosine),
        Some(KernelShape::Parabola),
        Some(KernelShape::Exponential),
        Some(KernelShape::Hat),
        None,
    ];
    let name = format!(
        "interpolator_{}_{}_{}",
        W::NAME,
        if stretch { "stretch" } else { "cell" },
        if slopes { "slopes" } else { "height" }
    );
    let mut random = Random(seed);
    let reads = if stretch { 4 } else { 1 };
    let mut answered = 0;
    // The largest tables in two machines: loading takes a while.
    for machine in 0..60 {
        let log2 = match machine {
            0 | 1 => 16,
            _ => 4 + random.below(if machine < 10 { 9 } else { 5 }) as u32,
        };
        let shape = SHAPES[machine % 5];
        let form = match machine % 7 {
            _ if stretch => Form::Stretch,
            0 => Form::Plain,
            1 => Form::Hat,
            2 => Form::TowardHat(random.among(&[0, 1, 23, 24, 25, 31, 32, 63])),
            _ => Form::TowardHat(random.below(8) as u32),
        };
        let scale = |random: &mut Random| {
            let one = 1_i64 << W::POINT;
            let largest = i64::MAX >> (64 - W::WIDTH);
            let scale = random.among(&[1, one, one + 1, largest, 0]);
            <W as Bits>::weight(if scale == 0 { 1 + random.below(4 * one) } else { scale })
        };
        let heights = Arc::new(heights::<W>(&mut random));
        let emulator = Interpolator::<W> {
            rom: (form != Form::Hat).then(|| Arc::new(rom::<W>(shape, stretch, log2, &mut random))),
            form,
            one: <W as Bits>::weight(1 << W::POINT),
            slope_scale: (random.below(2) == 0).then(|| [scale(&mut random), scale(&mut random)]),
            weight_format: (),
            heights: Arc::clone(&heights),
        };
        let tokens = (0..300)
            .map(|_| Token {
                x: place::<W>(heights.columns(), &mut random),
                z: place::<W>(heights.rows(), &mut random),
                tag: random.below(128) as u64,
                cycles: if random.below(6) == 0 {
                    1 + random.below(i64::from(reads)) as u32
                } else {
                    reads
                },
                pause: if random.below(4) == 0 { random.below(9) as u32 } else { 0 },
            })
            .collect::<Vec<_>>();
        let mut bench = Bench::new(Model::new(&name), emulator, slopes, Random(machine as u64));
        // A token that is left by dropping the request has a pause behind it, another one has none.
        answered += bench.stream(&tokens, [1, 2, 5][machine % 3]);
    }
    answered
}

fn compare_all<W: Bits>(stretch: bool) {
    let answered = compare::<W>(stretch, false, 1) + compare::<W>(stretch, true, 2);
    println!("{answered} interpolations");
    assert!(answered > 25_000);
}

#[test]
fn narrow_over_four_nodes() {
    compare_all::<Narrow>(false);
}

#[test]
fn narrow_over_nine_nodes() {
    compare_all::<Narrow>(true);
}

#[test]
fn wide_over_four_nodes() {
    compare_all::<Wide>(false);
}

#[test]
fn wide_over_nine_nodes() {
    compare_all::<Wide>(true);
}
