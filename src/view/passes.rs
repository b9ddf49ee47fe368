//! One order, drawn: a preview first where a frame takes long, then line after line.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::setup::SetupError;

use super::drawing::{Desk, Order, Wake};
use super::machine::{Machine, Memories, machine};
use super::pane::Source;
use super::probe::Modelled;
use super::shown::{Facts, Image, LineState, Shown, Timing};
use super::values::{Task, Values};

/// Time between two moments that are shown.
const MOMENT: Duration = Duration::from_millis(25);

/// Lines drawn between two looks at what else is wanted.
const SEGMENT: Duration = Duration::from_millis(12);

/// Lines whose cycles are counted for the modelled frame rate.
const SAMPLED_LINES: u32 = 16;

/// The one who draws.
pub struct Drawer {
    pub(super) memories: Memories,
    pub(super) images: Vec<Image>,
    facts: Facts,
    /// Seconds per pixel of each source, as measured last.
    costs: HashMap<Source, f64>,
    version: u64,
    moment: Instant,
}

/// A newer order has come, or the end.
pub(super) struct Superseded;

impl Drawer {
    /// With the memories that the first set-up has loaded.
    #[must_use]
    pub fn new(memories: Memories) -> Self {
        Self {
            memories,
            images: Vec::new(),
            facts: Facts::default(),
            costs: HashMap::new(),
            version: 0,
            moment: Instant::now(),
        }
    }

    /// Draws an order and stays with it until a newer one comes.
    pub fn draw(&mut self, order: &Order, desk: &Desk) {
        let (columns, lines) = order.raster();
        self.images = (0..order.panes.len())
            .map(|i| {
                let last = self.images.get(i).or(self.images.first());
                let mut image = match last {
                    Some(last) => last.resized(columns, lines),
                    None => Image::blank(order.panes[i], columns, lines),
                };
                if image.pane.picture != order.panes[i].picture {
                    image = Image::blank(order.panes[i], columns, lines);
                }
                image.pane = order.panes[i];
                image.note = None;
                if order.by_lines {
                    image.states.fill(LineState::Old);
                }
                image
            })
            .collect();
        let machine = match machine(&order.scene, order.full, &self.memories) {
            Ok(machine) => machine,
            Err(error) => return self.stand_still(&error, order, desk),
        };
        self.facts.world = machine.world();
        self.facts.trouble = None;
        let result = self.work(&*machine, order, desk);
        if let Err(error) = result {
            self.stand_still(&error, order, desk);
        }
    }

    /// Says why nothing is drawn.
    fn stand_still(&mut self, error: &SetupError, order: &Order, desk: &Desk) {
        self.facts.trouble = Some(error.to_string());
        self.facts.probe = None;
        self.facts.modelled = None;
        self.facts.timings.clear();
        for image in &mut self.images {
            image.states.fill(LineState::Old);
        }
        self.show(order, desk, None);
        while !matches!(desk.wait(false), Wake::Superseded) {}
    }

    fn work(
        &mut self,
        machine: &dyn Machine,
        order: &Order,
        desk: &Desk,
    ) -> Result<(), SetupError> {
        let mut tasks: Vec<Task> = Vec::new();
        for (index, pane) in order.panes.iter().enumerate() {
            match pane.source(machine.wraps()) {
                Ok(source) => match tasks.iter_mut().find(|task| task.source == source) {
                    Some(task) => task.panes.push(index),
                    None => tasks.push(Task { source, panes: vec![index] }),
                },
                Err(note) => {
                    self.images[index] =
                        Image { note: Some(note), ..self.images[index].blank_like() };
                }
            }
        }
        // Quick ones first: they need not wait for the slow ones.
        tasks.sort_by(|a, b| self.cost(a.source).total_cmp(&self.cost(b.source)));
        let finished = match self.preview(machine, order, desk, &tasks)? {
            Err(Superseded) => Err(Superseded),
            Ok(()) if order.by_lines => self.by_lines(machine, order, desk, &tasks)?,
            Ok(()) => self.whole_frames(machine, order, desk, &tasks)?,
        };
        if finished.is_ok() {
            self.linger(machine, order, desk)?;
        }
        Ok(())
    }

    pub(super) fn cost(&self, source: Source) -> f64 {
        self.costs.get(&source).copied().unwrap_or(match source {
            Source::Fast => 0.2e-6,
            Source::Processor | Source::Real => 0.7e-6,
            Source::Oracle => 6e-6,
            Source::FixedError | Source::RealError => 2e-5,
        })
    }

    /// Every source's frame, one after the other, as fast as can be.
    fn whole_frames(
        &mut self,
        machine: &dyn Machine,
        order: &Order,
        desk: &Desk,
        tasks: &[Task],
    ) -> Result<Result<(), Superseded>, SetupError> {
        let lines = machine.plan().geometry.lines;
        let mut timings = Vec::new();
        let mut exact = None;
        for task in tasks {
            if self.refine(machine, order, desk, task)?.is_err() {
                return Ok(Err(Superseded));
            }
            let mut scan = machine.scan(task.source, task.needs_buffers(order))?;
            let mut values = Values::default();
            let (mut spent, mut segment, mut line) = (0.0, 16, 0);
            while line < lines {
                let start = Instant::now();
                let Some(band) = scan.draw(segment, &|| desk.superseded()) else {
                    return Ok(Err(Superseded));
                };
                let took = start.elapsed().as_secs_f64();
                spent += took;
                line += band.lines;
                exact = exact.max(Some(band.cycles_so_far).filter(|&cycles| cycles > 0));
                values.push(band);
                let better = f64::from(segment) * SEGMENT.as_secs_f64() / took.max(1e-6);
                segment = (better as u32).clamp(1, 256);
                if self.moment.elapsed() >= MOMENT || line == lines {
                    self.paint(order, task, &values);
                    self.show(order, desk, (line < lines).then_some(line));
                }
                let scan = (line < lines).then_some(line);
                if self.attend(machine, order, desk, scan)?.is_err() {
                    return Ok(Err(Superseded));
                }
            }
            let pixels = values.pixels().max(1) as f64;
            self.costs.insert(task.source, spent / pixels);
            timings
                .push(Timing { source: task.source, ms: 1e3 * (machine.set_up_seconds() + spent) });
            if task.source != Source::Processor {
                exact = None;
            }
        }
        self.facts.timings = timings;
        self.facts.modelled = Some(match exact {
            Some(cycles) => Modelled::new(&order.scene.machine, cycles, lines, lines),
            None => machine.modelled(SAMPLED_LINES),
        });
        self.show(order, desk, None);
        Ok(Ok(()))
    }

    /// Line after line as they are granted, all sources side by side; from the top again and again.
    fn by_lines(
        &mut self,
        machine: &dyn Machine,
        order: &Order,
        desk: &Desk,
        tasks: &[Task],
    ) -> Result<Result<(), Superseded>, SetupError> {
        self.facts.timings.clear();
        self.facts.modelled = Some(machine.modelled(SAMPLED_LINES));
        let lines = machine.plan().geometry.lines;
        loop {
            let mut scans = Vec::new();
            for task in tasks {
                scans.push((
                    task,
                    machine.scan(task.source, task.needs_buffers(order))?,
                    Values::default(),
                ));
            }
            let mut line = 0;
            self.show(order, desk, Some(line));
            while line < lines {
                let Some(granted) = self.granted(machine, order, desk, line)? else {
                    return Ok(Err(Superseded));
                };
                let (granted, over) = (granted.min(lines - line), granted);
                desk.give_back(over - granted);
                for (_, scan, values) in &mut scans {
                    let Some(band) = scan.draw(granted, &|| desk.superseded()) else {
                        return Ok(Err(Superseded));
                    };
                    values.push(band);
                }
                line += granted;
                if self.moment.elapsed() >= MOMENT || !desk.has_lines() || line == lines {
                    for (task, _, values) in &scans {
                        self.paint(order, task, values);
                    }
                    self.show(order, desk, Some(line));
                }
            }
            // The whole frame stands until the next line is due.
            let Some(granted) = self.granted(machine, order, desk, lines)? else {
                return Ok(Err(Superseded));
            };
            desk.give_back(granted);
            for image in &mut self.images {
                image.states.fill(LineState::Old);
            }
        }
    }

    /// Waits for lines and does meanwhile what else is wanted; `None` when superseded.
    fn granted(
        &mut self,
        machine: &dyn Machine,
        order: &Order,
        desk: &Desk,
        line: u32,
    ) -> Result<Option<u32>, SetupError> {
        loop {
            match desk.wait(true) {
                Wake::Superseded => return Ok(None),
                Wake::Lines(count) => return Ok(Some(count)),
                wake => self.answer(wake, machine, order, desk, Some(line))?,
            }
        }
    }

    /// Does what else is wanted until a newer order comes.
    fn linger(
        &mut self,
        machine: &dyn Machine,
        order: &Order,
        desk: &Desk,
    ) -> Result<(), SetupError> {
        loop {
            match desk.wait(false) {
                Wake::Superseded => return Ok(()),
                wake => self.answer(wake, machine, order, desk, None)?,
            }
        }
    }

    /// Does what else is wanted now.
    pub(super) fn attend(
        &mut self,
        machine: &dyn Machine,
        order: &Order,
        desk: &Desk,
        scan: Option<u32>,
    ) -> Result<Result<(), Superseded>, SetupError> {
        while let Some(wake) = desk.poll() {
            if matches!(wake, Wake::Superseded) {
                return Ok(Err(Superseded));
            }
            self.answer(wake, machine, order, desk, scan)?;
        }
        Ok(Ok(()))
    }

    fn answer(
        &mut self,
        wake: Wake,
        machine: &dyn Machine,
        order: &Order,
        desk: &Desk,
        scan: Option<u32>,
    ) -> Result<(), SetupError> {
        let (columns, lines) = order.raster();
        let inside = |(c, l): (u32, u32)| (c as usize) < columns && (l as usize) < lines;
        match wake {
            Wake::Look(place) => {
                self.facts.probe = match place.filter(|&place| inside(place)) {
                    Some((column, line)) => Some(machine.probe(column, line)?),
                    None => None,
                };
                self.show(order, desk, scan);
            }
            Wake::Explain(place) if inside(place) => {
                desk.say(order.explain(machine.plan(), place)?);
            }
            Wake::Explain(_) | Wake::Lines(_) | Wake::Superseded => {}
        }
        Ok(())
    }

    fn paint(&mut self, order: &Order, task: &Task, values: &Values) {
        for &pane in &task.panes {
            self.images[pane].draw(values.paint(order.panes[pane].picture));
        }
    }

    pub(super) fn show(&mut self, order: &Order, desk: &Desk, scan: Option<u32>) {
        self.version += 1;
        self.moment = Instant::now();
        desk.show(Shown {
            version: self.version,
            images: self.images.iter().cloned().map(Arc::new).collect(),
            facts: self.facts.clone(),
            scan,
            by_lines: order.by_lines,
        });
    }
}

impl Image {
    fn blank_like(&self) -> Self {
        Self::blank(self.pane, self.columns, self.lines)
    }
}
