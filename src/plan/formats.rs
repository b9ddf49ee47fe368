//! Register formats of a machine: the stock ones of a word size, overridden by `[format]` and
//! `--format`.

use super::word_class::WordClass;
use super::{Plan, PlanError};
use crate::scene::{FormatRequest, Registers, Scene};
use crate::word::sweep::{Sweep, SweepFormat};
use crate::word::{Class, Fixed, Overflow, Register, Rounding};

/// The formats in use: those asked for, and stock ones for the other registers.
#[derive(Clone, Copy, Debug)]
pub struct Formats<'a> {
    /// Word size of the stock registers.
    pub words: WordClass,
    /// What is asked for; of several formats for a register the last one counts.
    pub requests: &'a [(Registers, FormatRequest)],
}

impl Formats<'_> {
    /// Every register of a word size as it is.
    pub fn stock(words: WordClass) -> Self {
        Self { words, requests: &[] }
    }

    fn request(&self, register: Register) -> Option<&FormatRequest> {
        let asked = self.requests.iter().rev().find(|(asked, _)| asked.contains(register));
        asked.map(|(_, request)| request)
    }

    /// Format of a register.
    pub fn fixed(&self, register: Register) -> Fixed {
        self.request(register).map_or(self.words.fixed(register), |request| Fixed {
            width: request.width,
            point: request.point,
        })
    }

    /// The sweep world of these formats.
    ///
    /// # Errors
    /// If a format leaves a register fewer bits before the point than its datapath needs, or asks for
    /// a rounding where none takes place.
    pub fn sweep(&self, seed: u64) -> Result<Sweep, PlanError> {
        for (registers, request) in self.requests {
            check(*registers, request)?;
        }
        Ok(Sweep::new(|register| {
            let Fixed { width, point } = self.fixed(register);
            let request = self.request(register);
            SweepFormat {
                width: width as u8,
                point: point as u8,
                rounding: request.map_or_else(Rounding::default, |request| request.rounding),
                overflow: request.map_or_else(Overflow::default, |request| request.overflow),
                seed: (seed ^ (seed >> 32)) as u32,
            }
        }))
    }
}

/// The sweep world of a scene.
///
/// # Errors
/// As [`Formats::sweep`], or if a position does not hold a step.
pub fn sweep(scene: &Scene, plan: &Plan) -> Result<Sweep, PlanError> {
    let formats = Formats { words: plan.words, requests: &scene.formats };
    let world = formats.sweep(scene.seed)?;
    let least = scene.stepper.fineness + 1;
    for register in [Register::GroundX, Register::GroundZ, Register::RayY] {
        let point = formats.fixed(register).point;
        if plan.surfaces.iter().any(|surface| surface.terrain().is_some()) && point < least {
            return Err(PlanError::Format {
                name: register.name(),
                reason: format!(
                    "{point} bits after the point do not hold a step of 2^-{least} cells; give \
                     at least {least}, or lower stepper.fineness"
                ),
            });
        }
    }
    Ok(world)
}

/// Refuses formats that no datapath of the machine can work with, and roundings that none acts by.
fn check(registers: Registers, request: &FormatRequest) -> Result<(), PlanError> {
    let integer = i64::from(request.width) - i64::from(request.point);
    let class = match registers {
        Registers::Class(class) => class,
        Registers::One(register) => register.class(),
    };
    let needed = match class {
        // Coefficients are scaled below one: a sign is enough.
        Class::View => 1,
        // Weights reach one, slopes two and more.
        Class::Weight => 3,
        // A channel reaches 255.
        Class::Tone => 10,
        Class::Ground | Class::Height => 2,
    };
    if integer < needed {
        let name = registers.name();
        return Err(PlanError::Format {
            name,
            reason: format!(
                "{} bits with {} after the point leave {integer} before it, sign included; \
                 {name} needs at least {needed}: widen it or move the point",
                request.width, request.point
            ),
        });
    }
    if request.rounding != Rounding::Nearest && !registers.are_rounded() {
        let (name, rounding) = (registers.name(), request.rounding.name());
        let why = match class {
            Class::View => "coefficients of the view are loaded to nearest and added",
            _ => "places on a ray are added; quotients and halvings are floored, steps go to nearest",
        };
        return Err(PlanError::Format {
            name,
            reason: format!(
                "rounding {rounding} would act nowhere: {why}; leave the rounding out, or give it \
                 to node, weight or normal, whose results are rounded"
            ),
        });
    }
    Ok(())
}
