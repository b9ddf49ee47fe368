//! `terraline-hdl multipliers`.

use terraline::cli::{Stop, report};

use crate::netlist::multipliers::{foreign, foreign_mapped};
use crate::netlist::{DESIGNS, Target, yosys};

/// Says of every design what multiplies in its netlist: nothing should.
pub fn run(map: bool) -> Result<(), Stop> {
    let files = yosys::sources().map_err(Stop::BadInput)?;
    let mut is_clean = true;
    let mut say = |name: &str, netlist: &str, cells: &yosys::Cells, found: Vec<(String, u64)>| {
        is_clean &= found.is_empty();
        let all: u64 = cells.count.values().sum();
        let found: Vec<String> = found.iter().map(|(kind, n)| format!("{n} {kind}")).collect();
        let verdict = if found.is_empty() { "none multiplies".into() } else { found.join(", ") };
        report::print(&format!("{name}, {netlist}: {all} cells, {verdict}"));
    };
    for design in DESIGNS {
        for &wide in design.words() {
            let parameters = design.with_words(wide);
            let words = if wide == 1 { "wide, elaborated" } else { "narrow, elaborated" };
            let cells =
                yosys::elaborated(&files, design.top, &parameters).map_err(Stop::BadInput)?;
            say(design.name, words, &cells, foreign(&cells));
            if !map || wide == 1 {
                continue;
            }
            for target in Target::ALL {
                let cells = yosys::mapped(&files, design.top, &parameters, target)
                    .map_err(Stop::BadInput)?;
                say(design.name, target.name(), &cells, foreign_mapped(&cells, target));
            }
        }
    }
    if is_clean { Ok(()) } else { Err(Stop::Failure) }
}
