//! The divider: ratio unit of the projection.
//!
//! *In hardware*: per axis a non-restoring shift-subtract array, one quotient bit per stage
//! (`word::array`), pipelined to one result per cycle, or serial with one bit per cycle.
//!
//! `ground = eye + view/denominator · 2^exponent` (equation 9 of docs/mathematics.md): the point
//! where the ray meets a plane. On terrain the plane is that of the highest node, where rays
//! enter the slab that the stepper walks through.
//!
//! | wire in | wire out |
//! |---|---|
//! | `view_x`, `view_z`, `denominator` | `entry`; `ground_x`, `ground_z` where it is `Met` |
//!
//! *Named outcomes*: a denominator that is not positive is `Sky`; a quotient out of range is
//! `Far`. *Never*: wraps a quotient, divides by zero.

use super::Line;
use super::line::Entry;
use crate::word::{Divide, Dividing, Ratio, Register, Site, Word, World};

/// How the ratio is taken; both give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// By the non-restoring array, stage by stage.
    Array,
    /// By the host's own division.
    Direct,
}

/// The divider's registers.
#[derive(Clone, Debug)]
pub struct Divider<W: World> {
    /// Foot of the ratio: the eye, x.
    pub eye_x: W::Ground,
    /// The eye, z.
    pub eye_z: W::Ground,
    /// Exponent, range and format of the quotient in x.
    pub ratio_x: Ratio<<W::Ground as Word>::Format>,
    /// The same in z.
    pub ratio_z: Ratio<<W::Ground as Word>::Format>,
    /// Quotient bits: stages of the array.
    pub bits: u32,
}

impl<W: Dividing> Divider<W> {
    /// Drives `entry`, `ground_x` and `ground_z` of one line.
    pub fn run(&self, line: &mut Line<W>, method: Method) {
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
                        line.ground_x[i] = self.eye_x + x;
                        line.ground_z[i] = self.eye_z + z;
                        Entry::Met
                    }
                    _ => Entry::Far,
                }
            } else {
                Entry::Sky
            };
        }
    }
}
