//! The checker: the colour of a pixel of a plane.
//!
//! *In hardware*: the parity of the square, faded to the mean of the two colours where squares
//! become smaller than pixels (equation 27 of docs/mathematics.md). It stands where height maps
//! have the shader.
//!
//! | wire in | wire out |
//! |---|---|
//! | `entry`, `entry_x`, `entry_z`, `denominator` | `hit`, `color` |
//!
//! *Cycles*: one pixel per cycle. *Never*: divides.

use super::coefficient::{Bank, Coefficient as C};
use super::description::{SHADER, SHADER_TIMING};
use super::line::{Entry, Wire};
use super::pixel::Pixel;
use super::{Description, Line, Timing, Unit};
use crate::frame::Hit;
use crate::word::{Cell, Multiply, Register, Rescale, Shading, Site, Word, World};

/// What the checker is.
pub const DESCRIPTION: Description = Description {
    name: "checker",
    stage: SHADER,
    gives: "outcome and colour of a pixel of a plane",
    inputs: &[Wire::Entry, Wire::EntryX, Wire::EntryZ, Wire::Denominator],
    outputs: &[Wire::Hit, Wire::Color],
    registers: &[
        Register::GroundX,
        Register::GroundZ,
        Register::Denominator,
        Register::Shade,
        Register::Channel,
    ],
    multiplier: Register::Shade,
};

/// The checker: the shader of planes.
#[derive(Clone, Debug)]
pub struct Checker<W: World> {
    /// Constant colours; a plane has no side.
    pub pixel: Pixel,
    /// Mean of the two colours.
    pub mean: [W::Tone; 3],
    /// Half their difference.
    pub swing: [W::Tone; 3],
    /// Exponent and gain that turn the denominator into contrast plus one.
    pub contrast_exponent: i32,
    /// See `contrast_exponent`.
    pub contrast_gain: W::Tone,
    /// The contrast of a square seen in full.
    pub one: W::Tone,
    /// The denominator from which on contrast is full: larger ones are not scaled. Absent where no
    /// pixel of the screen reaches it.
    pub full_from: Option<W::View>,
    /// Format of the contrast.
    pub format: <W::Tone as Word>::Format,
}

impl<W: Shading> Checker<W> {
    /// Contrast of the squares: 1 where a pixel covers at most a quarter of a square along the
    /// view, 0 where it covers a whole one (equation 27).
    #[inline(always)]
    pub fn contrast(&self, denominator: W::View, site: Site) -> W::Tone {
        let here = site.at(Register::Denominator);
        if self.full_from.is_some_and(|full| !denominator.is_below(full, here)) {
            return self.one;
        }
        let site = site.at(Register::Shade);
        let scaled: W::Tone = denominator.rescale(self.contrast_exponent, self.format, site);
        let scaled = scaled.multiply(self.contrast_gain, site.step(1));
        let contrast = (scaled - self.one).lesser(self.one);
        if contrast.is_positive(site) { contrast } else { W::Tone::zero(self.format) }
    }

    /// Colour of a square at a contrast.
    #[inline(always)]
    fn color(&self, contrast: W::Tone, odd: bool, site: Site) -> [u8; 3] {
        let site = site.at(Register::Channel);
        let color = std::array::from_fn(|at| {
            let (mean, swing) = (self.mean[at], self.swing[at]);
            let swing = swing.multiply(contrast, site.step(at as u32));
            if odd { mean - swing } else { mean + swing }
        });
        Pixel::rounded(color, site)
    }
}

impl<W: Shading> Unit<W> for Checker<W> {
    fn description(&self) -> &'static Description {
        &DESCRIPTION
    }

    fn run(&self, line: &mut Line<W>) {
        for i in 0..line.len() {
            (line.hit[i], line.color[i]) = match line.entry[i] {
                Entry::Sky => (Hit::Sky, self.pixel.sky),
                Entry::OutOfRange => (Hit::OutOfRange, self.pixel.out_of_range),
                Entry::Met => {
                    let site = Site::pixel(line.number, line.column[i]);
                    let contrast = self.contrast(line.denominator[i], site);
                    let x = line.entry_x[i].cell(site.at(Register::GroundX));
                    let z = line.entry_z[i].cell(site.at(Register::GroundZ));
                    let odd = (x ^ z) & 1 == 1;
                    (Hit::Surface, self.color(contrast, odd, site))
                }
            };
        }
    }

    fn coefficients(&self, bank: &mut Bank<W>) {
        Unit::<W>::coefficients(&self.pixel, bank);
        let names =
            [C::MeanRed, C::MeanGreen, C::MeanBlue, C::SwingRed, C::SwingGreen, C::SwingBlue];
        for (name, &word) in names.into_iter().zip(self.mean.iter().chain(&self.swing)) {
            bank.tone(name, word);
        }
        bank.number(C::ContrastExponent, self.contrast_exponent);
        bank.tone(C::ContrastGain, self.contrast_gain);
        bank.tone(C::ShadeOne, self.one);
        bank.number(C::FullFromFitted, self.full_from.is_some());
        if let Some(full) = self.full_from {
            bank.view(C::FullFrom, full);
        }
    }

    fn timing(&self, _: u32) -> Timing {
        SHADER_TIMING
    }
}
