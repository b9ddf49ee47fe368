//! Without Verilator the tests of the RTL are left out; this one says so.

#[test]
fn the_rtl_is_tested_or_said_to_be_skipped() {
    assert_eq!(terraline_hdl::skipped(), cfg!(not(rtl)));
}
