//! Several height files on one grid as one map.

use std::path::{Path, PathBuf};

use glam::DVec2;

use super::error::{MAX_NODES, MAX_SIDE, MapError};
use super::found::{HeightFile, NO_DATA};
use super::georeference::{Coordinates, Georeference};
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
    let (mut tiles, mut empty) = (Vec::new(), None);
    for path in paths {
        match source::read(path, &whole) {
            Ok(file) => tiles.push(Tile { path, file }),
            // A tile of the sea beside one of the coast.
            Err(error) if error.reason == NO_DATA => empty = Some(error),
            Err(error) => return Err(error),
        }
    }
    match (tiles.is_empty(), empty) {
        (true, Some(error)) => Err(error),
        (_, empty) => {
            let left_out = empty.map(|_| {
                format!("{} of the files have no data and add nothing", paths.len() - tiles.len())
            });
            assemble(tiles, left_out, asked)
        }
    }
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

fn assemble(
    tiles: Vec<Tile<'_>>,
    left_out: Option<String>,
    asked: &Interpretation,
) -> Result<HeightFile, MapError> {
    let name = shown_path(tiles[0].path);
    let (origin, cell) = grid(&tiles[0])?;
    // Places of the tiles in cells from the first one's north-west node.
    let mut corners = Vec::with_capacity(tiles.len());
    for tile in &tiles {
        corners.push(offset(&tiles[0], tile, origin, cell)?);
    }
    around_the_globe(&mut corners, &tiles[0].file.georeference, cell);
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
    notes.extend(left_out);
    for Tile { file, .. } in &tiles {
        // What is said of the cells of one tile is said below of all.
        let of_cells = file.georeference.ground_remark(file.map.columns(), file.map.rows());
        for note in &file.notes {
            if !notes.contains(note) && Some(note) != of_cells.as_ref() {
                notes.push(note.clone());
            }
        }
    }
    let no_code = tiles.iter().all(|tile| tile.file.georeference.epsg.is_none());
    if no_code && matches!(tiles[0].file.georeference.coordinates, Coordinates::Lengths { .. }) {
        notes.push(
            "the files name no coordinate system by its code: theirs are taken for the same"
                .to_owned(),
        );
    }
    let first = tiles.into_iter().next().map(|tile| tile.file);
    let Some(HeightFile { georeference, storage, nodata, .. }) = first else {
        unreachable!("there is a first one");
    };
    let corner = DVec2::new(west as f64, -(north as f64));
    let georeference = Georeference {
        origin: Some(origin + corner * cell),
        cell: Some(cell * every as f64),
        ..georeference
    };
    notes.extend(georeference.ground_remark(kept_columns, kept_rows));
    Ok(HeightFile {
        map: HeightMap::new(kept_columns, kept_rows, samples),
        georeference,
        storage,
        whole: (columns, rows),
        whole_origin: Some(origin + corner * cell),
        every,
        nodata,
        notes,
    })
}

/// Puts tiles of degrees side by side across the meridian at 180°, where that is nearer.
fn around_the_globe(corners: &mut [[i64; 2]], georeference: &Georeference, cell: DVec2) {
    if georeference.coordinates != Coordinates::Degrees {
        return;
    }
    let turn = (360.0 / cell.x).round() as i64;
    // West of the first one lies what is more than half a turn to its east.
    let near = |column: i64| match column {
        _ if 2 * column > turn => column - turn,
        _ if 2 * column < -turn => column + turn,
        _ => column,
    };
    let width = |place: &dyn Fn(i64) -> i64| {
        let places = || corners.iter().map(|corner| place(corner[0]));
        places().max().zip(places().min()).map_or(0, |(most, least)| most - least)
    };
    if width(&near) < width(&|column| column) {
        corners.iter_mut().for_each(|corner| corner[0] = near(corner[0]));
    }
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
    if a.projection != b.projection || a.ellipsoid != b.ellipsoid {
        return other("its projection or body is another one".to_owned());
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
