//! No netlist has a multiplier, a divider or a DSP block, and the check can fail.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use terraline_hdl::netlist::DESIGNS;
use terraline_hdl::netlist::multipliers::{foreign, foreign_mapped};
use terraline_hdl::netlist::yosys::{self, Target};
use terraline_hdl::skipped_without;

fn fixture(name: &str) -> [PathBuf; 1] {
    [Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name)]
}

fn names(found: &[(String, u64)]) -> Vec<&str> {
    found.iter().map(|(kind, _)| kind.as_str()).collect()
}

#[test]
fn a_multiplication_is_found() {
    if skipped_without(yosys::missing()) {
        return;
    }
    let files = fixture("multiplies.sv");
    let cells = yosys::elaborated(&files, "multiplies", &[]).expect("a netlist");
    assert_eq!(names(&foreign(&cells)), ["$mul"]);
    for (target, block) in [(Target::Ice40, "SB_MAC16"), (Target::Ecp5, "MULT18X18D")] {
        let cells = yosys::mapped(&files, "multiplies", &[], target).expect("a netlist");
        let found = foreign_mapped(&cells, target);
        assert!(names(&found).contains(&block), "{target:?}: {found:?}");
    }
}

#[test]
fn a_division_is_found() {
    if skipped_without(yosys::missing()) {
        return;
    }
    let cells = yosys::elaborated(&fixture("divides.sv"), "divides", &[]).expect("a netlist");
    assert_eq!(names(&foreign(&cells)), ["$div", "$mod"]);
}

#[test]
fn no_module_multiplies() {
    if skipped_without(yosys::missing()) {
        return;
    }
    let files = yosys::sources().expect("sources");
    let mut seen = BTreeSet::new();
    for design in DESIGNS {
        for &wide in design.words() {
            let cells =
                yosys::elaborated(&files, design.top, &design.with_words(wide)).expect("a netlist");
            assert_eq!(foreign(&cells), [], "{} with WIDE={wide}", design.name);
            seen.extend(cells.modules);
        }
    }
    // No module is left out.
    for file in &files {
        let module = file.file_stem().expect("a file name").to_string_lossy();
        assert!(module == "terraline_pkg" || seen.contains(&*module), "{module} is in no netlist");
    }
}

#[test]
fn no_dsp_block_after_mapping() {
    if skipped_without(yosys::missing()) {
        return;
    }
    let files = yosys::sources().expect("sources");
    for design in DESIGNS.iter().filter(|design| design.is_quick) {
        for target in Target::ALL {
            let cells = yosys::mapped(&files, design.top, &design.with_words(0), target)
                .expect("a netlist");
            assert_eq!(foreign_mapped(&cells, target), [], "{} on {target:?}", design.name);
        }
    }
}
