//! The projector's files. It has no input but its coefficients, so corner cases have coefficients
//! of their own, each set scanned over a small raster; a second file lists the sets.

use super::Files;
use super::bench::header;
use super::corner_cases::{CornerCases, RASTER};
use super::text::{Heading, Register, Sheet, Way, Written};
use super::wires::{COUNT, bits, registers};
use crate::sink::SinkError;
use crate::unit::coefficient::Bank;
use crate::unit::projector::Projector;
use crate::unit::{Line, Unit, Wire};
use crate::word::Complete;

/// The open files of the projector.
pub struct Scan<'a, W: Complete> {
    world: W,
    outputs: Vec<Wire>,
    rows: Sheet<'a>,
    sets: Sheet<'a>,
}

/// The coefficients of a projector.
fn set<W: Complete>(world: &W, unit: &Projector<W>) -> Vec<Register> {
    let mut bank = Bank::default();
    unit.coefficients(&mut bank);
    registers(world, &bank)
}

impl<'a, W: Complete> Scan<'a, W> {
    /// Begins both files.
    pub fn begin(files: &Files<'a>, world: &W, unit: &Projector<W>) -> Result<Self, SinkError> {
        let mut header = header(files, world, unit);
        header.columns.insert(
            0,
            Heading {
                way: Way::In,
                name: "set".into(),
                notation: COUNT,
                meaning: "row of projector_coefficients.mem; 0 is the scene's".into(),
            },
        );
        header.lines.push(format!("raster {RASTER} {RASTER} of every set but the scene's"));
        let rows = Sheet::begin(files.folder, files.scene, &header)?;
        header.stem = "projector_coefficients".into();
        header.holds = "coefficient sets of the projector, one a row";
        header.corner_cases = u64::from(files.vectors.corner_cases.div_ceil(RASTER * RASTER));
        header.rows = 1;
        let heading = |c: &Register| Heading {
            way: Way::Word,
            name: c.name.into(),
            notation: c.notation,
            meaning: c.meaning.into(),
        };
        header.columns = header.registers.iter().map(heading).collect();
        let mut sets = Sheet::begin(files.folder, files.scene, &header)?;
        sets.row(header.registers.iter().map(|c| Some(c.value)))?;
        Ok(Self { world: *world, outputs: unit.outputs(), rows, sets })
    }

    /// Writes the first pixels of a line that the projector has driven with a set.
    pub fn rows(&mut self, line: &Line<W>, set: u32, most: usize) -> Result<(), SinkError> {
        for at in 0..line.len().min(most) {
            let place = [line.number, line.column[at]].map(|n| Some(n.into()));
            let wires = self.outputs.iter().map(|&wire| bits(line, wire, at));
            self.rows.row([Some(set.into())].into_iter().chain(place).chain(wires))?;
        }
        Ok(())
    }

    /// Writes sets of corner cases and this many rows of them.
    pub fn corner_cases(
        &mut self,
        unit: &Projector<W>,
        cases: &mut CornerCases<W>,
        count: u32,
    ) -> Result<(), SinkError> {
        let mut line = Line::new(&self.world, 0..RASTER);
        for number_of_set in 1..=count.div_ceil(RASTER * RASTER) {
            let other = cases.projector(unit);
            self.sets.row(set(&self.world, &other).iter().map(|c| Some(c.value)))?;
            let mut left = (count - (number_of_set - 1) * RASTER * RASTER) as usize;
            let mut start = other.first_line();
            for number in 0..RASTER {
                line.number = number;
                line.start = vec![start];
                other.run(&mut line);
                self.rows(&line, number_of_set, left)?;
                left = left.saturating_sub(line.len());
                other.next_line(&mut start);
            }
        }
        Ok(())
    }

    /// Ends both files with their checksums.
    pub fn finish(self) -> Result<[Written; 2], SinkError> {
        Ok([self.rows.finish()?, self.sets.finish()?])
    }
}
