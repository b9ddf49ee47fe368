//! `[machine]` and `[format]`: the emulated processor and its registers.

use super::error::SceneError;
use super::field::{Field, Fields};
use super::kind::{Kind, LENGTH};
use super::table::{Table, braces, open, table, words};
use super::value::{Value, Words};
use super::writer::Writer;
use crate::word::{Overflow, Rounding};

table! {
    /// Clock and memory of the emulated machine, and the word size asked for.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Machine {
        /// Clock in MHz, which cycles are turned into frame rates by.
        clock_mhz: f64 = 100.0, LENGTH;
        /// Cycles from address to data.
        memory_latency: u32 = 2, Kind::Whole(1..=64);
        /// Word size of the stock world; "auto": the smaller one whose ranges and precision the
        /// plan can prove.
        words: WordSize = WordSize::Auto, WordSize::kind();
        /// Form of the divider: pixels are the same, cycles are not.
        ratio: RatioForm = RatioForm::Array, RatioForm::kind();
    }
}

words! {
    /// Form of the divider: quotients and remainders are the same, cycles are not.
    pub enum RatioForm {
        /// A pipelined array, one stage per quotient bit: a pixel per cycle.
        Array = "array",
        /// One stage for all bits, one bit per cycle.
        Serial = "serial",
    }
}

words! {
    /// Word size of the stock world.
    pub enum WordSize {
        /// The smaller one whose ranges and precision the plan can prove.
        Auto = "auto",
        /// 32 bits: 20 after the point on the ground, 30 in the view.
        Narrow = "narrow",
        /// 64 bits: 24 after the point on the ground, 38 in the view.
        Wide = "wide",
    }
}

table! {
    /// A register format asked for in `[format]` or by `--format`. The default is an example.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct FormatRequest {
        /// Bits in all, sign included.
        width: u32 = 32, Kind::Whole(2..=62);
        /// Bits after the point, no more than the width.
        point: u32 = 8, Kind::Whole(0..=62);
        /// What happens to bits that do not fit below.
        rounding: Rounding = Rounding::Floor, Rounding::kind();
        /// What happens to values that do not fit above.
        overflow: Overflow = Overflow::Wrap, Overflow::kind();
    }
}

impl Words for Rounding {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("floor", Self::Floor),
        ("toward_zero", Self::TowardZero),
        ("nearest", Self::Nearest),
        ("nearest_even", Self::NearestEven),
        ("stochastic", Self::Stochastic),
    ];
}

impl Words for Overflow {
    const WORDS: &'static [(&'static str, Self)] =
        &[("wrap", Self::Wrap), ("saturate", Self::Saturate)];
}

/// Reads `[format]`, whose keys are names of registers or classes, in the order of the file. They
/// are checked where the registers are known.
pub(super) fn read_formats(scene: &Fields<'_>) -> Result<Vec<(String, FormatRequest)>, SceneError> {
    let Some(field) = scene.get("format") else { return Ok(Vec::new()) };
    let formats = field.open()?;
    formats.all().map(|(name, format)| Ok((name.to_owned(), request(&format)?))).collect()
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
pub(super) fn write_formats(formats: &[(String, FormatRequest)], out: &mut Writer) {
    if formats.is_empty() {
        out.aside(|out| {
            out.head("[format]");
            out.key("ground", &braces(&FormatRequest::default()));
        });
        return;
    }
    out.head("[format]");
    for (index, (name, request)) in formats.iter().enumerate() {
        // Of several requests for one register the last one counts, as in the program.
        if !formats[index + 1..].iter().any(|(later, _)| later == name) {
            out.key(&key_of(name), &braces(request));
        }
    }
}

/// A name as a key, quoted where it must be.
fn key_of(name: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !name.is_empty() && name.chars().all(is_bare) {
        return name.to_owned();
    }
    let escaped = name.chars().map(|c| match c {
        '"' | '\\' => format!("\\{c}"),
        c if c.is_control() => format!("\\u{:04x}", u32::from(c)),
        c => c.to_string(),
    });
    format!("\"{}\"", escaped.collect::<String>())
}
