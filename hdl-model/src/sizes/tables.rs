//! The tables of the README.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::{Row, Sizes, jobs, measure, route};
use crate::netlist::Target;

const BEGIN: &str = "<!-- sizes: made by `cargo run --release -p terraline-hdl -- sizes` -->";
const END: &str = "<!-- sizes: end -->";

/// Frames per second that a flight simulator of the time needs.
const WANTED: f64 = 25.0;

/// The README with the tables between its two marks.
///
/// # Errors
/// If it has no marks.
pub fn into_readme(readme: &str, sizes: &Sizes) -> Result<String, String> {
    let without = || format!("README.md: no lines \"{BEGIN}\" and \"{END}\"; put them back");
    let (before, rest) = readme.split_once(BEGIN).ok_or_else(without)?;
    let (_, after) = rest.split_once(END).ok_or_else(without)?;
    Ok(format!("{before}{BEGIN}\n\n{}{END}{after}", text(sizes)))
}

fn text(sizes: &Sizes) -> String {
    let mut out = String::new();
    for target in Target::ALL {
        out.push_str(&device(sizes, target));
    }
    out.push_str(&rates(sizes));
    out
}

/// A row as one line, for the terminal.
pub fn line(row: &Row) -> String {
    format!(
        "{}, {} ({}): {} LUTs, {} flip-flops, {} block RAM, {}; {}",
        row.design,
        row.target,
        row.parameters,
        row.luts,
        row.flip_flops,
        row.block_ram,
        row.clock_mhz.map_or("no clock".into(), |clock| format!("{clock:.1} MHz")),
        row.remark
    )
}

fn device(sizes: &Sizes, target: Target) -> String {
    let rows: Vec<&Row> = sizes.rows.iter().filter(|row| row.target == target.name()).collect();
    let tools: BTreeSet<&str> = rows.iter().map(|row| row.tools.as_str()).collect();
    let tools: Vec<&str> = tools.into_iter().collect();
    let (luts, ram) = measure::capacity(target);
    let (device, block) = match target {
        Target::Ice40 => ("iCE40-HX8K", "4 kbit"),
        Target::Ecp5 => ("ECP5-85K", "18 kbit"),
    };
    let mut out = format!(
        "### {device}\n\n{luts} LUTs, {ram} blocks of RAM of {block}. `{}`, `{} {}`; {}.\n\n\
         | | Parameters | LUTs | Flip-flops | Block RAM | Cells with shell | Clock, MHz |\n\
         |---|---|--:|--:|--:|--:|--:|\n",
        target.synthesis(),
        route::options(target).join(" "),
        route::EFFORT.join(" "),
        tools.join("; ")
    );
    for row in &rows {
        let cells = row.cells.map_or(String::new(), |cells| cells.to_string());
        let clock = row.clock_mhz.map_or(row.remark.clone(), |clock| format!("{clock:.1}"));
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} | {cells} | {clock} |",
            row.design, row.parameters, row.luts, row.flip_flops, row.block_ram,
        );
    }
    let missing: Vec<&str> = jobs()
        .iter()
        .filter(|job| job.target == target)
        .map(|job| job.design.name)
        .filter(|name| !rows.iter().any(|row| row.design == *name))
        .collect();
    if !missing.is_empty() {
        let _ = writeln!(out, "\nNot measured: {}.", missing.join("; "));
    }
    out.push_str("\nLongest paths, from register to register:\n\n");
    for row in rows.iter().filter(|row| row.clock_mhz.is_some()) {
        let _ = writeln!(out, "- {}: {}", row.design, row.remark);
    }
    out.push('\n');
    out
}

fn rates(sizes: &Sizes) -> String {
    let clock_of = |scene: &str| {
        let design = if scene == "plane" { "plane, pipelined" } else { "terrain, pipelined" };
        let is_it = |row: &&Row| row.design == design && row.target == Target::Ecp5.name();
        sizes.rows.iter().find(is_it).and_then(|row| row.clock_mhz)
    };
    let mut out = String::from(
        "### Frame rates\n\nThe pipelined machines on ECP5 at their clock, memories of 2 cycles. \
         Cycles are those of `terraline cycles`. The last column is an estimate: pipelines that \
         share a frame's lines evenly, each with memories of its own.\n\n\
         | Scene | Words | Raster | Cycles | Clock, MHz | Frames/s | Pipelines for 25 frames/s |\n\
         |---|---|---|--:|--:|--:|--:|\n",
    );
    for frame in &sizes.frames {
        // The clocks are those of narrow words.
        let clock = clock_of(&frame.scene).filter(|_| frame.words == "narrow");
        let rate = clock.map(|mhz| mhz * 1e6 / frame.cycles as f64);
        let cell = |value: Option<String>| value.unwrap_or_else(|| "not measured".into());
        let _ = writeln!(
            out,
            "| {} | {} | {}×{} | {} | {} | {} | {} |",
            frame.scene,
            frame.words,
            frame.columns,
            frame.lines,
            frame.cycles,
            cell(clock.map(|mhz| format!("{mhz:.1}"))),
            cell(rate.map(|rate| format!("{rate:.2}"))),
            cell(rate.map(|rate| format!("{}", (WANTED / rate).ceil()))),
        );
    }
    out.push('\n');
    out
}
