//! Wires and coefficients as columns and lines of a file.

use super::text::{Heading, Notation, Register as Written, Way};
use crate::unit::coefficient::{Bank, Kind};
use crate::unit::{Line, Wire};
use crate::word::{Open, Register, World};

/// Columns of the place on the screen.
pub const PLACE: Notation = Notation::unsigned(16);
/// Codes of outcomes.
const OUTCOME: Notation = Notation::unsigned(2);
/// sRGB bytes.
const COLOR: Notation = Notation::unsigned(24);
/// Notation of a flag: one bit.
pub const FLAG: Notation = Notation::unsigned(1);
/// Counts and small whole numbers.
pub const COUNT: Notation = Notation::unsigned(32);
/// Exponents.
const EXPONENT: Notation = Notation::signed(16);

/// How a register is written.
pub fn notation<W: World>(world: &W, register: Register) -> Notation {
    // Worlds without bits are refused before anything is written.
    world.fixed(register).map_or(COUNT, Notation::of)
}

/// The column of a wire.
pub fn heading<W: World>(world: &W, way: Way, wire: Wire) -> Heading {
    let notation = match wire {
        Wire::Entry | Wire::Hit => OUTCOME,
        Wire::Color => COLOR,
        _ => wire.register().map_or(COUNT, |register| notation(world, register)),
    };
    let meaning = format!("{}{}", wire.meaning(), wire.when().note());
    Heading { way, name: wire.name().into(), notation, meaning }
}

/// The columns of the place on the screen.
pub fn place() -> [Heading; 2] {
    [("line", "scan line from the top"), ("column", "column from the left")].map(
        |(name, meaning)| Heading {
            way: Way::At,
            name: name.into(),
            notation: PLACE,
            meaning: meaning.into(),
        },
    )
}

/// The bits on a wire at a pixel, where they matter.
pub fn bits<W: Open>(line: &Line<W>, wire: Wire, at: usize) -> Option<i64> {
    line.is(wire.when(), at).then(|| line.bits(wire, at)).flatten()
}

/// The coefficients of a bank as lines of a header.
pub fn registers<W: Open>(world: &W, bank: &Bank<W>) -> Vec<Written> {
    let written = |(coefficient, value): (crate::unit::coefficient::Coefficient, i64)| Written {
        name: coefficient.name(),
        notation: match coefficient.kind() {
            Kind::Word(register) => notation(world, register),
            Kind::Flag => FLAG,
            Kind::Code => OUTCOME,
            Kind::Nodes | Kind::Count(_) => COUNT,
            Kind::Exponent => EXPONENT,
            Kind::Color => COLOR,
        },
        value,
        meaning: coefficient.meaning(),
    };
    bank.bits().map(written).collect()
}
