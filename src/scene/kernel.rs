//! `[kernel]`: the finite function that interpolates heights.

use super::kind::Kind;
use super::table::{Declared, table, words};
use super::words::Words;

table! {
    /// The finite function and its deformation.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct Kernel {
        /// The finite function f.
        shape: KernelShape = KernelShape::Cosine, KernelShape::kind();
        /// What is done to f.
        deformation: Deformation = Deformation::default();
        /// Entries of the kernel's table over the unit interval.
        table: u32 = 4096, Kind::PowerOfTwo(16..=65536);
    }
}

words! {
    /// The four finite functions.
    pub enum KernelShape {
        /// `(cos πt + 1)/2`.
        Cosine = "cosine",
        /// `1 − 2t²`, then `2(1−|t|)²`.
        Parabola = "parabola",
        /// `2^−(2t)²`, then `1 − 2^−(2−2|t|)²`.
        Exponential = "exponential",
        /// `1 − |t|`.
        Hat = "hat",
    }
}

impl KernelShape {
    /// Name in scene files.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.word()
    }
}

/// What is done to the finite function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deformation {
    /// 0: the plain finite function over 2×2 nodes.
    None,
    /// 1: `⅔ f(⅔x)` over 3×3 nodes.
    Stretch,
    /// 2: the hat plus `2^-weight_shift` of the difference to f, over 2×2 nodes.
    TowardHat {
        /// d in `a = 2^-d`.
        weight_shift: u32,
    },
}

table! {
    pub(super) struct DeformationKeys {
        /// 0: none; 1: f stretched over 3x3 nodes; 2: between the hat and f.
        deformation: u32 = 2, Kind::Whole(0..=2);
        /// Deformation 2 takes 2^-weight_shift of f, and the rest of the hat.
        weight_shift: u32 = 2, Kind::Whole(0..=64);
    }
}

impl From<DeformationKeys> for Deformation {
    fn from(keys: DeformationKeys) -> Self {
        match keys.deformation {
            0 => Self::None,
            1 => Self::Stretch,
            _ => Self::TowardHat { weight_shift: keys.weight_shift },
        }
    }
}

impl From<Deformation> for DeformationKeys {
    fn from(deformation: Deformation) -> Self {
        match deformation {
            Deformation::None => Self { deformation: 0, ..Self::default() },
            Deformation::Stretch => Self { deformation: 1, ..Self::default() },
            Deformation::TowardHat { weight_shift } => Self { deformation: 2, weight_shift },
        }
    }
}

impl Default for Deformation {
    fn default() -> Self {
        DeformationKeys::default().into()
    }
}

impl Declared for Deformation {
    type By = DeformationKeys;
}
