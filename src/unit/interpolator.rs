//! The interpolator: surface height and slopes at a place on the ground, by finite functions.
//!
//! *In hardware*: the kernel ROM, the weight toward the hat (a subtraction, a shift, an addition) and
//! shift-and-add multipliers with one rounding each.
//!
//! - 2×2 nodes: `A = h2 + (h1−h2)·w(zd)`, `B = h4 + (h3−h4)·w(zd)`, `y = B + (A−B)·w(xd)`:
//!   three multiplications (equation 14 of docs/mathematics.md; thesis 2.51, 2.52).
//! - 3×3 nodes: `h0 + (h₋−h0)·w₋ + (h₊−h0)·w₊` along z for three columns, then along x; the
//!   centre weight is implicit (equation 17; thesis 2.63).
//!
//! Each lerp rounds its exact product once, to nearest, so it stays within its nodes; constant
//! maps are exact under every kernel, and under the hat tilted ones are within the two roundings:
//! exact wherever the products are whole bits.
//!
//! | wire in | wire out |
//! |---|---|
//! | `hit`, `ground_x`, `ground_z` | `surface`, `slope_x`, `slope_z` |
//!
//! *Cycles*: one result per cycle over 2×2 nodes, four cycles over 3×3 (memory banks).
//! *Holes*: the surface exists where every node that it is made of has data; bits read with the nodes
//! say so. *Never*: truncates a partial product.

use std::sync::Arc;

use super::coefficient::{Bank, Coefficient as C};
use super::height_memory::HeightMemory;
use super::kernel_rom::{self, KernelRom};
use super::line::{When, Wire, Work};
use super::surface_unit::SurfaceUnit;
use super::{Description, Line, Reads, Timing, Unit};
use crate::frame::Hit;
use crate::word::{Cell, Interpolating, Multiply, Register, Rescale, Site, Word, World};

/// What the interpolator is.
pub const DESCRIPTION: Description = Description {
    name: "interpolator",
    stage: "interpolator",
    gives: "surface height and slopes at a place",
    inputs: &[Wire::Hit, Wire::GroundX, Wire::GroundZ],
    outputs: &[Wire::Surface, Wire::SlopeX, Wire::SlopeZ],
    registers: &[
        Register::GroundX,
        Register::GroundZ,
        Register::Node,
        Register::Surface,
        Register::SlopeX,
        Register::SlopeZ,
        Register::Weight,
        Register::WeightSlope,
    ],
    multiplier: Register::Weight,
};

/// Pipeline stages behind nodes and weights: differences, lerps along z, lerp along x, compare.
pub const LERP_LATENCY: u32 = 5;

/// Pipeline stages at the hit behind those of a height: the factors of slopes.
pub const SLOPE_LATENCY: u32 = 2;

/// Cycles from a place to its nodes and their weights: N of docs/cycles.md.
pub const fn nodes_latency(memory_latency: u32) -> u32 {
    if memory_latency > kernel_rom::LATENCY { memory_latency } else { kernel_rom::LATENCY }
}

/// Cycles from a place to the height there.
pub const fn height_latency(memory_latency: u32) -> u32 {
    nodes_latency(memory_latency) + LERP_LATENCY
}

/// Cycles at the hit, where an interpolation takes this many cycles of reading.
pub const fn timing(reads: u32, memory_latency: u32) -> Timing {
    Timing::pipeline(reads, height_latency(memory_latency) + SLOPE_LATENCY)
}

/// Which nodes are read, and how the weight is made of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// 2×2 nodes, the weight is the kernel's.
    Plain,
    /// 2×2 nodes, the weight is the hat plus the difference to the kernel shifted right.
    TowardHat(u32),
    /// 2×2 nodes, the weight is the hat's: no ROM is fitted.
    Hat,
    /// 3×3 nodes around the nearest one.
    Stretch,
}

/// The interpolator's memories and registers.
#[derive(Clone, Debug)]
pub struct Interpolator<W: World> {
    /// Heights of the nodes, and which have no data.
    pub heights: Arc<HeightMemory<W::Height>>,
    /// The kernel; unread, and absent where not fitted, when the form is the hat.
    pub rom: Option<Arc<KernelRom<W::Weight>>>,
    /// Which nodes and weights.
    pub form: Form,
    /// The weight one: the sum of an axis's weights.
    pub one: W::Weight,
    /// Height unit over cell size, x and z: absent when both are one.
    pub slope_scale: Option<[W::Weight; 2]>,
    /// Format of weights.
    pub weight_format: <W::Weight as Word>::Format,
}

/// Everything the interpolator computes at one place.
#[derive(Clone, Copy, Debug)]
pub struct Sample<W: World> {
    /// Height of the surface, height units.
    pub surface: W::Height,
    /// Negated slope against x.
    pub slope_x: W::Height,
    /// Negated slope against z.
    pub slope_z: W::Height,
}

/// Weight and slope of the kernel along one axis of the 2×2 form.
#[derive(Clone, Copy, Debug)]
pub struct Arm<T> {
    /// Weight of the node before the place.
    pub weight: T,
    /// Derivative of the weight.
    pub slope: T,
}

impl<W: World> Interpolator<W> {
    /// Cycles of the height memory per interpolation: 3×3 nodes take four cycles from four banks.
    pub fn read_cycles(&self) -> u32 {
        if self.form == Form::Stretch { 4 } else { 1 }
    }

    /// Reads of a height: its nodes, and a weight along each axis.
    pub fn reads_per_height(&self) -> Reads {
        let memory = if self.form == Form::Stretch { 9 } else { 4 };
        Reads { memory, table: if self.rom.is_some() { 2 } else { 0 } }
    }
}

impl<W: Interpolating> Interpolator<W> {
    /// Weight of the lower node of an axis at a fraction within the cell.
    #[inline(always)]
    pub fn weight(&self, fraction: W::Ground, site: Site) -> W::Weight {
        let site = site.at(Register::Weight);
        match (&self.form, &self.rom) {
            // Equation 16; thesis 2.59 to 2.61.
            (Form::TowardHat(shift), Some(rom)) => {
                let kernel = fraction.look_up(rom.weights(), site);
                self.hat(fraction, site).toward(kernel, *shift)
            }
            (Form::Plain, Some(rom)) => fraction.look_up(rom.weights(), site),
            _ => self.hat(fraction, site),
        }
    }

    /// The hat's weight.
    #[inline(always)]
    fn hat(&self, fraction: W::Ground, site: Site) -> W::Weight {
        self.one - fraction.rescale(0, self.weight_format, site)
    }

    /// Weight and slope of the lower node of an axis.
    #[inline(always)]
    pub fn arm(&self, fraction: W::Ground, site: Site) -> Arm<W::Weight> {
        let weight = self.weight(fraction, site);
        let site = site.at(Register::WeightSlope);
        let slope = match (&self.form, &self.rom) {
            (Form::TowardHat(shift), Some(rom)) => {
                // The hat falls with slope one.
                let slope = fraction.look_up(rom.slopes(), site);
                (slope + self.one).shift_toward_zero(*shift) - self.one
            }
            (Form::Plain, Some(rom)) => fraction.look_up(rom.slopes(), site),
            _ => -self.one,
        };
        Arm { weight, slope }
    }

    /// Nodes h1 (i, j), h2 (i, j+1), h3 (i+1, j), h4 (i+1, j+1) around a place.
    #[inline(always)]
    pub fn nodes(&self, x: W::Ground, z: W::Ground, site: Site) -> [W::Height; 4] {
        let [i, j] = cell::<W>(x, z, site);
        self.heights.corners(i, j)
    }

    /// Whether a place is within the edges of the map.
    #[inline(always)]
    pub fn is_on_map(&self, x: W::Ground, z: W::Ground, site: Site) -> bool {
        let [i, j] = cell::<W>(x, z, site);
        self.heights.contains(i, j)
    }

    /// Whether a node that the surface at a place is made of has no data.
    #[inline(always)]
    pub fn is_hole(&self, x: W::Ground, z: W::Ground, site: Site) -> bool {
        let heights = &*self.heights;
        if !heights.has_voids() {
            return false;
        }
        if self.form == Form::Stretch {
            let [i, j] = nearest::<W>(x, z, site);
            heights.any_void(i - 1, j - 1, 3)
        } else {
            let [i, j] = cell::<W>(x, z, site);
            heights.any_void(i, j, 2)
        }
    }

    /// Surface height and slopes at a place (equations 14 to 18; thesis 2.51, 2.52, 2.59 to 2.61,
    /// 2.63).
    #[inline(always)]
    pub fn sample(&self, x: W::Ground, z: W::Ground, site: Site) -> Sample<W> {
        if self.form == Form::Stretch {
            return self.stretched(x, z, site);
        }
        let [h1, h2, h3, h4] = self.nodes(x, z, site);
        let arm_x = self.arm(x.fraction(), site.step(site.operation ^ 1));
        let arm_z = self.arm(z.fraction(), site);
        let west = lerp(h2, h1, arm_z.weight, site);
        let east = lerp(h4, h3, arm_z.weight, site.step(site.operation ^ 1));
        let north = lerp(h3, h1, arm_x.weight, site.step(site.operation ^ 2));
        let south = lerp(h4, h2, arm_x.weight, site.step(site.operation ^ 3));
        Sample {
            surface: lerp(east, west, arm_x.weight, site.step(site.operation ^ 4)),
            slope_x: east.multiply_difference(west, arm_x.slope, site.at(Register::SlopeX)),
            slope_z: south.multiply_difference(north, arm_z.slope, site.at(Register::SlopeZ)),
        }
    }

    fn stretched(&self, x: W::Ground, z: W::Ground, site: Site) -> Sample<W> {
        let stencil = self.stencil(x, z, site);
        let (wx, wz) = (stencil.weights_x, stencil.weights_z);
        let mut along_z = stencil.nodes[1];
        let mut slope_along_z = stencil.nodes[1];
        for (k, column) in stencil.nodes.iter().enumerate() {
            let site = site.step(site.operation ^ k as u32);
            along_z[k] = three(*column, wz.weights, site.at(Register::Surface));
            slope_along_z[k] = slope(*column, wz.slopes, site.at(Register::SlopeZ));
        }
        let site = site.step(site.operation ^ 4);
        Sample {
            surface: three(along_z, wx.weights, site.at(Register::Surface)),
            slope_x: slope(along_z, wx.slopes, site.at(Register::SlopeX)),
            slope_z: three(slope_along_z, wx.weights, site.at(Register::SlopeZ)),
        }
    }

    /// The 3×3 nodes around a place, by column, and their weights.
    #[inline(always)]
    pub fn stencil(&self, x: W::Ground, z: W::Ground, site: Site) -> Stencil<W> {
        let heights = &*self.heights;
        let [i, j] = nearest::<W>(x, z, site);
        let rows = [heights.row(j - 1), heights.row(j), heights.row(j + 1)];
        let nodes = [i - 1, i, i + 1].map(|i| {
            let column = heights.column(i);
            rows.map(|row| heights.at(column, row))
        });
        Stencil {
            nodes,
            weights_x: self.outer(x.fraction_from_midpoint(), site.step(site.operation ^ 1)),
            weights_z: self.outer(z.fraction_from_midpoint(), site),
        }
    }

    /// Weights and slopes of the nodes before and after the nearest one.
    #[inline(always)]
    fn outer(&self, from_midpoint: W::Ground, site: Site) -> Outer<W::Weight> {
        match &self.rom {
            Some(rom) => {
                let [weights, [before, after]] = from_midpoint
                    .look_up_mirrored([rom.weights(), rom.slopes()], site.at(Register::Weight));
                Outer { weights, slopes: [before, -after] }
            }
            // Set-up fits a ROM with every stretched kernel.
            None => Outer { weights: [self.one; 2], slopes: [self.one; 2] },
        }
    }
}

impl<W: Interpolating> Unit<W> for Interpolator<W> {
    fn description(&self) -> &'static Description {
        &DESCRIPTION
    }

    fn run(&self, line: &mut Line<W>) {
        for i in 0..line.len() {
            if line.is(When::OnSurface, i) {
                let site = Site::pixel(line.number, line.column[i]).step(AT_THE_HIT);
                let sample = self.sample(line.ground_x[i], line.ground_z[i], site);
                line.surface[i] = sample.surface;
                (line.slope_x[i], line.slope_z[i]) = match self.slope_scale {
                    None => (sample.slope_x, sample.slope_z),
                    Some([x, z]) => (
                        sample.slope_x.multiply(x, site.at(Register::SlopeX).step(AT_THE_HIT ^ 8)),
                        sample.slope_z.multiply(z, site.at(Register::SlopeZ).step(AT_THE_HIT ^ 8)),
                    ),
                };
            }
        }
    }

    fn coefficients(&self, bank: &mut Bank<W>) {
        let (form, shift) = match self.form {
            Form::Plain => (0, 0),
            Form::TowardHat(shift) => (1, shift),
            Form::Hat => (2, 0),
            Form::Stretch => (3, 0),
        };
        bank.number(C::Form, form);
        bank.number(C::DeformationShift, shift);
        bank.weight(C::WeightOne, self.one);
        self.heights.coefficients(bank);
        if let Some(rom) = &self.rom {
            bank.number(C::KernelLog2, rom.log2());
        }
        bank.number(C::SlopeScaled, self.slope_scale.is_some());
        if let Some([x, z]) = self.slope_scale {
            bank.weight(C::SlopeScaleX, x);
            bank.weight(C::SlopeScaleZ, z);
        }
    }

    fn timing(&self, memory_latency: u32) -> Timing {
        timing(self.read_cycles(), memory_latency)
    }

    fn reads(&self, _: Work, hit: Hit) -> Reads {
        let Reads { memory, table } = self.reads_per_height();
        match hit {
            // Weights, and their derivatives.
            Hit::Surface | Hit::Side => Reads { memory, table: 2 * table },
            Hit::Sky | Hit::OutOfRange => Reads::default(),
        }
    }
}

/// The operation number of the interpolation at the hit, apart from all samples of the ray.
pub const AT_THE_HIT: u32 = 1 << 31;

/// Nodes and weights of the 3×3 form.
#[derive(Clone, Copy, Debug)]
pub struct Stencil<W: World> {
    /// Nodes by column from west to east, each from north to south.
    pub nodes: [[W::Height; 3]; 3],
    /// Weights of the outer columns of nodes.
    pub weights_x: Outer<W::Weight>,
    /// Weights of the outer rows of nodes.
    pub weights_z: Outer<W::Weight>,
}

/// Weights and slopes of the outer nodes; those of the centre are implicit.
#[derive(Clone, Copy, Debug)]
pub struct Outer<T> {
    /// Of the node before the middle one, and of the node after it.
    pub weights: [T; 2],
    /// Derivatives of these weights.
    pub slopes: [T; 2],
}

/// Indices of the cell that a place lies in.
#[inline(always)]
pub fn cell<W: World>(x: W::Ground, z: W::Ground, site: Site) -> [i32; 2] {
    [x.cell(site.at(Register::GroundX)), z.cell(site.at(Register::GroundZ))]
}

/// Indices of the node nearest to a place.
#[inline(always)]
fn nearest<W: World>(x: W::Ground, z: W::Ground, site: Site) -> [i32; 2] {
    [x.nearest(site.at(Register::GroundX)), z.nearest(site.at(Register::GroundZ))]
}

/// A lerp between heights.
#[inline(always)]
fn lerp<H: Multiply<T>, T: Word>(from: H, to: H, weight: T, site: Site) -> H {
    from.lerp(to, weight, site.at(Register::Surface))
}

/// The height between nodes h1 to h4 (equation 14; thesis 2.51, 2.52).
#[inline(always)]
pub fn lerp_nodes<H: Multiply<T>, T: Word>(
    [h1, h2, h3, h4]: [H; 4],
    weight_x: T,
    weight_z: T,
    site: Site,
) -> H {
    let west = lerp(h2, h1, weight_z, site);
    let east = lerp(h4, h3, weight_z, site.step(site.operation ^ 1));
    lerp(east, west, weight_x, site.step(site.operation ^ 4))
}

/// `h0 + (h₋ − h0)·w₋ + (h₊ − h0)·w₊`, one rounding.
#[inline(always)]
fn three<H: Multiply<T>, T: Word>(nodes: [H; 3], weights: [T; 2], site: Site) -> H {
    let [before, centre, after] = nodes;
    centre.lerp_two([before, after], weights, site)
}

/// The negated derivative of [`three`].
#[inline(always)]
fn slope<H: Multiply<T>, T: Word>(nodes: [H; 3], slopes: [T; 2], site: Site) -> H {
    let [before, centre, after] = nodes;
    centre.multiply_differences([before, after], slopes, site)
}

impl<W: Interpolating> SurfaceUnit<W> for Interpolator<W> {
    #[inline(always)]
    fn contains(&self, x: W::Ground, z: W::Ground, site: Site) -> bool {
        self.is_on_map(x, z, site) && !self.is_hole(x, z, site)
    }

    #[inline(always)]
    fn height(&self, x: W::Ground, z: W::Ground, site: Site) -> W::Height {
        if self.form == Form::Stretch {
            let stencil = self.stencil(x, z, site);
            let mut along_z = stencil.nodes[1];
            for (k, column) in stencil.nodes.iter().enumerate() {
                let site = site.step(site.operation ^ k as u32).at(Register::Surface);
                along_z[k] = three(*column, stencil.weights_z.weights, site);
            }
            let site = site.step(site.operation ^ 4).at(Register::Surface);
            return three(along_z, stencil.weights_x.weights, site);
        }
        let weight_z = self.weight(z.fraction(), site);
        let weight_x = self.weight(x.fraction(), site.step(site.operation ^ 1));
        lerp_nodes(self.nodes(x, z, site), weight_x, weight_z, site)
    }
}
