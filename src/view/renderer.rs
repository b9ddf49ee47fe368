//! What the render worker knows: the pictures as far as they are drawn, and what is asked of it
//! while it draws.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::Instant;

use super::end::End;
use super::desk::{Desk, Wake};
use super::order::Order;
use super::pane::{Pane, Source};
use super::shelf::{Shelf, Task};
use super::snapshot::{Facts, Image, LineState, Snapshot};
use crate::engine::{Band, Engine, Machine, Memories};
use crate::plan::PlanError;
use crate::study::explain::text::text;

/// The state of the render worker.
pub(super) struct Renderer {
    pub memories: Memories,
    pub images: Vec<Image>,
    pub facts: Facts,
    /// Seconds per pixel of each source, as measured last.
    pub costs: HashMap<Source, f64>,
    /// When the latest snapshot was taken.
    pub taken: Instant,
    version: u64,
}

impl From<PlanError> for End {
    fn from(error: PlanError) -> Self {
        Self::Refused(error.into())
    }
}

/// A machine that is drawn for an order.
#[derive(Clone, Copy)]
pub(super) struct Job<'a> {
    pub machine: &'a Machine<'a>,
    pub order: &'a Order,
    pub desk: &'a Desk,
}

impl Renderer {
    /// With the memories that the first set-up has loaded.
    pub fn new(memories: Memories) -> Self {
        Self {
            memories,
            images: Vec::new(),
            facts: Facts::default(),
            costs: HashMap::new(),
            taken: Instant::now(),
            version: 0,
        }
    }

    /// Seconds per pixel that a source is expected to take.
    pub fn cost(&self, source: Source) -> f64 {
        self.costs.get(&source).copied().unwrap_or(match source {
            Source::Frame(Engine::Fast) => 0.2e-6,
            Source::Frame(Engine::Processor | Engine::Real) => 0.7e-6,
            Source::Frame(Engine::Oracle) => 6e-6,
            Source::Error => 2e-5,
        })
    }

    /// Seconds that a source's frame is expected to take from where it is.
    pub fn wait(&self, job: Job<'_>, shelf: &Shelf<'_>, source: Source) -> f64 {
        let left = shelf.lines() - shelf.lines_of(source);
        self.cost(source) * job.order.raster().0 as f64 * f64::from(left)
    }

    /// The pictures of an order, what lies under them kept until it is drawn over.
    pub fn begin(&mut self, order: &Order) {
        let (columns, lines) = order.raster();
        let image = |(i, &pane): (usize, &Pane)| {
            let last = self.images.get(i).or(self.images.first());
            let mut image = match last {
                Some(last) if last.pane.picture == pane.picture => last.resized(columns, lines),
                _ => Image::blank(pane, columns, lines),
            };
            image.pane = pane;
            image.note = None;
            if order.by_lines {
                image.states.fill(LineState::Old);
            }
            image
        };
        self.images = order.panes.iter().enumerate().map(image).collect();
    }

    /// Waits for lines and does meanwhile what else is wanted.
    pub fn granted(&mut self, job: Job<'_>, line: u32) -> Result<u32, End> {
        loop {
            match job.desk.wait(true) {
                Wake::Lines(count) => return Ok(count),
                wake => self.answer(wake, job, Some(line))?,
            }
        }
    }

    /// Does what else is wanted until a newer order comes.
    pub fn linger(&mut self, job: Job<'_>) -> Result<(), End> {
        loop {
            let wake = job.desk.wait(false);
            self.answer(wake, job, None)?;
        }
    }

    /// Does what else is wanted now.
    pub fn attend(&mut self, job: Job<'_>, scan: Option<u32>) -> Result<(), End> {
        while let Some(wake) = job.desk.poll() {
            self.answer(wake, job, scan)?;
        }
        Ok(())
    }

    fn answer(&mut self, wake: Wake, job: Job<'_>, scan: Option<u32>) -> Result<(), End> {
        let Job { machine, order, desk } = job;
        match wake {
            Wake::Superseded => return Err(End::Superseded),
            Wake::Look(place) => {
                self.facts.probe = match place {
                    Some((column, line)) => machine.probe(column, line)?,
                    None => None,
                };
                self.show(order, desk, scan);
            }
            Wake::Explain((column, line)) => {
                let (columns, lines) = order.raster();
                if (column as usize) < columns && (line as usize) < lines {
                    let explanation = machine.explain(column, line)?;
                    desk.say(text(&order.scene.name, machine.world().name(), &explanation));
                }
            }
            Wake::Lines(_) => {}
        }
        Ok(())
    }

    /// Paints what a source has drawn.
    pub fn paint(&mut self, order: &Order, task: &Task, drawn: &Band) {
        for &pane in &task.panes {
            if let Some(painted) = order.panes[pane].picture.with(drawn, order.errors(pane)) {
                self.images[pane].draw(painted);
            }
        }
    }

    /// Hands out a snapshot.
    pub fn show(&mut self, order: &Order, desk: &Desk, scan: Option<u32>) {
        self.version += 1;
        self.taken = Instant::now();
        desk.show(Snapshot {
            version: self.version,
            images: self.images.iter().cloned().map(Arc::new).collect(),
            facts: self.facts.clone(),
            scan,
            by_lines: order.by_lines,
        });
    }
}
