//! Cycles of the built-in scenes, by the recurrence that the co-simulation found equal to the RTL.

use terraline::engine::{Machine, Memories};
use terraline::plan::Plan;
use terraline::scene;
use terraline::study::error::Sample;

use super::FrameRow;

const SCENES: [&str; 4] = ["plane", "overview", "flight", "valley"];
const RASTERS: [(u32, u32); 3] = [(320, 240), (640, 480), (1024, 1024)];

/// Every scene in every raster.
///
/// # Errors
/// If a scene cannot be planned.
pub fn all() -> Result<Vec<FrameRow>, String> {
    let mut rows = Vec::new();
    for name in SCENES {
        for (columns, lines) in RASTERS {
            rows.push(frame(name, columns, lines)?);
        }
    }
    Ok(rows)
}

fn frame(name: &str, columns: u32, lines: u32) -> Result<FrameRow, String> {
    let sets = [format!("screen.size=[{columns}, {lines}]")];
    let refused = |error: &dyn std::fmt::Display| format!("{name}: {error}");
    let scene = scene::load(Some(name), &sets).map_err(|error| refused(&error))?;
    let plan = Plan::new(&scene, None, false).map_err(|error| refused(&error))?;
    let machine =
        Machine::new(&scene, &plan, &Memories::default()).map_err(|error| refused(&error))?;
    let all = Sample::all(&plan);
    // Operations are not asked for: one line is enough.
    let one = Sample::whole_lines(&plan, 1, scene.seed);
    let cost = machine.cost(&all, &one).map_err(|error| refused(&error))?;
    Ok(FrameRow {
        scene: name.into(),
        words: plan.words.name.into(),
        columns,
        lines,
        cycles: cost.cycles,
    })
}
