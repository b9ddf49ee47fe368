//! One order, drawn: a preview first where a frame takes long, then line after line.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::plan::WordClass;
use crate::scene::{Scene, WordSize};
use crate::setup::SetupError;
use crate::sink::picture::{self, Painted, Picture};
use crate::study::error::{Sample, Sheet};

use super::drawing::{Desk, Order, Wake};
use super::machine::{Machine, Memories, machine};
use super::pane::Source;
use super::probe::Modelled;
use super::shown::{Facts, Image, LineState, Shown, Timing};
use super::sources::{Band, error_px};

/// A frame that takes longer is drawn coarsely first.
const PATIENCE: Duration = Duration::from_millis(30);

/// Time that a coarse frame may take.
const PREVIEW: f64 = 0.02;

/// Time between two moments that are shown.
const MOMENT: Duration = Duration::from_millis(25);

/// Lines drawn between two looks at what else is wanted.
const SEGMENT: Duration = Duration::from_millis(12);

/// Lines whose cycles are counted for the modelled frame rate.
const SAMPLED_LINES: u32 = 16;

/// The one who draws.
pub struct Drawer {
    memories: Memories,
    images: Vec<Image>,
    facts: Facts,
    /// Seconds per pixel of each source, as measured last.
    costs: HashMap<Source, f64>,
    version: u64,
    moment: Instant,
}

/// A newer order has come, or the end.
struct Superseded;

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
        let start = Instant::now();
        let machine = match machine(&order.scene, order.full, &self.memories) {
            Ok(machine) => machine,
            Err(error) => return self.stand_still(&error, order, desk),
        };
        let set_up = start.elapsed().as_secs_f64();
        self.facts.world = machine.world();
        self.facts.trouble = None;
        let result = self.work(&*machine, order, desk, set_up);
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
        set_up: f64,
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
            Ok(()) => self.whole_frames(machine, order, desk, &tasks, set_up)?,
        };
        if finished.is_ok() {
            self.linger(machine, order, desk, false)?;
        }
        Ok(())
    }

    fn cost(&self, source: Source) -> f64 {
        self.costs.get(&source).copied().unwrap_or(match source {
            Source::Fast => 0.2e-6,
            Source::Processor | Source::Real => 0.7e-6,
            Source::Oracle => 6e-6,
            Source::FixedError | Source::RealError => 2e-5,
        })
    }

    /// Coarse pictures of all panes, where the true ones would take long.
    fn preview(
        &mut self,
        machine: &dyn Machine,
        order: &Order,
        desk: &Desk,
        tasks: &[Task],
    ) -> Result<Result<(), Superseded>, SetupError> {
        let (columns, lines) = order.raster();
        let pixels = (columns * lines) as f64;
        let wait: f64 = tasks.iter().map(|task| self.cost(task.source) * pixels).sum();
        if wait < PATIENCE.as_secs_f64() && !order.by_lines {
            return Ok(Ok(()));
        }
        for task in tasks {
            let share = PREVIEW / tasks.len() as f64;
            let in_time = |f: &usize| self.cost(task.source) * pixels / (f * f) as f64 <= share;
            let factor = match task.source {
                // Below the falling scan the same coarse picture lies every time.
                Source::Fast | Source::Processor | Source::Real if order.by_lines => 4,
                _ if order.by_lines => 16,
                _ => (0..16).map(|power| 1 << power).find(in_time).unwrap_or(1),
            };
            let drawn = if matches!(task.source, Source::FixedError | Source::RealError) {
                self.sampled(machine, desk, task, factor.max(2))?
            } else {
                self.coarse(machine, order, desk, task, factor)?
            };
            if drawn.is_err() {
                return Ok(Err(Superseded));
            }
        }
        self.show(order, desk, Some(0));
        Ok(Ok(()))
    }

    /// A frame on a raster coarser by a whole number, enlarged.
    fn coarse(
        &mut self,
        machine: &dyn Machine,
        order: &Order,
        desk: &Desk,
        task: &Task,
        factor: usize,
    ) -> Result<Result<(), Superseded>, SetupError> {
        let scene = coarser(&order.scene, factor, machine.plan().words());
        // What the coarse raster cannot do does not matter: the true frame follows.
        let Ok(coarse) = self::machine(&Arc::new(scene), order.full, &self.memories) else {
            return Ok(Ok(()));
        };
        let mut scan = coarse.scan(task.source, task.needs_buffers(order))?;
        let Some(band) = scan.draw(u32::MAX, &|| desk.superseded()) else {
            return Ok(Err(Superseded));
        };
        let mut values = Values::default();
        values.push(band);
        for &pane in &task.panes {
            let painted = values.paint(order.panes[pane].picture);
            self.images[pane].spread(painted, factor);
        }
        Ok(Ok(()))
    }

    /// Errors of every pixel in the middle of a square.
    fn sampled(
        &mut self,
        machine: &dyn Machine,
        desk: &Desk,
        task: &Task,
        factor: usize,
    ) -> Result<Result<(), Superseded>, SetupError> {
        let geometry = &machine.plan().geometry;
        let middles = |count: u32| -> Vec<u32> {
            let middle = |from: u32| (from + factor as u32 / 2).min(count - 1);
            (0..count).step_by(factor).map(middle).collect()
        };
        let columns = middles(geometry.columns);
        let (mut errors, mut silhouettes) = (Vec::new(), Vec::new());
        for lines in middles(geometry.lines).chunks(4) {
            if desk.superseded() {
                return Ok(Err(Superseded));
            }
            let sample = Sample { lines: lines.to_vec(), columns: columns.clone() };
            for pixel in machine.errors(&sample)? {
                errors.push(error_px(&pixel, task.source == Source::RealError));
                silhouettes.push(pixel.sheet == Sheet::Silhouette);
            }
        }
        for &pane in &task.panes {
            self.images[pane].spread(picture::error(&errors, &silhouettes), factor);
        }
        Ok(Ok(()))
    }

    /// Every source's frame, one after the other, as fast as can be.
    fn whole_frames(
        &mut self,
        machine: &dyn Machine,
        order: &Order,
        desk: &Desk,
        tasks: &[Task],
        set_up: f64,
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
            timings.push(Timing { source: task.source, ms: 1e3 * (set_up + spent) });
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

    /// Errors take so long that they come in several passes, each twice as fine.
    fn refine(
        &mut self,
        machine: &dyn Machine,
        order: &Order,
        desk: &Desk,
        task: &Task,
    ) -> Result<Result<(), Superseded>, SetupError> {
        if !matches!(task.source, Source::FixedError | Source::RealError) {
            return Ok(Ok(()));
        }
        for factor in [16, 8, 4, 2] {
            if self.sampled(machine, desk, task, factor)?.is_err() {
                return Ok(Err(Superseded));
            }
            self.show(order, desk, Some(0));
            if self.attend(machine, order, desk, Some(0))?.is_err() {
                return Ok(Err(Superseded));
            }
        }
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
        lines: bool,
    ) -> Result<(), SetupError> {
        loop {
            match desk.wait(lines) {
                Wake::Superseded => return Ok(()),
                wake => self.answer(wake, machine, order, desk, None)?,
            }
        }
    }

    /// Does what else is wanted now.
    fn attend(
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

    fn show(&mut self, order: &Order, desk: &Desk, scan: Option<u32>) {
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

/// The scene on a raster coarser by a factor, in the same words: its memories then serve both.
fn coarser(scene: &Scene, factor: usize, words: WordClass) -> Scene {
    let mut scene = scene.clone();
    let coarse = |pixels: u32| (pixels as usize).div_ceil(factor) as u32;
    for screen in &mut scene.screens {
        *screen = screen.resized(coarse(screen.columns), coarse(screen.lines));
    }
    scene.machine.words =
        if words == WordClass::NARROW { WordSize::Narrow } else { WordSize::Wide };
    scene
}

/// A source and the panes that show it.
struct Task {
    source: Source,
    panes: Vec<usize>,
}

impl Task {
    fn needs_buffers(&self, order: &Order) -> bool {
        self.panes.iter().any(|&pane| order.panes[pane].picture.needs_buffers())
    }
}

/// Values of all lines drawn so far.
#[derive(Default)]
struct Values {
    color: Vec<[u8; 3]>,
    height: Vec<f64>,
    normal: Vec<[f64; 3]>,
    steps: Vec<u32>,
    cycles: Vec<u32>,
    errors: Vec<f64>,
    silhouettes: Vec<bool>,
}

impl Values {
    fn push(&mut self, band: Band) {
        if let Some(frame) = band.frame {
            self.color.extend(frame.color);
            if let Some(buffers) = frame.buffers {
                self.height.extend(buffers.height);
                self.normal.extend(buffers.normal);
                self.steps.extend(buffers.steps);
            }
        }
        self.cycles.extend(band.cycles);
        self.errors.extend(band.errors);
        self.silhouettes.extend(band.silhouettes);
    }

    fn pixels(&self) -> usize {
        self.color.len().max(self.errors.len())
    }

    fn paint(&self, picture: Picture) -> Painted {
        match picture {
            Picture::Color => Painted { pixels: self.color.clone(), legend: None },
            Picture::Height => picture::height(&self.height),
            Picture::Normal => picture::normal(&self.normal),
            Picture::Steps => picture::steps(&self.steps),
            Picture::Error => picture::error(&self.errors, &self.silhouettes),
            Picture::Cycles => picture::cycles(&self.cycles),
        }
    }
}
