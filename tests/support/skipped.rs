//! Tests that cannot run here say so where it is seen.

use std::io::Write as _;

/// Says that a test is skipped. The harness keeps what passing tests print, so this goes past it.
pub fn skipped(reason: &str) {
    let name = std::thread::current().name().unwrap_or("a test").to_owned();
    let _ = writeln!(std::io::stderr(), "SKIPPED {name}: {}", reason.trim());
}
