//! Register formats of the sweep world: the stock formats, overridden by `[format]` and `--format`.

use crate::plan::{Ground, Plan, PlanError, WordClass};
use crate::scene::{FormatRequest, Scene, shorten};
use crate::word::sweep::{Sweep, SweepFormat};
use crate::word::{Class, Overflow, Register, Rounding};

/// The register whose format another one takes, because they meet in one adder.
pub fn follows(register: Register) -> Option<Register> {
    use Register as R;
    match register {
        R::DGroundX => Some(R::GroundX),
        R::DGroundZ => Some(R::GroundZ),
        R::DRayY => Some(R::RayY),
        R::Surface | R::SlopeX | R::SlopeZ => Some(R::Node),
        R::WeightSlope => Some(R::Weight),
        R::Shade | R::Ramp | R::Channel => Some(R::Normal),
        _ => None,
    }
}

/// Registers that a request by this name sets: all of a class, or one of those that lead.
fn named(name: &str) -> Option<Vec<Register>> {
    let leads = |r: &Register| follows(*r).is_none();
    let classes = [Class::View, Class::Ground, Class::Height, Class::Weight, Class::Tone];
    if let Some(class) = classes.into_iter().find(|class| class.name() == name) {
        return Some(
            Register::ALL.iter().copied().filter(|r| r.class() == class && leads(r)).collect(),
        );
    }
    Register::ALL.iter().copied().find(|r| r.name() == name).map(|r| vec![r])
}

/// The sweep world of a scene: stock formats of `words`, with the scene's overrides.
///
/// # Errors
/// If a name is not that of a register or class, the register follows another one, or a position
/// does not hold a step.
pub fn sweep(scene: &Scene, plan: &Plan) -> Result<Sweep, PlanError> {
    let world = sweep_of(plan.words(), &scene.formats, scene.seed)?;
    let least = scene.stepper.fineness + 1;
    for register in [Register::GroundX, Register::GroundZ, Register::RayY] {
        let point = u32::from(world.format(register).point);
        if matches!(plan.ground, Ground::Terrain(_)) && point < least {
            return Err(PlanError::Format {
                name: register.name().to_owned(),
                reason: format!(
                    "{point} bits after the point do not hold a step of 2^-{least} cells; give \
                     at least {least}, or lower stepper.fineness"
                ),
            });
        }
    }
    Ok(world)
}

/// See [`sweep`].
///
/// # Errors
/// As [`sweep`].
pub fn sweep_of(
    words: WordClass,
    requests: &[(String, FormatRequest)],
    seed: u64,
) -> Result<Sweep, PlanError> {
    let stock = |register: Register| {
        let fixed = words.fixed(register);
        SweepFormat {
            width: fixed.width as u8,
            point: fixed.point as u8,
            rounding: Rounding::Nearest,
            overflow: Overflow::Wrap,
            seed: (seed ^ (seed >> 32)) as u32,
        }
    };
    let mut formats: Vec<SweepFormat> = Register::ALL.iter().map(|&r| stock(r)).collect();
    for (name, request) in requests {
        let registers = named(name).ok_or_else(|| PlanError::UnknownRegister {
            name: shorten(name),
            nearest: nearest(name).into(),
        })?;
        for register in registers {
            if let Some(leader) = follows(register) {
                return Err(PlanError::Format {
                    name: name.clone(),
                    reason: format!(
                        "this register has the format of {leader}, with which it meets in an \
                         adder; set {leader} instead"
                    ),
                });
            }
            check(name, register, request)?;
            formats[register as usize] = SweepFormat {
                width: request.width as u8,
                point: request.point as u8,
                rounding: request.rounding,
                overflow: request.overflow,
                seed: (seed ^ (seed >> 32)) as u32,
            };
        }
    }
    Ok(Sweep::new(|register| formats[follows(register).unwrap_or(register) as usize]))
}

/// Formats that no datapath of the machine can work with.
fn check(name: &str, register: Register, request: &FormatRequest) -> Result<(), PlanError> {
    let integer = i64::from(request.width) - i64::from(request.point);
    let needed = match register.class() {
        // Coefficients are scaled below one: a sign is enough.
        Class::View => 1,
        // Weights reach one, slopes two and more.
        Class::Weight => 3,
        // A channel reaches 255.
        Class::Tone => 10,
        Class::Ground | Class::Height => 2,
    };
    if integer < needed {
        return Err(PlanError::Format {
            name: name.to_owned(),
            reason: format!(
                "{} bits with {} after the point leave {integer} before it, sign included; \
                 {register} needs at least {needed}: widen it or move the point",
                request.width, request.point
            ),
        });
    }
    Ok(())
}

/// The name nearest to a misspelt one.
fn nearest(name: &str) -> &'static str {
    let classes = [Class::View, Class::Ground, Class::Height, Class::Weight, Class::Tone];
    classes
        .into_iter()
        .map(Class::name)
        .chain(Register::ALL.iter().filter(|r| follows(**r).is_none()).map(|r| r.name()))
        .max_by(|a, b| strsim::jaro_winkler(a, name).total_cmp(&strsim::jaro_winkler(b, name)))
        .unwrap_or("ground")
}
