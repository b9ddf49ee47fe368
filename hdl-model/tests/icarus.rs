//! The other simulator: Icarus Verilog elaborates and compiles every form of the machine. (Yosys reads
//! them in `netlist.rs`, Verilator in `build.rs`.)

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The sources, the package first.
fn sources() -> Vec<PathBuf> {
    let rtl = Path::new(env!("CARGO_MANIFEST_DIR")).join("rtl");
    let mut found: Vec<PathBuf> = std::fs::read_dir(rtl)
        .expect("rtl/ is a folder")
        .map(|entry| entry.expect("a readable folder").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "sv"))
        .collect();
    found.sort_by_key(|path| (!path.ends_with("terraline_pkg.sv"), path.clone()));
    found
}

#[test]
fn every_machine_compiles() {
    if Command::new("iverilog").arg("-V").output().is_err() {
        let required = std::env::var("REQUIRE_RTL").is_ok_and(|value| value == "1");
        assert!(!required, "REQUIRE_RTL=1, but iverilog cannot be run; install it");
        let _ = writeln!(std::io::stderr(), "SKIPPED, not tested: iverilog cannot be run");
        return;
    }
    for wide in [0, 1] {
        for form in ["TERRAIN=0", "STRETCH=0", "STRETCH=1", "SERIAL=1"] {
            let output = Command::new("iverilog")
                .args(["-g2012", "-Wall", "-Wno-timescale", "-o"])
                .arg(if cfg!(windows) { "NUL" } else { "/dev/null" })
                .args(["-s", "terraline", &format!("-Pterraline.WIDE={wide}")])
                .arg(format!("-Pterraline.{form}"))
                .args(sources())
                .output()
                .expect("iverilog runs");
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "WIDE={wide} {form}:\n{said}");
        }
    }
}
