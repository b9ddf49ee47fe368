//! `terraline scenes`.

use clap::Args;
use serde::Serialize;

use super::{Stop, report};
use crate::scene::builtin::{MAPS, MOST_NODES, SCENES, find, unknown};

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
    maps: Vec<ListedMap>,
}

#[derive(Serialize)]
struct ListedMap {
    name: &'static str,
    description: String,
}

fn maps_description() -> String {
    format!(
        "the height map of the first three scenes; with @N behind its name it has N x N nodes \
         (2 to {MOST_NODES}) over the same ground, with fractal detail"
    )
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
                let maps = vec![ListedMap { name: MAPS[0], description: maps_description() }];
                return report::json("scenes", None, &Listing { scenes, maps });
            }
            let widest = SCENES.iter().map(|s| s.name.len()).max().unwrap_or(0);
            for scene in &SCENES {
                report::print(&format!("{:widest$}  {}", scene.name, scene.description));
            }
            report::print(&format!("\nbuiltin:{}  {}", MAPS[0], maps_description()));
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
