//! A grid of height samples, row 0 north. [`source`] reads it from files of several formats.

mod archive;
mod ascii;
mod encoding;
mod epsg;
mod error;
pub(super) mod file;
mod found;
pub mod georeference;
mod geotiff;
mod hgt;
mod interpretation;
mod map;
mod marks;
mod memory;
pub mod mosaic;
mod png;
pub mod projection;
pub mod source;
pub mod unit;
mod wkt;

pub use encoding::Encoding;
pub use error::{MAX_NODES, MAX_SIDE, MapError};
pub use found::{HeightFile, Storage};
pub use georeference::{Coordinates, Georeference};
pub use interpretation::{CoordinateUnit, Interpretation, Thinning, length};
pub use map::HeightMap;
#[cfg(feature = "cli")]
pub(crate) use memory::bytes;
pub(in crate::scene) use memory::{available, in_words, nodes_in, refuse_too_large, taken};
