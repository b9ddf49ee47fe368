//! The engines of one frame, set up, behind one type for every number world.

use std::any::Any;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Instant;

use crate::engine::{self, FixedWorld, InFastWorld};
use crate::fast::{self, enter::Enterable};
use crate::oracle::Oracle;
use crate::plan::{Ground, Plan};
use crate::scene::Scene;
use crate::setup::{Memory, Setup, SetupError};
use crate::study::error::{Comparison, PixelError, Sample};
use crate::word::real::Real;
use crate::word::{Complete, World};

use super::pane::Source;
use super::probe::{self, Modelled, Probe};
use super::sources::{ErrorScan, FastScan, OracleScan, ProcessorScan, Scan};

/// A frame that can be drawn, whole or in parts, by any engine.
pub trait Machine: Send + Sync {
    /// Its plan.
    fn plan(&self) -> &Plan;

    /// Name of its fixed-point world.
    fn world(&self) -> &'static str;

    /// Seconds that its coefficients took to set up, without memories.
    fn set_up_seconds(&self) -> f64;

    /// Whether the fast engine can draw it.
    fn wraps(&self) -> bool;

    /// A source at the first line. Frames have buffers on request.
    ///
    /// # Errors
    /// If the scene cannot be set up in the source's world.
    fn scan(&self, source: Source, buffers: bool) -> Result<Box<dyn Scan + '_>, SetupError>;

    /// Errors of sampled pixels.
    ///
    /// # Errors
    /// If the scene cannot be set up in f64.
    fn errors(&self, sample: &Sample) -> Result<Vec<PixelError>, SetupError>;

    /// One pixel.
    ///
    /// # Errors
    /// If the scene cannot be set up in f64.
    fn probe(&self, column: u32, line: u32) -> Result<Probe, SetupError>;

    /// Frame rate of the emulated machine, from the cycles of `lines` sampled lines.
    fn modelled(&self, lines: u32) -> Modelled;
}

/// Sets up a scene for its first screen. The memories of earlier set-ups are used again; they are
/// of one surface, so one [`Memories`] serves one scene and what becomes of it.
///
/// # Errors
/// If the scene cannot be planned or set up.
pub fn machine(
    scene: &Arc<Scene>,
    full: bool,
    memories: &Memories,
) -> Result<Box<dyn Machine>, SetupError> {
    let plan = Plan::new(scene, None, full)?;
    let world = FixedWorld::of(scene, &plan)?;
    let wraps = world.wraps();
    world.run_fast(Load { scene, plan, name: world.name(), wraps, memories })
}

struct Load<'a> {
    scene: &'a Arc<Scene>,
    plan: Plan,
    name: &'static str,
    wraps: bool,
    memories: &'a Memories,
}

impl InFastWorld for Load<'_> {
    type Output = Result<Box<dyn Machine>, SetupError>;

    fn run<W: Enterable>(self, world: W) -> Self::Output {
        let kept = self.memories.get(world, self.scene, &self.plan)?;
        let start = Instant::now();
        let fixed = Setup::new(world, self.scene, &self.plan, kept.memory.as_ref())?;
        Ok(Box::new(Loaded {
            set_up_seconds: start.elapsed().as_secs_f64(),
            scene: Arc::clone(self.scene),
            plan: self.plan,
            name: self.name,
            wraps: self.wraps,
            fixed,
            kept,
            memories: self.memories.clone(),
            real: OnceLock::new(),
            oracle: OnceLock::new(),
        }))
    }
}

struct Loaded<W: Complete> {
    set_up_seconds: f64,
    scene: Arc<Scene>,
    plan: Plan,
    name: &'static str,
    wraps: bool,
    fixed: Setup<W>,
    kept: Arc<Kept<W>>,
    memories: Memories,
    real: OnceLock<Setup<Real>>,
    oracle: OnceLock<Oracle>,
}

impl<W: Complete> Loaded<W> {
    fn real(&self) -> Result<&Setup<Real>, SetupError> {
        if let Some(real) = self.real.get() {
            return Ok(real);
        }
        let kept = self.memories.get(Real, &self.scene, &self.plan)?;
        let real = Setup::new(Real, &self.scene, &self.plan, kept.memory.as_ref())?;
        Ok(self.real.get_or_init(|| real))
    }

    fn oracle(&self) -> &Oracle {
        self.oracle.get_or_init(|| engine::oracle(&self.scene, &self.plan))
    }

    fn comparison(&self) -> Result<Comparison<'_, W>, SetupError> {
        Ok(Comparison {
            plan: &self.plan,
            fixed: &self.fixed,
            real: self.real()?,
            oracle: self.oracle(),
        })
    }
}

impl<W: Enterable> Machine for Loaded<W> {
    fn plan(&self) -> &Plan {
        &self.plan
    }

    fn world(&self) -> &'static str {
        self.name
    }

    fn set_up_seconds(&self) -> f64 {
        self.set_up_seconds
    }

    fn wraps(&self) -> bool {
        self.wraps
    }

    fn scan(&self, source: Source, buffers: bool) -> Result<Box<dyn Scan + '_>, SetupError> {
        let machine = &self.scene.machine;
        Ok(match source {
            Source::Fast => {
                let world = &self.fixed.world;
                let memory = self.kept.memory.as_ref();
                let map = self
                    .kept
                    .map
                    .get_or_init(|| fast::Map::new(world, &self.scene, &self.plan, memory));
                Box::new(FastScan::new(&self.fixed, map.as_ref(), &self.plan, buffers))
            }
            Source::Processor => {
                Box::new(ProcessorScan::new(&self.fixed, &self.plan, machine, buffers))
            }
            Source::Real => {
                Box::new(ProcessorScan::new(self.real()?, &self.plan, machine, buffers))
            }
            Source::Oracle => Box::new(OracleScan::new(self.oracle(), &self.plan)),
            Source::FixedError | Source::RealError => {
                let errors = self.comparison()?;
                Box::new(ErrorScan::new(errors, source == Source::RealError))
            }
        })
    }

    fn errors(&self, sample: &Sample) -> Result<Vec<PixelError>, SetupError> {
        Ok(self.comparison()?.pixels(sample))
    }

    fn probe(&self, column: u32, line: u32) -> Result<Probe, SetupError> {
        let machine = &self.scene.machine;
        let comparison = self.comparison()?;
        Ok(probe::probe(&comparison, machine, column, line))
    }

    fn modelled(&self, lines: u32) -> Modelled {
        let sample = Sample::whole_lines(&self.plan, lines, self.scene.seed);
        probe::modelled(&self.fixed, &self.plan, &self.scene.machine, &sample)
    }
}

/// What one world keeps of a surface from frame to frame.
struct Kept<W: World> {
    memory: Option<Memory<W>>,
    /// Made when the fast engine first draws.
    map: OnceLock<Option<fast::Map<W>>>,
}

/// Memories of one surface that were loaded before, the latest used last.
#[derive(Clone, Default)]
pub struct Memories(Arc<Mutex<Vec<(String, AnyKept)>>>);

/// A [`Kept`] of any world, found by what it depends on, in words.
type AnyKept = Arc<dyn Any + Send + Sync>;

/// Fixed and real: of large maps they are large.
const MOST: usize = 2;

impl Memories {
    fn get<W: Complete>(
        &self,
        world: W,
        scene: &Scene,
        plan: &Plan,
    ) -> Result<Arc<Kept<W>>, SetupError> {
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
                kept.push(latest);
                let memory = kept.last().map(|(_, memory)| Arc::clone(memory));
                if let Some(Ok(memory)) = memory.map(Arc::downcast) {
                    return Ok(memory);
                }
            }
        }
        let memory = Memory::new(&world, scene, plan)?;
        let memory = Arc::new(Kept { memory, map: OnceLock::new() });
        let mut kept = kept();
        if kept.len() >= MOST {
            kept.remove(0);
        }
        kept.push((key, Arc::clone(&memory) as AnyKept));
        Ok(memory)
    }
}
