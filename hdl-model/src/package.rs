//! What the RTL takes from the emulator's tables: the package of constants and the coefficient
//! registers, generated as SystemVerilog.

use std::fmt::Write as _;

use terraline::plan::WordClass;
use terraline::setup::table;
use terraline::unit::coefficient::Coefficient;
use terraline::unit::description::SHADER_TIMING;
use terraline::unit::{divider, interpolator, kernel_rom, projector, stepper};
use terraline::word::Register;

use crate::coefficients::{self, Bits, Part, bits};

const HEAD: &str = "// Generated from the register table (src/setup/table.rs) and the lists of \
                    coefficients\n// (src/unit/coefficient.rs) and cycles (src/unit) by `cargo run \
                    -p terraline-hdl -- generate`; a\n// test compares.\n";

/// rtl/terraline_pkg.sv: widths, binary points, latencies and depths.
pub fn package() -> String {
    let mut out = format!("{HEAD}package terraline_pkg;\n");
    for class in [WordClass::NARROW, WordClass::WIDE] {
        let name = class.name.to_uppercase();
        let _ = write!(out, "\n  // Words of {} bits\n", class.width);
        let mut constant = |what: &str, value: u32| {
            let _ = writeln!(out, "  localparam int {name}_{what} = {value};");
        };
        constant("WIDTH", class.width);
        for (what, register) in [("VIEW_POINT", Register::ViewX), ("POINT", Register::GroundX)] {
            constant(what, class.fixed(register).point);
        }
    }
    out.push_str("\n  // Registers: format with narrow and with wide words\n");
    for &register in Register::ALL {
        let row = table::row(register);
        let _ = writeln!(
            out,
            "  //   {:<13} {:<7} {:<7} {}, {}",
            register.name(),
            WordClass::NARROW.fixed(register).to_string(),
            WordClass::WIDE.fixed(register).to_string(),
            row.meaning,
            row.measure,
        );
    }
    out.push_str("\n  // Cycles (docs/cycles.md)\n");
    for (name, value, what) in [
        ("PROJECTOR_LATENCY", projector::TIMING.latency, "L of the projector"),
        ("PROJECTOR_DEPTH", projector::TIMING.depth, "D of the projector"),
        ("DIVIDER_ENDS", divider::ENDS, "stages of the divider besides one per quotient bit"),
        (
            "STEPPER_DEPTH",
            stepper::timing(1, false, 1).depth,
            "D of the stepper and of the serial divider",
        ),
        (
            "RAY_START",
            stepper::RAY_START,
            "cycles to turn a view vector into a step and to begin with it",
        ),
        ("RAY_END", stepper::RAY_END, "cycles of a hit besides its bisection steps"),
        ("KERNEL_LATENCY", kernel_rom::LATENCY, "cycles of kernel ROM and hat weight"),
        ("LERP_LATENCY", interpolator::LERP_LATENCY, "stages of a height behind nodes and weights"),
        ("SLOPE_LATENCY", interpolator::SLOPE_LATENCY, "stages of the slopes' factors"),
        ("SHADER_LATENCY", SHADER_TIMING.latency, "L of the shader"),
        ("SHADER_DEPTH", SHADER_TIMING.depth, "D of the shader"),
    ] {
        let _ = writeln!(out, "  localparam int {name} = {value};  // {what}");
    }
    out.push_str("\n  // Addresses of coefficients\n");
    for (address, coefficient) in coefficients::all().enumerate() {
        let _ = writeln!(
            out,
            "  localparam int ADDRESS_{} = {address};",
            coefficient.name().to_uppercase()
        );
    }
    out.push_str("endpackage\n");
    out
}

/// The bank of a part's coefficients, as a file of `rtl/`: one register per coefficient.
pub fn registers(part: Part) -> String {
    let mut out = format!(
        "{HEAD}\n// The coefficients of {}. Loaded before `start`, one per cycle.\n//\n\
         // Never reset, never changed within a frame.\nmodule {} #(\n    \
         parameter int WIDE = 0  // words of 64 bits, not 32\n) (\n    \
         input logic clock,\n    \
         input logic load,  // take `load_data` at this edge\n    \
         input logic [15:0] load_address,  // terraline_pkg::ADDRESS_..., perhaps of another bank\n    \
         input logic [(WIDE == 1 ? 64 : 32)-1:0] load_data,  // in the low bits\n",
        part.about(),
        part.module(),
    );
    let last = part.coefficients().last();
    for coefficient in part.coefficients() {
        let comma = if Some(coefficient) == last { "" } else { "," };
        let _ = writeln!(
            out,
            "    output logic {}{}{comma}  // {}",
            range(coefficient),
            coefficient.name(),
            coefficient.meaning()
        );
    }
    out.push_str(");\n");
    if part.coefficients().any(|coefficient| bits(coefficient) == Bits::Cell) {
        out.push_str("  localparam int CELL = WIDE == 1 ? 26 : 12;\n\n");
    }
    out.push_str(
        "  always_ff @(posedge clock) begin\n    if (load) begin\n      case (load_address)\n",
    );
    for coefficient in part.coefficients() {
        let bits = match bits(coefficient) {
            Bits::Word => String::new(),
            Bits::Cell => "[CELL-1:0]".into(),
            Bits::Unsigned(1) => "[0]".into(),
            Bits::Unsigned(bits) | Bits::Signed(bits) => format!("[{}:0]", bits - 1),
        };
        let _ = writeln!(
            out,
            "        16'(terraline_pkg::ADDRESS_{}): {} <= load_data{bits};",
            coefficient.name().to_uppercase(),
            coefficient.name()
        );
    }
    out.push_str("        default: ;\n      endcase\n    end\n  end\nendmodule\n");
    out
}

fn range(coefficient: Coefficient) -> String {
    match bits(coefficient) {
        Bits::Word => "signed [(WIDE == 1 ? 64 : 32)-1:0] ".into(),
        Bits::Cell => "[(WIDE == 1 ? 26 : 12)-1:0] ".into(),
        Bits::Unsigned(1) => String::new(),
        Bits::Unsigned(bits) => format!("[{}:0] ", bits - 1),
        Bits::Signed(bits) => format!("signed [{}:0] ", bits - 1),
    }
}
