//! Wires and registers as columns and lines of a file.

use super::text::{Coefficient, Heading, Notation, Way};
use crate::frame::Hit;
use crate::unit::Line;
use crate::unit::line::Entry;
use crate::word::{Readout, Register, World};

/// How a wire is read: its bits at a pixel, `None` where they do not matter.
type Read<'a, W> = Box<dyn Fn(&Line<W>, usize) -> Option<i64> + 'a>;

/// A wire of a unit.
pub struct Wire<'a, W: World> {
    /// Its column.
    pub heading: Heading,
    read: Read<'a, W>,
}

/// Columns of the place on the screen.
pub const PLACE: Notation = Notation::unsigned(16);
/// Codes of [`Entry`] and [`Hit`].
pub const OUTCOME: Notation = Notation::unsigned(2);
/// sRGB bytes.
pub const COLOR: Notation = Notation::unsigned(24);
/// Flags.
pub const FLAG: Notation = Notation::unsigned(1);
/// Counts and small whole numbers.
pub const COUNT: Notation = Notation::unsigned(32);
/// Exponents.
pub const EXPONENT: Notation = Notation::signed(16);

/// How a register is written.
pub fn notation<W: World>(world: &W, register: Register) -> Notation {
    // Worlds without bits are refused before anything is written.
    world.fixed(register).map_or(COUNT, Notation::of)
}

/// A coefficient register of the world.
pub fn word<W: World>(
    world: &W,
    register: Register,
    name: impl Into<String>,
    value: impl Readout,
    meaning: &'static str,
) -> Coefficient {
    let value = value.raw().unwrap_or_default();
    Coefficient { name: name.into(), notation: notation(world, register), value, meaning }
}

/// A coefficient that is a whole number.
pub fn number(
    name: impl Into<String>,
    notation: Notation,
    value: impl Into<i64>,
    meaning: &'static str,
) -> Coefficient {
    Coefficient { name: name.into(), notation, value: value.into(), meaning }
}

/// sRGB bytes as one number.
pub fn packed([red, green, blue]: [u8; 3]) -> i64 {
    i64::from(red) << 16 | i64::from(green) << 8 | i64::from(blue)
}

impl<'a, W: World> Wire<'a, W> {
    /// A wire.
    pub fn new(
        way: Way,
        name: &str,
        notation: Notation,
        meaning: &'static str,
        read: impl Fn(&Line<W>, usize) -> Option<i64> + 'a,
    ) -> Self {
        let heading = Heading { way, name: name.into(), notation, meaning };
        Self { heading, read: Box::new(read) }
    }

    /// Its bits in a row, read before or after the unit has run. Hostile rows are no pixels.
    pub fn bits(&self, before: &Line<W>, after: &Line<W>, at: usize, hostile: bool) -> Option<i64> {
        match self.heading.way {
            Way::At if hostile => None,
            Way::Out => (self.read)(after, at),
            Way::At | Way::In | Way::Word => (self.read)(before, at),
        }
    }
}

/// The scan line and column of a pixel.
pub fn place<'a, W: World>() -> Vec<Wire<'a, W>> {
    vec![
        Wire::new(Way::At, "line", PLACE, "scan line from the top", |line, _| {
            Some(line.number.into())
        }),
        Wire::new(Way::At, "column", PLACE, "column from the left", |line, at| {
            Some(line.column[at].into())
        }),
    ]
}

/// Whether the divider has met the plane.
pub fn is_met<W: World>(line: &Line<W>, at: usize) -> bool {
    line.entry[at] == Entry::Met
}

/// Whether the stepper has met the surface or a side.
pub fn is_on_surface<W: World>(line: &Line<W>, at: usize) -> bool {
    matches!(line.hit[at], Hit::Surface | Hit::Side)
}

/// Whether the stepper has met the surface, which is lit.
pub fn is_lit<W: World>(line: &Line<W>, at: usize) -> bool {
    line.hit[at] == Hit::Surface
}

/// A wire of the world by its register and its name on the line, where a condition holds.
macro_rules! wire {
    ($world:expr, $way:ident $register:ident $field:ident $meaning:literal $(if $when:path)?) => {
        Wire::new(
            Way::$way,
            Register::$register.name(),
            notation($world, Register::$register),
            $meaning,
            |line: &Line<W>, at: usize| {
                $(if !$when(line, at) { return None; })?
                line.$field[at].raw()
            },
        )
    };
}
pub(super) use wire;

/// The outcome of the projection.
pub fn entry<'a, W: World>(way: Way) -> Wire<'a, W> {
    let meaning = "0 met, 1 sky, 2 far";
    Wire::new(way, "entry", OUTCOME, meaning, |line, at| Some(line.entry[at] as i64))
}

/// The outcome of the pixel.
pub fn hit<'a, W: World>(way: Way) -> Wire<'a, W> {
    let meaning = "0 sky, 1 surface, 2 side, 3 far";
    Wire::new(way, "hit", OUTCOME, meaning, |line, at| Some(line.hit[at] as i64))
}

/// The colour.
pub fn color<'a, W: World>() -> Wire<'a, W> {
    let read = |line: &Line<W>, at: usize| Some(packed(line.color[at]));
    Wire::new(Way::Out, "color", COLOR, "red, green, blue, a byte each", read)
}
