//! What is known about one pixel, and about the speed of the machine.

use glam::DVec3;

use crate::clock::{Chain, Clock};
use crate::frame::Hit;
use crate::processor::Processor;
use crate::readout::Reader;
use crate::scene::Machine;
use crate::setup::Setup;
use crate::study::cost::frame_cycles;
use crate::study::error::{Comparison, Sample, Sheet};
use crate::word::Complete;

/// One pixel of the processor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe {
    /// Column from the left.
    pub column: u32,
    /// Line from the top.
    pub line: u32,
    /// What the ray meets.
    pub hit: Hit,
    /// Where, scene units; `None` on a miss.
    pub point: Option<DVec3>,
    /// Index of the sample that hit.
    pub steps: u32,
    /// Cycles from the pixel before it to this one, the pipeline empty at the start of the line.
    pub cycles: u64,
    /// Distance to the oracle's ground point in pixels, on the same sheet of the surface.
    pub error_px: Option<f64>,
    /// Which kind of pixel it is for the oracle.
    pub sheet: Sheet,
}

/// Looks at a pixel of a frame.
pub fn probe<W: Complete>(comparison: &Comparison<'_, W>, column: u32, line: u32) -> Probe {
    let Comparison { plan, fixed, .. } = *comparison;
    let mut processor = Processor::new(fixed);
    while processor.next_line() < line {
        processor.skip_line();
    }
    let mut wires = processor.wires();
    processor.run_line(&mut wires);
    let mut clock = Clock::new(Chain::new(fixed));
    let (mut before, mut cycles) = (0, 0);
    clock.take_line(&wires, |i, done| {
        if i == column as usize {
            cycles = done - before;
        }
        before = done;
    });
    let at = column as usize;
    let point = Reader::new(plan).pixel(&wires, at).map(|pixel| pixel.point);
    let sample = Sample { lines: vec![line], columns: vec![column] };
    let error = comparison.pixels(&sample).first().copied();
    Probe {
        column,
        line,
        hit: wires.hit[at],
        point,
        steps: if point.is_some() { wires.steps[at] } else { 0 },
        cycles,
        error_px: error.map(|error| error.total_px).filter(|error| !error.is_nan()),
        sheet: error.map_or(Sheet::Empty, |error| error.sheet),
    }
}

/// Speed of the emulated machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Modelled {
    /// Frames per second at the scene's clock.
    pub fps: f64,
    /// Clock in MHz.
    pub clock_mhz: f64,
    /// Lines whose cycles were counted.
    pub counted: u32,
    /// Lines of the frame.
    pub lines: u32,
}

impl Modelled {
    /// From the cycles of a frame.
    #[must_use]
    pub fn new(machine: &Machine, cycles: u64, counted: u32, lines: u32) -> Self {
        let clock_mhz = machine.clock_mhz;
        Self { fps: clock_mhz * 1e6 / cycles.max(1) as f64, clock_mhz, counted, lines }
    }
}

/// The frame rate from sampled lines.
pub fn modelled<W: Complete>(setup: &Setup<W>, machine: &Machine, sample: &Sample) -> Modelled {
    let mut clock = Clock::new(Chain::new(setup));
    let mut processor = Processor::new(setup);
    let mut wires = processor.wires();
    for &line in &sample.lines {
        while processor.next_line() < line {
            processor.skip_line();
        }
        processor.run_line(&mut wires);
        clock.take_line(&wires, |_, _| {});
    }
    Modelled::new(machine, frame_cycles(setup, &clock), sample.lines.len() as u32, setup.lines)
}
