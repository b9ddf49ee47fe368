//! `--scene-out`: the scene as it is drawn, with all options in it, as a file to start from.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;

use super::Stop;
use super::outputs::Named;
use super::scene_args::Planned;
use crate::scene::framing;
use crate::sink;

/// Where the scene goes.
#[derive(Debug, Args)]
pub struct SceneOut {
    /// Write the scene with all options in it, or the one that was chosen for a height file.
    #[arg(long, value_name = "OUT.toml")]
    scene_out: Option<PathBuf>,
}

impl SceneOut {
    /// The file to write.
    pub fn named(&self) -> Option<Named<'_>> {
        self.scene_out.as_deref().map(|path| ("--scene-out", path))
    }

    /// What is to be written there.
    ///
    /// Asked for before anything is drawn, so that a refusal leaves nothing behind.
    pub fn text(&self, planned: &Planned) -> Result<Option<String>, Stop> {
        let Some(path) = &self.scene_out else { return Ok(None) };
        let mut scene = planned.scene.clone();
        // The first screen is drawn where none is named.
        let drawn = scene.screens.iter().position(|screen| screen.name == planned.plan.screen.name);
        scene.screens[..=drawn.unwrap_or_default()].rotate_right(1);
        Ok(Some(match &planned.framing {
            Some(framing) => framing.file(&scene, path)?,
            None => {
                let folder = Path::new(&planned.named).parent().unwrap_or(Path::new(""));
                framing::file(&scene, folder, path)?
            }
        }))
    }

    /// Writes the text, if there is one.
    pub fn write(&self, text: Option<&str>) -> Result<(), Stop> {
        if let (Some(path), Some(text)) = (&self.scene_out, text) {
            sink::write_atomically(path, |file| file.write_all(text.as_bytes()))?;
        }
        Ok(())
    }
}
