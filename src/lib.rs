//! Terraline emulates a dedicated raster processor for flight-simulator terrain, in fixed point,
//! and validates it against floating point.
//!
//! Data flows one way:
//!
//! ```text
//! scene -> plan -> set-up -> engine -> frame -> sinks and studies
//! ```
//!
//! - [`scene`]: what the user asked for, in scene units and `f64`.
//! - [`plan`]: which units the scene needs, which word size holds it, and the proof of its ranges.
//! - [`word`]: number worlds, from `f64` to fixed point of any width.
//! - [`setup`]: coefficients, tables and maps quantised into registers.
//! - [`mod@unit`]: one file per hardware unit; each works on the wires of one scan line.
//! - [`processor`] and [`fast`]: the two engines, equal in every bit; [`clock`] counts cycles.
//! - [`oracle`]: every pixel in closed form, sharing no code with what it checks.
//! - [`engine`]: a scene's machine, set up, to be drawn by any of them, and asked by studies.
//! - [`study`], [`sink`]: errors and costs, files.
//! - `cli` (feature `cli`): the commands; `view` (feature `window`): the window.
//!
//! Draw a frame and ask what it is worth:
//!
//! ```
//! use terraline::engine::{Engine, Machine, Memories};
//! use terraline::plan::Plan;
//! use terraline::study::error::{ErrorReport, Sample};
//!
//! let scene = terraline::scene::load(Some("overview"), &["screen.size=[64, 48]".into()])?;
//! let plan = Plan::new(&scene, None, false)?;
//! let machine = Machine::new(&scene, &plan, &Memories::default())?;
//! let frame = machine.frame(Engine::Fast, false)?;
//! assert_eq!(frame.color.len(), 64 * 48);
//!
//! let sample = Sample::strips(&plan, 16, scene.seed);
//! let errors = machine.errors(&sample)?;
//! let report = ErrorReport::new(&sample, &errors, scene.unit_m);
//! assert!(report.total_px.is_some_and(|spread| spread.median < 1.0 / 32.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(feature = "cli")]
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
#[cfg(feature = "window")]
pub mod view;
pub mod word;
