//! The tables of a scene, in the order of the file.

use super::camera::Camera;
use super::error::SceneError;
use super::field::Fields;
use super::format::{FormatRequest, read_formats, write_formats};
use super::hardware::Hardware;
use super::kernel::Kernel;
use super::kind::{Key, Kind, LENGTH};
use super::light::{Colors, Light};
use super::screen::{self, Screen};
use super::stepper::Stepper;
use super::surface::{self, Surface};
use super::table::{Table, keys, names, open, table};
use super::terrain::Terrain;
use super::writer::Writer;
use crate::word::Registers;

/// A complete scene: camera, screens, surfaces, and the machine that draws it.
#[derive(Clone, Debug)]
pub struct Scene {
    /// File stem or built-in name, for reports.
    pub name: String,
    /// Metres per scene unit; reports only.
    pub unit_m: f64,
    /// Seed of everything drawn at random (stochastic rounding, sample choice).
    pub seed: u64,
    /// Where the craft is and how it is turned.
    pub camera: Camera,
    /// One screen per channel, at least one.
    pub screens: Vec<Screen>,
    /// What the rays meet, at least one: of several the nearest shows, of equally near ones the
    /// first.
    pub surfaces: Vec<Surface>,
    /// The finite function that interpolates heights.
    pub kernel: Kernel,
    /// How a ray walks over the map.
    pub stepper: Stepper,
    /// Direction and share of the light.
    pub light: Light,
    /// Colours as sRGB bytes.
    pub color: Colors,
    /// Clock and memory of the emulated machine.
    pub machine: Hardware,
    /// Overrides of the stock register formats: class or register name, format. Sweep world only.
    pub formats: Vec<(Registers, FormatRequest)>,
}

table! {
    /// The keys above all tables.
    struct Head {
        /// Metres per scene unit, for reports.
        unit_m: f64 = 80.0, LENGTH;
        /// Seed of everything drawn at random.
        seed: u64 = 1, Kind::Whole(0..=i64::MAX);
    }
}

/// The keys of one table of a scene.
#[derive(Clone, Debug)]
pub struct Section {
    /// As `--set` takes it; empty above all tables.
    pub path: String,
    /// What a document calls the table.
    pub head: String,
    /// The keys, in the order of the file.
    pub keys: Vec<Key>,
}

/// All tables of a scene, those in braces behind the ones that they stand in.
pub fn sections() -> Vec<Section> {
    let tables = [
        ("", "Above all tables", keys::<Head>()),
        ("camera", "`[camera]`", keys::<Camera>()),
        ("screen", "`[[screen]]`", keys::<Screen>()),
        ("surface", "`[[surface]]`, kind \"terrain\"", surface::Kind::Terrain.keys()),
        ("surface", "`[[surface]]`, kind \"plane\"", surface::Kind::Plane.keys()),
        ("kernel", "`[kernel]`", keys::<Kernel>()),
        ("stepper", "`[stepper]`", keys::<Stepper>()),
        ("light", "`[light]`", keys::<Light>()),
        ("color", "`[color]`", keys::<Colors>()),
        ("machine", "`[machine]`", keys::<Hardware>()),
        ("format.NAME", "`[format]`, by register or class", keys::<FormatRequest>()),
    ];
    let mut sections = Vec::new();
    for (path, head, keys) in tables {
        let braces = keys.iter().filter_map(|key| match &key.kind {
            Kind::Table(inner) => Some(Section {
                path: format!("{path}.{}", key.name),
                head: format!("`{}` of {head}", key.name),
                keys: inner.clone(),
            }),
            _ => None,
        });
        let braces: Vec<Section> = braces.collect();
        sections.push(Section { path: path.to_owned(), head: head.to_owned(), keys });
        sections.extend(braces);
    }
    sections
}

/// The path of every table and key.
pub(super) fn paths() -> Vec<String> {
    let paths = sections().into_iter().flat_map(|Section { path, keys, .. }| {
        let under = |key: &Key| format!("{path}.{}", key.name).trim_start_matches('.').to_owned();
        let keys: Vec<String> = keys.iter().map(under).collect();
        std::iter::once(path).chain(keys)
    });
    paths.collect()
}

impl Scene {
    /// A scene of defaults around a surface.
    pub fn of(surface: Surface) -> Self {
        let Head { unit_m, seed } = Head::default();
        Self {
            name: String::new(),
            unit_m,
            seed,
            camera: Camera::default(),
            screens: vec![Screen::default()],
            surfaces: vec![surface],
            kernel: Kernel::default(),
            stepper: Stepper::default(),
            light: Light::default(),
            color: Colors::default(),
            machine: Hardware::default(),
            formats: Vec::new(),
        }
    }

    /// Its height map, the first one of several.
    pub fn terrain(&self) -> Option<&Terrain> {
        self.surfaces.iter().find_map(Surface::terrain)
    }

    /// The same, to change it.
    pub fn terrain_mut(&mut self) -> Option<&mut Terrain> {
        self.surfaces.iter_mut().find_map(Surface::terrain_mut)
    }

    /// Reads a scene from its top level.
    pub(super) fn read(name: &str, top: &Fields<'_>) -> Result<Self, SceneError> {
        let tables = ["camera", "screen", "surface", "kernel", "stepper", "light", "color"];
        let known = [&names::<Head>()[..], &tables, &["machine", "format"]].concat();
        top.check_keys(&known, |_| false)?;
        let Head { unit_m, seed } = Table::read(top, Head::default())?;
        Ok(Self {
            name: name.to_owned(),
            unit_m,
            seed,
            camera: read(top, "camera")?,
            screens: screen::read(top)?,
            kernel: read(top, "kernel")?,
            stepper: read(top, "stepper")?,
            light: read(top, "light")?,
            color: read(top, "color")?,
            machine: read(top, "machine")?,
            formats: read_formats(top)?,
            // Last, because the map may be large: every other mistake is found before it is read.
            surfaces: surface::read(top)?,
        })
    }

    pub(super) fn write(&self, out: &mut Writer) {
        Table::write(&Head { unit_m: self.unit_m, seed: self.seed }, out);
        write(out, "[camera]", &self.camera);
        for screen in &self.screens {
            write(out, "[[screen]]", screen);
        }
        for surface in &self.surfaces {
            surface.write(out);
        }
        write(out, "[kernel]", &self.kernel);
        write(out, "[stepper]", &self.stepper);
        write(out, "[light]", &self.light);
        write(out, "[color]", &self.color);
        write(out, "[machine]", &self.machine);
        write_formats(&self.formats, out);
    }
}

fn read<T: Table>(top: &Fields<'_>, key: &str) -> Result<T, SceneError> {
    top.get(key)
        .map_or_else(|| Ok(T::default()), |field| T::read(&open::<T>(&field)?, T::default()))
}

fn write(out: &mut Writer, head: &str, table: &impl Table) {
    out.head(head);
    table.write(out);
}
