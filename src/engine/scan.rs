//! Frames drawn from the top, some lines at a time, until they are no longer wanted.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use super::list::Engine;
use super::machine::{Machine, in_fixed};
use super::memories::Ready;
use super::overflows::Overflows;
use crate::clock::{Chain, Clock};
use crate::fast::{self, enter::Enterable};
use crate::frame::Frame;
use crate::processor::Processor;
use crate::readout::Reader;
use crate::setup::{Setup, SetupError};
use crate::unit::Line;
use crate::word::Complete;

/// Whether the work is no longer wanted; asked between lines, or parts of them.
pub type Stop<'a> = &'a (dyn Fn() -> bool + Sync);

/// What is wanted of a scan beside colours and outcomes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted {
    /// The line to begin with; cycles are counted from there.
    pub first_line: u32,
    /// The buffers. The oracle gives them always.
    pub buffers: bool,
    /// The cycles of every pixel; the processor's units alone take any.
    pub cycles: bool,
}

/// Errors of a pixel in pixels; NaN where there are none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorParts {
    /// Of the machine, against the oracle.
    pub total: f64,
    /// Of its units in f64, against the oracle.
    pub algorithm: f64,
    /// Of the machine, against its units in f64.
    pub quantisation: f64,
}

/// Values of some whole lines.
#[derive(Debug, Default)]
pub struct Band {
    /// Their part of the frame; of no lines where errors are measured.
    pub frame: Frame,
    /// Cycles of each pixel, if they are counted.
    pub cycles: Vec<u32>,
    /// Cycles since the first line, if they are counted.
    pub cycles_so_far: u64,
    /// Overflows, where registers may have any.
    pub overflows: Overflows,
    /// Errors, if they are measured.
    pub errors: Vec<ErrorParts>,
    /// Silhouette pixels, if errors are measured.
    pub silhouettes: Vec<bool>,
}

impl Band {
    /// The lines below these, of the same scan.
    pub fn append(&mut self, below: Self) {
        self.frame.append(below.frame);
        self.cycles.extend(below.cycles);
        self.cycles_so_far = below.cycles_so_far;
        self.overflows.append(below.overflows);
        self.errors.extend(below.errors);
        self.silhouettes.extend(below.silhouettes);
    }

    /// Pixels that it holds values of.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.frame.color.len().max(self.errors.len())
    }
}

/// What draws some lines of a frame.
type Draw<'a> = dyn FnMut(Range<u32>, Stop<'_>) -> Option<Band> + 'a;

/// A frame being drawn from the top.
pub struct Scan<'a> {
    /// Those that are not drawn yet.
    lines: Range<u32>,
    draw: Box<Draw<'a>>,
}

impl<'a> Scan<'a> {
    /// Lines that are drawn by `draw`, some at a time; `None` where that was stopped.
    pub fn new(
        lines: Range<u32>,
        draw: impl FnMut(Range<u32>, Stop<'_>) -> Option<Band> + 'a,
    ) -> Self {
        Self { lines, draw: Box::new(draw) }
    }

    /// Draws up to `count` lines more; `None` if it was stopped, after which it is of no use.
    pub fn draw(&mut self, count: u32, stop: Stop<'_>) -> Option<Band> {
        let Range { start, end } = self.lines;
        self.lines.start = start.saturating_add(count).min(end);
        (self.draw)(start..self.lines.start, stop)
    }

    /// Draws all lines that are left.
    pub fn finish(mut self) -> Band {
        self.draw(u32::MAX, &|| false).unwrap_or_else(|| unreachable!("nobody stops it"))
    }
}

impl Machine<'_> {
    /// An engine at a line.
    ///
    /// # Errors
    /// If the scene cannot be set up in the engine's world; for the fast engine also in worlds that
    /// do not wrap, see [`FixedWorld::wraps`](super::FixedWorld::wraps).
    pub fn scan(&self, engine: Engine, wanted: Wanted) -> Result<Scan<'_>, SetupError> {
        let lines = wanted.first_line..self.plan.geometry.lines;
        let watched = self.world().can_overflow();
        Ok(match engine {
            Engine::Processor => {
                in_fixed!(&self.fixed, ready => self.processor(&ready.setup, lines, wanted, watched))
            }
            Engine::Fast if !self.world().wraps() => return Err(SetupError::Saturating),
            Engine::Fast => {
                in_fixed!(&self.fixed, ready => self.fast(ready, lines, wanted, watched))
            }
            Engine::Real => self.processor(self.real()?, lines, wanted, false),
            Engine::Oracle => {
                let oracle = self.oracle();
                Scan::new(lines, |lines, stop| {
                    Some(Band { frame: oracle.draw(lines, stop)?, ..Band::default() })
                })
            }
        })
    }

    /// The frame of an engine, on request with its buffers.
    ///
    /// # Errors
    /// As [`Machine::scan`].
    pub fn frame(&self, engine: Engine, buffers: bool) -> Result<Frame, SetupError> {
        Ok(self.scan(engine, Wanted { buffers, ..Wanted::default() })?.finish().frame)
    }

    /// The fast engine's frame at every SIMD level of this processor, the widest first.
    #[must_use]
    pub fn frames_at_every_level(&self, buffers: bool) -> Vec<Frame> {
        in_fixed!(&self.fixed, ready => {
            let source = self.source(ready);
            fast::levels().into_iter().map(|level| fast::render_at(level, source, buffers)).collect()
        })
    }

    /// What the fast engine draws from; its map is made now if it has not drawn before.
    fn source<'a, W: Enterable>(&'a self, ready: &'a Ready<W>) -> fast::Source<'a, W> {
        let maps = ready.maps(self.scene, self.plan);
        fast::Source { setup: &ready.setup, maps, plan: self.plan }
    }

    fn fast<'a, W: Enterable>(
        &'a self,
        ready: &'a Ready<W>,
        lines: Range<u32>,
        wanted: Wanted,
        watched: bool,
    ) -> Scan<'a> {
        let source = self.source(ready);
        Scan::new(lines, move |lines, stop| {
            let overflows = Mutex::new(Overflows::default());
            let inspect = |line: &Line<W>| {
                overflows.lock().unwrap_or_else(PoisonError::into_inner).inspect(line);
            };
            let look: &(dyn Fn(&Line<W>) + Sync) = if watched { &inspect } else { &|_| {} };
            let frame = fast::draw(source, lines, wanted.buffers, look, stop)?;
            let overflows = overflows.into_inner().unwrap_or_else(PoisonError::into_inner);
            Some(Band { frame, overflows, ..Band::default() })
        })
    }

    /// The units in their order, with their clock where cycles are counted.
    fn processor<'a, W: Complete>(
        &'a self,
        setup: &'a Setup<W>,
        lines: Range<u32>,
        wanted: Wanted,
        watched: bool,
    ) -> Scan<'a> {
        let reader = Reader::new(self.plan);
        let mut processor = Processor::new(setup);
        processor.skip_to(lines.start);
        let mut line = processor.wires();
        let mut clock = wanted.cycles.then(|| Clock::new(Chain::new(setup)));
        Scan::new(lines, move |lines, stop| {
            let frame = Frame::with_room(line.len(), lines.len(), wanted.buffers);
            let mut band = Band { frame, ..Band::default() };
            for _ in lines {
                if stop() {
                    return None;
                }
                processor.run_line(&mut line);
                reader.push(&line, &mut band.frame);
                if watched {
                    band.overflows.inspect(&line);
                }
                if let Some(clock) = &mut clock {
                    let mut before = clock.cycles();
                    clock.take_line(&line, |_, done| {
                        band.cycles.push((done - before) as u32);
                        before = done;
                    });
                    band.cycles_so_far = clock.cycles();
                }
            }
            Some(band)
        })
    }
}
