//! The window: the scan as it is produced, with mouse and keys.
//!
//! ```text
//! glass (window) --input--> hands --actions--> session --order--> render worker
//!       ^                                         |                    |
//!       +------------- canvas <-------------------+----- snapshot <----+
//! ```
//!
//! - [`mod@input`]: keys and mouse of one tick, and [`input::Hands`], which turn them into actions
//!   ([`action`]).
//! - [`script`]: the same from a text, for unattended runs.
//! - [`session`]: what is being looked at and how; actions change it. [`camera`] moves the craft,
//!   [`pane`] says what each side of the split shows, [`measure`] what lengths are in metres.
//! - [`worker`]: the render worker, a thread that draws what the session orders ([`order`]) and
//!   hands out [`snapshot`]s over a [`desk`]: in `passes` from coarse (`preview`) to fine, with the
//!   state of `renderer` and what it keeps of a view (`shelf`).
//! - [`canvas`]: everything that is seen, as one picture.
//! - [`run`]: the loop between a [`run::Glass`] and the rest; `window` is the one that opens a
//!   window, and the only file that knows how.

pub mod action;
pub mod camera;
pub mod canvas;
pub mod desk;
pub mod input;
pub mod layout;
pub mod measure;
pub mod order;
pub mod pace;
pub mod pane;
mod end;
mod passes;
mod preview;
mod renderer;
pub mod run;
pub mod script;
pub mod session;
mod shelf;
pub mod snapshot;
pub mod window;
pub mod worker;
