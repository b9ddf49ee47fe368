//! The fast engine's own copy of a height map: what packets read beside the machine's registers.
//!
//! Made once per map, from set-up's `f64`; everything after it is integers.
#![allow(clippy::float_arithmetic)]

use rayon::prelude::*;

use super::cells::Cells;
use super::maxima::Maxima;
use crate::plan::TerrainPlan;
use crate::scene::Kernel;
use crate::setup::{Memory, kernel};
use crate::unit::height_memory::{Edge, HeightMemory};
use crate::unit::interpolator::Form;
use crate::unit::kernel_rom::KernelRom;
use crate::word::{Open, Readout, Register, Table, World};

/// Roundings of a weight: more than its last bits in any stock world.
const ROUNDINGS: f64 = 1.0 / (1 << 18) as f64;

/// A height map as packets read it.
#[derive(Clone, Debug)]
pub struct Map<W: World> {
    /// Highest nodes of blocks.
    pub(super) maxima: Maxima,
    /// Heights of nodes, in pairs of rows.
    pub(super) cells: Cells<W::Height>,
    /// Weights, where the machine has a kernel ROM.
    pub(super) weights: Option<Weights>,
    /// Straightness of the kernel.
    pub(super) bend: Bend,
}

/// How far a kernel's weight strays from straightness within a cell, rounded up. Equation 33 of
/// docs/mathematics.md.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend {
    /// Square of the largest slope, 8 fraction bits.
    pub slope_squared: u64,
    /// Half the largest second derivative, 8 fraction bits.
    pub half_curvature: u64,
    /// Five times the largest difference of a table's weight to the kernel's, 16 fraction bits.
    pub error: u32,
}

/// The kernel ROM's tables as integers, which have 32 bits in all stock worlds.
#[derive(Clone, Debug)]
pub(super) struct Weights {
    /// Entries per unit, as a power of two.
    pub log2: u32,
    /// Weights of the kernel, by entry.
    pub weight: MaskedTable,
    /// Derivatives of the weights, by entry.
    pub slope: MaskedTable,
}

/// More entries than any kernel ROM has: addresses are masked, so that none needs a test.
#[derive(Clone, Debug)]
pub(super) struct MaskedTable(Box<[i32; MaskedTable::ENTRIES]>);

impl MaskedTable {
    const ENTRIES: usize = 1 << 17;
    /// The bits of an address.
    pub const MASK: i32 = Self::ENTRIES as i32 - 1;

    /// `None` where words have no bits, or more than this copy has room for.
    fn new<T: Readout>(words: &Table<T>) -> Option<Self> {
        let mut table = Box::new([0; Self::ENTRIES]);
        for (to, from) in table.get_mut(..words.entries().len())?.iter_mut().zip(words.entries()) {
            *to = from.raw()?.try_into().ok()?;
        }
        Some(Self(table))
    }

    /// The entry at a masked address.
    #[inline(always)]
    pub fn at(&self, address: i32) -> i32 {
        self.0[(address & Self::MASK) as usize]
    }
}

impl<W: Open> Map<W> {
    /// The copy of a height map. `None` where rays do not walk by packets: in machines that do not
    /// skip, where blocks would meet at a seam, over holes that are no cells of the map, and where
    /// products of heights with weights need more than 64 bits.
    pub fn new(world: &W, kernel: &Kernel, walk: &TerrainPlan, memory: &Memory<W>) -> Option<Self> {
        let (heights, form) = (&*memory.heights, memory.form);
        let point = world.fixed(Register::Node)?.point;
        let cells = match heights.edge() {
            Edge::Wraps => false,
            Edge::Clamps => !heights.has_voids(),
            Edge::Ends => !heights.has_voids() || form != Form::Stretch,
        };
        let top = bits(walk.top, point);
        if !(walk.fitted.pyramid.fitted && cells && top + (point as i32) < 62) {
            return None;
        }
        let weights = |rom: &KernelRom<W::Weight>| {
            Some(Weights {
                log2: rom.log2(),
                weight: MaskedTable::new(rom.weights())?,
                slope: MaskedTable::new(rom.slopes())?,
            })
        };
        let weights = match &memory.rom {
            Some(rom) => Some(weights(rom)?),
            None => None,
        };
        Some(Self {
            maxima: maxima(heights, top, form, point),
            cells: Cells::new(heights),
            weights,
            bend: bend(kernel, form),
        })
    }
}

/// Bits of a positive value with a binary point, rounded up.
fn bits(value: f64, point: u32) -> i32 {
    libm::ceil(libm::log2(value.max(f64::MIN_POSITIVE))) as i32 + point as i32
}

/// Heights of up to `top` bits in coarse steps of 15 bits, rounded up.
fn maxima<T: Readout>(heights: &HeightMemory<T>, top: i32, form: Form, point: u32) -> Maxima {
    let places = (top - 14).max(0) as u32;
    let steps = libm::exp2(f64::from(point) - f64::from(places));
    let nodes = heights.nodes();
    let coarse = nodes.par_iter().map(|node| libm::ceil(node.value() * steps) as i16).collect();
    Maxima::new(&heights.with_words(coarse), i32::from(form == Form::Stretch), places)
}

/// Straightness of a weight over 2×2 nodes (equation 33); deformation 2 has a factor on what the
/// kernel differs from the hat by.
fn bend(kernel: &Kernel, form: Form) -> Bend {
    let share = match form {
        Form::Hat => 0.0,
        Form::TowardHat(shift) => libm::exp2(-f64::from(shift)),
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
