//! `terraline plan`.

use clap::Args;
use serde::Serialize;

use super::scene_args::SceneArgs;
use super::{Stop, report};
use crate::plan::SurfacePlan;
use crate::plan::units::UnitPlan;
use crate::study::caution::coarse_relief;

/// Say which units a scene needs, at which widths, and why the others are left out.
#[derive(Debug, Args)]
#[command(
    name = "plan",
    after_help = "Example: terraline plan valley\nExample: terraline plan overview --full"
)]
pub struct PlanCommand {
    #[command(flatten)]
    scene: SceneArgs,

    /// One JSON object on stdout.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Planning {
    world: &'static str,
    words: &'static str,
    words_why: String,
    not_proved: Vec<String>,
    cautions: Vec<String>,
    screen: String,
    columns: u32,
    lines: u32,
    walk: Option<WalkRange>,
    units: Vec<UnitPlan>,
}

#[derive(Serialize)]
struct WalkRange {
    last_index: u32,
    reach_cells: f64,
    extreme_cells: f64,
    height_unit: f64,
    datum: f64,
    from_eye: bool,
}

impl PlanCommand {
    pub fn run(&self) -> Result<(), Stop> {
        let planned = self.scene.load()?;
        let plan = &planned.plan;
        let walk = plan.surfaces.iter().find_map(SurfacePlan::terrain);
        let walk = walk.map(|walk| WalkRange {
            last_index: walk.last,
            reach_cells: walk.reach,
            extreme_cells: walk.extreme,
            height_unit: walk.scale.unit,
            datum: walk.scale.datum,
            from_eye: walk.from_eye,
        });
        let planning = Planning {
            world: planned.world.name(),
            words: plan.words.name,
            words_why: plan.words_why.clone(),
            not_proved: plan.not_proved.clone(),
            cautions: coarse_relief(&planned.scene, plan, &planned.world),
            screen: plan.screen.name.clone(),
            columns: plan.geometry.columns,
            lines: plan.geometry.lines,
            walk,
            units: planned.world.units(plan),
        };
        if self.json {
            return report::json("plan", Some(&planned.scene.name), &planning);
        }
        report::print(&text(&planned.scene.name, &planning));
        Ok(())
    }
}

fn text(scene: &str, planning: &Planning) -> String {
    let mut out = vec![format!(
        "{scene}, screen {}, {}x{}, {} ({})",
        planning.screen, planning.columns, planning.lines, planning.world, planning.words_why
    )];
    out.extend(report::not_proved(&planning.not_proved));
    out.extend(report::cautions(&planning.cautions));
    if let Some(walk) = &planning.walk {
        out.push(format!(
            "rays start {}; last sample {}, reach {:.0} cells; heights in units of {} above {}",
            if walk.from_eye { "at the eye" } else { "at the highest node" },
            walk.last_index,
            walk.reach_cells,
            report::digits(walk.height_unit),
            report::digits(walk.datum)
        ));
    }
    for unit in &planning.units {
        out.push(format!(
            "  {} {:<13} {}",
            if unit.fitted { "fitted  " } else { "left out" },
            unit.name,
            unit.why
        ));
        if !unit.widths.is_empty() {
            let widths: Vec<_> =
                unit.widths.iter().map(|(name, format)| format!("{name} {format}")).collect();
            out.push(format!("{:25}{}", "", widths.join(", ")));
        }
        if let Some(saves) = &unit.saves {
            out.push(format!("{:25}saves {saves}", ""));
        }
    }
    out.join("\n")
}
