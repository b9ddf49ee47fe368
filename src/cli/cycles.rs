//! `terraline cycles`.

use clap::Args;

use super::scene_args::SceneArgs;
use super::{Stop, report};
use crate::study::cost::Cost;
use crate::study::error::Sample;

/// Count cycles, additions and reads per unit, and the frame rate at the scene's clock.
#[derive(Debug, Args)]
#[command(after_help = "Example: terraline cycles valley --set machine.memory_latency=5")]
pub struct Cycles {
    #[command(flatten)]
    scene: SceneArgs,

    /// Lines whose operations are tallied, one at random in each of N strips. Cycles are those of
    /// all lines.
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u32).range(1..=16_384))]
    sample: u32,

    /// One JSON object on stdout.
    #[arg(long)]
    json: bool,
}

impl Cycles {
    pub fn run(&self) -> Result<(), Stop> {
        let planned = self.scene.load()?;
        let (scene, plan) = (&planned.scene, &planned.plan);
        let all = Sample::all(plan);
        let operations = Sample::whole_lines(plan, self.sample, scene.seed);
        let cost = report::while_waiting("counting", || {
            let cost = planned.machine()?.cost(&all, &operations);
            cost.map_err(|error| planned.refused(&error))
        })?;
        if self.json {
            return report::json("cycles", Some(&scene.name), &cost);
        }
        report::print(&text(&scene.name, scene.machine.clock_mhz, &cost));
        Ok(())
    }
}

fn text(scene: &str, clock: f64, cost: &Cost) -> String {
    let digits = report::digits;
    let mut out = vec![
        format!(
            "{scene}: {} cycles, {} a pixel, {} frames/s at {clock} MHz; the {} limits",
            cost.cycles,
            digits(cost.cycles_per_pixel),
            digits(cost.modelled_fps),
            cost.limit
        ),
        format!(
            "additions {} a pixel, tallied on {} of {} lines; those inside multipliers and \
             dividers included",
            digits(cost.additions_per_pixel),
            cost.operation_lines,
            cost.lines
        ),
        format!(
            "{:<13} {:>9} {:>9} {:>10} {:>9} {:>9} {:>9} {:>8} {:>6}",
            "per pixel",
            "busy",
            "stalled",
            "additions",
            "products",
            "memory",
            "tables",
            "latency",
            "depth"
        ),
    ];
    for unit in &cost.units {
        out.push(format!(
            "{:<13} {:>9} {:>9} {:>10} {:>9} {:>9} {:>9} {:>8} {:>6}",
            unit.name,
            digits(unit.busy_cycles_per_pixel),
            digits(unit.stalled_cycles_per_pixel),
            digits(unit.additions_per_pixel),
            digits(unit.products_per_pixel),
            digits(unit.memory_reads_per_pixel),
            digits(unit.table_reads_per_pixel),
            unit.latency_cycles,
            unit.depth
        ));
    }
    out.join("\n")
}
