//! The shader: light, ramp, mixer and pixel as the one stage that they are in the elastic chain.
//!
//! ```text
//! slopes  -> light -> shade  \
//!                             mixer -> lit -> pixel -> color
//! surface -> ramp  -> albedo /
//! ```
//!
//! Light and ramp work side by side. *Cycles*: one pixel per cycle. Planes have the checker in its
//! place.

use super::Unit;
use super::light::Light;
use super::mixer::Mixer;
use super::pixel::Pixel;
use super::ramp::Ramp;
use crate::word::{Shading, World};

/// The shader of height maps.
#[derive(Clone, Debug)]
pub struct Shader<W: World> {
    /// Slopes to shade; absent where the ambient share is all there is.
    pub light: Option<Light<W>>,
    /// Height to albedo.
    pub ramp: Ramp<W>,
    /// Albedo and shade to lit colour.
    pub mixer: Mixer,
    /// Outcome and lit colour to bytes.
    pub pixel: Pixel,
}

impl<W: Shading> Shader<W> {
    /// The units of the stage, in their order.
    pub fn units(&self) -> impl Iterator<Item = &dyn Unit<W>> {
        let light = self.light.iter().map(|light| light as &dyn Unit<W>);
        light.chain([&self.ramp as &dyn Unit<W>, &self.mixer, &self.pixel])
    }
}
