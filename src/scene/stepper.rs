//! `[stepper]`: how a ray walks over the map.

use super::error::SceneError;
use super::field::Field;
use super::kind::Kind;
use super::table::{table, words};
use super::value::{Value, quoted, word_or};
use super::words::Words;

table! {
    /// How a ray walks over the map.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct Stepper {
        /// Which samples of a ray are tested; the frame is the same.
        mode: StepperMode = StepperMode::Skipping, StepperMode::kind_without(&["thesis"]);
        /// k: the largest component of a step lies between 2^-k-1 and 2^-k cells.
        fineness: u32 = 3, Kind::Whole(0..=6);
        /// Bisection steps after the first hit; "footprint": until a step is at most 1/32 of the
        /// pixel's footprint, and less on maps with cliffs.
        halvings: Bisection = Bisection::Footprint,
            Kind::WordOr(vec!["footprint"], Box::new(Kind::Whole(0..=20)));
    }
}

words! {
    /// Which samples of a ray are tested.
    pub enum StepperMode {
        /// Jump over steps that the pyramid proves to be clear.
        Skipping = "skipping",
        /// Test every step.
        Plain = "plain",
    }
}

/// Number of bisection steps after the first hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bisection {
    /// Until a step is at most 1/32 of the pixel's footprint.
    Footprint,
    /// A fixed number, 0..=20.
    Fixed(u32),
}

impl Value for Bisection {
    fn read(field: &Field<'_>, kind: &Kind) -> Result<Self, SceneError> {
        word_or(field, kind, &[("footprint", Self::Footprint)], Self::Fixed)
    }

    fn write(&self, _: &Kind) -> String {
        match self {
            Self::Footprint => quoted("footprint"),
            Self::Fixed(count) => count.to_string(),
        }
    }
}
