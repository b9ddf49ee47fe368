//! What the units take on two devices, at which clock, and what frame rates follow.
//!
//! Results are kept in `sizes.json`, so that one design can be measured by itself; the tables of the
//! README are made of it.

pub mod frames;
pub mod measure;
pub mod route;
pub mod shell;
pub mod tables;

use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::netlist::{DESIGNS, Design, Target};

/// What `--only` calls the cycles of the frames.
pub const FRAMES: &str = "frames";

/// A design on a device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name of the design, as `netlist::DESIGNS` has it.
    pub design: String,
    /// Device family, by its name in reports.
    pub target: String,
    /// Parameters, as `NAME=value`.
    pub parameters: String,
    /// Programs and their versions.
    pub tools: String,
    /// Look-up tables of four inputs, those of carries included where they take some.
    pub luts: u64,
    /// Flip-flops after synthesis.
    pub flip_flops: u64,
    /// Blocks of RAM after synthesis.
    pub block_ram: u64,
    /// Logic cells after placement, the shell's included; `None` where it was not placed.
    pub cells: Option<u64>,
    /// Highest clock, MHz; `None` where it was not routed.
    pub clock_mhz: Option<f64>,
    /// The longest path, or why there is no clock.
    pub remark: String,
}

/// Cycles of a frame.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FrameRow {
    /// Built-in scene that was drawn.
    pub scene: String,
    /// Word size that its plan chooses.
    pub words: String,
    /// Columns of the raster.
    pub columns: u32,
    /// Lines of its frame.
    pub lines: u32,
    /// Cycles, all lines counted.
    pub cycles: u64,
}

/// All that was measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sizes {
    /// Designs on devices, in the order of [`jobs`].
    pub rows: Vec<Row>,
    /// Modelled frame rates, a row for each built-in scene.
    pub frames: Vec<FrameRow>,
}

/// A design to be measured on a device.
#[derive(Clone, Copy, Debug)]
pub struct Job {
    /// Design to be synthesised.
    pub design: &'static Design,
    /// Device family to map it to.
    pub target: Target,
    /// Parameters that differ there.
    pub parameters: &'static [(&'static str, u32)],
}

/// Kernel tables that an iCE40 has room for.
const SMALL_TABLES: &[(&str, u32)] = &[("TABLE_LOG2", 8)];

/// What is measured, in the order of the tables: narrow words. Machines that no device of the
/// family holds are left out.
pub fn jobs() -> Vec<Job> {
    let mut jobs = Vec::new();
    for target in Target::ALL {
        for design in DESIGNS {
            let is_left_out = match target {
                Target::Ice40 => design.top == "terraline" && design.name != "plane, serial",
                Target::Ecp5 => design.name == "terrain, 3×3",
            };
            if is_left_out {
                continue;
            }
            let small = target == Target::Ice40 && design.top == "interpolator";
            jobs.push(Job { design, target, parameters: if small { SMALL_TABLES } else { &[] } });
        }
    }
    jobs
}

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Measures everything, or what bears a name, and writes `sizes.json` and the README's tables.
///
/// # Errors
/// If a tool is missing or refuses, or there is nothing of that name.
pub fn run(only: Option<&str>, limit: Duration) -> Result<(), String> {
    let chosen = |name: &str| only.is_none_or(|only| only == name);
    let known = DESIGNS.iter().map(|design| design.name).chain([FRAMES]);
    if !known.clone().any(&chosen) {
        let known: Vec<&str> = known.collect();
        return Err(format!("--only: none of that name; there are {}", known.join("; ")));
    }
    let jobs = jobs();
    for job in jobs.iter().filter(|job| chosen(job.design.name)) {
        let row = measure::measure(job, limit)?;
        println!("{}", tables::line(&row));
        // Read again: other runs may have written theirs meanwhile.
        let mut sizes = load()?;
        let same = |old: &Row| old.design == row.design && old.target == row.target;
        sizes.rows.retain(|old| !same(old));
        sizes.rows.push(row);
        let place = |row: &Row| {
            let is_its =
                |job: &Job| job.design.name == row.design && job.target.name() == row.target;
            jobs.iter().position(is_its)
        };
        sizes.rows.retain(|row| place(row).is_some());
        sizes.rows.sort_by_key(place);
        store(&sizes)?;
    }
    if chosen(FRAMES) {
        let frames = frames::all()?;
        store(&Sizes { frames, ..load()? })?;
    }
    Ok(())
}

/// Reads `sizes.json`.
///
/// # Errors
/// If it does not exist or is something else.
pub fn load() -> Result<Sizes, String> {
    let path = file("sizes.json");
    let text = std::fs::read_to_string(&path);
    let text = text.map_err(|error| format!("{}: {error}", path.display()))?;
    serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))
}

/// Writes `sizes.json` and the README's tables.
fn store(sizes: &Sizes) -> Result<(), String> {
    let text = serde_json::to_string_pretty(sizes).map_err(|error| error.to_string())? + "\n";
    let path = file("README.md");
    let readme = std::fs::read_to_string(&path);
    let readme = readme.map_err(|error| format!("{}: {error}", path.display()))?;
    let readme = tables::into_readme(&readme, sizes)?;
    for (name, text) in [("sizes.json", text), ("README.md", readme)] {
        let path = file(name);
        std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}
