//! What a reader hands out: samples, their place, and how the file stores them.

use glam::DVec2;

use super::error::MapError;
use super::georeference::{Coordinates, Georeference};
use super::interpretation::Interpretation;
use super::map::HeightMap;
use super::marks::{self, Conversion};
use crate::scene::shown::{ordinal, quote, shown};

/// How a file stores its samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Storage {
    /// Name of the format.
    pub format: &'static str,
    /// What the file was in: `zip` or `gzip`.
    pub packed: Option<&'static str>,
    /// Type of a sample.
    pub sample: &'static str,
    /// Compression and predictor, where the format has a choice.
    pub compression: Option<String>,
    /// Strips or tiles, where the format has a choice.
    pub layout: Option<String>,
    /// Byte order, where the format has a choice.
    pub byte_order: Option<&'static str>,
}

impl Storage {
    /// Of a format without a choice of compression, layout and byte order.
    pub(super) fn of(format: &'static str, sample: &'static str) -> Self {
        Self { format, packed: None, sample, compression: None, layout: None, byte_order: None }
    }
}

/// A height file that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightFile {
    /// The samples, row 0 north; NaN without data.
    pub map: HeightMap,
    /// Where they lie on the Earth, as far as the file says.
    pub georeference: Georeference,
    /// How they are stored.
    pub storage: Storage,
    /// Columns and rows of the file.
    pub whole: (usize, usize),
    /// Coordinates (east, north) of its north-west node.
    pub whole_origin: Option<DVec2>,
    /// Every n-th node of every n-th row of it was read.
    pub every: usize,
    /// The value that marks nodes without data, if the file declares one.
    pub nodata: Option<f64>,
    /// What was assumed, changed or left out, a sentence each.
    pub notes: Vec<String>,
}

/// Why a map of nothing but marks is refused.
pub(super) const NO_DATA: &str = "no node has data";

/// What a reader has found, before it is known to be a map.
pub(super) struct Found {
    /// Columns and rows of the file.
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Heights of the nodes that are kept, row 0 north; NaN where a mark stands.
    pub(super) samples: Vec<f32>,
    pub(super) storage: Storage,
    pub(super) georeference: Georeference,
    /// The mark that the file declares.
    pub(super) nodata: Option<f64>,
    /// The rows of the file run from south to north.
    pub(super) turned_over: bool,
    /// What made heights of the stored samples.
    pub(super) conversion: Conversion,
    pub(super) notes: Vec<String>,
}

/// Keeps every n-th of every n-th row.
pub(super) fn thinned(samples: Vec<f32>, columns: usize, every: usize) -> Vec<f32> {
    if every == 1 {
        return samples;
    }
    let rows = samples.chunks_exact(columns).step_by(every);
    rows.flat_map(|row| row.iter().copied().step_by(every)).collect()
}

impl Found {
    /// What the file has, where every n-th node of every n-th row was kept.
    fn thin(&mut self, every: usize) {
        if every > 1 {
            let nth = ordinal(every as u64);
            self.notes.push(format!(
                "of {} x {} nodes every {nth} of every {nth} row is read",
                self.columns, self.rows
            ));
            let Georeference { origin, cell, .. } = &mut self.georeference;
            if let (true, Some(origin), Some(cell)) = (self.turned_over, origin, cell) {
                // Rows were kept from the southern one on.
                origin.y -= cell.y * ((self.rows - 1) % every) as f64;
            }
            self.columns = self.columns.div_ceil(every);
            self.rows = self.rows.div_ceil(every);
            self.georeference.cell = self.georeference.cell.map(|cell| cell * every as f64);
        }
    }

    /// Of samples of which every n-th was kept: makes infinite ones nodes without data, settles what
    /// the file leaves open, and refuses a map without data.
    pub(super) fn finish(
        mut self,
        name: &str,
        every: usize,
        asked: &Interpretation,
    ) -> Result<HeightFile, MapError> {
        let (whole, whole_origin) = ((self.columns, self.rows), self.georeference.origin);
        self.thin(every);
        let mut infinite = 0_usize;
        let mut data = false;
        for sample in &mut self.samples {
            if sample.is_infinite() {
                infinite += 1;
                *sample = f32::NAN;
            }
            data |= !sample.is_nan();
        }
        if !data {
            return Err(MapError::new(
                name,
                NO_DATA,
                "give a file with heights, or correct its no-data value",
            ));
        }
        let mut notes = self.notes;
        if infinite > 0 {
            let samples = if infinite == 1 { "sample counts" } else { "samples count" };
            notes.push(format!("{infinite} infinite {samples} as no data"));
        }
        let map = HeightMap::new(self.columns, self.rows, self.samples);
        let (low, high) = map.range();
        let relief = f64::from(high) - f64::from(low);
        self.georeference.settle((self.columns, self.rows), relief, asked, &mut notes);
        if let Some(reason) = self.georeference.nonsense(self.columns, self.rows) {
            let ask = match self.georeference.coordinates {
                Coordinates::Degrees => "--unit m says that coordinates are lengths, and ",
                Coordinates::Lengths { .. } | Coordinates::Unknown => "",
            };
            let edit = format!("gdal_edit -a_ullr WEST NORTH EAST SOUTH {}", quote(name));
            return Err(MapError::new(
                name,
                format!("its georeference cannot be used: {reason}"),
                format!("{ask}{edit} gives other corners"),
            ));
        }
        notes.extend(marks::suspicions(&map, &self.conversion));
        if let Some(mark) = asked.nodata {
            notes.push(format!("samples of {} are no data, as asked for", shown(mark)));
        }
        Ok(HeightFile {
            map,
            georeference: self.georeference,
            storage: self.storage,
            whole,
            whole_origin,
            every,
            nodata: self.nodata,
            notes,
        })
    }
}
