//! Coarse pictures before the true ones.

use std::time::Duration;

use super::end::End;
use super::pane::Source;
use super::renderer::{Job, Renderer};
use super::shelf::{Shelf, Task};
use crate::engine::{Band, Engine, Machine};
use crate::plan::{Plan, WordClass};
use crate::scene::{Scene, WordSize};
use crate::study::error::Sample;

/// A frame that takes longer is drawn coarsely first.
const PATIENCE: Duration = Duration::from_millis(30);

/// Time that a coarse frame may take.
const PREVIEW: f64 = 0.02;

impl Renderer {
    /// Coarse pictures of all panes, where the true ones would take long.
    pub fn preview(
        &mut self,
        job: Job<'_>,
        tasks: &[Task],
        shelf: &Shelf<'_>,
    ) -> Result<(), End> {
        let Job { order, desk, .. } = job;
        let (columns, lines) = order.raster();
        let pixels = (columns * lines) as f64;
        let missing = |task: &&Task| shelf.lines_of(task.source) < shelf.lines();
        let tasks: Vec<&Task> = tasks.iter().filter(missing).collect();
        let wait: f64 = tasks.iter().map(|task| self.wait(job, shelf, task.source)).sum();
        if tasks.is_empty() || wait < PATIENCE.as_secs_f64() && !order.by_lines {
            return Ok(());
        }
        for &task in &tasks {
            let share = PREVIEW / tasks.len() as f64;
            let in_time = |f: &usize| self.cost(task.source) * pixels / (f * f) as f64 <= share;
            let factor = match task.source {
                // Below the falling scan the same coarse picture lies every time.
                Source::Frame(Engine::Oracle) | Source::Error if order.by_lines => 16,
                Source::Frame(_) if order.by_lines => 4,
                _ => (0..16).map(|power| 1 << power).find(in_time).unwrap_or(1),
            };
            match task.source {
                Source::Frame(_) => self.coarse(job, task, factor)?,
                Source::Error => self.sampled(job, task, factor.max(2))?,
            }
        }
        self.show(order, desk, Some(0));
        Ok(())
    }

    /// A frame on a raster coarser by a whole number, enlarged.
    fn coarse(&mut self, job: Job<'_>, task: &Task, factor: usize) -> Result<(), End> {
        let Job { machine, order, desk } = job;
        let scene = coarser(&order.scene, factor, machine.plan().words);
        // What the coarse raster cannot do does not matter: the true frame follows.
        let Ok(plan) = Plan::new(&scene, None, order.full) else { return Ok(()) };
        let Ok(coarse) = Machine::new(&scene, &plan, &self.memories) else { return Ok(()) };
        let band = task.scan(&coarse, order)?.draw(u32::MAX, &|| desk.superseded());
        self.spread(job, task, &band.ok_or(End::Superseded)?, factor);
        Ok(())
    }

    /// Errors of every pixel in the middle of a square.
    fn sampled(
        &mut self,
        job: Job<'_>,
        task: &Task,
        factor: usize,
    ) -> Result<(), End> {
        let geometry = &job.machine.plan().geometry;
        let middles = |count: u32| -> Vec<u32> {
            let middle = |from: u32| (from + factor as u32 / 2).min(count - 1);
            (0..count).step_by(factor).map(middle).collect()
        };
        let columns = middles(geometry.columns);
        let sample = Sample { lines: middles(geometry.lines), columns };
        let mut scan = job.machine.scan_errors(sample)?;
        let band = scan.draw(u32::MAX, &|| job.desk.superseded()).ok_or(End::Superseded)?;
        self.spread(job, task, &band, factor);
        Ok(())
    }

    fn spread(&mut self, job: Job<'_>, task: &Task, drawn: &Band, factor: usize) {
        for &pane in &task.panes {
            if let Some(painted) = job.order.panes[pane].picture.with(drawn, job.order.errors(pane)) {
                self.images[pane].spread(painted, factor);
            }
        }
    }

    /// Errors take so long that they come in several passes, each twice as fine.
    pub fn refine(&mut self, job: Job<'_>, task: &Task) -> Result<(), End> {
        if task.source != Source::Error {
            return Ok(());
        }
        for factor in [16, 8, 4, 2] {
            self.sampled(job, task, factor)?;
            self.show(job.order, job.desk, Some(0));
            self.attend(job, Some(0))?;
        }
        Ok(())
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
