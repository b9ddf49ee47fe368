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
pub mod height_field;
pub mod kernel;
pub mod outcome;
pub mod patch;
pub mod plane;
pub mod shade;
#[cfg(test)]
mod tests;
pub mod traversal;

use glam::{DMat3, DVec3};

use crate::frame::Hit;
use crate::scene::{Colors, Light, Plane, Scene, Screen, Surface};
use camera::{Ray, View};
use height_field::HeightField;

/// How far a ray is followed over a map without end, in cells, unless told otherwise.
pub const REACH_CELLS: f64 = 32_768.0;

/// What one screen of a scene shows, exactly.
#[derive(Clone, Debug)]
pub struct Oracle {
    view: View,
    columns: u32,
    lines: u32,
    seen: Seen,
    light: Light,
    colors: Colors,
    reach_cells: f64,
    /// Larger pixel pitch times the screen's distance: the grain of a plane's contrast.
    grain: f64,
}

/// What the rays meet.
#[derive(Clone, Debug)]
enum Seen {
    Terrain(Box<HeightField>),
    Plane(Plane),
}

/// What a pixel sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting {
    /// What the pixel sees, or why nothing.
    pub hit: Hit,
    /// λ of `r_p = r_h + λ V`; NaN on a miss.
    pub lambda: f64,
    /// Ground point, scene units; y is the height of the surface at (x, z), which for a side of
    /// the map is its rim above the point seen. NaN on a miss.
    pub point: DVec3,
    /// Unit normal of the surface at (x, z); for a plane, the plane's own. NaN on a miss.
    pub normal: DVec3,
    /// sRGB bytes.
    pub color: [u8; 3],
    /// The ray comes closer to the surface somewhere up to its hit than rounding can tell: the
    /// outcome may rightly be another one.
    pub tangent: bool,
}

impl Oracle {
    /// The oracle of one screen of a scene.
    #[must_use]
    pub fn new(scene: &Scene, screen: &Screen) -> Self {
        Self {
            view: View::new(&scene.camera, screen),
            columns: screen.columns,
            lines: screen.lines,
            seen: match &scene.surface {
                Surface::Terrain(terrain) => {
                    Seen::Terrain(Box::new(HeightField::new(terrain, scene.kernel)))
                }
                Surface::Plane(plane) => Seen::Plane(plane.clone()),
            },
            light: scene.light,
            colors: scene.color.clone(),
            reach_cells: REACH_CELLS,
            grain: screen.pitch().max_element() * screen.distance(),
        }
    }

    /// Follow rays over a map without end as far as `reach_cells` from the eye, measured along the
    /// axis on which the ray moves most; what lies beyond is [`Hit::OutOfRange`].
    #[must_use]
    pub fn with_reach_cells(mut self, reach_cells: f64) -> Self {
        self.reach_cells = reach_cells;
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

    /// Height of the surface over (x, z), scene units; `None` outside a map that ends, in a hole, and
    /// on an upright plane.
    #[must_use]
    pub fn surface_height(&self, x: f64, z: f64) -> Option<f64> {
        match &self.seen {
            Seen::Terrain(ground) => {
                let index = ground.index_at(x, z)?;
                Some(ground.height_in(index, x, z).y)
            }
            Seen::Plane(plane) => plane::plane_height(plane, x, z),
        }
    }

    /// Unit normal `(−∂y/∂x, 1, −∂y/∂z)` over (x, z); `None` outside a map that ends and in a
    /// hole. A plane has its own normal everywhere.
    #[must_use]
    pub fn surface_normal(&self, x: f64, z: f64) -> Option<DVec3> {
        match &self.seen {
            Seen::Terrain(ground) => {
                let index = ground.index_at(x, z)?;
                Some(ground.normal(ground.height_in(index, x, z)))
            }
            Seen::Plane(plane) => Some(plane.normal),
        }
    }

    /// What is seen at a line and column.
    #[must_use]
    pub fn pixel(&self, line: f64, column: f64) -> Sighting {
        let ray = self.view.ray(line, column);
        match &self.seen {
            Seen::Terrain(ground) => self.sight_terrain(ground, &ray),
            Seen::Plane(plane) => self.sight_plane(plane, &ray),
        }
    }

    /// How often the ray of a pixel goes into the ground or out of it strictly between two λ, in
    /// either order; near contacts count. A plane is crossed at most once.
    #[must_use]
    pub fn crossings(&self, line: f64, column: f64, lambda_from: f64, lambda_to: f64) -> usize {
        let ray = self.view.ray(line, column);
        let (from, to) = (lambda_from.min(lambda_to), lambda_from.max(lambda_to));
        match &self.seen {
            Seen::Terrain(ground) => outcome::count_crossings(ground, &ray, from, to),
            Seen::Plane(plane) => {
                let lambda = plane::plane_lambda(plane, &ray);
                usize::from(lambda.is_some_and(|lambda| from < lambda && lambda < to))
            }
        }
    }

    /// Whether the point at `lambda_other` on the ray of a pixel is on the sheet of the surface
    /// that the pixel sees: both exist and no crossing lies between them other than the one seen.
    #[must_use]
    pub fn same_sheet(&self, line: f64, column: f64, lambda_other: f64) -> bool {
        let ray = self.view.ray(line, column);
        match &self.seen {
            Seen::Terrain(ground) => {
                outcome::is_same_sheet(ground, &ray, self.reach_cells, lambda_other)
            }
            Seen::Plane(plane) => {
                plane::plane_lambda(plane, &ray).is_some()
                    && lambda_other.is_finite()
                    && lambda_other >= 0.0
            }
        }
    }

    fn sight_terrain(&self, ground: &HeightField, ray: &Ray) -> Sighting {
        let outcome = outcome::first_entry(ground, ray, self.reach_cells);
        if outcome.behind.is_none() {
            return self.miss(outcome.hit, outcome.tangent);
        }
        let mut point = ray.at(outcome.lambda);
        let height = ground.height_in(outcome.patch, point.x, point.z);
        point.y = height.y;
        let normal = ground.normal(height);
        let color = shade::outcome_color(&self.colors, outcome.hit).unwrap_or_else(|| {
            shade::terrain_color(&self.colors, &self.light, ground.range(), point.y, normal)
        });
        Sighting {
            hit: outcome.hit,
            lambda: outcome.lambda,
            point,
            normal,
            color,
            tangent: outcome.tangent,
        }
    }

    fn sight_plane(&self, plane: &Plane, ray: &Ray) -> Sighting {
        let Some(lambda) = plane::plane_lambda(plane, ray) else {
            return self.miss(Hit::Sky, false);
        };
        let point = ray.at(lambda);
        Sighting {
            hit: Hit::Surface,
            lambda,
            point,
            normal: plane.normal,
            color: shade::plane_color(
                &self.colors,
                plane,
                point,
                shade::plane_contrast(plane, ray, self.grain),
            ),
            tangent: false,
        }
    }

    fn miss(&self, hit: Hit, tangent: bool) -> Sighting {
        Sighting {
            hit,
            lambda: f64::NAN,
            point: DVec3::NAN,
            normal: DVec3::NAN,
            color: shade::outcome_color(&self.colors, hit).unwrap_or(self.colors.sky),
            tangent,
        }
    }
}
