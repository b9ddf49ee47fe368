//! The cycles in which units take the rows of the scene, by the recurrence of `crate::clock`.

use super::Files;
use super::text::{Header, Heading, Notation, Sheet, Way, Written};
use super::wires::PLACE;
use crate::clock::{Chain, Clock};
use crate::sink::SinkError;
use crate::unit::Line;
use crate::unit::line::Work;
use crate::word::World;

/// Cycles of a frame.
const CYCLE: Notation = Notation::unsigned(48);

/// The open file of cycles.
pub struct Timing<'a> {
    clock: Clock,
    sheet: Sheet<'a>,
}

impl<'a> Timing<'a> {
    /// Begins the file; the clock starts with its first row.
    pub fn begin(files: &Files<'a>, chain: &Chain) -> Result<Self, SinkError> {
        let heading = |name: String, notation, meaning| Heading {
            way: if notation == PLACE { Way::At } else { Way::Out },
            name,
            notation,
            meaning,
        };
        let mut columns = vec![
            heading("line".into(), PLACE, "scan line from the top"),
            heading("column".into(), PLACE, "column from the left"),
        ];
        let memory_latency = files.vectors.machine.scene().machine.memory_latency;
        let mut lines = vec![
            "page docs/cycles.md".into(),
            "equation 28".into(),
            format!("memory_latency {memory_latency}"),
        ];
        let nothing = Work::default();
        for (at, stage) in chain.stages.iter().enumerate() {
            let fixed = chain.work(at, nothing);
            let varies = chain.work(at, Work { trials: 1, ..nothing }) != fixed;
            let work = if varies { "varies".into() } else { fixed.to_string() };
            let (name, latency, depth) = (stage.name, stage.latency, stage.depth);
            lines.push(format!("stage {name} work {work} latency {latency} depth {depth}"));
            let meaning = "cycle, from 0, in which it takes the item";
            columns.push(heading(format!("take_{}", stage.name), CYCLE, meaning));
        }
        let header = Header {
            stem: "cycles".into(),
            holds: "cycles in which the units take the rows of the scene, fed one after the other",
            lines,
            coefficients: Vec::new(),
            columns,
            rows: files.vectors.selection.pixels(),
            hostile: 0,
        };
        let sheet = Sheet::begin(files.folder, files.scene, &header)?;
        Ok(Self { clock: Clock::new(chain.clone()), sheet })
    }

    /// Takes a finished line.
    pub fn rows<W: World>(&mut self, line: &Line<W>) -> Result<(), SinkError> {
        for (&work, &column) in line.work.iter().zip(&line.column) {
            self.clock.take(work);
            let place = [line.number, column].map(|at| Some(at.into()));
            let cycles = self.clock.entered().map(|cycle| Some(cycle as i64));
            self.sheet.row(place.into_iter().chain(cycles))?;
        }
        Ok(())
    }

    /// Closes the file.
    pub fn finish(self) -> Result<Written, SinkError> {
        self.sheet.finish()
    }
}
