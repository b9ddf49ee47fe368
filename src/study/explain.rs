//! One pixel, register by register, from set-up to colour: fixed, real and oracle side by side.

mod closed;
mod quantity;
pub mod text;
mod trace;

use serde::Serialize;

use super::bounds;
use crate::engine::{Machine, WithSetup as _};
use crate::setup::coefficients::Coefficients;
use crate::setup::{SetupError, table};
use crate::unit::Wire;
use crate::word::Register;
use closed::Closed;
use quantity::{Axis, Quantity};
use trace::{PixelTrace, Reading, Trace};

/// One register of one pixel.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Unit that drives the register.
    pub unit: &'static str,
    /// Name of the quantity.
    pub what: String,
    /// Register whose format it has.
    pub register: &'static str,
    /// Its format, as `Q12.20`, or `f64`.
    pub format: String,
    /// Its bits; none in worlds without bits.
    pub raw: Option<i64>,
    /// Its value in the register's unit.
    pub value: f64,
    /// The same in the real world.
    pub real: Option<f64>,
    /// What the closed form says, where it says something.
    pub oracle: Option<f64>,
    /// Fixed-point value minus real value.
    pub error: Option<f64>,
    /// Derived bound of the error, where there is one.
    pub bound: Option<f64>,
    /// The error is larger than its bound: a register overflowed, or a bound does not hold.
    pub beyond_bound: bool,
    /// Numbers of its equations in docs/mathematics.md.
    pub equations: &'static str,
}

/// One pixel in fixed point, in `f64` and by the oracle, quantity by quantity.
#[derive(Clone, Debug, Serialize)]
pub struct Explanation {
    /// Column of the pixel, from the left.
    pub column: u32,
    /// Line of the pixel, from the top.
    pub line: u32,
    /// Outcome in fixed point.
    pub hit: &'static str,
    /// Outcome in the real world.
    pub real_hit: &'static str,
    /// Outcome of the oracle.
    pub oracle_hit: &'static str,
    /// Index of the sample that hit.
    pub steps: u32,
    /// Skip tests of the pyramid, in fixed point.
    pub skip_tests: u32,
    /// Samples tested on the walk, in fixed point.
    pub samples: u32,
    /// Bisection steps behind the hit, in fixed point.
    pub bisection_steps: u32,
    /// sRGB bytes: fixed.
    pub color: [u8; 3],
    /// sRGB bytes: oracle.
    pub oracle_color: [u8; 3],
    /// Power of two on the view registers, `V 2^e_V` (equation 6; thesis 2.37).
    pub view_exponent: i32,
    /// Power of two on the denominator, `D 2^e_D` (equation 9; thesis 2.39); none where nothing is
    /// divided.
    pub denominator_exponent: Option<i32>,
    /// Why the ray ended at the divider, if it did.
    pub turned_away: Option<&'static str>,
    /// What a hole of the map has to do with the end of the ray, if anything.
    pub hole: Option<&'static str>,
    /// Registers in the order of the data flow.
    pub rows: Vec<Row>,
}

impl Machine<'_> {
    /// Explains a pixel.
    ///
    /// # Errors
    /// If the scene cannot be set up in f64.
    pub fn explain(&self, column: u32, line: u32) -> Result<Explanation, SetupError> {
        let plan = self.plan();
        let fixed = self.run(PixelTrace { column, line, index: None });
        let surface = &plan.surfaces[fixed.owner];
        let real = PixelTrace { column, line, index: Some(fixed.steps) }.run(self.real()?);
        let oracle = self.oracle();
        let sighting = oracle.pixel(line.into(), column.into());
        let closed = Closed {
            scene: self.scene(),
            surface,
            coefficients: Coefficients::new(surface, &plan.geometry),
            direction: oracle.direction(line.into(), column.into()),
            eye: oracle.eye(),
            sighting,
        };
        let rows = fixed
            .readings
            .iter()
            .map(|reading| {
                let register = reading.quantity.register();
                let format = fixed.formats[register as usize];
                let real_value = real.value(reading.quantity);
                let error = real_value.map(|real| reading.value - real);
                let bound = bound(&fixed, reading, &closed.coefficients, column, line);
                Row {
                    unit: reading.unit,
                    what: reading.quantity.to_string(),
                    register: register.name(),
                    format: format.map_or_else(|| "f64".into(), |format| format.to_string()),
                    raw: reading.raw,
                    value: reading.value,
                    real: real_value,
                    oracle: closed.value(reading.quantity),
                    error,
                    bound,
                    beyond_bound: error.zip(bound).is_some_and(|(e, bound)| e.abs() > bound),
                    equations: table::row(register).equations,
                }
            })
            .collect();
        Ok(Explanation {
            column,
            line,
            hit: fixed.hit.name(),
            real_hit: real.hit.name(),
            oracle_hit: sighting.hit.name(),
            steps: fixed.steps,
            skip_tests: fixed.work.skip_tests,
            samples: fixed.work.samples,
            bisection_steps: fixed.work.bisection_steps,
            color: fixed.color,
            oracle_color: sighting.color,
            view_exponent: closed.coefficients.view_exponent,
            denominator_exponent: closed
                .coefficients
                .projection
                .divides
                .then_some(closed.coefficients.denominator_exponent),
            turned_away: fixed.turned_away,
            hole: fixed.hole,
            rows,
        })
    }
}

/// The derived bound of a reading, where there is one.
fn bound(
    trace: &Trace,
    reading: &Reading,
    coefficients: &Coefficients,
    column: u32,
    line: u32,
) -> Option<f64> {
    let format = |register: Register| trace.formats[register as usize];
    let view = |register| format(register).map(|f| bounds::view(f, line, column));
    let exponent = coefficients.denominator_exponent - coefficients.view_exponent;
    let entry = |register, numerator, view_register| {
        let denominator = trace.value(Quantity::Wire(Wire::Denominator))?;
        Some(bounds::entry(
            format(register)?,
            trace.value(Quantity::Wire(numerator))? / denominator * libm::scalbn(1.0, exponent),
            denominator,
            exponent,
            view(view_register)?,
            view(Register::Denominator)?,
        ))
    };
    let ray = |register, start, view_register| {
        let view = view(view_register)?;
        Some(bounds::ray(format(register)?, start, trace.steps, view, trace.exponent))
    };
    let entry_x = || entry(Register::GroundX, Wire::ViewX, Register::ViewX);
    let entry_z = || entry(Register::GroundZ, Wire::ViewZ, Register::ViewZ);
    let half = |register| format(register).map(|f| f.ulp() / 2.0);
    match reading.quantity {
        Quantity::Wire(Wire::ViewX | Wire::ViewY | Wire::ViewZ | Wire::Denominator) => {
            view(reading.quantity.register())
        }
        Quantity::Wire(Wire::EntryX) => entry_x(),
        Quantity::Wire(Wire::EntryZ) => entry_z(),
        Quantity::LastSample(Axis::X) => {
            ray(Register::GroundX, entry_x().or(half(Register::GroundX))?, Register::ViewX)
        }
        Quantity::LastSample(Axis::Z) => {
            ray(Register::GroundZ, entry_z().or(half(Register::GroundZ))?, Register::ViewZ)
        }
        Quantity::LastSample(Axis::Y) => {
            ray(Register::RayY, half(Register::RayY)?, Register::ViewY)
        }
        _ => None,
    }
}
