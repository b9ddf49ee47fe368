//! ESRI ASCII grids: a header of keys and values, then the heights as text, north row first.

use glam::DVec2;

use super::error::{MapError, check_size};
use super::found::{Found, HeightFile, Storage, thinned};
use super::georeference::{Georeference, PixelIs};
use super::interpretation::Interpretation;
use super::marks::Conversion;
use crate::scene::shown::shown;

/// What marks a node without data where the header does not say.
const DEFAULT_NODATA: f64 = -9999.0;

/// A byte order mark that some editors leave at the head of a text.
const MARK: &[u8] = b"\xEF\xBB\xBF";

/// Whether a file begins as such a grid does.
pub(super) fn begins(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(MARK).unwrap_or(bytes).trim_ascii_start();
    let starts = |key: &str| {
        text.get(..key.len()).is_some_and(|head| head.eq_ignore_ascii_case(key.as_bytes()))
    };
    let word = |key: &str| starts(key) && text.get(key.len()).is_some_and(u8::is_ascii_whitespace);
    ["ncols", "nrows", "xll", "yll", "cellsize", "nodata"].into_iter().any(starts)
        || ["dx", "dy"].into_iter().any(word)
}

/// Words of a text and the lines they stand in.
struct Words<'a> {
    name: &'a str,
    rest: &'a [u8],
    /// Of the last word, from 1.
    line: usize,
}

impl<'a> Words<'a> {
    fn next(&mut self) -> Option<&'a [u8]> {
        let space = self.rest.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        self.line += self.rest[..space].iter().filter(|&&byte| byte == b'\n').count();
        self.rest = &self.rest[space..];
        let length = self.rest.iter().take_while(|byte| !byte.is_ascii_whitespace()).count();
        let (word, rest) = self.rest.split_at(length);
        self.rest = rest;
        (!word.is_empty()).then_some(word)
    }

    fn peek(&self) -> Option<&'a [u8]> {
        Words { name: self.name, rest: self.rest, line: 0 }.next()
    }

    fn error(&self, reason: &str, remedy: &str) -> MapError {
        MapError::new(self.name, format!("line {}: {reason}", self.line), remedy)
    }

    /// A word as a number.
    fn number(&self, word: &[u8]) -> Result<f64, MapError> {
        let text = std::str::from_utf8(word).unwrap_or_default();
        if let Ok(number) = text.parse() {
            return Ok(number);
        }
        // C libraries of Windows write NaN in many ways.
        let small = text.to_ascii_lowercase();
        if ["-nan", "1.#qnan", "1.#ind", "nan("].iter().any(|nan| small.contains(nan)) {
            return Ok(f64::NAN);
        }
        let shown: String = String::from_utf8_lossy(word).chars().take(20).collect();
        if word.contains(&b',') && text.replace(',', ".").parse::<f64>().is_ok() {
            return Err(self.error(
                &format!("`{shown}` has a decimal comma"),
                "write decimal points: replace every comma by a point",
            ));
        }
        Err(self.error(
            &format!("`{}` is not a number", shown.escape_debug()),
            "correct this line: header keys and numbers are all that a grid holds",
        ))
    }
}

/// The header: `None` is a key that is not given.
#[derive(Default)]
struct Header {
    columns: Option<f64>,
    rows: Option<f64>,
    x_corner: Option<f64>,
    x_center: Option<f64>,
    y_corner: Option<f64>,
    y_center: Option<f64>,
    size: Option<f64>,
    dx: Option<f64>,
    dy: Option<f64>,
    nodata: Option<f64>,
}

impl Header {
    fn field(&mut self, key: &str) -> Option<&mut Option<f64>> {
        Some(match key {
            "ncols" => &mut self.columns,
            "nrows" => &mut self.rows,
            "xllcorner" => &mut self.x_corner,
            "xllcenter" | "xllcentre" => &mut self.x_center,
            "yllcorner" => &mut self.y_corner,
            "yllcenter" | "yllcentre" => &mut self.y_center,
            "cellsize" => &mut self.size,
            "dx" => &mut self.dx,
            "dy" => &mut self.dy,
            "nodata_value" | "nodata" => &mut self.nodata,
            _ => return None,
        })
    }

    /// Reads keys and values up to the first height.
    fn read(words: &mut Words<'_>) -> Result<Self, MapError> {
        const KEYS: &str = "a grid begins with ncols, nrows, xllcorner or xllcenter, yllcorner or \
                            yllcenter, cellsize (or dx and dy) and perhaps NODATA_value";
        let mut header = Self::default();
        loop {
            let letter = |word: &[u8]| word.first().is_some_and(u8::is_ascii_alphabetic);
            // "nan" is a height, not a key.
            let heights = |word: &[u8]| !letter(word) || words.number(word).is_ok();
            if words.peek().is_none_or(heights) {
                return Ok(header);
            }
            let key = words.next().unwrap_or_default();
            let key = String::from_utf8_lossy(key).to_lowercase();
            let shown: String = key.chars().take(20).flat_map(char::escape_debug).collect();
            let Some(field) = header.field(&key) else {
                return Err(words.error(&format!("unknown key `{shown}`"), KEYS));
            };
            let line = words.line;
            if field.is_some() {
                return Err(words.error(&format!("`{shown}` is given twice"), KEYS));
            }
            let value = words.next().filter(|_| words.line == line);
            let Some(value) = value else {
                words.line = line;
                return Err(words.error(&format!("`{shown}` has no value"), KEYS));
            };
            let number = words.number(value)?;
            if !number.is_finite() && !key.starts_with("nodata") {
                return Err(words.error(&format!("`{shown}` is not finite"), KEYS));
            }
            *field = Some(number);
        }
    }

    fn missing(name: &str, key: &str) -> MapError {
        MapError::new(
            name,
            format!("the header has no `{key}`"),
            format!("add a line with {key} and its value"),
        )
    }

    /// Columns and rows.
    fn counts(&self, name: &str) -> Result<(usize, usize), MapError> {
        let count = |value: Option<f64>, key: &str| -> Result<u64, MapError> {
            let value = value.ok_or_else(|| Self::missing(name, key))?;
            if value.fract() != 0.0 || !(0.0..1e15).contains(&value) {
                return Err(MapError::new(
                    name,
                    format!("{key} is {}", shown(value)),
                    "give a whole number of nodes",
                ));
            }
            Ok(value as u64)
        };
        let (columns, rows) = (count(self.columns, "ncols")?, count(self.rows, "nrows")?);
        check_size(name, columns, rows)?;
        Ok((columns as usize, rows as usize))
    }

    /// Place and cell.
    fn georeference(&self, name: &str, rows: usize) -> Result<Georeference, MapError> {
        let cell = match (self.size, self.dx, self.dy) {
            (Some(size), None, None) => DVec2::splat(size),
            (None, Some(dx), Some(dy)) => DVec2::new(dx, dy),
            (None, Some(_), None) => return Err(Self::missing(name, "dy")),
            (None, None, Some(_)) => return Err(Self::missing(name, "dx")),
            (None, None, None) => return Err(Self::missing(name, "cellsize")),
            (Some(_), _, _) => {
                return Err(MapError::new(
                    name,
                    "the header gives both cellsize and dx or dy",
                    "keep either cellsize, or dx and dy",
                ));
            }
        };
        if cell.min_element() <= 0.0 {
            return Err(MapError::new(
                name,
                format!("the header claims cells of {} x {}", shown(cell.x), shown(cell.y)),
                "give cells of a size above 0",
            ));
        }
        let low = |corner: Option<f64>, center: Option<f64>, size: f64, axis: &str| match (
            corner, center,
        ) {
            (Some(corner), None) => Ok(corner + size / 2.0),
            (None, Some(center)) => Ok(center),
            (None, None) => Err(Self::missing(name, &format!("{axis}llcorner"))),
            (Some(_), Some(_)) => Err(MapError::new(
                name,
                format!("the header gives both {axis}llcorner and {axis}llcenter"),
                "keep one of them",
            )),
        };
        let west = low(self.x_corner, self.x_center, cell.x, "x")?;
        let south = low(self.y_corner, self.y_center, cell.y, "y")?;
        let origin = DVec2::new(west, south + cell.y * (rows as f64 - 1.0));
        Ok(Georeference {
            origin: Some(origin),
            cell: Some(cell),
            pixel_is: Some(if self.x_center.is_some() { PixelIs::Point } else { PixelIs::Area }),
            ..Georeference::unknown()
        })
    }
}

/// What old programs end a text with.
const CONTROL_Z: u8 = 0x1A;

/// Decodes a grid.
pub(super) fn decode(
    bytes: &[u8],
    name: &str,
    asked: &Interpretation,
) -> Result<HeightFile, MapError> {
    let mut rest = bytes.strip_prefix(MARK).unwrap_or(bytes);
    while let Some((&(CONTROL_Z | 0), before)) = rest.trim_ascii_end().split_last() {
        rest = before;
    }
    let mut words = Words { name, rest, line: 1 };
    let header = Header::read(&mut words)?;
    let (columns, rows) = header.counts(name)?;
    let every = asked.every(name, columns as u64, rows as u64)?;
    let mut notes = Vec::new();
    let georeference = header.georeference(name, rows)?;
    let nodes = columns * rows;
    let cut_short = |words: &Words<'_>, found: &str| {
        words.error(
            &format!("the text ends after {found} of {nodes} heights"),
            "give the whole file, or correct ncols and nrows",
        )
    };
    // A height and the space after it take two bytes at least.
    if words.rest.len() < 2 * nodes - 1 {
        let line = words.line + words.rest.iter().filter(|&&byte| byte == b'\n').count();
        let found = std::iter::from_fn({
            let mut words = Words { name, rest: words.rest, line: 0 };
            move || words.next()
        })
        .count();
        return Err(cut_short(&Words { name, rest: &[], line }, &found.to_string()));
    }
    let nodata = header.nodata.unwrap_or(DEFAULT_NODATA);
    let conversion = Conversion::of_floats(Some(nodata), asked.nodata);
    let mut marked = 0_usize;
    let mut rounded = false;
    let mut samples = Vec::with_capacity(nodes);
    while samples.len() < nodes {
        let Some(word) = words.next() else {
            return Err(cut_short(&words, &samples.len().to_string()));
        };
        let value = words.number(word)?;
        let (height, _) = conversion.height(value);
        marked += usize::from(height.is_nan());
        rounded |= height.abs() > 16_777_216.0 && height.is_finite();
        samples.push(height);
    }
    if words.next().is_some() {
        return Err(words.error(
            &format!("there are more than {columns} x {rows} = {nodes} heights"),
            "correct ncols and nrows, or take the rest away",
        ));
    }
    if header.nodata.is_none() && marked > 0 {
        notes.push(format!("without NODATA_value, {DEFAULT_NODATA} marks nodes without data"));
    }
    if rounded {
        notes.push("heights were rounded to 32-bit floats, which hold 7 digits".to_owned());
    }
    let storage = Storage::of("ESRI ASCII grid", "text");
    let (nodata, samples) = (header.nodata, thinned(samples, columns, every));
    Found {
        columns,
        rows,
        samples,
        storage,
        georeference,
        nodata,
        turned_over: false,
        conversion,
        notes,
    }
    .finish(name, every, asked)
}
