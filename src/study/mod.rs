//! Studies: what the machine's frames are worth, and what they cost.

pub mod bounds;
pub mod compare;
pub mod cost;
pub mod error;
pub mod explain;
pub mod ssim;
