//! `[[surface]]`: what the rays meet.

use std::path::Path;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::array::is_unit;
use super::error::{SceneError, nearest};
use super::field::{FARTHEST, Field, Fields, is_length};
use super::height_map::{Encoding, MapError, source};
use super::keys::{self, Keys};
use super::nodata::apply;
use super::tree::{shorten, shown};
use super::{HeightMap, NoData, Outside, Plane, Surface, Terrain, builtin};

#[derive(Clone, Copy)]
enum Kind {
    Terrain,
    Plane,
    Facets,
    Sphere,
}

/// A map that is in memory already: the scene that names it need not read it again.
#[derive(Clone, Debug)]
pub(super) struct ReadMap {
    /// As the scene names it.
    pub(super) source: String,
    pub(super) encoding: Encoding,
    pub(super) map: Arc<HeightMap>,
}

/// Where maps come from.
#[derive(Clone, Copy)]
pub(super) struct Maps<'a> {
    /// Where relative paths start.
    pub(super) folder: &'a Path,
    pub(super) known: Option<&'a ReadMap>,
}

pub(super) fn read(scene: &Fields<'_>, maps: Maps<'_>) -> Result<Surface, SceneError> {
    let Some(field) = scene.get("surface") else {
        return terrain(&scene.empty("surface"), maps);
    };
    let tables = field.tables()?;
    if let Some(second) = tables.get(1) {
        return Err(second
            .error("a scene with more than one surface is not built yet", "keep one [[surface]]"));
    }
    let Some(field) = tables.first() else {
        return terrain(&scene.empty("surface"), maps);
    };
    let table = field.open()?;
    let kind = table.get("kind");
    let chosen = table.read("kind", Kind::Terrain, |kind| {
        kind.choice(&[
            ("terrain", Kind::Terrain),
            ("plane", Kind::Plane),
            ("facets", Kind::Facets),
            ("sphere", Kind::Sphere),
        ])
    })?;
    // A kind chosen by an option leaves behind what the file says about the other kind.
    let replaced = kind.as_ref().is_some_and(Field::is_set);
    let check = |known: &Keys, other: &Keys| {
        table.check_keys(known, |entry| {
            replaced && !entry.node.origin.is_set() && other.has(&entry.key)
        })
    };
    match chosen {
        Kind::Terrain => {
            check(&keys::TERRAIN, &keys::PLANE)?;
            terrain(&table, maps)
        }
        Kind::Plane => {
            check(&keys::PLANE, &keys::TERRAIN)?;
            plane(&table)
        }
        Kind::Facets | Kind::Sphere => Err(kind
            .unwrap_or_else(|| field.clone())
            .error("surfaces of this kind are not built yet", "use \"terrain\" or \"plane\"")),
    }
}

fn plane(table: &Fields<'_>) -> Result<Surface, SceneError> {
    let normal = table.read("normal", DVec3::Y, Field::direction)?;
    // n·r = d holds for any length of n if d grows with it.
    let length = if is_unit(normal) { 1.0 } else { normal.length() };
    let distance = table.read("distance", 0.0, |distance| {
        distance.number("a number no farther than 1e9 from 0 along the unit normal", |distance| {
            (distance / length).abs() <= FARTHEST
        })
    })?;
    let checker = table.read("checker", 8.0, Field::length)?;
    Ok(Surface::Plane(Plane { normal: normal / length, distance: distance / length, checker }))
}

fn terrain(table: &Fields<'_>, maps: Maps<'_>) -> Result<Surface, SceneError> {
    let cell = table.read("cell", None, |cell| {
        cell.pair("[x, z], two lengths above 0 (from 1e-9 to 1e9)", is_length).map(Some)
    })?;
    let height = table.table("height", &keys::HEIGHT)?;
    let offset = height.read("offset", 236.0, |offset| {
        offset.number("a number from -1e9 to 1e9", |offset| offset.abs() <= FARTHEST)
    })?;
    let scale = height.read("scale", 0.025, Field::length)?;
    let outside = table.read("outside", Outside::Sky, |outside| {
        outside.choice(&[("sky", Outside::Sky), ("clamp", Outside::Clamp), ("wrap", Outside::Wrap)])
    })?;
    let nodata = table.read("nodata", NoData::Hole, nodata)?;
    let base_depth = table.read("base_depth", None, |depth| depth.length().map(Some))?;
    let source = table.read("map", "builtin:jacksboro".to_owned(), |map| {
        let source = map.text(MAP)?;
        if source.is_empty() {
            return Err(map.error("found no name", format!("give {MAP}")));
        }
        Ok(source.to_owned())
    })?;
    let encoding =
        table.read("encoding", Encoding::Stored, |encoding| encoding.choice(&Encoding::NAMES))?;
    let map = load(&source, encoding, maps).map_err(|error| match table.get("map") {
        Some(field) => {
            SceneError::Map { place: field.place(), field: field.path, source: Box::new(error) }
        }
        None => table.error("map", error.reason, error.remedy),
    })?;
    let map = apply(map, nodata);
    let cell = cell.unwrap_or_else(|| default_cell(&source, &map));
    let terrain =
        Terrain { source, map, encoding, cell, offset, scale, outside, nodata, base_depth };
    check_extent(table, &terrain)?;
    Ok(Surface::Terrain(terrain))
}

const MAP: &str =
    "the path of a height file, \"builtin:jacksboro\", or \"builtin:jacksboro@N\" with N x N nodes";

fn nodata(field: &Field<'_>) -> Result<NoData, SceneError> {
    const EXPECTED: &str = "\"hole\", \"nearest\" or a number";
    if field.is_text() {
        field.choice(&[("hole", NoData::Hole), ("nearest", NoData::Nearest)]).map_err(|_| {
            field.error("this is no rule for nodes without data", format!("give {EXPECTED}"))
        })
    } else {
        field.number(EXPECTED, |height| height.abs() <= FARTHEST).map(NoData::Sample)
    }
}

/// One unit; but resampled built-in maps cover the same ground with any number of nodes.
fn default_cell(source: &str, map: &HeightMap) -> DVec2 {
    if source.starts_with(BUILTIN) {
        DVec2::splat(builtin::GROUND / (map.columns() - 1) as f64)
    } else {
        DVec2::ONE
    }
}

const BUILTIN: &str = "builtin:";

fn load(source: &str, encoding: Encoding, maps: Maps<'_>) -> Result<Arc<HeightMap>, MapError> {
    if let Some(known) = maps.known
        && (known.source.as_str(), known.encoding) == (source, encoding)
    {
        return Ok(Arc::clone(&known.map));
    }
    let Some(name) = source.strip_prefix(BUILTIN) else {
        return source::read(&maps.folder.join(source), encoding).map(|file| Arc::new(file.map));
    };
    let shown = format!("{BUILTIN}{}", shorten(name));
    if encoding != Encoding::Stored {
        return Err(MapError::new(
            &shown,
            "maps of the program hold heights as they are",
            "leave surface.encoding out",
        ));
    }
    builtin::map(name).unwrap_or_else(|| {
        let guess = nearest(name, builtin::MAPS).unwrap_or(builtin::MAPS[0]);
        Err(MapError::new(
            &shown,
            "the program has no such map",
            format!("use \"builtin:{guess}\" or the path of a height file"),
        ))
    })
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
