//! Options that settle what a height file leaves open.

use clap::Args;

use super::Stop;
use crate::scene::height_map::{CoordinateUnit, length};
use crate::scene::{Encoding, Interpretation, quote};

/// What a user says of a height file. It counts more than what the file says.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Height files")]
pub struct Reading {
    /// What the file's coordinates count: `m`, `ft`, `us-ft`, `deg`, another unit of length, or the
    /// metres of one.
    #[arg(long, value_name = "UNIT", value_parser = CoordinateUnit::parse)]
    pub unit: Option<CoordinateUnit>,

    /// What its heights count: `m`, `ft`, `us-ft`, another unit of length, or the metres of one.
    #[arg(long, value_name = "UNIT", value_parser = length)]
    pub height_unit: Option<f64>,

    /// The stored sample that marks nodes without data, beside what the file declares.
    #[arg(long, value_name = "SAMPLE", allow_negative_numbers = true)]
    pub nodata: Option<f64>,

    /// What the colours of a PNG stand for: `terrain-rgb` or `terrarium` for packed heights.
    #[arg(long, value_name = "ENCODING", value_parser = encoding)]
    pub encoding: Option<Encoding>,
}

fn encoding(text: &str) -> Result<Encoding, String> {
    let names = || Encoding::NAMES.map(|(name, _)| name).join(", ");
    Encoding::named(text).ok_or_else(|| format!("give one of {}", names()))
}

impl Reading {
    /// For a file that is read without a scene.
    pub fn interpretation(&self) -> Interpretation {
        Interpretation {
            encoding: self.encoding.unwrap_or_default(),
            nodata: self.nodata,
            unit: self.unit,
            height_unit_m: self.height_unit,
            ..Interpretation::default()
        }
    }

    /// The options that are keys of a scene, as `--set` takes them.
    pub fn sets(&self) -> Vec<String> {
        let encoding = self.encoding.map(|found| format!("surface.encoding={}", found.name()));
        let nodata = self.nodata.map(|sample| format!("surface.nodata_value={sample:?}"));
        encoding.into_iter().chain(nodata).collect()
    }

    /// The options again, as words of a command line.
    pub fn words(&self) -> Vec<String> {
        let unit = self.unit.map(|unit| match unit {
            CoordinateUnit::Degrees => "--unit deg".to_owned(),
            CoordinateUnit::Length(metres) => format!("--unit {metres:?}"),
        });
        let height = self.height_unit.map(|metres| format!("--height-unit {metres:?}"));
        let nodata = self.nodata.map(|sample| format!("--nodata {sample:?}"));
        let encoding = self.encoding.map(|found| format!("--encoding {}", found.name()));
        [unit, height, nodata, encoding].into_iter().flatten().collect()
    }

    /// Refuses options that only height files take, for a scene that is none.
    pub fn refuse(&self, memory: Option<u64>, scene: &str) -> Result<(), Stop> {
        let given = [
            ("--unit", self.unit.is_some()),
            ("--height-unit", self.height_unit.is_some()),
            ("--memory", memory.is_some()),
        ];
        given.iter().find(|(_, given)| *given).map_or(Ok(()), |(option, _)| {
            Err(Stop::BadInput(format!(
                "{option}: {} is no height file; a scene says what its map counts by surface.cell, \
                 surface.height and unit_m, and thins it by surface.thin",
                quote(scene)
            )))
        })
    }
}
