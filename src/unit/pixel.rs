//! The pixel: the bytes that the frame takes.
//!
//! *In hardware*: the lit colour is rounded to the nearest bytes where the surface is met; a
//! multiplexer takes a constant colour elsewhere. Last part of the [shader](super::shader); the
//! [checker](super::checker) of planes ends in the same.
//!
//! | wire in | wire out |
//! |---|---|
//! | `hit`, `lit` | `color` |
//!
//! *Cycles*: one pixel per cycle. *Never*: multiplies or divides.

use super::coefficient::{Bank, Coefficient as C};
use super::description::{SHADER, SHADER_TIMING};
use super::line::Wire;
use super::{Description, Line, Timing, Unit};
use crate::frame::Hit;
use crate::word::{Cell, Register, Site, World};

/// What the pixel unit is.
pub const DESCRIPTION: Description = Description {
    name: "pixel",
    stage: SHADER,
    gives: "the bytes of a pixel",
    inputs: &[Wire::Hit, Wire::LitRed, Wire::LitGreen, Wire::LitBlue],
    outputs: &[Wire::Color],
    registers: &[Register::Channel],
    multiplier: Register::Shade,
};

/// Constant colours, of pixels that meet no lit surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pixel {
    /// Nothing is met.
    pub sky: [u8; 3],
    /// The ground is out of range.
    pub out_of_range: [u8; 3],
    /// The side of the map.
    pub side: [u8; 3],
}

impl Pixel {
    /// The constant colour of an outcome; `None` where a surface is met, whose colour is computed.
    #[inline(always)]
    pub fn constant(&self, hit: Hit) -> Option<[u8; 3]> {
        match hit {
            Hit::Surface => None,
            Hit::Sky => Some(self.sky),
            Hit::OutOfRange => Some(self.out_of_range),
            Hit::Side => Some(self.side),
        }
    }

    /// The nearest bytes of a colour, ties upward.
    #[inline(always)]
    pub fn rounded<T: Cell>(color: [T; 3], site: Site) -> [u8; 3] {
        let site = site.at(Register::Channel);
        color.map(|channel| channel.nearest(site).clamp(0, 255) as u8)
    }
}

impl<W: World> Unit<W> for Pixel {
    fn description(&self) -> &'static Description {
        &DESCRIPTION
    }

    fn run(&self, line: &mut Line<W>) {
        for i in 0..line.len() {
            let site = Site::pixel(line.number, line.column[i]);
            line.color[i] =
                self.constant(line.hit[i]).unwrap_or_else(|| Self::rounded(line.lit[i], site));
        }
    }

    fn coefficients(&self, bank: &mut Bank<W>) {
        bank.color(C::SkyColor, self.sky);
        bank.color(C::OutOfRangeColor, self.out_of_range);
        bank.color(C::SideColor, self.side);
    }

    fn timing(&self, _: u32) -> Timing {
        SHADER_TIMING
    }
}
