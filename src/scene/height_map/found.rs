//! What a reader hands out: samples, their place, and how the file stores them.

use super::error::MapError;
use super::georeference::Georeference;
use super::map::HeightMap;
use crate::scene::words::Words;

/// How the samples of a file stand for heights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// A sample is a height.
    #[default]
    Stored,
    /// Colour PNG: `-10000 + (R·65536 + G·256 + B)/10` metres.
    TerrainRgb,
    /// Colour PNG: `R·256 + G + B/256 - 32768` metres.
    Terrarium,
}

impl Encoding {
    /// Names in scene files and on the command line.
    pub const NAMES: [(&'static str, Self); 3] = [
        ("stored", Self::Stored),
        ("terrain-rgb", Self::TerrainRgb),
        ("terrarium", Self::Terrarium),
    ];

    /// Name in scene files.
    pub fn name(self) -> &'static str {
        self.word()
    }
}

/// How a file stores its samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Storage {
    /// Name of the format.
    pub format: &'static str,
    /// Type of a sample.
    pub sample: &'static str,
    /// Compression and predictor, where the format has a choice.
    pub compression: Option<String>,
    /// Strips or tiles, where the format has a choice.
    pub layout: Option<String>,
    /// Byte order, where the format has a choice.
    pub byte_order: Option<&'static str>,
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
    /// The value that marks nodes without data, if the file declares one.
    pub nodata: Option<f64>,
    /// What was assumed, changed or left out, a sentence each.
    pub notes: Vec<String>,
}

/// What a reader has found, before it is known to be a map.
pub(super) struct Found {
    pub(super) columns: usize,
    pub(super) rows: usize,
    pub(super) samples: Vec<f32>,
    pub(super) storage: Storage,
    pub(super) georeference: Georeference,
}

impl Found {
    /// Makes infinite samples nodes without data, and refuses a map of nothing else.
    pub(super) fn finish(
        mut self,
        name: &str,
        nodata: Option<f64>,
        mut notes: Vec<String>,
    ) -> Result<HeightFile, MapError> {
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
                "no node has data",
                "give a file with heights, or correct its no-data value",
            ));
        }
        if infinite > 0 {
            notes.push(format!("{infinite} infinite samples count as nodes without data"));
        }
        let map = HeightMap::new(self.columns, self.rows, self.samples);
        notes.extend(suspicion(&map));
        Ok(HeightFile {
            map,
            georeference: self.georeference,
            storage: self.storage,
            nodata,
            notes,
        })
    }
}

/// A lowest sample that usually means "no data", where the file does not declare it.
fn suspicion(map: &HeightMap) -> Option<String> {
    let low = map.range().0;
    // No ground lies 12 km under the sea, and the usual marks all lie below that but -9999.
    let usual = low == -9999.0 || low == -32768.0 || low == -32767.0 || low < -1e30;
    usual.then(|| {
        format!(
            "the lowest sample is {low:?}, which often marks nodes without data, but the file does \
             not declare it"
        )
    })
}
