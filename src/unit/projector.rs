//! The projector: view vector and denominator of every pixel by additions.
//!
//! *In hardware*: an accumulator per quantity, each with three coefficient registers. A quantity
//! c linear in the screen, `c(j, k) = start + j·per_line + k·per_column` (equations 5 and 6 of
//! docs/mathematics.md), costs one addition per pixel and one per line.
//!
//! | wire out | class | is |
//! |---|---|---|
//! | `view_x`, `view_y`, `view_z` | view | V of the pixel, in cells and height units |
//! | `denominator` | view | s n·V scaled, positive towards the plane |
//!
//! *Cycles*: one pixel per cycle. *Never*: multiplies, rounds or saturates inside the recurrence,
//! so that entering it at any pixel gives the same bits.

use super::Line;
use crate::word::{Word, World};

/// Coefficients of one accumulator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear<T> {
    /// Value at line 0, column 0.
    pub start: T,
    /// Increment per line.
    pub per_line: T,
    /// Increment per column.
    pub per_column: T,
}

/// The projector's coefficient registers. An accumulator that the scene does not need is absent.
#[derive(Clone, Debug)]
pub struct Projector<W: World> {
    /// View vector, x.
    pub x: Linear<W::View>,
    /// View vector, y; only the stepper needs it.
    pub y: Option<Linear<W::View>>,
    /// View vector, z.
    pub z: Linear<W::View>,
    /// Denominator; only the divider needs it.
    pub denominator: Option<Linear<W::View>>,
}

/// The accumulators at the first column of a line.
#[derive(Clone, Copy, Debug)]
pub struct LineStart<W: World> {
    /// View vector, x.
    pub x: W::View,
    /// View vector, y.
    pub y: Option<W::View>,
    /// View vector, z.
    pub z: W::View,
    /// Denominator.
    pub denominator: Option<W::View>,
}

impl<W: World> Projector<W> {
    /// The accumulators at line 0.
    pub fn first_line(&self) -> LineStart<W> {
        LineStart {
            x: self.x.start,
            y: self.y.map(|c| c.start),
            z: self.z.start,
            denominator: self.denominator.map(|c| c.start),
        }
    }

    /// One line on: one addition per accumulator.
    pub fn next_line(&self, line: &mut LineStart<W>) {
        line.x = line.x + self.x.per_line;
        line.z = line.z + self.z.per_line;
        if let (Some(y), Some(c)) = (&mut line.y, self.y) {
            *y = *y + c.per_line;
        }
        if let (Some(d), Some(c)) = (&mut line.denominator, self.denominator) {
            *d = *d + c.per_line;
        }
    }

    /// Drives the view wires of one line: one addition per accumulator and column.
    ///
    /// The wires take the pixels of `line.column`, in ascending order; the accumulators walk over
    /// every column up to the last one asked for.
    pub fn run(&self, start: &LineStart<W>, line: &mut Line<W>) {
        accumulate(start.x, self.x.per_column, &line.column, &mut line.view_x);
        accumulate(start.z, self.z.per_column, &line.column, &mut line.view_z);
        if let (Some(y), Some(c)) = (start.y, self.y) {
            accumulate(y, c.per_column, &line.column, &mut line.view_y);
        }
        if let (Some(d), Some(c)) = (start.denominator, self.denominator) {
            accumulate(d, c.per_column, &line.column, &mut line.denominator);
        }
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
