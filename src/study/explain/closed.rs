//! Closed forms of a pixel's registers, from the oracle.

use glam::DVec3;

use super::quantity::Quantity::{self, Wire as Of};
use crate::oracle::Sighting;
use crate::plan::{SurfacePlan, TerrainPlan};
use crate::scene::Scene;
use crate::setup::coefficients::Coefficients;
use crate::unit::Wire;

/// Closed forms of a pixel's registers.
pub(super) struct Closed<'a> {
    pub scene: &'a Scene,
    pub surface: &'a SurfacePlan,
    pub coefficients: Coefficients,
    pub direction: DVec3,
    pub eye: DVec3,
    pub sighting: Sighting,
}

impl Closed<'_> {
    fn ramp(&self, walk: &TerrainPlan) -> f64 {
        let height = walk.scale.to_register(self.sighting.point.y);
        let segments = (self.scene.color.ramp.len() - 1) as f64;
        if walk.top == 0.0 { 0.0 } else { height / walk.top * segments }
    }

    fn light(&self) -> f64 {
        let light = &self.scene.light;
        let diffuse = self.sighting.normal.dot(light.direction).max(0.0);
        light.ambient + (1.0 - light.ambient) * diffuse
    }

    pub fn value(&self, quantity: Quantity) -> Option<f64> {
        match self.surface {
            SurfacePlan::Terrain(walk) => {
                let view = self.direction / walk.lengths;
                let eye = walk.eye;
                let scale = libm::scalbn(1.0, self.coefficients.view_exponent);
                let lambda = (walk.top - eye.y) / view.y;
                let met = self.sighting.point.is_finite();
                let slope = |at: usize| {
                    let n = self.sighting.normal;
                    met.then(|| n.to_array()[at] / n.y)
                };
                match quantity {
                    Of(Wire::ViewX) => Some(view.x * scale),
                    Of(Wire::ViewY) => Some(view.y * scale),
                    Of(Wire::ViewZ) => Some(view.z * scale),
                    Of(Wire::Denominator) if !walk.from_eye => {
                        let scale = libm::scalbn(1.0, self.coefficients.denominator_exponent);
                        Some(view.y / (walk.top - eye.y) * scale)
                    }
                    Of(Wire::EntryX) => Some(eye.x + lambda * view.x),
                    Of(Wire::EntryZ) => Some(eye.z + lambda * view.z),
                    Of(Wire::GroundX) => met.then(|| self.sighting.point.x / walk.lengths.x),
                    Of(Wire::GroundZ) => met.then(|| self.sighting.point.z / walk.lengths.z),
                    Of(Wire::Surface) => met.then(|| walk.scale.to_register(self.sighting.point.y)),
                    Quantity::RampPlace if met => Some(self.ramp(walk)),
                    Of(Wire::Shade) if met => Some(self.light()),
                    Of(Wire::SlopeX) => slope(0),
                    Of(Wire::SlopeZ) => slope(2),
                    _ => None,
                }
            }
            SurfacePlan::Plane(plane) => {
                let along = |at: usize| plane.axes[at].dot(self.direction) / plane.checker;
                let scale = libm::scalbn(1.0, self.coefficients.view_exponent);
                let g = plane.normal.dot(self.direction);
                let point = |at: usize| {
                    let met = self.sighting.point.is_finite();
                    met.then(|| {
                        plane.axes[at].dot(self.eye + g.recip() * plane.numerator * self.direction)
                            / plane.checker
                    })
                };
                match quantity {
                    Of(Wire::ViewX) => Some(along(0) * scale),
                    Of(Wire::ViewZ) => Some(along(1) * scale),
                    Of(Wire::Denominator) if plane.numerator != 0.0 => {
                        let scale = libm::scalbn(1.0, self.coefficients.denominator_exponent);
                        Some(g / plane.numerator * scale)
                    }
                    Of(Wire::EntryX) => point(0),
                    Of(Wire::EntryZ) => point(1),
                    _ => None,
                }
            }
        }
    }
}
