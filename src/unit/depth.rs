//! The depth register: which of several surfaces a pixel shows. Fitted behind each of them, where a
//! scene has more than one.
//!
//! *In hardware*: a register with the greatest 1/λ so far, a comparator, and multiplexers for the
//! wires of the surface that it belongs to, which go on with it. 1/λ = G/F of a plane is linear in
//! the screen (equation 8 of docs/mathematics.md; thesis 2.15): it is the denominator, so that the
//! nearest surface is found by additions and comparisons alone. Surfaces scale their denominators by
//! powers of two of their own; a shift brings them to one scale.
//!
//! | wire in | wire out |
//! |---|---|
//! | all of its surface's | `depth`; behind the last surface, all of the nearest one's |
//!
//! Of equally near surfaces the first shows. Where none does, a surface out of range shows rather
//! than sky. *Cycles*: one pixel per cycle. *Never*: divides.

use super::coefficient::Bank;
use super::line::Wire;
use super::{Description, Line, Timing, Unit};
use crate::frame::Hit;
use crate::word::{Register, Site, Word, World};

/// What the depth register is.
pub const DESCRIPTION: Description = Description {
    name: "depth",
    stage: "depth",
    gives: "the nearest surface so far",
    inputs: &[Wire::Hit, Wire::Denominator],
    outputs: &[Wire::Hit, Wire::Depth],
    registers: &[Register::Denominator],
    multiplier: Register::Denominator,
};

/// Cycles of a depth register.
pub const TIMING: Timing = Timing::pipeline(1, 1);

/// The depth register behind one surface.
#[derive(Clone, Copy, Debug)]
pub struct Depth {
    /// Index of the surface.
    pub surface: u32,
    /// Whether it is the last one, behind which the nearest one's wires go on.
    pub last: bool,
    /// Places to shift the denominator right.
    pub shift: u32,
}

impl Depth {
    /// Whether a pixel shows the surface whose wires come in, not the nearest one so far.
    fn is_nearer<W: World>(line: &Line<W>, nearest: &Line<W>, i: usize) -> bool {
        let rank = |hit| match hit {
            Hit::Surface | Hit::Side => 0,
            Hit::OutOfRange => 1,
            Hit::Sky => 2,
        };
        let site = Site::pixel(line.number, line.column[i]).at(Register::Denominator);
        match (rank(line.hit[i]), rank(nearest.hit[i])) {
            (0, 0) => nearest.depth[i].is_below(line.depth[i], site),
            (own, its) => own < its,
        }
    }
}

impl<W: World> Unit<W> for Depth {
    fn description(&self) -> &'static Description {
        &DESCRIPTION
    }

    fn run(&self, line: &mut Line<W>) {
        for i in 0..line.len() {
            line.owner[i] = self.surface;
            line.depth[i] = line.denominator[i].shift_floor(self.shift);
        }
        let Some(mut nearest) = line.nearest.take().filter(|_| self.surface > 0) else {
            line.nearest = Some(Box::new(Line { nearest: None, ..line.clone() }));
            return;
        };
        for i in 0..line.len() {
            if Self::is_nearer(line, &nearest, i) {
                nearest.take_pixel(line, i);
            }
        }
        if self.last {
            std::mem::swap(line, &mut nearest);
            std::mem::swap(&mut line.work, &mut nearest.work);
        }
        line.nearest = Some(nearest);
    }

    fn coefficients(&self, _: &mut Bank<W>) {}

    fn timing(&self, _: u32) -> Timing {
        TIMING
    }
}
