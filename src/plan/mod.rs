//! The plan: which units a scene needs, at which widths, and why the others are left out.
//!
//! A plan is made from the scene alone, in `f64`, before anything is loaded; making it may fail,
//! running it cannot. A pruned and a full machine give the same frame.

mod fitted;
pub mod formats;
pub mod geometry;
mod plane;
mod planned;
mod proof;
mod surface;
mod terrain;
pub mod units;
mod word_class;
mod words;

use crate::scene::{Scene, Screen};
use geometry::Geometry;
use words::Choice;

pub use fitted::Fit;
pub use plane::PlanePlan;
pub use planned::Projection;
pub use surface::SurfacePlan;
pub use terrain::TerrainPlan;
pub use units::UnitPlan;
pub use word_class::WordClass;

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
        "camera.position: the eye is at height {}, the ground under it at {1}: it would look from \
         under the ground; raise y above {1}", told_apart(*eye, *ground).0, told_apart(*eye, *ground).1
    )]
    EyeUnderGround {
        /// Height of the eye, scene units.
        eye: f64,
        /// Height of the surface there.
        ground: f64,
    },
    /// Several surfaces, and why they cannot compete.
    #[error("surface: {0}; keep one [[surface]]")]
    SeveralSurfaces(&'static str),
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

/// A scene compiled for one channel.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Screen whose pixels are drawn.
    pub screen: Screen,
    /// View vectors of that screen in the ground frame.
    pub geometry: Geometry,
    /// The word size of the stock registers.
    pub words: WordClass,
    /// The plans of the scene's surfaces, in their order.
    pub surfaces: Vec<SurfacePlan>,
    /// Everything fitted, nothing pruned.
    pub full: bool,
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
        if scene.surfaces.len() > 1 {
            let refused = |reason| Err(PlanError::SeveralSurfaces(reason));
            if scene.terrain().is_some() {
                return refused(
                    "a height map beside other surfaces is not built yet: its depth is no register",
                );
            }
            if !scene.formats.is_empty() {
                return refused(
                    "several surfaces in formats of the scene's own are not built yet: overflows of \
                     what is hidden would not be counted",
                );
            }
        }
        let geometry = Geometry::new(&scene.camera, &screen);
        let Choice { words, surfaces, why: words_why, not_proved } =
            words::choose(scene, &geometry, full)?;
        Ok(Self { screen, geometry, words, surfaces, full, words_why, not_proved })
    }
}

/// An eye and a higher ground with so many decimals that they differ, the ground rounded up, so that
/// an eye at that height is not under it.
fn told_apart(eye: f64, ground: f64) -> (String, String) {
    const MOST: usize = 17;
    let at = |places: usize| {
        let step = libm::pow(10.0, -(places as f64));
        let mut up = format!("{ground:.places$}");
        if up.parse().is_ok_and(|shown: f64| shown < ground) {
            up = format!("{:.places$}", ground + step / 2.0);
        }
        (format!("{eye:.places$}"), up)
    };
    (6..MOST).map(at).find(|(eye, ground)| eye != ground).unwrap_or_else(|| at(MOST))
}

/// A shift that leaves no bit of any word.
pub(crate) const ALL_BITS: u32 = 63;
