//! The plan: which units a scene needs, at which widths, and why the others are left out.
//!
//! A plan is made from the scene alone, in `f64`, before anything is loaded; making it may fail,
//! running it cannot. A pruned and a full machine give the same frame.

pub mod geometry;
pub mod ranges;
pub mod units;

use glam::DVec3;

use crate::scene::{
    Deformation, KernelShape, Scene, Screen, StepperMode, Surface, Terrain, WordSize,
};
use crate::word::{Class, Fixed, Register};
use geometry::Geometry;
use ranges::WalkPlan;

pub use units::UnitPlan;

/// Why a scene cannot be planned.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// A register would not hold what the scene puts into it.
    #[error("{field}: {reason}; {remedy}")]
    Range {
        /// Field of the scene.
        field: &'static str,
        /// What is wrong.
        reason: String,
        /// What to do.
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
        /// What there is.
        known: String,
    },
    /// An unknown register in `[format]`.
    #[error(
        "format.{name}: no register or class has this name; the nearest is {nearest}; \
             classes: view, ground, height, weight, tone"
    )]
    UnknownRegister {
        /// What was asked for.
        name: String,
        /// What is near.
        nearest: String,
    },
    /// A format that the machine cannot work with.
    #[error("format.{name}: {reason}")]
    Format {
        /// Register.
        name: String,
        /// What is wrong and what to do.
        reason: String,
    },
}

impl PlanError {
    /// The reason alone, without field and remedy.
    fn reason(&self) -> String {
        match self {
            Self::Range { reason, .. } => reason.clone(),
            other => other.to_string(),
        }
    }
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

impl WordClass {
    /// 32 bits.
    pub const NARROW: Self = Self { name: "narrow", width: 32, view_point: 30, ground_point: 20 };
    /// 64 bits.
    pub const WIDE: Self = Self { name: "wide", width: 64, view_point: 38, ground_point: 24 };

    /// Largest magnitude of a ground or height register that the plan allows.
    pub fn ground_limit(self) -> f64 {
        // Products in wide words are formed from values of up to 2^24; nothing needs more.
        libm::exp2(f64::from(self.width - 1 - self.ground_point).min(24.0))
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

/// What the machine draws.
#[derive(Clone, Debug)]
pub enum Ground {
    /// A height map.
    Terrain(WalkPlan),
    /// A plane.
    Plane(PlanePlan),
}

/// Projection onto a plane.
#[derive(Clone, Debug)]
pub struct PlanePlan {
    /// Word size.
    pub words: WordClass,
    /// Why.
    pub words_why: String,
    /// Unit normal.
    pub normal: DVec3,
    /// Side of a square, scene units.
    pub checker: f64,
    /// In-plane axes of the two coordinates (equation 11).
    pub axes: [DVec3; 2],
    /// The eye along them, in squares.
    pub eye: [f64; 2],
    /// `F = d − n·r_h`, scene units.
    pub numerator: f64,
    /// Quotients lie within ±2^range squares.
    pub range: u32,
}

/// Which of the units that can be left out are fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fitted {
    /// Divider, with the denominator's accumulator.
    pub divider: bool,
    /// Skip pyramid.
    pub pyramid: bool,
    /// Kernel ROM, with the hat blend.
    pub kernel_rom: bool,
    /// The bits that mark nodes without data.
    pub void_bits: bool,
    /// Slope multipliers for cells that are not cubes of the height unit.
    pub slope_scale: bool,
    /// Normal and light.
    pub light: bool,
    /// Units of another kind of surface, idle.
    pub idle: bool,
}

/// A scene compiled for one channel.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The channel's screen.
    pub screen: Screen,
    /// Camera geometry.
    pub geometry: Geometry,
    /// What is drawn.
    pub ground: Ground,
    /// Everything fitted, nothing pruned.
    pub full: bool,
    /// What is fitted.
    pub fitted: Fitted,
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
        let (ground, needs) = match &scene.surface {
            Surface::Terrain(terrain) => {
                let walk =
                    WalkPlan::new(terrain, &geometry, scene.stepper.fineness, scene.machine.words)?;
                let needs = terrain_needs(scene, terrain, &walk);
                (Ground::Terrain(walk), needs)
            }
            Surface::Plane(_) => {
                let plane = PlanePlan::new(scene, &geometry)?;
                let needs = Fitted {
                    divider: true,
                    pyramid: false,
                    kernel_rom: false,
                    void_bits: false,
                    slope_scale: false,
                    light: false,
                    idle: false,
                };
                (Ground::Plane(plane), needs)
            }
        };
        let fitted = if full {
            let terrain = matches!(ground, Ground::Terrain(_));
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
        Ok(Self { screen, geometry, ground, full, fitted })
    }

    /// The word size of the stock world that the plan chose.
    pub fn words(&self) -> WordClass {
        match &self.ground {
            Ground::Terrain(walk) => walk.words,
            Ground::Plane(plane) => plane.words,
        }
    }

    /// Why that word size.
    pub fn words_why(&self) -> &str {
        match &self.ground {
            Ground::Terrain(walk) => &walk.words_why,
            Ground::Plane(plane) => &plane.words_why,
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
        Deformation::Blend { weight_shift } => {
            kernel.shape == KernelShape::Hat || weight_shift >= last
        }
        Deformation::Stretch => false,
    }
}

/// Whether the kernel shows: not on a constant map, but for the reach of its holes.
pub(crate) fn needs_kernel(scene: &Scene, constant: bool, holes: bool) -> bool {
    !constant || (holes && scene.kernel.deformation == Deformation::Stretch)
}

fn terrain_needs(scene: &Scene, terrain: &Terrain, walk: &WalkPlan) -> Fitted {
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

impl PlanePlan {
    fn new(scene: &Scene, geometry: &Geometry) -> Result<Self, PlanError> {
        let Surface::Plane(plane) = &scene.surface else { unreachable!("called for planes only") };
        let axes = plane_axes(plane.normal);
        let eye = axes.map(|axis| axis.dot(geometry.eye) / plane.checker);
        let farthest = eye[0].abs().max(eye[1].abs());
        let numerator = plane.distance - plane.normal.dot(geometry.eye);
        let drift = f64::from(geometry.columns) + f64::from(geometry.lines);
        // `coarsest`: the last bit of a position in pixels of the nearest point.
        let fits = |words: WordClass, coarsest: f64| -> Result<u32, PlanError> {
            let ulp = |point: u32| libm::exp2(-f64::from(point));
            // Positions hold the eye and the quotient.
            let limit = words.ground_limit();
            let range = libm::log2(limit) as u32 - 1;
            if farthest + libm::exp2(f64::from(range)) > limit {
                return Err(PlanError::Range {
                    field: "camera.position",
                    reason: format!("the eye is {farthest:.0} squares from the origin"),
                    remedy: "move it closer, or enlarge surface.checker",
                });
            }
            if drift * ulp(words.view_point + 1) > geometry.finest_angle / 128.0 {
                return Err(PlanError::Range {
                    field: "screen.size",
                    reason: "the roundings of the view coefficients add up to more than 1/128 \
                             pixel"
                        .into(),
                    remedy: "draw fewer or coarser pixels",
                });
            }
            // The nearest point of the plane is |F| away: a pixel is at least so large there.
            let pixel = numerator.abs() * geometry.finest_angle / plane.checker;
            if numerator != 0.0 && ulp(words.ground_point) > pixel * coarsest {
                return Err(PlanError::Range {
                    field: "camera.position",
                    reason: format!(
                        "the eye is {:e} above the plane, where the last bit of a position is \
                         {:.2} pixel",
                        numerator.abs(),
                        ulp(words.ground_point) / pixel
                    ),
                    remedy: "move it away from the plane, or make surface.checker smaller",
                });
            }
            Ok(range)
        };
        let (words, range, words_why) = match scene.machine.words {
            WordSize::Narrow => (
                WordClass::NARROW,
                fits(WordClass::NARROW, 0.5)?,
                "asked for, and proved".to_owned(),
            ),
            WordSize::Wide => {
                (WordClass::WIDE, fits(WordClass::WIDE, 0.5)?, "asked for".to_owned())
            }
            WordSize::Auto => match fits(WordClass::NARROW, 1.0 / 64.0) {
                Ok(range) => (WordClass::NARROW, range, "positions and pixels fit".to_owned()),
                Err(refusal) => {
                    let why = format!("32 bits do not do: {}", refusal.reason());
                    (WordClass::WIDE, fits(WordClass::WIDE, 0.5)?, why)
                }
            },
        };
        let (normal, checker) = (plane.normal, plane.checker);
        Ok(Self { words, words_why, normal, checker, axes, eye, numerator, range })
    }
}

/// In-plane axes (equation 11): along n × z (n × x where n is nearly z), and across it; x and z
/// for a floor.
pub(crate) fn plane_axes(normal: DVec3) -> [DVec3; 2] {
    let across = if normal.z.abs() < 0.9 { DVec3::Z } else { DVec3::X };
    let first = normal.cross(across).normalize();
    [first, first.cross(normal)]
}
