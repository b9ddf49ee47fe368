//! A reader of vector files, written from docs/vectors.md alone. It is strict: what the page does
//! not allow is an error.

use std::collections::BTreeMap;
use std::path::Path;

/// How a word is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Notation {
    pub signed: bool,
    pub width: u32,
    pub point: u32,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    pub way: String,
    pub name: String,
    pub notation: Notation,
}

/// A row: `None` for a word of `x`.
pub type Row = Vec<Option<i64>>;

#[derive(Clone, Debug)]
pub struct File {
    pub name: String,
    /// Lines about the scene, by their key.
    pub scene: BTreeMap<String, String>,
    /// Further lines, key first.
    pub further: Vec<String>,
    pub registers: BTreeMap<String, (Notation, i64)>,
    pub columns: Vec<Column>,
    pub rows: Vec<Row>,
    /// Rows of the scene; the others are corner cases.
    pub of_scene: usize,
}

impl File {
    /// Place of a column.
    pub fn at(&self, way: &str, name: &str) -> usize {
        let column = |c: &Column| c.way == way && c.name == name;
        self.columns.iter().position(column).unwrap_or_else(|| panic!("{}: {name}", self.name))
    }

    pub fn has(&self, way: &str, name: &str) -> bool {
        self.columns.iter().any(|c| c.way == way && c.name == name)
    }

    /// Value of a register.
    pub fn register(&self, name: &str) -> i64 {
        self.registers.get(name).unwrap_or_else(|| panic!("{}: {name}", self.name)).1
    }

    /// Values of further lines that begin with a key.
    pub fn lines<'a>(&'a self, key: &'a str) -> impl Iterator<Item = &'a str> {
        self.further.iter().filter_map(move |line| line.strip_prefix(key)?.strip_prefix(' '))
    }
}

fn word(text: &str, notation: Notation) -> Result<Option<i64>, String> {
    let digits = notation.width.div_ceil(4) as usize;
    if text.len() != digits {
        return Err(format!("{text} has not {digits} digits"));
    }
    if text.bytes().all(|c| c == b'x') {
        return Ok(None);
    }
    if !text.bytes().all(|c| matches!(c, b'0'..=b'9' | b'a'..=b'f')) {
        return Err(format!("{text} is not hexadecimal"));
    }
    let bits = u64::from_str_radix(text, 16).map_err(|error| format!("{text}: {error}"))?;
    let spare = 64 - notation.width;
    if bits << spare >> spare != bits {
        return Err(format!("{text} has more than {} bits", notation.width));
    }
    Ok(Some(if notation.signed { (bits << spare) as i64 >> spare } else { bits as i64 }))
}

fn notation(words: &mut dyn Iterator<Item = &str>) -> Option<Notation> {
    let signed = match words.next()? {
        "signed" => true,
        "unsigned" => false,
        _ => return None,
    };
    let width = words.next()?.parse().ok().filter(|width| (1..=64).contains(width))?;
    Some(Notation { signed, width, point: words.next()?.parse().ok()? })
}

/// CRC-32 bit by bit, so that the check is no copy of what it checks.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 }
        })
    })
}

/// Reads a file's text.
pub fn read(name: &str, text: &str) -> Result<File, String> {
    if !text.is_ascii() || !text.ends_with('\n') {
        return Err("not ASCII, or the last line is cut".into());
    }
    let body = text.rfind("// crc32 ").ok_or("no checksum")?;
    if text[body..] != format!("// crc32 {:08x}\n", crc32(&text.as_bytes()[..body])) {
        return Err("the checksum differs".into());
    }
    let mut lines = text[..body].lines().peekable();
    let header = |lines: &mut dyn Iterator<Item = &'_ str>, key: &str| -> Result<String, String> {
        let line = lines.next().ok_or(format!("no {key}"))?;
        let value = line.strip_prefix(&format!("// {key} ")).ok_or(format!("{key}: {line}"))?;
        Ok(value.to_owned())
    };
    if header(&mut lines, "terraline vectors")? != "1" || header(&mut lines, "file")? != name {
        return Err("another version or file".into());
    }
    let mut scene = BTreeMap::new();
    for key in ["holds", "scene", "screen", "program", "world", "pixels", "seed"] {
        scene.insert(key.to_owned(), header(&mut lines, key)?);
    }
    let mut further = Vec::new();
    let is = |line: &&str, key: &str| line.starts_with(&format!("// {key} "));
    while let Some(line) =
        lines.next_if(|line| !["register", "column", "rows"].iter().any(|key| is(line, key)))
    {
        further
            .push(line.strip_prefix("// ").ok_or(format!("a row in the header: {line}"))?.into());
    }
    let mut registers = BTreeMap::new();
    while let Some(line) = lines.next_if(|line| is(line, "register")) {
        let bad = || format!("register: {line}");
        let mut words = line.split(' ').skip(2);
        let name = words.next().ok_or_else(bad)?.to_owned();
        let notation = notation(&mut words).ok_or_else(bad)?;
        let value = word(words.next().ok_or_else(bad)?, notation)?.ok_or_else(bad)?;
        words.next().ok_or_else(bad)?;
        if registers.insert(name, (notation, value)).is_some() {
            return Err(format!("twice: {line}"));
        }
    }
    let mut columns = Vec::new();
    while let Some(line) = lines.next_if(|line| is(line, "column")) {
        let bad = || format!("column: {line}");
        let mut words = line.split(' ').skip(2);
        if words.next() != Some(columns.len().to_string().as_str()) {
            return Err(bad());
        }
        let way = words.next().filter(|way| ["at", "in", "out", "word"].contains(way));
        let way = way.ok_or_else(bad)?.to_owned();
        let name = words.next().ok_or_else(bad)?.to_owned();
        columns.push(Column { way, name, notation: notation(&mut words).ok_or_else(bad)? });
        words.next().ok_or_else(bad)?;
    }
    let counts = header(&mut lines, "rows")?;
    let counts: Vec<usize> = counts.split(' ').filter_map(|n| n.parse().ok()).collect();
    let [all, of_scene, corner_cases] = counts[..] else {
        return Err("rows: three numbers".into());
    };
    let mut rows = Vec::new();
    for line in lines {
        let words: Vec<&str> = line.split(' ').collect();
        if words.len() != columns.len() {
            return Err(format!("row {}: {line}", rows.len()));
        }
        let words = words.iter().zip(&columns).map(|(text, column)| word(text, column.notation));
        rows.push(words.collect::<Result<Row, String>>()?);
    }
    if rows.len() != all || of_scene + corner_cases != all {
        return Err(format!("{} rows of {all}, {of_scene} and {corner_cases}", rows.len()));
    }
    Ok(File { name: name.into(), scene, further, registers, columns, rows, of_scene })
}

/// Reads a folder: every file in it.
pub fn folder(path: &Path) -> Result<BTreeMap<String, File>, String> {
    let mut files = BTreeMap::new();
    for entry in std::fs::read_dir(path).map_err(|error| error.to_string())? {
        let path = entry.map_err(|error| error.to_string())?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let stem = name.strip_suffix(".mem").ok_or(format!("{name} is no file of the page"))?;
        let text = std::fs::read_to_string(&path).map_err(|error| error.to_string())?;
        let file = read(&name, &text).map_err(|error| format!("{name}: {error}"))?;
        files.insert(stem.to_owned(), file);
    }
    Ok(files)
}
