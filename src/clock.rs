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

use crate::setup::Setup;
use crate::unit::line::Work;
use crate::unit::{Line, Timing};
use crate::word::format::hash;
use crate::word::{Complete, World};

/// One stage of the chain: a unit, or several that work on an item together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stage {
    /// Name of the stage: that of its unit, or of the stage that its units share.
    pub name: &'static str,
    /// Work, latency and depth.
    pub timing: Timing,
}

/// The frame takes a pixel in the cycle in which it comes, and holds none.
const FRAME: Stage = Stage { name: "frame", timing: Timing { depth: 1, ..Timing::pipeline(1, 0) } };

/// What a unit did over all items.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Occupancy {
    /// Cycles in which it worked on an item.
    pub busy: u64,
    /// Cycles in which an item was there but the next unit had no room.
    pub stalled: u64,
}

/// The stages of a machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chain {
    /// Stages in the order of the data flow; the last one is the frame.
    pub stages: Vec<Stage>,
    /// Stage of each unit of the set-up.
    pub of_units: Vec<usize>,
}

impl Chain {
    /// The chain of a set-up.
    pub fn new<W: Complete>(setup: &Setup<W>) -> Self {
        let stage = |unit: &dyn crate::unit::Unit<W>| Stage {
            name: unit.description().stage,
            timing: unit.timing(setup.memory_latency),
        };
        let (mut stages, mut of_units) = (Vec::new(), Vec::new());
        for unit in setup.chain().into_iter().map(stage) {
            if stages.last() != Some(&unit) {
                stages.push(unit);
            }
            of_units.push(stages.len() - 1);
        }
        stages.push(FRAME);
        Self { stages, of_units }
    }
}

/// When finished pixels are taken from the frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Taker {
    /// Takes a pixel in every cycle.
    #[default]
    Ready,
    /// Is busy in some cycles, chosen by a seed: the co-simulation's.
    #[cfg_attr(not(feature = "parts"), expect(dead_code, reason = "only parts are co-simulated"))]
    Busy {
        /// Seed of the random bits that choose the cycles.
        seed: u64,
        /// How many of 256, below 256.
        of_256: u8,
    },
}

impl Taker {
    /// Whether it takes a pixel in a cycle, counted from 0.
    pub fn is_ready(self, cycle: u64) -> bool {
        match self {
            Self::Ready => true,
            Self::Busy { seed, of_256 } => hash(seed, cycle) as u8 >= of_256,
        }
    }
}

/// Equation 28, evaluated pixel by pixel.
#[derive(Clone, Debug)]
pub struct Clock {
    chain: Chain,
    /// Per unit, `t_in` of its latest items: as many as the unit before holds.
    taken: Vec<Ring>,
    /// Per unit, the first cycle in which it is done with the item before.
    free: Vec<u64>,
    occupancy: Vec<Occupancy>,
    taker: Taker,
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
        let depths = std::iter::once(1).chain(chain.stages.iter().map(|stage| stage.timing.depth));
        Self {
            taken: depths.take(chain.stages.len()).map(ring).collect(),
            free: vec![0; chain.stages.len()],
            occupancy: vec![Occupancy::default(); chain.stages.len()],
            taker: Taker::Ready,
            items: 0,
            last: 0,
            chain,
        }
    }

    /// The clock with another taker behind the frame.
    #[cfg(feature = "parts")]
    #[must_use]
    pub fn with_taker(self, taker: Taker) -> Self {
        Self { taker, ..self }
    }

    /// One pixel; returns the cycle (from 1) in which the frame takes it.
    pub fn take(&mut self, work: Work) -> u64 {
        let count = self.chain.stages.len();
        let mut ready = 0;
        for unit in 0..count {
            let timing = self.chain.stages[unit].timing;
            let here = ready.max(self.free[unit]);
            // The next unit's ring holds D_u times: its oldest is that of item i − D_u.
            let room = match self.taken.get(unit + 1) {
                Some(ring) if self.items >= u64::from(timing.depth) => ring.times[ring.at] + 1,
                _ => 0,
            };
            let mut entered = here.max(room);
            while unit + 1 == count && !self.taker.is_ready(entered) {
                entered += 1;
            }
            let cycles = timing.work.of(work);
            let occupancy = &mut self.occupancy[unit];
            occupancy.busy += u64::from(cycles);
            occupancy.stalled += entered - here;
            self.free[unit] = entered + u64::from(cycles);
            let ring = &mut self.taken[unit];
            ring.times[ring.at] = entered;
            ring.at = (ring.at + 1) % ring.times.len();
            ready = entered + u64::from(cycles) - 1 + u64::from(timing.latency);
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

    /// The stages.
    pub fn chain(&self) -> &Chain {
        &self.chain
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
