//! What can be said of a pixel: the wires between units, and what units have inside.

use std::fmt;

use crate::unit::Wire;
use crate::word::Register;

/// An axis of the ground frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// East.
    X,
    /// Up.
    Y,
    /// South.
    Z,
}

/// A quantity of one pixel, the same in every number world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A wire between two units.
    Wire(Wire),
    /// Where the ray starts.
    Start(Axis),
    /// Step of the ray.
    Step(Axis),
    /// Place of the last sample.
    LastSample(Axis),
    /// One of the four nodes h1 to h4 of a cell.
    CellNode(usize),
    /// One of 3×3 nodes, columns and rows from the nearest one.
    Node(i32, i32),
    /// Weight of the node before the place.
    Weight(Axis),
    /// Weight of the node after the place, of 3×3 nodes.
    WeightAfter(Axis),
    /// Derivative of the weight.
    WeightSlope(Axis),
    /// Height as a place on the ramp, in segments.
    RampPlace,
    /// Contrast of a plane's squares.
    Contrast,
}

impl Quantity {
    /// The register that holds it.
    pub fn register(self) -> Register {
        let ground = |axis, x, y, z| match axis {
            Axis::X => x,
            Axis::Y => y,
            Axis::Z => z,
        };
        match self {
            Self::Wire(wire) => wire.register().unwrap_or(Register::Channel),
            Self::Start(axis) | Self::LastSample(axis) => {
                ground(axis, Register::GroundX, Register::RayY, Register::GroundZ)
            }
            Self::Step(axis) => {
                ground(axis, Register::DGroundX, Register::DRayY, Register::DGroundZ)
            }
            Self::CellNode(_) | Self::Node(..) => Register::Node,
            Self::Weight(_) | Self::WeightAfter(_) => Register::Weight,
            Self::WeightSlope(_) => Register::WeightSlope,
            Self::RampPlace => Register::Ramp,
            Self::Contrast => Register::Shade,
        }
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        })
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Wire(wire) => f.write_str(wire.name()),
            Self::Start(axis) => write!(f, "start of the ray, {axis}"),
            Self::Step(axis) => write!(f, "step, {axis}"),
            Self::LastSample(axis) => write!(f, "last sample, {axis}"),
            Self::CellNode(at) => write!(f, "node h{}", at + 1),
            Self::Node(column, row) => write!(f, "node ({column}, {row})"),
            Self::Weight(axis) => write!(f, "weight, {axis}"),
            Self::WeightAfter(axis) => write!(f, "weight after, {axis}"),
            Self::WeightSlope(axis) => write!(f, "weight slope, {axis}"),
            Self::RampPlace => f.write_str("place on the ramp"),
            Self::Contrast => f.write_str("contrast of the squares"),
        }
    }
}
