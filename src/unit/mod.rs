//! The hardware units, one file each. A unit works on the wires of one scan line; it cannot name
//! a concrete number world, and its trait bounds say what arithmetic it is made of.
//!
//! ```text
//! projector -> divider -> stepper -> interpolator -> shader -> frame
//!                            ^  |
//!                            |  v
//!                  pyramid  heights + kernel ROM
//! ```
//!
//! The shader is four units in one stage: light, ramp, mixer, pixel. On a plane the checker follows
//! the divider.
//!
//! Floating point does not occur here: floats belong to set-up, oracle and studies.
#![deny(clippy::float_arithmetic)]

pub mod checker;
pub mod coefficient;
pub mod depth;
pub mod description;
pub mod divider;
pub mod height_memory;
pub mod interpolator;
pub mod kernel_rom;
pub mod light;
pub mod line;
pub mod mixer;
pub mod pixel;
pub mod projector;
pub mod pyramid;
pub mod ramp;
pub mod shader;
pub mod stepper;
pub mod surface_unit;

pub use description::{Cycles, Description, Idle, Reads, Timing, Unit};
pub use line::{Line, Wire};
