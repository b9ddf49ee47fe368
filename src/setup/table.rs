//! The register table: what each register holds, in which unit, by which equation, and how far it
//! can be from the exact value. `docs/registers.md` is generated from it.

use std::fmt::Write as _;

use crate::plan::WordClass;
use crate::unit::description::SHADER_TIMING;
use crate::unit::divider::ENDS as DIVIDER_ENDS;
use crate::unit::interpolator::{LERP_LATENCY, SLOPE_LATENCY};
use crate::unit::kernel_rom::LATENCY as KERNEL_LATENCY;
use crate::unit::stepper::{RAY_END, RAY_START};
use crate::word::Register;

/// One row of the table.
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
            "nodes and 2 lerps: 2 ulp, plus the table's share (13)",
        ),
        R::SlopeX => new("interpolator", "−∂y/∂x", "1", "15, 18", "table's share (13)"),
        R::SlopeZ => new("interpolator", "−∂y/∂z", "1", "15, 18", "table's share (13)"),
        R::Weight => new("kernel ROM", "kernel weight", "1", "12, 16", "½ ulp + (13)"),
        R::WeightSlope => new("kernel ROM", "its derivative", "1/cell", "12, 16", "½ ulp + (13)"),
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

/// Text of docs/registers.md.
pub fn markdown() -> String {
    let mut out = String::from(
        "# Registers\n\n\
         Generated from the register table (`src/setup/table.rs`); a test compares the two.\n\n\
         Formats are written Q*i.f*: *i* bits before the point, sign included, *f* after it. \
         Numbers in parentheses are equations of [mathematics.md](mathematics.md). A register \
         named under *follows* meets its leader in an adder and always has its format; \
         `[format]` sets the leader. Exponents e and d are powers of two of the set-up that bring \
         the largest value on the screen into [½, 1).\n\n\
         | register | class | unit | holds | measure | narrow | wide | follows | equations | error bound |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
    );
    for &register in Register::ALL {
        let e = row(register);
        let _ = writeln!(
            out,
            "| `{}` | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            register,
            register.class().name(),
            e.unit,
            e.meaning,
            e.measure,
            WordClass::NARROW.fixed(register),
            WordClass::WIDE.fixed(register),
            register.follows().map_or_else(String::new, |leader| format!("`{leader}`")),
            e.equations,
            e.bound
        );
    }
    let _ = write!(
        out,
        "\n## Latencies and queues\n\n\
         Cycles; M is `machine.memory_latency`, *bits* the quotient bits of the plan. A unit holds \
         *depth* items, pipeline and queue together (equation 28).\n\n\
         | unit | work on an item | latency | depth |\n|---|---|---|---|\n\
         | projector | 1 | 1 | 2 |\n\
         | divider, array | 1 | bits + {DIVIDER_ENDS} | bits + {} |\n\
         | divider, serial | bits + {DIVIDER_ENDS} | 1 | 2 |\n\
         | stepper | {RAY_START} + skip_tests·(1 + M) + samples·R + bursts·(N + {LERP_LATENCY}) + \
         bisection_steps·(R + N + {LERP_LATENCY}) + hits·({RAY_END} + H) | 1 | 2 |\n\
         | interpolator | R | N + {} | N + {} |\n\
         | shader, checker | 1 | {} | {} |\n\
         | frame | 1 | 0 | 1 |\n\n\
         R, reads of the height memory per interpolation: 1 cycle for 2×2 nodes, 4 for 3×3. A \
         burst is a run of up to 2^k samples streamed through the interpolator. H is 2R + N + \
         {LERP_LATENCY} on a map with holes, else 0. N is the larger of M and {KERNEL_LATENCY}, the cycles \
         of kernel ROM and hat weight.\n",
        DIVIDER_ENDS + 1,
        LERP_LATENCY + SLOPE_LATENCY,
        LERP_LATENCY + SLOPE_LATENCY + 1,
        SHADER_TIMING.latency,
        SHADER_TIMING.depth,
    );
    out
}
