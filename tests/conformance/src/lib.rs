//! What an engine of Terraline has to draw as the line-by-line processor does: the same frame, bit for
//! bit, in every buffer that engines give.
//!
//! An engine enrols itself with the way it draws a machine's scene, in a test target:
//!
//! ```ignore
//! terraline_conformance::conforms!(fast, by_fast_engine);
//!
//! fn by_fast_engine(machine: &Machine<'_>) -> Option<Frame> {
//!     Some(machine.frame(Engine::Fast, true).expect("a frame"))
//! }
//! ```
//!
//! `None` says that it does not draw such scenes, and one that draws less than half of them fails. A
//! panic is a difference.

#[doc(hidden)]
pub mod compared;
#[doc(hidden)]
pub mod corner_cases;
pub mod formats;
pub mod frames;
#[doc(hidden)]
pub mod random;
#[doc(hidden)]
pub mod rasters;
pub mod recipe;
pub mod scenes;

pub use compared::Draw;

/// The tests of an engine, in a module of its own, from the function that draws with it.
#[macro_export]
macro_rules! conforms {
    ($engine:ident, $draw:ident) => {
        mod $engine {
            const DRAW: &$crate::Draw = &super::$draw;

            #[test]
            fn draws_built_in_scenes() {
                $crate::random::built_in_scenes(DRAW);
            }

            #[test]
            fn draws_all_rasters() {
                $crate::rasters::all(DRAW);
            }

            #[test]
            fn draws_corner_cases() {
                $crate::corner_cases::all(DRAW);
            }

            #[test]
            fn draws_random_scenes() {
                $crate::random::scenes(DRAW);
            }

            #[test]
            fn draws_in_formats_of_a_scenes_own() {
                $crate::random::sweeps(DRAW);
            }
        }
    };
}
