//! Whole frames of the oracle, line by line in parallel.

use rayon::prelude::*;

use super::{Oracle, Sighting};
use crate::frame::{Buffers, Frame};

impl Oracle {
    /// Every pixel of the screen, with all buffers; `steps` is zero and `trials` is not given,
    /// since nothing is stepped. The height of a side of the map is that of its rim.
    #[must_use]
    pub fn frame(&self) -> Frame {
        let (columns, lines) = (self.columns as usize, self.lines as usize);
        let sightings: Vec<Sighting> = (0..lines * columns)
            .into_par_iter()
            .with_min_len(columns.max(1))
            .map(|index| self.pixel((index / columns) as f64, (index % columns) as f64))
            .collect();
        let buffers = Buffers {
            lambda: sightings.iter().map(|s| s.lambda).collect(),
            ground_x: sightings.iter().map(|s| s.point.x).collect(),
            ground_z: sightings.iter().map(|s| s.point.z).collect(),
            height: sightings.iter().map(|s| s.point.y).collect(),
            normal: sightings.iter().map(|s| s.normal.to_array()).collect(),
            steps: vec![0; sightings.len()],
            trials: None,
        };
        Frame {
            columns,
            lines,
            color: sightings.iter().map(|s| s.color).collect(),
            hit: sightings.iter().map(|s| s.hit).collect(),
            buffers: Some(buffers),
        }
    }
}
