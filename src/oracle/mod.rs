//! The oracle: every quantity of a pixel in `f64`, in closed form, without recurrences.
//!
//! It shares the scene with the processor and nothing else, so that the two can be compared.
//! Each pixel stands for itself: its ray is computed from its line and column, and the first
//! crossing of the surface is found by a traversal that cannot jump over one (see [`traversal`]).
//!
//! Lines and columns are continuous numbers, whole at the pixel centres.

pub mod camera;
mod draw;
pub mod extrema;
pub mod ground;
pub mod height_field;
pub mod kernel;
pub mod outcome;
pub mod patch;
pub mod plane;
mod seen;
pub mod shade;
#[cfg(test)]
mod tests;
pub mod traversal;

use std::sync::Arc;

use glam::{DMat3, DVec3};

use crate::scene::{Kernel, Scene, Screen, Surface};
use camera::{Ray, View};
use height_field::HeightField;
use seen::{Look, Seen};
pub use seen::Sighting;

/// How far a ray is followed over a map without end, in cells, unless told otherwise.
pub const REACH_CELLS: f64 = 32_768.0;

/// What one screen of a scene shows, exactly.
#[derive(Clone, Debug)]
pub struct Oracle {
    view: View,
    columns: u32,
    lines: u32,
    surfaces: Vec<Arc<dyn Seen>>,
    look: Look,
}

/// A surface of a scene.
fn seen(surface: &Surface, kernel: Kernel) -> Arc<dyn Seen> {
    match surface {
        Surface::Terrain(terrain) => Arc::new(HeightField::new(terrain, kernel)),
        Surface::Plane(plane) => Arc::new(plane.clone()),
    }
}

impl Oracle {
    /// The oracle of one screen of a scene.
    #[must_use]
    pub fn new(scene: &Scene, screen: &Screen) -> Self {
        Self {
            view: View::new(&scene.camera, screen),
            columns: screen.columns,
            lines: screen.lines,
            surfaces: scene.surfaces.iter().map(|surface| seen(surface, scene.kernel)).collect(),
            look: Look {
                light: scene.light,
                colors: scene.color.clone(),
                reach_cells: REACH_CELLS,
                grain: screen.pitch().max_element() * screen.distance(),
            },
        }
    }

    /// Follow rays over a map without end as far as `reach_cells` from the eye, measured along the
    /// axis on which the ray moves most; what lies beyond is
    /// [`OutOfRange`](crate::frame::Hit::OutOfRange).
    #[must_use]
    pub fn with_reach_cells(mut self, reach_cells: f64) -> Self {
        self.look.reach_cells = reach_cells;
        self
    }

    /// Centre of projection `r_h = r_0 + A h`, ground frame, scene units.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.view.eye()
    }

    /// `A A_mount`: columns u, v, w in the ground frame.
    #[must_use]
    pub fn axes(&self) -> DMat3 {
        self.view.axes()
    }

    /// V of a pixel in the ground frame, in the unit of the screen's distance.
    #[must_use]
    pub fn direction(&self, line: f64, column: f64) -> DVec3 {
        self.view.direction(line, column)
    }

    /// The (line, column) at which a ground point is seen; `None` for a point behind the eye.
    #[must_use]
    pub fn project(&self, point: DVec3) -> Option<(f64, f64)> {
        self.view.project(point)
    }

    /// Height of the surface over (x, z), scene units, of several the highest; `None` outside a map
    /// that ends, in a hole, and on an upright plane.
    #[must_use]
    pub fn surface_height(&self, x: f64, z: f64) -> Option<f64> {
        self.surfaces.iter().filter_map(|surface| surface.height(x, z)).reduce(f64::max)
    }

    /// Height of one surface of the scene over (x, z), as [`Oracle::surface_height`].
    #[must_use]
    pub fn height_of(&self, surface: usize, x: f64, z: f64) -> Option<f64> {
        self.surfaces.get(surface)?.height(x, z)
    }

    /// Unit normal `(−∂y/∂x, 1, −∂y/∂z)` over (x, z), of several surfaces that of the highest; `None`
    /// outside a map that ends and in a hole. A plane has its own normal everywhere.
    #[must_use]
    pub fn surface_normal(&self, x: f64, z: f64) -> Option<DVec3> {
        let over = |surface: &Arc<dyn Seen>| {
            let height = surface.height(x, z).unwrap_or(f64::NEG_INFINITY);
            Some((height, surface.normal(x, z)?))
        };
        let higher = |a: (f64, DVec3), b: (f64, DVec3)| if b.0 > a.0 { b } else { a };
        self.surfaces.iter().filter_map(over).reduce(higher).map(|(_, normal)| normal)
    }

    /// What is seen at a line and column: the nearest surface, of equally near ones the first.
    #[must_use]
    pub fn pixel(&self, line: f64, column: f64) -> Sighting {
        self.nearest(&self.view.ray(line, column))
    }

    /// What a ray sees of the nearest surface.
    fn nearest(&self, ray: &Ray) -> Sighting {
        let sight = |(at, surface): (usize, &Arc<dyn Seen>)| Sighting {
            surface: at,
            ..surface.sight(ray, &self.look)
        };
        let nearer = |a: Sighting, b: Sighting| {
            let tangent = a.tangent || b.tangent;
            Sighting { tangent, ..if b.is_before(&a) { b } else { a } }
        };
        let nearest = self.surfaces.iter().enumerate().map(sight).reduce(nearer);
        nearest.unwrap_or_else(|| unreachable!("a scene has a surface"))
    }

    /// How often the ray of a pixel goes into the ground or out of it strictly between two λ, in
    /// either order; near contacts count. A plane is crossed at most once.
    #[must_use]
    pub fn crossings(&self, line: f64, column: f64, lambda_from: f64, lambda_to: f64) -> usize {
        let ray = self.view.ray(line, column);
        let (from, to) = (lambda_from.min(lambda_to), lambda_from.max(lambda_to));
        self.surfaces.iter().map(|surface| surface.crossings(&ray, from, to)).sum()
    }

    /// What is seen at a line and column, and whether points at two other λ of the same ray are on
    /// the sheet of the surface that is seen: both exist and no crossing lies between them other
    /// than the one seen. NaN is on none.
    ///
    /// The ray is followed once for all three.
    #[must_use]
    pub fn pixel_beside(
        &self,
        line: f64,
        column: f64,
        others: [f64; 2],
    ) -> (Sighting, [bool; 2]) {
        let ray = self.view.ray(line, column);
        if let [surface] = &self.surfaces[..] {
            // Nothing can stand before it, so that its own crossings are all that is asked.
            return surface.sight_beside(&ray, &self.look, others);
        }
        let sighting = self.nearest(&ray);
        let own = self.surfaces[sighting.surface].sight_beside(&ray, &self.look, others).1;
        let mut sheets = [false; 2];
        for ((sheet, own), other) in sheets.iter_mut().zip(own).zip(others) {
            let (from, to) = (sighting.lambda.min(other), sighting.lambda.max(other));
            *sheet = own
                && self.surfaces.iter().enumerate().all(|(at, surface)| {
                    at == sighting.surface || surface.crossings(&ray, from, to) == 0
                });
        }
        (sighting, sheets)
    }
}
