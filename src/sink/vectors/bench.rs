//! The open files of units: each runs its unit on a line and writes the wires before and after.

use super::Files;
use super::corner_cases::CornerCases;
use super::text::{Header, Heading, Sheet, Way, Written};
use super::wires::{COUNT, bits, heading, place, registers};
use crate::setup::{Setup, SurfaceUnits};
use crate::sink::SinkError;
use crate::unit::coefficient::Bank;
use crate::unit::{Cycles, Line, Unit, Wire};
use crate::word::Complete;

/// The open file of a unit.
struct Bench<'a, W: Complete> {
    unit: &'a dyn Unit<W>,
    inputs: Vec<Wire>,
    outputs: Vec<Wire>,
    /// Cycles of its work, where they are not the same on every item.
    work: Option<Cycles>,
    sheet: Sheet<'a>,
}

/// The header of a unit's file.
pub fn header<W: Complete>(files: &Files<'_>, world: &W, unit: &dyn Unit<W>) -> Header {
    let description = unit.description();
    let mut lines = vec![format!("page docs/units/{}.md", description.name)];
    lines.extend(files.vectors.formats(world, description.registers));
    let mut bank = Bank::default();
    unit.coefficients(&mut bank);
    let inputs = unit.inputs().into_iter().map(|wire| heading(world, Way::In, wire));
    let outputs = unit.outputs().into_iter().map(|wire| heading(world, Way::Out, wire));
    Header {
        stem: description.name.into(),
        holds: description.gives,
        lines,
        registers: registers(world, &bank),
        columns: place().into_iter().chain(inputs).chain(outputs).collect(),
        rows: files.vectors.selection.pixels(),
        corner_cases: files.vectors.corner_cases.into(),
    }
}

impl<'a, W: Complete> Bench<'a, W> {
    fn begin(
        files: &Files<'a>,
        setup: &'a Setup<W>,
        unit: &'a dyn Unit<W>,
    ) -> Result<Self, SinkError> {
        let mut header = header(files, &setup.world, unit);
        let work = unit.timing(setup.memory_latency).work;
        let work = (work != Cycles::every(work.item)).then_some(work);
        header.columns.extend(work.map(|_| Heading {
            way: Way::Out,
            name: "work".into(),
            notation: COUNT,
            meaning: "cycles of work on the item".into(),
        }));
        let sheet = Sheet::begin(files.folder, files.scene, &header)?;
        Ok(Self { unit, inputs: unit.inputs(), outputs: unit.outputs(), work, sheet })
    }

    /// Runs the unit on a line and writes a row for every pixel. Corner cases are no pixels.
    fn rows(&mut self, line: &mut Line<W>, corner_cases: bool) -> Result<(), SinkError> {
        let before = line.clone();
        self.unit.run(line);
        for at in 0..line.len() {
            let place = [line.number, line.column[at]].map(|n| (!corner_cases).then_some(n.into()));
            let inputs = self.inputs.iter().map(|&wire| bits(&before, wire, at));
            let outputs = self.outputs.iter().map(|&wire| bits(line, wire, at));
            let work = self.work.map(|work| Some(work.of(line.work[at]).into()));
            self.sheet.row(place.into_iter().chain(inputs).chain(outputs).chain(work))?;
        }
        Ok(())
    }
}

/// The open files of the units behind the projector, in the order of the chain.
pub struct Benches<'a, W: Complete> {
    surface: &'a SurfaceUnits<W>,
    benches: Vec<Bench<'a, W>>,
}

impl<'a, W: Complete> Benches<'a, W> {
    /// Begins the files of the units that are fitted and work.
    pub fn begin(
        files: &Files<'a>,
        setup: &'a Setup<W>,
        surface: &'a SurfaceUnits<W>,
    ) -> Result<Self, SinkError> {
        let units = surface.chain().into_iter().skip(1).filter(|unit| !unit.is_idle());
        let benches = units.map(|unit| Bench::begin(files, setup, unit));
        Ok(Self { surface, benches: benches.collect::<Result<_, _>>()? })
    }

    /// Runs all units on a line of the scene, which the projector has driven, and writes its rows.
    pub fn rows(&mut self, line: &mut Line<W>) -> Result<(), SinkError> {
        self.benches.iter_mut().try_for_each(|bench| bench.rows(line, false))
    }

    /// Writes this many corner cases of every unit.
    pub fn corner_cases(
        &mut self,
        cases: &mut CornerCases<W>,
        count: u32,
    ) -> Result<(), SinkError> {
        for bench in &mut self.benches {
            let mut line = cases.line(self.surface, bench.unit.description(), count);
            bench.rows(&mut line, true)?;
        }
        Ok(())
    }

    /// Ends all files with their checksums.
    pub fn finish(self) -> Result<Vec<Written>, SinkError> {
        self.benches.into_iter().map(|bench| bench.sheet.finish()).collect()
    }
}
