//! Which scene, and what is changed in it.

use std::path::{Path, PathBuf};

use clap::Args;

use super::Stop;
use super::reading::Reading;
use crate::engine::{Engine, FixedWorld, Machine, Memories};
use crate::plan::Plan;
use crate::scene::height_map::bytes;
use crate::scene::framing::{self, Framing, Wishes};
use crate::scene::screen::{MAX_PIXELS, MAX_SIDE};
use crate::scene::{
    self, FormatRequest, Overflow, Registers, Rounding, Scene, Surface, list, quote, registers,
};
use crate::setup::SetupError;
use crate::word::real::Real;

/// The scene of a command, and what changes it.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// A scene file (.toml), a height file (GeoTIFF, .hgt, .asc, PNG) to look over, several that make
    /// one map, or the name of a built-in scene; `overview` if not given.
    scene: Vec<String>,

    #[command(flatten)]
    reading: Reading,

    /// Memory that the map may take, for example `600M` or `2.5G`; of a larger file every n-th node of
    /// every n-th row is read. Without it, what the machine has free.
    #[arg(long, value_name = "BYTES", value_parser = bytes)]
    memory: Option<u64>,

    /// Override a value of the scene, for example `--set camera.pitch=-20`; repeatable.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    set: Vec<String>,

    /// Another raster: columns x lines; the field of view across stays.
    #[arg(long, value_name = "WxH")]
    size: Option<String>,

    /// Draw heights N times life size, in place of surface.height.scale. Samples are metres, unless a
    /// height file says what else they are.
    #[arg(long, value_name = "N", value_parser = parse_exaggeration)]
    exaggeration: Option<f64>,

    /// The screen (channel) to draw; the first if not given.
    #[arg(long, value_name = "NAME")]
    screen: Option<String>,

    /// A register or class in a format of its own (sweep world), for example `ground=24.8` or
    /// `node=12.16:stochastic:saturate`: bits before and after the point, rounding, overflow
    /// (as in stock registers, `nearest` and `wrap`, where they are left out). Places and views are
    /// never rounded and take `nearest` alone.
    #[arg(long = "format", value_name = "NAME=I.F[:ROUNDING[:OVERFLOW]]")]
    format: Vec<String>,

    /// Fit every unit, whether the scene needs it or not.
    #[arg(long)]
    full: bool,
}

/// A scene with its plan and world.
pub struct Planned {
    /// The scene, with all overrides in it.
    pub scene: Scene,
    /// What is fitted for it, in which words.
    pub plan: Plan,
    /// The number world that the plan leads to.
    pub world: FixedWorld,
    /// Its memories, once they are loaded.
    memories: Memories,
    /// How the command line names the scene.
    pub named: String,
    /// How to name the scene and its overrides on a command line.
    pub invocation: String,
    /// The scene that was chosen for a height file.
    pub framing: Option<Framing>,
}

impl Planned {
    /// The scene's machine, its coefficients set up anew, its memories loaded once.
    pub fn machine(&self) -> Result<Machine<'_>, Stop> {
        Machine::in_world(self.world, &self.scene, &self.plan, &self.memories)
            .map_err(|error| self.refused(&error))
    }

    /// The machine for an engine, which refuses in its own numbers what it cannot draw.
    pub fn machine_for(&self, engine: Engine) -> Result<Machine<'_>, Stop> {
        let real = || self.memories.set_up(Real, &self.scene, &self.plan).err();
        self.machine().map_err(|stop| match engine {
            Engine::Real => real().map_or(stop, |error| self.refused(&error)),
            _ => stop,
        })
    }

    /// The message for an error of set-up, with the name of the scene.
    pub fn refused(&self, error: &SetupError) -> Stop {
        Stop::BadInput(format!("{}: {error}", self.named))
    }
}

impl SceneArgs {
    /// Reads, overrides and plans the scene.
    pub fn load(&self) -> Result<Planned, Stop> {
        if self.exaggeration.is_some() && framing::is_set(&self.set, "surface.height.scale") {
            return Err(Stop::BadInput(
                "--exaggeration: it chooses surface.height.scale, which --set gives as well; leave \
                 one of the two out"
                    .into(),
            ));
        }
        let sets: Vec<String> = self.reading.sets().into_iter().chain(self.set.clone()).collect();
        let name = self.scene.first().map(String::as_str);
        let is_height_file =
            |name: &str| scene::builtin::find(name).is_none() && framing::applies(name);
        let framing = if name.is_some_and(is_height_file) {
            let size = self.size.as_deref().map(parse_size).transpose()?;
            let Reading { unit, height_unit, .. } = self.reading;
            let memory = self.memory;
            let exaggeration = self.exaggeration;
            let wishes = Wishes { size, unit, height_unit_m: height_unit, exaggeration, memory };
            let paths: Vec<&Path> = self.scene.iter().map(Path::new).collect();
            Some(framing::read(&paths, &sets, &wishes)?)
        } else {
            if let [first, second, ..] = self.scene.as_slice() {
                return Err(Stop::BadInput(format!(
                    "{second}: {first} is a scene, and one is drawn at a time; several height files \
                     make one map"
                )));
            }
            self.reading.refuse(self.memory, name.unwrap_or("overview"))?;
            None
        };
        let mut scene = match &framing {
            Some(framing) => framing.scene.clone(),
            None => scene::load(name, &sets)?,
        };
        if let Some(times) = self.exaggeration
            && framing.is_none()
            && !scene.exaggerate(times, 1.0)
        {
            return Err(Stop::BadInput(format!(
                "--exaggeration: {} has no terrain whose heights it could change; leave it out, or \
                 give a height file or a scene with a terrain",
                scene.name
            )));
        }
        for format in &self.format {
            scene.formats.push(parse_format(format)?);
        }
        if let Some(size) = &self.size {
            let (columns, lines) = parse_size(size)?;
            for screen in &mut scene.screens {
                *screen = screen.resized(columns, lines);
            }
        }
        let of = name.unwrap_or("overview");
        let located = |error: String| Stop::BadInput(format!("{of}: {error}"));
        let plan = Plan::new(&scene, self.screen.as_deref(), self.full)
            .map_err(|error| located(error.to_string()))?;
        let world = FixedWorld::of(&scene, &plan).map_err(|error| located(error.to_string()))?;
        let (memories, invocation) = (Memories::default(), self.invocation());
        Ok(Planned { scene, plan, world, memories, named: of.to_owned(), invocation, framing })
    }

    /// Whether a raster was asked for on the command line.
    #[cfg(feature = "window")]
    pub fn asks_for_size(&self) -> bool {
        self.size.is_some()
    }

    /// Files that a planned scene was read from.
    pub fn inputs(&self, planned: &Planned) -> Vec<PathBuf> {
        let Some(file) = self.scene.first().map(PathBuf::from) else { return Vec::new() };
        let maps = planned.scene.surfaces.iter().filter_map(Surface::terrain);
        maps.flat_map(|terrain| terrain.source.paths(self.folder())).chain([file]).collect()
    }

    /// Whether this file is the (first) one that was given as the scene.
    #[cfg(feature = "window")]
    pub fn is(&self, file: &Path) -> bool {
        self.scene.first().is_some_and(|first| Path::new(first) == file)
    }

    /// Folder where relative paths of the scene start.
    pub fn folder(&self) -> &Path {
        let first = self.scene.first().and_then(|file| Path::new(file).parent());
        first.unwrap_or(Path::new(""))
    }

    /// The arguments again, quoted for a shell.
    fn invocation(&self) -> String {
        let mut words: Vec<String> = self.scene.iter().map(|name| quote(name)).collect();
        if words.is_empty() {
            words.push("overview".to_owned());
        }
        words.extend(self.reading.words());
        words.extend(self.memory.map(|bytes| format!("--memory {}M", bytes as f64 / 1e6)));
        let mut option = |name: &str, value: &str| words.push(format!("{name} {}", quote(value)));
        self.set.iter().for_each(|value| option("--set", value));
        self.format.iter().for_each(|value| option("--format", value));
        if let Some(size) = &self.size {
            option("--size", size);
        }
        if let Some(screen) = &self.screen {
            option("--screen", screen);
        }
        if let Some(times) = self.exaggeration {
            option("--exaggeration", &times.to_string());
        }
        if self.full {
            words.push("--full".into());
        }
        words.join(" ")
    }
}

/// Times life size.
fn parse_exaggeration(text: &str) -> Result<f64, String> {
    let times = text.parse().ok().filter(|times| (0.001..=1000.0).contains(times));
    times.ok_or_else(|| "give a number from 0.001 to 1000; 1 is life size".into())
}

/// `WxH`.
fn parse_size(text: &str) -> Result<(u32, u32), Stop> {
    let bad = |reason: String| {
        Stop::BadInput(format!(
            "--size {text}: {reason}; give columns x lines, for example 640x480, at most \
             {MAX_SIDE} a side and {MAX_PIXELS} pixels"
        ))
    };
    let (columns, lines) =
        text.split_once(['x', 'X', '×']).ok_or_else(|| bad("no `x` between two numbers".into()))?;
    let side = |side: &str| -> Result<u32, Stop> {
        match side.trim().parse::<u32>() {
            Ok(0) => Err(bad("a screen has at least one pixel".into())),
            Ok(value) if value > MAX_SIDE => Err(bad(format!("{value} is too many"))),
            Ok(value) => Ok(value),
            Err(_) => Err(bad(format!("`{side}` is not a number of pixels"))),
        }
    };
    let (columns, lines) = (side(columns)?, side(lines)?);
    if u64::from(columns) * u64::from(lines) > MAX_PIXELS {
        return Err(bad("too many pixels".into()));
    }
    Ok((columns, lines))
}

/// `COLUMN,LINE`, inside the plan's screen.
pub fn parse_pixel(text: &str, plan: &Plan) -> Result<(u32, u32), Stop> {
    let (columns, lines) = (plan.geometry.columns, plan.geometry.lines);
    let bad = |reason: &str| {
        Stop::BadInput(format!(
            "--pixel {text}: {reason}; give column,line from 0,0 at the top left to {},{}",
            columns - 1,
            lines - 1
        ))
    };
    let (column, line) = text.split_once(',').ok_or_else(|| bad("no comma"))?;
    let number = |text: &str| text.trim().parse::<u32>().map_err(|_| bad("not two numbers"));
    let (column, line) = (number(column)?, number(line)?);
    if column >= columns || line >= lines {
        return Err(bad("outside the screen"));
    }
    Ok((column, line))
}

/// `NAME=I.F[:ROUNDING[:OVERFLOW]]`.
fn parse_format(text: &str) -> Result<(Registers, FormatRequest), Stop> {
    let bad = |reason: &str| {
        Stop::BadInput(format!(
            "--format {text}: {reason}; for example ground=24.8 or height=24.8:floor:saturate \
             (roundings: {}; overflows: {})",
            list(Rounding::ALL.map(Rounding::name)),
            list(Overflow::ALL.map(Overflow::name))
        ))
    };
    let (name, format) = text.split_once('=').ok_or_else(|| bad("no `=`"))?;
    let registers = registers(name).map_err(|(reason, remedy)| {
        Stop::BadInput(format!("--format {text}: {reason}; {remedy}"))
    })?;
    let mut parts = format.split(':');
    let bits = parts.next().unwrap_or_default();
    let (integer, point) =
        bits.split_once('.').ok_or_else(|| bad("no `.` between integer and fraction bits"))?;
    let number = |text: &str| text.parse::<u32>().map_err(|_| bad("bits are not numbers"));
    let (integer, point) = (number(integer)?, number(point)?);
    let width = integer.checked_add(point).filter(|width| (2..=62).contains(width));
    let width = width.ok_or_else(|| bad("a register has 2 to 62 bits in all"))?;
    let rounding = match parts.next() {
        None => Rounding::default(),
        Some(name) => Rounding::from_name(name).ok_or_else(|| bad("unknown rounding"))?,
    };
    let overflow = match parts.next() {
        None => Overflow::default(),
        Some(name) => Overflow::from_name(name).ok_or_else(|| bad("unknown overflow"))?,
    };
    if parts.next().is_some() {
        return Err(bad("too many parts"));
    }
    Ok((registers, FormatRequest { width, point, rounding, overflow }))
}
