//! The ray stepper: the first sample of a ray under the surface.
//!
//! *In hardware*: three position accumulators, `P ← P + ΔP` per step (equation 19 of
//! docs/mathematics.md; thesis 2.1), a comparator against the interpolated surface, and for
//! skipping a second set of adders for `P + J·ΔP` with two comparators against the pyramid's bound.
//!
//! The walk starts at the eye, or where the ray enters the slab under the highest node. ΔP is V
//! shifted right and rounded to nearest so that its largest component lies between 2^−k−1 and 2^−k
//! cells (equation 20). A sample hits if the surface exists there and `y < surface`, strictly; the
//! first such index is the hit, refined by bisection.
//!
//! | wire in | wire out |
//! |---|---|
//! | `view_*`, `entry`, `entry_x`, `entry_z` | `hit`, `ground_x`, `ground_z`, `steps`, `work` |
//!
//! *Named outcomes*: `Side` when the last clear place, after the bisection, lies outside the map or in
//! a hole; `Sky` when the ray is out of the map and receding, above the highest node and rising, or
//! outside the map or in a hole, under the base and falling; `OutOfRange` when the last index is reached.
//! *Never*: wraps a position (proved at set-up for the last index and the largest jump), passes a
//! sample that might hit.

mod place;
mod walk;

use std::sync::Arc;

use super::coefficient::{Bank, Coefficient as C};
use super::interpolator::{self, Interpolator};
use super::line::{Entry, Wire, Work};
use super::pyramid::Pyramid;
use super::{Cycles, Description, Line, Reads, Timing, Unit};
use crate::frame::Hit;
use crate::word::{Interpolating, Register, Rescale, Site, Word, World};
pub use place::Place;

/// What the stepper is.
pub const DESCRIPTION: Description = Description {
    name: "stepper",
    stage: "stepper",
    gives: "the first sample of a ray under the surface",
    inputs: &[Wire::ViewX, Wire::ViewY, Wire::ViewZ, Wire::Entry, Wire::EntryX, Wire::EntryZ],
    outputs: &[Wire::Hit, Wire::GroundX, Wire::GroundZ, Wire::Steps],
    registers: &[
        Register::ViewX,
        Register::ViewY,
        Register::ViewZ,
        Register::GroundX,
        Register::GroundZ,
        Register::DGroundX,
        Register::DGroundZ,
        Register::RayY,
        Register::DRayY,
        Register::Node,
        Register::Surface,
        Register::Weight,
    ],
    multiplier: Register::Weight,
};

/// Cycles to turn a view vector into a step and to begin a walk with it: magnitudes, their leading
/// one, shift, end of the walk.
pub const RAY_START: u32 = 4;

/// Cycles that a hit takes besides its bisection steps: one for its distance from the eye, which says
/// how many they are, and one to place it.
pub const RAY_END: u32 = 2;

/// Cycles over a map whose interpolations take this many cycles of reading: every skip test waits for
/// the pyramid, samples stream through the interpolation in bursts, bisection steps wait for each other.
/// With holes, the bits of the two places between which a hit lies are read once more.
pub const fn timing(reads: u32, void_bits: bool, memory_latency: u32) -> Timing {
    let answer = interpolator::height_latency(memory_latency);
    let rim = if void_bits { 2 * reads + answer } else { 0 };
    let work = Cycles {
        item: RAY_START,
        skip_test: 1 + memory_latency,
        sample: reads,
        burst: answer,
        bisection_step: reads + answer,
        hit: RAY_END + rim,
    };
    Timing { work, latency: 1, depth: 2 }
}

/// How many bisection steps refine a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BisectionRule {
    /// `bias − e`, e the place of the leading one of the distance to the eye, within `0..=cap`.
    Footprint {
        /// Bisection steps at distance one.
        bias: i32,
        /// Most bisection steps: the step still has bits.
        cap: u32,
    },
    /// The same number for every hit.
    Fixed(u32),
}

/// The stepper's coefficients, and the memories that it reads.
#[derive(Clone, Debug)]
pub struct Stepper<W: World> {
    /// Whether rays start at the eye; else where they enter the slab.
    pub from_eye: bool,
    /// The eye, x in cells.
    pub eye_x: W::Ground,
    /// The eye, z in cells.
    pub eye_z: W::Ground,
    /// The eye, y in height units.
    pub eye_y: W::Height,
    /// The highest node, height units.
    pub top: W::Height,
    /// Base of the block under the map.
    pub base: W::Height,
    /// k: the largest component of a step lies between 2^−k−1 and 2^−k.
    pub fineness: u32,
    /// Index of the last sample.
    pub last: u32,
    /// How far a hit is refined.
    pub bisection: BisectionRule,
    /// Bounds for skipping; absent when the stepper is plain.
    pub pyramid: Option<Arc<Pyramid<W::Height>>>,
    /// What an entry beyond the divider's range means: `Sky` where the whole map is within it.
    pub beyond: Hit,
    /// Nodes of the map where it ends at its edge.
    pub extent: Option<(i32, i32)>,
    /// The map has sides, drawn down to the base: it ends at its edge, or has holes.
    pub sides: bool,
    /// Format of x.
    pub format_x: <W::Ground as Word>::Format,
    /// Format of z.
    pub format_z: <W::Ground as Word>::Format,
    /// Format of y.
    pub format_y: <W::Height as Word>::Format,
    /// Its own interpolation, of the surface at its samples.
    pub surface: Interpolator<W>,
}

impl<W: World> Stepper<W> {
    /// Where the ray of a pixel starts, if it has one.
    pub fn start(&self, line: &Line<W>, i: usize) -> Option<Place<W>> {
        match line.entry[i] {
            _ if self.from_eye => Some(self.eye()),
            Entry::Met => Some(Place { x: line.entry_x[i], y: self.top, z: line.entry_z[i] }),
            Entry::Sky | Entry::OutOfRange => None,
        }
    }

    /// The eye as a place on the map.
    #[inline(always)]
    pub fn eye(&self) -> Place<W> {
        Place { x: self.eye_x, y: self.eye_y, z: self.eye_z }
    }

    /// Power of two that makes a step of a view vector (equation 20).
    #[inline(always)]
    pub fn exponent(&self, x: W::View, y: W::View, z: W::View, site: Site) -> i32 {
        let leading = x
            .leading_one(site.at(Register::ViewX))
            .max(y.leading_one(site.at(Register::ViewY)))
            .max(z.leading_one(site.at(Register::ViewZ)));
        -(leading + 1 + self.fineness as i32)
    }

    /// ΔP of a view vector (equation 20).
    #[inline(always)]
    pub fn step(&self, x: W::View, y: W::View, z: W::View, site: Site) -> Place<W> {
        let exponent = self.exponent(x, y, z, site);
        Place {
            x: x.rescale_nearest(exponent, self.format_x, site.at(Register::DGroundX)),
            y: y.rescale_nearest(exponent, self.format_y, site.at(Register::DRayY)),
            z: z.rescale_nearest(exponent, self.format_z, site.at(Register::DGroundZ)),
        }
    }

    /// Bisection steps at a place (equation 22).
    #[inline(always)]
    pub fn bisection_steps_at(&self, place: Place<W>, site: Site) -> u32 {
        match self.bisection {
            BisectionRule::Fixed(times) => times,
            BisectionRule::Footprint { bias, cap } => {
                let away = place.minus(self.eye());
                let leading = away
                    .x
                    .leading_one(site.at(Register::GroundX))
                    .max(away.y.leading_one(site.at(Register::RayY)))
                    .max(away.z.leading_one(site.at(Register::GroundZ)));
                (bias - leading).clamp(0, cap as i32) as u32
            }
        }
    }
}

impl<W: Interpolating> Unit<W> for Stepper<W> {
    fn description(&self) -> &'static Description {
        &DESCRIPTION
    }

    fn inputs(&self) -> Vec<Wire> {
        let views = if self.from_eye { 3 } else { DESCRIPTION.inputs.len() };
        DESCRIPTION.inputs[..views].to_vec()
    }

    fn run(&self, line: &mut Line<W>) {
        for i in 0..line.len() {
            let Some(start) = self.start(line, i) else {
                line.hit[i] =
                    if line.entry[i] == Entry::OutOfRange { self.beyond } else { Hit::Sky };
                line.steps[i] = 0;
                line.work[i] = Work::default();
                continue;
            };
            let site = Site::pixel(line.number, line.column[i]);
            let step = self.step(line.view_x[i], line.view_y[i], line.view_z[i], site);
            let walk = self.walk(start, step, &self.surface, site);
            line.hit[i] = walk.hit;
            line.ground_x[i] = walk.place.x;
            line.ground_z[i] = walk.place.z;
            line.steps[i] = walk.index;
            line.work[i] = walk.work;
        }
    }

    fn coefficients(&self, bank: &mut Bank<W>) {
        let heights = &self.surface.heights;
        bank.number(C::FromEye, self.from_eye);
        bank.ground(C::EyeX, self.eye_x);
        bank.height(C::EyeY, self.eye_y);
        bank.ground(C::EyeZ, self.eye_z);
        bank.height(C::Highest, self.top);
        bank.height(C::Base, self.base);
        bank.number(C::Sides, self.sides);
        bank.number(C::Fineness, self.fineness);
        bank.number(C::Last, self.last);
        bank.number(C::BeyondSky, self.beyond == Hit::Sky);
        heights.coefficients(bank);
        let (fixed, bias, cap) = match self.bisection {
            BisectionRule::Fixed(times) => (true, 0, times),
            BisectionRule::Footprint { bias, cap } => (false, bias, cap),
        };
        bank.number(C::BisectionFixed, fixed);
        bank.number(C::BisectionBias, bias);
        bank.number(C::BisectionCap, cap);
        bank.number(C::Skipping, self.pyramid.is_some());
        bank.number(C::PyramidTop, self.pyramid.as_ref().map_or(0, |pyramid| pyramid.top()));
    }

    fn timing(&self, memory_latency: u32) -> Timing {
        let surface = &self.surface;
        timing(surface.read_cycles(), surface.heights.has_voids(), memory_latency)
    }

    fn reads(&self, work: Work, _: Hit) -> Reads {
        let each = self.surface.reads_per_height();
        let interpolations = u64::from(work.samples + work.bisection_steps);
        Reads {
            memory: u64::from(work.skip_tests) + interpolations * each.memory,
            table: interpolations * each.table,
        }
    }
}
