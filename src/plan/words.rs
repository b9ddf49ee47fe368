//! The word size of a scene: one for all of its surfaces, which is proved for each of them.

use super::PlanError;
use super::formats::Formats;
use super::geometry::Geometry;
use super::proof::{Proof, Refusal};
use super::surface::SurfacePlan;
use super::word_class::WordClass;
use crate::scene::{Scene, WordSize};

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
    let asked_for = |choice: Choice, why| Choice { why: format!("{why}: {}", choice.why), ..choice };
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
                let choice = proved(wide, Proof::holds)?;
                let why = format!("32 bits are not enough: {}; {}", refusal.reason, choice.why);
                Choice { why, ..choice }
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
