//! What lengths and places of a scene are outside of it: metres, and the coordinates of a height file.

use crate::scene::Scene;
use crate::scene::height_map::{Coordinates, Georeference};

/// Measures of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Measure<'a> {
    scene: &'a Scene,
    file: Option<&'a Georeference>,
}

impl<'a> Measure<'a> {
    /// Of a scene, whose map may come from a file that says where it lies.
    #[must_use]
    pub fn new(scene: &'a Scene, file: Option<&'a Georeference>) -> Self {
        Self { scene, file }
    }

    /// Metres of a difference in height, scene units: without the exaggeration of a height map, whose
    /// samples are metres unless its file says what else they are.
    #[must_use]
    pub fn rise_m(&self, rise: f64) -> f64 {
        match self.scene.terrain() {
            Some(terrain) => rise / terrain.scale * self.sample_m(),
            None => rise * self.scene.unit_m,
        }
    }

    /// Metres of a height, scene units, above the zero of the samples.
    #[must_use]
    pub fn height_m(&self, y: f64) -> f64 {
        let zero = self.scene.terrain().map_or(0.0, |terrain| terrain.offset * self.sample_m());
        self.rise_m(y) + zero
    }

    /// Metres of a level distance, scene units.
    #[must_use]
    pub fn distance_m(&self, distance: f64) -> f64 {
        distance * self.scene.unit_m
    }

    /// Metres per unit of sample.
    #[must_use]
    pub fn sample_m(&self) -> f64 {
        self.file.and_then(|file| file.height_unit_m).unwrap_or(1.0)
    }

    /// The place over (x, z), scene units, in the coordinates of the height file; `None` where it has
    /// none.
    #[must_use]
    pub fn place(&self, x: f64, z: f64) -> Option<String> {
        let (file, terrain) = (self.file?, self.scene.terrain()?);
        let (origin, cell) = (file.origin?, file.cell?);
        // Nodes are counted to the east and to the south.
        let east = origin.x + x / terrain.cell.x * cell.x;
        let north = origin.y - z / terrain.cell.y * cell.y;
        match file.coordinates {
            Coordinates::Degrees => {
                let (ns, ew) = (if north < 0.0 { 'S' } else { 'N' }, if east < 0.0 { 'W' } else { 'E' });
                Some(format!("{:.5}° {ns} {:.5}° {ew}", north.abs(), east.abs()))
            }
            Coordinates::Lengths { .. } => {
                let system = file.epsg.map_or(String::new(), |code| format!("EPSG:{code} "));
                Some(format!("{system}east {east:.1} north {north:.1}"))
            }
            Coordinates::Unknown => None,
        }
    }
}
