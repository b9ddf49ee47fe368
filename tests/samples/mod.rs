//! Frames and pictures to write and to compare.

use std::path::Path;

use tempfile::TempDir;
use terraline::frame::{Buffers, Frame, Hit};
use terraline::sink::png::{self, Image};

pub fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// A frame with every outcome, misses and values of many sizes.
pub fn frame(columns: usize, lines: usize) -> Frame {
    let n = columns * lines;
    let outcome = |i: usize| [Hit::Surface, Hit::Sky, Hit::Side, Hit::Far][i % 4];
    let value = |i: usize, scale: f64| if i % 4 == 1 { f64::NAN } else { i as f64 / 7.0 * scale };
    Frame {
        columns,
        lines,
        color: (0..n).map(|i| [i as u8, (i / 3) as u8, (i * 7) as u8]).collect(),
        hit: (0..n).map(outcome).collect(),
        buffers: Some(Buffers {
            lambda: (0..n).map(|i| value(i, 1e-9)).collect(),
            ground_x: (0..n).map(|i| value(i, 1.0)).collect(),
            ground_z: (0..n).map(|i| value(i, -1.0)).collect(),
            height: (0..n).map(|i| value(i, 1e12)).collect(),
            normal: (0..n).map(|i| [value(i, 0.1), value(i, -0.1), value(i, 0.5)]).collect(),
            steps: (0..n).map(|i| i as u32 * 65_537).collect(),
            trials: Some((0..n).map(|i| i as u32).collect()),
        }),
    }
}

pub fn image(columns: usize, lines: usize) -> Image {
    let pixels = (0..columns * lines).map(|i| [i as u8, (i / 5) as u8, (i * 11) as u8]).collect();
    Image { columns, lines, pixels }
}

pub fn write_image(path: &Path, image: &Image) {
    png::write(path, image.columns, image.lines, &image.pixels).expect("a PNG");
}
