//! The projector's files. It has no input but its coefficients, so hostile rows have coefficients
//! of their own, each set scanned over a small raster; a second file lists the sets.

use super::Files;
use super::bench;
use super::hostile::{Hostile, RASTER};
use super::text::{Coefficient, Heading, Sheet, Way, Written};
use super::units::{Unit, projector};
use super::wires::COUNT;
use crate::setup::Setup;
use crate::sink::SinkError;
use crate::unit::Line;
use crate::unit::projector::Projector;
use crate::word::Complete;

/// The open files of the projector.
pub struct Scan<'a, W: Complete> {
    world: W,
    unit: Unit<'a, W>,
    rows: Sheet<'a>,
    sets: Sheet<'a>,
}

impl<'a, W: Complete> Scan<'a, W> {
    /// Begins both files.
    pub fn begin(files: &Files<'a>, setup: &Setup<W>) -> Result<Self, SinkError> {
        let unit = projector(&setup.world, &setup.projector);
        let mut header = bench::header(files, &setup.world, &unit);
        header.columns.insert(
            0,
            Heading {
                way: Way::In,
                name: "set".into(),
                notation: COUNT,
                meaning: "row of projector_coefficients.mem; 0 is the scene's",
            },
        );
        header.lines.push(format!("raster {RASTER} {RASTER} of every set but the scene's"));
        let rows = Sheet::begin(files.folder, files.scene, &header)?;
        header.stem = "projector_coefficients".into();
        header.holds = "coefficient sets of the projector, one a row";
        header.hostile = u64::from(files.vectors.hostile.div_ceil(RASTER * RASTER));
        header.rows = 1;
        let heading = |c: &Coefficient| Heading {
            way: Way::Word,
            name: c.name.clone(),
            notation: c.notation,
            meaning: c.meaning,
        };
        header.columns = unit.coefficients.iter().map(heading).collect();
        let mut sets = Sheet::begin(files.folder, files.scene, &header)?;
        sets.row(unit.coefficients.iter().map(|c| Some(c.value)))?;
        Ok(Self { world: setup.world, unit, rows, sets })
    }

    /// Writes the first pixels of a line that the projector has driven with a set.
    pub fn rows(&mut self, line: &Line<W>, set: u32, most: usize) -> Result<(), SinkError> {
        for at in 0..line.len().min(most) {
            let wires = self.unit.wires.iter().map(|wire| wire.bits(line, line, at, false));
            self.rows.row(std::iter::once(Some(set.into())).chain(wires))?;
        }
        Ok(())
    }

    /// Writes hostile sets and so many rows of them.
    pub fn hostile_rows(
        &mut self,
        unit: &Projector<W>,
        hostile: &mut Hostile<W>,
        count: u32,
    ) -> Result<(), SinkError> {
        let mut line = Line::new(&self.world, 0..RASTER);
        for set in 1..=count.div_ceil(RASTER * RASTER) {
            let other = hostile.projector(unit);
            let coefficients = projector(&self.world, &other).coefficients;
            self.sets.row(coefficients.iter().map(|c| Some(c.value)))?;
            let mut left = (count - (set - 1) * RASTER * RASTER) as usize;
            let mut start = other.first_line();
            for number in 0..RASTER {
                line.number = number;
                other.run(&start, &mut line);
                self.rows(&line, set, left)?;
                left = left.saturating_sub(line.len());
                other.next_line(&mut start);
            }
        }
        Ok(())
    }

    /// Closes both files.
    pub fn finish(self) -> Result<[Written; 2], SinkError> {
        Ok([self.rows.finish()?, self.sets.finish()?])
    }
}
