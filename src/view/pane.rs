//! What one side of the split shows: a picture, and the engine that draws it.

use crate::engine::Engine;
use crate::sink::picture::Picture;
use crate::sink::picture::errors::ErrorPart;

/// A picture by an engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pane {
    /// The engine that draws it.
    pub engine: Engine,
    /// The picture that it shows.
    pub picture: Picture,
    /// Which errors it shows, where it shows errors.
    pub part: ErrorPart,
}

/// What gives the values of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// Frames of an engine; the processor's with cycles.
    Frame(Engine),
    /// The processor's units, in fixed point and in f64, compared with the oracle.
    Error,
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
            (Picture::Error, _) => Ok(Source::Error),
            (_, Engine::Fast) if !fast_can => {
                Err("the fast engine cannot draw saturating registers: G for the processor")
            }
            (_, engine) => Ok(Source::Frame(engine)),
        }
    }

    /// Which errors it shows: those of the units in f64 are the algorithm's alone.
    #[must_use]
    pub fn errors(self) -> ErrorPart {
        if self.engine == Engine::Real { ErrorPart::Algorithm } else { self.part }
    }

    /// The same with the next part of the errors.
    #[must_use]
    pub fn next_part(self) -> Self {
        let part = match self.part {
            ErrorPart::Total => ErrorPart::Algorithm,
            ErrorPart::Algorithm => ErrorPart::Quantisation,
            ErrorPart::Quantisation => ErrorPart::Total,
        };
        Self { part, ..self }
    }

    /// Head of its legend.
    #[must_use]
    pub fn title(self) -> String {
        if self.picture == Picture::Error && self.engine != Engine::Oracle {
            let between = match self.errors() {
                ErrorPart::Total => "fixed - oracle",
                ErrorPart::Algorithm => "real - oracle",
                ErrorPart::Quantisation => "fixed - real",
            };
            return format!("{} error, {between}", self.errors().name());
        }
        let picture = match self.picture {
            Picture::Color => "colour",
            other => other.name(),
        };
        let engine = match (self.picture, self.engine) {
            (Picture::Cycles, Engine::Fast) => "processor",
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
