//! The command line of the package.

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use clap::{Parser, Subcommand};

use crate::netlist::multipliers::{foreign, foreign_mapped};
use crate::netlist::{DESIGNS, Target, yosys};
use crate::{package, sizes};

/// The processor in SystemVerilog, and its comparison with the emulator.
#[derive(Debug, Parser)]
#[command(name = "terraline-hdl", version, about, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Write the generated files of rtl/ anew.
    Generate,
    /// Check that no netlist multiplies or divides, other than by additions; needs Yosys.
    Multipliers {
        /// Map every design to both devices as well, and look for DSP blocks; takes many minutes.
        #[arg(long)]
        map: bool,
    },
    /// Measure size and clock on two devices, and write them into hdl-model/README.md; needs Yosys
    /// and nextpnr.
    Sizes {
        /// Measure but the design of this name, or `frames`; the others stay as they are.
        #[arg(long, value_name = "NAME")]
        only: Option<String>,
        /// Time limit of each place and route, seconds.
        #[arg(long, value_name = "SECONDS", default_value_t = 900)]
        limit: u64,
    },
}

/// The generated files of `rtl/`, with their texts.
pub fn generated() -> [(&'static str, String); 2] {
    [("rtl/terraline_pkg.sv", package::package()), ("rtl/registers.sv", package::registers())]
}

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Generate => generate(),
        Command::Multipliers { map } => multipliers(map),
        Command::Sizes { only, limit } => {
            sizes::run(only.as_deref(), Duration::from_secs(limit)).map(|()| ExitCode::SUCCESS)
        }
    };
    match result {
        Ok(code) => code,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

fn generate() -> Result<ExitCode, String> {
    for (file, text) in generated() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
        std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
        println!("{}", path.display());
    }
    Ok(ExitCode::SUCCESS)
}

fn multipliers(map: bool) -> Result<ExitCode, String> {
    let files = yosys::sources()?;
    let mut is_clean = true;
    let mut report =
        |name: &str, netlist: &str, cells: &yosys::Cells, found: Vec<(String, u64)>| {
            is_clean &= found.is_empty();
            let all: u64 = cells.count.values().sum();
            let found: Vec<String> = found.iter().map(|(kind, n)| format!("{n} {kind}")).collect();
            let verdict =
                if found.is_empty() { "none multiplies".into() } else { found.join(", ") };
            println!("{name}, {netlist}: {all} cells, {verdict}");
        };
    for design in DESIGNS {
        for &wide in design.words() {
            let parameters = design.with_words(wide);
            let words = if wide == 1 { "wide, elaborated" } else { "narrow, elaborated" };
            let cells = yosys::elaborated(&files, design.top, &parameters)?;
            report(design.name, words, &cells, foreign(&cells));
            if !map || wide == 1 {
                continue;
            }
            for target in Target::ALL {
                let cells = yosys::mapped(&files, design.top, &parameters, target)?;
                report(design.name, target.name(), &cells, foreign_mapped(&cells, target));
            }
        }
    }
    Ok(if is_clean { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
