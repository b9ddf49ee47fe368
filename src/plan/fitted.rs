//! Whether a unit is fitted, and why: said once, where it is decided.

use std::borrow::Cow;

use super::geometry::Geometry;
use crate::word::Register;

/// Whether a machine has a unit, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fit {
    /// Whether it is fitted.
    pub fitted: bool,
    /// Why it is fitted or left out, half a sentence.
    pub why: Cow<'static, str>,
}

impl Fit {
    /// A unit that every machine of its kind has.
    pub(super) fn always(why: impl Into<Cow<'static, str>>) -> Self {
        Self { fitted: true, why: why.into() }
    }

    /// A unit that a pruned machine has where the scene needs it, and a full one in any case.
    pub(super) fn where_needed(
        needed: bool,
        full: bool,
        why: impl Into<Cow<'static, str>>,
    ) -> Self {
        let why = why.into();
        match (needed, full) {
            (false, true) => Self::always(format!("--full; not needed: {why}")),
            (fitted, _) => Self { fitted, why },
        }
    }
}

/// A unit of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitFit {
    /// Its name.
    pub name: &'static str,
    /// Whether it is fitted, and why.
    pub fit: Fit,
    /// The registers whose formats a plan shows.
    pub registers: &'static [Register],
    /// What leaving it out saves; empty where it never is.
    pub saves: &'static str,
}

impl UnitFit {
    /// The projector; a surface without steps has no use for one of its accumulators.
    pub(super) fn projector(geometry: &Geometry, steps: bool) -> Self {
        use Register::{ViewX, ViewY, ViewZ};
        let step = geometry.view.per_column;
        let still = [("view_x", step.x), ("view_y", step.y), ("view_z", step.z)];
        let still: Vec<_> =
            still.into_iter().filter_map(|(name, step)| (step == 0.0).then_some(name)).collect();
        let mut why = "every scene: view vector by additions".to_owned();
        if steps && !still.is_empty() {
            why += &format!("; no column adder for {} (increment zero)", still.join(", "));
        }
        let registers = &[ViewX, ViewY, ViewZ];
        Self { name: "projector", fit: Fit::always(why), registers, saves: "" }
    }

    /// The register by which several surfaces compete.
    pub(super) fn depth() -> Self {
        let fit = Fit::always("several surfaces: the nearest shows");
        Self { name: "depth", fit, registers: &[Register::Denominator], saves: "" }
    }

    /// The divider.
    pub(super) fn divider(fit: Fit) -> Self {
        use Register::{Denominator, GroundX, GroundZ};
        Self {
            name: "divider",
            fit,
            registers: &[Denominator, GroundX, GroundZ],
            saves: "one accumulator and two ratios per pixel",
        }
    }
}
