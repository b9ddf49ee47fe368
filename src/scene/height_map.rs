//! A grid of height samples, row 0 north. [`source`] reads it from files of several formats.

mod ascii;
mod error;
pub(super) mod file;
mod found;
pub mod georeference;
mod geotiff;
mod hgt;
mod map;
mod png;
pub mod source;

pub use error::{MAX_NODES, MAX_SIDE, MapError};
pub use found::{Encoding, HeightFile, Storage};
pub use georeference::{Coordinates, Georeference};
pub use map::HeightMap;
