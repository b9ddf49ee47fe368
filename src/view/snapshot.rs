//! What the render worker hands to the canvas: pictures as far as they are drawn, and what was
//! measured.

use std::sync::Arc;

use super::pane::{Pane, Source};
use crate::sink::picture::{Legend, Painted, Picture};
use crate::study::probe::Probe;

/// Colour of pixels that nothing has been drawn on.
pub const BLANK: [u8; 3] = [24, 24, 26];

/// How true a line of an image is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineState {
    /// Of an earlier order, or blank.
    Old,
    /// Enlarged from a coarser raster, or sampled.
    Preview,
    /// The line is drawn.
    Drawn,
}

/// A pane's picture, as far as it is drawn.
#[derive(Clone, Debug)]
pub struct Image {
    /// Picture and engine that it shows.
    pub pane: Pane,
    /// Pixels across.
    pub columns: usize,
    /// Scan lines.
    pub lines: usize,
    /// sRGB bytes, line by line from the top.
    pub pixels: Vec<[u8; 3]>,
    /// State of each line, from the top.
    pub states: Vec<LineState>,
    /// What its ramp stands for.
    pub legend: Option<Legend>,
    /// Why there is no picture.
    pub note: Option<&'static str>,
}

impl Image {
    /// A picture of which nothing is drawn yet.
    #[must_use]
    pub fn blank(pane: Pane, columns: usize, lines: usize) -> Self {
        Self {
            pane,
            columns,
            lines,
            pixels: vec![BLANK; columns * lines],
            states: vec![LineState::Old; lines],
            legend: None,
            note: None,
        }
    }

    /// The same picture on another raster, for the time until that is drawn.
    #[must_use]
    pub fn resized(&self, columns: usize, lines: usize) -> Self {
        if (columns, lines) == (self.columns, self.lines) {
            return self.clone();
        }
        let mut image = Self { legend: self.legend, ..Self::blank(self.pane, columns, lines) };
        for line in 0..lines {
            let from = line * self.lines / lines * self.columns;
            for column in 0..columns {
                let pixel = self.pixels.get(from + column * self.columns / columns);
                image.pixels[line * columns + column] = pixel.copied().unwrap_or(BLANK);
            }
        }
        image
    }

    /// Takes over lines from the top.
    pub fn draw(&mut self, painted: Painted) {
        let count = painted.pixels.len().min(self.pixels.len());
        self.pixels[..count].copy_from_slice(&painted.pixels[..count]);
        self.states[..count / self.columns.max(1)].fill(LineState::Drawn);
        self.legend = painted.legend;
    }

    /// Takes over a coarse picture, every pixel of it as a square of `factor` pixels.
    pub fn spread(&mut self, painted: Painted, factor: usize) {
        let across = self.columns.div_ceil(factor);
        for (line, row) in self.pixels.chunks_mut(self.columns.max(1)).enumerate() {
            let from = line / factor * across;
            for (column, pixel) in row.iter_mut().enumerate() {
                if let Some(coarse) = painted.pixels.get(from + column / factor) {
                    *pixel = *coarse;
                }
            }
        }
        self.states.fill(LineState::Preview);
        self.legend = painted.legend;
    }

    /// Lines that are drawn, from the top.
    #[cfg(any(test, feature = "parts"))]
    #[must_use]
    pub fn drawn(&self) -> usize {
        self.states.iter().take_while(|&&state| state == LineState::Drawn).count()
    }
}

/// How long a whole frame took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// What the time was spent on.
    pub source: Source,
    /// Milliseconds, with coefficient set-up, without maps and tables.
    pub ms: f64,
}

/// Frame rate of the emulated machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameRate {
    /// Frames per second at the scene's clock.
    pub fps: f64,
    /// Clock of the machine, MHz.
    pub clock_mhz: f64,
    /// Lines whose cycles were counted.
    pub counted: u32,
    /// Lines of the frame.
    pub lines: u32,
}

/// What is known beside the pictures.
#[derive(Clone, Debug, Default)]
pub struct Facts {
    /// Name of the fixed-point world.
    pub world: &'static str,
    /// Whole frames at full rate, one per source.
    pub timings: Vec<Timing>,
    /// Speed of the emulated machine.
    pub frame_rate: Option<FrameRate>,
    /// The pixel under the cursor.
    pub probe: Option<Probe>,
    /// Why nothing can be drawn.
    pub trouble: Option<String>,
}

/// The pictures and measurements of one moment.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// Grows with every snapshot.
    pub version: u64,
    /// Left and, where there is a split, right.
    pub images: Vec<Arc<Image>>,
    /// What was measured and found beside the pictures.
    pub facts: Facts,
    /// The line that the scan draws next; `None` at the full rate when all is drawn.
    pub scan: Option<u32>,
    /// Lines fall by and by; what they have not reached is dimmed.
    pub by_lines: bool,
}

impl Snapshot {
    /// Pixels at the bright end of the first picture of errors.
    #[must_use]
    pub fn error_high(&self) -> Option<f64> {
        let errors = self.images.iter().find(|image| image.pane.picture == Picture::Error)?;
        Some(errors.legend?.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Engine;
    use crate::sink::picture::Picture;
use crate::sink::picture::errors::ErrorPart;

    const PANE: Pane =
        Pane { engine: Engine::Fast, picture: Picture::Color, part: ErrorPart::Total };

    fn painted(values: impl IntoIterator<Item = u8>) -> Painted {
        Painted { pixels: values.into_iter().map(|v| [v; 3]).collect(), legend: None }
    }

    #[test]
    fn coarse_pixels_become_squares_and_lines_replace_them() {
        let mut image = Image::blank(PANE, 5, 3);
        image.spread(painted(0..6), 2);
        let row = |image: &Image, line: usize| -> Vec<u8> {
            image.pixels[line * 5..][..5].iter().map(|p| p[0]).collect()
        };
        assert_eq!(row(&image, 1), [0, 0, 1, 1, 2]);
        assert_eq!(row(&image, 2), [3, 3, 4, 4, 5]);
        assert_eq!((image.drawn(), image.states[2]), (0, LineState::Preview));
        image.draw(painted(10..15));
        assert_eq!(row(&image, 0), [10, 11, 12, 13, 14]);
        assert_eq!((image.drawn(), row(&image, 1)), (1, vec![0, 0, 1, 1, 2]));
    }

    #[test]
    fn another_raster_takes_the_nearest_pixels() {
        let mut image = Image::blank(PANE, 2, 1);
        image.draw(painted([1, 2]));
        let larger = image.resized(4, 2);
        let values: Vec<u8> = larger.pixels.iter().map(|p| p[0]).collect();
        assert_eq!(values, [1, 1, 2, 2, 1, 1, 2, 2]);
        assert_eq!(larger.drawn(), 0);
    }
}
