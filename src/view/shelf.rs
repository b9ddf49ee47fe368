//! What has been drawn of a view, kept until the view changes: another picture of it then shows at
//! once, and the scan goes on where it was.

use super::end::End;
use super::order::Order;
use super::pane::Source;
use crate::engine::{Band, Engine, Machine, Scan, Stop, Wanted};
use crate::setup::SetupError;
use crate::study::error::Sample;

/// Bytes beyond which what is not shown is given up, the longest unused first.
const MOST_BYTES: usize = 512 << 20;

/// A source and the panes that show it.
pub(super) struct Task {
    pub source: Source,
    pub panes: Vec<usize>,
}

impl Task {
    /// Whether one of its panes shows buffers.
    fn needs_buffers(&self, order: &Order) -> bool {
        self.panes.iter().any(|&pane| order.panes[pane].picture.needs_buffers())
    }

    /// The source at a machine's first line.
    pub fn scan<'a>(
        &self,
        machine: &'a Machine<'_>,
        order: &Order,
    ) -> Result<Scan<'a>, SetupError> {
        match self.source {
            Source::Frame(engine) => {
                let buffers = self.needs_buffers(order);
                let cycles = engine == Engine::Processor;
                machine.scan(engine, Wanted { first_line: 0, buffers, cycles })
            }
            Source::Error => machine.scan_errors(Sample::all(machine.plan())),
        }
    }
}

/// A source's frame, as far as it is drawn.
pub(super) struct Progress<'a> {
    source: Source,
    buffers: bool,
    scan: Scan<'a>,
    /// The lines drawn so far.
    pub band: Band,
    /// How many they are.
    pub lines: u32,
    /// Seconds that they took.
    pub seconds: f64,
}

impl<'a> Progress<'a> {
    /// Draws up to `count` lines more.
    pub fn draw(&mut self, count: u32, stop: Stop<'_>) -> Result<(), End> {
        let start = std::time::Instant::now();
        self.band.append(self.scan.draw(count, stop).ok_or(End::Superseded)?);
        self.seconds += start.elapsed().as_secs_f64();
        self.lines += count;
        Ok(())
    }

    fn bytes(&self) -> usize {
        // As much as the buffers of a pixel take, or its errors, or its colour, outcome and cycles.
        self.band.pixels() * if self.buffers { 90 } else { 25 }
    }
}

/// Frames of one view.
pub(super) struct Shelf<'a> {
    machine: &'a Machine<'a>,
    /// The latest used last.
    kept: Vec<Progress<'a>>,
    /// Lines that the scan has let fall; `None` before it and at the full rate.
    pub fallen: Option<u32>,
}

impl<'a> Shelf<'a> {
    pub fn new(machine: &'a Machine<'a>) -> Self {
        Self { machine, kept: Vec::new(), fallen: None }
    }

    /// Lines of a frame.
    pub fn lines(&self) -> u32 {
        self.machine.plan().geometry.lines
    }

    /// What there is of a source.
    pub fn of(&self, source: Source) -> Option<&Progress<'a>> {
        self.kept.iter().find(|kept| kept.source == source)
    }

    /// Lines that there are of a source.
    pub fn lines_of(&self, source: Source) -> u32 {
        self.of(source).map_or(0, |kept| kept.lines)
    }

    /// Makes room for what an order shows: begun anew where a frame lacks the buffers.
    pub fn prepare(&mut self, order: &Order, tasks: &[Task]) -> Result<(), SetupError> {
        for task in tasks {
            let needs = task.needs_buffers(order);
            let at = self.kept.iter().position(|kept| kept.source == task.source);
            let known = at.map(|at| self.kept.remove(at)).filter(|kept| kept.buffers || !needs);
            self.kept.push(match known {
                Some(known) => known,
                None => Progress {
                    source: task.source,
                    buffers: needs || task.source == Source::Frame(Engine::Oracle),
                    scan: task.scan(self.machine, order)?,
                    band: Band::default(),
                    lines: 0,
                    seconds: 0.0,
                },
            });
        }
        let used = |kept: &[Progress<'_>]| kept.iter().map(Progress::bytes).sum::<usize>();
        while self.kept.len() > tasks.len() && used(&self.kept) > MOST_BYTES {
            self.kept.remove(0);
        }
        Ok(())
    }

    /// The frame of a task that was prepared.
    pub fn progress(&mut self, task: &Task) -> &mut Progress<'a> {
        let known = self.kept.iter_mut().find(|kept| kept.source == task.source);
        known.unwrap_or_else(|| unreachable!("it was prepared"))
    }

    /// Cycles of the whole frame, if the processor has drawn it.
    pub fn cycles(&self) -> Option<u64> {
        let whole = self.of(Source::Frame(Engine::Processor))?;
        (whole.lines == self.lines()).then_some(whole.band.cycles_so_far)
    }
}
