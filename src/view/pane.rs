//! What one side of the divider shows: a picture, and who draws it.

use crate::engine::Engine;
use crate::sink::picture::Picture;

/// A picture by an engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pane {
    /// Who draws.
    pub engine: Engine,
    /// What is seen.
    pub picture: Picture,
}

/// Work that gives the values of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// Frames of the fast engine.
    Fast,
    /// Frames of the processor, with cycles.
    Processor,
    /// Frames of the units in f64.
    Real,
    /// Frames of the oracle.
    Oracle,
    /// Fixed point compared with the oracle.
    FixedError,
    /// The units in f64 compared with the oracle.
    RealError,
}

impl Pane {
    /// Where its values come from; why there are none, if there are none.
    ///
    /// # Errors
    /// One line to show in the place of the picture.
    pub fn source(self, fast_can: bool) -> Result<Source, &'static str> {
        match (self.picture, self.engine) {
            // Fast engine and processor draw the same frame, so they have the same cycles: the
            // processor's, which alone takes any.
            (Picture::Cycles, Engine::Fast | Engine::Processor) => Ok(Source::Processor),
            (Picture::Cycles, _) => {
                Err("only the machine takes cycles: G for the processor, or another picture")
            }
            (Picture::Error, Engine::Oracle) => {
                Err("the oracle is what errors are measured against: G for another engine")
            }
            (Picture::Steps, Engine::Oracle) => {
                Err("the oracle takes no steps: G for another engine, or another picture")
            }
            (Picture::Error, Engine::Real) => Ok(Source::RealError),
            (Picture::Error, _) => Ok(Source::FixedError),
            (_, Engine::Fast) if !fast_can => {
                Err("the fast engine cannot draw saturating registers: G for the processor")
            }
            (_, Engine::Fast) => Ok(Source::Fast),
            (_, Engine::Processor) => Ok(Source::Processor),
            (_, Engine::Real) => Ok(Source::Real),
            (_, Engine::Oracle) => Ok(Source::Oracle),
        }
    }

    /// Head of its legend.
    #[must_use]
    pub fn title(self) -> String {
        let picture = match self.picture {
            Picture::Color => "colour",
            other => other.name(),
        };
        let engine = match (self.picture, self.engine) {
            (Picture::Cycles, Engine::Fast) => "processor",
            (Picture::Error, Engine::Fast | Engine::Processor) => "fixed - oracle",
            (Picture::Error, Engine::Real) => "real - oracle",
            (_, engine) => engine.name(),
        };
        format!("{picture}, {engine}")
    }

    /// The same picture by the next engine.
    #[must_use]
    pub fn next_engine(self) -> Self {
        let engine = match self.engine {
            Engine::Fast => Engine::Processor,
            Engine::Processor => Engine::Real,
            Engine::Real => Engine::Oracle,
            Engine::Oracle => Engine::Fast,
        };
        Self { engine, ..self }
    }
}
