//! Several height files on one grid as one map.

use std::path::{Path, PathBuf};

use glam::DVec2;

use super::error::{MAX_NODES, MAX_SIDE, MapError};
use super::found::HeightFile;
use super::georeference::Georeference;
use super::interpretation::{Interpretation, Thinning};
use super::map::HeightMap;
use super::source;
use crate::scene::shown::{ordinal, quote, shown, shown_path};

/// Cells of tiles differ by no more than this share of one, over a whole tile.
const SAME: f64 = 1e-3;

/// Reads one height file, or several that make one map.
///
/// # Errors
/// As [`source::read`], and if the files do not lie on one grid.
///
/// # Panics
/// If there is no path.
pub fn read(paths: &[PathBuf], asked: &Interpretation) -> Result<HeightFile, MapError> {
    if let [path] = paths {
        return source::read(path, asked);
    }
    // Nodes are left out once, of the whole: tiles thinned alone would not fit.
    let whole = Interpretation { thinning: Thinning::None, ..*asked };
    let tiles = paths
        .iter()
        .map(|path| source::read(path, &whole).map(|file| Tile { path, file }))
        .collect::<Result<Vec<_>, _>>()?;
    assemble(tiles, asked)
}

struct Tile<'a> {
    path: &'a Path,
    file: HeightFile,
}

/// Where a tile lies in the mosaic.
struct Place {
    column: usize,
    row: usize,
}

fn assemble(tiles: Vec<Tile<'_>>, asked: &Interpretation) -> Result<HeightFile, MapError> {
    let name = shown_path(tiles[0].path);
    let (origin, cell) = grid(&tiles[0])?;
    // Places of the tiles in cells from the first one's north-west node.
    let mut corners = Vec::with_capacity(tiles.len());
    for tile in &tiles {
        corners.push(offset(&tiles[0], tile, origin, cell)?);
    }
    let west = corners.iter().map(|corner| corner[0]).min().unwrap_or(0);
    let north = corners.iter().map(|corner| corner[1]).min().unwrap_or(0);
    let places: Vec<Place> = corners
        .iter()
        .map(|corner| Place {
            column: (corner[0] - west) as usize,
            row: (corner[1] - north) as usize,
        })
        .collect();
    let ends = |end: &dyn Fn(&Place, &HeightMap) -> usize| {
        tiles.iter().zip(&places).map(|(tile, at)| end(at, &tile.file.map)).max().unwrap_or(0)
    };
    let columns = ends(&|at, map| at.column + map.columns());
    let rows = ends(&|at, map| at.row + map.rows());
    let every = asked.every(&name, columns as u64, rows as u64)?;
    let (kept_columns, kept_rows) = (columns.div_ceil(every), rows.div_ceil(every));
    let mut samples = vec![f32::NAN; kept_columns * kept_rows];
    let mut differing = 0_usize;
    for (tile, at) in tiles.iter().zip(&places) {
        let map = &tile.file.map;
        for row in (at.row.div_ceil(every)..).take_while(|row| row * every < at.row + map.rows()) {
            let columns = at.column.div_ceil(every)..(at.column + map.columns()).div_ceil(every);
            for column in columns {
                let sample = map.sample(column * every - at.column, row * every - at.row);
                let node = &mut samples[row * kept_columns + column];
                if node.is_nan() {
                    *node = sample;
                } else if !sample.is_nan() && sample != *node {
                    differing += 1;
                }
            }
        }
    }
    let count = tiles.len();
    let mut notes: Vec<String> = Vec::new();
    notes.push(format!("{count} files make one map of {columns} x {rows} nodes"));
    if every > 1 {
        let nth = ordinal(every as u64);
        notes.push(format!("every {nth} node of every {nth} row of it is read"));
    }
    if differing > 0 {
        notes.push(format!(
            "{differing} nodes have another height in a later file: that of the first counts"
        ));
    }
    for note in tiles.iter().flat_map(|tile| &tile.file.notes) {
        if !notes.contains(note) {
            notes.push(note.clone());
        }
    }
    let first = tiles.into_iter().next().map(|tile| tile.file);
    let Some(HeightFile { georeference, storage, nodata, .. }) = first else {
        unreachable!("there is a first one");
    };
    let corner = DVec2::new(west as f64, -(north as f64));
    Ok(HeightFile {
        map: HeightMap::new(kept_columns, kept_rows, samples),
        georeference: Georeference {
            origin: Some(origin + corner * cell),
            cell: Some(cell * every as f64),
            ..georeference
        },
        storage,
        whole: (columns, rows),
        every,
        nodata,
        notes,
    })
}

/// Origin and cell of a tile.
fn grid(tile: &Tile<'_>) -> Result<(DVec2, DVec2), MapError> {
    let Georeference { origin, cell, .. } = tile.file.georeference;
    origin.zip(cell).ok_or_else(|| {
        MapError::new(
            &shown_path(tile.path),
            "it does not say where it lies, so it cannot be put beside others",
            "give files with a georeference, or this one alone",
        )
    })
}

/// The place of a tile in cells, eastward and southward from the first one.
fn offset(
    first: &Tile<'_>,
    tile: &Tile<'_>,
    origin: DVec2,
    cell: DVec2,
) -> Result<[i64; 2], MapError> {
    let (own_origin, own_cell) = grid(tile)?;
    let (a, b) = (&first.file.georeference, &tile.file.georeference);
    let other = |what: String| {
        let (one, two) = (first.path.display().to_string(), tile.path.display().to_string());
        Err(MapError::new(
            &shown_path(tile.path),
            format!("it does not fit {}: {what}", shown_path(first.path)),
            format!("put them on one grid: gdalwarp {} {} mosaic.tif", quote(&one), quote(&two)),
        ))
    };
    if a.epsg.zip(b.epsg).is_some_and(|(a, b)| a != b) {
        return other("its coordinate system is another one".to_owned());
    }
    if a.coordinates != b.coordinates {
        return other("its coordinates count something else".to_owned());
    }
    let height = |georeference: &Georeference| georeference.height_unit_m.unwrap_or(1.0);
    if height(a) != height(b) {
        return other("its heights have another unit".to_owned());
    }
    let nodes = DVec2::new(tile.file.map.columns() as f64, tile.file.map.rows() as f64);
    if ((own_cell - cell).abs() * nodes / cell).max_element() > SAME {
        let (x, z) = (shown(own_cell.x), shown(own_cell.y));
        return other(format!(
            "its cells are {x} x {z}, not {} x {}",
            shown(cell.x),
            shown(cell.y)
        ));
    }
    let away = (own_origin - origin) / cell * DVec2::new(1.0, -1.0);
    let whole = away.round();
    if (away - whole).abs().max_element() > SAME.max(1e-9 * away.abs().max_element()) {
        return other("its nodes lie between the nodes of the other".to_owned());
    }
    if whole.abs().max_element() > f64::from(MAX_SIDE) * 64.0 {
        return other(format!(
            "it is {} cells away; a map has at most {MAX_SIDE} nodes a side and {MAX_NODES} in all",
            shown(whole.abs().max_element())
        ));
    }
    Ok([whole.x as i64, whole.y as i64])
}
