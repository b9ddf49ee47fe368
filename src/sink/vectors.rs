//! Test vectors: what goes into every unit and what it has to answer, as text that a test bench of
//! anybody's hardware reads. The format's page is docs/vectors.md.
//!
//! Scene rows come from the wires of the line-by-line processor; corner cases from the same units
//! with random words on their wires. Nothing expected is computed here.

mod bench;
mod corner_cases;
mod memories;
mod scan;
pub mod selection;
pub mod text;
mod timing;
mod wires;

use std::path::Path;

use serde::Serialize;

use super::SinkError;
use super::folder::NewFolder;
use crate::engine::{FixedWorld, Machine, WithSetup};
use crate::processor::Processor;
use crate::setup::{Setup, table};
use crate::unit::{Line, Unit as _};
use crate::word::{Complete, Overflow, Register, Rounding};
use bench::Benches;
use corner_cases::CornerCases;
use scan::Scan;
use selection::Selection;
use text::Written;
use timing::Timing;
use wires::notation;

/// Corner cases that are on the wires at a time.
const CHUNK: u32 = 4096;

/// Why vectors are not written.
#[derive(Debug, thiserror::Error)]
pub enum VectorsError {
    /// A file cannot be written.
    #[error(transparent)]
    Sink(#[from] SinkError),
    /// Files are named after units, of which several surfaces would have several.
    #[error("surface: test vectors of several surfaces are not built yet; keep one [[surface]]")]
    SeveralSurfaces,
    /// Random bits are part of what is expected.
    #[error(
        "format.{0}: stochastic rounding draws random bits that no other hardware has; give it \
         another rounding for vectors, for example nearest"
    )]
    Stochastic(Register),
}

/// The vectors of a scene, to be written in its fixed world.
#[derive(Clone, Copy)]
pub struct Vectors<'a> {
    /// The machine of the scene.
    pub machine: &'a Machine<'a>,
    /// Pixels whose wires become rows.
    pub selection: &'a Selection,
    /// Corner cases of every unit.
    pub corner_cases: u32,
    /// Seed of the corner cases.
    pub seed: u64,
    /// The folder that is made.
    pub folder: &'a Path,
}

/// The files that were written.
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
    /// If there are several surfaces, a register rounds stochastically, or a file cannot be written.
    pub fn write(self) -> Result<Report, VectorsError> {
        if self.machine.plan().surfaces.len() > 1 {
            return Err(VectorsError::SeveralSurfaces);
        }
        if let FixedWorld::Sweep(world) = self.machine.world() {
            let stochastic = |r: &&Register| world.format(**r).rounding == Rounding::Stochastic;
            if let Some(&register) = Register::ALL.iter().find(stochastic) {
                return Err(VectorsError::Stochastic(register));
            }
        }
        self.machine.run(self)
    }

    /// Lines that the headers of all files share.
    fn scene_lines(&self) -> Vec<String> {
        let (scene, plan) = (self.machine.scene(), self.machine.plan());
        let screen = &plan.screen;
        let fitted = if plan.full { "every unit fitted" } else { "pruned" };
        vec![
            format!("scene {}", scene.name.escape_default()),
            format!("screen {} {} {}", screen.columns, screen.lines, screen.name.escape_default()),
            format!("program terraline {}", env!("CARGO_PKG_VERSION")),
            format!("world {}, {fitted}", self.machine.world().name()),
            format!("pixels {}", self.selection.description),
            format!("seed {}", self.seed),
        ]
    }

    /// Formats and equations of a unit's registers.
    fn formats<W: Complete>(&self, world: &W, registers: &[Register]) -> Vec<String> {
        let line = |&register: &Register| {
            let word = notation(world, register);
            let rule = match self.machine.world() {
                FixedWorld::Sweep(sweep) => {
                    let format = sweep.format(register);
                    format!("{} {}", format.rounding.name(), format.overflow.name())
                }
                _ => format!("{} {}", Rounding::default().name(), Overflow::default().name()),
            };
            let equations = table::row(register).equations;
            format!("format {register} {word} {rule} equations {equations}")
        };
        registers.iter().map(line).collect()
    }
}

/// Where files go, and what their headers share.
struct Files<'a> {
    vectors: Vectors<'a>,
    folder: &'a NewFolder,
    scene: &'a [String],
}

impl WithSetup for Vectors<'_> {
    type Output = Result<Report, VectorsError>;

    fn run<W: Complete>(self, setup: &Setup<W>) -> Self::Output {
        let folder = NewFolder::begin(self.folder)?;
        let scene = self.scene_lines();
        let files = Files { vectors: self, folder: &folder, scene: &scene };
        let written = files.write(setup)?;
        folder.finish()?;
        let bytes = written.iter().map(|file| file.bytes).sum();
        Ok(Report { files: written, bytes })
    }
}

impl<'a> Files<'a> {
    /// Writes all files: the scene's rows line by line through all units, then each unit's corner
    /// cases, then the memories.
    fn write<W: Complete>(&self, setup: &'a Setup<W>) -> Result<Vec<Written>, SinkError> {
        let world = &setup.world;
        let [surface] = &setup.surfaces[..] else { unreachable!("`Vectors::write` refuses it") };
        let mut scan = Scan::begin(self, world, &surface.projector)?;
        let mut benches = Benches::begin(self, setup, surface)?;
        let mut timing = Timing::begin(self, setup)?;
        let mut processor = Processor::new(setup);
        for (number, columns) in &self.vectors.selection.lines {
            processor.skip_to(*number);
            let mut line = Line::new(world, columns.list());
            processor.begin(&mut line);
            surface.projector.run(&mut line);
            scan.rows(&line, 0, line.len())?;
            benches.rows(&mut line)?;
            timing.rows(&line)?;
        }

        let count = self.vectors.corner_cases;
        let mut cases = CornerCases::new(*world, self.vectors.seed);
        scan.corner_cases(&surface.projector, &mut cases, count)?;
        for from in (0..count).step_by(CHUNK as usize) {
            benches.corner_cases(&mut cases, CHUNK.min(count - from))?;
        }

        let mut written = scan.finish()?.to_vec();
        written.extend(benches.finish()?);
        written.push(timing.finish()?);
        if let Some(units) = surface.back.terrain() {
            written.extend(memories::write(world, units, self.folder, self.scene)?);
        }
        Ok(written)
    }
}
