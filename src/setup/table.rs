//! The register table: what each register holds, in which unit, by which equation, and how far it
//! can be from the exact value. The tests generate docs/registers.md from it.

use crate::word::Register;

/// One row of the table. The hardware's package and docs/registers.md are made of it.
#[cfg_attr(not(feature = "parts"), expect(dead_code, reason = "only parts read all of it"))]
#[derive(Clone, Copy, Debug)]
pub struct RegisterRow {
    /// The register that the row is about.
    pub register: Register,
    /// Unit that drives it.
    pub unit: &'static str,
    /// What it holds, in half a sentence.
    pub meaning: &'static str,
    /// Physical unit of its values.
    pub measure: &'static str,
    /// Numbers of its equations in docs/mathematics.md.
    pub equations: &'static str,
    /// Bound of its error against the exact value, ulp the register's last bit.
    pub bound: &'static str,
}

/// The row of a register.
pub fn row(register: Register) -> RegisterRow {
    use Register as R;
    let new = |unit, meaning, measure, equations, bound| RegisterRow {
        register,
        unit,
        meaning,
        measure,
        equations,
        bound,
    };
    const VIEW: &str = "(1 + line + column)/2 ulp (29)";
    match register {
        R::ViewX => new("projector", "view vector along x", "cells × 2^e", "5, 6", VIEW),
        R::ViewY => new("projector", "view vector along y", "height units × 2^e", "5, 6", VIEW),
        R::ViewZ => new("projector", "view vector along z", "cells × 2^e", "5, 6", VIEW),
        R::Denominator => {
            new("projector", "s n·V / abs(F), positive towards the plane", "2^d", "8, 9", VIEW)
        }
        R::GroundX => new("divider, stepper", "position, x", "cells", "9, 19", "(30), (31)"),
        R::GroundZ => new("divider, stepper", "position, z", "cells", "9, 19", "(30), (31)"),
        R::DGroundX => new("stepper", "step, x", "cells", "20", "½ ulp + (29) shifted"),
        R::DGroundZ => new("stepper", "step, z", "cells", "20", "½ ulp + (29) shifted"),
        R::RayY => new("stepper", "height of the ray", "height units", "19", "(31)"),
        R::DRayY => new("stepper", "step, y", "height units", "20", "½ ulp + (29) shifted"),
        R::Node => new("height memory", "node of the map", "height units", "14", "½ ulp"),
        R::Surface => new(
            "interpolator",
            "surface height",
            "height units",
            "14, 17",
            "nodes and 2 lerps: 2 ulp, plus the weights' share (13, 35)",
        ),
        R::SlopeX => new("interpolator", "−∂y/∂x", "1", "15, 18", "the weights' share (13, 35)"),
        R::SlopeZ => new("interpolator", "−∂y/∂z", "1", "15, 18", "the weights' share (13, 35)"),
        R::Weight => new(
            "kernel ROM",
            "kernel weight",
            "1",
            "12, 16",
            "(13); with deformation 2 (3/2 − a) ulp + a times the table's share (35)",
        ),
        R::WeightSlope => new(
            "kernel ROM",
            "its derivative",
            "1/cell",
            "12, 16",
            "(13); with deformation 2 (1 − a/2) ulp + a times the table's share (35)",
        ),
        R::Normal => new("light", "normal, scaled below one", "1", "23", "½ ulp"),
        R::Shade => new(
            "light, checker",
            "ambient plus diffuse light; contrast",
            "1",
            "24, 25, 27",
            "2^-10 + 6 ulp (24)",
        ),
        R::Ramp => new(
            "ramp",
            "place on the ramp",
            "segments",
            "26",
            "segments + 1 ulp, plus the height's",
        ),
        R::Channel => new("ramp, mixer, checker", "colour channel", "0..=255", "26, 27", "1 level"),
    }
}
