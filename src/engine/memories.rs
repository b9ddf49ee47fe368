//! The keeper of memories: heights, pyramid and tables are loaded once, coefficients every frame.

use std::any::Any;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use crate::fast;
use crate::fast::enter::Enterable;
use crate::plan::{Plan, SurfacePlan, TerrainPlan};
use crate::scene::{Scene, Surface};
use crate::setup::{Memory, Setup, SetupError};
use crate::word::{Complete, World};

/// Memories of one scene's surfaces that were loaded before, the latest used last. They are kept by what
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

/// What is loaded once per map in a world, for each surface.
struct Loaded<W: World> {
    memories: Vec<Option<Memory<W>>>,
    /// The fast engine's own copies, made when it first draws, and how long that took.
    maps: OnceLock<(Vec<Option<fast::Map<W>>>, Duration)>,
}

/// A set-up in a world, with what was loaded for it.
pub struct Ready<W: World> {
    /// The registers of one frame.
    pub setup: Setup<W>,
    loaded: Arc<Loaded<W>>,
    time: SetUpTime,
}

impl<W: World> Ready<W> {
    /// How long it took, without the fast engine's maps.
    #[must_use]
    pub fn time(&self) -> SetUpTime {
        self.time
    }
}

impl<W: Enterable> Ready<W> {
    /// The maps of the surfaces as the fast engine reads them, made now if it has not drawn before;
    /// `None` for a surface that it draws ray by ray.
    pub fn maps(&self, scene: &Scene, plan: &Plan) -> &[Option<fast::Map<W>>] {
        &self.timed_maps(scene, plan).0
    }

    /// How long the set-up took for the fast engine.
    pub(super) fn fast_time(&self, scene: &Scene, plan: &Plan) -> SetUpTime {
        let maps = self.timed_maps(scene, plan).1;
        SetUpTime { memories: self.time.memories + maps, ..self.time }
    }

    fn timed_maps(&self, scene: &Scene, plan: &Plan) -> &(Vec<Option<fast::Map<W>>>, Duration) {
        self.loaded.maps.get_or_init(|| {
            let start = Instant::now();
            let maps = fast::maps(&self.setup.world, scene, plan, &self.loaded.memories);
            (maps, start.elapsed())
        })
    }
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
        Ok(self.load(world, scene, plan)?.setup)
    }

    /// The same, with what it was loaded from.
    ///
    /// # Errors
    /// As [`Memories::set_up`].
    pub fn load<W: Complete>(
        &self,
        world: W,
        scene: &Scene,
        plan: &Plan,
    ) -> Result<Ready<W>, SetupError> {
        let start = Instant::now();
        let loaded = self.get(world, scene, plan)?;
        let memories = start.elapsed();
        let setup = Setup::new(world, scene, plan, &loaded.memories)?;
        let time = SetUpTime { memories, coefficients: start.elapsed() - memories };
        Ok(Ready { setup, loaded, time })
    }

    fn get<W: Complete>(
        &self,
        world: W,
        scene: &Scene,
        plan: &Plan,
    ) -> Result<Arc<Loaded<W>>, SetupError> {
        let of_map = |walk: &TerrainPlan| {
            let TerrainPlan { scale, fitted, .. } = walk;
            let [pyramid, rom, voids] =
                [&fitted.pyramid, &fitted.kernel_rom, &fitted.void_bits].map(|fit| fit.fitted);
            format!(" {scale:?} {pyramid} {rom} {voids}")
        };
        let maps: String =
            plan.surfaces.iter().filter_map(SurfacePlan::terrain).map(of_map).collect();
        // The same samples may stand for other heights.
        let heights: Vec<_> = scene
            .surfaces
            .iter()
            .filter_map(Surface::terrain)
            .map(|terrain| (terrain.offset, terrain.scale))
            .collect();
        let Plan { words, full, .. } = plan;
        let key = format!("{world:?} {:?} {words:?} {full}{maps} {heights:?}", scene.kernel);
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        {
            let mut kept = kept();
            if let Some(at) = kept.iter().position(|(known, _)| *known == key) {
                let latest = kept.remove(at);
                let loaded = Arc::downcast(Arc::clone(&latest.1));
                kept.push(latest);
                if let Ok(loaded) = loaded {
                    return Ok(loaded);
                }
            }
        }
        let memories = Memory::of_surfaces(&world, scene, plan)?;
        let loaded = Arc::new(Loaded { memories, maps: OnceLock::new() });
        let mut kept = kept();
        if kept.len() >= KEPT {
            kept.remove(0);
        }
        kept.push((key, Arc::clone(&loaded) as Arc<dyn Any + Send + Sync>));
        Ok(loaded)
    }
}
