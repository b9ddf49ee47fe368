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

use super::coefficient::{Bank, Coefficient as C};
use super::description::{SHADER, SHADER_TIMING};
use super::line::{When, Wire};
use super::{Description, Line, Timing, Unit};
use crate::word::{Multiply, Register, Shading, Site};

/// What the mixer is.
pub const DESCRIPTION: Description = Description {
    name: "mixer",
    stage: SHADER,
    gives: "the colour of the lit ground",
    inputs: &[Wire::Hit, Wire::AlbedoRed, Wire::AlbedoGreen, Wire::AlbedoBlue, Wire::Shade],
    outputs: &[Wire::LitRed, Wire::LitGreen, Wire::LitBlue],
    registers: &[Register::Shade, Register::Channel],
    multiplier: Register::Shade,
};

/// The mixer: it needs no coefficient.
#[derive(Clone, Copy, Debug)]
pub struct Mixer {
    /// Whether the light drives `shade`; without it the albedo is the lit colour.
    pub shaded: bool,
}

impl<W: Shading> Unit<W> for Mixer {
    fn description(&self) -> &'static Description {
        &DESCRIPTION
    }

    fn inputs(&self) -> Vec<Wire> {
        let all = DESCRIPTION.inputs.iter();
        all.filter(|&&wire| self.shaded || wire != Wire::Shade).copied().collect()
    }

    fn run(&self, line: &mut Line<W>) {
        for i in 0..line.len() {
            if line.is(When::Lit, i) {
                let albedo = line.albedo[i];
                line.lit[i] = if self.shaded {
                    let site = Site::pixel(line.number, line.column[i]).at(Register::Channel);
                    let channel =
                        |at: usize| albedo[at].multiply(line.shade[i], site.step(at as u32));
                    std::array::from_fn(channel)
                } else {
                    albedo
                };
            }
        }
    }

    fn coefficients(&self, bank: &mut Bank<W>) {
        bank.number(C::Lit, self.shaded);
    }

    fn timing(&self, _: u32) -> Timing {
        SHADER_TIMING
    }
}
