//! A candidate's frames beside the processor's, counted.

use std::panic::{AssertUnwindSafe, catch_unwind};

use terraline::engine::{Engine, Machine, Memories};
use terraline::frame::{Frame, Hit};
use terraline::plan::Plan;
use terraline::scene::{Scene, WordSize};

use crate::frames::{count, difference};

/// How a candidate draws the scene of a machine, with buffers; `None` where it does not draw such
/// scenes.
pub type Draw = dyn Fn(&Machine<'_>) -> Option<Frame> + Sync;

/// What was compared, and what went wrong.
#[derive(Debug, Default)]
pub(crate) struct Compared {
    /// Frames of the processor.
    pub(crate) frames: usize,
    /// Of these, frames that the candidate does not draw.
    left_out: usize,
    /// Pixels of the surface in the processor's frames.
    met: usize,
    /// Scenes that plan or set-up refuse, with the reason.
    pub(crate) refused: Vec<String>,
    wrong: Vec<String>,
}

impl Compared {
    /// One scene, in both word sizes where they can be proved.
    pub(crate) fn in_both_words(&mut self, what: &str, scene: &Scene, candidate: &Draw) {
        for words in [WordSize::Narrow, WordSize::Wide] {
            let mut scene = scene.clone();
            scene.machine.words = words;
            // A word size that cannot be proved is no refusal of the scene.
            if Plan::new(&scene, None, false).is_ok() {
                self.scene(what, &scene, false, candidate);
            }
        }
    }

    /// One scene, pruned or with everything fitted; the processor's frame, if it is drawn.
    pub(crate) fn scene(
        &mut self,
        what: &str,
        scene: &Scene,
        full: bool,
        candidate: &Draw,
    ) -> Option<Frame> {
        let drawn = catch_unwind(AssertUnwindSafe(|| {
            let plan = Plan::new(scene, None, full).map_err(|error| error.to_string())?;
            let machine = Machine::new(scene, &plan, &Memories::default());
            let machine = machine.map_err(|error| error.to_string())?;
            let expected = machine.frame(Engine::Processor, true);
            let expected = expected.map_err(|error| error.to_string())?;
            let drawn = candidate(&machine);
            let difference = drawn.as_ref().map(|drawn| difference(&expected, drawn));
            Ok::<_, String>((plan.words.name, expected, difference))
        }));
        let Ok(drawn) = drawn else {
            self.wrong.push(format!("{what}, full {full}: panicked"));
            return None;
        };
        match drawn {
            Err(reason) => {
                self.refused.push(format!("{what}: {reason}"));
                None
            }
            Ok((words, frame, difference)) => {
                self.frames += 1;
                self.met += count(&frame, Hit::Surface);
                match difference {
                    None => self.left_out += 1,
                    Some(None) => {}
                    Some(Some(difference)) => {
                        self.wrong.push(format!("{what}, {words}, full {full}: {difference}"));
                    }
                }
                Some(frame)
            }
        }
    }

    /// What differs, so far.
    pub(crate) fn wrong(&self) -> Option<String> {
        let first = &self.wrong[..self.wrong.len().min(20)];
        (!first.is_empty())
            .then(|| format!("{} failures, the first:\n{}", self.wrong.len(), first.join("\n")))
    }

    /// Fails where a frame differed, where the candidate drew hardly any, or where the scenes met less
    /// than this many pixels of surface.
    #[track_caller]
    pub(crate) fn finish(&self, least: usize) {
        let Self { frames, left_out, met, .. } = self;
        println!("{frames} frames, {left_out} not drawn, {met} pixels met something");
        assert!(self.wrong.is_empty(), "{}", self.wrong().unwrap_or_default());
        assert!(left_out * 2 < *frames, "{left_out} of {frames} frames are not drawn");
        assert!(*met > least, "{met} pixels met something");
    }
}
