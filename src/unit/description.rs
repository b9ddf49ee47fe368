//! What the rest of the program knows of a unit: its name, its wires, its registers, its cycles.
//! Processor, clock, costs, explanations, test vectors and co-simulation read it from here.

use std::fmt::Debug;

use super::coefficient::Bank;
use super::line::{Line, Wire, Work};
use crate::frame::Hit;
use crate::word::{Register, World};

/// A unit, whatever the scene.
#[derive(Clone, Copy, Debug)]
pub struct Description {
    /// Name: stem of its file here, of its module in the RTL, of its page in docs/units, and of
    /// its test vectors.
    pub name: &'static str,
    /// Stage of the elastic chain that it is, or that it is a part of.
    pub stage: &'static str,
    /// What it gives, in half a sentence.
    pub gives: &'static str,
    /// Wires that it reads.
    pub inputs: &'static [Wire],
    /// Wires that it drives.
    pub outputs: &'static [Wire],
    /// Registers whose formats its arithmetic has.
    pub registers: &'static [Register],
    /// Register whose bits its multipliers add over, one addition a bit.
    pub multiplier: Register,
}

/// Cycles of a unit's work on an item, linear in what the stepper did for it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cycles {
    /// On every item.
    pub item: u32,
    /// On each of its skip tests.
    pub skip_test: u32,
    /// On each sample of its bursts.
    pub sample: u32,
    /// On each of its sample bursts, besides the samples.
    pub burst: u32,
    /// On each of its bisection steps.
    pub bisection_step: u32,
    /// On its hit.
    pub hit: u32,
}

impl Cycles {
    /// The same number of cycles on every item.
    pub const fn every(item: u32) -> Self {
        Self { item, skip_test: 0, sample: 0, burst: 0, bisection_step: 0, hit: 0 }
    }

    /// On an item for which the stepper did this work.
    pub fn of(self, work: Work) -> u32 {
        self.item
            + work.skip_tests * self.skip_test
            + work.samples * self.sample
            + work.bursts * self.burst
            + work.bisection_steps * self.bisection_step
            + work.hits * self.hit
    }
}

/// Cycles of a unit in the elastic chain (equation 28 of docs/mathematics.md).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// Work on an item.
    pub work: Cycles,
    /// L: cycles from its last cycle of work on an item to the item's arrival at the next unit.
    pub latency: u32,
    /// D: items that it holds, pipeline and queue together.
    pub depth: u32,
}

impl Timing {
    /// A pipeline that takes an item every `every` cycles, with a queue for all that it holds.
    pub const fn pipeline(every: u32, latency: u32) -> Self {
        Self { work: Cycles::every(every), latency, depth: latency + 1 }
    }
}

/// The stage that light, ramp, mixer and pixel share; on a plane the checker is in their place.
pub const SHADER: &str = "shader";

/// Its cycles: eleven of light and ramp side by side (normal, squares, table, dot product, light;
/// place, segment, colour), one of the mixer's products, one of mixer and pixel that rounds them.
/// The checker, which has fewer to do, takes as many.
pub const SHADER_TIMING: Timing = Timing::pipeline(1, 13);

/// Reads of a unit on an item.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reads {
    /// Of heights and pyramid.
    pub memory: u64,
    /// Of tables.
    pub table: u64,
}

/// A unit that has been set up. The bounds of its implementation are its bill of materials.
pub trait Unit<W: World>: Debug + Sync {
    /// What it is.
    fn description(&self) -> &'static Description;

    /// Wires in that this set-up reads.
    fn inputs(&self) -> Vec<Wire> {
        self.description().inputs.to_vec()
    }

    /// Wires out that this set-up drives.
    fn outputs(&self) -> Vec<Wire> {
        self.description().outputs.to_vec()
    }

    /// Drives its output wires on a line.
    fn run(&self, line: &mut Line<W>);

    /// Puts in its coefficients.
    fn coefficients(&self, bank: &mut Bank<W>);

    /// Its cycles, with memories of a latency.
    fn timing(&self, memory_latency: u32) -> Timing;

    /// Its reads on an item of which the stepper says this.
    fn reads(&self, _work: Work, _hit: Hit) -> Reads {
        Reads::default()
    }

    /// Whether it only passes items on.
    fn is_idle(&self) -> bool {
        false
    }

    /// Quotient bits, of a unit that divides.
    fn quotient_bits(&self) -> u32 {
        0
    }
}

/// A unit of another kind of surface in a full machine: it passes items on, one a cycle.
#[derive(Clone, Copy, Debug)]
pub struct Idle {
    /// What it would be.
    pub description: &'static Description,
    /// Its cycles if it worked, with memories of a latency.
    pub timing: fn(u32) -> Timing,
}

impl<W: World> Unit<W> for Idle {
    fn description(&self) -> &'static Description {
        self.description
    }

    fn run(&self, _: &mut Line<W>) {}

    fn coefficients(&self, _: &mut Bank<W>) {}

    fn is_idle(&self) -> bool {
        true
    }

    fn timing(&self, memory_latency: u32) -> Timing {
        Timing { work: Cycles::every(1), ..(self.timing)(memory_latency) }
    }
}
