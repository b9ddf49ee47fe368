//! Frames of the oracle, all pixels in parallel.

use std::ops::Range;

use rayon::prelude::*;

use super::{Oracle, Sighting};
use crate::frame::{Frame, Giver, Pixel};

impl Oracle {
    /// Every pixel of the screen, with all buffers; see [`Oracle::draw`].
    #[must_use]
    pub fn frame(&self) -> Frame {
        self.draw(0..self.lines, &|| false).unwrap_or_else(|| unreachable!("nobody stops it"))
    }

    /// Some lines of the screen, with all buffers that the oracle gives; `steps` is zero, since
    /// nothing is stepped. The height of a side of the map is that of its rim. `None` if `stop`,
    /// which is asked before every pixel, said so.
    pub fn draw(&self, lines: Range<u32>, stop: &(dyn Fn() -> bool + Sync)) -> Option<Frame> {
        let columns = self.columns;
        let seen: Option<Vec<Sighting>> = (lines.start * columns..lines.end * columns)
            .into_par_iter()
            .with_min_len(16)
            .map(|index| {
                let (line, column) = (index / columns, index % columns);
                (!stop()).then(|| self.pixel(line.into(), column.into()))
            })
            .collect();
        let mut frame = Frame::with_room(columns as usize, lines.len(), true);
        for sighting in seen? {
            frame.color.push(sighting.color);
            frame.hit.push(sighting.hit);
            if let Some(buffers) = &mut frame.buffers {
                buffers.push(sighting.into(), Giver::Engines);
            }
        }
        Some(frame)
    }
}

impl From<Sighting> for Pixel {
    fn from(sighting: Sighting) -> Self {
        Self {
            lambda: sighting.lambda,
            ground_x: sighting.point.x,
            ground_z: sighting.point.z,
            height: sighting.point.y,
            normal: sighting.normal.to_array(),
            steps: 0,
            trials: 0,
        }
    }
}
