//! The claim that the machine multiplies by additions only, checked on netlists.
//!
//! A netlist may have cells of the lists below and no other: a multiplication, a division, a power,
//! a DSP block or a cell that nobody thought of are all found.

use super::yosys::{Cells, Target};

/// Cells of an elaborated netlist: additions, comparisons, logic, shifts, choices, registers and
/// memories.
const ELABORATED: &[&str] = &[
    "$add",
    "$sub",
    "$neg",
    "$pos", // additions
    "$eq",
    "$ne",
    "$lt",
    "$le",
    "$gt",
    "$ge", // comparisons
    "$and",
    "$or",
    "$xor",
    "$xnor",
    "$not", // logic, bit by bit
    "$logic_and",
    "$logic_or",
    "$logic_not", // logic of words
    "$reduce_and",
    "$reduce_or",
    "$reduce_xor",
    "$reduce_xnor",
    "$reduce_bool",
    "$shl",
    "$shr",
    "$sshl",
    "$sshr",
    "$shift",
    "$shiftx", // shifts
    "$mux",
    "$pmux", // choices
    "$dff",
    "$dffe",
    "$sdff",
    "$sdffe",
    "$sdffce", // registers
    "$mem_v2",
    "$memrd",
    "$memrd_v2",
    "$memwr_v2", // memories
];

/// Cells of iCE40 besides its registers: look-up tables, carries, block RAM.
const ICE40: &[&str] = &["SB_LUT4", "SB_CARRY", "SB_RAM40_4K"];

/// Cells of ECP5: look-up tables, carries, choices, registers, block and distributed RAM.
const ECP5: &[&str] =
    &["LUT4", "CCU2C", "PFUMX", "L6MUX21", "TRELLIS_FF", "DP16KD", "TRELLIS_DPR16X4"];

/// Cells that an elaborated netlist must not have, with their number.
pub fn foreign(cells: &Cells) -> Vec<(String, u64)> {
    others(cells, |kind| ELABORATED.contains(&kind))
}

/// The same for a mapped netlist.
pub fn foreign_mapped(cells: &Cells, target: Target) -> Vec<(String, u64)> {
    others(cells, |kind| match target {
        Target::Ice40 => ICE40.contains(&kind) || kind.starts_with("SB_DFF"),
        Target::Ecp5 => ECP5.contains(&kind),
    })
}

fn others(cells: &Cells, allowed: impl Fn(&str) -> bool) -> Vec<(String, u64)> {
    let count = cells.count.iter();
    count.filter(|(kind, _)| !allowed(kind)).map(|(kind, n)| (kind.clone(), *n)).collect()
}
