//! What a ray sees of a plane.

use glam::DVec3;

use super::{Look, Seen, Sighting};
use crate::frame::Hit;
use crate::oracle::camera::Ray;
use crate::oracle::plane::{plane_height, plane_lambda};
use crate::oracle::shade;
use crate::scene::Plane;

impl Seen for Plane {
    fn sight_beside(&self, ray: &Ray, look: &Look, others: [f64; 2]) -> (Sighting, [bool; 2]) {
        let Some(lambda) = plane_lambda(self, ray) else {
            return (Sighting::miss(&look.colors, Hit::Sky, false), [false; 2]);
        };
        let point = ray.at(lambda);
        let contrast = shade::plane_contrast(self, ray, look.grain);
        let sighting = Sighting {
            hit: Hit::Surface,
            lambda,
            point,
            normal: self.normal,
            color: shade::plane_color(&look.colors, self, point, contrast),
            surface: 0,
            tangent: false,
        };
        (sighting, others.map(|other| other.is_finite() && other >= 0.0))
    }

    fn crossings(&self, ray: &Ray, from: f64, to: f64) -> usize {
        let lambda = plane_lambda(self, ray);
        usize::from(lambda.is_some_and(|lambda| from < lambda && lambda < to))
    }

    fn height(&self, x: f64, z: f64) -> Option<f64> {
        plane_height(self, x, z)
    }

    fn normal(&self, _: f64, _: f64) -> Option<DVec3> {
        Some(self.normal)
    }
}
