//! Terraline.
pub mod cli;
pub mod clock;
pub mod engine;
pub mod fast;
pub mod frame;
pub mod oracle;
pub mod plan;
pub mod processor;
pub mod readout;
pub mod scene;
pub mod setup;
pub mod sink;
pub mod study;
pub mod unit;
pub mod word;
