//! One design on one device: synthesis by itself, then place and route in a shell.

use std::time::Duration;

use super::route::{self, Routed};
use super::{Job, Row, shell};
use crate::netlist::multipliers::foreign_mapped;
use crate::netlist::yosys::{self, Cells, Scratch, Target};

/// Look-up tables and blocks of RAM of the device that is measured on: iCE40-HX8K, ECP5-85K.
pub fn capacity(target: Target) -> (u64, u64) {
    match target {
        Target::Ice40 => (7680, 32),
        Target::Ecp5 => (83640, 208),
    }
}

/// Measures a design.
///
/// # Errors
/// If a tool is missing or refuses, or the netlist has a cell that multiplies.
pub fn measure(job: &Job, limit: Duration) -> Result<Row, String> {
    let Job { design, target, .. } = *job;
    let program = route::program(target)?;
    let mut parameters = design.with_words(0);
    parameters.extend(job.parameters);
    let scratch = Scratch::new()?;
    let synthesis = target.synthesis();
    let script = yosys::read(&yosys::sources()?, design.top, &parameters)
        + &format!(
            "{synthesis} -top {}\nrename -top mapped\nwrite_json unit.json\n\
             write_rtlil unit.il\n",
            design.top
        );
    yosys::run(&script, &scratch)?;
    let netlist = scratch.json("unit.json")?;
    let cells = yosys::cells(&netlist)?;
    let foreign = foreign_mapped(&cells, target);
    if !foreign.is_empty() {
        return Err(format!("{} on {}: cells of {foreign:?}", design.name, target.name()));
    }
    let mut row = Row {
        design: design.name.into(),
        target: target.name().into(),
        parameters: parameters
            .iter()
            .map(|(name, value)| format!("{name}={value}"))
            .collect::<Vec<_>>()
            .join(" "),
        tools: format!(
            "{}; {}",
            yosys::version("yosys", "-V")?,
            yosys::version(program, "--version")?
        ),
        luts: luts(&cells, target),
        flip_flops: cells.beginning("SB_DFF") + cells.of(&["TRELLIS_FF"]),
        block_ram: cells.of(&["SB_RAM40_4K", "DP16KD"]),
        cells: None,
        clock_mhz: None,
        remark: String::new(),
    };
    let (most_luts, most_ram) = capacity(target);
    if row.luts > most_luts || row.flip_flops > most_luts || row.block_ram > most_ram {
        row.remark = "does not fit".into();
        return Ok(row);
    }
    let text = shell::around("mapped", &netlist)?;
    std::fs::write(scratch.file("shell.v"), text).map_err(|error| error.to_string())?;
    // The unit's cells stay as they are; only the shell's are mapped.
    let script = format!(
        "read_rtlil unit.il\nread_verilog shell.v\nhierarchy -top shell\nproc\nflatten\n\
         {synthesis} -top shell -run coarse:json\nopt_clean\nwrite_json shell.json\n"
    );
    yosys::run(&script, &scratch)?;
    match route::route(target, &scratch, limit)? {
        Routed::Done { clock_mhz, cells, longest_path } => {
            row.clock_mhz = Some(clock_mhz);
            row.cells = Some(cells);
            row.remark = longest_path;
        }
        Routed::Not(why) => row.remark = why,
    }
    Ok(row)
}

/// Look-up tables of four inputs. A carry of ECP5 takes two of them, 16×4 bits of distributed RAM
/// six; a carry of iCE40 stands beside one.
fn luts(cells: &Cells, target: Target) -> u64 {
    match target {
        Target::Ice40 => cells.of(&["SB_LUT4"]),
        Target::Ecp5 => {
            cells.of(&["LUT4"]) + 2 * cells.of(&["CCU2C"]) + 6 * cells.of(&["TRELLIS_DPR16X4"])
        }
    }
}
