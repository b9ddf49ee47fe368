//! What a plan proves of the registers in use, and what it cannot prove.

use super::PlanError;
use super::formats::Formats;
use super::geometry::Geometry;
use super::word_class::LARGEST_PLACE;
use crate::word::Register;

/// A claim that does not hold.
#[derive(Debug)]
pub(super) struct Refusal {
    /// Field of the scene.
    pub(super) field: &'static str,
    /// Which range or rounding does not hold, with its number.
    pub(super) reason: String,
    /// What to do about it.
    pub(super) remedy: &'static str,
    /// The register whose format is to blame.
    pub(super) register: Register,
}

impl From<Refusal> for PlanError {
    fn from(Refusal { field, reason, remedy, .. }: Refusal) -> Self {
        Self::Range { field, reason, remedy }
    }
}

/// What was found of the registers in use.
#[derive(Debug)]
pub(super) struct Proof {
    /// How far ranges and roundings go in them.
    pub(super) facts: String,
    /// The claims that do not hold.
    pub(super) refusals: Vec<Refusal>,
    /// What holds, but not so well that the plan would choose these words while there are finer
    /// ones.
    pub(super) reservations: Vec<Refusal>,
}

impl Proof {
    /// The facts, where every claim holds.
    pub(super) fn holds(self) -> Result<String, Refusal> {
        self.refusals.into_iter().next().map_or(Ok(self.facts), Err)
    }

    /// The same, where they hold without reservations.
    pub(super) fn holds_well(mut self) -> Result<String, Refusal> {
        self.refusals.append(&mut self.reservations);
        self.holds()
    }

    /// The open claims of a sweep, and those that hold but not well: its formats are coarse on
    /// purpose, its overflows counted.
    pub(super) fn not_proved(&self, formats: &Formats<'_>) -> Vec<String> {
        let told = |Refusal { reason, register, .. }: &Refusal| {
            format!("{reason} ({register} {})", formats.fixed(*register))
        };
        self.refusals.iter().chain(&self.reservations).map(told).collect()
    }
}

impl Formats<'_> {
    /// The register with the largest last bit among some.
    pub(super) fn coarsest(&self, registers: &[Register]) -> Register {
        self.least(registers, |register| -self.fixed(register).ulp())
    }

    /// The register with the smallest range among some, and the largest magnitude that the plan
    /// allows it.
    pub(super) fn shortest(&self, registers: &[Register]) -> (Register, f64) {
        let register = self.least(registers, |register| self.fixed(register).limit());
        (register, self.fixed(register).limit().min(LARGEST_PLACE))
    }

    fn least(&self, registers: &[Register], measure: impl Fn(Register) -> f64) -> Register {
        let less = |a, b| if measure(b) < measure(a) { b } else { a };
        registers.iter().copied().fold(registers[0], less)
    }

    /// How far a view register is off at most on the screen (equation 29).
    pub(super) fn view_drift(&self, geometry: &Geometry, register: Register) -> f64 {
        let last = geometry.columns - 1 + (geometry.lines - 1);
        (1.0 + f64::from(last)) * self.fixed(register).ulp() / 2.0
    }

    /// What does not hold of the accumulators of the view: coefficients are below two, and half a
    /// bit off each; `pixels` says what an error of the registers is on the screen.
    pub(super) fn view_refusals(
        &self,
        geometry: &Geometry,
        registers: &[Register],
        pixels: impl FnOnce(f64) -> f64,
    ) -> impl Iterator<Item = Refusal> {
        let (shortest, limit) = self.shortest(registers);
        let range = (limit < 2.0).then(|| Refusal {
            field: "format",
            reason: format!("coefficients of the view may reach 2, the registers hold {limit}"),
            remedy: "give two bits before the point",
            register: shortest,
        });
        let coarsest = self.coarsest(registers);
        let drift = pixels(self.view_drift(geometry, coarsest));
        let rounding = (drift > 1.0 / 128.0).then(|| Refusal {
            field: "screen.size",
            reason: "the roundings of the view coefficients add up to more than 1/128 pixel".into(),
            remedy: "draw fewer or coarser pixels",
            register: coarsest,
        });
        range.into_iter().chain(rounding)
    }
}

/// A length as a share of a pixel, given how many of it a pixel has: `1/115 pixel`, or `35.61 pixels` where it is not small.
pub(super) fn in_pixels(per_pixel: f64) -> String {
    if per_pixel >= 10.0 {
        format!("1/{per_pixel:.0} pixel")
    } else {
        format!("{:.2} pixels", 1.0 / per_pixel)
    }
}
