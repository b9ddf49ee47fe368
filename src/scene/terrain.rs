//! `[[surface]]` with `kind = "terrain"`: a height map interpolated by finite functions.

use std::sync::Arc;

use glam::DVec2;

use super::builtin;
use super::error::SceneError;
use super::field::Fields;
use super::height_map::{Encoding, HeightMap};
use super::kind::{COORDINATE, FARTHEST, Kind, LENGTH, SMALLEST};
use super::maps::MapSource;
use super::nodata::{self, NoData};
use super::shown::shown;
use super::table::{Table, keys, table, words};
use super::words::Words;
use super::writer::Writer;

/// A height map in the scene.
#[derive(Clone, Debug)]
pub struct Terrain {
    /// Which file the map comes from, and how it is read.
    pub source: MapSource,
    /// The samples, with `nodata` carried out: nodes that are NaN are holes.
    pub map: Arc<HeightMap>,
    /// Cell size (Lx, Lz) in scene units, positive.
    pub cell: DVec2,
    /// `y = (sample - offset) * scale`.
    pub offset: f64,
    /// Scene units of height per unit of sample.
    pub scale: f64,
    /// What lies beyond the map.
    pub outside: Outside,
    /// What nodes without data become, as asked for; `map` holds the outcome.
    pub nodata: NoData,
    /// Depth of the block under the lowest node whose sides are drawn, in scene units, positive.
    /// A ray that falls below it outside the map or in a hole sees sky. `None`: a quarter of the height range, two
    /// cells at least.
    pub base_depth: Option<f64>,
}

impl Terrain {
    /// Height of node (column i, row j) in scene units; NaN in a hole.
    pub fn node(&self, i: usize, j: usize) -> f64 {
        self.height(self.map.sample(i, j))
    }

    /// Height in scene units of a map sample.
    pub fn height(&self, sample: f32) -> f64 {
        (f64::from(sample) - self.offset) * self.scale
    }

    /// Lowest and highest node with data in scene units.
    pub fn range(&self) -> (f64, f64) {
        let (low, high) = self.map.range();
        let (a, b) = (self.height(low), self.height(high));
        (a.min(b), a.max(b))
    }

    /// Depth of the block under the lowest node, see [`Terrain::base_depth`].
    pub fn base_depth(&self) -> f64 {
        let (low, high) = self.range();
        self.base_depth.unwrap_or_else(|| ((high - low) / 4.0).max(2.0 * self.cell.max_element()))
    }
}

words! {
    /// What lies beyond the edge nodes of the map.
    pub enum Outside {
        /// Nothing: the map ends at its outermost nodes and its sides are drawn.
        Sky = "sky",
        /// The edge nodes go on for ever.
        Clamp = "clamp",
        /// The map repeats; its period is its number of nodes.
        Wrap = "wrap",
    }
}

impl Words for Encoding {
    const WORDS: &'static [(&'static str, Self)] = &Self::NAMES;
}

table! {
    /// A terrain as the file has it: its map is not read yet.
    pub(super) struct TerrainKeys {
        /// The height map; a relative path starts at the folder of the scene file.
        map: String = "builtin:jacksboro".to_owned(), Kind::Text {
            expected: "the path of a height file, \"builtin:jacksboro\", or \
                       \"builtin:jacksboro@N\" with N x N nodes",
            refusal: "found no name",
            fits: |name| !name.is_empty(),
        };
        /// How samples stand for heights; other than "stored" of a colour PNG.
        encoding: Encoding = Encoding::Stored, Encoding::kind();
        /// Further height files that make one map with it, on one grid; a relative path starts at
        /// the folder of the map.
        tiles: Vec<String> = Vec::new(), Kind::Array("paths", Box::new(Kind::Text {
            expected: "the path of a height file",
            refusal: "found no name",
            fits: |name| !name.is_empty(),
        }), 0..=1024);
        /// A stored sample that marks nodes without data, beside what the file declares.
        nodata_value: Option<f64> = None, Kind::Number(-3.5e38..=3.5e38);
        /// Every n-th node of every n-th row is read: a map has at most 16384 nodes a side and
        /// 67108864 in all.
        thin: u32 = 1, Kind::Whole(1..=1024);
        /// Size of a cell; left out, [1.0, 1.0], and 343 / (N - 1) with "builtin:jacksboro@N".
        cell: Option<DVec2> = None, Kind::pair("[x, z]", SMALLEST..=FARTHEST);
        /// What a sample means: y = (sample - offset) * scale.
        height: Height = Height::default(), Kind::Table(keys::<Height>());
        /// What lies beyond the edge nodes of the map.
        outside: Outside = Outside::Sky, Outside::kind();
        /// What nodes without data become: holes, the nearest sample, or this sample.
        nodata: NoData = NoData::Hole,
            Kind::WordOr(vec!["hole", "nearest"], Box::new(COORDINATE));
        /// Depth of the block under the lowest node; left out, a quarter of the height range, two cells
        /// at least.
        base_depth: Option<f64> = None, LENGTH;
    }
}

table! {
    pub(super) struct Height {
        /// The sample at y = 0.
        offset: f64 = 236.0, COORDINATE;
        /// Scene units of height per unit of sample.
        scale: f64 = 0.025, LENGTH;
    }
}

impl Terrain {
    /// Reads the keys, then the map that they name.
    pub(super) fn load(fields: &Fields<'_>) -> Result<Self, SceneError> {
        let TerrainKeys {
            map: file,
            encoding,
            tiles,
            nodata_value,
            thin,
            cell,
            height,
            outside,
            nodata,
            base_depth,
        } = Table::read(fields, TerrainKeys::default())?;
        let source = MapSource { file, tiles, encoding, nodata_value, thin };
        let map = fields.maps().load(&source).map_err(|error| match fields.get("map") {
            Some(field) => {
                SceneError::Map { place: field.place(), field: field.path, source: Box::new(error) }
            }
            None => fields.error("map", error.reason, error.remedy),
        })?;
        let map = nodata::apply(map, nodata);
        let cell = cell.unwrap_or_else(|| default_cell(&source, &map));
        let Height { offset, scale } = height;
        let terrain = Self { source, map, cell, offset, scale, outside, nodata, base_depth };
        check_extent(fields, &terrain)?;
        Ok(terrain)
    }

    pub(super) fn write(&self, out: &mut Writer) {
        let keys = TerrainKeys {
            map: self.source.file.clone(),
            encoding: self.source.encoding,
            tiles: self.source.tiles.clone(),
            nodata_value: self.source.nodata_value,
            thin: self.source.thin,
            cell: (self.cell != default_cell(&self.source, &self.map)).then_some(self.cell),
            height: Height { offset: self.offset, scale: self.scale },
            outside: self.outside,
            nodata: self.nodata,
            base_depth: self.base_depth,
        };
        Table::write(&keys, out);
    }
}

/// One unit; but resampled built-in maps cover the same ground with any number of nodes.
fn default_cell(source: &MapSource, map: &HeightMap) -> DVec2 {
    if source.is_built_in() {
        DVec2::splat(builtin::GROUND / (map.columns() - 1) as f64)
    } else {
        DVec2::ONE
    }
}

/// What only map and fields together can get wrong.
fn check_extent(table: &Fields<'_>, terrain: &Terrain) -> Result<(), SceneError> {
    let (columns, rows) = (terrain.map.columns(), terrain.map.rows());
    let error = |key: &str, reason: String, remedy: &str| match table.get(key) {
        Some(field) => Err(field.error(reason, remedy)),
        None => Err(table.error(key, reason, remedy)),
    };
    if terrain.outside == Outside::Sky && columns.min(rows) < 2 {
        return error(
            "map",
            format!("a map of {columns} x {rows} nodes encloses no ground"),
            "set surface.outside = \"clamp\", or use a map of at least 2 x 2 nodes",
        );
    }
    let extent = terrain.cell * DVec2::new(columns as f64, rows as f64);
    if extent.max_element() > FARTHEST {
        return error(
            "cell",
            format!("the map is {} scene units across", shown(extent.max_element())),
            "give smaller cells: a map reaches 1e9 scene units at most",
        );
    }
    let (low, high) = terrain.range();
    let highest = low.abs().max(high.abs());
    if highest > FARTHEST {
        return error(
            "height",
            format!("heights reach {} scene units", shown(highest)),
            "give a smaller height.scale: heights reach 1e9 scene units at most",
        );
    }
    Ok(())
}
