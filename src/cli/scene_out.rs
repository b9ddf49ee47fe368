//! `--scene-out`: the scene that was chosen for a height file, as a file to start from.

use std::io::Write as _;
use std::path::PathBuf;

use clap::Args;

use super::Stop;
use super::outputs::Named;
use super::scene_args::Planned;
use crate::sink;

/// Where the chosen scene goes.
#[derive(Debug, Args)]
pub struct SceneOut {
    /// Write the scene that was chosen for a height file, to start from.
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
        let refused =
            |reason: &str| Err(Stop::BadInput(format!("--scene-out {}: {reason}", path.display())));
        let Some(framing) = &planned.framing else {
            return refused(
                "a scene is written for height files only; copy the scene file, or print a \
                 built-in scene with `terraline scenes NAME`",
            );
        };
        Ok(Some(framing.file(&planned.scene, path)?))
    }

    /// Writes the text, if there is one.
    pub fn write(&self, text: Option<&str>) -> Result<(), Stop> {
        if let (Some(path), Some(text)) = (&self.scene_out, text) {
            sink::write_atomically(path, |file| file.write_all(text.as_bytes()))?;
        }
        Ok(())
    }
}
