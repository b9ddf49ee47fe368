//! `terraline render`.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use serde::Serialize;

use super::scene_args::{Planned, SceneArgs};
use super::{Stop, report};
use crate::clock::{Chain, Clock};
use crate::engine::{self, Engine, InFixedWorld, Overflows};
use crate::fast::{self, enter::Enterable};
use crate::frame::{Frame, Hit};
use crate::plan::units::{UnitPlan, units};
use crate::setup::{Memory, Setup, SetupError};
use crate::sink::picture::{self, Picture};
use crate::sink::{self, npz, png};
use crate::study::cost::{Cost, Measure};
use crate::study::error::{self, ErrorReport, Sample, Sheet, Spread};
use crate::study::explain::hit_name;
use crate::word::Complete;

/// Draw one frame and say what it is worth and what it costs.
#[derive(Debug, Args)]
#[command(after_help = "Example: terraline render flight -o flight.png --size 640x480 --repeat 9")]
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

    /// Draw the frame this many times and report minimum, median and maximum.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    repeat: u32,

    /// Errors are measured on N lines x N columns, one at random in each of N strips; 0 for none.
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(0..=16_384))]
    sample: u32,

    /// One JSON object on stdout.
    #[arg(long)]
    json: bool,
}

/// Pixels beyond which buffers are refused: they hold about 90 bytes each.
const MAX_BUFFERED: usize = 1 << 24;
/// Lines whose cycles and operations the summary counts.
const COST_LINES: u32 = 32;

/// A drawn frame.
struct Drawn {
    frame: Frame,
    times: Vec<Duration>,
    setup: Duration,
    overflows: Overflows,
    cycles: Option<Vec<u32>>,
}

/// Milliseconds of repeated frames.
#[derive(Serialize)]
struct Times {
    min: f64,
    median: f64,
    max: f64,
    runs: usize,
}

/// Pixels by outcome.
#[derive(Serialize)]
struct Hits {
    sky: usize,
    surface: usize,
    side: usize,
    far: usize,
}

#[derive(Serialize)]
struct Located {
    register: &'static str,
    pixels: u64,
    line: u32,
    column: u32,
}

#[derive(Serialize)]
struct Worst {
    column: u32,
    line: u32,
    error_px: f64,
    explain: String,
}

#[derive(Serialize)]
struct Summary {
    engine: &'static str,
    world: &'static str,
    world_why: String,
    columns: usize,
    lines: usize,
    units: Vec<UnitPlan>,
    frame_ms: Times,
    setup_ms: f64,
    threads: usize,
    hits: Hits,
    cycles: u64,
    additions: u64,
    modelled_fps: f64,
    cost: Cost,
    overflows: Vec<Located>,
    errors: Option<ErrorReport>,
    worst: Option<Worst>,
}

struct Draw<'a> {
    planned: &'a Planned,
    engine: Engine,
    buffers: bool,
    repeat: u32,
    cycles: bool,
}

impl InFixedWorld for Draw<'_> {
    type Output = Result<Drawn, SetupError>;

    fn run<W: Complete + Enterable>(self, world: W) -> Self::Output {
        let Planned { scene, plan, .. } = self.planned;
        let start = Instant::now();
        let memory = Memory::new(&world, scene, plan)?;
        let loaded = start.elapsed();
        let mut overflows = Overflows::default();
        let mut cycles = None;
        let mut times = Vec::new();
        let mut frame = None;
        for _ in 0..self.repeat {
            let start = Instant::now();
            let setup = Setup::new(world, scene, plan, memory.as_ref())?;
            frame = Some(if self.engine == Engine::Fast {
                fast::render(&setup, plan, self.buffers)
            } else {
                let mut clock = self.cycles.then(|| {
                    let latency = scene.machine.memory_latency;
                    (Clock::new(Chain::new(&setup, latency, plan.fitted.idle)), Vec::new(), 0)
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
        for path in [&self.output, &self.buffers].into_iter().flatten() {
            sink::check_writable(path)?;
        }
        if let (Some(output), Some(buffers)) = (&self.output, &self.buffers)
            && std::path::absolute(output).ok() == std::path::absolute(buffers).ok()
        {
            return Err(Stop::BadInput(format!(
                "--buffers {}: the picture goes to the same file; give two names",
                buffers.display()
            )));
        }
        let planned = self.scene.load()?;
        let pixels = planned.plan.geometry.columns as usize * planned.plan.geometry.lines as usize;
        let buffers = self.buffers.is_some() || self.picture.needs_buffers();
        if buffers && pixels > MAX_BUFFERED {
            return Err(Stop::BadInput(format!(
                "--size: buffers of {pixels} pixels would take gigabytes, at most {MAX_BUFFERED} \
                 are held; draw a smaller frame, or the colour picture alone"
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
        if self.json {
            return report::json("render", Some(&planned.scene.name), &summary);
        }
        report::print(&self.text(&planned, &summary));
        Ok(())
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
            Engine::Fast | Engine::Processor => Ok(world.run(draw(self.engine))?),
            Engine::Real | Engine::Oracle => {
                let mut times = Vec::new();
                let mut frame = None;
                for _ in 0..self.repeat {
                    let start = Instant::now();
                    frame = Some(match self.engine {
                        Engine::Real => engine::draw_real(scene, plan, buffers)?,
                        _ => engine::draw_oracle(scene, plan),
                    });
                    times.push(start.elapsed());
                }
                let frame = frame.unwrap_or_else(|| unreachable!("at least one frame is drawn"));
                Ok(Drawn {
                    frame,
                    times,
                    setup: Duration::ZERO,
                    overflows: Overflows::default(),
                    cycles: None,
                })
            }
        }
    }

    fn write_picture(
        &self,
        path: &std::path::Path,
        planned: &Planned,
        drawn: &Drawn,
    ) -> Result<(), Stop> {
        let frame = &drawn.frame;
        let painted = match self.picture {
            Picture::Error => {
                let Planned { scene, plan, world, .. } = planned;
                let pixels = report::while_waiting("asking the oracle", || {
                    error::pixels(scene, plan, world, &Sample::all(plan))
                })?;
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

    fn summarise(&self, planned: &Planned, drawn: &Drawn) -> Result<Summary, Stop> {
        let Planned { scene, plan, world, invocation } = planned;
        let count = |hit| drawn.frame.hit.iter().filter(|h| **h == hit).count();
        let mut times: Vec<f64> = drawn.times.iter().map(|t| t.as_secs_f64() * 1e3).collect();
        times.sort_by(f64::total_cmp);
        let lines = Sample::whole_lines(plan, COST_LINES, scene.seed);
        let all = Sample::all(plan);
        // The processor's own frame gives the cycles of all its lines.
        let cycles = if self.engine == Engine::Processor { &all } else { &lines };
        let cost = world.run(Measure { scene, plan, cycles, operations: &lines })?;
        let fixed = matches!(self.engine, Engine::Fast | Engine::Processor);
        let errors = if fixed && self.sample > 0 {
            let sample = Sample::strips(plan, self.sample, scene.seed);
            let pixels = error::pixels(scene, plan, world, &sample)?;
            Some(ErrorReport::new(&sample, &pixels, scene.unit_m))
        } else {
            None
        };
        let worst = errors.as_ref().and_then(|errors| {
            let (column, line) = errors.worst?;
            Some(Worst {
                column,
                line,
                error_px: errors.total_px.max,
                explain: format!("terraline explain {invocation} --pixel {column},{line}"),
            })
        });
        Ok(Summary {
            engine: self.engine.name(),
            world: match self.engine {
                Engine::Real => "real",
                Engine::Oracle => "oracle",
                _ => world.name(),
            },
            world_why: plan.words_why().to_owned(),
            columns: drawn.frame.columns,
            lines: drawn.frame.lines,
            units: world.run(Units { planned }),
            frame_ms: Times {
                min: times[0],
                median: times[times.len() / 2],
                max: times[times.len() - 1],
                runs: times.len(),
            },
            setup_ms: drawn.setup.as_secs_f64() * 1e3,
            threads: if self.engine == Engine::Processor || self.engine == Engine::Real {
                1
            } else {
                rayon::current_num_threads()
            },
            hits: Hits {
                sky: count(Hit::Sky),
                surface: count(Hit::Surface),
                side: count(Hit::Side),
                far: count(Hit::Far),
            },
            cycles: cost.cycles,
            additions: cost.additions,
            modelled_fps: cost.modelled_fps,
            cost,
            overflows: drawn
                .overflows
                .registers
                .iter()
                .map(|&(register, pixels, (line, column))| Located {
                    register: register.name(),
                    pixels,
                    line,
                    column,
                })
                .collect(),
            errors,
            worst,
        })
    }

    fn text(&self, planned: &Planned, summary: &Summary) -> String {
        let digits = report::digits;
        let mut out = vec![format!(
            "{}, {}x{}, {} engine, {} ({})",
            planned.scene.name,
            summary.columns,
            summary.lines,
            summary.engine,
            summary.world,
            summary.world_why
        )];
        let fitted: Vec<_> =
            summary.units.iter().filter(|unit| unit.fitted).map(|unit| unit.name).collect();
        out.push(format!("  fitted    {}", fitted.join(", ")));
        for unit in summary.units.iter().filter(|unit| !unit.fitted) {
            out.push(format!("  left out  {}: {}", unit.name, unit.why));
        }
        let cost = &summary.cost;
        out.push(format!(
            "  machine   {} cycles and {} additions a pixel (processor, {} and {} of {} lines); \
             the {} limits",
            digits(cost.cycles_per_pixel),
            digits(cost.additions_per_pixel),
            cost.cycle_lines,
            cost.operation_lines,
            cost.lines,
            cost.limit
        ));
        out.push(format!(
            "            {} frames/s modelled at {} MHz",
            digits(summary.modelled_fps),
            planned.scene.machine.clock_mhz
        ));
        let times = &summary.frame_ms;
        let spread = if times.runs > 1 {
            format!(" (median of {}, {} to {})", times.runs, digits(times.min), digits(times.max))
        } else {
            String::new()
        };
        out.push(format!(
            "  wall time {} ms a frame{spread} on {} thread{}; maps and tables {} ms before",
            digits(times.median),
            summary.threads,
            if summary.threads == 1 { "" } else { "s" },
            digits(summary.setup_ms)
        ));
        let pixels = (summary.columns * summary.lines) as f64;
        let share = |count: usize| 100.0 * count as f64 / pixels;
        let hits = &summary.hits;
        out.push(format!(
            "  pixels    {}",
            [
                (Hit::Surface, hits.surface),
                (Hit::Side, hits.side),
                (Hit::Sky, hits.sky),
                (Hit::Far, hits.far)
            ]
            .iter()
            .filter(|(_, count)| *count > 0)
            .map(|(hit, count)| format!("{} {:.2} %", hit_name(*hit), share(*count)))
            .collect::<Vec<_>>()
            .join(", ")
        ));
        for overflow in &summary.overflows {
            out.push(format!(
                "  overflow  {} on {} pixels, first at column {}, line {}",
                overflow.register, overflow.pixels, overflow.column, overflow.line
            ));
        }
        match &summary.errors {
            Some(errors) => out.extend(error_lines(errors)),
            None => out.push("  error     not measured".into()),
        }
        if let Some(worst) = &summary.worst {
            out.push(format!(
                "  worst     column {}, line {}: {} pixels off; {}",
                worst.column,
                worst.line,
                digits(worst.error_px),
                worst.explain
            ));
        }
        for path in [&self.output, &self.buffers].into_iter().flatten() {
            out.push(format!("  wrote     {}", path.display()));
        }
        out.join("\n")
    }
}

fn error_lines(errors: &ErrorReport) -> Vec<String> {
    let row = |name: &str, px: Spread, m: Spread| {
        let digits = report::digits;
        format!(
            "            {name:<13} {:>9} {:>9} {:>9} px {:>9} {:>9} {:>9} m",
            digits(px.median),
            digits(px.p999),
            digits(px.max),
            digits(m.median),
            digits(m.p999),
            digits(m.max)
        )
    };
    vec![
        format!(
            "  error     against the oracle on {} pixels ({} lines x {} columns): {} on the same \
             sheet, {} silhouettes",
            errors.pixels,
            errors.sampled_lines,
            errors.sampled_columns,
            errors.same_sheet,
            errors.silhouettes
        ),
        format!(
            "            {:<13} {:>9} {:>9} {:>9}    {:>9} {:>9} {:>9}",
            "", "median", "99.9 %", "max", "median", "99.9 %", "max"
        ),
        row("total", errors.total_px, errors.total_m),
        row("algorithm", errors.algorithm_px, errors.algorithm_m),
        row("quantisation", errors.quantisation_px, errors.quantisation_m),
        format!("            colour within 2 levels on {:.2} %", 100.0 * errors.color_within_2),
    ]
}

/// The plan's units in the world's formats.
pub struct Units<'a> {
    /// Scene and plan.
    pub planned: &'a Planned,
}

impl InFixedWorld for Units<'_> {
    type Output = Vec<UnitPlan>;
    fn run<W: Complete + Enterable>(self, world: W) -> Self::Output {
        units(&self.planned.plan, &self.planned.scene, &world)
    }
}
