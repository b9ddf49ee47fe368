//! Where the maps of a scene come from: files, the program, or a reader that has been there before.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::builtin;
use super::error::nearest;
use super::height_map::{Encoding, HeightMap, Interpretation, MapError, Thinning, mosaic};
use super::shown::shorten;

/// What the name of a map of the program begins with.
pub(super) const BUILTIN: &str = "builtin:";

/// Which file a map comes from, and how it is read.
#[derive(Clone, Debug, PartialEq)]
pub struct MapSource {
    /// As written in the scene: a path or `builtin:NAME`.
    pub file: String,
    /// Further height files that make one map with it; relative paths start at its folder.
    pub tiles: Vec<String>,
    /// How the samples of the file stand for heights.
    pub encoding: Encoding,
    /// The stored sample that marks nodes without data, beside what the file declares.
    pub nodata_value: Option<f64>,
    /// Every n-th node of every n-th row is read.
    pub thin: u32,
}

impl MapSource {
    /// A file read as it is.
    pub fn new(file: impl Into<String>) -> Self {
        Self {
            file: file.into(),
            tiles: Vec::new(),
            encoding: Encoding::Stored,
            nodata_value: None,
            thin: 1,
        }
    }

    /// Whether the map comes from the program.
    pub fn is_built_in(&self) -> bool {
        self.file.starts_with(BUILTIN)
    }

    /// Paths of all its files, for a scene in a folder.
    pub fn paths(&self, folder: &Path) -> Vec<PathBuf> {
        let first = folder.join(&self.file);
        let beside = first.parent().unwrap_or(Path::new("")).to_owned();
        let tiles = self.tiles.iter().map(|tile| beside.join(tile));
        std::iter::once(first.clone()).chain(tiles).collect()
    }

    fn interpretation(&self) -> Interpretation {
        Interpretation {
            nodata: self.nodata_value,
            thinning: Thinning::Every(self.thin as usize),
            ..Interpretation::encoded(self.encoding)
        }
    }
}

/// A map that is in memory already: the scene that names it need not read it again.
#[derive(Clone, Debug)]
pub(super) struct ReadMap {
    /// As the scene names it.
    pub(super) source: MapSource,
    pub(super) map: Arc<HeightMap>,
}

/// Where maps come from.
#[derive(Clone, Copy)]
pub(super) struct Maps<'a> {
    /// Where relative paths start.
    pub(super) folder: &'a Path,
    pub(super) known: Option<&'a ReadMap>,
}

impl Maps<'_> {
    /// The map that a scene names.
    pub(super) fn load(self, source: &MapSource) -> Result<Arc<HeightMap>, MapError> {
        if let Some(known) = self.known
            && known.source == *source
        {
            return Ok(Arc::clone(&known.map));
        }
        let Some(name) = source.file.strip_prefix(BUILTIN) else {
            return mosaic::read(&source.paths(self.folder), &source.interpretation())
                .map(|file| Arc::new(file.map));
        };
        let shown = format!("{BUILTIN}{}", shorten(name));
        let plain = MapSource { nodata_value: source.nodata_value, ..MapSource::new(&source.file) };
        if *source != plain {
            return Err(MapError::new(
                &shown,
                "maps of the program hold heights as they are",
                "leave surface.encoding, tiles and thin out",
            ));
        }
        let map = builtin::map(name).unwrap_or_else(|| {
            let guess = nearest(name, builtin::MAPS).unwrap_or(builtin::MAPS[0]);
            Err(MapError::new(
                &shown,
                "the program has no such map",
                format!("use \"builtin:{guess}\" or the path of a height file"),
            ))
        })?;
        match source.nodata_value {
            None => Ok(map),
            Some(mark) => map.without(mark as f32).map(Arc::new).ok_or_else(|| {
                MapError::new(&shown, "no node has data", "give another surface.nodata_value")
            }),
        }
    }
}
