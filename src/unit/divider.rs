//! The divider: ratio unit of the projection.
//!
//! *In hardware*: per axis a non-restoring shift-subtract array, one quotient bit per stage
//! (`word::array`), pipelined to one result per cycle, or serial with one bit per cycle.
//!
//! `ground = eye + view/denominator · 2^exponent` (equation 9 of docs/mathematics.md; thesis 2.39):
//! the point where the ray meets a plane. On terrain the plane is that of the highest node, where
//! rays enter the slab that the stepper walks through.
//!
//! | wire in | wire out |
//! |---|---|
//! | `view_x`, `view_z`, `denominator` | `entry`; `entry_x`, `entry_z` where it is `Met` |
//!
//! *Named outcomes*: a denominator that is not positive is `Sky`; a quotient out of range is
//! `OutOfRange`. *Never*: wraps a quotient, divides by zero.

use super::coefficient::{Bank, Coefficient as C};
use super::line::{Entry, Wire};
use super::{Cycles, Description, Line, Timing, Unit};
use crate::word::{Divide, Dividing, Ratio, Register, Site, Word, World};

/// What the divider is.
pub const DESCRIPTION: Description = Description {
    name: "divider",
    stage: "divider",
    gives: "where the ray meets a plane: one ratio per axis",
    inputs: &[Wire::ViewX, Wire::ViewZ, Wire::Denominator],
    outputs: &[Wire::Entry, Wire::EntryX, Wire::EntryZ],
    registers: &[
        Register::ViewX,
        Register::ViewZ,
        Register::Denominator,
        Register::GroundX,
        Register::GroundZ,
    ],
    multiplier: Register::Weight,
};

/// Register stages besides one per quotient bit: shift, bias and range, eye.
pub const ENDS: u32 = 3;

/// Cycles of a divider of this many quotient bits.
pub const fn timing(bits: u32, serial: bool) -> Timing {
    if serial {
        Timing { work: Cycles::every(bits + ENDS), latency: 1, depth: 2 }
    } else {
        Timing::pipeline(1, bits + ENDS)
    }
}

/// How the ratio is taken; both give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// By the non-restoring array, stage by stage.
    Array,
    /// By the host's own division.
    Direct,
}

/// The divider's coefficients.
#[derive(Clone, Debug)]
pub struct Divider<W: World> {
    /// Foot of the ratio: the eye, x.
    pub eye_x: W::Ground,
    /// The eye, z in cells.
    pub eye_z: W::Ground,
    /// Exponent, range and format of the quotient in x.
    pub ratio_x: Ratio<<W::Ground as Word>::Format>,
    /// The same in z.
    pub ratio_z: Ratio<<W::Ground as Word>::Format>,
    /// Places to shift the numerators left before the ratio (right if negative), x and z: the
    /// exponent, and what the points of numerator, denominator and quotient differ by.
    pub shifts: [i32; 2],
    /// Quotient bits, x and z: stages of the array.
    pub bits: [u32; 2],
    /// One stage does all of them, a bit per cycle.
    pub serial: bool,
}

impl<W: Dividing> Divider<W> {
    /// Drives `entry`, `entry_x` and `entry_z` of one line.
    pub fn run_by(&self, method: Method, line: &mut Line<W>) {
        match method {
            Method::Array => self.run_with(line, Divide::divide_array),
            Method::Direct => self.run_with(line, Divide::divide_direct),
        }
    }

    #[inline(always)]
    fn run_with(
        &self,
        line: &mut Line<W>,
        divide: impl Fn(W::View, W::View, Ratio<<W::Ground as Word>::Format>, Site) -> Option<W::Ground>,
    ) {
        for i in 0..line.len() {
            let denominator = line.denominator[i];
            let site = Site::pixel(line.number, line.column[i]);
            line.entry[i] = if denominator.is_positive(site.at(Register::Denominator)) {
                let x =
                    divide(line.view_x[i], denominator, self.ratio_x, site.at(Register::GroundX));
                let z =
                    divide(line.view_z[i], denominator, self.ratio_z, site.at(Register::GroundZ));
                match (x, z) {
                    (Some(x), Some(z)) => {
                        line.entry_x[i] = self.eye_x + x;
                        line.entry_z[i] = self.eye_z + z;
                        Entry::Met
                    }
                    _ => Entry::OutOfRange,
                }
            } else {
                Entry::Sky
            };
        }
    }
}

impl<W: Dividing> Unit<W> for Divider<W> {
    fn description(&self) -> &'static Description {
        &DESCRIPTION
    }

    fn run(&self, line: &mut Line<W>) {
        self.run_by(Method::Array, line);
    }

    fn coefficients(&self, bank: &mut Bank<W>) {
        bank.ground(C::EyeX, self.eye_x);
        bank.ground(C::EyeZ, self.eye_z);
        bank.number(C::RatioShiftX, self.shifts[0]);
        bank.number(C::RatioShiftZ, self.shifts[1]);
        bank.number(C::RatioBitsX, self.bits[0]);
        bank.number(C::RatioBitsZ, self.bits[1]);
    }

    fn timing(&self, _: u32) -> Timing {
        timing(self.quotient_bits(), self.serial)
    }

    /// The axes divide side by side: the longer quotient takes the time.
    fn quotient_bits(&self) -> u32 {
        self.bits[0].max(self.bits[1])
    }
}
