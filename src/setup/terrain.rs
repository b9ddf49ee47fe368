//! The units of a height map, loaded.

use super::SetupError;
use super::coefficients::{normalising, pixel, power, quotient_range};
use super::memory::{Memory, load};
use crate::frame::Hit;
use crate::plan::{Plan, PlanError, TerrainPlan};
use crate::scene::{Bisection, Scene};
use crate::unit::Unit;
use crate::unit::height_memory::Edge;
use crate::unit::interpolator::Interpolator;
use crate::unit::light::Light;
use crate::unit::mixer::Mixer;
use crate::unit::ramp::{Ramp, Segment};
use crate::unit::shader::Shader;
use crate::unit::stepper::{BisectionRule, Stepper};
use crate::unit::surface_unit::SurfaceUnit;
use crate::word::{
    Complete, Interpolating, Open, Readout, Register, Shading, Site, Word as _, World,
};

/// The units that draw a height map.
#[derive(Clone, Debug)]
pub struct TerrainUnits<W: World> {
    /// Finds the first sample of a ray under the surface.
    pub stepper: Stepper<W>,
    /// Gives height and slopes at the hit.
    pub interpolator: Interpolator<W>,
    /// Light, ramp, mixer and pixel.
    pub shader: Shader<W>,
}

impl<W: Interpolating + Shading> TerrainUnits<W> {
    /// The units in the order of the data flow.
    pub fn units(&self) -> Vec<&dyn Unit<W>> {
        let mut units: Vec<&dyn Unit<W>> = vec![&self.stepper, &self.interpolator];
        units.extend(self.shader.units());
        units
    }
}

impl<W: Complete> TerrainUnits<W> {
    /// Loads the units.
    pub(super) fn new(
        world: &W,
        scene: &Scene,
        plan: &Plan,
        walk: &TerrainPlan,
        memory: &Memory<W>,
    ) -> Result<Self, SetupError> {
        let interpolator = interpolator(world, walk, memory)?;
        // The real world bisects as often as the stock one of this plan.
        let point = world.fixed(Register::GroundX).map_or(plan.words.ground_point, |f| f.point);
        let stepper = stepper(world, scene, walk, memory, interpolator.clone(), point)?;
        refuse_eye_under_ground(walk, &stepper)?;
        let shader = shader(world, scene, walk, memory)?;
        Ok(Self { stepper, interpolator, shader })
    }
}

/// The stepper's coefficients, as words of a world; positions have `point` bits after the point.
fn stepper<W: Open>(
    world: &W,
    scene: &Scene,
    walk: &TerrainPlan,
    memory: &Memory<W>,
    surface: Interpolator<W>,
    point: u32,
) -> Result<Stepper<W>, SetupError> {
    let ground = |value, register| load(value, register, world.ground(register));
    let height = |value| load(value, Register::RayY, world.height(Register::RayY));
    let heights = &memory.heights;
    let ends = heights.edge() == Edge::Ends;
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
fn interpolator<W: Open>(
    world: &W,
    walk: &TerrainPlan,
    memory: &Memory<W>,
) -> Result<Interpolator<W>, SetupError> {
    let format = world.weight(Register::Weight);
    let weight = |value| load(value, Register::Weight, format);
    let slope_scale = if walk.fitted.slope_scale.fitted {
        // A constant map has no slopes: a full machine's factors multiply zeros and are one.
        let factor = |cell| if walk.top == 0.0 { 1.0 } else { walk.lengths.y / cell };
        Some([weight(factor(walk.lengths.x))?, weight(factor(walk.lengths.z))?])
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

/// The shader's registers for a height map.
fn shader<W: Open>(
    world: &W,
    scene: &Scene,
    walk: &TerrainPlan,
    memory: &Memory<W>,
) -> Result<Shader<W>, SetupError> {
    let tone = |value, register: Register| load(value, register, world.tone(register));
    let light = if walk.fitted.light.fitted {
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

fn refuse_eye_under_ground<W: Interpolating + Open>(
    walk: &TerrainPlan,
    stepper: &Stepper<W>,
) -> Result<(), PlanError> {
    let (eye, surface) = (stepper.eye(), &stepper.surface);
    let nowhere = Site::pixel(0, 0);
    if !surface.contains(eye.x, eye.z, nowhere) {
        return Ok(());
    }
    let ground = surface.height(eye.x, eye.z, nowhere);
    if eye.y.is_below(ground, nowhere.at(Register::Surface)) {
        return Err(PlanError::EyeUnderGround {
            eye: walk.scale.to_scene(eye.y.value()),
            ground: walk.scale.to_scene(ground.value()),
        });
    }
    Ok(())
}
