//! What tests share: the scenes and frames of the conformance suite, and values of scene keys.
#![allow(unused_imports, dead_code, reason = "each test file uses its own part")]

pub mod keys;

pub use terraline_conformance::frames::*;
pub use terraline_conformance::scenes::*;
pub use terraline_conformance::{formats, recipe};
