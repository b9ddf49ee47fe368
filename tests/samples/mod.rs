//! Frames and pictures to write and to compare.

use std::path::Path;

use tempfile::TempDir;
use terraline::frame::{Frame, Giver, Hit, Pixel};
use terraline::sink::png::{self, Image};

pub fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// A frame with every array and outcome, misses and values of many sizes.
pub fn frame(columns: usize, lines: usize) -> Frame {
    let n = columns * lines;
    let outcome = |i: usize| [Hit::Surface, Hit::Sky, Hit::Side, Hit::OutOfRange][i % 4];
    let value = |i: usize, scale: f64| if i % 4 == 1 { f64::NAN } else { i as f64 / 7.0 * scale };
    let mut frame = Frame::with_room(columns, lines, true);
    for i in 0..n {
        frame.color.push([i as u8, (i / 3) as u8, (i * 7) as u8]);
        frame.hit.push(outcome(i));
        let pixel = Pixel {
            lambda: value(i, 1e-9),
            ground_x: value(i, 1.0),
            ground_z: value(i, -1.0),
            height: value(i, 1e12),
            normal: [value(i, 0.1), value(i, -0.1), value(i, 0.5)],
            steps: i as u32 * 65_537,
            trials: i as u32,
        };
        let buffers = frame.buffers.as_mut().expect("asked for");
        buffers.push(pixel, Giver::Processor);
        buffers.error_px.push(if i % 5 == 2 { f64::INFINITY } else { value(i, 1e-3) });
        buffers.cycles.push(i as u32 % 97);
    }
    frame
}

pub fn image(columns: usize, lines: usize) -> Image {
    let pixels = (0..columns * lines).map(|i| [i as u8, (i / 5) as u8, (i * 11) as u8]).collect();
    Image { columns, lines, pixels }
}

pub fn write_image(path: &Path, image: &Image) {
    png::write(path, image.columns, image.lines, &image.pixels).expect("a PNG");
}
