//! The `terraline-hdl` command.

fn main() -> std::process::ExitCode {
    terraline_hdl::cli::main()
}
