//! What a rendered frame is worth and what it cost, for people and as JSON.

use serde::Serialize;

use super::super::report;
use super::super::scene_args::Planned;
use super::errors::{self, Pointed};
use super::{Drawn, Render, Stop};
use crate::engine::Engine;
use crate::frame::Hit;
use crate::plan::units::UnitPlan;
use crate::study::cost::Cost;
use crate::study::error::{ErrorReport, PixelError, Sample};

/// Lines whose cycles and operations the summary counts.
const COST_LINES: u32 = 32;

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
    out_of_range: usize,
}

#[derive(Serialize)]
struct Located {
    register: &'static str,
    pixels: u64,
    line: u32,
    column: u32,
}

/// The fields of `render --json`.
#[derive(Serialize)]
pub(super) struct Summary {
    engine: &'static str,
    world: &'static str,
    world_why: String,
    not_proved: Vec<String>,
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
    worst: Option<Pointed>,
    cautions: Vec<String>,
    chosen: Vec<String>,
}

impl Render {
    /// Measures a drawn frame; `every` holds the errors of all pixels where they are known.
    pub(super) fn summarise(
        &self,
        planned: &Planned,
        drawn: &Drawn<'_>,
        every: Option<&[PixelError]>,
    ) -> Result<Summary, Stop> {
        let machine = &drawn.machine;
        let Planned { scene, plan, world, invocation, framing, .. } = planned;
        let count = |hit| drawn.band.frame.hit.iter().filter(|h| **h == hit).count();
        let mut times: Vec<f64> = drawn.times.iter().map(|t| t.as_secs_f64() * 1e3).collect();
        times.sort_by(f64::total_cmp);
        let lines = Sample::whole_lines(plan, COST_LINES, scene.seed);
        let all = Sample::all(plan);
        // The processor's own frame gives the cycles of all its lines.
        let cycles = if self.engine == Engine::Processor { &all } else { &lines };
        let refused = |error| planned.refused(&error);
        let cost = machine.cost(cycles, &lines).map_err(refused)?;
        let errors = match self.engine.is_fixed() {
            true => self.sample.measure(machine, every).map_err(refused)?,
            false => None,
        };
        let overflow = drawn.band.overflows.registers.first();
        let worst = Pointed::new(errors.as_ref(), overflow, invocation);
        Ok(Summary {
            engine: self.engine.name(),
            world: match self.engine {
                Engine::Real => "real",
                Engine::Oracle => "oracle",
                _ => world.name(),
            },
            world_why: plan.words_why.clone(),
            not_proved: plan.not_proved.clone(),
            columns: drawn.band.frame.columns,
            lines: drawn.band.frame.lines,
            units: world.units(&planned.plan),
            frame_ms: Times {
                min: times[0],
                median: (times[(times.len() - 1) / 2] + times[times.len() / 2]) / 2.0,
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
                out_of_range: count(Hit::OutOfRange),
            },
            cycles: cost.cycles,
            additions: cost.additions,
            modelled_fps: cost.modelled_fps,
            cost,
            overflows: drawn
                .band
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
            cautions: machine.cautions(),
            chosen: framing.as_ref().map_or_else(Vec::new, |framing| framing.chosen.clone()),
        })
    }

    /// The summary for people.
    pub(super) fn text(&self, planned: &Planned, summary: &Summary) -> String {
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
        out.extend(report::not_proved(&summary.not_proved));
        out.extend(report::cautions(&summary.cautions));
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
                (Hit::OutOfRange, hits.out_of_range)
            ]
            .iter()
            .filter(|(_, count)| *count > 0)
            .map(|(hit, count)| format!("{} {:.2} %", hit.name(), share(*count)))
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
            Some(errors) => out.extend(errors::lines(errors, &planned.invocation)),
            None => out.push("  error     not measured".into()),
        }
        out.extend(summary.worst.as_ref().map(Pointed::line));
        for chosen in planned.framing.iter().flat_map(|framing| &framing.chosen) {
            out.push(format!("  chosen    {chosen}"));
        }
        for (_, path) in self.outputs() {
            out.push(format!("  wrote     {}", path.display()));
        }
        out.join("\n")
    }
}
