//! The orders of one view, drawn: a preview first where a frame takes long, then line after line.

use std::sync::Arc;
use std::time::Duration;

use super::end::End;
use super::desk::{Desk, Wake};
use super::order::Order;
use super::pane::Source;
use super::renderer::{Job, Renderer};
use super::shelf::{Shelf, Task};
use super::snapshot::{FrameRate, Image, LineState, Timing};
use crate::engine::{Engine, Machine};
use crate::plan::Plan;
use crate::setup::SetupError;
use crate::study::error::Sample;

/// Time between two snapshots.
const SNAPSHOT: Duration = Duration::from_millis(25);

/// Time spent drawing between two looks at what else is wanted.
const SEGMENT: Duration = Duration::from_millis(12);

/// Lines whose cycles are counted for the modelled frame rate.
const SAMPLED_LINES: u32 = 16;

impl Renderer {
    /// Draws an order, and those that follow it of the same view, until one of another view comes.
    pub fn draw(&mut self, first: Order, desk: &Desk) {
        let scene = Arc::clone(&first.scene);
        let mut order = first;
        self.begin(&order);
        let plan = match Plan::new(&scene, None, order.full) {
            Ok(plan) => plan,
            Err(error) => return self.stand_still(&error.into(), &order, desk),
        };
        let machine = match Machine::new(&scene, &plan, &self.memories) {
            Ok(machine) => machine,
            Err(error) => return self.stand_still(&error, &order, desk),
        };
        self.facts.world = machine.world().name();
        self.facts.trouble = None;
        self.facts.frame_rate = None;
        let mut shelf = Shelf::new(&machine);
        loop {
            let job = Job { machine: &machine, order: &order, desk };
            if let Err(End::Refused(error)) = self.serve(job, &mut shelf) {
                return self.stand_still(&error, &order, desk);
            }
            match desk.take_order_of(&order) {
                Some(next) => order = next,
                None => return,
            }
            self.begin(&order);
        }
    }

    /// Says why nothing is drawn.
    fn stand_still(&mut self, error: &SetupError, order: &Order, desk: &Desk) {
        self.facts.trouble = Some(error.to_string());
        self.facts.probe = None;
        self.facts.frame_rate = None;
        self.facts.timings.clear();
        for image in &mut self.images {
            image.states.fill(LineState::Old);
        }
        self.show(order, desk, None);
        while !matches!(desk.wait(false), Wake::Superseded) {}
    }

    /// Draws an order and stays with it until a newer one comes.
    fn serve(&mut self, job: Job<'_>, shelf: &mut Shelf<'_>) -> Result<(), End> {
        let Job { machine, order, .. } = job;
        let mut tasks: Vec<Task> = Vec::new();
        for (index, pane) in order.panes.iter().enumerate() {
            match pane.source(machine.world().wraps()) {
                Ok(source) => match tasks.iter_mut().find(|task| task.source == source) {
                    Some(task) => task.panes.push(index),
                    None => tasks.push(Task { source, panes: vec![index] }),
                },
                Err(note) => {
                    let image = &mut self.images[index];
                    let blank = Image::blank(image.pane, image.columns, image.lines);
                    *image = Image { note: Some(note), ..blank };
                }
            }
        }
        shelf.prepare(order, &tasks)?;
        // Quick ones first: they need not wait for the slow ones.
        let wait = |task: &Task| self.wait(job, shelf, task.source);
        tasks.sort_by(|a, b| wait(a).total_cmp(&wait(b)));
        self.preview(job, &tasks, shelf)?;
        for task in &tasks {
            self.paint(order, task, &shelf.progress(task).band);
        }
        if order.by_lines {
            self.by_lines(job, &tasks, shelf)
        } else {
            shelf.fallen = None;
            self.whole_frames(job, &tasks, shelf)?;
            self.linger(job)
        }
    }

    /// Every source's frame, one after the other, as fast as can be.
    fn whole_frames(
        &mut self,
        job: Job<'_>,
        tasks: &[Task],
        shelf: &mut Shelf<'_>,
    ) -> Result<(), End> {
        let Job { machine, order, desk } = job;
        let lines = shelf.lines();
        let mut timings = Vec::new();
        for task in tasks {
            if shelf.lines_of(task.source) == 0 {
                self.refine(job, task)?;
            }
            self.complete(job, task, shelf, lines)?;
            let spent = shelf.progress(task).seconds;
            let engine = match task.source {
                Source::Frame(engine) => engine,
                Source::Error => Engine::Processor,
            };
            let set_up = machine.set_up_time(engine)?.coefficients.as_secs_f64();
            timings.push(Timing { source: task.source, ms: 1e3 * (set_up + spent) });
        }
        self.facts.timings = timings;
        self.rate(machine, shelf)?;
        self.show(order, desk, None);
        Ok(())
    }

    /// Draws a source down to a line, as far as it is not drawn yet.
    fn complete(
        &mut self,
        job: Job<'_>,
        task: &Task,
        shelf: &mut Shelf<'_>,
        end: u32,
    ) -> Result<(), End> {
        let Job { order, desk, .. } = job;
        let lines = shelf.lines();
        let progress = shelf.progress(task);
        let in_time = |seconds_a_line: f64| SEGMENT.as_secs_f64() / seconds_a_line.max(1e-9);
        let columns = order.raster().0 as f64;
        let mut segment = (in_time(self.cost(task.source) * columns) as u32).clamp(1, 16);
        while progress.lines < end {
            let before = progress.seconds;
            let count = segment.min(end - progress.lines);
            progress.draw(count, &|| desk.outdated())?;
            segment = (in_time((progress.seconds - before) / f64::from(count)) as u32).clamp(1, 256);
            let at = (progress.lines < lines).then_some(progress.lines);
            if self.taken.elapsed() >= SNAPSHOT || progress.lines == end {
                self.paint(order, task, &progress.band);
                self.show(order, desk, at);
            }
            self.attend(job, at)?;
        }
        if progress.lines == lines {
            let pixels = progress.band.pixels().max(1);
            self.costs.insert(task.source, progress.seconds / pixels as f64);
        }
        Ok(())
    }

    /// Line after line as they are granted, all sources side by side; from the top again and again.
    /// What has been drawn once falls again as it is.
    fn by_lines(
        &mut self,
        job: Job<'_>,
        tasks: &[Task],
        shelf: &mut Shelf<'_>,
    ) -> Result<(), End> {
        let Job { machine, order, desk } = job;
        self.facts.timings.clear();
        let lines = shelf.lines();
        // From the full rate the scan goes on where all frames are.
        let reached = tasks.iter().map(|task| shelf.lines_of(task.source)).min();
        let mut fallen = shelf.fallen.or(reached).unwrap_or(0);
        shelf.fallen = Some(fallen);
        for task in tasks {
            self.complete(job, task, shelf, fallen)?;
        }
        self.rate(machine, shelf)?;
        self.reveal(fallen);
        self.show(order, desk, Some(fallen));
        loop {
            let granted = self.granted(job, fallen)?;
            if fallen == lines {
                fallen = 0;
            }
            let (granted, over) = (granted.min(lines - fallen), granted);
            desk.give_back(over - granted);
            fallen += granted;
            let mut grown = Vec::new();
            for task in tasks {
                let progress = shelf.progress(task);
                let missing = fallen.saturating_sub(progress.lines);
                if missing > 0 {
                    progress.draw(missing, &|| desk.outdated())?;
                    grown.push(task);
                }
            }
            shelf.fallen = Some(fallen);
            for task in grown {
                self.paint(order, task, &shelf.progress(task).band);
            }
            if self.taken.elapsed() >= SNAPSHOT || !desk.has_lines() || fallen == lines {
                self.reveal(fallen);
                self.show(order, desk, Some(fallen));
            }
        }
    }

    /// Lines above the scan are true, those below it are not yet, whatever is known of them.
    fn reveal(&mut self, fallen: u32) {
        for image in self.images.iter_mut().filter(|image| image.note.is_none()) {
            let fallen = (fallen as usize).min(image.states.len());
            image.states[..fallen].fill(LineState::Drawn);
            image.states[fallen..].fill(LineState::Old);
        }
    }

    /// The frame rate of the machine, asked once a view, and once more when the processor has drawn
    /// the whole frame.
    fn rate(&mut self, machine: &Machine<'_>, shelf: &Shelf<'_>) -> Result<(), End> {
        let exact = shelf.cycles();
        let known = self.facts.frame_rate.as_ref();
        if known.is_none_or(|known| known.counted < known.lines && exact.is_some()) {
            self.facts.frame_rate = Some(frame_rate(machine, exact)?);
        }
        Ok(())
    }
}

/// The modelled frame rate, from the cycles of the whole frame or of sampled lines.
fn frame_rate(machine: &Machine<'_>, exact: Option<u64>) -> Result<FrameRate, SetupError> {
    let (scene, lines) = (machine.scene(), machine.plan().geometry.lines);
    let (cycles, counted) = match exact {
        Some(cycles) => (cycles, lines),
        None => {
            let sample = Sample::whole_lines(machine.plan(), SAMPLED_LINES, scene.seed);
            let none = Sample { lines: vec![], columns: vec![] };
            (machine.cost(&sample, &none)?.cycles, sample.lines.len() as u32)
        }
    };
    let hardware = &scene.machine;
    let fps = hardware.frames_per_second(cycles);
    Ok(FrameRate { fps, clock_mhz: hardware.clock_mhz, counted, lines })
}
