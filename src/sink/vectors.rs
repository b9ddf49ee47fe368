//! Test vectors: what goes into every unit and what it has to answer, as text that a test bench of
//! anybody's hardware reads. The format's page is docs/vectors.md.
//!
//! Scene rows come from the wires of the line-by-line processor; hostile rows from the same units
//! with random words on their wires. Nothing expected is computed here.

mod bench;
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
use crate::plan::Plan;
use crate::scene::Scene;
use crate::setup::{Back, Memory, Setup, SetupError, table};
use crate::unit::Line;
use crate::word::{Complete, Overflow, Register, Rounding};
use bench::Benches;
use hostile::Hostile;
use scan::Scan;
use selection::Selection;
use text::Written;
use timing::Timing;
use wires::notation;

/// Hostile rows that are on the wires at a time.
const CHUNK: u32 = 4096;

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

impl InFixedWorld for Vectors<'_> {
    type Output = Result<Report, VectorsError>;

    fn run<W: Complete>(self, world: W) -> Self::Output {
        let memory = Memory::new(&world, self.scene, self.plan)?;
        let setup = Setup::new(world, self.scene, self.plan, memory.as_ref())?;
        let chain = Chain::new(&setup, &self.scene.machine, self.plan.fitted.idle);
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
        let mut benches = Benches::begin(self, setup, chain)?;
        let mut timing = Timing::begin(self, chain)?;

        let mut start = setup.projector.first_line();
        let mut next = 0;
        for (number, columns) in &self.vectors.selection.lines {
            while next < *number {
                setup.projector.next_line(&mut start);
                next += 1;
            }
            let mut line = Line::new(world, columns.list());
            line.number = *number;
            setup.projector.run(&start, &mut line);
            scan.rows(&line, 0, line.len())?;
            benches.rows(&mut line)?;
            timing.rows(&line)?;
        }

        let count = self.vectors.hostile;
        let mut hostile = Hostile::new(*world, self.vectors.seed);
        scan.hostile_rows(&setup.projector, &mut hostile, count)?;
        for from in (0..count).step_by(CHUNK as usize) {
            benches.hostile_rows(&mut hostile, CHUNK.min(count - from))?;
        }

        let mut written = scan.finish()?.to_vec();
        written.extend(benches.finish()?);
        written.push(timing.finish()?);
        if let Back::Terrain(units) = &setup.back {
            written.extend(memories::write(world, units, self.folder, self.scene)?);
        }
        Ok(written)
    }
}
