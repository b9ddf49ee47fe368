//! What is loaded once per map: heights, pyramid, kernel ROM, reciprocal-square-root table.

use std::sync::Arc;

use rayon::prelude::*;

use super::cells::Cells;
use super::kernel;
use super::maxima::{Bend, Maxima};
use crate::plan::ranges::WalkPlan;
use crate::plan::{ALL_BITS, Ground, Plan};
use crate::scene::{Deformation, Kernel, KernelShape, Outside, Scene, Surface, Terrain};
use crate::unit::height_memory::{Edge, HeightMemory};
use crate::unit::interpolator::Form;
use crate::unit::kernel_rom::KernelRom;
use crate::unit::pyramid::Pyramid;
use crate::word::{Load, Open, Readout, Register, World};

/// Entries per unit of the reciprocal-square-root table, as a power of two.
const RSQRT_LOG2: u32 = 10;

/// Roundings of a weight: more than its last bits in any stock world.
const ROUNDINGS: f64 = 1.0 / (1 << 18) as f64;

/// The machine's memories for one height map.
#[derive(Clone, Debug)]
pub struct Memory<W: World> {
    /// Nodes.
    pub heights: Arc<HeightMemory<W::Height>>,
    /// Bounds for skipping.
    pub pyramid: Option<Arc<Pyramid<W::Height>>>,
    /// The map as the fast engine reads it; absent where the machine does not skip.
    pub relief: Option<Arc<Relief<W::Height>>>,
    /// Kernel tables.
    pub rom: Option<Arc<KernelRom<W::Weight>>>,
    /// How nodes are weighted.
    pub form: Form,
    /// Reciprocal square roots of t / 2^rsqrt_log2, for arguments in `[0, 4]`.
    pub rsqrt: Arc<Vec<W::Tone>>,
    /// Entries per unit of `rsqrt`, as a power of two.
    pub rsqrt_log2: u32,
}

/// What the packets of the fast engine read of a height map, beside the machine's memories.
#[derive(Clone, Debug)]
pub struct Relief<T> {
    /// Highest nodes of blocks.
    pub maxima: Maxima,
    /// Nodes.
    pub cells: Cells<T>,
    /// Straightness of the kernel.
    pub bend: Bend,
}

/// Loads a value that the plan has proved to fit, or says which register it overflows.
pub(super) fn load<T: Load>(
    value: f64,
    register: Register,
    format: T::Format,
) -> Result<T, super::SetupError> {
    T::load(value, format).ok_or(super::SetupError::Register { register, value })
}

impl<W: Open> Memory<W> {
    /// Loads the memories of a scene; `None` where it has no height map.
    ///
    /// # Errors
    /// If a height or weight does not fit its register: only in a sweep.
    pub fn new(world: &W, scene: &Scene, plan: &Plan) -> Result<Option<Self>, super::SetupError> {
        let (Surface::Terrain(terrain), Ground::Terrain(walk)) = (&scene.surface, &plan.ground)
        else {
            return Ok(None);
        };
        let heights = heights(world, terrain, walk, plan.fitted.void_bits)?;
        let form = form(&scene.kernel, plan);
        let radius = i32::from(form == Form::Stretch);
        let pyramid = plan.fitted.pyramid.then(|| Arc::new(Pyramid::new(&heights, radius)));
        let relief = world
            .fixed(Register::Node)
            .filter(|format| {
                plan.fitted.pyramid && packets_walk(&heights, form, walk, format.point)
            })
            .map(|format| {
                Arc::new(Relief {
                    maxima: maxima(&heights, walk, form, format.point),
                    cells: Cells::new(&heights),
                    bend: bend(&scene.kernel, form),
                })
            });
        let rom = match form {
            Form::Hat => None,
            _ => Some(Arc::new(kernel_rom(world, &scene.kernel)?)),
        };
        let tone = world.tone(Register::Shade);
        let rsqrt = (0..=4_u32 << RSQRT_LOG2)
            .map(|t| {
                // Squares are at least 1/4; below, the table repeats that entry.
                let t = f64::from(t.max(1 << (RSQRT_LOG2 - 2)));
                let square = t / f64::from(1_u32 << RSQRT_LOG2);
                load(1.0 / libm::sqrt(square), Register::Shade, tone)
            })
            .collect::<Result<_, _>>()?;
        Ok(Some(Self {
            heights: Arc::new(heights),
            pyramid,
            relief,
            rom,
            form,
            rsqrt: Arc::new(rsqrt),
            rsqrt_log2: RSQRT_LOG2,
        }))
    }
}

fn heights<W: Open>(
    world: &W,
    terrain: &Terrain,
    walk: &WalkPlan,
    void_bits: bool,
) -> Result<HeightMemory<W::Height>, super::SetupError> {
    let format = world.height(Register::Node);
    let nodes = terrain
        .map
        .samples()
        .par_iter()
        .map(|&sample| {
            // Nodes without data are as low as the lowest, so that no bound is raised by them.
            let height =
                if sample.is_nan() { 0.0 } else { walk.scale.to_register(terrain.height(sample)) };
            load(height, Register::Node, format)
        })
        .collect::<Result<Vec<_>, _>>()?;
    let (columns, rows) = (terrain.map.columns(), terrain.map.rows());
    let edge = match terrain.outside {
        Outside::Sky => Edge::Ends,
        Outside::Clamp => Edge::Clamps,
        Outside::Wrap => Edge::Wraps,
    };
    let memory = HeightMemory::new(nodes, columns, rows, edge);
    Ok(if void_bits {
        memory.with_voids(terrain.map.samples().iter().map(|sample| sample.is_nan()).collect())
    } else {
        memory
    })
}

/// Whether the fast engine's packets know the map: not where blocks would meet at a seam, nor holes
/// that are no cells of the map, nor heights whose products with weights need more than 64 bits.
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

/// The fast engine's maxima: heights in coarse steps of 15 bits, rounded up.
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
    let coarse = heights.with_words(coarse);
    Maxima::new(&coarse, i32::from(form == Form::Stretch), places)
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

/// The smallest form that gives the kernel's bits; the full machine's form where all is fitted.
fn form(kernel: &Kernel, plan: &Plan) -> Form {
    match kernel.deformation {
        // Constant maps, too: every form is exact on them.
        _ if !plan.fitted.kernel_rom => Form::Hat,
        Deformation::Stretch => Form::Stretch,
        // The general datapath: a shift by all bits is the hat, one by zero the kernel.
        _ if plan.full && kernel.shape == KernelShape::Hat => Form::Blend(ALL_BITS),
        Deformation::None if plan.full => Form::Blend(0),
        Deformation::None => Form::Plain,
        Deformation::Blend { weight_shift } => Form::Blend(weight_shift.min(ALL_BITS)),
    }
}

fn kernel_rom<W: Open>(
    world: &W,
    kernel: &Kernel,
) -> Result<KernelRom<W::Weight>, super::SetupError> {
    let shape = kernel.shape;
    let log2 = kernel.table.ilog2();
    let stretched = kernel.deformation == Deformation::Stretch;
    let format = world.weight(Register::Weight);
    let table = |f: &dyn Fn(f64) -> f64, register| {
        (0..=kernel.table)
            .map(|entry| load(f(f64::from(entry) / f64::from(kernel.table)), register, format))
            .collect::<Result<Vec<_>, _>>()
    };
    let (weights, slopes) = if stretched {
        // The entry's argument is t + 1/2, t from the nearest node; the node before is at t + 1.
        (
            table(&|t| kernel::stretched(shape, t + 0.5), Register::Weight)?,
            table(&|t| kernel::stretched_slope(shape, t + 0.5), Register::WeightSlope)?,
        )
    } else {
        (
            table(&|t| kernel::value(shape, t), Register::Weight)?,
            table(&|t| kernel::slope(shape, t), Register::WeightSlope)?,
        )
    };
    Ok(KernelRom::new(log2, weights, slopes))
}
