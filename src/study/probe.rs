//! What is known about one pixel.

use glam::DVec3;

use super::error::{Sample, Sheet};
use crate::engine::{Engine, Machine, Wanted};
use crate::frame::Hit;
use crate::setup::SetupError;

/// One pixel of the processor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe {
    /// Column from the left.
    pub column: u32,
    /// Line from the top.
    pub line: u32,
    /// What the ray meets.
    pub hit: Hit,
    /// Where, scene units; `None` on a miss.
    pub point: Option<DVec3>,
    /// Index of the sample that hit.
    pub steps: u32,
    /// Cycles from the pixel before it to this one, the pipeline empty at the start of the line.
    pub cycles: u32,
    /// Distance to the oracle's ground point in pixels, on the same sheet of the surface.
    pub error_px: Option<f64>,
    /// Which kind of pixel it is for the oracle.
    pub sheet: Sheet,
}

impl Machine<'_> {
    /// Looks at a pixel of the frame; `None` if there is no such pixel.
    ///
    /// # Errors
    /// If the scene cannot be set up in f64.
    pub fn probe(&self, column: u32, line: u32) -> Result<Option<Probe>, SetupError> {
        let geometry = &self.plan().geometry;
        if column >= geometry.columns || line >= geometry.lines {
            return Ok(None);
        }
        let wanted = Wanted { first_line: line, buffers: true, cycles: true };
        let band = self.scan(Engine::Processor, wanted)?.draw(1, &|| false);
        let sample = Sample { lines: vec![line], columns: vec![column] };
        let error = self.errors(&sample)?.pop();
        let at = column as usize;
        Ok(band.zip(error).and_then(|(band, error)| {
            let (hit, buffers) = (band.frame.hit[at], band.frame.buffers?);
            Some(Probe {
                column,
                line,
                hit,
                point: matches!(hit, Hit::Surface | Hit::Side).then(|| buffers.point(at)),
                steps: buffers.steps[at],
                cycles: band.cycles[at],
                error_px: Some(error.total_px).filter(|error| error.is_finite()),
                sheet: error.sheet,
            })
        }))
    }
}
