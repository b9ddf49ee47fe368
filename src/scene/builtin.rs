//! Scenes and maps inside the program.

use std::sync::{Arc, OnceLock};

use super::error::{SceneError, list, nearest};
use super::fractal;
use super::height_map::{HeightMap, MAX_NODES, MapError, refuse_too_large};
use super::shown::shorten;

/// A scene inside the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltinScene {
    /// What the command line calls it.
    pub name: &'static str,
    /// What it shows, in one line.
    pub description: &'static str,
    /// The scene file; written to a folder of the user's, it renders as it is.
    pub toml: &'static str,
}

/// The built-in scenes; the first is the default.
pub const SCENES: [BuiltinScene; 4] = [
    BuiltinScene {
        name: "overview",
        description: "the whole Jacksboro map from above its north edge",
        toml: include_str!("builtin/overview.toml"),
    },
    BuiltinScene {
        name: "flight",
        description: "over the Jacksboro fault, looking north-west",
        toml: include_str!("builtin/flight.toml"),
    },
    BuiltinScene {
        name: "valley",
        description: "just above the ground of a valley, with ridges up to the horizon",
        toml: include_str!("builtin/valley.toml"),
    },
    BuiltinScene {
        name: "plane",
        description: "an endless checkered plane, which needs no map and no stepper",
        toml: include_str!("builtin/plane.toml"),
    },
];

/// Names of the built-in maps, as in `builtin:jacksboro` and `builtin:jacksboro@4096`.
pub const MAPS: [&str; 1] = ["jacksboro"];

static JACKSBORO: &[u8] = include_bytes!("../../assets/jacksboro.png");

/// The built-in scene of that name.
pub fn find(name: &str) -> Option<&'static BuiltinScene> {
    SCENES.iter().find(|scene| scene.name == name)
}

/// Cells along each side of the ground that a built-in map covers, if its own nodes are used.
pub const GROUND: f64 = 343.0;

/// Most nodes a side of a resampled map.
pub const MOST_NODES: usize = MAX_NODES.isqrt() as usize;

/// Seed of the detail of resampled maps, which are the same wherever they are made.
const DETAIL_SEED: u64 = 1;

/// The built-in map of a name; `None` if there is none.
///
/// `NAME@N` is the map resampled to N × N nodes over the same ground, with fractal detail where
/// these are closer than its own.
///
/// # Errors
/// If N is not a number from 2 to [`MOST_NODES`].
pub fn map(name: &str) -> Option<Result<Arc<HeightMap>, MapError>> {
    let (base, nodes) = match name.split_once('@') {
        Some((base, nodes)) => (base, Some(nodes)),
        None => (name, None),
    };
    (base == MAPS[0]).then(|| {
        let map = jacksboro()?;
        let Some(nodes) = nodes else { return Ok(map) };
        let side = side(name, nodes)?;
        let shown = format!("builtin:{}", shorten(name));
        let smaller = |enough: u64| format!("give {base}@{}", side as u64 / enough);
        refuse_too_large(&shown, side as u64, side as u64, smaller)?;
        Ok(Arc::new(fractal::resample(&map, side, DETAIL_SEED)))
    })
}

/// The map as it is, decoded once.
fn jacksboro() -> Result<Arc<HeightMap>, MapError> {
    static DECODED: OnceLock<Result<Arc<HeightMap>, MapError>> = OnceLock::new();
    DECODED
        .get_or_init(|| HeightMap::from_png(JACKSBORO, "builtin:jacksboro").map(Arc::new))
        .clone()
}

/// Nodes a side, from what stands behind `@`.
fn side(name: &str, nodes: &str) -> Result<usize, MapError> {
    let digits = !nodes.is_empty() && nodes.bytes().all(|byte| byte.is_ascii_digit());
    let error = |reason: String| {
        MapError::new(
            &format!("builtin:{}", shorten(name)),
            reason,
            format!(
                "give the nodes a side, from 2 to {MOST_NODES}, as in \"builtin:{}@4096\"",
                MAPS[0]
            ),
        )
    };
    if !digits {
        return Err(error(format!("`{}` is not a number of nodes", shorten(nodes))));
    }
    match nodes.parse() {
        Ok(side @ 2..=MOST_NODES) => Ok(side),
        Ok(0 | 1) => Err(error(format!("{nodes} nodes a side enclose no ground"))),
        _ => Err(error(format!("{} nodes a side are too many", shorten(nodes)))),
    }
}

/// The error for a name that no built-in scene has.
pub fn unknown(name: &str) -> SceneError {
    let names = || SCENES.iter().map(|scene| scene.name);
    SceneError::UnknownScene {
        name: shorten(name),
        suggestion: nearest(name, names()).map(str::to_owned),
        known: list(names()),
    }
}
