//! The line-by-line processor: the reference engine. Units run in their order on one line after
//! another, every accumulator by additions only.
#![deny(clippy::float_arithmetic)]

use crate::setup::Setup;
use crate::unit::Line;
use crate::unit::divider::Method;
use crate::unit::projector::LineStart;
use crate::word::Complete;

/// Walks over the lines of a frame in scan order.
#[derive(Debug)]
pub struct Processor<'a, W: Complete> {
    setup: &'a Setup<W>,
    start: LineStart<W>,
    next: u32,
}

impl<'a, W: Complete> Processor<'a, W> {
    /// A processor at the first line.
    pub fn new(setup: &'a Setup<W>) -> Self {
        Self { setup, start: setup.projector.first_line(), next: 0 }
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
        line.number = self.next;
        let setup = self.setup;
        setup.projector.run(&self.start, line);
        if let Some(divider) = &setup.divider {
            divider.run(line, Method::Array);
        }
        setup.run_back(line);
        self.skip_line();
        true
    }

    /// Moves on to the next line without drawing this one: the line accumulators alone.
    pub fn skip_line(&mut self) {
        self.setup.projector.next_line(&mut self.start);
        self.next += 1;
    }

    /// The accumulators at the first column of the next line.
    pub fn line_start(&self) -> &LineStart<W> {
        &self.start
    }

    /// The line that [`Processor::run_line`] draws next.
    pub fn next_line(&self) -> u32 {
        self.next
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
        while processor.next_line() < number {
            processor.skip_line();
        }
        if !processor.run_line(line) {
            break;
        }
        take(line);
    }
}
