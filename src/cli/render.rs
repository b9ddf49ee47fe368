//! `terraline render`.

mod summary;

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use clap::Args;

use super::outputs::{self, Named};
use super::scene_args::{Planned, SceneArgs};
use super::scene_out::SceneOut;
use super::{Stop, report};
use crate::clock::{Chain, Clock};
use crate::engine::{self, Engine, InFastWorld, InFixedWorld, Overflows};
use crate::fast::{self, enter::Enterable};
use crate::frame::Frame;
use crate::plan::units::{UnitPlan, units};
use crate::setup::{Memory, Setup, SetupError};
use crate::sink::picture::{self, Picture};
use crate::sink::{npz, png};
use crate::study::error::{self, Sample, Sheet};
use crate::word::Complete;
use crate::word::real::Real;

/// Draw one frame and say what it is worth and what it costs.
#[derive(Debug, Args)]
#[command(after_help = "Example: terraline render flight -o flight.png --size 640x480 --repeat 9
Example: terraline render dem.tif -o terrain.png --scene-out terrain.toml")]
pub struct Render {
    #[command(flatten)]
    scene: SceneArgs,

    /// The picture to write, a PNG; without it only the summary is made.
    #[arg(short, long, value_name = "OUT.png")]
    output: Option<PathBuf>,

    /// Who draws.
    #[arg(long, value_enum, default_value_t = Engine::Fast)]
    engine: Engine,

    /// What the picture shows.
    #[arg(long, value_enum, default_value_t = Picture::Color)]
    picture: Picture,

    /// Write every pixel's outcome, ground point, height, normal, steps and colour.
    #[arg(long, value_name = "OUT.npz")]
    buffers: Option<PathBuf>,

    #[command(flatten)]
    scene_out: SceneOut,

    /// Draw the frame this many times and report minimum, median and maximum.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    repeat: u32,

    /// Errors are measured on N lines x N columns, one at random in each of N strips; 0 for none.
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(0..=4096))]
    sample: u32,

    /// One JSON object on stdout.
    #[arg(long)]
    json: bool,
}

/// Pixels beyond which buffers are refused: they hold about 90 bytes each.
const MAX_BUFFERED: usize = 1 << 24;

/// A drawn frame.
struct Drawn {
    frame: Frame,
    times: Vec<Duration>,
    setup: Duration,
    overflows: Overflows,
    cycles: Option<Vec<u32>>,
}

struct Draw<'a> {
    planned: &'a Planned,
    engine: Engine,
    buffers: bool,
    repeat: u32,
    cycles: bool,
}

impl InFastWorld for Draw<'_> {
    type Output = Result<Drawn, SetupError>;

    fn run<W: Enterable>(self, world: W) -> Self::Output {
        let Planned { scene, plan, .. } = self.planned;
        let start = Instant::now();
        let memory = Memory::new(&world, scene, plan)?;
        let map = match self.engine {
            Engine::Fast => fast::Map::new(&world, scene, plan, memory.as_ref()),
            _ => None,
        };
        let loaded = start.elapsed();
        let mut overflows = Overflows::default();
        let mut cycles = None;
        let mut times = Vec::new();
        let mut frame = None;
        for _ in 0..self.repeat {
            let start = Instant::now();
            let setup = Setup::new(world, scene, plan, memory.as_ref())?;
            frame = Some(if self.engine == Engine::Fast && !self.planned.world.can_overflow() {
                fast::render(&setup, map.as_ref(), plan, self.buffers)
            } else if self.engine == Engine::Fast {
                let found = Mutex::new(Overflows::default());
                let frame =
                    fast::render_and_look(&setup, map.as_ref(), plan, self.buffers, &|line| {
                        if let Ok(mut found) = found.lock() {
                            found.inspect(line);
                        }
                    });
                overflows = found.into_inner().unwrap_or_default();
                frame
            } else {
                let mut clock = self.cycles.then(|| {
                    (
                        Clock::new(Chain::new(&setup, &scene.machine, plan.fitted.idle)),
                        Vec::new(),
                        0,
                    )
                });
                overflows = Overflows::default();
                let frame = engine::draw_by_lines(&setup, plan, self.buffers, |line| {
                    overflows.inspect(line);
                    if let Some((clock, spent, before)) = &mut clock {
                        clock.take_line(line, |_, done| {
                            spent.push((done - *before) as u32);
                            *before = done;
                        });
                    }
                });
                cycles = clock.map(|(_, spent, _)| spent);
                frame
            });
            times.push(start.elapsed());
        }
        let frame = frame.unwrap_or_else(|| unreachable!("at least one frame is drawn"));
        Ok(Drawn { frame, times, setup: loaded, overflows, cycles })
    }
}

impl Render {
    pub fn run(&self) -> Result<(), Stop> {
        outputs::check(self.outputs())?;
        let planned = self.scene.load()?;
        outputs::keep_inputs(self.outputs(), &self.scene.inputs(&planned))?;
        let scene_text = self.scene_out.text(&self.scene, &planned)?;
        let pixels = planned.plan.geometry.columns as usize * planned.plan.geometry.lines as usize;
        let buffers = self.buffers.is_some() || self.picture.needs_buffers();
        // The oracle's frame has buffers always, the picture of errors holds as much.
        let heavy = buffers || self.engine == Engine::Oracle || self.picture == Picture::Error;
        if heavy && pixels > MAX_BUFFERED {
            return Err(Stop::BadInput(format!(
                "--size: {pixels} pixels with their buffers would take gigabytes, at most \
                 {MAX_BUFFERED} are held; draw a smaller frame, or the colour picture with the fast \
                 engine"
            )));
        }
        let drawn = report::while_waiting("drawing", || self.draw(&planned, buffers))?;
        let summary = report::while_waiting("measuring", || self.summarise(&planned, &drawn))?;
        if let Some(path) = &self.output {
            self.write_picture(path, &planned, &drawn)?;
        }
        if let Some(path) = &self.buffers {
            npz::write(path, &drawn.frame)?;
        }
        self.scene_out.write(scene_text.as_deref())?;
        if self.json {
            return report::json("render", Some(&planned.scene.name), &summary);
        }
        report::print(&self.text(&planned, &summary));
        Ok(())
    }

    /// The files to write.
    fn outputs(&self) -> impl Iterator<Item = Named<'_>> {
        let named = [("--output", &self.output), ("--buffers", &self.buffers)];
        named
            .into_iter()
            .filter_map(|(option, path)| Some((option, path.as_deref()?)))
            .chain(self.scene_out.named())
    }

    fn draw(&self, planned: &Planned, buffers: bool) -> Result<Drawn, Stop> {
        let Planned { scene, plan, world, .. } = planned;
        let cycles = self.picture == Picture::Cycles;
        if cycles && self.engine != Engine::Processor {
            return Err(Stop::BadInput(
                "--picture cycles: cycles are the processor's; add --engine processor".into(),
            ));
        }
        let draw = |engine| Draw { planned, engine, buffers, repeat: self.repeat, cycles };
        match self.engine {
            Engine::Fast if !world.wraps() => Err(Stop::BadInput(
                "--engine fast: saturating registers cannot be entered at any step; add \
                 --engine processor"
                    .into(),
            )),
            Engine::Fast | Engine::Processor => {
                world.run_fast(draw(self.engine)).map_err(|error| planned.refused(&error))
            }
            Engine::Real | Engine::Oracle => {
                let mut times = Vec::new();
                let mut frame = None;
                let refused = |error| planned.refused(&error);
                let start = Instant::now();
                let memory = match self.engine {
                    Engine::Real => Memory::new(&Real, scene, plan).map_err(refused)?,
                    _ => None,
                };
                let setup = start.elapsed();
                for _ in 0..self.repeat {
                    let start = Instant::now();
                    frame = Some(match self.engine {
                        Engine::Real => engine::draw_real(scene, plan, memory.as_ref(), buffers)
                            .map_err(refused)?,
                        _ => engine::draw_oracle(scene, plan),
                    });
                    times.push(start.elapsed());
                }
                let frame = frame.unwrap_or_else(|| unreachable!("at least one frame is drawn"));
                Ok(Drawn { frame, times, setup, overflows: Overflows::default(), cycles: None })
            }
        }
    }

    fn write_picture(&self, path: &Path, planned: &Planned, drawn: &Drawn) -> Result<(), Stop> {
        let frame = &drawn.frame;
        let painted = match self.picture {
            Picture::Error => {
                let Planned { scene, plan, world, .. } = planned;
                let pixels = report::while_waiting("asking the oracle", || {
                    error::pixels(scene, plan, world, &Sample::all(plan))
                })
                .map_err(|error| planned.refused(&error))?;
                let errors: Vec<f64> = pixels.iter().map(|p| p.total_px).collect();
                let silhouettes: Vec<bool> =
                    pixels.iter().map(|p| p.sheet == Sheet::Silhouette).collect();
                picture::error(&errors, &silhouettes)
            }
            Picture::Cycles => picture::cycles(drawn.cycles.as_deref().unwrap_or_default()),
            other => other.of_frame(frame).unwrap_or_else(|| unreachable!("buffers were drawn")),
        };
        png::write(path, frame.columns, frame.lines, &painted.pixels)?;
        if let Some(legend) = painted.legend {
            eprintln!(
                "{}: {} to {} {}{}",
                self.picture.name(),
                report::digits(legend.low),
                report::digits(legend.high),
                legend.unit,
                if legend.logarithmic { ", logarithmic" } else { "" }
            );
        }
        Ok(())
    }
}

/// The plan's units in the world's formats.
pub struct Units<'a> {
    /// Scene and plan.
    pub planned: &'a Planned,
}

impl InFixedWorld for Units<'_> {
    type Output = Vec<UnitPlan>;
    fn run<W: Complete>(self, world: W) -> Self::Output {
        units(&self.planned.plan, &self.planned.scene, &world)
    }
}
