//! What the packets of the fast engine read of a height map, beside the machine's memories.

use rayon::prelude::*;

use super::cells::Cells;
use super::kernel;
use super::maxima::Maxima;
use crate::plan::ranges::WalkPlan;
use crate::scene::Kernel;
use crate::unit::height_memory::{Edge, HeightMemory};
use crate::unit::interpolator::Form;
use crate::unit::kernel_rom::KernelRom;
use crate::word::{Readout, Register, World};

/// Roundings of a weight: more than its last bits in any stock world.
const ROUNDINGS: f64 = 1.0 / (1 << 18) as f64;

/// A height map as packets read it.
#[derive(Clone, Debug)]
pub struct Relief<T> {
    /// Highest nodes of blocks.
    pub maxima: Maxima,
    /// Nodes.
    pub cells: Cells<T>,
    /// Weights, where the machine has a kernel ROM.
    pub weights: Option<Weights>,
    /// Straightness of the kernel.
    pub bend: Bend,
}

/// How far a kernel's weight strays from straightness within a cell, rounded up. Equation 33 of
/// docs/mathematics.md.
#[derive(Clone, Copy, Debug)]
pub struct Bend {
    /// Square of the largest slope, 8 fraction bits.
    pub slope_squared: u64,
    /// Half the largest second derivative, 8 fraction bits.
    pub half_curvature: u64,
    /// Five times the largest difference of a table's weight to the kernel's, 16 fraction bits.
    pub error: u32,
}

/// The kernel ROM's tables as integers, which have 32 bits in all stock worlds.
#[derive(Clone, Debug)]
pub struct Weights {
    /// Entries per unit, as a power of two.
    pub log2: u32,
    /// Weights.
    pub weight: Table,
    /// Slopes.
    pub slope: Table,
}

/// More entries than any kernel ROM has: addresses are masked, so that none needs a test.
#[derive(Clone, Debug)]
pub struct Table(Box<[i32; Table::ENTRIES]>);

impl Table {
    const ENTRIES: usize = 1 << 17;
    /// The bits of an address.
    pub const MASK: i32 = Self::ENTRIES as i32 - 1;

    fn new(entries: impl Iterator<Item = i32>) -> Self {
        let mut table = Box::new([0; Self::ENTRIES]);
        for (to, from) in table.iter_mut().zip(entries) {
            *to = from;
        }
        Self(table)
    }

    /// The entry at a masked address.
    #[inline(always)]
    pub fn at(&self, address: i32) -> i32 {
        self.0[(address & Self::MASK) as usize]
    }
}

impl<T: Readout + Send + Sync> Relief<T> {
    /// The relief of a map; none where packets do not know it.
    pub fn new<W: World<Height = T, Weight: Readout>>(
        world: &W,
        heights: &HeightMemory<T>,
        rom: Option<&KernelRom<W::Weight>>,
        walk: &WalkPlan,
        kernel: &Kernel,
        form: Form,
    ) -> Option<Self> {
        let point = world.fixed(Register::Node)?.point;
        if !packets_walk(heights, form, walk, point) {
            return None;
        }
        let weight_point = world.fixed(Register::Weight)?.point;
        Some(Self {
            maxima: maxima(heights, walk, form, point),
            cells: Cells::new(heights),
            weights: rom.map(|rom| weights(rom, weight_point)),
            bend: bend(kernel, form),
        })
    }
}

/// Whether packets know the map: not where blocks would meet at a seam, nor holes that are no cells
/// of the map, nor heights whose products with weights need more than 64 bits.
fn packets_walk<T: Copy>(
    heights: &HeightMemory<T>,
    form: Form,
    walk: &WalkPlan,
    point: u32,
) -> bool {
    let cells = match heights.edge() {
        Edge::Wraps => false,
        Edge::Clamps => !heights.has_voids(),
        Edge::Ends => !heights.has_voids() || form != Form::Stretch,
    };
    cells && bits(walk.top, point) + (point as i32) < 62
}

/// Bits of a positive value with a binary point, rounded up.
fn bits(value: f64, point: u32) -> i32 {
    libm::ceil(libm::log2(value.max(f64::MIN_POSITIVE))) as i32 + point as i32
}

/// Heights in coarse steps of 15 bits, rounded up.
fn maxima<T: Readout + Send + Sync>(
    heights: &HeightMemory<T>,
    walk: &WalkPlan,
    form: Form,
    point: u32,
) -> Maxima {
    let places = (bits(walk.top, point) - 14).max(0) as u32;
    let steps = libm::exp2(f64::from(point) - f64::from(places));
    let nodes = heights.nodes();
    let coarse = nodes.par_iter().map(|node| libm::ceil(node.value() * steps) as i16).collect();
    Maxima::new(&heights.with_words(coarse), i32::from(form == Form::Stretch), places)
}

fn weights<T: Readout>(rom: &KernelRom<T>, point: u32) -> Weights {
    let one = libm::exp2(f64::from(point));
    let entries = 0..=1_usize << rom.log2();
    Weights {
        log2: rom.log2(),
        weight: Table::new(entries.clone().map(|at| (rom.weight(at).value() * one) as i32)),
        slope: Table::new(entries.map(|at| (rom.slope(at).value() * one) as i32)),
    }
}

/// Straightness of a weight over 2×2 nodes (equation 33); its blend's shift is a factor on what the
/// kernel differs from the hat by.
fn bend(kernel: &Kernel, form: Form) -> Bend {
    let share = match form {
        Form::Hat => 0.0,
        Form::Blend(shift) => libm::exp2(-f64::from(shift)),
        Form::Plain | Form::Stretch => 1.0,
    };
    let steepest = 1.0 + share * (kernel::steepest(kernel.shape) - 1.0);
    // Half an entry of the table at its steepest, and the rounding of both.
    let entry =
        share * kernel::steepest(kernel.shape) / (2.0 * f64::from(kernel.table)) + ROUNDINGS;
    let up = |value: f64, bits: i32| libm::ceil(value * libm::exp2(f64::from(bits))) as u64 + 1;
    Bend {
        slope_squared: up(steepest * steepest, 8),
        half_curvature: up(share * kernel::most_curved(kernel.shape) / 2.0, 8),
        error: up(5.0 * entry, 16) as u32,
    }
}
