//! What is loaded once per map: heights, pyramid, kernel ROM, reciprocal-square-root table.

use std::sync::Arc;

use rayon::prelude::*;

use super::kernel;
use crate::plan::{ALL_BITS, Plan, SurfacePlan, TerrainPlan};
use crate::scene::{Deformation, Kernel, KernelShape, Outside, Scene, Surface, Terrain};
use crate::unit::height_memory::{Edge, HeightMemory};
use crate::unit::interpolator::Form;
use crate::unit::kernel_rom::KernelRom;
use crate::unit::pyramid::Pyramid;
use crate::word::{Load, Open, Register, Table, World};

/// Entries per unit of the reciprocal-square-root table, as a power of two.
const RSQRT_LOG2: u32 = 10;

/// The machine's memories for one height map.
#[derive(Clone, Debug)]
pub struct Memory<W: World> {
    /// Heights of the nodes, height units above the lowest one.
    pub heights: Arc<HeightMemory<W::Height>>,
    /// Bounds for skipping; absent in a plain stepper.
    pub pyramid: Option<Arc<Pyramid<W::Height>>>,
    /// Weights and slopes of the kernel; absent where not fitted.
    pub rom: Option<Arc<KernelRom<W::Weight>>>,
    /// How nodes are weighted.
    pub form: Form,
    /// Reciprocal square roots, for arguments in `[0, 4]`.
    pub rsqrt: Arc<Table<W::Tone>>,
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
    /// Loads the memories of a scene's surfaces; `None` for one that is no height map.
    ///
    /// # Errors
    /// If a height or weight does not fit its register: only in a sweep.
    pub fn of_surfaces(
        world: &W,
        scene: &Scene,
        plan: &Plan,
    ) -> Result<Vec<Option<Self>>, super::SetupError> {
        let surfaces = scene.surfaces.iter().zip(&plan.surfaces);
        let memory = |(surface, planned): (&Surface, &SurfacePlan)| {
            let terrain = surface.terrain().zip(planned.terrain());
            terrain.map(|(terrain, walk)| Self::new(world, scene, plan, terrain, walk)).transpose()
        };
        surfaces.map(memory).collect()
    }

    fn new(
        world: &W,
        scene: &Scene,
        plan: &Plan,
        terrain: &Terrain,
        walk: &TerrainPlan,
    ) -> Result<Self, super::SetupError> {
        let heights = heights(world, terrain, walk)?;
        let form = form(&scene.kernel, plan.full, walk.fitted.kernel_rom.fitted);
        let radius = i32::from(form == Form::Stretch);
        let pyramid = walk.fitted.pyramid.fitted.then(|| Arc::new(Pyramid::new(&heights, radius)));
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
        Ok(Self {
            heights: Arc::new(heights),
            pyramid,
            rom,
            form,
            rsqrt: Arc::new(Table::new(RSQRT_LOG2, rsqrt)),
        })
    }
}

fn heights<W: Open>(
    world: &W,
    terrain: &Terrain,
    walk: &TerrainPlan,
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
    Ok(if walk.fitted.void_bits.fitted {
        memory.with_voids(terrain.map.samples().iter().map(|sample| sample.is_nan()).collect())
    } else {
        memory
    })
}

/// The smallest form that gives the kernel's bits; the full machine's form where all is fitted.
fn form(kernel: &Kernel, full: bool, rom: bool) -> Form {
    match kernel.deformation {
        // Constant maps, too: every form is exact on them.
        _ if !rom => Form::Hat,
        Deformation::Stretch => Form::Stretch,
        // The general datapath: a shift by all bits is the hat, one by zero the kernel.
        _ if full && kernel.shape == KernelShape::Hat => Form::TowardHat(ALL_BITS),
        Deformation::None if full => Form::TowardHat(0),
        Deformation::None => Form::Plain,
        Deformation::TowardHat { weight_shift } => Form::TowardHat(weight_shift.min(ALL_BITS)),
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
