//! A folder of files graded: every row computed again by the units of the emulator, from the
//! inputs in the file; what one unit answers is what the next one gets; memories as they are loaded.

use std::collections::BTreeMap;

use terraline::engine::WithSetup;
use terraline::frame::Hit;
use terraline::plan::Plan;
use terraline::scene::Scene;
use terraline::setup::{Back, Setup, TerrainUnits};
use terraline::sink::vectors::selection::Selection;
use terraline::unit::line::Entry;
use terraline::unit::{Line, checker::Checker};
use terraline::word::{Complete, Load, Readout, Register};

use super::reader::File;
use super::{exact, memories};

/// What is graded.
pub struct Grade<'a> {
    pub scene: &'a Scene,
    pub plan: &'a Plan,
    pub selection: &'a Selection,
    pub files: &'a BTreeMap<String, File>,
    /// Whether products are rounded to nearest, as the exact computation does.
    pub stock: bool,
}

impl WithSetup for Grade<'_> {
    type Output = Result<(), String>;

    fn run<W: Complete>(self, setup: &Setup<W>) -> Self::Output {
        let (scene, plan) = (self.scene, self.plan);
        let files = self.files;
        let names = self.names(setup);
        if !files.keys().eq(names.iter()) {
            return Err(format!("files {:?}, fitted {names:?}", files.keys()));
        }
        for file in files.values() {
            let size = format!("{} {} ", plan.geometry.columns, plan.geometry.lines);
            let said = file.scene["scene"] == scene.name && file.scene["screen"].starts_with(&size);
            if !said || file.scene["pixels"] != self.selection.description {
                return Err(format!("{} is of another scene", file.name));
            }
        }
        self.places()?;
        self.handed_on()?;
        exact::projector(files)?;
        exact::divider(files)?;
        exact::cycles(files)?;
        if self.stock {
            exact::interpolator(files)?;
        }
        self.units(setup)?;
        if let Some(units) = setup.surfaces[0].back.terrain() {
            memories::check(files, units)?;
        }
        Ok(())
    }
}

/// Hits by their code.
const HITS: [Hit; 4] = [Hit::Sky, Hit::Surface, Hit::Side, Hit::OutOfRange];
/// Entries by their code.
const ENTRIES: [Entry; 3] = [Entry::Met, Entry::Sky, Entry::OutOfRange];

impl Grade<'_> {
    /// Files that the page lists for a machine, in the order of their names.
    fn names<W: Complete>(&self, setup: &Setup<W>) -> Vec<String> {
        let mut names = vec!["cycles", "projector", "projector_coefficients"];
        if setup.surfaces[0].divider.is_some() {
            names.push("divider");
        }
        match &setup.surfaces[0].back {
            Back::Plane(_) => names.push("checker"),
            Back::Terrain(units) => {
                names.extend(["stepper", "interpolator", "ramp", "mixer", "pixel"]);
                names.extend(["height_memory", "ramp_segments"]);
                let optional = [
                    ("void_bits", units.interpolator.heights.has_voids()),
                    ("pyramid", units.stepper.pyramid.is_some()),
                    ("kernel_weight", units.interpolator.rom.is_some()),
                    ("kernel_slope", units.interpolator.rom.is_some()),
                    ("light", units.shader.light.is_some()),
                    ("rsqrt", units.shader.light.is_some()),
                ];
                names.extend(optional.iter().filter(|(_, fitted)| *fitted).map(|(name, _)| name));
            }
        }
        names.sort_unstable();
        names.into_iter().map(str::to_owned).collect()
    }

    /// Files with a row per pixel.
    fn of_pixels(&self) -> impl Iterator<Item = &File> {
        self.files.values().filter(|file| file.has("at", "line"))
    }

    /// Rows of the scene are the pixels that were asked for, corner cases are none.
    fn places(&self) -> Result<(), String> {
        let lines = &self.selection.lines;
        let pixels: Vec<(i64, i64)> = lines
            .iter()
            .flat_map(|(line, columns)| {
                columns.list().into_iter().map(|c| (i64::from(*line), c.into()))
            })
            .collect();
        for file in self.of_pixels() {
            if file.of_scene != pixels.len() {
                return Err(format!("{}: {} pixels", file.name, file.of_scene));
            }
            let (line, column) = (file.at("at", "line"), file.at("at", "column"));
            for (at, row) in file.rows.iter().enumerate() {
                // Sets of corner cases are scanned over a raster; other corner cases have no place.
                let raster = at.checked_sub(pixels.len()).map(|n| n as i64);
                let of_set = file.name == "projector.mem";
                let scanned = raster.filter(|_| of_set).map(|n| (n % 16 / 4, n % 4));
                let (l, c) = pixels.get(at).copied().or(scanned).unzip();
                let set = raster.map_or(0, |n| n / 16 + 1);
                if (row[line], row[column]) != (l, c)
                    || (of_set && row[file.at("in", "set")] != Some(set))
                {
                    return Err(format!("{} row {at}: another pixel", file.name));
                }
            }
        }
        Ok(())
    }

    /// What a unit gets in a row of the scene is what the last unit before that drives the wire says.
    fn handed_on(&self) -> Result<(), String> {
        let order = [
            "projector",
            "divider",
            "stepper",
            "interpolator",
            "light",
            "ramp",
            "mixer",
            "pixel",
            "checker",
        ];
        let mut driven: BTreeMap<&str, (&File, usize)> = BTreeMap::new();
        for file in order.iter().filter_map(|name| self.files.get(*name)) {
            for (at, column) in file.columns.iter().enumerate() {
                if column.way != "in" || column.name == "set" {
                    continue;
                }
                let (from, driver) = driven.get(column.name.as_str()).ok_or("nobody drives it")?;
                for n in 0..file.of_scene {
                    // Units after the divider look at wires only where they are valid.
                    let (given, said) = (file.rows[n][at], from.rows[n][*driver]);
                    if given != said {
                        return Err(format!("{} row {n}: {}", file.name, column.name));
                    }
                }
            }
            for (at, column) in file.columns.iter().enumerate().filter(|(_, c)| c.way == "out") {
                driven.insert(&column.name, (file, at));
            }
        }
        Ok(())
    }

    /// Registers of the machine, and all rows through the units.
    fn units<W: Complete>(&self, setup: &Setup<W>) -> Result<(), String> {
        if let Some(unit) = &setup.surfaces[0].divider {
            let file = &self.files["divider"];
            registers(file, &[("eye_x", unit.eye_x.raw()), ("eye_z", unit.eye_z.raw())])?;
            registers(file, &[("ratio_bits_x", Some(unit.bits[0].into()))])?;
        }
        match &setup.surfaces[0].back {
            Back::Plane(unit) => self.plane(unit)?,
            Back::Terrain(units) => self.terrain(units)?,
        }
        for unit in setup.chain().into_iter().skip(1).filter(|unit| !unit.is_idle()) {
            let file = &self.files[unit.description().name];
            let mut line = wires(&setup.world, file)?;
            unit.run(&mut line);
            let work = |i: usize| unit.timing(setup.memory_latency).work.of(line.work[i]);
            compare(file, &line, work)?;
        }
        Ok(())
    }

    fn plane<W: Complete>(&self, unit: &Checker<W>) -> Result<(), String> {
        let [mean, swing] = [unit.mean, unit.swing].map(|words| words.map(Readout::raw));
        registers(
            &self.files["checker"],
            &[
                ("sky_color", Some(packed(unit.pixel.sky))),
                ("out_of_range_color", Some(packed(unit.pixel.out_of_range))),
                ("mean_red", mean[0]),
                ("mean_green", mean[1]),
                ("mean_blue", mean[2]),
                ("swing_red", swing[0]),
                ("swing_green", swing[1]),
                ("swing_blue", swing[2]),
                ("contrast_exponent", Some(unit.contrast_exponent.into())),
                ("contrast_gain", unit.contrast_gain.raw()),
                ("shade_one", unit.one.raw()),
            ],
        )
    }

    fn terrain<W: Complete>(&self, units: &TerrainUnits<W>) -> Result<(), String> {
        let unit = &units.stepper;
        registers(
            &self.files["stepper"],
            &[
                ("from_eye", Some(unit.from_eye.into())),
                ("eye_x", unit.eye_x.raw()),
                ("eye_y", unit.eye_y.raw()),
                ("eye_z", unit.eye_z.raw()),
                ("highest", unit.top.raw()),
                ("base", unit.base.raw()),
                ("sides", Some(unit.sides.into())),
                ("fineness", Some(unit.fineness.into())),
                ("last", Some(unit.last.into())),
                ("beyond_sky", Some((unit.beyond == Hit::Sky).into())),
            ],
        )?;
        registers(&self.files["interpolator"], &[("weight_one", units.interpolator.one.raw())])?;
        let shader = &units.shader;
        if let Some(unit) = &shader.light {
            let file = &self.files["light"];
            let [x, y, z] = unit.toward.map(Readout::raw);
            registers(file, &[("light_x", x), ("light_y", y), ("light_z", z)])?;
            registers(file, &[("ambient", unit.ambient.raw()), ("shade_one", unit.one.raw())])?;
        }
        registers(
            &self.files["ramp"],
            &[
                ("ramp_exponent", Some(shader.ramp.exponent.into())),
                ("ramp_gain", shader.ramp.gain.raw()),
                ("ramp_last", Some(shader.ramp.segments.len() as i64 - 1)),
            ],
        )?;
        registers(&self.files["mixer"], &[("lit", Some(shader.light.is_some().into()))])?;
        registers(
            &self.files["pixel"],
            &[
                ("sky_color", Some(packed(shader.pixel.sky))),
                ("out_of_range_color", Some(packed(shader.pixel.out_of_range))),
                ("side_color", Some(packed(shader.pixel.side))),
            ],
        )
    }
}

/// Compares registers of a file with those of the machine.
fn registers(file: &File, expected: &[(&str, Option<i64>)]) -> Result<(), String> {
    for (name, value) in expected {
        let found = file.registers.get(*name).map(|(_, value)| *value);
        if found != *value {
            return Err(format!("{}: {name} {found:x?}, not {value:x?}", file.name));
        }
    }
    Ok(())
}

fn packed(color: [u8; 3]) -> i64 {
    color.into_iter().fold(0, |all, byte| all << 8 | i64::from(byte))
}

/// The inputs of a file on the wires of a line. What does not matter is whatever is there.
fn wires<W: Complete>(world: &W, file: &File) -> Result<Line<W>, String> {
    let mut line = Line::new(world, 0..file.rows.len() as u32);
    for (at, column) in file.columns.iter().enumerate().filter(|(_, c)| c.way == "in") {
        for (n, row) in file.rows.iter().enumerate() {
            let Some(bits) = row[at] else { continue };
            let refused = || format!("{} row {n}: {}", file.name, column.name);
            macro_rules! load {
                ($wire:ident $([$channel:literal])?, $class:ident, $register:ident) => {
                    line.$wire[n]$([$channel])? = Load::load_raw(bits, world.$class(Register::$register))
                        .ok_or_else(refused)?
                };
            }
            match column.name.as_str() {
                "view_x" => load!(view_x, view, ViewX),
                "view_y" => load!(view_y, view, ViewY),
                "view_z" => load!(view_z, view, ViewZ),
                "denominator" => load!(denominator, view, Denominator),
                "entry_x" => load!(entry_x, ground, GroundX),
                "entry_z" => load!(entry_z, ground, GroundZ),
                "ground_x" => load!(ground_x, ground, GroundX),
                "ground_z" => load!(ground_z, ground, GroundZ),
                "surface" => load!(surface, height, Surface),
                "slope_x" => load!(slope_x, height, SlopeX),
                "slope_z" => load!(slope_z, height, SlopeZ),
                "shade" => load!(shade, tone, Shade),
                "albedo_red" => load!(albedo[0], tone, Channel),
                "albedo_green" => load!(albedo[1], tone, Channel),
                "albedo_blue" => load!(albedo[2], tone, Channel),
                "lit_red" => load!(lit[0], tone, Channel),
                "lit_green" => load!(lit[1], tone, Channel),
                "lit_blue" => load!(lit[2], tone, Channel),
                "entry" => line.entry[n] = *ENTRIES.get(bits as usize).ok_or_else(refused)?,
                "hit" => line.hit[n] = *HITS.get(bits as usize).ok_or_else(refused)?,
                other => return Err(format!("{}: {other}", file.name)),
            }
        }
    }
    Ok(line)
}

/// Compares the outputs of a file with the wires that a unit has driven, by the page's rules of
/// what matters.
fn compare<W: Complete>(
    file: &File,
    line: &Line<W>,
    work: impl Fn(usize) -> u32,
) -> Result<(), String> {
    for (at, column) in file.columns.iter().enumerate().filter(|(_, c)| c.way == "out") {
        for (n, row) in file.rows.iter().enumerate() {
            let met = match file.name.as_str() {
                "divider.mem" => line.entry[n] == Entry::Met,
                "light.mem" | "ramp.mem" | "mixer.mem" => line.hit[n] == Hit::Surface,
                _ => matches!(line.hit[n], Hit::Surface | Hit::Side),
            };
            let expected = match column.name.as_str() {
                "entry" => Some(line.entry[n] as i64),
                "hit" => Some(line.hit[n] as i64),
                "color" => Some(packed(line.color[n])),
                "work" => Some(work(n).into()),
                _ if !met => None,
                "entry_x" => line.entry_x[n].raw(),
                "entry_z" => line.entry_z[n].raw(),
                "ground_x" => line.ground_x[n].raw(),
                "ground_z" => line.ground_z[n].raw(),
                "steps" => Some(line.steps[n].into()),
                "surface" => line.surface[n].raw(),
                "slope_x" => line.slope_x[n].raw(),
                "slope_z" => line.slope_z[n].raw(),
                "shade" => line.shade[n].raw(),
                "albedo_red" => line.albedo[n][0].raw(),
                "albedo_green" => line.albedo[n][1].raw(),
                "albedo_blue" => line.albedo[n][2].raw(),
                "lit_red" => line.lit[n][0].raw(),
                "lit_green" => line.lit[n][1].raw(),
                "lit_blue" => line.lit[n][2].raw(),
                other => return Err(format!("{}: {other}", file.name)),
            };
            if row[at] != expected {
                let name = &column.name;
                return Err(format!(
                    "{} row {n}: {name} {:x?}, not {expected:x?}",
                    file.name, row[at]
                ));
            }
        }
    }
    Ok(())
}
