//! What a frame costs the machine: cycles by the recurrence, operations by the tally world, reads
//! from what the stepper did.

use serde::Serialize;

use super::error::Sample;
use crate::clock::{Chain, Clock};
use crate::engine::InFixedWorld;
use crate::frame::Hit;
use crate::plan::Plan;
use crate::processor::{self, Processor};
use crate::scene::Scene;
use crate::setup::{Back, Memory, Setup, SetupError};
use crate::unit::Line;
use crate::unit::divider::Method;
use crate::unit::interpolator::Form;
use crate::word::tally::{Operations, Tally, counted};
use crate::word::{Complete, Register, World};

/// Cost of one unit, per pixel of the frame.
#[derive(Clone, Debug, Serialize)]
pub struct UnitCost {
    /// Unit.
    pub name: &'static str,
    /// Cycles from its work's end to the next unit.
    pub latency_cycles: u32,
    /// Items that it holds.
    pub depth: u32,
    /// Cycles of work.
    pub busy_cycles_per_pixel: f64,
    /// Cycles in which it waited for the next unit.
    pub stalled_cycles_per_pixel: f64,
    /// Additions, those inside its multipliers and dividers included.
    pub additions_per_pixel: f64,
    /// Products among them.
    pub products_per_pixel: f64,
    /// Reads of heights and pyramid.
    pub memory_reads_per_pixel: f64,
    /// Reads of tables.
    pub table_reads_per_pixel: f64,
}

/// Cost of a frame.
#[derive(Clone, Debug, Serialize)]
pub struct Cost {
    /// Lines whose cycles were counted.
    pub cycle_lines: usize,
    /// Lines whose operations were counted.
    pub operation_lines: usize,
    /// Lines of the frame.
    pub lines: u32,
    /// Cycles of the frame; from all lines if all were counted, else scaled from those.
    pub cycles: u64,
    /// Cycles per pixel.
    pub cycles_per_pixel: f64,
    /// Additions of the frame.
    pub additions: u64,
    /// Additions per pixel.
    pub additions_per_pixel: f64,
    /// Frames per second at the scene's clock.
    pub modelled_fps: f64,
    /// The unit with most cycles of work.
    pub limit: &'static str,
    /// Unit by unit.
    pub units: Vec<UnitCost>,
}

/// The measurement, to be run in a fixed world.
#[derive(Clone, Copy, Debug)]
pub struct Measure<'a> {
    /// Scene.
    pub scene: &'a Scene,
    /// Its plan.
    pub plan: &'a Plan,
    /// Lines whose cycles are counted.
    pub cycles: &'a Sample,
    /// Lines whose operations are counted.
    pub operations: &'a Sample,
}

/// Reads of a pixel.
#[derive(Clone, Copy, Debug, Default)]
struct Reads {
    memory: u64,
    table: u64,
}

impl InFixedWorld for Measure<'_> {
    type Output = Result<Cost, SetupError>;

    fn run<W: Complete>(self, world: W) -> Self::Output {
        let memory = Memory::new(&world, self.scene, self.plan)?;
        let setup = Setup::new(world, self.scene, self.plan, memory.as_ref())?;
        let chain = Chain::new(&setup, &self.scene.machine, self.plan.fitted.idle);
        let mut clock = Clock::new(chain);
        let mut reads = [Reads::default(); 3];
        let mut line = Processor::new(&setup).wires();
        processor::run_lines(&setup, &mut line, self.cycles.lines.iter().copied(), |line| {
            clock.take_line(line, |_, _| {});
            count_reads(&setup, line, &mut reads);
        });
        let operations = self.operations(Tally(world))?;
        Ok(self.report(&setup, &clock, reads, &operations))
    }
}

impl Measure<'_> {
    /// Operations per unit over the sampled lines, pixels counted.
    fn operations<W: Complete>(
        &self,
        world: W,
    ) -> Result<Vec<(&'static str, Operations)>, SetupError> {
        let memory = Memory::new(&world, self.scene, self.plan)?;
        let setup = Setup::new(world, self.scene, self.plan, memory.as_ref())?;
        let mut start = setup.projector.first_line();
        let mut line = Processor::new(&setup).wires();
        let mut totals: Vec<(&'static str, Operations)> = Vec::new();
        let mut add = |name, done: Operations| {
            let at = totals.iter().position(|(known, _)| *known == name).unwrap_or_else(|| {
                totals.push((name, Operations::default()));
                totals.len() - 1
            });
            let total = &mut totals[at].1;
            total.additions += done.additions;
            total.products += done.products;
            total.ratios += done.ratios;
            total.shifts += done.shifts;
        };
        for number in 0..setup.lines {
            if self.operations.lines.binary_search(&number).is_ok() {
                line.number = number;
                add("projector", counted(|| setup.projector.run(&start, &mut line)).1);
                if let Some(divider) = &setup.divider {
                    add("divider", counted(|| divider.run(&mut line, Method::Array)).1);
                }
                match &setup.back {
                    Back::Terrain(units) => {
                        let stepper = || units.stepper.run(&mut line, &units.interpolator);
                        add("stepper", counted(stepper).1);
                        add("interpolator", counted(|| units.interpolator.run(&mut line)).1);
                        add("shader", counted(|| units.shader.run(&mut line)).1);
                    }
                    // The chain has one name for the stage before the frame.
                    Back::Plane(checker) => add("shader", counted(|| checker.run(&mut line)).1),
                }
            }
            setup.projector.next_line(&mut start);
        }
        Ok(totals)
    }

    fn report<W: Complete>(
        &self,
        setup: &Setup<W>,
        clock: &Clock,
        reads: [Reads; 3],
        operations: &[(&'static str, Operations)],
    ) -> Cost {
        let pixels = clock.items().max(1) as f64;
        let operation_pixels =
            (self.operations.lines.len() as f64 * f64::from(setup.columns)).max(1.0);
        let point = |register| {
            setup.world.fixed(register).map_or(0, |fixed: crate::word::Fixed| fixed.point)
        };
        let ratio = setup.divider.as_ref().map_or(0, |d| u64::from(d.bits + 3));
        let units: Vec<UnitCost> = clock
            .occupancy()
            .map(|(stage, occupancy)| {
                let done = operations
                    .iter()
                    .find(|(name, _)| *name == stage.name)
                    .map_or(Operations::default(), |(_, done)| *done);
                // A shift-and-add multiplier adds once per bit of its multiplier.
                let per_product = match stage.name {
                    "shader" => point(Register::Shade) + 1,
                    _ => point(Register::Weight) + 1,
                };
                let additions =
                    done.additions + done.products * u64::from(per_product) + done.ratios * ratio;
                let read = match stage.name {
                    "stepper" => reads[0],
                    "interpolator" => reads[1],
                    "shader" => reads[2],
                    _ => Reads::default(),
                };
                UnitCost {
                    name: stage.name,
                    latency_cycles: stage.latency,
                    depth: stage.depth,
                    busy_cycles_per_pixel: occupancy.busy as f64 / pixels,
                    stalled_cycles_per_pixel: occupancy.stalled as f64 / pixels,
                    additions_per_pixel: additions as f64 / operation_pixels,
                    products_per_pixel: done.products as f64 / operation_pixels,
                    memory_reads_per_pixel: read.memory as f64 / pixels,
                    table_reads_per_pixel: read.table as f64 / pixels,
                }
            })
            .collect();
        let frame_pixels = f64::from(setup.columns) * f64::from(setup.lines);
        let cycles = frame_cycles(setup, clock);
        let additions_per_pixel: f64 = units.iter().map(|unit| unit.additions_per_pixel).sum();
        Cost {
            cycle_lines: self.cycles.lines.len(),
            operation_lines: self.operations.lines.len(),
            lines: setup.lines,
            cycles,
            cycles_per_pixel: cycles as f64 / frame_pixels,
            additions: (additions_per_pixel * frame_pixels).round() as u64,
            additions_per_pixel,
            modelled_fps: self.scene.machine.clock_mhz * 1e6 / cycles as f64,
            limit: clock.limit(),
            units,
        }
    }
}

/// Cycles of the whole frame, from a clock that took some of its lines; of all lines, exactly.
pub fn frame_cycles<W: World>(setup: &Setup<W>, clock: &Clock) -> u64 {
    let frame_pixels = u64::from(setup.columns) * u64::from(setup.lines);
    if clock.items() == frame_pixels {
        return clock.cycles();
    }
    // The pipeline fills once, however many lines are counted.
    let fill: u64 = clock.occupancy().map(|(stage, _)| u64::from(stage.latency)).sum();
    let flowing = clock.cycles().saturating_sub(fill) as f64;
    fill + (flowing / clock.items().max(1) as f64 * frame_pixels as f64).round() as u64
}

/// Adds the reads of a line: of the stepper, the interpolator and the shader.
fn count_reads<W: World>(setup: &Setup<W>, line: &Line<W>, reads: &mut [Reads; 3]) {
    let Back::Terrain(units) = &setup.back else { return };
    let nodes = if units.interpolator.form == Form::Stretch { 9 } else { 4 };
    let tables = if units.interpolator.rom.is_some() { 2 } else { 0 };
    for (work, hit) in line.work.iter().zip(&line.hit) {
        let interpolations = u64::from(work.samples + work.halvings);
        reads[0].memory += u64::from(work.trials) + interpolations * nodes;
        reads[0].table += interpolations * tables;
        if matches!(hit, Hit::Surface | Hit::Side) {
            reads[1].memory += nodes;
            reads[1].table += 2 * tables;
            reads[2].table += u64::from(units.shader.light.is_some() && *hit == Hit::Surface);
        }
    }
}
