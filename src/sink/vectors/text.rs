//! The text of a vector file: a commented header, rows of hexadecimal words, a checksum. Its page
//! is docs/vectors.md.

use std::fmt::{self, Write as _};
use std::fs::File;
use std::io::{self, BufWriter, Write as _};

use crate::sink::SinkError;
use crate::sink::folder::NewFolder;
use crate::word::Fixed;

/// Version of the format; grows when a reader of the page would misread a file.
pub const VERSION: u32 = 1;

/// How a word is written: as many hexadecimal digits as its bits need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Notation {
    /// Words are two's complement.
    pub signed: bool,
    /// Bits in all.
    pub width: u32,
    /// Bits after the point.
    pub point: u32,
}

impl Notation {
    /// The notation of a register's words.
    pub fn of(fixed: Fixed) -> Self {
        Self { signed: true, width: fixed.width, point: fixed.point }
    }

    /// A whole number that is not negative.
    pub const fn unsigned(width: u32) -> Self {
        Self { signed: false, width, point: 0 }
    }

    /// Whole numbers with a sign.
    pub const fn signed(width: u32) -> Self {
        Self { signed: true, width, point: 0 }
    }

    /// Appends a value's digits; `x` where it does not matter.
    pub fn write(self, value: Option<i64>, out: &mut String) {
        let digits = self.width.div_ceil(4) as usize;
        match value {
            Some(value) => {
                let bits = value as u64 & (u64::MAX >> (64 - self.width));
                let _ = write!(out, "{bits:0digits$x}");
            }
            None => out.extend(std::iter::repeat_n('x', digits)),
        }
    }
}

impl fmt::Display for Notation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.signed { "signed" } else { "unsigned" };
        write!(f, "{sign} {} {}", self.width, self.point)
    }
}

/// What a column is to the unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Which item it is, for people and for the scan.
    At,
    /// It goes into the unit.
    In,
    /// The unit has to answer so.
    Out,
    /// What a memory holds.
    Word,
}

impl Way {
    fn name(self) -> &'static str {
        match self {
            Self::At => "at",
            Self::In => "in",
            Self::Out => "out",
            Self::Word => "word",
        }
    }
}

/// A column of a file.
#[derive(Clone, Debug)]
pub struct Heading {
    /// What it is to the unit.
    pub way: Way,
    /// Name of the column.
    pub name: String,
    /// How its words are written.
    pub notation: Notation,
    /// What its words hold, and when they are valid.
    pub meaning: String,
}

/// A coefficient register with its value.
#[derive(Clone, Debug)]
pub struct Register {
    /// Name of the coefficient.
    pub name: &'static str,
    /// How it is written.
    pub notation: Notation,
    /// Its bits, as loaded for the scene.
    pub value: i64,
    /// What the coefficient is for.
    pub meaning: &'static str,
}

/// The header of a file.
#[derive(Clone, Debug)]
pub struct Header {
    /// Name of the file without its ending.
    pub stem: String,
    /// What it holds, in a sentence.
    pub holds: &'static str,
    /// Further lines, each a key and a value.
    pub lines: Vec<String>,
    /// Coefficient registers of the unit.
    pub registers: Vec<Register>,
    /// Columns of a row, in their order.
    pub columns: Vec<Heading>,
    /// Rows of the scene.
    pub rows: u64,
    /// Corner cases after them.
    pub corner_cases: u64,
}

impl Header {
    /// The text, with lines about the scene that all files share.
    fn text(&self, scene: &[String]) -> String {
        let mut out = format!("// terraline vectors {VERSION}\n// file {}.mem\n", self.stem);
        let _ = writeln!(out, "// holds {}", self.holds);
        for line in scene.iter().chain(&self.lines) {
            let _ = writeln!(out, "// {line}");
        }
        for c in &self.registers {
            let _ = write!(out, "// register {} {} ", c.name, c.notation);
            c.notation.write(Some(c.value), &mut out);
            let _ = writeln!(out, " {}", c.meaning);
        }
        for (at, c) in self.columns.iter().enumerate() {
            let (way, name) = (c.way.name(), &c.name);
            let _ = writeln!(out, "// column {at} {way} {name} {} {}", c.notation, c.meaning);
        }
        let all = self.rows + self.corner_cases;
        let _ = writeln!(out, "// rows {all} {} {}", self.rows, self.corner_cases);
        out
    }
}

/// What was written of a file.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Written {
    /// Name of the file.
    pub file: String,
    /// What the file holds, in half a sentence.
    pub holds: &'static str,
    /// Rows written.
    pub rows: u64,
    /// Words of a row.
    pub columns: usize,
    /// Size of the file.
    pub bytes: u64,
}

/// A file that takes its rows one by one.
#[derive(Debug)]
pub struct Sheet<'a> {
    folder: &'a NewFolder,
    out: BufWriter<File>,
    digest: crc32fast::Hasher,
    notations: Vec<Notation>,
    row: String,
    written: Written,
}

impl<'a> Sheet<'a> {
    /// Begins a file in a folder.
    ///
    /// # Errors
    /// If the operating system refuses.
    pub fn begin(
        folder: &'a NewFolder,
        scene: &[String],
        header: &Header,
    ) -> Result<Self, SinkError> {
        let file = format!("{}.mem", header.stem);
        let out = File::create_new(folder.path().join(&file))
            .map_err(|error| folder.error(&file, error))?;
        let mut sheet = Self {
            folder,
            out: BufWriter::new(out),
            digest: crc32fast::Hasher::new(),
            notations: header.columns.iter().map(|column| column.notation).collect(),
            row: String::new(),
            written: Written {
                file,
                holds: header.holds,
                rows: 0,
                columns: header.columns.len(),
                bytes: 0,
            },
        };
        sheet.row = header.text(scene);
        sheet.put().map_err(|error| sheet.refused(error))?;
        Ok(sheet)
    }

    fn refused(&self, error: io::Error) -> SinkError {
        self.folder.error(&self.written.file, error)
    }

    /// Writes what stands in `row`.
    fn put(&mut self) -> io::Result<()> {
        self.digest.update(self.row.as_bytes());
        self.written.bytes += self.row.len() as u64;
        self.out.write_all(self.row.as_bytes())?;
        self.row.clear();
        Ok(())
    }

    /// Writes a row of values, `None` where they do not matter.
    ///
    /// # Errors
    /// If the operating system refuses.
    pub fn row(&mut self, values: impl IntoIterator<Item = Option<i64>>) -> Result<(), SinkError> {
        for (value, notation) in values.into_iter().zip(&self.notations) {
            if !self.row.is_empty() {
                self.row.push(' ');
            }
            notation.write(value, &mut self.row);
        }
        self.row.push('\n');
        self.written.rows += 1;
        self.put().map_err(|error| self.refused(error))
    }

    /// Writes the checksum and closes the file.
    ///
    /// # Errors
    /// If the operating system refuses.
    pub fn finish(mut self) -> Result<Written, SinkError> {
        self.row = format!("// crc32 {:08x}\n", self.digest.clone().finalize());
        let done = self.put().and_then(|()| self.out.flush());
        done.map_err(|error| self.refused(error))?;
        Ok(self.written)
    }
}
