//! The desk between window and render worker.
//!
//! The window puts an [`Order`] on it, then grants lines, asks for pixels and takes snapshots. A
//! newer order supersedes the one being drawn between two lines.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use super::order::Order;
use super::snapshot::Snapshot;

/// What the render worker is woken for.
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

/// What lies on the desk.
#[derive(Default)]
pub(super) struct State {
    pub order: Option<Order>,
    /// The order that is being drawn.
    drawing: Option<Order>,
    pub end: bool,
    pub lines: u32,
    pub look: Option<Option<(u32, u32)>>,
    pub explain: VecDeque<(u32, u32)>,
    pub idle: bool,
    pub snapshot: Arc<Snapshot>,
    pub messages: Vec<String>,
}

/// Where window and render worker meet.
#[derive(Default)]
pub struct Desk {
    state: Mutex<State>,
    changed: Condvar,
    /// Set with a newer order or the end: looked at between lines, without the lock.
    superseded: AtomicBool,
    /// Set if the newer order is of another view, or with the end.
    outdated: AtomicBool,
}

/// Lines that the render worker takes at a time.
const HANDFUL: u32 = 16;

impl Desk {
    pub(super) fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until somebody changes the state.
    fn changed<'a>(&self, state: MutexGuard<'a, State>) -> MutexGuard<'a, State> {
        self.changed.wait(state).unwrap_or_else(PoisonError::into_inner)
    }

    /// Changes what is wanted.
    pub(super) fn want(&self, change: impl FnOnce(&mut State)) {
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

    /// Whether the view being drawn is no longer wanted: nothing of its frames will be shown.
    #[must_use]
    pub fn outdated(&self) -> bool {
        self.outdated.load(Ordering::Relaxed)
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
            state = self.changed(state);
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

    /// Takes over a new snapshot.
    pub fn show(&self, snapshot: Snapshot) {
        self.state().snapshot = Arc::new(snapshot);
    }

    /// Something for the terminal.
    pub fn say(&self, text: String) {
        self.state().messages.push(text);
    }

    /// A newer order, or the end: what is being drawn is no longer wanted.
    pub(super) fn supersede(&self, change: impl FnOnce(&mut State)) {
        self.want(|state| {
            change(state);
            let orders = state.order.as_ref().zip(state.drawing.as_ref());
            let goes_on = orders.is_some_and(|(next, now)| next.is_view_of(now)) && !state.end;
            self.superseded.store(true, Ordering::Relaxed);
            self.outdated.store(!goes_on, Ordering::Relaxed);
        });
    }

    /// Waits until all that is wanted is done.
    pub(super) fn finish(&self) {
        let mut state = self.state();
        while !state.idle && !state.end {
            state = self.changed(state);
        }
    }

    /// Ends all waiting: nobody draws any more.
    pub(super) fn close(&self) {
        self.state().end = true;
        self.changed.notify_all();
    }

    /// The order that waits, if it is of the same view as the one being drawn.
    pub(super) fn take_order_of(&self, drawn: &Order) -> Option<Order> {
        let mut state = self.state();
        let goes_on = state.order.as_ref().is_some_and(|next| next.is_view_of(drawn));
        if goes_on && !state.end { self.take(&mut state) } else { None }
    }

    /// The order that waits, which is being drawn from now on.
    fn take(&self, state: &mut State) -> Option<Order> {
        let order = state.order.take()?;
        state.drawing = Some(order.clone());
        self.superseded.store(false, Ordering::Relaxed);
        self.outdated.store(false, Ordering::Relaxed);
        Some(order)
    }

    /// The next order; `None` at the end.
    pub(super) fn take_order(&self) -> Option<Order> {
        let mut state = self.state();
        loop {
            if state.end {
                return None;
            }
            if let Some(order) = self.take(&mut state) {
                return Some(order);
            }
            state.idle = true;
            self.changed.notify_all();
            state = self.changed(state);
        }
    }
}
