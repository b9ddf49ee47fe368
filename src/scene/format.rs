//! Register formats that a scene asks for.

use super::error::{list, nearest};
use crate::word::{Class, Overflow, Registers, Rounding};

/// A register format asked for in `[format]` or by `--format`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormatRequest {
    /// Bits in all, sign included, 2..=62.
    pub width: u32,
    /// Bits after the point, 0..=width.
    pub point: u32,
    /// What happens to bits that do not fit below.
    pub rounding: Rounding,
    /// What happens to values that do not fit above.
    pub overflow: Overflow,
}

/// The registers that a format is asked for by this name.
///
/// # Errors
/// If no register or class has this name, or the register follows another one: reason and remedy.
pub(crate) fn registers(name: &str) -> Result<Registers, (String, String)> {
    let leader = |registers| match registers {
        Registers::One(register) => register.follows(),
        Registers::Class(_) => None,
    };
    let Some(registers) = Registers::from_name(name) else {
        let leading = Registers::all().filter(|registers| leader(*registers).is_none());
        let classes = list(Class::ALL.map(Class::name));
        let remedy = match nearest(name, leading.map(Registers::name)) {
            Some(guess) => format!("did you mean `{guess}`? The classes are {classes}"),
            None => format!("the classes are {classes}; docs/registers.md lists the registers"),
        };
        return Err(("no register or class has this name".to_owned(), remedy));
    };
    match leader(registers) {
        None => Ok(registers),
        Some(leader) => Err((
            format!("this register has the format of {leader}, with which it meets in an adder"),
            format!("set {leader} instead"),
        )),
    }
}
