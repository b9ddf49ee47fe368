//! What a user says of a height file beside what the file says itself.

use super::encoding::Encoding;
use super::error::{MAX_NODES, MAX_SIDE, MapError, gdal, least_thinning};
use super::memory;
use super::unit;
use crate::scene::shown::ordinal;

/// What a user says of a height file. It counts more than what the file says itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Interpretation {
    /// How samples stand for heights.
    pub encoding: Encoding,
    /// The stored sample that marks nodes without data, beside what the file declares.
    pub nodata: Option<f64>,
    /// What coordinates count.
    pub unit: Option<CoordinateUnit>,
    /// Metres per unit of height.
    pub height_unit_m: Option<f64>,
    /// Which nodes are kept.
    pub thinning: Thinning,
}

/// Which nodes of a file are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Thinning {
    /// All; a file with more than a map may have is refused.
    #[default]
    None,
    /// Every n-th of every n-th row, from the north-west.
    Every(usize),
    /// So many at most: every n-th of every n-th row for the least n that does.
    Fit(u64),
}

impl Interpretation {
    /// Of files whose samples stand for heights in a way of their own.
    pub fn encoded(encoding: Encoding) -> Self {
        Self { encoding, ..Self::default() }
    }

    /// Which nodes of `columns` x `rows` are kept: every n-th.
    pub(super) fn every(&self, name: &str, columns: u64, rows: u64) -> Result<usize, MapError> {
        let every = match self.thinning {
            Thinning::None => 1,
            Thinning::Every(every) => every.max(1) as u64,
            Thinning::Fit(nodes) => least_thinning(columns, rows, nodes.min(MAX_NODES)),
        };
        let enough = least_thinning(columns, rows, MAX_NODES);
        if every >= enough {
            memory::refuse_too_large(
                name,
                columns.div_ceil(every),
                rows.div_ceil(every),
                |more| {
                    let enough = every * more;
                    format!(
                        "surface.thin = {enough} keeps every {} node, or free some memory (ulimit -v, \
                     other programs)",
                        ordinal(enough)
                    )
                },
            )?;
            return Ok(every as usize);
        }
        Err(MapError::new(
            name,
            format!("the header claims {columns} x {rows} nodes"),
            format!(
                "a map has at most {MAX_SIDE} nodes a side and {MAX_NODES} in all: surface.thin = \
                 {enough} keeps every {} node, and {} averages them",
                ordinal(enough),
                gdal(&format!("gdal_translate -outsize {}% 0 -r average", 100 / enough), name)
            ),
        ))
    }
}

/// What coordinates count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CoordinateUnit {
    /// Degrees of longitude and latitude.
    Degrees,
    /// Lengths, with the metres of one.
    Length(f64),
}

impl CoordinateUnit {
    /// As written on the command line: `deg`, or as [`length`].
    ///
    /// # Errors
    /// If it is neither; the text says what there is.
    pub fn parse(text: &str) -> Result<Self, String> {
        match text.to_lowercase().as_str() {
            "deg" | "degree" | "degrees" => Ok(Self::Degrees),
            _ => length(text).map(Self::Length).map_err(|reason| format!("{reason}, or deg")),
        }
    }
}

/// Metres of a unit of length as written on the command line: its name, or so many metres.
///
/// # Errors
/// If it is neither; the text says what there is.
pub fn length(text: &str) -> Result<f64, String> {
    let number = || text.parse().ok().filter(|&metres: &f64| (1e-12..=1e9).contains(&metres));
    unit::metres(text).or_else(number).ok_or_else(|| {
        "give m, ft, us-ft, km, cm, mm, um, nm, another unit of length, or the metres of one unit"
            .to_owned()
    })
}
