//! What a scene's machine is worth and what it costs. Each study is asked of a
//! [`Machine`](crate::engine::Machine).

pub mod bounds;
pub mod caution;
pub mod compare;
pub mod cost;
pub mod error;
pub mod explain;
pub mod figures;
pub mod probe;
pub mod ssim;
