//! The vertical exaggeration of a scene: its heights over those of life size.

use super::surface::Surface;
use super::tables::Scene;

impl Scene {
    /// How many times life size the heights of its first height map are drawn, with samples of so many
    /// metres; `None` without a map.
    #[must_use]
    pub fn exaggeration(&self, sample_m: f64) -> Option<f64> {
        Some(self.terrain()?.scale * self.unit_m / sample_m)
    }

    /// Draws the heights of its maps so many times life size; whether it has any.
    pub fn exaggerate(&mut self, times: f64, sample_m: f64) -> bool {
        let scale = times * sample_m / self.unit_m;
        let terrains = self.surfaces.iter_mut().filter_map(Surface::terrain_mut);
        terrains.map(|terrain| terrain.scale = scale).count() > 0
    }
}
