//! `terraline explain`.

use clap::Args;

use super::scene_args::{SceneArgs, parse_pixel};
use super::{Stop, report};
use crate::study::explain::text::text;

/// Walk one pixel from set-up to colour, register by register.
#[derive(Debug, Args)]
#[command(after_help = "Example: terraline explain overview --pixel 400,700")]
pub struct Explain {
    #[command(flatten)]
    scene: SceneArgs,

    /// The pixel: column from the left, line from the top, from 0.
    #[arg(long, value_name = "C,L")]
    pixel: String,

    /// One JSON object on stdout.
    #[arg(long)]
    json: bool,
}

impl Explain {
    pub fn run(&self) -> Result<(), Stop> {
        let planned = self.scene.load()?;
        let (column, line) = parse_pixel(&self.pixel, &planned.plan)?;
        let explanation =
            planned.machine()?.explain(column, line).map_err(|error| planned.refused(&error))?;
        if self.json {
            return report::json("explain", Some(&planned.scene.name), &explanation);
        }
        report::print(&text(&planned.scene.name, planned.world.name(), &explanation));
        Ok(())
    }
}
