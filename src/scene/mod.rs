//! What the user asked for: scene units, `f64`, degrees in the file and radians in here.
//!
//! Ground frame: x = column = east, z = row = south, y up, right-handed. Craft frame:
//! u forward, v up, w to the right.
//!
//! ```text
//!            -z north                    v up
//!               |                        |   u forward
//!   -x west ----+---- x east             |  /
//!               |                        | /
//!            z south                     +------ w right
//! ```
//!
//! Of registers nothing in this module knows more than their names, and nothing of engines. A
//! [`Scene`] that exists is complete and finite: every value has been checked by the reader in [`mod@file`]. Every key of the file is
//! declared once, as a field of the struct that it fills (`table.rs`).

pub mod builtin;
mod camera;
pub mod error;
mod exaggeration;
mod field;
pub mod file;
mod form;
mod format;
mod fractal;
pub mod framing;
mod hardware;
pub mod height_map;
mod kernel;
pub mod keys;
mod kind;
mod light;
mod load;
mod maps;
mod nodata;
mod plane;
pub mod screen;
pub mod set;
mod shown;
mod stepper;
mod surface;
mod table;
mod tables;
mod terrain;
mod tree;
mod value;
mod words;
pub mod write;
mod writer;

pub use crate::word::{Overflow, Registers, Rounding};
pub use camera::{Angles, Attitude, Camera};
pub use error::SceneError;
#[cfg(feature = "cli")]
pub(crate) use error::list;
pub use format::FormatRequest;
#[cfg(feature = "cli")]
pub(crate) use format::registers;
pub use hardware::{Hardware, RatioForm, WordSize};
pub use height_map::{Encoding, HeightFile, HeightMap, Interpretation};
pub use kernel::{Deformation, Kernel, KernelShape};
pub use light::{Colors, Light};
pub use load::load;
pub use maps::MapSource;
pub use nodata::NoData;
pub use plane::Plane;
pub use screen::{Extent, Screen};
#[cfg(feature = "cli")]
pub(crate) use shown::quote;
pub use stepper::{Bisection, Stepper, StepperMode};
pub use surface::Surface;
pub use tables::Scene;
pub use terrain::{Outside, Terrain};
