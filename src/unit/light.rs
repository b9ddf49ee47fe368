//! The light: how much of its light a surface with these slopes reflects.
//!
//! *In hardware*: the normal (slopes and one) is shifted until its largest component is below one,
//! squared and summed, normalised by a reciprocal-square-root table, and multiplied with the
//! direction of the light (equations 23 to 25 of docs/mathematics.md). Part of the
//! [shader](super::shader); left out where the ambient share is all there is.
//!
//! | wire in | wire out |
//! |---|---|
//! | `hit`, `slope_x`, `slope_z` | `shade` |
//!
//! *Cycles*: one pixel per cycle. *Never*: divides.

use std::sync::Arc;

use super::coefficient::{Bank, Coefficient as C};
use super::description::{SHADER, SHADER_TIMING};
use super::line::{When, Wire, Work};
use super::{Description, Line, Reads, Timing, Unit};
use crate::frame::Hit;
use crate::word::{Cell, Multiply, Register, Rescale, Shading, Site, Table, Word, World};

/// What the light is.
pub const DESCRIPTION: Description = Description {
    name: "light",
    stage: SHADER,
    gives: "how much light the surface reflects",
    inputs: &[Wire::Hit, Wire::SlopeX, Wire::SlopeZ],
    outputs: &[Wire::Shade],
    registers: &[Register::SlopeX, Register::SlopeZ, Register::Normal, Register::Shade],
    multiplier: Register::Shade,
};

/// Registers of the light.
#[derive(Clone, Debug)]
pub struct Light<W: World> {
    /// Direction towards the light in the frame of slopes, times the diffuse share.
    pub toward: [W::Tone; 3],
    /// The share of light from everywhere, from 0 to 1.
    pub ambient: W::Tone,
    /// Full light.
    pub one: W::Tone,
    /// Reciprocal square roots of `t / 2^log2`, `0 ≤ t ≤ 4 · 2^log2`.
    pub rsqrt: Arc<Table<W::Tone>>,
    /// Format of the scaled normal.
    pub normal_format: <W::Tone as Word>::Format,
}

impl<W: Shading> Light<W> {
    /// Ambient plus diffuse light, at most one (equations 23 to 25).
    #[inline(always)]
    pub fn shade(&self, slope_x: W::Height, slope_z: W::Height, site: Site) -> W::Tone {
        let site = site.at(Register::Normal);
        // Slopes below one share the exponent of the vertical component, which is one.
        let leading = slope_x
            .leading_one(site.at(Register::SlopeX))
            .max(slope_z.leading_one(site.at(Register::SlopeZ)))
            .max(0);
        let exponent = -(leading + 1);
        let x = slope_x.rescale(exponent, self.normal_format, site);
        let z = slope_z.rescale(exponent, self.normal_format, site.step(1));
        let y = self.one.shift_floor((leading + 1) as u32);
        let square = x.multiply_two(x, z, z, site.step(4)) + y.multiply(y, site.step(5));
        let site = site.at(Register::Shade);
        let rsqrt = square.look_up(&self.rsqrt, site);
        let [light_x, light_y, light_z] = self.toward;
        let dot = x.multiply_two(light_x, z, light_z, site) + y.multiply(light_y, site.step(1));
        if dot.is_positive(site) {
            let shade = self.ambient + dot.multiply(rsqrt, site.step(2));
            // The table's rounding may lift full light above one by a bit.
            shade.lesser(self.one)
        } else {
            self.ambient
        }
    }
}

impl<W: Shading> Unit<W> for Light<W> {
    fn description(&self) -> &'static Description {
        &DESCRIPTION
    }

    fn run(&self, line: &mut Line<W>) {
        for i in 0..line.len() {
            if line.is(When::Lit, i) {
                let site = Site::pixel(line.number, line.column[i]);
                line.shade[i] = self.shade(line.slope_x[i], line.slope_z[i], site);
            }
        }
    }

    fn coefficients(&self, bank: &mut Bank<W>) {
        let [x, y, z] = self.toward;
        bank.number(C::Lit, true);
        bank.tone(C::LightX, x);
        bank.tone(C::LightY, y);
        bank.tone(C::LightZ, z);
        bank.tone(C::Ambient, self.ambient);
        bank.tone(C::ShadeOne, self.one);
        bank.number(C::RsqrtLog2, self.rsqrt.log2());
    }

    fn timing(&self, _: u32) -> Timing {
        SHADER_TIMING
    }

    fn reads(&self, _: Work, hit: Hit) -> Reads {
        Reads { memory: 0, table: u64::from(hit == Hit::Surface) }
    }
}
