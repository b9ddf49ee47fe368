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
//! - [`Plan`]: which units a scene needs, which word size holds it, and the proof of its ranges.
//! - [`Machine`]: a scene, set up, to be drawn by any [`Engine`] and asked by studies. Processor and
//!   fast engine are equal in every bit; `f64` units and oracle are what they are compared with.
//! - [`Frame`] and its [`Buffers`]: what an engine hands out.
//! - [`Oracle`]: every pixel in closed form, sharing no code with what it checks.
//! - [`ErrorReport`], [`Cost`], [`Explanation`]: what a machine is worth, what it costs, and one of its
//!   pixels register by register.
//! - [`Vectors`], [`write_png`], [`write_npz`]: files.
//!
//! Draw a frame and ask what it is worth:
//!
//! ```
//! use terraline::{Engine, ErrorReport, Machine, Memories, Plan, Sample};
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
//!
//! The parts of the machine (units, number worlds, set-up, clock, engines) are open to whoever asks for
//! the feature `parts`, as the hardware model and the tests do; they change without notice.

macro_rules! parts {
    ($($(#[$which:meta])* $name:ident)*) => {
        $(
            $(#[$which])*
            #[cfg(feature = "parts")]
            pub mod $name;
            $(#[$which])*
            #[cfg(not(feature = "parts"))]
            mod $name;
        )*
    };
}

parts! {
    #[cfg(feature = "cli")] cli
    clock
    engine
    fast
    frame
    oracle
    plan
    processor
    readout
    setup
    sink
    study
    unit
    #[cfg(feature = "window")] view
    word
}
pub mod scene;

#[cfg(feature = "cli")]
#[doc(hidden)]
pub use cli::main;
pub use engine::{
    Band, Engine, FixedWorld, Machine, Memories, Overflows, Scan, SetUpTime, Stop, Wanted,
};
pub use frame::{
    BufferRow, Buffers, Dtype, Element, Frame, Giver, Hit, Pixel, Scalars, TABLE as BUFFERS,
};
pub use oracle::{Oracle, Sighting};
pub use plan::{Fit, Plan, PlanError, SurfacePlan, UnitPlan, WordClass};
pub use setup::SetupError;
pub use sink::npz::write as write_npz;
pub use sink::picture::{Legend, Painted, Picture};
pub use sink::png::{Image, read as read_png, write as write_png};
pub use sink::vectors::selection::Selection;
pub use sink::vectors::{Vectors, VectorsError};
pub use sink::{ReadError, SinkError};
pub use study::compare::{
    CompareError, Comparison, compare_files, difference_picture, gain as difference_gain,
};
pub use study::cost::Cost;
pub use study::error::{
    Counts, ErrorReport, Outcomes, PixelError, Sample, Sheet, Spread, SuspectReport, Suspects,
    Worst,
};
pub use study::explain::Explanation;
pub use study::explain::text::text as explanation_text;
pub use word::{Class, Fixed, Register};
