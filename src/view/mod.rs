//! The window: the scan as it is produced, with mouse and keys.
//!
//! ```text
//! glass (window) --input--> hands --actions--> session --order--> drawing (thread)
//!       ^                                         |                    |
//!       +------------- canvas <-------------------+------- shown <-----+
//! ```
//!
//! - [`mod@input`]: keys and mouse of one tick, and [`input::Hands`], which turn them into actions
//!   ([`action`]).
//! - [`script`]: the same from a text, for runs without hands.
//! - [`session`]: what is being looked at and how; actions change it. [`camera`] moves the craft,
//!   [`pane`] says what each side of the divider shows.
//! - [`drawing`]: the thread that draws what the session orders, in passes from coarse to fine
//!   ([`passes`]), with the engines set up in [`machine`].
//! - [`canvas`]: everything that is seen, as one picture.
//! - [`run`]: the loop between a [`run::Glass`] and the rest; `window` is the one that opens a
//!   window, and the only file that knows how.

pub mod action;
pub mod camera;
pub mod canvas;
pub mod drawing;
pub mod ground;
pub mod input;
pub mod layout;
pub mod machine;
pub mod pace;
pub mod pane;
pub mod passes;
mod preview;
pub mod probe;
pub mod run;
pub mod script;
pub mod session;
pub mod shown;
pub mod sources;
mod values;
pub mod window;
