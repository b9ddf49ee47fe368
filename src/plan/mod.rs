//! The plan: which units a scene needs, at which widths, and why the others are left out.
//!
//! A plan is made from the scene alone, in `f64`, before anything is loaded; making it may fail,
//! running it cannot. A pruned and a full machine give the same frame.

pub mod formats;
pub mod geometry;
mod plane;
mod proof;
pub mod ranges;
pub mod units;

use crate::scene::{
    Deformation, KernelShape, Scene, Screen, StepperMode, Surface, Terrain, WordSize,
};
use crate::word::{Class, Fixed, Register};
use geometry::Geometry;
use proof::Finding;
use ranges::TerrainPlan;

pub use plane::PlanePlan;
pub use units::UnitPlan;

/// Why a scene cannot be planned.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// A register would not hold what the scene puts into it.
    #[error("{field}: {reason}; {remedy}")]
    Range {
        /// Field of the scene.
        field: &'static str,
        /// Which range or size is out of bounds, with its number.
        reason: String,
        /// What the user can change.
        remedy: &'static str,
    },
    /// The eye is below the surface.
    #[error(
        "camera.position: the eye is at height {eye:.6}, the ground under it at {ground:.6}: it \
         would look from under the ground; raise y above {ground:.6}"
    )]
    EyeUnderGround {
        /// Height of the eye, scene units.
        eye: f64,
        /// Height of the surface there.
        ground: f64,
    },
    /// An unknown screen was named.
    #[error("--screen {asked}: the scene has no such screen; it has {known}")]
    UnknownScreen {
        /// What was asked for.
        asked: String,
        /// Names of the screens that there are.
        known: String,
    },
    /// A format that the machine cannot work with.
    #[error("format.{name}: {reason}")]
    Format {
        /// Name of the register or class.
        name: &'static str,
        /// What is wrong and what to do.
        reason: String,
    },
}

/// A word size of the stock world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WordClass {
    /// Name in reports.
    pub name: &'static str,
    /// Bits of a word.
    pub width: u32,
    /// Fraction bits of view registers.
    pub view_point: u32,
    /// Fraction bits of all others.
    pub ground_point: u32,
}

/// Largest magnitude of a place that the machine works with: products in wide words are formed
/// from values of up to 2^24, and nothing needs more.
const LARGEST_PLACE: f64 = 16_777_216.0;

impl WordClass {
    /// 32 bits: places to 2048 cells, in steps of 2^-20.
    pub const NARROW: Self = Self { name: "narrow", width: 32, view_point: 30, ground_point: 20 };
    /// 64 bits: places to 2^24 cells, in steps of 2^-24.
    pub const WIDE: Self = Self { name: "wide", width: 64, view_point: 38, ground_point: 24 };

    /// The words whose walk a scene's own formats take: those asked for, else narrow ones where
    /// they would hold.
    fn of_sweep(asked: WordSize, narrow_holds: impl FnOnce() -> bool) -> Self {
        match asked {
            WordSize::Narrow => Self::NARROW,
            WordSize::Wide => Self::WIDE,
            WordSize::Auto if narrow_holds() => Self::NARROW,
            WordSize::Auto => Self::WIDE,
        }
    }

    /// Largest magnitude of a ground or height register that the plan allows.
    pub fn ground_limit(self) -> f64 {
        self.fixed(Register::GroundX).limit().min(LARGEST_PLACE)
    }

    /// Format of a register.
    pub fn fixed(self, register: Register) -> Fixed {
        let point = match register.class() {
            Class::View => self.view_point,
            _ => self.ground_point,
        };
        Fixed { width: self.width, point }
    }
}

/// The kind of surface that the machine draws, planned.
#[derive(Clone, Debug)]
pub enum SurfacePlan {
    /// A height map, walked over by rays.
    Terrain(TerrainPlan),
    /// A plane, met by one ratio.
    Plane(PlanePlan),
}

/// Which of the units that can be left out are fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fitted {
    /// Divider, with the denominator's accumulator.
    pub divider: bool,
    /// Skip pyramid, with the adders of a jump.
    pub pyramid: bool,
    /// Kernel ROM, with the weight toward the hat.
    pub kernel_rom: bool,
    /// The bits that mark nodes without data.
    pub void_bits: bool,
    /// Slope multipliers for cells that are not cubes of the height unit.
    pub slope_scale: bool,
    /// The light unit; without it shade is one.
    pub light: bool,
    /// Units of another kind of surface, idle.
    pub idle: bool,
}

/// A scene compiled for one channel.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Screen whose pixels are drawn.
    pub screen: Screen,
    /// View vectors of that screen in the ground frame.
    pub geometry: Geometry,
    /// The plan of its surface.
    pub surface: SurfacePlan,
    /// Everything fitted, nothing pruned.
    pub full: bool,
    /// Which units are fitted.
    pub fitted: Fitted,
    /// Why these words, or how far the scene's own formats go.
    pub words_why: String,
    /// Ranges and roundings that the scene's own formats do not hold, a sentence each: drawn all
    /// the same, with overflows counted. Empty in stock words, which are proved or refused.
    pub not_proved: Vec<String>,
}

impl Plan {
    /// Plans a scene for one of its screens (the first, if `screen` is `None`).
    ///
    /// # Errors
    /// If a range cannot be proved, the eye is under the ground, or the screen does not exist.
    pub fn new(scene: &Scene, screen: Option<&str>, full: bool) -> Result<Self, PlanError> {
        let screen = match screen {
            None => &scene.screens[0],
            Some(name) => scene.screens.iter().find(|s| s.name == name).ok_or_else(|| {
                let known: Vec<_> = scene.screens.iter().map(|s| s.name.as_str()).collect();
                PlanError::UnknownScreen { asked: name.into(), known: known.join(", ") }
            })?,
        }
        .clone();
        let geometry = Geometry::new(&scene.camera, &screen);
        let (asked, formats) = (scene.machine.words, &scene.formats[..]);
        let (surface, needs, finding) = match &scene.surface {
            Surface::Terrain(terrain) => {
                let fineness = scene.stepper.fineness;
                let (walk, finding) =
                    TerrainPlan::new(terrain, &geometry, fineness, asked, formats)?;
                let needs = terrain_needs(scene, terrain, &walk);
                (SurfacePlan::Terrain(walk), needs, finding)
            }
            Surface::Plane(plane) => {
                let (plane, finding) = PlanePlan::new(plane, &geometry, asked, formats)?;
                let needs = Fitted {
                    divider: true,
                    pyramid: false,
                    kernel_rom: false,
                    void_bits: false,
                    slope_scale: false,
                    light: false,
                    idle: false,
                };
                (SurfacePlan::Plane(plane), needs, finding)
            }
        };
        let fitted = if full {
            let terrain = matches!(surface, SurfacePlan::Terrain(_));
            Fitted {
                divider: true,
                pyramid: terrain && scene.stepper.mode == StepperMode::Skipping,
                kernel_rom: terrain,
                void_bits: terrain,
                slope_scale: terrain,
                light: terrain,
                idle: true,
            }
        } else {
            needs
        };
        let Finding { why: words_why, not_proved } = finding;
        Ok(Self { screen, geometry, surface, full, fitted, words_why, not_proved })
    }

    /// The word size of the stock world that the plan chose.
    pub fn words(&self) -> WordClass {
        match &self.surface {
            SurfacePlan::Terrain(walk) => walk.words,
            SurfacePlan::Plane(plane) => plane.words,
        }
    }
}

/// A shift that leaves no bit of any word.
pub(crate) const ALL_BITS: u32 = 63;

/// Whether the kernel's weights are the hat's in every bit, in stock registers of `words` or in the
/// scene's own formats.
pub(crate) fn kernel_is_hat(scene: &Scene, words: WordClass) -> bool {
    let kernel = &scene.kernel;
    let last = if scene.formats.is_empty() { words.width - 1 } else { ALL_BITS };
    match kernel.deformation {
        Deformation::None => kernel.shape == KernelShape::Hat,
        Deformation::TowardHat { weight_shift } => {
            kernel.shape == KernelShape::Hat || weight_shift >= last
        }
        Deformation::Stretch => false,
    }
}

/// Whether the kernel shows: not on a constant map, but for the reach of its holes.
pub(crate) fn needs_kernel(scene: &Scene, constant: bool, holes: bool) -> bool {
    !constant || (holes && scene.kernel.deformation == Deformation::Stretch)
}

fn terrain_needs(scene: &Scene, terrain: &Terrain, walk: &TerrainPlan) -> Fitted {
    let (lowest, highest) = terrain.range();
    let constant = lowest == highest;
    let unit = walk.scale.unit;
    let void_bits = terrain.map.voids() > 0;
    Fitted {
        divider: !walk.from_eye,
        pyramid: scene.stepper.mode == StepperMode::Skipping,
        kernel_rom: needs_kernel(scene, constant, void_bits) && !kernel_is_hat(scene, walk.words),
        void_bits,
        slope_scale: !constant && (terrain.cell.x != unit || terrain.cell.y != unit),
        light: scene.light.ambient < 1.0,
        idle: false,
    }
}
