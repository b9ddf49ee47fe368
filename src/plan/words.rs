//! The word size of a scene: one for all of its surfaces, which is proved for each of them.

use super::PlanError;
use super::formats::Formats;
use super::geometry::Geometry;
use super::proof::{Proof, Refusal};
use super::surface::SurfacePlan;
use crate::scene::{Scene, WordSize};
use crate::word::{Class, Fixed, Register};

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
pub(super) const LARGEST_PLACE: f64 = 16_777_216.0;

impl WordClass {
    /// 32 bits: places to 2048 cells, in steps of 2^-20.
    pub const NARROW: Self = Self { name: "narrow", width: 32, view_point: 30, ground_point: 20 };
    /// 64 bits: places to 2^24 cells, in steps of 2^-24.
    pub const WIDE: Self = Self { name: "wide", width: 64, view_point: 38, ground_point: 24 };

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

/// The words of a scene, and what they lead to.
pub(super) struct Choice {
    pub(super) words: WordClass,
    pub(super) surfaces: Vec<SurfacePlan>,
    /// Why these words, or how far the scene's own formats go.
    pub(super) why: String,
    /// What is not proved of a sweep; nothing in stock words, which are refused instead.
    pub(super) not_proved: Vec<String>,
}

/// Chooses the smaller word size that every surface is proved in, or the one asked for; of the
/// scene's own formats it says what is not proved.
///
/// # Errors
/// If no word size holds the scene, or the one asked for does not.
pub(super) fn choose(scene: &Scene, geometry: &Geometry, full: bool) -> Result<Choice, PlanError> {
    let of = |words| -> Vec<SurfacePlan> {
        let plan = |surface| SurfacePlan::new(surface, scene, geometry, words, full);
        scene.surfaces.iter().map(plan).collect()
    };
    // The facts of a surface in stock words, if it is proved.
    let proved = |words, holds: fn(Proof) -> Result<String, Refusal>| {
        let surfaces = of(words);
        let prove = |surface: &SurfacePlan| {
            let planned = surface.planned();
            let facts = holds(planned.proof(geometry, &Formats::stock(words)))?;
            planned.check_counters()?;
            Ok::<_, Refusal>(facts)
        };
        let facts: Vec<String> = surfaces.iter().map(prove).collect::<Result<_, _>>()?;
        let why = facts.join("; ");
        Ok::<_, Refusal>(Choice { words, surfaces, why, not_proved: Vec::new() })
    };
    let (narrow, wide) = (WordClass::NARROW, WordClass::WIDE);
    let asked = scene.machine.words;
    if !scene.formats.is_empty() {
        let words = match asked {
            WordSize::Narrow => narrow,
            WordSize::Auto if proved(narrow, Proof::holds_well).is_ok() => narrow,
            WordSize::Auto | WordSize::Wide => wide,
        };
        return of_sweep(scene, geometry, words, of(words));
    }
    let asked_for = |choice, why: &str| Choice { why: why.to_owned(), ..choice };
    Ok(match asked {
        WordSize::Narrow => {
            let choice = proved(narrow, Proof::holds).map_err(|refusal| PlanError::Range {
                field: "machine.words",
                reason: format!("32-bit words cannot be proved: {}", refusal.reason),
                remedy: "use words = \"auto\"",
            })?;
            asked_for(choice, "asked for, and proved")
        }
        WordSize::Wide => asked_for(proved(wide, Proof::holds)?, "asked for"),
        WordSize::Auto => match proved(narrow, Proof::holds_well) {
            Ok(choice) => choice,
            Err(refusal) => {
                let why = format!("32 bits are not enough: {}", refusal.reason);
                Choice { why, ..proved(wide, Proof::holds)? }
            }
        },
    })
}

/// The scene's own formats, beside stock registers of a word size.
fn of_sweep(
    scene: &Scene,
    geometry: &Geometry,
    words: WordClass,
    surfaces: Vec<SurfacePlan>,
) -> Result<Choice, PlanError> {
    let formats = Formats { words, requests: &scene.formats };
    let (mut facts, mut not_proved) = (Vec::new(), Vec::new());
    for surface in &surfaces {
        let planned = surface.planned();
        planned.check_counters()?;
        let proof = planned.proof(geometry, &formats);
        not_proved.extend(proof.not_proved(&formats));
        facts.push(proof.facts);
    }
    Ok(Choice { words, surfaces, why: facts.join("; "), not_proved })
}
