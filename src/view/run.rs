//! The loop between a window, the session and the render worker: live, or after a script.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use super::action::Effect;
use super::canvas::Canvas;
use super::input::{Hands, Input};
use super::layout::Layout;
use super::session::Session;
use super::worker::RenderWorker;
use crate::sink::{SinkError, png};

/// A window, or what stands for one.
pub trait Glass {
    /// Pixels across and down.
    fn size(&self) -> (usize, usize);

    /// What the hands have done since the last call; `None` when the window is closed.
    fn poll(&mut self) -> Option<Input>;

    /// Shows a picture of the glass's size.
    ///
    /// # Errors
    /// The reason, if the window does not take it.
    fn present(&mut self, canvas: &Canvas) -> Result<(), String>;
}

/// Why a run ends before its time.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The window does not take a picture.
    #[error("the window does not take its picture: {0}")]
    Window(String),
    /// The render worker has ended.
    #[error("the drawing has stopped, which is a defect of the program; the reason stands above")]
    Worker,
    /// The window was closed before the script's end.
    #[error("the window was closed after {0} of {1} frames: no screenshot is written")]
    Closed(u32, u32),
}

/// Time that a frame of a script stands for, seconds.
pub const SCRIPT_FRAME: f64 = 0.1;

/// Shortest time between two pictures.
const REFRESH: Duration = Duration::from_millis(14);

/// A view that has not changed for so long rests.
const REST: Duration = Duration::from_millis(150);

/// An unchanged picture is shown again after this time: the window may have been covered.
const AGAIN: Duration = Duration::from_millis(250);

/// Longest time that one tick flies, seconds: after a stall the craft does not leap.
const LONGEST_TICK: f64 = 0.1;

/// One window with all that belongs to it.
pub struct View<'a> {
    glass: &'a mut dyn Glass,
    session: Session,
    worker: RenderWorker,
    scale: usize,
    hands: Hands,
    canvas: Canvas,
    looked_at: Option<(u32, u32)>,
    /// When the view changed last; not in a script, which has no clock.
    ordered: Option<Instant>,
    live: bool,
    print: &'a mut dyn FnMut(&str),
}

impl<'a> View<'a> {
    /// A session and its render worker in a window, `scale` window pixels per raster pixel. `print`
    /// takes what is for the terminal.
    pub fn new(
        glass: &'a mut dyn Glass,
        session: Session,
        worker: RenderWorker,
        print: &'a mut dyn FnMut(&str),
    ) -> Self {
        let scale = session.layout().scale;
        Self {
            glass,
            session,
            worker,
            scale,
            hands: Hands::default(),
            canvas: Canvas::default(),
            looked_at: None,
            ordered: None,
            live: false,
            print,
        }
    }

    /// Runs until the window is closed.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn live(&mut self) -> Result<(), RunError> {
        self.live = true;
        let (mut last, mut presented) = (Instant::now(), None::<Instant>);
        let (mut version, mut changed) = (None, true);
        while let Some(input) = self.glass.poll() {
            let seconds = last.elapsed().as_secs_f64().min(LONGEST_TICK);
            last = Instant::now();
            let (acted, quit) = self.tick(&input, seconds);
            if quit {
                break;
            }
            if self.worker.is_dead() {
                return Err(RunError::Worker);
            }
            let now = self.worker.snapshot().version;
            changed |= acted || version != Some(now);
            let wait = if changed { REFRESH } else { AGAIN };
            if presented.is_none_or(|then| then.elapsed() >= wait) {
                self.present(true)?;
                (presented, version, changed) = (Some(Instant::now()), Some(now), false);
            }
        }
        Ok(())
    }

    /// Runs this many frames, with the script's input in the first of them, and returns the last
    /// picture, which is drawn to its end.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn scripted(&mut self, script: &[Input], frames: u32) -> Result<&Canvas, RunError> {
        let still = Input::default();
        // The first frame is whole when the first key comes, however fast this computer is.
        self.worker.finish();
        for frame in 0..frames {
            if self.glass.poll().is_none() {
                return Err(RunError::Closed(frame, frames));
            }
            let mut input = script.get(frame as usize).unwrap_or(&still).clone();
            if input.cursor.is_none() {
                // The cursor stays where the script has put it.
                input.cursor = script.last().and_then(|last| last.cursor);
            }
            let (_, quit) = self.tick(&input, SCRIPT_FRAME);
            if quit {
                return Err(RunError::Closed(frame, frames));
            }
            self.worker.finish();
            if self.worker.is_dead() {
                return Err(RunError::Worker);
            }
            self.say();
            self.present(false)?;
        }
        Ok(&self.canvas)
    }

    /// One turn: input to actions to orders. Says whether anything was done, and whether to quit.
    fn tick(&mut self, input: &Input, seconds: f64) -> (bool, bool) {
        let (width, height) = self.glass.size();
        let layout = Layout::new(width, height, self.scale);
        let mut acted = layout != self.session.layout();
        if acted {
            self.session.resize(layout);
        }
        self.session.see_errors(self.worker.snapshot().error_high());
        let split = self.session.split();
        for action in self.hands.actions(input, &layout, split, seconds) {
            acted = true;
            let was_paused = self.session.pace().is_paused();
            let effect = self.session.act(action);
            if self.session.pace().is_paused() && !was_paused {
                // A worker that is slower than the pace has lines left to draw.
                self.worker.hold();
            }
            // A line or an explanation is of the order as it is now.
            self.send_order();
            match effect {
                Some(Effect::Quit) => return (true, true),
                Some(Effect::Line) => self.worker.grant(1, u32::MAX),
                Some(Effect::Explain(column, line)) => self.worker.explain((column, line)),
                Some(Effect::Print(text)) => (self.print)(&text),
                Some(Effect::Screenshot) => self.screenshot(),
                None => {}
            }
        }
        acted |= self.send_order();
        let lines = self.session.advance(seconds);
        // A worker that is slower than the pace does not run after it for ever.
        let speed = self.session.pace().lines_per_second().unwrap_or_default();
        self.worker.grant(lines, lines.max(speed / 4));
        let pointed = self.session.pointed();
        // Looking at a pixel takes an oracle of its own: not while the view changes.
        let rests = self.ordered.is_none_or(|then| then.elapsed() >= REST);
        if pointed != self.looked_at && rests {
            self.looked_at = pointed;
            self.worker.look(pointed);
        }
        acted |= self.say();
        (acted, false)
    }

    /// Orders what the session wants drawn, if that is something new.
    fn send_order(&mut self) -> bool {
        let Some(order) = self.session.order() else { return false };
        self.worker.order(order);
        // The new picture has another pixel under the cursor.
        self.looked_at = None;
        self.ordered = self.live.then(Instant::now);
        true
    }

    /// Prints what the render worker has to say.
    fn say(&mut self) -> bool {
        let messages = self.worker.take_messages();
        messages.iter().for_each(|text| (self.print)(text));
        !messages.is_empty()
    }

    fn present(&mut self, timed: bool) -> Result<(), RunError> {
        self.canvas.compose(&self.session, &self.worker.snapshot(), timed);
        self.glass.present(&self.canvas).map_err(RunError::Window)
    }

    /// Saves the picture that was presented last.
    fn screenshot(&mut self) {
        match save(&self.canvas) {
            Ok(path) => {
                self.session.tell(format!("saved {}", path.display()));
                (self.print)(&path.display().to_string());
            }
            Err(error) => self.session.tell(error.to_string()),
        }
    }
}

/// Writes a PNG into the current folder, under the first name that is free.
fn save(canvas: &Canvas) -> Result<PathBuf, SinkError> {
    let free = (1..).map(|number| PathBuf::from(format!("terraline-{number:03}.png")));
    let path = free.into_iter().find(|path| !path.exists()).unwrap_or_default();
    let (width, height) = canvas.size();
    png::write(&path, width, height, &canvas.bytes())?;
    Ok(path)
}
