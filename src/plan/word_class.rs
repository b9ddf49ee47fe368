//! The word sizes of the stock worlds.

use crate::word::{Class, Fixed, Register};

/// A word size of the stock world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WordClass {
    /// Name in reports.
    pub name: &'static str,
    /// Bits of a word.
    pub width: u32,
    /// Fraction bits of view registers.
    pub view_point: u32,
    /// Fraction bits of all others.
    pub ground_point: u32,
}

/// Largest magnitude of a place that the machine works with: products in wide words are formed
/// from values of up to 2^24, and nothing needs more.
pub(super) const LARGEST_PLACE: f64 = 16_777_216.0;

impl WordClass {
    /// 32 bits: places to 2048 cells, in steps of 2^-20.
    pub const NARROW: Self = Self { name: "narrow", width: 32, view_point: 30, ground_point: 20 };
    /// 64 bits: places to 2^24 cells, in steps of 2^-24.
    pub const WIDE: Self = Self { name: "wide", width: 64, view_point: 38, ground_point: 24 };

    /// Largest magnitude of a ground or height register that the plan allows.
    pub fn ground_limit(self) -> f64 {
        self.fixed(Register::GroundX).limit().min(LARGEST_PLACE)
    }

    /// Format of a register.
    pub fn fixed(self, register: Register) -> Fixed {
        let point = match register.class() {
            Class::View => self.view_point,
            _ => self.ground_point,
        };
        Fixed { width: self.width, point }
    }
}
