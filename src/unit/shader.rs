//! The shader: the colour of a pixel of a height map.
//!
//! *In hardware*: the normal (slopes and one) is shifted until its largest component is below one,
//! squared and summed, normalised by a reciprocal-square-root table, and multiplied with the light;
//! the height's place on the ramp mixes two colours; the product is rounded into a byte
//! (equations 23 to 26 of docs/mathematics.md). Planes have the checker in its place.
//!
//! | wire in | wire out |
//! |---|---|
//! | `hit`, `surface`, `slope_x`, `slope_z` | `color` |
//!
//! *Cycles*: one pixel per cycle. *Never*: divides.

use std::sync::Arc;

use super::Line;
use super::color::{Flat, byte};
use crate::frame::Hit;
use crate::word::{Cell, Multiply, Register, Rescale, Shading, Site, Word, World};

/// The shader of height maps.
#[derive(Clone, Debug)]
pub struct TerrainShader<W: World> {
    /// Constant colours.
    pub flat: Flat,
    /// Light; absent when the ambient share is all there is.
    pub light: Option<Light<W>>,
    /// Colour over height.
    pub ramp: Ramp<W>,
}

/// Registers of the lighting.
#[derive(Clone, Debug)]
pub struct Light<W: World> {
    /// Direction towards the light in the frame of slopes, times the diffuse share.
    pub toward: [W::Tone; 3],
    /// The ambient share.
    pub ambient: W::Tone,
    /// One.
    pub one: W::Tone,
    /// Reciprocal square roots of `t / 2^log2`, `0 ≤ t ≤ 4 · 2^log2`.
    pub rsqrt: Arc<Vec<W::Tone>>,
    /// Table entries per unit, as a power of two.
    pub rsqrt_log2: u32,
    /// Format of the scaled normal.
    pub normal_format: <W::Tone as Word>::Format,
}

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

/// Everything the terrain shader computes for one pixel.
#[derive(Clone, Copy, Debug)]
pub struct Tones<W: World> {
    /// Place on the ramp, in segments.
    pub ramp: W::Tone,
    /// Light.
    pub shade: Option<W::Tone>,
    /// Channels before rounding to bytes.
    pub channels: [W::Tone; 3],
}

impl<W: Shading> TerrainShader<W> {
    /// Drives `color` of one line.
    pub fn run(&self, line: &mut Line<W>) {
        for i in 0..line.len() {
            line.color[i] = match line.hit[i] {
                Hit::Sky => self.flat.sky,
                Hit::Far => self.flat.far,
                Hit::Side => self.flat.side,
                Hit::Surface => {
                    let site = Site::pixel(line.number, line.column[i]);
                    let tones = self.tones(line.surface[i], line.slope_x[i], line.slope_z[i], site);
                    tones.channels.map(byte)
                }
            };
        }
    }

    /// Ramp, light and channels of a lit pixel.
    #[inline(always)]
    pub fn tones(
        &self,
        surface: W::Height,
        slope_x: W::Height,
        slope_z: W::Height,
        site: Site,
    ) -> Tones<W> {
        let ramp = self.ramp.place(surface, site);
        let color = self.ramp.color(ramp, site);
        let shade = self.light.as_ref().map(|light| light.shade(slope_x, slope_z, site));
        let channels = match shade {
            None => color,
            Some(shade) => std::array::from_fn(|at| {
                color[at].multiply(shade, site.at(Register::Channel).step(at as u32))
            }),
        };
        Tones { ramp, shade, channels }
    }
}

impl<W: Shading> Light<W> {
    /// Ambient plus diffuse light (equations 23 to 25).
    #[inline(always)]
    pub fn shade(&self, slope_x: W::Height, slope_z: W::Height, site: Site) -> W::Tone {
        let site = site.at(Register::Normal);
        // Slopes below one share the exponent of the vertical component, which is one.
        let leading = slope_x.leading_one().max(slope_z.leading_one()).max(0);
        let exponent = -(leading + 1);
        let x = slope_x.rescale(exponent, self.normal_format, site);
        let z = slope_z.rescale(exponent, self.normal_format, site.step(1));
        let y = self.one.shift_floor((leading + 1) as u32);
        let square = x.multiply_two(x, z, z, site.step(4)) + y.multiply(y, site.step(5));
        let entry = square.entry(self.rsqrt_log2).min(self.rsqrt.len() - 1);
        let [light_x, light_y, light_z] = self.toward;
        let site = site.at(Register::Shade);
        let dot = x.multiply_two(light_x, z, light_z, site) + y.multiply(light_y, site.step(1));
        if dot.sign() > 0 {
            let shade = self.ambient + dot.multiply(self.rsqrt[entry], site.step(2));
            // The table's rounding may lift full light above one by a bit.
            if shade > self.one { self.one } else { shade }
        } else {
            self.ambient
        }
    }
}

impl<W: Shading> Ramp<W> {
    /// Place on the ramp in segments (equation 26).
    #[inline(always)]
    pub fn place(&self, surface: W::Height, site: Site) -> W::Tone {
        let site = site.at(Register::Ramp);
        let height: W::Tone = surface.rescale(self.exponent, self.format, site);
        height.multiply(self.gain, site.step(1))
    }

    /// The colour there.
    #[inline(always)]
    pub fn color(&self, place: W::Tone, site: Site) -> [W::Tone; 3] {
        let last = self.segments.len() as i32 - 1;
        let segment = place.cell().clamp(0, last);
        // The end of the ramp is the end of its last segment.
        let inside = if place.cell() > last { None } else { Some(place.fraction()) };
        let segment = &self.segments[segment as usize];
        std::array::from_fn(|at| {
            let (start, rise) = segment[at];
            let site = site.at(Register::Channel).step(8 + at as u32);
            match inside {
                Some(fraction) => start + rise.multiply(fraction, site),
                None => start + rise,
            }
        })
    }
}
