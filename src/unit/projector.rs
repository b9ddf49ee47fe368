//! The projector: view vector and denominator of every pixel by additions.
//!
//! *In hardware*: an accumulator per quantity, each with three coefficient registers. A quantity
//! c linear in the screen, `c(j, k) = start + j·per_line + k·per_column` (equations 5 and 6 of
//! docs/mathematics.md; thesis 2.36, 2.37), costs one addition per pixel and one per line.
//!
//! | wire out | class | is |
//! |---|---|---|
//! | `view_x`, `view_y`, `view_z` | view | V of the pixel, in cells and height units |
//! | `denominator` | view | s n·V scaled, positive towards the plane |
//!
//! *Cycles*: one pixel per cycle. *Never*: multiplies, rounds or saturates inside the recurrence,
//! so that entering it at any pixel gives the same bits.

use super::coefficient::{Bank, Coefficient as C};
use super::line::{LineStart, Wire};
use super::{Cycles, Description, Line, Timing, Unit};
use crate::word::{Register, Word, World};

/// What the projector is.
pub const DESCRIPTION: Description = Description {
    name: "projector",
    stage: "projector",
    gives: "view vector and denominator of a pixel by additions",
    inputs: &[],
    outputs: &[Wire::ViewX, Wire::ViewY, Wire::ViewZ, Wire::Denominator],
    registers: &[Register::ViewX, Register::ViewY, Register::ViewZ, Register::Denominator],
    multiplier: Register::Weight,
};

/// Cycles of the projector: accumulators add side by side.
pub const TIMING: Timing = Timing { work: Cycles::every(1), latency: 1, depth: 2 };

/// Coefficients of one accumulator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear<T> {
    /// Value at line 0, column 0.
    pub start: T,
    /// Increment from a line to the next.
    pub per_line: T,
    /// Increment from a column to the next.
    pub per_column: T,
}

/// The projector's coefficient registers. An accumulator that the scene does not need is absent.
#[derive(Clone, Debug)]
pub struct Projector<W: World> {
    /// Index of its surface.
    pub surface: usize,
    /// View vector, x.
    pub x: Linear<W::View>,
    /// View vector, y; only the stepper needs it.
    pub y: Option<Linear<W::View>>,
    /// View vector, z.
    pub z: Linear<W::View>,
    /// Denominator; only the divider needs it.
    pub denominator: Option<Linear<W::View>>,
}

impl<W: World> Projector<W> {
    /// The accumulators at line 0.
    pub fn first_line(&self) -> LineStart<W> {
        self.line_start(|c| c.start)
    }

    /// The accumulators where `at` says; one that is absent, which nothing reads, is as x.
    #[inline]
    pub fn line_start(&self, at: impl Fn(&Linear<W::View>) -> W::View) -> LineStart<W> {
        let x = at(&self.x);
        let of = |c: &Option<Linear<W::View>>| c.as_ref().map_or(x, &at);
        LineStart { x, y: of(&self.y), z: at(&self.z), denominator: of(&self.denominator) }
    }

    /// One line on: one addition per accumulator.
    pub fn next_line(&self, line: &mut LineStart<W>) {
        line.x = line.x + self.x.per_line;
        line.z = line.z + self.z.per_line;
        if let Some(c) = self.y {
            line.y = line.y + c.per_line;
        }
        if let Some(c) = self.denominator {
            line.denominator = line.denominator + c.per_line;
        }
    }

    /// The accumulators that are fitted, with the registers that they drive.
    pub fn accumulators(&self) -> impl Iterator<Item = (Register, Linear<W::View>)> {
        let all = [
            (Register::ViewX, Some(self.x)),
            (Register::ViewY, self.y),
            (Register::ViewZ, Some(self.z)),
            (Register::Denominator, self.denominator),
        ];
        all.into_iter().filter_map(|(register, linear)| Some((register, linear?)))
    }
}

impl<W: World> Unit<W> for Projector<W> {
    fn description(&self) -> &'static Description {
        &DESCRIPTION
    }

    fn outputs(&self) -> Vec<Wire> {
        let fitted = [true, self.y.is_some(), true, self.denominator.is_some()];
        let all = DESCRIPTION.outputs.iter().zip(fitted);
        all.filter_map(|(&wire, fitted)| fitted.then_some(wire)).collect()
    }

    /// Drives the view wires of one line: one addition per accumulator and column.
    ///
    /// The wires take the pixels of `line.column`, in ascending order; the accumulators walk over
    /// every column up to the last one asked for.
    fn run(&self, line: &mut Line<W>) {
        let start = line.start[self.surface];
        accumulate(start.x, self.x.per_column, &line.column, &mut line.view_x);
        accumulate(start.z, self.z.per_column, &line.column, &mut line.view_z);
        if let Some(c) = self.y {
            accumulate(start.y, c.per_column, &line.column, &mut line.view_y);
        }
        if let Some(c) = self.denominator {
            accumulate(start.denominator, c.per_column, &line.column, &mut line.denominator);
        }
    }

    fn coefficients(&self, bank: &mut Bank<W>) {
        for (register, linear) in self.accumulators() {
            let [start, per_line, per_column] = match register {
                Register::ViewX => [C::ViewXStart, C::ViewXPerLine, C::ViewXPerColumn],
                Register::ViewY => [C::ViewYStart, C::ViewYPerLine, C::ViewYPerColumn],
                Register::ViewZ => [C::ViewZStart, C::ViewZPerLine, C::ViewZPerColumn],
                _ => [C::DenominatorStart, C::DenominatorPerLine, C::DenominatorPerColumn],
            };
            bank.view(start, linear.start);
            bank.view(per_line, linear.per_line);
            bank.view(per_column, linear.per_column);
        }
    }

    fn timing(&self, _: u32) -> Timing {
        TIMING
    }
}

/// One accumulator along one line.
fn accumulate<T: Word>(start: T, per_column: T, columns: &[u32], wire: &mut [T]) {
    if per_column.is_exactly_zero() {
        // No adder is fitted for an increment of zero.
        wire.fill(start);
        return;
    }
    let mut sum = start;
    let mut at = 0;
    for (out, &column) in wire.iter_mut().zip(columns) {
        while at < column {
            sum = sum + per_column;
            at += 1;
        }
        *out = sum;
    }
}
