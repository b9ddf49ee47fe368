//! The command line of the package.

#[cfg(rtl)]
mod cosim;
mod multipliers;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use clap::{Parser, Subcommand};
use terraline::cli::{Stop, report};

use crate::coefficients::Part;
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
    #[cfg(rtl)]
    Cosim(Box<cosim::Cosim>),
    /// Draw a scene with the RTL and compare it with the emulator: left out, there is no Verilator.
    #[cfg(not(rtl))]
    Cosim {
        /// Whatever the command takes where it is built.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<String>,
    },
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
        #[arg(long, value_name = "SECONDS", default_value_t = 3600)]
        limit: u64,
    },
}

/// The generated files of `rtl/`, with their texts.
pub fn generated() -> Vec<(PathBuf, String)> {
    let file = |module: &str| {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("rtl").join(module).with_extension("sv")
    };
    let mut files = vec![(file("terraline_pkg"), package::package())];
    let banks = Part::ALL.iter();
    files.extend(banks.map(|&part| (file(part.module()), package::registers(part))));
    files
}

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        #[cfg(rtl)]
        Command::Cosim(command) => command.run(),
        #[cfg(not(rtl))]
        Command::Cosim { .. } => Err(Stop::BadInput(format!(
            "cosim is left out of this build: {}; then build anew",
            crate::missing().unwrap_or("no models of the RTL")
        ))),
        Command::Generate => generate(),
        Command::Multipliers { map } => multipliers::run(map),
        Command::Sizes { only, limit } => {
            sizes::run(only.as_deref(), Duration::from_secs(limit)).map_err(Stop::BadInput)
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Stop::Failure) => ExitCode::FAILURE,
        Err(Stop::BadInput(message)) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

fn generate() -> Result<(), Stop> {
    for (path, text) in generated() {
        std::fs::write(&path, text)
            .map_err(|error| Stop::BadInput(format!("{}: {error}", path.display())))?;
        report::print(&path.display().to_string());
    }
    Ok(())
}
