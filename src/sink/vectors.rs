//! Test vectors: what goes into every unit and what it has to answer, as text that a test bench of
//! anybody's hardware reads. The format's page is docs/vectors.md.
//!
//! Scene rows come from the wires of the line-by-line processor; hostile rows from the same units
//! with random words on their wires. Nothing expected is computed here.

mod hostile;
mod memories;
mod scan;
pub mod selection;
mod shading;
pub mod text;
mod timing;
mod units;
mod wires;

use std::path::Path;

use serde::Serialize;

use super::SinkError;
use super::folder::NewFolder;
use crate::clock::Chain;
use crate::engine::{FixedWorld, InFixedWorld};
use crate::fast::enter::Enterable;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::setup::{Back, Memory, Setup, SetupError, TerrainUnits, table};
use crate::unit::Line;
use crate::unit::divider::{Divider, Method};
use crate::unit::shader::PlaneShader;
use crate::word::{Complete, Overflow, Register, Rounding};
use hostile::Hostile;
use scan::Scan;
use selection::Selection;
use text::{Header, Sheet, Written};
use timing::Timing;
use units::Unit;
use wires::{Wire, notation};

/// Why vectors are not written.
#[derive(Debug, thiserror::Error)]
pub enum VectorsError {
    /// The registers cannot be loaded.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A file cannot be written.
    #[error(transparent)]
    Sink(#[from] SinkError),
    /// Random bits are part of what is expected.
    #[error(
        "format.{0}: stochastic rounding draws random bits that no other hardware has; give it \
         another rounding for vectors, for example nearest"
    )]
    Stochastic(Register),
}

/// The vectors of a scene, to be written in its fixed world.
#[derive(Clone, Copy, Debug)]
pub struct Vectors<'a> {
    /// Scene.
    pub scene: &'a Scene,
    /// Its plan.
    pub plan: &'a Plan,
    /// Its world.
    pub world: &'a FixedWorld,
    /// Pixels whose wires become rows.
    pub selection: &'a Selection,
    /// Hostile rows a unit.
    pub hostile: u32,
    /// Seed of the hostile rows.
    pub seed: u64,
    /// The folder that is made.
    pub folder: &'a Path,
}

/// What was written.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Files in the order of the data flow, memories last.
    pub files: Vec<Written>,
    /// Size of all of them.
    pub bytes: u64,
}

impl Vectors<'_> {
    /// Writes the folder, whole or not at all.
    ///
    /// # Errors
    /// If the scene cannot be set up, a register rounds stochastically, or a file cannot be
    /// written.
    pub fn write(self) -> Result<Report, VectorsError> {
        if let FixedWorld::Sweep(world) = self.world {
            let stochastic = |r: &&Register| world.format(**r).rounding == Rounding::Stochastic;
            if let Some(&register) = Register::ALL.iter().find(stochastic) {
                return Err(VectorsError::Stochastic(register));
            }
        }
        self.world.run(self)
    }

    /// Lines that the headers of all files share.
    fn scene_lines(&self) -> Vec<String> {
        let screen = &self.plan.screen;
        let fitted = if self.plan.full { "every unit fitted" } else { "pruned" };
        vec![
            format!("scene {}", self.scene.name.escape_default()),
            format!("screen {} {} {}", screen.columns, screen.lines, screen.name.escape_default()),
            format!("program terraline {}", env!("CARGO_PKG_VERSION")),
            format!("world {}, {fitted}", self.world.name()),
            format!("pixels {}", self.selection.said),
            format!("seed {}", self.seed),
        ]
    }

    /// Formats and equations of a unit's registers.
    fn formats<W: Complete>(&self, world: &W, registers: &[Register]) -> Vec<String> {
        let line = |&register: &Register| {
            let word = notation(world, register);
            let rule = match self.world {
                FixedWorld::Sweep(sweep) => {
                    let format = sweep.format(register);
                    format!("{} {}", rounding(format.rounding), overflow(format.overflow))
                }
                _ => "nearest wrap".into(),
            };
            let equations = table::entry(register).equations;
            format!("format {register} {word} {rule} equations {equations}")
        };
        registers.iter().map(line).collect()
    }
}

fn rounding(rounding: Rounding) -> &'static str {
    match rounding {
        Rounding::Floor => "floor",
        Rounding::TowardZero => "toward_zero",
        Rounding::Nearest => "nearest",
        Rounding::NearestEven => "nearest_even",
        Rounding::Stochastic => "stochastic",
    }
}

fn overflow(overflow: Overflow) -> &'static str {
    match overflow {
        Overflow::Wrap => "wrap",
        Overflow::Saturate => "saturate",
    }
}

/// Where files go, and what their headers share.
struct Files<'a> {
    vectors: Vectors<'a>,
    folder: &'a NewFolder,
    scene: &'a [String],
}

/// The open file of a unit.
struct Bench<'a, W: Complete> {
    unit: Unit<'a, W>,
    sheet: Sheet<'a>,
}

impl<'a, W: Complete> Bench<'a, W> {
    fn header(files: &Files<'_>, world: &W, unit: &Unit<'_, W>) -> Header {
        let mut lines = vec![format!("page docs/units/{}.md", unit.page)];
        lines.extend(files.vectors.formats(world, unit.registers));
        Header {
            stem: unit.stem.into(),
            holds: unit.holds,
            lines,
            coefficients: unit.coefficients.clone(),
            columns: unit.wires.iter().map(|wire| wire.heading.clone()).collect(),
            rows: files.vectors.selection.pixels(),
            hostile: files.vectors.hostile.into(),
        }
    }

    fn begin(files: &Files<'a>, world: &W, unit: Unit<'a, W>) -> Result<Self, SinkError> {
        let header = Self::header(files, world, &unit);
        Ok(Self { sheet: Sheet::begin(files.folder, files.scene, &header)?, unit })
    }

    /// Runs the unit on a line and writes a row for every pixel.
    fn run(
        &mut self,
        line: &mut Line<W>,
        hostile: bool,
        unit: impl FnOnce(&mut Line<W>),
    ) -> Result<(), SinkError> {
        let before = line.clone();
        unit(line);
        for at in 0..line.len() {
            let bits = |wire: &Wire<'_, W>| wire.bits(&before, line, at, hostile);
            self.sheet.row(self.unit.wires.iter().map(bits))?;
        }
        Ok(())
    }
}

/// The open files of the units behind the divider.
enum Behind<'a, W: Complete> {
    Terrain {
        units: &'a TerrainUnits<W>,
        stepper: Bench<'a, W>,
        interpolator: Bench<'a, W>,
        shader: Bench<'a, W>,
    },
    Plane {
        unit: &'a PlaneShader<W>,
        checker: Bench<'a, W>,
    },
}

impl<'a, W: Complete> Behind<'a, W> {
    fn begin(files: &Files<'a>, setup: &'a Setup<W>, chain: &'a Chain) -> Result<Self, SinkError> {
        let world = &setup.world;
        let begin = |unit| Bench::begin(files, world, unit);
        Ok(match &setup.back {
            Back::Terrain(units) => Self::Terrain {
                units,
                stepper: begin(units::stepper(world, units, chain))?,
                interpolator: begin(units::interpolator(world, &units.interpolator))?,
                shader: begin(shading::shader(world, &units.shader))?,
            },
            Back::Plane(unit) => {
                Self::Plane { unit, checker: begin(shading::checker(world, unit))? }
            }
        })
    }

    /// One line of the scene through all of them.
    fn run(&mut self, line: &mut Line<W>) -> Result<(), SinkError> {
        match self {
            Self::Terrain { units, stepper, interpolator, shader } => {
                stepper.run(line, false, |line| units.stepper.run(line, &units.interpolator))?;
                interpolator.run(line, false, |line| units.interpolator.run(line))?;
                shader.run(line, false, |line| units.shader.run(line))
            }
            Self::Plane { unit, checker } => checker.run(line, false, |line| unit.run(line)),
        }
    }

    /// Hostile rows of each of them.
    fn run_hostile(
        &mut self,
        hostile: &mut Hostile<W>,
        divider: Option<&Divider<W>>,
        count: u32,
    ) -> Result<(), SinkError> {
        match self {
            Self::Terrain { units, stepper, interpolator, shader } => {
                let mut line = hostile.stepper(units, divider, count);
                stepper
                    .run(&mut line, true, |line| units.stepper.run(line, &units.interpolator))?;
                let mut line = hostile.interpolator(units, count);
                interpolator.run(&mut line, true, |line| units.interpolator.run(line))?;
                let mut line = hostile.shader(units, count);
                shader.run(&mut line, true, |line| units.shader.run(line))
            }
            Self::Plane { unit, checker } => {
                let mut line = hostile.checker(unit, divider, count);
                checker.run(&mut line, true, |line| unit.run(line))
            }
        }
    }

    fn finish(self) -> Result<Vec<Written>, SinkError> {
        match self {
            Self::Terrain { stepper, interpolator, shader, .. } => {
                [stepper, interpolator, shader].into_iter().map(|b| b.sheet.finish()).collect()
            }
            Self::Plane { checker, .. } => Ok(vec![checker.sheet.finish()?]),
        }
    }
}

impl InFixedWorld for Vectors<'_> {
    type Output = Result<Report, VectorsError>;

    fn run<W: Complete + Enterable>(self, world: W) -> Self::Output {
        let memory = Memory::new(&world, self.scene, self.plan)?;
        let setup = Setup::new(world, self.scene, self.plan, memory.as_ref())?;
        let chain = Chain::new(&setup, self.scene.machine.memory_latency, self.plan.fitted.idle);
        let folder = NewFolder::begin(self.folder)?;
        let scene = self.scene_lines();
        let files = Files { vectors: self, folder: &folder, scene: &scene };
        let written = files.write(&setup, &chain)?;
        folder.finish()?;
        let bytes = written.iter().map(|file| file.bytes).sum();
        Ok(Report { files: written, bytes })
    }
}

impl<'a> Files<'a> {
    /// Writes all files: the scene's rows line by line through all units, then each unit's hostile
    /// rows, then the memories.
    fn write<W: Complete>(
        &self,
        setup: &'a Setup<W>,
        chain: &'a Chain,
    ) -> Result<Vec<Written>, SinkError> {
        let world = &setup.world;
        let mut scan = Scan::begin(self, setup)?;
        let divider = setup.divider.as_ref();
        let begin = |unit| Bench::begin(self, world, units::divider(world, unit));
        let mut ratio = divider.map(begin).transpose()?;
        let mut behind = Behind::begin(self, setup, chain)?;
        let mut timing = Timing::begin(self, chain)?;

        let mut start = setup.projector.first_line();
        let mut next = 0;
        for (number, columns) in &self.vectors.selection.lines {
            while next < *number {
                setup.projector.next_line(&mut start);
                next += 1;
            }
            let mut line = Line::new(world, columns.iter().copied());
            line.number = *number;
            setup.projector.run(&start, &mut line);
            scan.rows(&line, 0, line.len())?;
            if let (Some(bench), Some(unit)) = (&mut ratio, divider) {
                bench.run(&mut line, false, |line| unit.run(line, Method::Array))?;
            }
            behind.run(&mut line)?;
            timing.rows(&line)?;
        }

        let count = self.vectors.hostile;
        let mut hostile = Hostile::new(*world, self.vectors.seed);
        scan.hostile_rows(&setup.projector, &mut hostile, count)?;
        if let (Some(bench), Some(unit)) = (&mut ratio, divider) {
            let mut line = hostile.divider(unit, count);
            bench.run(&mut line, true, |line| unit.run(line, Method::Array))?;
        }
        behind.run_hostile(&mut hostile, divider, count)?;

        let mut written = scan.finish()?.to_vec();
        if let Some(bench) = ratio {
            written.push(bench.sheet.finish()?);
        }
        written.extend(behind.finish()?);
        written.push(timing.finish()?);
        if let Back::Terrain(units) = &setup.back {
            written.extend(memories::write(world, units, self.folder, self.scene)?);
        }
        Ok(written)
    }
}
