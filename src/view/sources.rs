//! Sources of values: engines that draw a frame from the top, some lines at a time.

use std::ops::Range;

use rayon::prelude::*;

use crate::clock::{Chain, Clock};
use crate::fast::{self, enter::Enterable};
use crate::frame::{Buffers, Frame};
use crate::oracle::Oracle;
use crate::plan::Plan;
use crate::processor::Processor;
use crate::readout::FrameBuilder;
use crate::scene::Machine;
use crate::setup::Setup;
use crate::study::error::{Comparison, PixelError, Sample, Sheet};
use crate::unit::Line;
use crate::word::Complete;

/// Whether the work is no longer wanted.
pub type Stop<'a> = &'a (dyn Fn() -> bool + Sync);

/// Values of some whole lines.
#[derive(Debug, Default)]
pub struct Band {
    /// First line.
    pub first: u32,
    /// Number of lines.
    pub lines: u32,
    /// The frame's part, if a frame is drawn.
    pub frame: Option<Frame>,
    /// Cycles of each pixel, if they are counted.
    pub cycles: Vec<u32>,
    /// Cycles since the first line, if they are counted.
    pub cycles_so_far: u64,
    /// Errors in pixels, if they are measured.
    pub errors: Vec<f64>,
    /// Silhouette pixels, if errors are measured.
    pub silhouettes: Vec<bool>,
}

/// A frame being drawn from the top.
pub trait Scan {
    /// Draws up to `count` lines more; `None` if it was stopped, after which it is of no use.
    fn draw(&mut self, count: u32, stop: Stop<'_>) -> Option<Band>;
}

/// The lines that come next.
fn next_lines(next: &mut u32, count: u32, lines: u32) -> Range<u32> {
    let first = *next;
    *next = first.saturating_add(count).min(lines);
    first..*next
}

/// The fast engine, on all threads.
pub struct FastScan<'a, W: Complete> {
    setup: &'a Setup<W>,
    map: Option<&'a fast::Map<W>>,
    plan: &'a Plan,
    buffers: bool,
    next: u32,
}

/// Lines of one task of the fast engine.
const TASK: u32 = 8;

impl<'a, W: Complete> FastScan<'a, W> {
    /// At the first line.
    pub fn new(
        setup: &'a Setup<W>,
        map: Option<&'a fast::Map<W>>,
        plan: &'a Plan,
        buffers: bool,
    ) -> Self {
        Self { setup, map, plan, buffers, next: 0 }
    }
}

impl<W: Enterable> Scan for FastScan<'_, W> {
    fn draw(&mut self, count: u32, stop: Stop<'_>) -> Option<Band> {
        let lines = next_lines(&mut self.next, count, self.setup.lines);
        let tasks = (lines.len() as u32).div_ceil(TASK);
        let parts: Option<Vec<FrameBuilder<'_>>> = (0..tasks)
            .into_par_iter()
            .map_init(
                || vec![Line::new(&self.setup.world, 0..self.setup.columns); fast::GROUP],
                |wires, task| {
                    let from = lines.start + task * TASK;
                    let numbers = from..lines.end.min(from + TASK);
                    let mut part = FrameBuilder::new(self.plan, numbers.len(), self.buffers, false);
                    for first in numbers.clone().step_by(fast::GROUP) {
                        if stop() {
                            return None;
                        }
                        let group = &mut wires[..fast::GROUP.min((numbers.end - first) as usize)];
                        fast::run_lines(self.setup, self.map, first, group);
                        group.iter().for_each(|line| part.push(line));
                    }
                    Some(part)
                },
            )
            .collect();
        let mut frame = FrameBuilder::new(self.plan, lines.len(), self.buffers, false);
        for part in parts? {
            frame.append(part);
        }
        let frame = Some(frame.finish());
        Some(Band { first: lines.start, lines: lines.len() as u32, frame, ..Band::default() })
    }
}

/// The line-by-line processor with its clock, in any world.
pub struct ProcessorScan<'a, W: Complete> {
    processor: Processor<'a, W>,
    line: Line<W>,
    clock: Clock,
    before: u64,
    plan: &'a Plan,
    buffers: bool,
    next: u32,
    lines: u32,
}

impl<'a, W: Complete> ProcessorScan<'a, W> {
    /// At the first line, with the cycles of a machine.
    pub fn new(setup: &'a Setup<W>, plan: &'a Plan, machine: &Machine, buffers: bool) -> Self {
        let processor = Processor::new(setup);
        Self {
            line: processor.wires(),
            processor,
            clock: Clock::new(Chain::new(setup, machine, plan.fitted.idle)),
            before: 0,
            plan,
            buffers,
            next: 0,
            lines: setup.lines,
        }
    }
}

impl<W: Complete> Scan for ProcessorScan<'_, W> {
    fn draw(&mut self, count: u32, stop: Stop<'_>) -> Option<Band> {
        let lines = next_lines(&mut self.next, count, self.lines);
        let mut frame = FrameBuilder::new(self.plan, lines.len(), self.buffers, false);
        let mut cycles = Vec::with_capacity(lines.len() * self.line.len());
        for _ in lines.clone() {
            if stop() {
                return None;
            }
            self.processor.run_line(&mut self.line);
            frame.push(&self.line);
            self.clock.take_line(&self.line, |_, done| {
                cycles.push((done - self.before) as u32);
                self.before = done;
            });
        }
        Some(Band {
            first: lines.start,
            lines: lines.len() as u32,
            frame: Some(frame.finish()),
            cycles,
            cycles_so_far: self.clock.cycles(),
            ..Band::default()
        })
    }
}

/// The oracle, on all threads.
pub struct OracleScan<'a> {
    oracle: &'a Oracle,
    columns: u32,
    lines: u32,
    next: u32,
}

impl<'a> OracleScan<'a> {
    /// At the first line.
    #[must_use]
    pub fn new(oracle: &'a Oracle, plan: &Plan) -> Self {
        let (columns, lines) = (plan.geometry.columns, plan.geometry.lines);
        Self { oracle, columns, lines, next: 0 }
    }
}

impl Scan for OracleScan<'_> {
    fn draw(&mut self, count: u32, stop: Stop<'_>) -> Option<Band> {
        let lines = next_lines(&mut self.next, count, self.lines);
        let columns = self.columns;
        let seen: Option<Vec<_>> = (lines.start * columns..lines.end * columns)
            .into_par_iter()
            .with_min_len(16)
            .map(|index| {
                let (line, column) = (index / columns, index % columns);
                (!stop()).then(|| self.oracle.pixel(line.into(), column.into()))
            })
            .collect();
        let seen = seen?;
        let buffers = Buffers {
            height: seen.iter().map(|s| s.point.y).collect(),
            normal: seen.iter().map(|s| s.normal.to_array()).collect(),
            steps: vec![0; seen.len()],
            ..Buffers::default()
        };
        let frame = Frame {
            columns: columns as usize,
            lines: lines.len(),
            color: seen.iter().map(|s| s.color).collect(),
            hit: seen.iter().map(|s| s.hit).collect(),
            buffers: Some(buffers),
        };
        let frame = Some(frame);
        Some(Band { first: lines.start, lines: lines.len() as u32, frame, ..Band::default() })
    }
}

/// Lines that are compared with the oracle at once, on all threads.
const AT_ONCE: usize = 4;

/// Errors against the oracle.
pub struct ErrorScan<'a, W: Complete> {
    comparison: Comparison<'a, W>,
    algorithm: bool,
    next: u32,
}

impl<'a, W: Complete> ErrorScan<'a, W> {
    /// At the first line; of the algorithm alone, or in all.
    pub fn new(comparison: Comparison<'a, W>, algorithm: bool) -> Self {
        Self { comparison, algorithm, next: 0 }
    }
}

impl<W: Complete> Scan for ErrorScan<'_, W> {
    fn draw(&mut self, count: u32, stop: Stop<'_>) -> Option<Band> {
        let geometry = &self.comparison.plan.geometry;
        let lines = next_lines(&mut self.next, count, geometry.lines);
        let mut band = Band { first: lines.start, lines: lines.len() as u32, ..Band::default() };
        let lines: Vec<u32> = lines.collect();
        for part in lines.chunks(AT_ONCE) {
            if stop() {
                return None;
            }
            let columns = (0..geometry.columns).collect();
            let pixels = self.comparison.pixels(&Sample { lines: part.to_vec(), columns });
            band.errors.extend(pixels.iter().map(|pixel| error_px(pixel, self.algorithm)));
            band.silhouettes.extend(pixels.iter().map(|p| p.sheet == Sheet::Silhouette));
        }
        Some(band)
    }
}

/// The error of a pixel: of the algorithm alone, or in all.
#[must_use]
pub fn error_px(pixel: &PixelError, algorithm: bool) -> f64 {
    if algorithm { pixel.algorithm_px } else { pixel.total_px }
}
