//! The command line of the package.

use std::path::Path;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::package;

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
}

/// The generated files of `rtl/`, with their texts.
pub fn generated() -> [(&'static str, String); 2] {
    [("rtl/terraline_pkg.sv", package::package()), ("rtl/registers.sv", package::registers())]
}

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Generate => generate(),
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
