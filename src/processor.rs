//! The line-by-line processor: the reference engine. Units run in their order on one line after
//! another, every accumulator by additions only.
#![deny(clippy::float_arithmetic)]

use crate::setup::Setup;
use crate::unit::line::LineStart;
use crate::unit::{Line, Unit};
use crate::word::Complete;

/// Walks over the lines of a frame in scan order.
#[derive(Debug)]
pub struct Processor<'a, W: Complete> {
    setup: &'a Setup<W>,
    chain: Vec<&'a dyn Unit<W>>,
    start: Vec<LineStart<W>>,
    next: u32,
}

impl<'a, W: Complete> Processor<'a, W> {
    /// A processor at the first line.
    pub fn new(setup: &'a Setup<W>) -> Self {
        let start = setup.surfaces.iter().map(|units| units.projector.first_line()).collect();
        Self { setup, chain: setup.chain(), start, next: 0 }
    }

    /// Wires for all columns of a line.
    pub fn wires(&self) -> Line<W> {
        Line::new(&self.setup.world, 0..self.setup.columns)
    }

    /// Runs one line and moves on to the next; `false` after the last.
    pub fn run_line(&mut self, line: &mut Line<W>) -> bool {
        if self.next >= self.setup.lines {
            return false;
        }
        self.begin(line);
        for unit in &self.chain {
            unit.run(line);
        }
        self.skip_line();
        true
    }

    /// Puts the next line on wires, as the raster scan hands it to the projectors.
    pub fn begin(&self, line: &mut Line<W>) {
        line.number = self.next;
        line.start.clone_from(&self.start);
    }

    /// The units, in their order.
    pub fn chain(&self) -> &[&'a dyn Unit<W>] {
        &self.chain
    }

    /// Moves on to the next line without drawing this one: the line accumulators alone.
    pub fn skip_line(&mut self) {
        for (units, start) in self.setup.surfaces.iter().zip(&mut self.start) {
            units.projector.next_line(start);
        }
        self.next += 1;
    }

    /// Skips the lines before this one; nothing if it is behind already.
    pub fn skip_to(&mut self, number: u32) {
        while self.next < number {
            self.skip_line();
        }
    }
}

/// Runs chosen lines (ascending) of a frame, each on the given wires' columns, and hands every
/// finished line to `take`.
pub fn run_lines<W: Complete>(
    setup: &Setup<W>,
    line: &mut Line<W>,
    lines: impl IntoIterator<Item = u32>,
    mut take: impl FnMut(&Line<W>),
) {
    let mut processor = Processor::new(setup);
    for number in lines {
        processor.skip_to(number);
        if !processor.run_line(line) {
            break;
        }
        take(line);
    }
}
