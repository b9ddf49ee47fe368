//! The checker of a plane, loaded.

use super::SetupError;
use super::coefficients::{Coefficients, normalising, pixel, power};
use super::memory::load;
use crate::plan::{Plan, PlanePlan};
use crate::scene::Scene;
use crate::unit::checker::Checker;
use crate::word::{Load, Open, Register, Word};

/// The checker's coefficients, as words of a world.
pub(super) fn checker<W: Open>(
    world: &W,
    scene: &Scene,
    plan: &Plan,
    plane: &PlanePlan,
    coefficients: &Coefficients,
) -> Result<Checker<W>, SetupError> {
    let tone = |value, register: Register| load(value, register, world.tone(register));
    let [even, odd] = scene.color.checker;
    let mut mean = [W::Tone::zero(world.tone(Register::Channel)); 3];
    let mut swing = mean;
    for at in 0..3 {
        let (even, odd) = (f64::from(even[at]), f64::from(odd[at]));
        mean[at] = tone((even + odd) / 2.0, Register::Channel)?;
        swing[at] = tone((even - odd) / 2.0, Register::Channel)?;
    }
    // Equation 27: a pixel covers one square along the view where G = g; D there:
    let g = fade(plan, plane);
    let per_f = if plane.numerator == 0.0 { 0.0 } else { 1.0 / plane.numerator.abs() };
    let at_zero_contrast = g * per_f * power(coefficients.denominator_exponent);
    let exponent = normalising(at_zero_contrast);
    let format = world.view(Register::Denominator);
    // Where twice that denominator is beyond the register, no pixel reaches it.
    let full_from = W::View::load(2.0 * at_zero_contrast, format);
    let gain =
        if at_zero_contrast == 0.0 { 0.0 } else { 1.0 / (at_zero_contrast * power(exponent)) };
    Ok(Checker {
        pixel: pixel(&scene.color),
        mean,
        swing,
        contrast_exponent: exponent,
        contrast_gain: tone(gain, Register::Shade)?,
        one: tone(1.0, Register::Shade)?,
        full_from,
        format: world.tone(Register::Shade),
    })
}

/// The G at which a pixel covers one square along the view (equation 27):
/// `g = sqrt(|F| · δ · U1 / square)`, δ the larger pitch.
pub fn fade(plan: &Plan, plane: &PlanePlan) -> f64 {
    let pitch = plan.screen.pitch().max_element();
    libm::sqrt(plane.numerator.abs() * pitch * plan.screen.distance() / plane.checker)
}
