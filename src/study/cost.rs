//! What a frame costs the machine: cycles by the recurrence, operations by the tally world, reads
//! from what the stepper did.

use serde::Serialize;

use super::error::Sample;
use crate::clock::{Chain, Clock};
use crate::engine::{Machine, Memories, WithSetup};
use crate::plan::Plan;
use crate::processor::{self, Processor};
use crate::scene::Scene;
use crate::setup::{Setup, SetupError};
use crate::unit::{Reads, Unit, divider};
use crate::word::tally::{Operations, Tally, counted};
use crate::word::{Complete, World};

/// Cost of one unit, per pixel of the frame.
#[derive(Clone, Debug, Default, Serialize)]
pub struct UnitCost {
    /// Name of the unit.
    pub name: &'static str,
    /// Cycles from its work's end to the next unit.
    pub latency_cycles: u32,
    /// Items that it holds.
    pub depth: u32,
    /// Cycles of work on an item, mean over the pixels.
    pub busy_cycles_per_pixel: f64,
    /// Cycles in which it waited for the next unit.
    pub stalled_cycles_per_pixel: f64,
    /// Additions, those inside its multipliers and dividers included.
    pub additions_per_pixel: f64,
    /// Products, whose additions are counted above.
    pub products_per_pixel: f64,
    /// Reads of heights and pyramid.
    pub memory_reads_per_pixel: f64,
    /// Reads of the kernel's and the light's tables.
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
    /// Cycles of the frame by its pixels.
    pub cycles_per_pixel: f64,
    /// Additions of the frame.
    pub additions: u64,
    /// Additions of the frame by its pixels.
    pub additions_per_pixel: f64,
    /// Frames per second at the scene's clock.
    pub modelled_fps: f64,
    /// The unit with most cycles of work.
    pub limit: &'static str,
    /// The same for every unit, in their order.
    pub units: Vec<UnitCost>,
}

impl Machine<'_> {
    /// The cost of a frame: cycles from the lines of one sample, operations from those of another,
    /// which may have none.
    ///
    /// # Errors
    /// If the scene cannot be set up to have its operations counted.
    pub fn cost(&self, cycles: &Sample, operations: &Sample) -> Result<Cost, SetupError> {
        self.run(Measure { scene: self.scene(), plan: self.plan(), cycles, operations })
    }
}

/// The measurement in a fixed world.
struct Measure<'a> {
    scene: &'a Scene,
    plan: &'a Plan,
    cycles: &'a Sample,
    operations: &'a Sample,
}

impl WithSetup for Measure<'_> {
    type Output = Result<Cost, SetupError>;

    fn run<W: Complete>(self, setup: &Setup<W>) -> Self::Output {
        let chain = setup.chain();
        let mut clock = Clock::new(Chain::new(setup));
        let mut reads = vec![Reads::default(); chain.len()];
        let mut line = Processor::new(setup).wires();
        processor::run_lines(setup, &mut line, self.cycles.lines.iter().copied(), |line| {
            clock.take_line(line, |_, _| {});
            for (unit, reads) in chain.iter().zip(&mut reads) {
                for (&work, &hit) in line.work.iter().zip(&line.hit) {
                    let of_pixel = unit.reads(work, hit);
                    reads.memory += of_pixel.memory;
                    reads.table += of_pixel.table;
                }
            }
        });
        let operations = if self.operations.is_empty() {
            vec![Operations::default(); chain.len()]
        } else {
            self.operations(Tally(setup.world))?
        };
        Ok(self.report(setup, &clock, &reads, &operations))
    }
}

impl Measure<'_> {
    /// Operations of every unit over the sampled lines.
    fn operations<W: Complete>(&self, world: W) -> Result<Vec<Operations>, SetupError> {
        let setup = Memories::default().set_up(world, self.scene, self.plan)?;
        let mut processor = Processor::new(&setup);
        let mut line = processor.wires();
        let mut totals = vec![Operations::default(); processor.chain().len()];
        for &number in &self.operations.lines {
            processor.skip_to(number);
            processor.begin(&mut line);
            for (unit, total) in processor.chain().iter().zip(&mut totals) {
                *total += counted(|| unit.run(&mut line)).1;
            }
        }
        Ok(totals)
    }

    fn report<W: Complete>(
        &self,
        setup: &Setup<W>,
        clock: &Clock,
        reads: &[Reads],
        operations: &[Operations],
    ) -> Cost {
        let pixels = clock.items().max(1) as f64;
        let operation_pixels =
            (self.operations.lines.len() as f64 * f64::from(setup.columns)).max(1.0);
        // A shift-and-add multiplier adds once per bit of its multiplier, a divider once per
        // quotient bit and at its ends.
        let additions = |unit: &dyn Unit<W>, done: &Operations| {
            let multiplier = setup.world.fixed(unit.description().multiplier);
            let per_product = multiplier.map_or(0, |fixed| fixed.point) + 1;
            let per_ratio = unit.quotient_bits() + divider::ENDS;
            done.additions
                + done.products * u64::from(per_product)
                + done.ratios * u64::from(per_ratio)
        };
        let of_units = &clock.chain().of_units;
        let units: Vec<UnitCost> = clock
            .occupancy()
            .enumerate()
            .map(|(at, (stage, occupancy))| {
                let mut cost = UnitCost {
                    name: stage.name,
                    latency_cycles: stage.timing.latency,
                    depth: stage.timing.depth,
                    busy_cycles_per_pixel: occupancy.busy as f64 / pixels,
                    stalled_cycles_per_pixel: occupancy.stalled as f64 / pixels,
                    ..UnitCost::default()
                };
                let chain = setup.chain().into_iter().zip(of_units).zip(reads).zip(operations);
                let (mut sums, mut products, mut read) = (0, 0, Reads::default());
                for (((unit, _), reads), done) in chain.filter(|(((_, of), _), _)| **of == at) {
                    sums += additions(unit, done);
                    products += done.products;
                    read.memory += reads.memory;
                    read.table += reads.table;
                }
                cost.additions_per_pixel = sums as f64 / operation_pixels;
                cost.products_per_pixel = products as f64 / operation_pixels;
                cost.memory_reads_per_pixel = read.memory as f64 / pixels;
                cost.table_reads_per_pixel = read.table as f64 / pixels;
                cost
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
            modelled_fps: self.scene.machine.frames_per_second(cycles),
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
    let fill: u64 = clock.occupancy().map(|(stage, _)| u64::from(stage.timing.latency)).sum();
    let flowing = clock.cycles().saturating_sub(fill) as f64;
    fill + (flowing / clock.items().max(1) as f64 * frame_pixels as f64).round() as u64
}
