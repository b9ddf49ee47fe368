//! The `terraline` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    terraline::main()
}
