//! The render worker: a thread that draws what is ordered. Nothing here waits for it but
//! [`RenderWorker::finish`].

use std::sync::Arc;
use std::thread::JoinHandle;

use super::desk::Desk;
use super::order::Order;
use super::renderer::Renderer;
use super::snapshot::Snapshot;
use crate::engine::{Machine, Memories};
use crate::plan::Plan;
use crate::setup::SetupError;

/// The render worker, seen from the window.
pub struct RenderWorker {
    desk: Arc<Desk>,
    thread: Option<JoinHandle<()>>,
}

impl RenderWorker {
    /// Sets an order up once, which loads its memories, and starts a thread that draws it.
    ///
    /// # Errors
    /// If the order's scene cannot be drawn.
    pub fn start(order: Order) -> Result<Self, SetupError> {
        let memories = Memories::default();
        Machine::new(&order.scene, &Plan::new(&order.scene, None, order.full)?, &memories)?;
        let desk = Arc::new(Desk::default());
        desk.want(|state| state.order = Some(order));
        let theirs = Arc::clone(&desk);
        let thread = std::thread::spawn(move || {
            // Whatever happens, nobody waits for this thread for ever.
            let _last = LastWord(&theirs);
            let mut renderer = Renderer::new(memories);
            while let Some(order) = theirs.take_order() {
                renderer.draw(order, &theirs);
            }
        });
        Ok(Self { desk, thread: Some(thread) })
    }

    /// Draws this instead of what it draws now.
    pub fn order(&self, order: Order) {
        self.desk.supersede(|state| {
            state.order = Some(order);
            state.lines = 0;
        });
    }

    /// Lines to draw, up to `most` in all that wait to be drawn.
    pub fn grant(&self, lines: u32, most: u32) {
        if lines > 0 {
            self.desk.want(|state| state.lines = (state.lines + lines).min(most));
        }
    }

    /// Draws no more of the lines that were granted.
    pub fn hold(&self) {
        self.desk.want(|state| state.lines = 0);
    }

    /// Looks at a pixel.
    pub fn look(&self, place: Option<(u32, u32)>) {
        self.desk.want(|state| state.look = Some(place));
    }

    /// Has a pixel explained; the text comes by [`RenderWorker::take_messages`].
    pub fn explain(&self, place: (u32, u32)) {
        self.desk.want(|state| state.explain.push_back(place));
    }

    /// The latest snapshot.
    #[must_use]
    pub fn snapshot(&self) -> Arc<Snapshot> {
        Arc::clone(&self.desk.state().snapshot)
    }

    /// What there is to print since the last call, for the terminal.
    #[must_use]
    pub fn take_messages(&self) -> Vec<String> {
        std::mem::take(&mut self.desk.state().messages)
    }

    /// Whether the thread has ended, which only a defect makes it do.
    #[must_use]
    pub fn is_dead(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// Waits until all that was ordered, granted and asked for is done.
    pub fn finish(&self) {
        self.desk.finish();
    }
}

impl Drop for RenderWorker {
    fn drop(&mut self) {
        self.desk.supersede(|state| state.end = true);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// Ends the waiting when the thread ends, even by a panic.
struct LastWord<'a>(&'a Desk);

impl Drop for LastWord<'_> {
    fn drop(&mut self) {
        self.0.close();
    }
}
