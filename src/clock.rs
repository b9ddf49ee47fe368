//! Cycles: the recurrence of elastic ready/valid stages.
//!
//! Unit u takes item i when the unit before has finished it, when it has done its own work on item
//! i−1, and when item i−D_u has left it for the next unit (equation 28 of docs/mathematics.md):
//!
//! ```text
//! t_in(u, i)  = max(t_out(u−1, i), t_in(u, i−1) + work(u, i−1), t_in(u+1, i−D_u) + 1)
//! t_out(u, i) = t_in(u, i) + work(u, i) − 1 + L_u
//! ```
//!
//! Cycles are counted from the first one after start, with coefficients, tables and maps loaded,
//! to the one in which the frame takes the last pixel.
#![deny(clippy::float_arithmetic)]

use crate::scene::{Hardware, RatioForm};
use crate::setup::table::{
    DIVIDER_ENDS, KERNEL_LATENCY, LERP_LATENCY, RAY_END, RAY_START, SHADER_LATENCY, SLOPE_LATENCY,
};
use crate::setup::{Back, Setup};
use crate::unit::Line;
use crate::unit::interpolator::Form;
use crate::unit::line::Work;
use crate::word::format::mix;
use crate::word::{Complete, World};

/// One unit in the chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stage {
    /// Unit.
    pub name: &'static str,
    /// L: cycles from its last cycle of work on an item to the item's arrival at the next unit.
    pub latency: u32,
    /// D: items that it holds, pipeline and queue together.
    pub depth: u32,
}

/// What a unit did over all items.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Occupancy {
    /// Cycles of work.
    pub busy: u64,
    /// Cycles in which an item was there but the next unit had no room.
    pub stalled: u64,
}

/// The chain of fitted units and the cycles of one item's work in each.
#[derive(Clone, Debug)]
pub struct Chain {
    /// Units in the order of the data flow; the last one is the frame.
    pub stages: Vec<Stage>,
    stepper: Option<usize>,
    interpolator: Option<usize>,
    /// The divider's place and its cycles of work, where it takes more than one.
    serial: Option<(usize, u32)>,
    memory_latency: u32,
    reads: u32,
    void_bits: bool,
}

impl Chain {
    /// The chain of a set-up in a machine. `idle` units pass items on in one cycle.
    pub fn new<W: Complete>(setup: &Setup<W>, hardware: &Hardware, idle: bool) -> Self {
        let memory_latency = hardware.memory_latency;
        let mut stages = vec![Stage { name: "projector", latency: 1, depth: 2 }];
        let mut serial = None;
        if let Some(divider) = &setup.divider {
            let cycles = divider.bits + DIVIDER_ENDS;
            match hardware.ratio {
                RatioForm::Array => {
                    stages.push(Stage { name: "divider", latency: cycles, depth: cycles + 1 });
                }
                RatioForm::Serial => {
                    serial = Some((stages.len(), cycles));
                    stages.push(Stage { name: "divider", latency: 1, depth: 2 });
                }
            }
        }
        let answer = nodes_latency(memory_latency) + LERP_LATENCY + SLOPE_LATENCY;
        let (mut stepper, mut interpolator) = (None, None);
        let (mut reads, mut void_bits) = (1, false);
        match &setup.back {
            Back::Terrain(units) => {
                // 3×3 nodes take four cycles from four banks.
                reads = if units.interpolator.form == Form::Stretch { 4 } else { 1 };
                void_bits = units.interpolator.heights.has_voids();
                stepper = Some(stages.len());
                stages.push(Stage { name: "stepper", latency: 1, depth: 2 });
                interpolator = Some(stages.len());
                stages.push(Stage { name: "interpolator", latency: answer, depth: answer + 1 });
            }
            Back::Plane(_) if idle => {
                stages.push(Stage { name: "stepper", latency: 1, depth: 2 });
                stages.push(Stage { name: "interpolator", latency: answer, depth: answer + 1 });
            }
            Back::Plane(_) => {}
        }
        stages.push(Stage { name: "shader", latency: SHADER_LATENCY, depth: SHADER_LATENCY + 1 });
        stages.push(Stage { name: "frame", latency: 0, depth: 1 });
        Self { stages, stepper, interpolator, serial, memory_latency, reads, void_bits }
    }

    /// Cycles of the stepper's work on a pixel: every trial waits for the pyramid, samples stream
    /// through the interpolation in groups, halvings wait for each other. With holes, the bits of
    /// the two places between which a hit lies are read once more.
    pub fn stepper_work(&self, work: Work) -> u32 {
        let answer = nodes_latency(self.memory_latency) + LERP_LATENCY;
        let rim = if self.void_bits { 2 * self.reads + answer } else { 0 };
        RAY_START
            + work.trials * (1 + self.memory_latency)
            + work.samples * self.reads
            + work.groups * answer
            + work.halvings * (self.reads + answer)
            + work.hits * (RAY_END + rim)
    }

    /// Cycles of a unit's work on a pixel.
    pub fn work(&self, stage: usize, work: Work) -> u32 {
        if Some(stage) == self.stepper {
            self.stepper_work(work)
        } else if Some(stage) == self.interpolator {
            self.reads
        } else {
            self.serial.filter(|&(divider, _)| divider == stage).map_or(1, |(_, cycles)| cycles)
        }
    }
}

/// Cycles from a place to its nodes and their weights: N of docs/cycles.md.
fn nodes_latency(memory_latency: u32) -> u32 {
    memory_latency.max(KERNEL_LATENCY)
}

/// Who takes finished pixels from the frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sink {
    /// Takes a pixel in every cycle.
    #[default]
    Ready,
    /// Is busy in some cycles, chosen by a seed.
    Busy {
        /// Which cycles.
        seed: u64,
        /// How many of 256, below 256.
        of_256: u8,
    },
}

impl Sink {
    /// Whether it takes a pixel in a cycle, counted from 0.
    pub fn is_ready(self, cycle: u64) -> bool {
        match self {
            Self::Ready => true,
            Self::Busy { seed, of_256 } => mix(seed, cycle) as u8 >= of_256,
        }
    }
}

/// The running recurrence.
#[derive(Clone, Debug)]
pub struct Clock {
    chain: Chain,
    /// Per unit, `t_in` of its latest items: as many as the unit before holds.
    taken: Vec<Ring>,
    /// Per unit, the first cycle in which it is done with the item before.
    free: Vec<u64>,
    occupancy: Vec<Occupancy>,
    sink: Sink,
    items: u64,
    last: u64,
}

/// The latest `t_in` of a unit.
#[derive(Clone, Debug)]
struct Ring {
    times: Vec<u64>,
    at: usize,
}

impl Clock {
    /// A clock at start.
    pub fn new(chain: Chain) -> Self {
        let ring = |depth: u32| Ring { times: vec![0; depth as usize], at: 0 };
        let depths = std::iter::once(1).chain(chain.stages.iter().map(|stage| stage.depth));
        Self {
            taken: depths.take(chain.stages.len()).map(ring).collect(),
            free: vec![0; chain.stages.len()],
            occupancy: vec![Occupancy::default(); chain.stages.len()],
            sink: Sink::Ready,
            items: 0,
            last: 0,
            chain,
        }
    }

    /// The clock with another sink behind the frame.
    #[must_use]
    pub fn with_sink(self, sink: Sink) -> Self {
        Self { sink, ..self }
    }

    /// One pixel; returns the cycle (from 1) in which the frame takes it.
    pub fn take(&mut self, work: Work) -> u64 {
        let count = self.chain.stages.len();
        let mut ready = 0;
        for unit in 0..count {
            let stage = self.chain.stages[unit];
            let here = ready.max(self.free[unit]);
            // The next unit's ring holds D_u times: its oldest is that of item i − D_u.
            let room = match self.taken.get(unit + 1) {
                Some(ring) if self.items >= u64::from(stage.depth) => ring.times[ring.at] + 1,
                _ => 0,
            };
            let mut entered = here.max(room);
            while unit + 1 == count && !self.sink.is_ready(entered) {
                entered += 1;
            }
            let cycles = self.chain.work(unit, work);
            let occupancy = &mut self.occupancy[unit];
            occupancy.busy += u64::from(cycles);
            occupancy.stalled += entered - here;
            self.free[unit] = entered + u64::from(cycles);
            let ring = &mut self.taken[unit];
            ring.times[ring.at] = entered;
            ring.at = (ring.at + 1) % ring.times.len();
            ready = entered + u64::from(cycles) - 1 + u64::from(stage.latency);
        }
        self.items += 1;
        self.last = ready + 1;
        self.last
    }

    /// Unit by unit, the cycle (from 0) in which it took the latest pixel.
    pub fn entered(&self) -> impl Iterator<Item = u64> + '_ {
        self.taken
            .iter()
            .map(|ring| ring.times[(ring.at + ring.times.len() - 1) % ring.times.len()])
    }

    /// All pixels of a line; hands each completion cycle to `done`.
    pub fn take_line<W: World>(&mut self, line: &Line<W>, mut done: impl FnMut(usize, u64)) {
        for (i, &work) in line.work.iter().enumerate() {
            done(i, self.take(work));
        }
    }

    /// Cycles so far.
    pub fn cycles(&self) -> u64 {
        self.last
    }

    /// Pixels so far.
    pub fn items(&self) -> u64 {
        self.items
    }

    /// Units with what they did.
    pub fn occupancy(&self) -> impl Iterator<Item = (Stage, Occupancy)> + '_ {
        self.chain.stages.iter().copied().zip(self.occupancy.iter().copied())
    }

    /// The (first) unit with most cycles of work: it limits the frame rate.
    pub fn limit(&self) -> &'static str {
        let most = self.occupancy().map(|(_, occupancy)| occupancy.busy).max();
        self.occupancy()
            .find(|(_, occupancy)| Some(occupancy.busy) == most)
            .map_or("projector", |(stage, _)| stage.name)
    }
}
