//! Coefficients of the units, from the plan's `f64` geometry.

use glam::DVec3;

use super::SetupError;
use super::memory::{Memory, load};
use crate::frame::Hit;
use crate::plan::geometry::{LinearScalar, LinearVector};
use crate::plan::ranges::TerrainPlan;
use crate::plan::{Plan, PlanePlan, SurfacePlan};
use crate::scene::{Bisection, Colors, Plane, RatioForm, Scene};
use crate::unit::checker::Checker;
use crate::unit::divider::Divider;
use crate::unit::interpolator::Interpolator;
use crate::unit::light::Light;
use crate::unit::mixer::Mixer;
use crate::unit::pixel::Pixel;
use crate::unit::projector::{Linear, Projector};
use crate::unit::ramp::{Ramp, Segment};
use crate::unit::shader::Shader;
use crate::unit::stepper::{BisectionRule, Stepper};
use crate::word::{Dividing, Load, Open, Ratio, Register, Word, World};

/// View vector and denominator as the projector accumulates them, scaled by powers of two.
#[derive(Clone, Debug)]
pub struct Coefficients {
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
fn normalising(magnitude: f64) -> i32 {
    if magnitude == 0.0 { 0 } else { -libm::frexp(magnitude).1 }
}

fn power(exponent: i32) -> f64 {
    libm::scalbn(1.0, exponent)
}

impl Coefficients {
    /// Coefficients of a plan's projection.
    pub fn new(plan: &Plan) -> Self {
        let geometry = &plan.geometry;
        // View in register units, denominator's G and F.
        let (view, g, f) = match &plan.surface {
            SurfacePlan::Terrain(walk) => {
                let view = geometry.view.scaled(walk.lengths.recip());
                // The slab's top: n = y. Rays that start at the eye have no use for it.
                let f = if walk.from_eye { -1.0 } else { walk.top - walk.eye.y };
                (view, view.dot(DVec3::Y), f)
            }
            SurfacePlan::Plane(plane) => {
                let PlaneView { view, g } = plane_view(plan, plane);
                (view, g, plane.numerator)
            }
        };
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
            view: view.scaled(DVec3::splat(power(view_exponent))),
            denominator: denominator.scaled(power(denominator_exponent)),
            view_exponent,
            denominator_exponent,
        }
    }

    /// The projector's registers.
    ///
    /// # Errors
    /// If a coefficient does not fit a register of a sweep.
    pub fn projector<W: Open>(&self, world: &W, plan: &Plan) -> Result<Projector<W>, SetupError> {
        let linear = |register, pick: &dyn Fn(DVec3) -> f64| {
            let format = world.view(register);
            let load = |value: DVec3| load::<W::View>(pick(value), register, format);
            Ok::<_, SetupError>(Linear {
                start: load(self.view.start)?,
                per_line: load(self.view.per_line)?,
                per_column: load(self.view.per_column)?,
            })
        };
        let stepping = matches!(plan.surface, SurfacePlan::Terrain(_)) || plan.fitted.idle;
        let denominator = if plan.fitted.divider {
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
            x: linear(Register::ViewX, &|v| v.x)?,
            y: if stepping { Some(linear(Register::ViewY, &|v| v.y)?) } else { None },
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
        plan: &Plan,
    ) -> Result<Option<Divider<W>>, SetupError> {
        if !plan.fitted.divider {
            return Ok(None);
        }
        let (x, z, range) = match &plan.surface {
            SurfacePlan::Terrain(walk) => (walk.eye.x, walk.eye.z, walk.range),
            SurfacePlan::Plane(plane) => (plane.eye[0], plane.eye[1], plane.range),
        };
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
fn quotient_range<W: World>(world: &W, planned: u32) -> u32 {
    [Register::GroundX, Register::GroundZ]
        .into_iter()
        .filter_map(|register| world.fixed(register))
        .fold(planned, |range, f| range.min(f.width.saturating_sub(f.point + 1)))
}

/// In-plane view and n·V.
struct PlaneView {
    view: LinearVector,
    g: LinearScalar,
}

fn plane_view(plan: &Plan, plane: &PlanePlan) -> PlaneView {
    let along = plane.axes.map(|axis| plan.geometry.view.dot(axis).scaled(1.0 / plane.checker));
    let g = plan.geometry.view.dot(plane.normal);
    let pack =
        |pick: &dyn Fn(&LinearScalar) -> f64| DVec3::new(pick(&along[0]), 0.0, pick(&along[1]));
    PlaneView {
        view: LinearVector {
            start: pack(&|s| s.start),
            per_line: pack(&|s| s.per_line),
            per_column: pack(&|s| s.per_column),
        },
        g,
    }
}

/// The stepper's coefficients, as words of a world.
pub(super) fn stepper<W: Open>(
    world: &W,
    scene: &Scene,
    walk: &TerrainPlan,
    memory: &Memory<W>,
    surface: Interpolator<W>,
) -> Result<Stepper<W>, SetupError> {
    let ground = |value, register| load(value, register, world.ground(register));
    let height = |value| load(value, Register::RayY, world.height(Register::RayY));
    let heights = &memory.heights;
    let ends = heights.edge() == crate::unit::height_memory::Edge::Ends;
    // The real world bisects as often as the stock one of this plan.
    let point = world.fixed(Register::GroundX).map_or(walk.words.ground_point, |f| f.point);
    Ok(Stepper {
        from_eye: walk.from_eye,
        eye_x: ground(walk.eye.x, Register::GroundX)?,
        eye_z: ground(walk.eye.z, Register::GroundZ)?,
        eye_y: height(walk.eye.y)?,
        top: height(walk.top)?,
        base: height(walk.base)?,
        fineness: scene.stepper.fineness,
        last: walk.last,
        bisection: match scene.stepper.halvings {
            Bisection::Fixed(times) => BisectionRule::Fixed(times),
            Bisection::Footprint => BisectionRule::Footprint {
                bias: walk.bisection_bias,
                // A step keeps a bit.
                cap: point.saturating_sub(scene.stepper.fineness + 1),
            },
        },
        pyramid: memory.pyramid.clone(),
        beyond: if ends && quotient_range(world, walk.range) == walk.range {
            Hit::Sky
        } else {
            Hit::OutOfRange
        },
        sides: ends || heights.has_voids(),
        extent: ends.then(|| (heights.columns(), heights.rows())),
        format_x: world.ground(Register::GroundX),
        format_z: world.ground(Register::GroundZ),
        format_y: world.height(Register::RayY),
        surface,
    })
}

/// The interpolator's coefficients, as words of a world.
pub(super) fn interpolator<W: Open>(
    world: &W,
    plan: &Plan,
    walk: &TerrainPlan,
    memory: &Memory<W>,
) -> Result<Interpolator<W>, SetupError> {
    let format = world.weight(Register::Weight);
    let weight = |value| load(value, Register::Weight, format);
    let slope_scale = if plan.fitted.slope_scale {
        let unit = walk.lengths.y;
        Some([weight(unit / walk.lengths.x)?, weight(unit / walk.lengths.z)?])
    } else {
        None
    };
    Ok(Interpolator {
        heights: memory.heights.clone(),
        rom: memory.rom.clone(),
        form: memory.form,
        one: weight(1.0)?,
        slope_scale,
        weight_format: format,
    })
}

fn pixel(color: &Colors) -> Pixel {
    Pixel { sky: color.sky, out_of_range: color.far, side: color.side }
}

/// The shader's registers for a height map.
pub(super) fn shader<W: Open>(
    world: &W,
    scene: &Scene,
    plan: &Plan,
    walk: &TerrainPlan,
    memory: &Memory<W>,
) -> Result<Shader<W>, SetupError> {
    let tone = |value, register: Register| load(value, register, world.tone(register));
    let light = if plan.fitted.light {
        let diffuse = 1.0 - scene.light.ambient;
        let toward = (scene.light.direction * diffuse).to_array();
        Some(Light {
            toward: [
                tone(toward[0], Register::Shade)?,
                tone(toward[1], Register::Shade)?,
                tone(toward[2], Register::Shade)?,
            ],
            ambient: tone(scene.light.ambient, Register::Shade)?,
            one: tone(1.0, Register::Shade)?,
            rsqrt: memory.rsqrt.clone(),
            normal_format: world.tone(Register::Normal),
        })
    } else {
        None
    };
    let exponent = normalising(walk.top);
    let segments = scene.color.ramp.len() - 1;
    let gain = if walk.top == 0.0 { 0.0 } else { segments as f64 / (walk.top * power(exponent)) };
    let segment = |pair: &[[u8; 3]]| -> Result<Segment<W::Tone>, SetupError> {
        let channel = |at: usize| -> Result<_, SetupError> {
            let (from, to) = (f64::from(pair[0][at]), f64::from(pair[1][at]));
            Ok((tone(from, Register::Channel)?, tone(to - from, Register::Channel)?))
        };
        Ok([channel(0)?, channel(1)?, channel(2)?])
    };
    Ok(Shader {
        mixer: Mixer { shaded: light.is_some() },
        light,
        ramp: Ramp {
            exponent,
            gain: tone(gain, Register::Ramp)?,
            segments: scene.color.ramp.windows(2).map(segment).collect::<Result<_, _>>()?,
            format: world.tone(Register::Ramp),
        },
        pixel: pixel(&scene.color),
    })
}

/// The checker's coefficients, as words of a world.
pub(super) fn checker<W: Open>(
    world: &W,
    scene: &Scene,
    plan: &Plan,
    plane: &Plane,
    planned: &PlanePlan,
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
    let g = fade(plan, plane, planned);
    let per_f = if planned.numerator == 0.0 { 0.0 } else { 1.0 / planned.numerator.abs() };
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
pub fn fade(plan: &Plan, plane: &Plane, planned: &PlanePlan) -> f64 {
    let pitch = plan.screen.pitch().max_element();
    libm::sqrt(planned.numerator.abs() * pitch * plan.screen.distance() / plane.checker)
}
