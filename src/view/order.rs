//! What the window wants to have drawn.

use std::sync::Arc;

use super::pane::Pane;
use crate::scene::Scene;
use crate::sink::picture::errors::ErrorView;

/// What is to be drawn.
#[derive(Clone, Debug)]
pub struct Order {
    /// The scene; its first screen is drawn, of at most [`MAX_PIXELS`]. As long as it is the same one
    /// in memory, nothing of it has changed.
    pub scene: Arc<Scene>,
    /// Every unit is fitted, as with `--full`.
    pub full: bool,
    /// Left and, where there is a split, right.
    pub panes: Vec<Pane>,
    /// Pixels at the bright end of pictures of errors; `None`: as what is drawn needs.
    pub error_high: Option<f64>,
    /// Lines as they are granted; otherwise whole frames.
    pub by_lines: bool,
}

/// Pixels of a raster that can be shown: their values take about 90 bytes each.
pub const MAX_PIXELS: usize = 1 << 24;

impl Order {
    /// How a pane shows errors.
    #[must_use]
    pub fn errors(&self, pane: usize) -> ErrorView {
        ErrorView { part: self.panes[pane].errors(), high: self.error_high }
    }

    /// Whether it asks for the same frame as another, whatever is shown of it.
    #[must_use]
    pub fn is_view_of(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene) && self.full == other.full
    }

    /// Columns and lines of the screen.
    #[must_use]
    pub fn raster(&self) -> (usize, usize) {
        let screen = &self.scene.screens[0];
        (screen.columns as usize, screen.lines as usize)
    }
}
