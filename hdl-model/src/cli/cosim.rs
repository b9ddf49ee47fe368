//! `terraline-hdl cosim`.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use serde::Serialize;
use terraline::cli::scene_args::SceneArgs;
use terraline::cli::{Stop, report};
use terraline::clock::Taker;
use terraline::engine::WithSetup;
use terraline::plan::Plan;
use terraline::setup::Setup;
use terraline::word::Complete;

use crate::cosim::{self, Fault, Outcome, Window};
use crate::rtl::Rtl;
use crate::waves;

/// Draw a scene with the RTL and compare every output of every unit, and every cycle, with the
/// emulator.
#[derive(Debug, Args)]
#[command(after_help = "Example: terraline-hdl cosim flight --size 160x120 --trace flight.fst\n\
                  Exit code 1: something differs, or the RTL reads beside its memories.")]
pub struct Cosim {
    #[command(flatten)]
    scene: SceneArgs,

    /// The taker behind the frame is busy in N of 256 cycles, chosen by the scene's seed.
    #[arg(long, value_name = "N", default_value_t = 0)]
    busy: u8,

    /// Write a trace in FST, and beside it a save file for GTKWave (.gtkw) with the units' signals
    /// and their binary points.
    #[arg(long, value_name = "OUT.fst")]
    trace: Option<PathBuf>,

    /// Pixels whose cycles are traced, in scan order: all from the start of pixel A to the end of
    /// the last one before B. The first 64 of the middle line if not given.
    #[arg(long, value_name = "A..B", value_parser = parse_range, requires = "trace", conflicts_with = "trace_lines")]
    trace_pixels: Option<(u64, u64)>,

    /// Lines whose cycles are traced, from line A to before line B.
    #[arg(long, value_name = "A..B", value_parser = parse_range, requires = "trace")]
    trace_lines: Option<(u64, u64)>,

    /// One JSON object on stdout.
    #[arg(long)]
    json: bool,
}

fn parse_range(text: &str) -> Result<(u64, u64), String> {
    let range = text.split_once("..").and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
    range.filter(|(a, b)| a < b).ok_or_else(|| "give A..B, for example 0..64".into())
}

#[derive(Serialize)]
struct Waits {
    name: &'static str,
    wait_cycles: u64,
}

#[derive(Serialize)]
struct Report {
    equal: bool,
    pixels: u64,
    cycles: u64,
    emulator_cycles: u64,
    differences: u64,
    first_differences: Vec<String>,
    units: Vec<Waits>,
    trace: Option<PathBuf>,
    waves: Option<PathBuf>,
    seconds: f64,
}

struct Compare<'a> {
    taker: Taker,
    trace: Option<(&'a str, Window)>,
}

impl WithSetup for Compare<'_> {
    type Output = Result<(Outcome, Option<String>), Fault>;

    fn run<W: Complete>(self, setup: &Setup<W>) -> Self::Output {
        let rtl = Rtl::new(setup).map_err(Fault::Refused)?;
        let waves = self.trace.map(|(path, _)| waves::gtkw(Path::new(path), setup, &rtl));
        let outcome = cosim::compare_with(rtl, setup, self.taker, self.trace)?;
        Ok((outcome, waves))
    }
}

impl Cosim {
    pub fn run(&self) -> Result<(), Stop> {
        let planned = self.scene.load()?;
        let (scene, plan) = (&planned.scene, &planned.plan);
        let stop = |fault: Fault| match fault {
            Fault::Refused(reason) => Stop::BadInput(format!("{}: {reason}", planned.named)),
            Fault::Wrong(what) => {
                eprintln!("error: {}: {what}", planned.named);
                Stop::Failure
            }
        };
        let window = self.window(plan).map_err(Stop::BadInput)?;
        let path = self.trace.as_deref().map(trace_path).transpose()?;
        let compare = Compare {
            taker: match self.busy {
                0 => Taker::Ready,
                of_256 => Taker::Busy { seed: scene.seed, of_256 },
            },
            trace: path.map(|path| (path, window)),
        };
        let machine = planned.machine()?;
        let start = Instant::now();
        let (outcome, waves) =
            report::while_waiting("the RTL draws", || machine.run(compare)).map_err(stop)?;
        let seconds = start.elapsed().as_secs_f64();
        let waves = self.trace.as_deref().zip(waves);
        let waves = waves.map(|(trace, text)| write_waves(trace, &text)).transpose()?;
        let equal = outcome.is_equal();
        let found = Report {
            equal,
            pixels: outcome.pixels,
            cycles: outcome.cycles,
            emulator_cycles: outcome.expected_cycles,
            differences: outcome.differences,
            first_differences: outcome.described,
            units: outcome
                .waits
                .iter()
                .map(|&(name, wait_cycles)| Waits { name, wait_cycles })
                .collect(),
            trace: self.trace.clone(),
            waves,
            seconds,
        };
        if self.json {
            report::json("cosim", Some(&scene.name), &found)?;
        } else {
            report::print(&text(&scene.name, &found));
        }
        if equal { Ok(()) } else { Err(Stop::Failure) }
    }

    /// The pixels that are traced.
    fn window(&self, plan: &Plan) -> Result<Window, String> {
        let (columns, lines) = (u64::from(plan.geometry.columns), u64::from(plan.geometry.lines));
        let pixels = columns * lines;
        let (option, (first, end)) = match (self.trace_pixels, self.trace_lines) {
            (Some(range), _) => ("--trace-pixels", range),
            (_, Some((a, b))) => {
                ("--trace-lines", (a.saturating_mul(columns), b.saturating_mul(columns)))
            }
            _ => {
                let first = lines / 2 * columns;
                ("", (first, (first + 64).min(pixels)))
            }
        };
        if end > pixels {
            return Err(format!(
                "{option}: the frame has {lines} lines of {columns} pixels; choose among these"
            ));
        }
        Ok(Window { first, end })
    }
}

/// The name of a trace as the RTL takes it; its folder exists.
fn trace_path(path: &Path) -> Result<&str, Stop> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    if folder.is_some_and(|folder| !folder.is_dir()) {
        return Err(Stop::BadInput(format!(
            "--trace {}: its folder does not exist; make it first",
            path.display()
        )));
    }
    path.to_str().ok_or_else(|| {
        Stop::BadInput(format!("--trace {}: the name is not UTF-8; choose another", path.display()))
    })
}

fn write_waves(trace: &Path, text: &str) -> Result<PathBuf, Stop> {
    let path = trace.with_extension("gtkw");
    std::fs::write(&path, text)
        .map_err(|error| Stop::BadInput(format!("{}: {error}", path.display())))?;
    Ok(path)
}

fn text(scene: &str, found: &Report) -> String {
    let mut out = vec![format!(
        "{scene}: {} pixels in {} cycles; {}",
        found.pixels,
        found.cycles,
        if found.equal {
            "every output of every unit and every cycle is equal to the emulator's".into()
        } else {
            format!(
                "{} differences from the emulator, which takes {} cycles",
                found.differences, found.emulator_cycles
            )
        }
    )];
    out.extend(found.first_differences.iter().map(|difference| format!("  {difference}")));
    out.push("cycles in which an item waited before a unit:".into());
    for unit in &found.units {
        let share = 100.0 * unit.wait_cycles as f64 / found.cycles.max(1) as f64;
        out.push(format!("  {:<13} {:>12}  {share:.1} %", unit.name, unit.wait_cycles));
    }
    out.push(format!(
        "{} s, {} million cycles a second",
        report::digits(found.seconds),
        report::digits(found.cycles as f64 / found.seconds / 1e6)
    ));
    if let (Some(trace), Some(waves)) = (&found.trace, &found.waves) {
        out.push(format!(
            "trace in {}; open it with: gtkwave {}",
            trace.display(),
            waves.display()
        ));
    }
    out.join("\n")
}
