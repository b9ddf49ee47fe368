//! One order, drawn: a preview first where a frame takes long, then line after line.

use std::time::{Duration, Instant};

use super::desk::{Desk, Wake};
use super::order::Order;
use super::pane::Source;
use super::renderer::{End, Job, Renderer, Task};
use super::snapshot::{FrameRate, Image, LineState, Timing};
use crate::engine::{Band, Engine, Machine};
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
    /// Draws an order and stays with it until a newer one comes.
    pub fn draw(&mut self, order: &Order, desk: &Desk) {
        self.begin(order);
        if let Err(End::Refused(error)) = self.set_up_and_draw(order, desk) {
            self.stand_still(&error, order, desk);
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

    fn set_up_and_draw(&mut self, order: &Order, desk: &Desk) -> Result<(), End> {
        let plan = Plan::new(&order.scene, None, order.full)?;
        let machine = Machine::new(&order.scene, &plan, &self.memories)?;
        self.facts.world = machine.world().name();
        self.facts.trouble = None;
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
        // Quick ones first: they need not wait for the slow ones.
        tasks.sort_by(|a, b| self.cost(a.source).total_cmp(&self.cost(b.source)));
        let job = Job { machine: &machine, order, desk };
        self.preview(job, &tasks)?;
        if order.by_lines {
            self.by_lines(job, &tasks)
        } else {
            self.whole_frames(job, &tasks)?;
            self.linger(job)
        }
    }

    /// Every source's frame, one after the other, as fast as can be.
    fn whole_frames(&mut self, job: Job<'_>, tasks: &[Task]) -> Result<(), End> {
        let Job { machine, order, desk } = job;
        let lines = machine.plan().geometry.lines;
        let mut timings = Vec::new();
        let mut exact = None;
        for task in tasks {
            self.refine(job, task)?;
            let mut scan = task.scan(machine, order)?;
            let mut drawn = Band::default();
            let (mut spent, mut segment, mut line) = (0.0, 16, 0);
            while line < lines {
                let start = Instant::now();
                let band = scan.draw(segment, &|| desk.superseded()).ok_or(End::Superseded)?;
                let took = start.elapsed().as_secs_f64();
                spent += took;
                line = lines.min(line + segment);
                drawn.append(band);
                let better = f64::from(segment) * SEGMENT.as_secs_f64() / took.max(1e-6);
                segment = (better as u32).clamp(1, 256);
                if self.taken.elapsed() >= SNAPSHOT || line == lines {
                    self.paint(order, task, &drawn);
                    self.show(order, desk, (line < lines).then_some(line));
                }
                self.attend(job, (line < lines).then_some(line))?;
            }
            self.costs.insert(task.source, spent / drawn.pixels().max(1) as f64);
            let (Source::Frame(engine) | Source::Error(engine)) = task.source;
            let set_up = machine.set_up_time(engine)?.coefficients.as_secs_f64();
            timings.push(Timing { source: task.source, ms: 1e3 * (set_up + spent) });
            if task.source == Source::Frame(Engine::Processor) {
                exact = Some(drawn.cycles_so_far);
            }
        }
        self.facts.timings = timings;
        self.facts.frame_rate = Some(frame_rate(machine, exact)?);
        self.show(order, desk, None);
        Ok(())
    }

    /// Line after line as they are granted, all sources side by side; from the top again and again.
    fn by_lines(&mut self, job: Job<'_>, tasks: &[Task]) -> Result<(), End> {
        let Job { machine, order, desk } = job;
        self.facts.timings.clear();
        self.facts.frame_rate = Some(frame_rate(machine, None)?);
        let lines = machine.plan().geometry.lines;
        loop {
            let mut scans = Vec::new();
            for task in tasks {
                scans.push((task, task.scan(machine, order)?, Band::default()));
            }
            let mut line = 0;
            self.show(order, desk, Some(line));
            while line < lines {
                let granted = self.granted(job, line)?;
                let (granted, over) = (granted.min(lines - line), granted);
                desk.give_back(over - granted);
                for (_, scan, drawn) in &mut scans {
                    let band = scan.draw(granted, &|| desk.superseded());
                    drawn.append(band.ok_or(End::Superseded)?);
                }
                line += granted;
                if self.taken.elapsed() >= SNAPSHOT || !desk.has_lines() || line == lines {
                    for (task, _, drawn) in &scans {
                        self.paint(order, task, drawn);
                    }
                    self.show(order, desk, Some(line));
                }
            }
            // The whole frame stands until the next line is due.
            let granted = self.granted(job, lines)?;
            desk.give_back(granted);
            for image in &mut self.images {
                image.states.fill(LineState::Old);
            }
        }
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
