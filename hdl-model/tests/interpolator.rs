//! The interpolator: every answer and its cycle, against the emulator's unit.
#![cfg(rtl)]

mod random;

use std::collections::VecDeque;
use std::sync::Arc;

use random::Random;
use terraline::scene::KernelShape;
use terraline::setup::kernel;
use terraline::setup::table::LERP_LATENCY;
use terraline::unit::height_memory::{Edge, HeightMemory};
use terraline::unit::interpolator::{Form, Interpolator};
use terraline::unit::kernel_rom::KernelRom;
use terraline::unit::stepper::SurfaceUnit;
use terraline::word::stock::{Narrow, Wide};
use terraline::word::{Interpolating, Lane, Load, Multiply, Readout, Register, Site, World};
use terraline_hdl::{Model, Port};

/// The stock worlds, whose words are made of bits.
trait Bits:
    Interpolating
    + World<
        Ground: Load,
        Height: Load + Readout + Multiply<Self::Weight>,
        Weight: Load<Format = ()> + Readout,
    >
{
    const NAME: &'static str;
    /// Bits of a word, fraction bits, bits of a cell's index in the RTL.
    const WIDTH: u32;
    const POINT: u32;
    const CELL: u32;
    fn ground(bits: i64) -> Self::Ground;
    fn height(bits: i64) -> Self::Height;
    fn weight(bits: i64) -> Self::Weight;
}

macro_rules! bits {
    ($world:ident $name:literal $int:ident $point:literal $cell:literal) => {
        impl Bits for $world {
            const NAME: &'static str = $name;
            const WIDTH: u32 = $int::BITS;
            const POINT: u32 = $point;
            const CELL: u32 = $cell;
            fn ground(bits: i64) -> Self::Ground {
                Lane::of_int(bits as $int)
            }
            fn height(bits: i64) -> Self::Height {
                Lane::of_int(bits as $int)
            }
            fn weight(bits: i64) -> Self::Weight {
                Lane::of_int(bits as $int)
            }
        }
    };
}
bits! { Narrow "narrow" i32 20 12 }
bits! { Wide "wide" i64 24 26 }

fn raw(word: impl Readout) -> i64 {
    word.raw().expect("stock words have bits")
}

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
            Form::Blend(shift) => (1, shift.min(63)),
            Form::Hat => (2, 0),
            Form::Stretch => (3, 0),
        };
        let heights = Arc::clone(&self.emulator.heights);
        self.set("form", form);
        self.set("blend_shift", shift.into());
        self.set("map_columns", heights.columns().into());
        self.set("map_rows", heights.rows().into());
        self.set("edge_rule", i64::from(heights.edge() == Edge::Clamps));
        self.set("voids", heights.has_voids().into());
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
                [("load_weight", rom.weight(entry)), ("load_slope", rom.slope(entry))]
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
        let exists = self.emulator.contains(x, z);
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
            (self.random.word(), true)
        })
    }

    /// Streams tokens; requires every answer in its cycle, and no other one.
    fn stream(&mut self, tokens: &[Token], memory_latency: usize) -> usize {
        let reads = if self.emulator.form == Form::Stretch { 4 } else { 1 };
        let latency = LERP_LATENCY + if self.slopes { 2 } else { 0 };
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
                None => (self.random.word(), self.random.word(), 0, self.random.below(2) == 0),
            };
            self.rtl.set(request_first, first.into());
            self.rtl.set_signed(request_x, x);
            self.rtl.set_signed(request_z, z);
            self.rtl.set(request_tag, tag);
            let arrived: Option<[(i64, bool); 4]> = memory.pop_front().expect("as long as M");
            self.rtl.set(data_valid, arrived.is_some().into());
            let words = arrived.unwrap_or_else(|| [0; 4].map(|_| (self.random.word(), true)));
            set_words(&mut self.rtl, data, W::WIDTH, words.map(|(height, _)| height));
            let voids = words.iter().enumerate().map(|(bank, &(_, void))| u64::from(void) << bank);
            self.rtl.set(void, voids.sum());
            self.rtl.settle();

            assert_eq!(self.rtl.is(read), request.is_some());
            if let Some((token, cycle)) = request {
                assert_eq!(self.rtl.is(request_last), cycle + 1 == reads);
                if cycle + 1 == reads {
                    let cycle = self.rtl.cycle() + memory_latency as u64 + u64::from(latency);
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

/// A kernel as set-up makes it, or one of extreme and random entries.
fn rom<W: Bits>(
    shape: Option<KernelShape>,
    stretched: bool,
    log2: u32,
    random: &mut Random,
) -> KernelRom<W::Weight> {
    let one = 1_i64 << W::POINT;
    let entries = 1_u32 << log2;
    let (weights, slopes): (Vec<_>, Vec<_>) = (0..=entries)
        .map(|entry| {
            let t = f64::from(entry) / f64::from(entries);
            let load = |value| W::Weight::load(value, ()).expect("kernels fit");
            match shape {
                Some(shape) if stretched => (
                    load(kernel::stretched(shape, t + 0.5)),
                    load(kernel::stretched_slope(shape, t + 0.5)),
                ),
                Some(shape) => (load(kernel::value(shape, t)), load(kernel::slope(shape, t))),
                None => {
                    let weight = random.among(&[0, 1, one - 1, one, -1]);
                    let weight = if weight < 0 { random.below(one + 1) } else { weight };
                    let slope = random.among(&[0, 4 * one - 1, 1 - 4 * one, -one, one + 1, one]);
                    let slope =
                        if slope == one { random.below(8 * one - 1) - 4 * one + 1 } else { slope };
                    (<W as Bits>::weight(weight), <W as Bits>::weight(slope))
                }
            }
        })
        .unzip();
    KernelRom::new(log2, weights, slopes)
}

/// A map of random nodes: flat, small, of the plan's range, or of all words that are not negative.
fn heights<W: Bits>(random: &mut Random) -> HeightMemory<W::Height> {
    let sizes = [1, 2, 3, 4, 5, 8, 33, 64];
    // One node a side has no cell: such maps only go on.
    let edge = if random.below(2) == 0 { Edge::Ends } else { Edge::Clamps };
    let side = |random: &mut Random| match (edge, random.among(&sizes)) {
        (Edge::Ends, 1) => 2,
        (_, side) => side,
    };
    let (columns, rows) = (side(random), side(random));
    let limit =
        random.among(&[1, 7, 1 << W::POINT, 1 << (W::WIDTH - 4), i64::MAX >> (64 - W::WIDTH)]);
    let nodes = (0..columns * rows)
        .map(|_| <W as Bits>::height(random.among(&[0, limit, -1])))
        .collect::<Vec<_>>();
    let nodes = nodes
        .into_iter()
        .map(|node| if raw(node) < 0 { <W as Bits>::height(random.below(limit)) } else { node })
        .collect();
    let memory = HeightMemory::new(nodes, columns, rows, edge);
    match random.below(3) {
        0 => memory,
        1 => memory.with_voids((0..columns * rows).map(|_| random.below(9) == 0).collect()),
        _ => memory.with_voids(vec![false; columns * rows]),
    }
}

fn place<W: Bits>(size: i32, random: &mut Random) -> i64 {
    let one = 1_i64 << W::POINT;
    let cells = 1_i64 << (W::CELL - 1);
    let cell = match random.below(8) {
        0 => random.among(&[-cells, 1 - cells, cells - 1, cells - 2]),
        1 => random.below(2 * cells) - cells,
        2 => random.among(&[-2, -1, i64::from(size) - 2, i64::from(size) - 1, i64::from(size)]),
        _ => random.below(i64::from(size) + 3) - 2,
    };
    let fraction = match random.below(4) {
        0 => random.among(&[0, 1, one - 1, one / 2, one / 2 - 1, one / 2 + 1]),
        // About the border between two entries.
        1 => (random.below(64) << (W::POINT - 6)) + random.below(3) & (one - 1),
        _ => random.below(one),
    };
    cell * one + fraction
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
            2 => Form::Blend(random.among(&[0, 1, 23, 24, 25, 31, 32, 63])),
            _ => Form::Blend(random.below(8) as u32),
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
