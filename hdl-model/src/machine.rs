//! The whole processor in RTL, with its memories: loads a set-up, draws a frame, and says what passed
//! between the units in which cycle.

use terraline::clock::Sink;
use terraline::scene::{Machine as Parameters, RatioForm};
use terraline::setup::{Back, Setup, TerrainUnits};
use terraline::unit::height_memory::Edge;
use terraline::unit::interpolator::Form;
use terraline::word::Complete;

use crate::coefficients::{self, raw};
use crate::memory::Delay;
use crate::{Model, Port};

/// Units, in the order of the machine's `takes`.
pub const UNITS: [&str; 6] = ["projector", "divider", "stepper", "interpolator", "shader", "frame"];

/// Nodes of the four banks, and which of them have no data.
type Nodes = ([u64; 4], u64);

/// Address spaces of the load port.
const COEFFICIENTS: u64 = 0;
const WEIGHTS: u64 = 1;
const SLOPES: u64 = 2;
const RSQRT: u64 = 3;
const RAMP: u64 = 4;

/// What a unit handed on for one pixel: words on its output wires, in the order of
/// [`wires`].
pub type Words = [i64; 4];

/// Output wires of each unit but the frame.
pub const fn wires(unit: usize) -> &'static [&'static str] {
    match unit {
        0 => &["view_x", "view_y", "view_z", "denominator"],
        1 => &["entry", "entry_x", "entry_z"],
        2 => &["walk_hit", "ground_x", "ground_z", "steps"],
        3 => &["surface_hit", "surface", "slope_x", "slope_z"],
        4 => &["pixel_hit", "pixel_color"],
        _ => &[],
    }
}

/// What happened in a cycle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cycle {
    /// Bit per unit: it took an item at the end of this cycle.
    pub takes: u64,
    /// Bit per unit: an item waited before it.
    pub waits: u64,
}

/// A machine with its memories, loaded.
#[derive(Debug)]
pub struct Machine<'a, W: Complete> {
    rtl: Model,
    units: Option<&'a TerrainUnits<W>>,
    latency: u32,
    probes: Vec<Vec<Port>>,
    unsigned: Vec<Vec<bool>>,
    takes: Port,
    waits: Port,
    pixel_ready: Port,
    bound: Delay<i64>,
    bound_ports: [Port; 6],
    samples: Delay<Nodes>,
    sample_ports: [Port; 6],
    hits: Delay<Nodes>,
    hit_ports: [Port; 6],
    start: u64,
}

/// The model that draws a set-up, or why there is none.
pub fn model_for<W: Complete>(setup: &Setup<W>, parameters: &Parameters) -> Result<String, String> {
    let size = setup.world.name();
    if !matches!(size, "narrow" | "wide") {
        return Err("format: the RTL has stock words only; leave [format] and --format out".into());
    }
    let mut name = match &setup.back {
        Back::Plane(_) => format!("plane_{size}"),
        Back::Terrain(units) => {
            if units.interpolator.heights.edge() == Edge::Wraps {
                return Err(
                    "surface.outside: the RTL does not repeat maps; use sky or clamp".into()
                );
            }
            let stretch = units.interpolator.form == Form::Stretch;
            format!("terrain_{size}{}", if stretch { "_3x3" } else { "" })
        }
    };
    if parameters.ratio == RatioForm::Serial && setup.divider.is_some() {
        // Of height maps, one machine has it.
        if matches!(setup.back, Back::Terrain(_)) && name != "terrain_narrow" {
            return Err(
                "machine.ratio: height maps in wide words or with 3x3 nodes have no machine \
                        with a serial divider; use array"
                    .into(),
            );
        }
        name += "_serial";
    }
    Ok(name)
}

impl<'a, W: Complete> Machine<'a, W> {
    /// A machine that is loaded with a set-up and waits for its start.
    ///
    /// # Errors
    /// If the RTL cannot draw this set-up: its words are no stock words, or the map repeats.
    pub fn new(setup: &'a Setup<W>, parameters: &Parameters) -> Result<Self, String> {
        let mut rtl = Model::new(&model_for(setup, parameters)?);
        let ports = |names: &[&str]| names.iter().map(|name| rtl.port(name)).collect::<Vec<_>>();
        let six = |names: [&str; 6]| names.map(|name| rtl.port(name));
        let probes = (0..UNITS.len()).map(|unit| ports(wires(unit))).collect();
        let is_code = |name: &&str| {
            ["entry", "walk_hit", "steps", "surface_hit", "pixel_hit", "pixel_color"].contains(name)
        };
        let unsigned =
            (0..UNITS.len()).map(|unit| wires(unit).iter().map(is_code).collect()).collect();
        let [takes, waits, pixel_ready] =
            ["takes", "waits", "pixel_ready"].map(|name| rtl.port(name));
        let bound_ports =
            six(["bound_read", "bound_level", "bound_column", "bound_row", "bound_valid", "bound"]);
        let sample_ports = six([
            "sample_read",
            "sample_column",
            "sample_row",
            "sample_data_valid",
            "sample_data",
            "sample_void",
        ]);
        let hit_ports =
            six(["hit_read", "hit_column", "hit_row", "hit_data_valid", "hit_data", "hit_void"]);
        let latency = parameters.memory_latency;
        let units = match &setup.back {
            Back::Terrain(units) => Some(&**units),
            Back::Plane(_) => None,
        };
        load(&mut rtl, setup, parameters);
        Ok(Self {
            rtl,
            units,
            latency,
            probes,
            unsigned,
            takes,
            waits,
            pixel_ready,
            bound: Delay::new(latency),
            bound_ports,
            samples: Delay::new(latency),
            sample_ports,
            hits: Delay::new(latency),
            hit_ports,
            start: 0,
        })
    }

    /// Opens a trace in FST; see [`Model::trace`].
    ///
    /// # Errors
    /// If the path cannot be passed on.
    pub fn open_trace(&mut self, path: &str) -> Result<(), String> {
        self.rtl.open_trace(path)
    }

    /// Whether the following cycles are written to the trace.
    pub fn trace(&mut self, on: bool) {
        self.rtl.trace(on);
    }

    /// Begins a frame: the next cycle is cycle 0.
    pub fn start(&mut self) {
        let [reset, start] = ["reset", "start"].map(|name| self.rtl.port(name));
        self.rtl.set(reset, 1);
        self.rtl.edge();
        self.rtl.set(reset, 0);
        self.rtl.set(start, 1);
        self.rtl.edge();
        self.rtl.set(start, 0);
        self.bound = Delay::new(self.latency);
        self.samples = Delay::new(self.latency);
        self.hits = Delay::new(self.latency);
        self.start = self.rtl.cycle();
    }

    /// One cycle. `passed` gets each unit but the frame whose item goes over to the next unit at its
    /// end, with the words on its wires.
    ///
    /// # Errors
    /// If the machine reads beside its memories.
    pub fn cycle(
        &mut self,
        sink: Sink,
        mut passed: impl FnMut(usize, Words),
    ) -> Result<Cycle, String> {
        let now = self.rtl.cycle() - self.start;
        self.rtl.set(self.pixel_ready, sink.is_ready(now).into());
        if let Some(units) = self.units {
            let [_, _, _, valid, data] = &self.bound_ports[1..] else { unreachable!("six ports") };
            let answer = self.bound.answer(now);
            self.rtl.set(*valid, answer.is_some().into());
            self.rtl.set_signed(*data, answer.unwrap_or(0));
            answer_nodes(&mut self.rtl, &self.sample_ports, self.samples.answer(now));
            answer_nodes(&mut self.rtl, &self.hit_ports, self.hits.answer(now));
            self.rtl.settle();
            if self.rtl.is(self.bound_ports[0]) {
                let [level, column, row] = [1, 2, 3].map(|at| self.rtl.get(self.bound_ports[at]));
                let bound = bound(units, level as u32, column as i32, row as i32);
                self.bound.read(now, bound);
            }
            if let Some(nodes) = read_nodes(&self.rtl, &self.sample_ports, units)? {
                self.samples.read(now, nodes);
            }
            if let Some(nodes) = read_nodes(&self.rtl, &self.hit_ports, units)? {
                self.hits.read(now, nodes);
            }
        } else {
            self.rtl.settle();
        }
        let cycle = Cycle { takes: self.rtl.get(self.takes), waits: self.rtl.get(self.waits) };
        for taker in 1..UNITS.len() {
            if cycle.takes >> taker & 1 == 1 {
                let unit = self.before(taker);
                let mut words = Words::default();
                for (at, (&port, &unsigned)) in
                    self.probes[unit].iter().zip(&self.unsigned[unit]).enumerate()
                {
                    words[at] =
                        if unsigned { self.rtl.get(port) as i64 } else { self.rtl.signed(port) };
                }
                passed(unit, words);
            }
        }
        self.rtl.edge();
        Ok(cycle)
    }

    /// The unit whose items another takes.
    fn before(&self, taker: usize) -> usize {
        match (self.units, taker) {
            // A plane has no stepper and no interpolator.
            (None, 4) => 1,
            // Rays from the eye pass the divider by.
            (Some(units), 2) if units.stepper.from_eye => 0,
            _ => taker - 1,
        }
    }
}

/// Loads coefficients and tables.
fn load<W: Complete>(rtl: &mut Model, setup: &Setup<W>, parameters: &Parameters) {
    let [enable, space, address, data] =
        ["load", "load_space", "load_address", "load_data"].map(|name| rtl.port(name));
    let mut put = |in_space: u64, at: usize, word: u64| {
        rtl.set(enable, 1);
        rtl.set(space, in_space);
        rtl.set(address, at as u64);
        rtl.set(data, word);
        rtl.edge();
    };
    for (at, word) in coefficients::values(setup, parameters).words() {
        put(COEFFICIENTS, at as usize, word);
    }
    if let Back::Terrain(units) = &setup.back {
        if let Some(rom) = &units.interpolator.rom {
            for (space, table) in [(WEIGHTS, rom.weights()), (SLOPES, rom.slopes())] {
                for (entry, &word) in table.entries().iter().enumerate() {
                    put(space, entry, raw(word) as u64);
                }
            }
        }
        if let Some(light) = &units.shader.light {
            for (entry, &root) in light.rsqrt.entries().iter().enumerate() {
                put(RSQRT, entry, raw(root) as u64);
            }
        }
        for (segment, channels) in units.shader.ramp.segments.iter().enumerate() {
            for (channel, &(start, rise)) in channels.iter().enumerate() {
                put(RAMP, segment * 8 + channel * 2, raw(start) as u64);
                put(RAMP, segment * 8 + channel * 2 + 1, raw(rise) as u64);
            }
        }
    }
    rtl.set(enable, 0);
}

/// The bound that is stored for a level at a column and row; zero where the machine does not ask for
/// one that is stored, which it knows.
fn bound<W: Complete>(units: &TerrainUnits<W>, level: u32, column: i32, row: i32) -> i64 {
    let Some(pyramid) = &units.stepper.pyramid else { return 0 };
    // Where the map ends, the first stored block is block −1.
    let first = i32::from(units.interpolator.heights.edge() == Edge::Ends);
    let cell = |at: i32| (at - first).wrapping_shl(level);
    pyramid.bound(level, cell(column), cell(row)).map_or(0, raw)
}

/// The nodes that a port of the height memory asks for.
fn read_nodes<W: Complete>(
    rtl: &Model,
    ports: &[Port; 6],
    units: &TerrainUnits<W>,
) -> Result<Option<Nodes>, String> {
    if !rtl.is(ports[0]) {
        return Ok(None);
    }
    let heights = &units.interpolator.heights;
    let bits = ports[1].width() / 4;
    let mut nodes = ([0; 4], 0);
    for bank in 0..4 {
        let column = 2 * rtl.bits(ports[1], bank * bits, bits) as i32 + (bank & 1) as i32;
        let row = 2 * rtl.bits(ports[2], bank * bits, bits) as i32 + (bank >> 1) as i32;
        if column >= heights.columns() || row >= heights.rows() {
            return Err(format!(
                "the RTL reads node {column}, {row} of a map of {} x {}",
                heights.columns(),
                heights.rows()
            ));
        }
        nodes.0[bank as usize] = raw(heights.at(column as usize, row as usize)) as u64;
        nodes.1 |= u64::from(heights.any_void(column, row, 1)) << bank;
    }
    Ok(Some(nodes))
}

/// Drives a port of the height memory with the answer of this cycle.
fn answer_nodes(rtl: &mut Model, ports: &[Port; 6], answer: Option<Nodes>) {
    rtl.set(ports[3], answer.is_some().into());
    let (nodes, voids) = answer.unwrap_or_default();
    let bits = ports[4].width() / 4;
    if bits == 64 {
        for (at, node) in (0..).zip(nodes) {
            rtl.set_part(ports[4], at, node);
        }
    } else {
        let low = |node: u64| node & u64::from(u32::MAX);
        rtl.set_part(ports[4], 0, low(nodes[1]) << 32 | low(nodes[0]));
        rtl.set_part(ports[4], 1, low(nodes[3]) << 32 | low(nodes[2]));
    }
    rtl.set(ports[5], voids);
}
