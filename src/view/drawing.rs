//! The drawing thread, and the desk between it and the window.
//!
//! The window puts an [`Order`] on the desk, then grants lines, asks for pixels and takes what is
//! shown. A newer order supersedes the one being drawn between two lines. Nothing here waits for
//! the drawing but [`Drawing::finish`].

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

use crate::engine::FixedWorld;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::setup::SetupError;
use crate::study::explain::{explain, text::text};

use super::machine::{Memories, machine};
use super::pane::Pane;
use super::passes::Drawer;
use super::shown::Shown;

/// What is to be drawn.
#[derive(Clone, Debug)]
pub struct Order {
    /// The scene; its first screen is drawn, of at most [`MAX_PIXELS`].
    pub scene: Arc<Scene>,
    /// Every unit fitted.
    pub full: bool,
    /// Left and, where there is a divider, right.
    pub panes: Vec<Pane>,
    /// Lines as they are granted; otherwise whole frames.
    pub by_lines: bool,
}

/// Pixels of a raster that can be shown: their values take about 90 bytes each.
pub const MAX_PIXELS: usize = 1 << 24;

impl Order {
    /// Columns and lines.
    #[must_use]
    pub fn raster(&self) -> (usize, usize) {
        let screen = &self.scene.screens[0];
        (screen.columns as usize, screen.lines as usize)
    }

    pub(super) fn explain(
        &self,
        plan: &Plan,
        (column, line): (u32, u32),
    ) -> Result<String, SetupError> {
        let world = FixedWorld::of(&self.scene, plan)?;
        let explanation = explain(&self.scene, plan, &world, column, line)?;
        Ok(text(&self.scene.name, world.name(), &explanation))
    }
}

/// What the drawing is woken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wake {
    /// A newer order, or the end.
    Superseded,
    /// So many lines may be drawn.
    Lines(u32),
    /// A pixel (column, line) to look at; `None` when the cursor has left.
    Look(Option<(u32, u32)>),
    /// A pixel to explain.
    Explain((u32, u32)),
}

#[derive(Default)]
struct State {
    order: Option<Order>,
    end: bool,
    lines: u32,
    look: Option<Option<(u32, u32)>>,
    explain: VecDeque<(u32, u32)>,
    idle: bool,
    shown: Arc<Shown>,
    said: Vec<String>,
}

/// Where window and drawing meet.
#[derive(Default)]
pub struct Desk {
    state: Mutex<State>,
    changed: Condvar,
    /// Set with a newer order or the end: looked at between lines, without the lock.
    superseded: AtomicBool,
}

/// Lines that the drawing takes at a time.
const HANDFUL: u32 = 16;

impl Desk {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Changes what is wanted.
    fn want(&self, change: impl FnOnce(&mut State)) {
        let mut state = self.state();
        change(&mut state);
        state.idle = false;
        self.changed.notify_all();
    }

    /// Whether the order being drawn is no longer wanted.
    #[must_use]
    pub fn superseded(&self) -> bool {
        self.superseded.load(Ordering::Relaxed)
    }

    /// What is wanted, most urgent first, lines last.
    fn next(state: &mut State, lines: bool) -> Option<Wake> {
        if state.end || state.order.is_some() {
            return Some(Wake::Superseded);
        }
        if let Some(place) = state.explain.pop_front() {
            return Some(Wake::Explain(place));
        }
        if let Some(place) = state.look.take() {
            return Some(Wake::Look(place));
        }
        let handful = state.lines.min(HANDFUL);
        if lines && handful > 0 {
            state.lines -= handful;
            return Some(Wake::Lines(handful));
        }
        None
    }

    /// What is wanted now beside lines.
    pub fn poll(&self) -> Option<Wake> {
        Self::next(&mut self.state(), false)
    }

    /// Waits until something is wanted.
    pub fn wait(&self, lines: bool) -> Wake {
        let mut state = self.state();
        loop {
            if let Some(wake) = Self::next(&mut state, lines) {
                return wake;
            }
            state.idle = true;
            self.changed.notify_all();
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Lines that were taken but not drawn.
    pub fn give_back(&self, lines: u32) {
        self.state().lines += lines;
    }

    /// Whether more lines may be drawn at once.
    #[must_use]
    pub fn has_lines(&self) -> bool {
        self.state().lines > 0
    }

    /// Shows a moment.
    pub fn show(&self, shown: Shown) {
        self.state().shown = Arc::new(shown);
    }

    /// Something for the terminal.
    pub fn say(&self, text: String) {
        self.state().said.push(text);
    }

    /// The next order; `None` at the end.
    fn take_order(&self) -> Option<Order> {
        let mut state = self.state();
        loop {
            if state.end {
                return None;
            }
            if let Some(order) = state.order.take() {
                self.superseded.store(false, Ordering::Relaxed);
                return Some(order);
            }
            state.idle = true;
            self.changed.notify_all();
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

/// The drawing thread, seen from the window.
pub struct Drawing {
    desk: Arc<Desk>,
    thread: Option<JoinHandle<()>>,
}

impl Drawing {
    /// Sets an order up once, which loads its memories, and starts a thread that draws it.
    ///
    /// # Errors
    /// If the order's scene cannot be drawn.
    pub fn start(order: Order) -> Result<Self, SetupError> {
        let memories = Memories::default();
        machine(&order.scene, order.full, &memories)?;
        let desk = Arc::new(Desk::default());
        desk.want(|state| state.order = Some(order));
        let theirs = Arc::clone(&desk);
        let thread = std::thread::spawn(move || {
            // Whatever happens, nobody waits for this thread for ever.
            let _last = LastWord(&theirs);
            let mut drawer = Drawer::new(memories);
            while let Some(order) = theirs.take_order() {
                drawer.draw(&order, &theirs);
            }
        });
        Ok(Self { desk, thread: Some(thread) })
    }

    /// Draw this instead.
    pub fn order(&self, order: Order) {
        self.desk.want(|state| {
            state.order = Some(order);
            state.lines = 0;
            self.desk.superseded.store(true, Ordering::Relaxed);
        });
    }

    /// Lines to draw, up to `most` in all that wait to be drawn.
    pub fn grant(&self, lines: u32, most: u32) {
        if lines > 0 {
            self.desk.want(|state| state.lines = (state.lines + lines).min(most));
        }
    }

    /// Looks at a pixel.
    pub fn look(&self, place: Option<(u32, u32)>) {
        self.desk.want(|state| state.look = Some(place));
    }

    /// Explains a pixel, see [`Drawing::said`].
    pub fn explain(&self, place: (u32, u32)) {
        self.desk.want(|state| state.explain.push_back(place));
    }

    /// The latest moment.
    #[must_use]
    pub fn shown(&self) -> Arc<Shown> {
        Arc::clone(&self.desk.state().shown)
    }

    /// What is to be printed, once.
    #[must_use]
    pub fn said(&self) -> Vec<String> {
        std::mem::take(&mut self.desk.state().said)
    }

    /// Whether the thread has ended, which only a defect makes it do.
    #[must_use]
    pub fn is_dead(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// Waits until all that was ordered, granted and asked for is done.
    pub fn finish(&self) {
        let mut state = self.desk.state();
        while !state.idle && !state.end {
            state = self.desk.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl Drop for Drawing {
    fn drop(&mut self) {
        self.desk.want(|state| state.end = true);
        self.desk.superseded.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// Ends the waiting when the thread ends, even by a panic.
struct LastWord<'a>(&'a Desk);

impl Drop for LastWord<'_> {
    fn drop(&mut self) {
        let mut state = self.0.state();
        state.end = true;
        self.0.changed.notify_all();
    }
}
