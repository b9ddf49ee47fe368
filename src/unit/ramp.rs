//! The ramp: the colour of the ground by its height, before it is lit.
//!
//! *In hardware*: the height's place on the ramp chooses a segment of a table and mixes the two
//! colours at its ends (equation 26 of docs/mathematics.md). Part of the [shader](super::shader).
//!
//! | wire in | wire out |
//! |---|---|
//! | `hit`, `surface` | `albedo` |
//!
//! *Cycles*: one pixel per cycle. *Never*: divides.

use super::coefficient::{Bank, Coefficient as C};
use super::description::{SHADER, SHADER_TIMING};
use super::line::{When, Wire};
use super::{Description, Line, Timing, Unit};
use crate::word::{Multiply, Register, Rescale, Shading, Site, Word, World};

/// What the ramp is.
pub const DESCRIPTION: Description = Description {
    name: "ramp",
    stage: SHADER,
    gives: "the colour of the ground by its height",
    inputs: &[Wire::Hit, Wire::Surface],
    outputs: &[Wire::AlbedoRed, Wire::AlbedoGreen, Wire::AlbedoBlue],
    registers: &[Register::Surface, Register::Ramp, Register::Channel],
    multiplier: Register::Shade,
};

/// Registers of the ramp.
#[derive(Clone, Debug)]
pub struct Ramp<W: World> {
    /// Heights, which registers hold above the lowest node, are shifted by this into `[0, 1)`.
    pub exponent: i32,
    /// Segments per shifted height.
    pub gain: W::Tone,
    /// Start and rise of every segment, by channel.
    pub segments: Vec<Segment<W::Tone>>,
    /// Format of the place on the ramp.
    pub format: <W::Tone as Word>::Format,
}

/// Start and rise of a ramp segment, by channel.
pub type Segment<T> = [(T, T); 3];

impl<W: Shading> Ramp<W> {
    /// Place on the ramp in segments (equation 26).
    #[inline(always)]
    pub fn place(&self, surface: W::Height, site: Site) -> W::Tone {
        let site = site.at(Register::Ramp);
        let height: W::Tone = surface.rescale(self.exponent, self.format, site);
        height.multiply(self.gain, site.step(1))
    }

    /// The colour there, channels in `0 ..= 255`.
    #[inline(always)]
    pub fn color(&self, place: W::Tone, site: Site) -> [W::Tone; 3] {
        W::Tone::piecewise_linear(&self.segments, place, site.at(Register::Channel).step(8))
    }
}

impl<W: Shading> Unit<W> for Ramp<W> {
    fn description(&self) -> &'static Description {
        &DESCRIPTION
    }

    fn run(&self, line: &mut Line<W>) {
        for i in 0..line.len() {
            if line.is(When::Lit, i) {
                let site = Site::pixel(line.number, line.column[i]);
                line.albedo[i] = self.color(self.place(line.surface[i], site), site);
            }
        }
    }

    fn coefficients(&self, bank: &mut Bank<W>) {
        bank.number(C::RampExponent, self.exponent);
        bank.tone(C::RampGain, self.gain);
        bank.number(C::RampLast, self.segments.len() as i64 - 1);
    }

    fn timing(&self, _: u32) -> Timing {
        SHADER_TIMING
    }
}
