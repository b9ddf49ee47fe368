//! The processor in SystemVerilog (`rtl/`), run beside the emulator.
//!
//! `build.rs` has Verilator make programs of the modules; [`Model`] drives one. Where Verilator is
//! missing there are no models, and everything that needs one says so.

use std::io::Write as _;

pub mod cli;
pub mod coefficients;
#[cfg(rtl)]
pub mod cosim;
#[cfg(rtl)]
mod ffi;
#[cfg(rtl)]
mod memory;
#[cfg(rtl)]
mod model;
pub mod netlist;
pub mod package;
#[cfg(rtl)]
pub mod rtl;
pub mod sizes;
#[cfg(rtl)]
mod waves;

#[cfg(rtl)]
pub use model::{Model, Port};

/// Why there are no models of the RTL; `None` where there are.
pub fn missing() -> Option<&'static str> {
    option_env!("RTL_MISSING")
}

/// For tests that need a model: whether to skip them, said loudly.
///
/// # Panics
/// If `REQUIRE_RTL=1`.
pub fn skipped() -> bool {
    skipped_without(missing().map(str::to_owned))
}

/// For tests that need a tool: whether to skip them because it is missing, said loudly.
///
/// # Panics
/// If it is missing with `REQUIRE_RTL=1`.
pub fn skipped_without(missing: Option<String>) -> bool {
    let Some(why) = missing else { return false };
    let required = std::env::var("REQUIRE_RTL").is_ok_and(|value| value == "1");
    assert!(!required, "REQUIRE_RTL=1, but {why}");
    // Past the test harness, which keeps what passing tests print to itself.
    let _ = writeln!(std::io::stderr(), "SKIPPED, not tested: {why}");
    true
}
