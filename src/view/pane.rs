//! What one side of the split shows: a picture, and the engine that draws it.

use crate::engine::Engine;
use crate::sink::picture::Picture;

/// A picture by an engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pane {
    /// The engine that draws it.
    pub engine: Engine,
    /// The picture that it shows.
    pub picture: Picture,
}

/// What gives the values of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// Frames of an engine; the processor's with cycles.
    Frame(Engine),
    /// The processor's units, in fixed point or in f64, compared with the oracle.
    Error(Engine),
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
            (Picture::Cycles, Engine::Fast | Engine::Processor) => {
                Ok(Source::Frame(Engine::Processor))
            }
            (Picture::Cycles, _) => {
                Err("only the machine takes cycles: G for the processor, or another picture")
            }
            (Picture::Error, Engine::Oracle) => {
                Err("the oracle is what errors are measured against: G for another engine")
            }
            (Picture::Steps, Engine::Oracle) => {
                Err("the oracle takes no steps: G for another engine, or another picture")
            }
            (Picture::Error, Engine::Real) => Ok(Source::Error(Engine::Real)),
            (Picture::Error, _) => Ok(Source::Error(Engine::Processor)),
            (_, Engine::Fast) if !fast_can => {
                Err("the fast engine cannot draw saturating registers: G for the processor")
            }
            (_, engine) => Ok(Source::Frame(engine)),
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
