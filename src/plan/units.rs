//! The plan in words: every unit, fitted or not, why, at which widths, and what leaving it out
//! saves.

use serde::Serialize;

use super::fitted::UnitFit;
use super::{Plan, SurfacePlan};
use crate::word::{Register, World};

/// One unit of the plan.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnitPlan {
    /// Name of the unit.
    pub name: &'static str,
    /// Whether the machine has it.
    pub fitted: bool,
    /// Why it is fitted or left out.
    pub why: String,
    /// Formats of its registers, name and format.
    pub widths: Vec<(String, String)>,
    /// What leaving it out saves, where it is left out.
    pub saves: Option<String>,
}

/// All units of a plan in a number world, surface by surface.
pub fn units<W: World>(plan: &Plan, world: &W) -> Vec<UnitPlan> {
    let width = |register: &Register| {
        let format =
            world.fixed(*register).map_or_else(|| "f64".to_owned(), |format| format.to_string());
        (register.name().to_owned(), format)
    };
    let unit = |UnitFit { name, fit, registers, saves }: UnitFit| {
        let registers = if fit.fitted { registers } else { &[] };
        UnitPlan {
            name,
            fitted: fit.fitted,
            why: fit.why.into_owned(),
            widths: registers.iter().map(width).collect(),
            saves: (!fit.fitted).then(|| saves.to_owned()),
        }
    };
    let of_surface = |surface: &SurfacePlan| {
        let mut units = surface.planned().units(&plan.geometry, plan.full);
        // One surface has none, and nothing to say of it.
        units.extend((plan.surfaces.len() > 1).then(UnitFit::depth));
        units
    };
    plan.surfaces.iter().flat_map(of_surface).map(unit).collect()
}
