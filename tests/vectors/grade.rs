//! A folder of files graded: every row computed again by the units of the emulator, from the
//! inputs in the file; what one unit answers is what the next one gets; memories as they are loaded.

use std::collections::BTreeMap;

use terraline::clock::Chain;
use terraline::engine::InFixedWorld;
use terraline::frame::Hit;
use terraline::plan::Plan;
use terraline::scene::Scene;
use terraline::setup::{Back, Memory, Setup, TerrainUnits};
use terraline::sink::vectors::selection::Selection;
use terraline::unit::Line;
use terraline::unit::divider::Method;
use terraline::unit::line::Entry;
use terraline::unit::shader::Shader;
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

impl InFixedWorld for Grade<'_> {
    type Output = Result<(), String>;

    fn run<W: Complete>(self, world: W) -> Self::Output {
        let (scene, plan) = (self.scene, self.plan);
        let memory = Memory::new(&world, scene, plan).map_err(|error| error.to_string())?;
        let setup =
            Setup::new(world, scene, plan, memory.as_ref()).map_err(|error| error.to_string())?;
        let files = self.files;
        let names = self.names(&setup);
        if !files.keys().eq(names.iter()) {
            return Err(format!("files {:?}, fitted {names:?}", files.keys()));
        }
        for file in files.values() {
            let size = format!("{} {} ", plan.geometry.columns, plan.geometry.lines);
            let said = file.scene["scene"] == scene.name && file.scene["screen"].starts_with(&size);
            if !said || file.scene["pixels"] != self.selection.said {
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
        let chain = Chain::new(&setup, &scene.machine, plan.fitted.idle);
        self.units(&setup, &chain)?;
        if let Back::Terrain(units) = &setup.back {
            memories::check(files, units)?;
        }
        Ok(())
    }
}

/// Hits by their code.
const HITS: [Hit; 4] = [Hit::Sky, Hit::Surface, Hit::Side, Hit::Far];
/// Entries by their code.
const ENTRIES: [Entry; 3] = [Entry::Met, Entry::Sky, Entry::Far];

impl Grade<'_> {
    /// Files that the page lists for a machine, in the order of their names.
    fn names<W: Complete>(&self, setup: &Setup<W>) -> Vec<String> {
        let mut names = vec!["cycles", "projector", "projector_coefficients"];
        if setup.divider.is_some() {
            names.push("divider");
        }
        match &setup.back {
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

    /// Rows of the scene are the pixels that were asked for, hostile rows are none.
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
                // Hostile sets are scanned over a raster; other hostile rows have no place.
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

    /// All rows through the units.
    fn units<W: Complete>(&self, setup: &Setup<W>, chain: &Chain) -> Result<(), String> {
        if let (Some(unit), Some(file)) = (&setup.divider, self.files.get("divider")) {
            let eyes = [("eye_x", unit.eye_x.raw()), ("eye_z", unit.eye_z.raw())];
            registers(file, &eyes)?;
            registers(file, &[("bits_x", Some(unit.bits.into()))])?;
            let mut line = wires(&setup.world, file)?;
            unit.run(&mut line, Method::Array);
            compare(file, &line, chain)?;
        }
        match &setup.back {
            Back::Plane(unit) => {
                let file = &self.files["checker"];
                let [mean, swing] = [unit.mean, unit.swing].map(|words| words.map(Readout::raw));
                registers(
                    file,
                    &[
                        ("sky", Some(packed(unit.pixel.sky))),
                        ("out_of_range", Some(packed(unit.pixel.out_of_range))),
                        ("mean_red", mean[0]),
                        ("mean_green", mean[1]),
                        ("mean_blue", mean[2]),
                        ("swing_red", swing[0]),
                        ("swing_green", swing[1]),
                        ("swing_blue", swing[2]),
                        ("contrast_exponent", Some(unit.contrast_exponent.into())),
                        ("contrast_gain", unit.contrast_gain.raw()),
                        ("one", unit.one.raw()),
                    ],
                )?;
                let mut line = wires(&setup.world, file)?;
                unit.run(&mut line);
                compare(file, &line, chain)
            }
            Back::Terrain(units) => self.terrain(&setup.world, units, chain),
        }
    }

    fn terrain<W: Complete>(
        &self,
        world: &W,
        units: &TerrainUnits<W>,
        chain: &Chain,
    ) -> Result<(), String> {
        let (file, unit) = (&self.files["stepper"], &units.stepper);
        registers(
            file,
            &[
                ("from_eye", Some(unit.from_eye.into())),
                ("eye_x", unit.eye_x.raw()),
                ("eye_y", unit.eye_y.raw()),
                ("eye_z", unit.eye_z.raw()),
                ("top", unit.top.raw()),
                ("base", unit.base.raw()),
                ("sides", Some(unit.sides.into())),
                ("fineness", Some(unit.fineness.into())),
                ("last", Some(unit.last.into())),
                ("beyond", Some(unit.beyond as i64)),
            ],
        )?;
        let mut line = wires(world, file)?;
        unit.run(&mut line, &units.interpolator);
        compare(file, &line, chain)?;

        let (file, unit) = (&self.files["interpolator"], &units.interpolator);
        registers(file, &[("one", unit.one.raw())])?;
        let mut line = wires(world, file)?;
        unit.run(&mut line);
        compare(file, &line, chain)?;

        self.shader(world, &units.shader, chain)
    }

    fn shader<W: Complete>(
        &self,
        world: &W,
        shader: &Shader<W>,
        chain: &Chain,
    ) -> Result<(), String> {
        if let Some(unit) = &shader.light {
            let file = &self.files["light"];
            let [x, y, z] = unit.toward.map(Readout::raw);
            registers(file, &[("light_x", x), ("light_y", y), ("light_z", z)])?;
            registers(file, &[("ambient", unit.ambient.raw()), ("one", unit.one.raw())])?;
            let mut line = wires(world, file)?;
            unit.run(&mut line);
            compare(file, &line, chain)?;
        }
        let (file, unit) = (&self.files["ramp"], &shader.ramp);
        registers(
            file,
            &[
                ("ramp_exponent", Some(unit.exponent.into())),
                ("ramp_gain", unit.gain.raw()),
                ("ramp_segments", Some(unit.segments.len() as i64)),
            ],
        )?;
        let mut line = wires(world, file)?;
        unit.run(&mut line);
        compare(file, &line, chain)?;

        let (file, unit) = (&self.files["mixer"], &shader.mixer);
        registers(file, &[("shaded", Some(shader.light.is_some().into()))])?;
        let mut line = wires(world, file)?;
        unit.run(&mut line);
        compare(file, &line, chain)?;

        let (file, unit) = (&self.files["pixel"], &shader.pixel);
        registers(
            file,
            &[
                ("sky", Some(packed(unit.sky))),
                ("out_of_range", Some(packed(unit.out_of_range))),
                ("side", Some(packed(unit.side))),
            ],
        )?;
        let mut line = wires(world, file)?;
        unit.run(&mut line);
        compare(file, &line, chain)
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
fn compare<W: Complete>(file: &File, line: &Line<W>, chain: &Chain) -> Result<(), String> {
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
                "work" => Some(chain.stepper_work(line.work[n]).into()),
                _ if !met => None,
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
