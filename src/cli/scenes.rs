//! `terraline scenes`.

use clap::Args;
use serde::Serialize;

use super::{Stop, report};
use crate::scene::builtin::{SCENES, find, unknown};

/// List the built-in scenes, or print one's TOML to start from.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: terraline scenes valley > my.toml && terraline render my.toml -o valley.png"
)]
pub struct Scenes {
    /// A built-in scene: prints its file.
    name: Option<String>,

    /// One JSON object on stdout.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Listing {
    scenes: Vec<Listed>,
}

#[derive(Serialize)]
struct Listed {
    name: &'static str,
    description: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    toml: Option<&'static str>,
}

impl Scenes {
    pub fn run(&self) -> Result<(), Stop> {
        let Some(name) = &self.name else {
            if self.json {
                let scenes = SCENES
                    .iter()
                    .map(|s| Listed { name: s.name, description: s.description, toml: None })
                    .collect();
                return report::json("scenes", None, &Listing { scenes });
            }
            let widest = SCENES.iter().map(|s| s.name.len()).max().unwrap_or(0);
            for scene in &SCENES {
                report::print(&format!("{:widest$}  {}", scene.name, scene.description));
            }
            return Ok(());
        };
        let scene = find(name).ok_or_else(|| unknown(name))?;
        if self.json {
            let listed =
                Listed { name: scene.name, description: scene.description, toml: Some(scene.toml) };
            return report::json("scenes", Some(scene.name), &listed);
        }
        report::print(scene.toml.trim_end());
        Ok(())
    }
}
