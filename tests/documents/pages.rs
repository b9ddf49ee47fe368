//! Pages of docs/ as the program's tables say them.

use std::fmt::Write as _;

use terraline::frame::{BufferRow, Giver, TABLE};
use terraline::plan::WordClass;
use terraline::scene::keys::{Key, Section, sections};
use terraline::setup::table::row;
use terraline::unit::description::SHADER_TIMING;
use terraline::unit::divider::ENDS as DIVIDER_ENDS;
use terraline::unit::interpolator::{LERP_LATENCY, SLOPE_LATENCY};
use terraline::unit::kernel_rom::LATENCY as KERNEL_LATENCY;
use terraline::unit::stepper::{RAY_END, RAY_START};
use terraline::word::Register;

/// Text of docs/registers.md.
pub fn registers() -> String {
    let mut out = String::from(
        "# Registers\n\n\
         Generated from the register table (`src/setup/table.rs`); a test compares the two.\n\n\
         Formats are written Q*i.f*: *i* bits before the point, sign included, *f* after it. \
         Numbers in parentheses are equations of [mathematics.md](mathematics.md). A register \
         named under *follows* meets its leader in an adder and always has its format; \
         `[format]` sets the leader. A rounding of `[format]` acts on `surface` and slopes (by `node`), \
         on `weight` where positions have more bits, and on all of class tone; other registers are \
         loaded to nearest and never rounded, or as the algorithm says, and take none. Exponents e and d are powers of two of the set-up that bring \
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

/// Text of docs/buffers.md.
pub fn buffers() -> String {
    let mut out = String::from(
        "# Buffers\n\n\
         `render --buffers OUT.npz` writes numpy arrays of shape [lines, columns], or [lines, columns, 3], from\n\
         the top left. Misses (sky, out of range) are NaN in floats and 0 in integers. Arrays with\n\
         `--with` are there only if it is given; `--with error,cycles` gives both, and measures every pixel.\n\
         This page is generated from the table in `src/frame/buffers.rs`.\n\n\
         | array | type | given by | holds |\n|---|---|---|---|\n",
    );
    for BufferRow { name, dtype, components, giver, holds } in &TABLE {
        let dtype = &dtype.name()[1..];
        let times = if *components > 1 { format!(" ×{components}") } else { String::new() };
        let giver = match giver {
            Giver::Engines => "all",
            Giver::Processor => "processor, real",
            Giver::Errors => "`--with error`: fast, processor",
            Giver::Clock => "`--with cycles`: processor",
        };
        let _ = writeln!(out, "| `{name}` | {dtype}{times} | {giver} | {holds} |");
    }
    out + "\nThe engines fast and processor write the same bits. Real and oracle write the same arrays in their\n\
           own numbers.\n"
}

/// Text of docs/scene-keys.md.
pub fn scene_keys() -> String {
    let mut page = String::from(
        "# The keys of a scene file\n\n\
         Generated from the declarations in `src/scene/`. Lengths are in scene units, angles in\n\
         degrees; x is east, y up, z south. A key that is left out has its default; where none is\n\
         given here, the meaning says what counts. Unknown keys are errors.\n",
    );
    for Section { head, keys, .. } in sections() {
        // Writing to a string cannot fail.
        let _ = write!(
            page,
            "\n## {head}\n\n| key | default | values | meaning |\n|---|---|---|---|\n"
        );
        for Key { name, meaning, kind, default } in keys {
            let default = default.map_or_else(String::new, |default| format!("`{default}`"));
            let _ = writeln!(page, "| `{name}` | {default} | {} | {meaning} |", kind.expected());
        }
    }
    page
}
