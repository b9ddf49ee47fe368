//! `terraline vectors`.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use super::scene_args::{Planned, SceneArgs};
use super::{Stop, report};
use crate::sink::folder::NewFolder;
use crate::sink::vectors::selection::{Choice, Selection};
use crate::sink::vectors::{self, Report};

/// Lines that become rows where nothing else is asked for: a whole frame would be huge.
const LINES: &str = "4";

/// Write test vectors of every unit, to grade anybody's hardware of the same units.
#[derive(Debug, Args)]
#[command(after_help = "Example: terraline vectors flight -o vectors\n\
                  Example: terraline vectors plane -o vectors --lines 500..504 --corner-cases 10000")]
pub struct Vectors {
    #[command(flatten)]
    scene: SceneArgs,

    /// The folder to make; its files are described in docs/vectors.md.
    #[arg(short = 'o', long = "output", value_name = "DIR")]
    output: PathBuf,

    /// Pixels of which lines: A..B from A to the one before B, or a number of lines, one at random
    /// out of each of as many strips.
    #[arg(long, value_name = "A..B|N", default_value = LINES, conflicts_with = "random")]
    lines: String,

    /// Single pixels instead, one at random out of each of N stretches of the scan.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    random: Option<u32>,

    /// Corner cases of each unit: words at the ends of ranges, tiny and negative denominators,
    /// accumulators that wrap.
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = clap::value_parser!(u32).range(..=10_000_000))]
    corner_cases: u32,

    /// Seed of everything random; the scene's if not given.
    #[arg(long, value_name = "S")]
    seed: Option<u64>,

    /// One JSON object on stdout.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Listing<'a> {
    world: &'static str,
    folder: String,
    columns: u32,
    lines: u32,
    pixels: u64,
    selection: &'a str,
    corner_cases: u32,
    seed: u64,
    #[serde(flatten)]
    written: Report,
}

impl Vectors {
    pub fn run(&self) -> Result<(), Stop> {
        NewFolder::check(&self.output)?;
        let planned = self.scene.load()?;
        let (scene, plan) = (&planned.scene, &planned.plan);
        let choice = self.choice(plan.geometry.lines)?;
        let seed = self.seed.unwrap_or(scene.seed);
        let selection = Selection::new(plan, choice, seed);
        let written = report::while_waiting("writing vectors", || {
            let job = vectors::Vectors {
                machine: &planned.machine()?,
                selection: &selection,
                corner_cases: self.corner_cases,
                seed,
                folder: &self.output,
            };
            job.write().map_err(Stop::from)
        })?;
        let listing = Listing {
            world: planned.world.name(),
            folder: self.output.display().to_string(),
            columns: plan.geometry.columns,
            lines: plan.geometry.lines,
            pixels: selection.pixels(),
            selection: &selection.description,
            corner_cases: self.corner_cases,
            seed,
            written,
        };
        if self.json {
            return report::json("vectors", Some(&scene.name), &listing);
        }
        report::print(&text(&planned, &listing));
        Ok(())
    }

    /// What `--lines` and `--random` ask for.
    fn choice(&self, lines: u32) -> Result<Choice, Stop> {
        if let Some(pixels) = self.random {
            return Ok(Choice::Pixels(pixels));
        }
        let bad = |reason: String| {
            Stop::BadInput(format!(
                "--lines {}: {reason}; give a number of lines, or A..B with A below B and B at \
                 most {lines}",
                self.lines
            ))
        };
        let number = |text: &str| {
            let text = text.trim();
            text.parse::<u32>().map_err(|_| bad(format!("`{text}` is not a number of lines")))
        };
        match self.lines.split_once("..") {
            None => match number(&self.lines)? {
                0 => Err(bad("there is nothing to write".into())),
                count => Ok(Choice::Strips(count)),
            },
            Some((from, to)) => {
                let (from, to) = (number(from)?, number(to)?);
                if from >= to {
                    return Err(bad("there is no line in this range".into()));
                }
                if to > lines {
                    return Err(bad(format!("the screen has {lines} lines")));
                }
                Ok(Choice::Lines(from, to))
            }
        }
    }
}

/// A size in bytes.
fn size(bytes: u64) -> String {
    match bytes {
        0..1_000 => format!("{bytes} B"),
        1_000..1_000_000 => format!("{:.1} kB", bytes as f64 / 1e3),
        _ => format!("{:.1} MB", bytes as f64 / 1e6),
    }
}

fn text(planned: &Planned, listing: &Listing<'_>) -> String {
    let mut out = vec![format!(
        "{}, {}x{}, {}: {} pixels ({}) and {} corner cases a unit",
        planned.scene.name,
        listing.columns,
        listing.lines,
        listing.world,
        listing.pixels,
        listing.selection,
        listing.corner_cases
    )];
    let files = &listing.written.files;
    for file in files {
        let (name, bytes) = (&file.file, size(file.bytes));
        out.push(format!("  {name:<26} {:>8} rows {bytes:>10}  {}", file.rows, file.holds));
    }
    out.push(format!(
        "wrote {}: {} files, {}; docs/vectors.md describes them",
        listing.folder,
        files.len(),
        size(listing.written.bytes)
    ));
    out.join("\n")
}
