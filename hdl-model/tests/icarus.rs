//! The other simulator: Icarus Verilog elaborates and compiles every form of the machine. (Yosys reads
//! them in `netlist.rs`, Verilator in `build.rs`.)

use std::process::Command;

use terraline_hdl::netlist::yosys;
use terraline_hdl::skipped_without;

#[test]
fn every_machine_compiles() {
    if skipped_without(yosys::version("iverilog", "-V").err()) {
        return;
    }
    let sources = yosys::sources().expect("sources");
    for wide in [0, 1] {
        for form in ["TERRAIN=0", "STRETCH=0", "STRETCH=1", "SERIAL=1"] {
            let output = Command::new("iverilog")
                .args(["-g2012", "-Wall", "-Wno-timescale", "-o"])
                .arg(if cfg!(windows) { "NUL" } else { "/dev/null" })
                .args(["-s", "terraline", &format!("-Pterraline.WIDE={wide}")])
                .arg(format!("-Pterraline.{form}"))
                .args(&sources)
                .output()
                .expect("iverilog runs");
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "WIDE={wide} {form}:\n{said}");
        }
    }
}
