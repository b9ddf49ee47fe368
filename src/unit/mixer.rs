//! The mixer: the lit colour of the ground, albedo times shade.
//!
//! *In hardware*: three multipliers. Part of the [shader](super::shader), and the place where
//! whatever else colours the ground enters: texture layers into the albedo, occlusion into the
//! shade.
//!
//! | wire in | wire out |
//! |---|---|
//! | `hit`, `albedo`, `shade` | `lit` |
//!
//! *Cycles*: one pixel per cycle. *Never*: divides.

use super::Line;
use crate::frame::Hit;
use crate::word::{Multiply, Register, Shading, Site};

/// The mixer.
#[derive(Clone, Copy, Debug)]
pub struct Mixer {
    /// Whether the light drives `shade`; without it the albedo is the lit colour.
    pub shaded: bool,
}

impl Mixer {
    /// Drives `lit` of one line, where the surface is met.
    pub fn run<W: Shading>(&self, line: &mut Line<W>) {
        for i in 0..line.len() {
            if line.hit[i] == Hit::Surface {
                let (albedo, shade) = (line.albedo[i], line.shade[i]);
                line.lit[i] = if self.shaded {
                    let site = Site::pixel(line.number, line.column[i]).at(Register::Channel);
                    std::array::from_fn(|at| albedo[at].multiply(shade, site.step(at as u32)))
                } else {
                    albedo
                };
            }
        }
    }
}
