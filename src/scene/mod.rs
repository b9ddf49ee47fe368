//! What the user asked for: scene units, `f64`, degrees in the file and radians in here.
//!
//! Ground frame: x = column = east, z = row = south, y up, right-handed. Craft frame:
//! u forward, v up, w to the right.
//!
//! ```text
//!            -z north                    v up
//!               |                        |   u forward
//!   -x west ----+---- x east             |  /
//!               |                        | /
//!            z south                     +------ w right
//! ```
//!
//! Nothing in this module knows more of registers than their names, or anything of engines. A [`Scene`] that exists is complete
//! and finite: every value has been checked by the reader in [`mod@file`].

mod array;
pub mod builtin;
mod camera;
pub mod error;
mod field;
pub mod file;
mod format;
mod fractal;
pub mod height_map;
mod keys;
mod nodata;
pub mod overlook;
pub mod screen;
pub mod set;
mod surface;
mod tree;
pub mod write;

use std::sync::Arc;

use glam::{DVec2, DVec3};

pub use crate::word::{Overflow, Registers, Rounding};
pub use builtin::load;
pub use error::SceneError;
pub(crate) use error::list;
pub use format::FormatRequest;
pub(crate) use format::registers;
pub use height_map::{Encoding, HeightFile, HeightMap};

/// A complete scene: camera, screens, one surface, and the machine that draws it.
#[derive(Clone, Debug)]
pub struct Scene {
    /// File stem or built-in name, for reports.
    pub name: String,
    /// Metres per scene unit; reports only.
    pub unit_m: f64,
    /// Seed of everything drawn at random (stochastic rounding, sample choice).
    pub seed: u64,
    /// Where the craft is and how it is turned.
    pub camera: Camera,
    /// One screen per channel, at least one.
    pub screens: Vec<Screen>,
    /// What is seen.
    pub surface: Surface,
    /// The finite function that interpolates heights.
    pub kernel: Kernel,
    /// How a ray walks over the map.
    pub stepper: Stepper,
    /// Direction and share of the light.
    pub light: Light,
    /// Colours as sRGB bytes.
    pub color: Colors,
    /// Clock and memory of the emulated machine.
    pub machine: Hardware,
    /// Overrides of the stock register formats: class or register name, format. Sweep world only.
    pub formats: Vec<(Registers, FormatRequest)>,
}

/// The craft: position `r_0`, offset `h` of the centre of projection, attitude.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// `r_0` in the ground frame, scene units.
    pub position: DVec3,
    /// `h` in the craft frame (u, v, w), scene units.
    pub offset: DVec3,
    /// Orientation of the craft.
    pub attitude: Attitude,
}

/// Orientation of the craft, by angles or by directions.
#[derive(Clone, Debug, PartialEq)]
pub enum Attitude {
    /// `A = R_Y(heading) R_Z(pitch) R_X(roll)`.
    Angles(Angles),
    /// Forward direction and a hint of up; neither needs unit length, they are not parallel.
    Directions {
        /// Direction of u in the ground frame.
        forward: DVec3,
        /// v lies in the plane of `forward` and `up`, on the side of `up`.
        up: DVec3,
    },
}

/// Heading, pitch and roll in radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Angles {
    /// About Y; 0 looks along +x (east), positive to the left.
    pub heading: f64,
    /// Nose up positive.
    pub pitch: f64,
    /// Right wing down positive.
    pub roll: f64,
}

/// One channel: a flat raster screen perpendicular to u.
#[derive(Clone, Debug, PartialEq)]
pub struct Screen {
    /// Channel name.
    pub name: String,
    /// Pixels across.
    pub columns: u32,
    /// Scan lines.
    pub lines: u32,
    /// Distance and pixel pitch.
    pub extent: Extent,
    /// `(Ve, We)`: centre of the screen off the axis, up and to the right, in the unit of
    /// `distance` (with `fov`, the screen stands at distance 1).
    pub center: DVec2,
    /// Mounting angles of the screen in the cabin: `A A_mount` in place of `A`.
    pub mount: Angles,
}

/// How large the screen is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// Field of view in radians across the width; square pixels, distance 1.
    FieldOfView(f64),
    /// Distance `U1` and pitch `(dz across, dy down)` of one pixel, in one unit.
    Pitch {
        /// `U1`.
        distance: f64,
        /// `(dz, dy)`.
        pixel: DVec2,
    },
}

impl Screen {
    /// `U1` in the unit of [`Screen::pitch`].
    pub fn distance(&self) -> f64 {
        match self.extent {
            Extent::FieldOfView(_) => 1.0,
            Extent::Pitch { distance, .. } => distance,
        }
    }

    /// Pixel pitch `(dz across, dy down)`.
    pub fn pitch(&self) -> DVec2 {
        match self.extent {
            Extent::FieldOfView(fov) => {
                DVec2::splat(2.0 * libm::tan(fov / 2.0) / f64::from(self.columns))
            }
            Extent::Pitch { pixel, .. } => pixel,
        }
    }

    /// The same screen with another raster: the field across the width stays.
    #[must_use]
    pub fn resized(&self, columns: u32, lines: u32) -> Self {
        let extent = match self.extent {
            Extent::Pitch { distance, pixel } => Extent::Pitch {
                distance,
                pixel: pixel * (f64::from(self.columns) / f64::from(columns)),
            },
            fov @ Extent::FieldOfView(_) => fov,
        };
        Self { columns, lines, extent, ..self.clone() }
    }
}

/// What the rays meet.
#[derive(Clone, Debug)]
pub enum Surface {
    /// A height map interpolated by finite functions.
    Terrain(Terrain),
    /// An infinite checkered plane `n·r = d`.
    Plane(Plane),
}

/// A height map in the scene.
#[derive(Clone, Debug)]
pub struct Terrain {
    /// As written in the scene: a path or `builtin:NAME`.
    pub source: String,
    /// The samples, with `nodata` carried out: nodes that are NaN are holes.
    pub map: Arc<HeightMap>,
    /// How the samples of the file stand for heights.
    pub encoding: Encoding,
    /// Cell size (Lx, Lz) in scene units, positive.
    pub cell: DVec2,
    /// `y = (sample - offset) * scale`.
    pub offset: f64,
    /// Scene units of height per unit of sample.
    pub scale: f64,
    /// What lies beyond the map.
    pub outside: Outside,
    /// What nodes without data become, as asked for; `map` holds the outcome.
    pub nodata: NoData,
    /// Depth of the block under the lowest node whose sides are drawn, in scene units, positive.
    /// A ray that falls below it outside the map or in a hole sees sky. `None`: a quarter of the relief, two
    /// cells at least.
    pub base_depth: Option<f64>,
}

impl Terrain {
    /// Height of node (column i, row j) in scene units; NaN in a hole.
    pub fn node(&self, i: usize, j: usize) -> f64 {
        self.height(self.map.sample(i, j))
    }

    /// Height in scene units of a map sample.
    pub fn height(&self, sample: f32) -> f64 {
        (f64::from(sample) - self.offset) * self.scale
    }

    /// Lowest and highest node with data in scene units.
    pub fn range(&self) -> (f64, f64) {
        let (low, high) = self.map.range();
        let (a, b) = (self.height(low), self.height(high));
        (a.min(b), a.max(b))
    }

    /// Depth of the block under the lowest node, see [`Terrain::base_depth`].
    pub fn base_depth(&self) -> f64 {
        let (low, high) = self.range();
        self.base_depth.unwrap_or_else(|| ((high - low) / 4.0).max(2.0 * self.cell.max_element()))
    }
}

/// What lies beyond the edge nodes of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// Nothing: the map ends at its outermost nodes and its sides are drawn.
    Sky,
    /// The edge nodes go on for ever.
    Clamp,
    /// The map repeats; its period is its number of nodes.
    Wrap,
}

/// What nodes without data become.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoData {
    /// Cells that touch one are holes.
    Hole,
    /// The sample of the nearest node with data.
    Nearest,
    /// This sample, in the unit of the map.
    Sample(f64),
}

/// A checkered plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal n.
    pub normal: DVec3,
    /// d in `n·r = d`, scene units.
    pub distance: f64,
    /// Side of a checker square in scene units.
    pub checker: f64,
}

/// The finite function and its deformation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kernel {
    /// The basic shape f.
    pub shape: KernelShape,
    /// Deformation.
    pub deformation: Deformation,
    /// Entries of the kernel table over the unit interval, a power of two.
    pub table: u32,
}

/// The four finite functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KernelShape {
    /// `(cos πt + 1)/2`.
    Cosine,
    /// `1 − 2t²`, then `2(1−|t|)²`.
    Parabola,
    /// `2^−(2t)²`, then `1 − 2^−(2−2|t|)²`.
    Exponential,
    /// `1 − |t|`.
    Hat,
}

/// What is done to the finite function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deformation {
    /// 0: the plain finite function over 2×2 nodes.
    None,
    /// 1: `⅔ f(⅔x)` over 3×3 nodes.
    Stretch,
    /// 2: the hat plus `2^-weight_shift` of the difference to f, over 2×2 nodes.
    Blend {
        /// d in `a = 2^-d`.
        weight_shift: u32,
    },
}

/// How a ray walks over the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stepper {
    /// With or without the pyramid.
    pub mode: StepperMode,
    /// k: the largest component of a step lies between 2^-k-1 and 2^-k cells. 0..=6.
    pub fineness: u32,
    /// How the hit is refined.
    pub halvings: Halvings,
}

/// Which samples of a ray are tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepperMode {
    /// Jump over steps that the pyramid proves to be clear.
    Skipping,
    /// Test every step.
    Plain,
}

/// Number of halvings after the first hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Halvings {
    /// Until a step is at most 1/32 of the pixel's footprint.
    Footprint,
    /// A fixed number, 0..=20.
    Fixed(u32),
}

/// Light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Unit vector towards the light, ground frame.
    pub direction: DVec3,
    /// Share of light that comes from everywhere, 0..=1.
    pub ambient: f64,
}

/// Colours, sRGB bytes.
#[derive(Clone, Debug, PartialEq)]
pub struct Colors {
    /// From the lowest to the highest node, evenly spaced, linear in sRGB bytes; 2..=16 colours.
    pub ramp: Vec<[u8; 3]>,
    /// A ray that meets nothing.
    pub sky: [u8; 3],
    /// A ray that meets something beyond the registers' range.
    pub far: [u8; 3],
    /// The side of the map.
    pub side: [u8; 3],
    /// The two colours of a checkered plane.
    pub checker: [[u8; 3]; 2],
}

/// Clock and memory of the emulated machine, and the word size asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hardware {
    /// Clock in MHz.
    pub clock_mhz: f64,
    /// Cycles from address to data, 1..=64.
    pub memory_latency: u32,
    /// Word size of the stock world.
    pub words: WordSize,
    /// The divider's form.
    pub ratio: RatioForm,
}

/// Form of the divider: quotients and remainders are the same, cycles are not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RatioForm {
    /// A pipelined array, one stage per quotient bit: a pixel per cycle.
    Array,
    /// One stage for all bits, one bit per cycle.
    Serial,
}

/// Word size of the stock world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordSize {
    /// The smaller one whose ranges and precision the plan can prove.
    Auto,
    /// 32 bits: 20 after the point on the ground, 30 in the view.
    Narrow,
    /// 64 bits: 24 after the point on the ground, 38 in the view.
    Wide,
}
