//! The open files of units: each runs its unit on a line and writes the wires before and after.

use super::hostile::Hostile;
use super::text::{Header, Sheet, Written};
use super::units::{self, Unit};
use super::wires::Wire;
use super::{Files, shading};
use crate::clock::Chain;
use crate::setup::{Back, Setup, TerrainUnits};
use crate::sink::SinkError;
use crate::unit::Line;
use crate::unit::checker::Checker;
use crate::unit::divider::Divider;
use crate::word::Complete;

/// The open file of a unit.
pub struct Bench<'a, W: Complete> {
    unit: Unit<'a, W>,
    sheet: Sheet<'a>,
}

impl<'a, W: Complete> Bench<'a, W> {
    /// The header of a unit's file.
    pub fn header(files: &Files<'_>, world: &W, unit: &Unit<'_, W>) -> Header {
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

    /// Begins the file of a unit.
    pub fn begin(files: &Files<'a>, world: &W, unit: Unit<'a, W>) -> Result<Self, SinkError> {
        let header = Self::header(files, world, &unit);
        Ok(Self { sheet: Sheet::begin(files.folder, files.scene, &header)?, unit })
    }

    /// Runs the unit on a line and writes a row for every pixel.
    pub fn run(
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

    /// Closes the file.
    pub fn finish(self) -> Result<Written, SinkError> {
        self.sheet.finish()
    }
}

/// The open files of the units behind the divider.
pub enum Behind<'a, W: Complete> {
    /// Stepper, interpolator, shader of a height map.
    Terrain(&'a TerrainUnits<W>, Box<[Bench<'a, W>; 3]>),
    /// Shader of a plane.
    Plane(&'a Checker<W>, Box<Bench<'a, W>>),
}

impl<'a, W: Complete> Behind<'a, W> {
    /// Begins their files.
    pub fn begin(
        files: &Files<'a>,
        setup: &'a Setup<W>,
        chain: &'a Chain,
    ) -> Result<Self, SinkError> {
        let world = &setup.world;
        let begin = |unit| Bench::begin(files, world, unit);
        Ok(match &setup.back {
            Back::Terrain(units) => {
                let stepper = begin(units::stepper(world, units, chain))?;
                let interpolator = begin(units::interpolator(world, &units.interpolator))?;
                let shader = begin(shading::shader(world, &units.shader))?;
                Self::Terrain(units, Box::new([stepper, interpolator, shader]))
            }
            Back::Plane(unit) => Self::Plane(unit, Box::new(begin(shading::checker(world, unit))?)),
        })
    }

    /// One line of the scene through all of them.
    pub fn run(&mut self, line: &mut Line<W>) -> Result<(), SinkError> {
        match self {
            Self::Terrain(units, benches) => {
                let [stepper, interpolator, shader] = &mut **benches;
                stepper.run(line, false, |line| units.stepper.run(line, &units.interpolator))?;
                interpolator.run(line, false, |line| units.interpolator.run(line))?;
                shader.run(line, false, |line| units.shader.run(line))
            }
            Self::Plane(unit, checker) => checker.run(line, false, |line| unit.run(line)),
        }
    }

    /// Hostile rows of each of them.
    pub fn run_hostile(
        &mut self,
        hostile: &mut Hostile<W>,
        divider: Option<&Divider<W>>,
        count: u32,
    ) -> Result<(), SinkError> {
        match self {
            Self::Terrain(units, benches) => {
                let [stepper, interpolator, shader] = &mut **benches;
                let mut line = hostile.stepper(units, divider, count);
                stepper
                    .run(&mut line, true, |line| units.stepper.run(line, &units.interpolator))?;
                let mut line = hostile.interpolator(units, count);
                interpolator.run(&mut line, true, |line| units.interpolator.run(line))?;
                let mut line = hostile.shader(units, count);
                shader.run(&mut line, true, |line| units.shader.run(line))
            }
            Self::Plane(unit, checker) => {
                let mut line = hostile.checker(unit, divider, count);
                checker.run(&mut line, true, |line| unit.run(line))
            }
        }
    }

    /// Closes their files.
    pub fn finish(self) -> Result<Vec<Written>, SinkError> {
        match self {
            Self::Terrain(_, benches) => benches.into_iter().map(Bench::finish).collect(),
            Self::Plane(_, checker) => Ok(vec![checker.finish()?]),
        }
    }
}
