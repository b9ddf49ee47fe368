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
use crate::unit::divider::Method;
use crate::word::Complete;

/// Runs a unit on a line.
type Run<'a, W> = Box<dyn Fn(&mut Line<W>) + 'a>;
/// Puts corner cases on the wires of so many pixels.
type Inputs<'a, W> = Box<dyn Fn(&mut Hostile<W>, u32) -> Line<W> + 'a>;

/// The open file of a unit.
struct Bench<'a, W: Complete> {
    unit: Unit<'a, W>,
    run: Run<'a, W>,
    sheet: Sheet<'a>,
}

/// The header of a unit's file.
pub fn header<W: Complete>(files: &Files<'_>, world: &W, unit: &Unit<'_, W>) -> Header {
    let mut lines = vec![format!("page docs/units/{}.md", unit.stem)];
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

impl<W: Complete> Bench<'_, W> {
    /// Runs the unit on a line and writes a row for every pixel.
    fn rows(&mut self, line: &mut Line<W>, hostile: bool) -> Result<(), SinkError> {
        let before = line.clone();
        (self.run)(line);
        for at in 0..line.len() {
            let bits = |wire: &Wire<'_, W>| wire.bits(&before, line, at, hostile);
            self.sheet.row(self.unit.wires.iter().map(bits))?;
        }
        Ok(())
    }
}

/// Neighbouring units: corner cases are drawn for the first one and go through all of them.
struct Group<'a, W: Complete> {
    inputs: Inputs<'a, W>,
    benches: Vec<Bench<'a, W>>,
}

/// The open files of the units behind the projector, in the order of the chain.
pub struct Benches<'a, W: Complete>(Vec<Group<'a, W>>);

impl<'a, W: Complete> Benches<'a, W> {
    /// Begins the files of the units that are fitted.
    pub fn begin(
        files: &Files<'a>,
        setup: &'a Setup<W>,
        chain: &'a Chain,
    ) -> Result<Self, SinkError> {
        let world = &setup.world;
        let open = |unit: Unit<'a, W>, run: Run<'a, W>| -> Result<Bench<'a, W>, SinkError> {
            let sheet = Sheet::begin(files.folder, files.scene, &header(files, world, &unit))?;
            Ok(Bench { unit, run, sheet })
        };
        let mut groups = Vec::new();
        let mut group = |inputs: Inputs<'a, W>, benches| groups.push(Group { inputs, benches });
        let divider = setup.divider.as_ref();
        if let Some(unit) = divider {
            let run = |line: &mut Line<W>| unit.run(line, Method::Array);
            let bench = open(units::divider(world, unit), Box::new(run))?;
            group(Box::new(|hostile, count| hostile.divider(unit, count)), vec![bench]);
        }
        match &setup.back {
            Back::Terrain(terrain) => {
                let TerrainUnits { stepper, interpolator, shader, .. } = &**terrain;
                let run = |line: &mut Line<W>| stepper.run(line, interpolator);
                let bench = open(units::stepper(world, terrain, chain), Box::new(run))?;
                let inputs =
                    move |hostile: &mut Hostile<W>, count| hostile.stepper(terrain, divider, count);
                group(Box::new(inputs), vec![bench]);

                let run = |line: &mut Line<W>| interpolator.run(line);
                let bench = open(units::interpolator(world, interpolator), Box::new(run))?;
                group(Box::new(|hostile, count| hostile.interpolator(terrain, count)), vec![bench]);

                let mut benches = Vec::new();
                if let Some(light) = &shader.light {
                    let run = |line: &mut Line<W>| light.run(line);
                    benches.push(open(shading::light(world, light), Box::new(run))?);
                }
                let run = |line: &mut Line<W>| shader.ramp.run(line);
                benches.push(open(shading::ramp(world, &shader.ramp), Box::new(run))?);
                group(Box::new(|hostile, count| hostile.surface(terrain, count)), benches);

                let run = |line: &mut Line<W>| shader.mixer.run(line);
                let mixer = open(shading::mixer(world, &shader.mixer), Box::new(run))?;
                let run = |line: &mut Line<W>| shader.pixel.run(line);
                let pixel = open(shading::pixel(world, &shader.pixel), Box::new(run))?;
                group(Box::new(|hostile, count| hostile.colors(count)), vec![mixer, pixel]);
            }
            Back::Plane(checker) => {
                let run = |line: &mut Line<W>| checker.run(line);
                let bench = open(shading::checker(world, checker), Box::new(run))?;
                let inputs =
                    move |hostile: &mut Hostile<W>, count| hostile.checker(checker, divider, count);
                group(Box::new(inputs), vec![bench]);
            }
        }
        Ok(Self(groups))
    }

    /// Runs all units on a line of the scene, which the projector has driven, and writes its rows.
    pub fn rows(&mut self, line: &mut Line<W>) -> Result<(), SinkError> {
        let mut benches = self.0.iter_mut().flat_map(|group| &mut group.benches);
        benches.try_for_each(|bench| bench.rows(line, false))
    }

    /// Writes so many corner cases of every unit.
    pub fn hostile_rows(&mut self, hostile: &mut Hostile<W>, count: u32) -> Result<(), SinkError> {
        for Group { inputs, benches } in &mut self.0 {
            let mut line = inputs(hostile, count);
            benches.iter_mut().try_for_each(|bench| bench.rows(&mut line, true))?;
        }
        Ok(())
    }

    /// Closes the files.
    pub fn finish(self) -> Result<Vec<Written>, SinkError> {
        let benches = self.0.into_iter().flat_map(|group| group.benches);
        benches.map(|bench| bench.sheet.finish()).collect()
    }
}
