//! Coarse pictures before the true ones.

use std::sync::Arc;
use std::time::Duration;

use crate::plan::WordClass;
use crate::scene::{Scene, WordSize};
use crate::setup::SetupError;
use crate::sink::picture;
use crate::study::error::{Sample, Sheet};

use super::drawing::{Desk, Order};
use super::machine::{Machine, machine};
use super::pane::Source;
use super::passes::{Drawer, Superseded};
use super::sources::error_px;
use super::values::{Task, Values};

/// A frame that takes longer is drawn coarsely first.
const PATIENCE: Duration = Duration::from_millis(30);

/// Time that a coarse frame may take.
const PREVIEW: f64 = 0.02;

impl Drawer {
    /// Coarse pictures of all panes, where the true ones would take long.
    pub(super) fn preview(
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

    /// Errors take so long that they come in several passes, each twice as fine.
    pub(super) fn refine(
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
