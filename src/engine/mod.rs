//! The engines that draw a frame, and the machine of a scene: set up once behind one type for every number
//! world, to be drawn whole or in parts by any engine.
//!
//! What studies ask of a machine (errors, cost, explanations) they add to it themselves, so that
//! nothing here knows of them.

mod list;
mod machine;
mod memories;
mod overflows;
mod scan;
mod world;

pub use list::Engine;
pub use machine::{Machine, WithSetup};
pub use memories::{Memories, SetUpTime};
pub use overflows::Overflows;
pub use scan::{Band, ErrorParts, Scan, Stop, Wanted};
pub use world::FixedWorld;
