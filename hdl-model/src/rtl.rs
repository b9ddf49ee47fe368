//! The whole processor in RTL, with its memories: loads a set-up, draws a frame, and says what passed
//! between the units in which cycle.

use terraline::clock::Taker;
use terraline::setup::{Back, Setup, TerrainUnits};
use terraline::unit::Wire;
use terraline::unit::height_memory::Edge;
use terraline::unit::interpolator::Form;
use terraline::word::Complete;

use crate::coefficients::{self, raw};
use crate::memory::Delay;
use crate::{Model, Port};

/// Stages of the elastic chain, in the order of the machine's `takes`.
pub const STAGES: [&str; 6] =
    ["projector", "divider", "stepper", "interpolator", "shader", "frame"];

/// Nodes of the four banks, and which of them have no data.
type Nodes = ([u64; 4], u64);

/// Address spaces of the load port.
const COEFFICIENTS: u64 = 0;
const WEIGHTS: u64 = 1;
const SLOPES: u64 = 2;
const RSQRT: u64 = 3;
const RAMP: u64 = 4;

/// What a stage handed on for one pixel: the bits on those of its wires that the RTL shows.
pub type Words = Vec<(Wire, i64)>;

/// The port that shows a wire behind a stage. Every stage behind the stepper hands the outcome on.
pub fn port_name(stage: &str, wire: Wire) -> String {
    match wire {
        Wire::Hit => format!("{stage}_hit"),
        Wire::Color => "pixel_color".into(),
        _ => wire.name().into(),
    }
}

/// The wires that a stage of a set-up hands on, whether the RTL shows them or not.
pub fn wires<W: Complete>(setup: &Setup<W>, stage: &str) -> Vec<Wire> {
    let chain = setup.chain();
    let units = chain.iter().filter(|unit| unit.description().stage == stage);
    let mut wires: Vec<Wire> = units.flat_map(|unit| unit.outputs()).collect();
    if matches!(stage, "interpolator" | "shader") && !wires.contains(&Wire::Hit) {
        wires.insert(0, Wire::Hit);
    }
    wires
}

/// A wire that the RTL shows.
#[derive(Clone, Copy, Debug)]
struct Probe {
    wire: Wire,
    port: Port,
}

impl Probe {
    /// The bits, as the emulator has them.
    fn bits(self, model: &Model) -> i64 {
        let bits = model.get(self.port);
        match self.wire {
            // Red is in the low byte there.
            Wire::Color => i64::from((bits as u32).swap_bytes() >> 8),
            wire if wire.register().is_some() => model.signed(self.port),
            _ => bits as i64,
        }
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
pub struct Rtl<'a, W: Complete> {
    model: Model,
    units: Option<&'a TerrainUnits<W>>,
    latency: u32,
    probes: Vec<Vec<Probe>>,
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
pub fn model_for<W: Complete>(setup: &Setup<W>) -> Result<String, String> {
    let size = setup.world.name();
    if !matches!(size, "narrow" | "wide") {
        return Err("format: the RTL has stock words only; leave [format] and --format out".into());
    }
    let [surface] = &setup.surfaces[..] else {
        return Err("surface: the RTL draws one surface; keep one [[surface]]".into());
    };
    if surface.has_idle_units() {
        return Err("--full: the RTL of a plane has no idle units; leave it out".into());
    }
    let mut name = match &surface.back {
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
    if surface.divider.as_ref().is_some_and(|divider| divider.serial) {
        // Of height maps, one machine has it.
        if surface.back.terrain().is_some() && name != "terrain_narrow" {
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

impl<'a, W: Complete> Rtl<'a, W> {
    /// A machine that is loaded with a set-up and waits for its start.
    ///
    /// # Errors
    /// If the RTL cannot draw this set-up: its words are no stock words, or the map repeats.
    pub fn new(setup: &'a Setup<W>) -> Result<Self, String> {
        let mut model = Model::new(&model_for(setup)?);
        let six = |names: [&str; 6]| names.map(|name| model.port(name));
        let probe = |stage: &str, wire| {
            model.find(&port_name(stage, wire)).map(|port| Probe { wire, port })
        };
        let of_stage = |stage: &&str| {
            wires(setup, stage).into_iter().filter_map(|wire| probe(stage, wire)).collect()
        };
        let probes = STAGES.iter().map(of_stage).collect();
        let [takes, waits, pixel_ready] =
            ["takes", "waits", "pixel_ready"].map(|name| model.port(name));
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
        let latency = setup.memory_latency;
        // `model_for` has refused several.
        let units = setup.surfaces[0].back.terrain();
        load(&mut model, setup);
        Ok(Self {
            model,
            units,
            latency,
            probes,
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

    /// The wires behind a stage that the RTL shows.
    pub fn shown(&self, stage: usize) -> impl Iterator<Item = Wire> + '_ {
        self.probes[stage].iter().map(|probe| probe.wire)
    }

    /// Opens a trace in FST; see [`Model::trace`].
    ///
    /// # Errors
    /// If the path cannot be passed on.
    pub fn open_trace(&mut self, path: &str) -> Result<(), String> {
        self.model.open_trace(path)
    }

    /// Whether the following cycles are written to the trace.
    pub fn trace(&mut self, on: bool) {
        self.model.trace(on);
    }

    /// Begins a frame: the next cycle is cycle 0.
    pub fn start(&mut self) {
        let [reset, start] = ["reset", "start"].map(|name| self.model.port(name));
        self.model.set(reset, 1);
        self.model.edge();
        self.model.set(reset, 0);
        self.model.set(start, 1);
        self.model.edge();
        self.model.set(start, 0);
        self.bound = Delay::new(self.latency);
        self.samples = Delay::new(self.latency);
        self.hits = Delay::new(self.latency);
        self.start = self.model.cycle();
    }

    /// One cycle. `passed` gets each unit but the frame whose item goes over to the next unit at its
    /// end, with the words on its wires.
    ///
    /// # Errors
    /// If the machine reads beside its memories.
    pub fn cycle(
        &mut self,
        taker: Taker,
        mut passed: impl FnMut(usize, Words),
    ) -> Result<Cycle, String> {
        let now = self.model.cycle() - self.start;
        self.model.set(self.pixel_ready, taker.is_ready(now).into());
        if let Some(units) = self.units {
            let [_, _, _, valid, data] = &self.bound_ports[1..] else { unreachable!("six ports") };
            let answer = self.bound.answer(now);
            self.model.set(*valid, answer.is_some().into());
            self.model.set_signed(*data, answer.unwrap_or(0));
            answer_nodes(&mut self.model, &self.sample_ports, self.samples.answer(now));
            answer_nodes(&mut self.model, &self.hit_ports, self.hits.answer(now));
            self.model.settle();
            if self.model.is(self.bound_ports[0]) {
                let [level, column, row] = [1, 2, 3].map(|at| self.model.get(self.bound_ports[at]));
                let bound = bound(units, level as u32, column as i32, row as i32);
                self.bound.read(now, bound);
            }
            if let Some(nodes) = read_nodes(&self.model, &self.sample_ports, units)? {
                self.samples.read(now, nodes);
            }
            if let Some(nodes) = read_nodes(&self.model, &self.hit_ports, units)? {
                self.hits.read(now, nodes);
            }
        } else {
            self.model.settle();
        }
        let cycle = Cycle { takes: self.model.get(self.takes), waits: self.model.get(self.waits) };
        for taker in 1..STAGES.len() {
            if cycle.takes >> taker & 1 == 1 {
                let unit = self.before(taker);
                let words = self.probes[unit].iter();
                let words = words.map(|probe| (probe.wire, probe.bits(&self.model))).collect();
                passed(unit, words);
            }
        }
        self.model.edge();
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
fn load<W: Complete>(model: &mut Model, setup: &Setup<W>) {
    let [enable, space, address, data] =
        ["load", "load_space", "load_address", "load_data"].map(|name| model.port(name));
    let mut put = |in_space: u64, at: usize, word: u64| {
        model.set(enable, 1);
        model.set(space, in_space);
        model.set(address, at as u64);
        model.set(data, word);
        model.edge();
    };
    for (at, word) in coefficients::words(setup) {
        put(COEFFICIENTS, at, word as u64);
    }
    if let Some(units) = setup.surfaces[0].back.terrain() {
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
    model.set(enable, 0);
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
    model: &Model,
    ports: &[Port; 6],
    units: &TerrainUnits<W>,
) -> Result<Option<Nodes>, String> {
    if !model.is(ports[0]) {
        return Ok(None);
    }
    let heights = &units.interpolator.heights;
    let bits = ports[1].width() / 4;
    let mut nodes = ([0; 4], 0);
    for bank in 0..4 {
        let half_column = model.bits(ports[1], bank * bits, bits) as i32;
        let half_row = model.bits(ports[2], bank * bits, bits) as i32;
        let (column, row) =
            (2 * half_column + (bank & 1) as i32, 2 * half_row + (bank >> 1) as i32);
        // On an axis of one node the bank of odd nodes is empty: address 0 is read and not used.
        let empty = |size: i32, half: i32, odd: bool| size == 1 && half == 0 && odd;
        if empty(heights.columns(), half_column, bank & 1 == 1)
            || empty(heights.rows(), half_row, bank >> 1 == 1)
        {
            continue;
        }
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
fn answer_nodes(model: &mut Model, ports: &[Port; 6], answer: Option<Nodes>) {
    model.set(ports[3], answer.is_some().into());
    let (nodes, voids) = answer.unwrap_or_default();
    let bits = ports[4].width() / 4;
    if bits == 64 {
        for (at, node) in (0..).zip(nodes) {
            model.set_part(ports[4], at, node);
        }
    } else {
        let low = |node: u64| node & u64::from(u32::MAX);
        model.set_part(ports[4], 0, low(nodes[1]) << 32 | low(nodes[0]));
        model.set_part(ports[4], 1, low(nodes[3]) << 32 | low(nodes[2]));
    }
    model.set(ports[5], voids);
}
