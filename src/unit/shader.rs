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

use super::light::Light;
use super::mixer::Mixer;
use super::pixel::Pixel;
use super::ramp::Ramp;
use super::{Timing, Unit};
use crate::word::{Shading, World};

/// Name of the stage.
pub const STAGE: &str = "shader";

/// Its cycles: eleven of light and ramp side by side (normal, squares, table, dot product, light;
/// place, segment, colour), one of the mixer's products, one of mixer and pixel that rounds them.
/// The checker, which has fewer to do, takes as many.
pub const TIMING: Timing = Timing::pipeline(1, 13);

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
