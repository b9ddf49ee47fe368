//! Terraline.
pub mod frame;
pub mod scene;
