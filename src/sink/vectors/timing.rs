//! The cycles in which units take the rows of the scene, by the recurrence of `crate::clock`.

use super::Files;
use super::text::{Header, Heading, Notation, Sheet, Way, Written};
use super::wires::place;
use crate::clock::{Chain, Clock, Stage};
use crate::setup::Setup;
use crate::sink::SinkError;
use crate::unit;
use crate::unit::{Cycles, Line};
use crate::word::{Complete, World};

/// Cycles of a frame.
const CYCLE: Notation = Notation::unsigned(48);

/// The open file of cycles.
pub struct Timing<'a> {
    clock: Clock,
    sheet: Sheet<'a>,
}

impl<'a> Timing<'a> {
    /// Begins the file; the clock starts with its first row.
    pub fn begin<W: Complete>(files: &Files<'a>, setup: &Setup<W>) -> Result<Self, SinkError> {
        let (chain, memory_latency) = (Chain::new(setup), setup.memory_latency);
        let mut lines = vec![
            "page docs/cycles.md".into(),
            "equation 28".into(),
            format!("memory_latency {memory_latency}"),
        ];
        let mut columns = place().to_vec();
        for Stage { name, timing } in &chain.stages {
            let unit::Timing { work, latency, depth } = *timing;
            let varies = work != Cycles::every(work.item);
            let work = if varies { "varies".into() } else { work.item.to_string() };
            lines.push(format!("stage {name} work {work} latency {latency} depth {depth}"));
            columns.push(Heading {
                way: Way::Out,
                name: format!("take_{name}"),
                notation: CYCLE,
                meaning: "cycle, from 0, in which it takes the item".into(),
            });
        }
        let header = Header {
            stem: "cycles".into(),
            holds: "cycles in which the units take the rows of the scene, fed one after the other",
            lines,
            registers: Vec::new(),
            columns,
            rows: files.vectors.selection.pixels(),
            corner_cases: 0,
        };
        let sheet = Sheet::begin(files.folder, files.scene, &header)?;
        Ok(Self { clock: Clock::new(chain), sheet })
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

    /// Ends the file with its checksum.
    pub fn finish(self) -> Result<Written, SinkError> {
        self.sheet.finish()
    }
}
