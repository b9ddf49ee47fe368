//! What a ray sees of a height map.

use glam::DVec3;

use super::{Look, Seen, Sighting};
use crate::oracle::camera::Ray;
use crate::oracle::height_field::HeightField;
use crate::oracle::{outcome, shade};

impl Seen for HeightField {
    fn sight_beside(&self, ray: &Ray, look: &Look, others: [f64; 2]) -> (Sighting, [bool; 2]) {
        let outcome = outcome::first_entry(self, ray, look.reach_cells);
        let (hit, tangent) = (outcome.hit, outcome.tangent);
        if outcome.behind.is_none() {
            return (Sighting::miss(&look.colors, hit, tangent), [false; 2]);
        }
        let mut point = ray.at(outcome.lambda);
        let height = self.height_in(outcome.patch, point.x, point.z);
        point.y = height.y;
        let normal = HeightField::normal(self, height);
        let color = shade::outcome_color(&look.colors, hit).unwrap_or_else(|| {
            shade::terrain_color(&look.colors, &look.light, self.range(), point.y, normal)
        });
        let sheets = others.map(|other| outcome.is_same_sheet(self, ray, other));
        (Sighting { hit, lambda: outcome.lambda, point, normal, color, surface: 0, tangent }, sheets)
    }

    fn crossings(&self, ray: &Ray, from: f64, to: f64) -> usize {
        outcome::count_crossings(self, ray, from, to)
    }

    fn height(&self, x: f64, z: f64) -> Option<f64> {
        let index = self.index_at(x, z)?;
        Some(self.height_in(index, x, z).y)
    }

    fn normal(&self, x: f64, z: f64) -> Option<DVec3> {
        let index = self.index_at(x, z)?;
        Some(HeightField::normal(self, self.height_in(index, x, z)))
    }
}
