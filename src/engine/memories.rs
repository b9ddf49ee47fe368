//! The keeper of memories: heights, pyramid and tables are loaded once, coefficients every frame.

use std::any::Any;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::plan::{Ground, Plan};
use crate::scene::Scene;
use crate::setup::{Memory, Setup, SetupError};
use crate::word::Complete;

/// Memories of one surface that were loaded before, the latest used last. They are kept by what
/// the machine's choice may change (world, kernel, plan), not by the map: one keeper serves one
/// scene and what becomes of it.
#[derive(Clone, Default)]
pub struct Memories(Arc<Mutex<Vec<Kept>>>);

/// What a memory depends on, in words, and the memory.
type Kept = (String, Arc<dyn Any + Send + Sync>);

/// Fixed and real: of large maps they are large.
const KEPT: usize = 2;

/// How long a set-up took.
#[derive(Clone, Copy, Debug, Default)]
pub struct SetUpTime {
    /// Loading maps and tables; next to nothing where they were kept.
    pub memories: Duration,
    /// Loading the coefficients of the frame.
    pub coefficients: Duration,
}

impl Memories {
    /// Sets up a scene in a world, from a memory that was kept or is loaded and kept from now on.
    ///
    /// # Errors
    /// If the eye is under the ground, or a value does not fit a register of a sweep.
    pub fn set_up<W: Complete>(
        &self,
        world: W,
        scene: &Scene,
        plan: &Plan,
    ) -> Result<Setup<W>, SetupError> {
        Ok(self.set_up_timed(world, scene, plan)?.0)
    }

    /// The same, and how long it took.
    pub(super) fn set_up_timed<W: Complete>(
        &self,
        world: W,
        scene: &Scene,
        plan: &Plan,
    ) -> Result<(Setup<W>, SetUpTime), SetupError> {
        let start = Instant::now();
        let memory = self.get(world, scene, plan)?;
        let memories = start.elapsed();
        let setup = Setup::new(world, scene, plan, memory.as_ref().as_ref())?;
        Ok((setup, SetUpTime { memories, coefficients: start.elapsed() - memories }))
    }

    fn get<W: Complete>(
        &self,
        world: W,
        scene: &Scene,
        plan: &Plan,
    ) -> Result<Arc<Option<Memory<W>>>, SetupError> {
        let scale = match &plan.ground {
            Ground::Terrain(walk) => Some(walk.scale),
            Ground::Plane(_) => None,
        };
        let key = format!(
            "{world:?} {:?} {:?} {} {} {} {scale:?}",
            scene.kernel,
            plan.words(),
            plan.full,
            plan.fitted.pyramid,
            plan.fitted.kernel_rom
        );
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        {
            let mut kept = kept();
            if let Some(at) = kept.iter().position(|(known, _)| *known == key) {
                let latest = kept.remove(at);
                let memory = Arc::downcast(Arc::clone(&latest.1));
                kept.push(latest);
                if let Ok(memory) = memory {
                    return Ok(memory);
                }
            }
        }
        let memory = Arc::new(Memory::new(&world, scene, plan)?);
        let mut kept = kept();
        if kept.len() >= KEPT {
            kept.remove(0);
        }
        kept.push((key, Arc::clone(&memory) as Arc<dyn Any + Send + Sync>));
        Ok(memory)
    }
}
