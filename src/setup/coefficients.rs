//! Coefficients of projector and divider, from the plan's `f64` geometry.

use glam::DVec3;

use super::SetupError;
use super::memory::load;
use crate::plan::geometry::{Geometry, LinearScalar, LinearVector};
use crate::plan::{Projection, SurfacePlan};
use crate::scene::{Colors, RatioForm, Scene};
use crate::unit::divider::Divider;
use crate::unit::pixel::Pixel;
use crate::unit::projector::{Linear, Projector};
use crate::word::{Dividing, Open, Ratio, Register, World};

/// View vector and denominator as the projector accumulates them, scaled by powers of two.
#[derive(Clone, Debug)]
pub struct Coefficients {
    /// What is scaled.
    pub projection: Projection,
    /// V along the axes of the registers, in cells, height units or squares, times 2^view_exponent
    /// (equation 6; thesis 2.37).
    pub view: LinearVector,
    /// s n·V / |F| times 2^denominator_exponent (equations 8 and 9; thesis 2.15, 2.39).
    pub denominator: LinearScalar,
    /// Power of two on the view vector.
    pub view_exponent: i32,
    /// Power of two on the denominator.
    pub denominator_exponent: i32,
}

/// The exponent that brings a magnitude into `[1/2, 1)`; 0 for zero.
pub(super) fn normalising(magnitude: f64) -> i32 {
    if magnitude == 0.0 { 0 } else { -libm::frexp(magnitude).1 }
}

pub(super) fn power(exponent: i32) -> f64 {
    libm::scalbn(1.0, exponent)
}

impl Coefficients {
    /// Coefficients of a surface's projection.
    pub fn new(surface: &SurfacePlan, geometry: &Geometry) -> Self {
        let projection = surface.projection(geometry);
        let Projection { view, g, f, .. } = projection;
        let columns = f64::from(geometry.columns - 1);
        let lines = f64::from(geometry.lines - 1);
        let corners = [(0.0, 0.0), (0.0, columns), (lines, 0.0), (lines, columns)];
        let largest = |value: &dyn Fn(f64, f64) -> f64| {
            corners.iter().map(|&(l, c)| value(l, c)).fold(0.0, f64::max)
        };
        // Between two pixels on either side of zero an increment is at most twice the larger one,
        // which the registers hold beside the sign.
        let view_exponent = normalising(largest(&|l, c| view.at(l, c).abs().max_element()));
        // A plane seen edge-on (F = 0) has no denominator: nothing is met.
        let per_f = if f == 0.0 { 0.0 } else { 1.0 / f };
        let denominator = g.scaled(per_f);
        let denominator_exponent = normalising(largest(&|l, c| denominator.at(l, c).abs()));
        Self {
            projection,
            view: view.scaled(DVec3::splat(power(view_exponent))),
            denominator: denominator.scaled(power(denominator_exponent)),
            view_exponent,
            denominator_exponent,
        }
    }

    /// The projector's registers, of the surface with this index; with an accumulator for y where rays
    /// are stepped.
    ///
    /// # Errors
    /// If a coefficient does not fit a register of a sweep.
    pub fn projector<W: Open>(
        &self,
        world: &W,
        surface: usize,
        steps: bool,
    ) -> Result<Projector<W>, SetupError> {
        let linear = |register, pick: &dyn Fn(DVec3) -> f64| {
            let format = world.view(register);
            let load = |value: DVec3| load::<W::View>(pick(value), register, format);
            Ok::<_, SetupError>(Linear {
                start: load(self.view.start)?,
                per_line: load(self.view.per_line)?,
                per_column: load(self.view.per_column)?,
            })
        };
        let denominator = if self.projection.divides {
            let format = world.view(Register::Denominator);
            let load = |value| load::<W::View>(value, Register::Denominator, format);
            Some(Linear {
                start: load(self.denominator.start)?,
                per_line: load(self.denominator.per_line)?,
                per_column: load(self.denominator.per_column)?,
            })
        } else {
            None
        };
        Ok(Projector {
            surface,
            x: linear(Register::ViewX, &|v| v.x)?,
            y: if steps { Some(linear(Register::ViewY, &|v| v.y)?) } else { None },
            z: linear(Register::ViewZ, &|v| v.z)?,
            denominator,
        })
    }

    /// The divider's registers, where it is fitted.
    ///
    /// # Errors
    /// If the eye does not fit a register of a sweep.
    pub fn divider<W: Open + Dividing>(
        &self,
        world: &W,
        scene: &Scene,
    ) -> Result<Option<Divider<W>>, SetupError> {
        let Projection { eye: [x, z], range, divides, .. } = self.projection;
        if !divides {
            return Ok(None);
        }
        let exponent = self.denominator_exponent - self.view_exponent;
        let range = quotient_range(world, range);
        let ratio = |register| Ratio { exponent, range, format: world.ground(register) };
        let ground = |value, register| load(value, register, world.ground(register));
        let point = |register| world.fixed(register).map_or(0, |format| format.point);
        let axes = [(Register::ViewX, Register::GroundX), (Register::ViewZ, Register::GroundZ)];
        Ok(Some(Divider {
            eye_x: ground(x, Register::GroundX)?,
            eye_z: ground(z, Register::GroundZ)?,
            ratio_x: ratio(Register::GroundX),
            ratio_z: ratio(Register::GroundZ),
            shifts: axes.map(|(numerator, quotient)| {
                let places = point(quotient) + point(Register::Denominator);
                exponent + places as i32 - point(numerator) as i32
            }),
            bits: axes.map(|(_, quotient)| range + point(quotient) + 1),
            serial: scene.machine.ratio == RatioForm::Serial,
        }))
    }
}

/// The range of quotients: the planned one, or that of registers made narrower, so that no quotient
/// wraps.
pub(super) fn quotient_range<W: World>(world: &W, planned: u32) -> u32 {
    [Register::GroundX, Register::GroundZ]
        .into_iter()
        .filter_map(|register| world.fixed(register))
        .fold(planned, |range, f| range.min(f.width.saturating_sub(f.point + 1)))
}

/// The constant colours, which every kind of surface has.
pub(super) fn pixel(color: &Colors) -> Pixel {
    Pixel { sky: color.sky, out_of_range: color.far, side: color.side }
}
