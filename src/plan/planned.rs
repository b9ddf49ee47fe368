//! What is asked of a planned surface, whatever its kind.

use super::fitted::UnitFit;
use super::formats::Formats;
use super::geometry::{Geometry, LinearScalar, LinearVector};
use super::proof::{Proof, Refusal};

/// The lines of sight as a surface's registers take them, and the plane of its ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// V along the axes of the registers, in their units.
    pub view: LinearVector,
    /// `G = n·V` (equation 8; thesis 2.15).
    pub g: LinearScalar,
    /// `F = d − n·r_h`, in the units of G.
    pub f: f64,
    /// The eye along the axes of the ratio, in their units.
    pub eye: [f64; 2],
    /// Quotients lie within ±2^range of these units.
    pub range: u32,
    /// Whether the ratio is taken: the divider is fitted.
    pub divides: bool,
    /// Whether rays are stepped, which takes the third component of V.
    pub steps: bool,
}

/// What a kind of surface answers.
pub(super) trait Planned {
    /// What the machine counts in and no format can mend.
    fn check_counters(&self) -> Result<(), Refusal>;

    /// Ranges and roundings in registers of these formats.
    fn proof(&self, geometry: &Geometry, formats: &Formats<'_>) -> Proof;

    /// Its projection.
    fn projection(&self, geometry: &Geometry) -> Projection;

    /// Its units in the order of the data flow, with those that it does without: idle in a full
    /// machine.
    fn units(&self, geometry: &Geometry, full: bool) -> Vec<UnitFit>;
}
