//! All keys of a scene file as their declarations say, for documents and tests.

pub use super::kind::{Key, Kind};
pub use super::tables::{Section, sections};
