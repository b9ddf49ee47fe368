//! `[format]`: register formats that a scene asks for.

use super::error::{SceneError, list, nearest};
use super::field::{Field, Fields};
use super::kind::Kind;
use super::table::{Table, braces, open, table};
use super::value::Value;
use super::words::Words;
use super::writer::Writer;
use crate::word::{Class, Overflow, Registers, Rounding};

table! {
    /// A register format asked for in `[format]` or by `--format`. The default is an example.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct FormatRequest {
        /// Bits in all, sign included.
        width: u32 = 32, Kind::Whole(2..=62);
        /// Bits after the point, no more than the width.
        point: u32 = 8, Kind::Whole(0..=62);
        /// What happens to bits that do not fit below: of heights, weights and tones. View, ground and
        /// ray_y are added unrounded: "nearest" alone.
        rounding: Rounding = Rounding::Nearest, Rounding::kind();
        /// What happens to values that do not fit above.
        overflow: Overflow = Overflow::Wrap, Overflow::kind();
    }
}

/// Values with their names.
macro_rules! named {
    ($type:ty) => {{
        let mut words = [("", <$type>::ALL[0]); <$type>::ALL.len()];
        let mut at = 0;
        while at < words.len() {
            words[at] = (<$type>::ALL[at].name(), <$type>::ALL[at]);
            at += 1;
        }
        words
    }};
}

impl Words for Rounding {
    const WORDS: &'static [(&'static str, Self)] = &named!(Rounding);
}

impl Words for Overflow {
    const WORDS: &'static [(&'static str, Self)] = &named!(Overflow);
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

/// Reads `[format]`, whose keys are names of registers or classes, in the order of the file.
pub(super) fn read_formats(
    scene: &Fields<'_>,
) -> Result<Vec<(Registers, FormatRequest)>, SceneError> {
    let Some(field) = scene.get("format") else { return Ok(Vec::new()) };
    let formats = field.open()?;
    let read = |(name, format): (&str, Field<'_>)| {
        let registers = registers(name).map_err(|(reason, remedy)| format.error(reason, remedy))?;
        Ok((registers, request(&format)?))
    };
    formats.all().map(read).collect()
}

fn request(field: &Field<'_>) -> Result<FormatRequest, SceneError> {
    let table = open::<FormatRequest>(field)?;
    if let Some(key) = ["width", "point"].into_iter().find(|key| table.get(key).is_none()) {
        let remedy = "give width and point, as in { width = 48, point = 30 }";
        return Err(field.error(format!("`{key}` is missing"), remedy));
    }
    let request: FormatRequest = Table::read(&table, FormatRequest::default())?;
    if let Some(point) = table.get("point") {
        u32::read(&point, &Kind::Whole(0..=i64::from(request.width)))?;
    }
    Ok(request)
}

/// Writes `[format]`, if there are any.
pub(super) fn write_formats(formats: &[(Registers, FormatRequest)], out: &mut Writer) {
    if formats.is_empty() {
        out.aside(|out| {
            out.head("[format]");
            out.key("ground", &braces(&FormatRequest::default()));
        });
        return;
    }
    out.head("[format]");
    for (index, (registers, request)) in formats.iter().enumerate() {
        // Of several requests for one register the last one counts, as in the program.
        if !formats[index + 1..].iter().any(|(later, _)| later == registers) {
            out.key(registers.name(), &braces(request));
        }
    }
}
