//! `[[surface]]`: what the rays meet.

use super::error::SceneError;
use super::field::{Field, Fields};
use super::kind::Key;
use super::plane::Plane;
use super::table::{Declaration, Table, keys, words};
use super::terrain::{Terrain, TerrainKeys};
use super::words::Words;
use super::writer::Writer;

/// What the rays meet.
#[derive(Clone, Debug)]
pub enum Surface {
    /// A height map interpolated by finite functions.
    Terrain(Terrain),
    /// An infinite checkered plane `n·r = d`.
    Plane(Plane),
}

words! {
    /// What a surface is.
    pub(super) enum Kind {
        Terrain = "terrain",
        Plane = "plane",
    }
}

/// The key `kind`.
fn kind() -> Declaration {
    let kind = Kind::kind_without(&["facets", "sphere"]);
    Declaration { name: "kind", docs: &["What the surface is."], kind }
}

impl Kind {
    /// The keys of a surface of this kind.
    pub(super) fn keys(self) -> Vec<Key> {
        let own = match self {
            Self::Terrain => keys::<TerrainKeys>(),
            Self::Plane => keys::<Plane>(),
        };
        [vec![kind().key(&self)], own].concat()
    }

    fn names(self) -> Vec<&'static str> {
        self.keys().iter().map(|key| key.name).collect()
    }
}

/// Reads the `[[surface]]` tables; without any there is one of defaults.
pub(super) fn read(scene: &Fields<'_>) -> Result<Vec<Surface>, SceneError> {
    let tables = scene.get("surface").map(|field| field.tables()).transpose()?;
    match tables.unwrap_or_default().as_slice() {
        [] => Ok(vec![Surface::Terrain(Terrain::load(&scene.empty("surface"))?)]),
        [one] => Ok(vec![Surface::read(one)?]),
        [_, second, ..] => {
            let reason = "a scene with more than one surface is not built yet";
            Err(second.error(reason, "keep one [[surface]]"))
        }
    }
}

impl Surface {
    /// The height map, of a surface that is one.
    pub fn terrain(&self) -> Option<&Terrain> {
        if let Self::Terrain(terrain) = self { Some(terrain) } else { None }
    }

    /// The same, to change it.
    pub fn terrain_mut(&mut self) -> Option<&mut Terrain> {
        if let Self::Terrain(terrain) = self { Some(terrain) } else { None }
    }

    /// Its smallest feature, scene units: the shorter side of a cell or a square.
    pub fn grain(&self) -> f64 {
        match self {
            Self::Terrain(terrain) => terrain.cell.min_element(),
            Self::Plane(plane) => plane.checker,
        }
    }

    /// How far across its features go on, scene units: the map, or a hundred squares of a plane.
    pub fn width(&self) -> f64 {
        match self {
            Self::Terrain(terrain) => {
                let nodes = terrain.map.columns().max(terrain.map.rows()) as f64;
                nodes * terrain.cell.max_element()
            }
            Self::Plane(plane) => 100.0 * plane.checker,
        }
    }

    /// Reads one `[[surface]]` table.
    fn read(field: &Field<'_>) -> Result<Self, SceneError> {
        let table = field.open()?;
        let kind = kind().read(&table, Kind::Terrain)?;
        // A kind chosen by an option leaves behind what the file says about another kind.
        let replaced = table.get("kind").is_some_and(|kind| kind.is_set());
        let others: Vec<&str> = Kind::WORDS.iter().flat_map(|(_, kind)| kind.names()).collect();
        table.check_keys(&kind.names(), |entry| {
            replaced && !entry.node.origin.is_set() && others.contains(&entry.key.as_str())
        })?;
        match kind {
            Kind::Terrain => Terrain::load(&table).map(Self::Terrain),
            Kind::Plane => Plane::normalised(&table).map(Self::Plane),
        }
    }

    /// Writes one `[[surface]]` table.
    pub(super) fn write(&self, out: &mut Writer) {
        out.head("[[surface]]");
        match self {
            Self::Terrain(terrain) => {
                kind().write(&Kind::Terrain, out);
                terrain.write(out);
                out.aside(|out| {
                    out.head("[[surface]]");
                    kind().write(&Kind::Plane, out);
                    Table::write(&Plane::default(), out);
                });
            }
            Self::Plane(plane) => {
                kind().write(&Kind::Plane, out);
                Table::write(plane, out);
            }
        }
    }
}
