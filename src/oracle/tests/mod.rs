//! Small scenes made by hand, and an independent surface to compare with.

mod camera;
mod crossing;
mod kernel;
mod outcome;
mod plane;
mod surface;

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::Oracle;
use crate::scene::{
    Attitude, Camera, Colors, Deformation, Extent, HeightMap, Kernel, KernelShape, Outside, Scene,
    Screen, Surface, Terrain,
};

/// Every shape.
pub(super) const SHAPES: [KernelShape; 4] =
    [KernelShape::Cosine, KernelShape::Parabola, KernelShape::Exponential, KernelShape::Hat];

/// Every shape under every deformation.
pub(super) fn kernels() -> Vec<Kernel> {
    let deformations = [
        Deformation::None,
        Deformation::Stretch,
        Deformation::TowardHat { weight_shift: 0 },
        Deformation::TowardHat { weight_shift: 2 },
        Deformation::TowardHat { weight_shift: 64 },
    ];
    SHAPES
        .iter()
        .flat_map(|&shape| deformations.map(|deformation| kernel(shape, deformation)))
        .collect()
}

pub(super) fn kernel(shape: KernelShape, deformation: Deformation) -> Kernel {
    Kernel { shape, deformation, table: 4096 }
}

/// A generator of numbers in [0, 1), the same ones every time.
pub(super) struct Dice(pub u64);

impl Dice {
    pub(super) fn roll(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(super) fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.roll()
    }
}

/// A map of whole random samples from 0 to 99.
pub(super) fn rough_map(columns: usize, rows: usize, seed: u64) -> HeightMap {
    let mut dice = Dice(seed);
    let samples = (0..columns * rows).map(|_| (dice.roll() * 100.0).floor() as f32).collect();
    HeightMap::new(columns, rows, samples)
}

/// A map with no data at a random share of its nodes.
pub(super) fn with_holes(map: &HeightMap, share: f64, seed: u64) -> HeightMap {
    let mut dice = Dice(seed);
    let samples = map.samples().iter().map(|&s| if dice.roll() < share { f32::NAN } else { s });
    HeightMap::new(map.columns(), map.rows(), samples.collect())
}

pub(super) fn terrain(map: HeightMap, outside: Outside) -> Terrain {
    Terrain {
        source: crate::scene::MapSource::new("test"),
        map: Arc::new(map),
        cell: DVec2::new(1.5, 0.75),
        offset: 50.0,
        scale: 0.03,
        outside,
        base_depth: Some(2.0),
        nodata: crate::scene::NoData::Hole,
    }
}

pub(super) fn scene(surface: Surface, kernel: Kernel, eye: DVec3, forward: DVec3) -> Scene {
    Scene {
        unit_m: 1.0,
        camera: Camera {
            position: eye,
            attitude: Attitude::Directions { forward, up: DVec3::Y },
            ..Camera::default()
        },
        screens: vec![Screen {
            columns: 64,
            lines: 48,
            extent: Extent::FieldOfView(1.0),
            ..Screen::default()
        }],
        kernel,
        color: Colors {
            far: [200, 210, 220],
            side: [90, 70, 50],
            checker: [[240, 240, 240], [40, 40, 40]],
            ..Colors::default()
        },
        ..Scene::of(surface)
    }
}

pub(super) fn oracle(scene: &Scene) -> Oracle {
    Oracle::new(scene, &scene.screens[0])
}

/// The surface by its definition, written out anew: kernels straight from their formulas, weights
/// of all nodes, clamped or wrapped.
pub(super) struct Naive<'a> {
    pub terrain: &'a Terrain,
    pub kernel: Kernel,
}

impl Naive<'_> {
    fn shape(&self, t: f64) -> f64 {
        let t = t.abs();
        if t >= 1.0 {
            return 0.0;
        }
        let near = t < 0.5;
        match self.kernel.shape {
            KernelShape::Cosine => 0.5 * (1.0 + (std::f64::consts::PI * t).cos()),
            KernelShape::Parabola if near => 1.0 - 2.0 * t * t,
            KernelShape::Parabola => 2.0 * (1.0 - t).powi(2),
            KernelShape::Exponential if near => 2f64.powf(-(2.0 * t).powi(2)),
            KernelShape::Exponential => 1.0 - 2f64.powf(-(2.0 - 2.0 * t).powi(2)),
            KernelShape::Hat => 1.0 - t,
        }
    }

    fn node(&self, i: i64, j: i64) -> f64 {
        let t = self.terrain;
        let (columns, rows) = (t.map.columns() as i64, t.map.rows() as i64);
        let (i, j) = if t.outside == Outside::Wrap {
            (((i % columns) + columns) % columns, ((j % rows) + rows) % rows)
        } else {
            (i.max(0).min(columns - 1), j.max(0).min(rows - 1))
        };
        t.node(i as usize, j as usize)
    }

    /// (node, weight) pairs along one axis.
    fn weights(&self, x: f64) -> Vec<(i64, f64)> {
        match self.kernel.deformation {
            Deformation::None => {
                let i = x.floor() as i64;
                [i, i + 1].map(|n| (n, self.shape(x - n as f64))).to_vec()
            }
            Deformation::TowardHat { weight_shift } => {
                let i = x.floor() as i64;
                let a = 2f64.powf(-f64::from(weight_shift));
                [i, i + 1]
                    .map(|n| {
                        let t = x - n as f64;
                        let hat = (1.0 - t.abs()).max(0.0);
                        (n, (1.0 - a) * hat + a * self.shape(t))
                    })
                    .to_vec()
            }
            Deformation::Stretch => {
                let i = (x + 0.5).floor() as i64;
                // Scaled so that neighbouring patches meet half-way.
                let alpha = 0.75 / self.shape(1.0 / 3.0);
                let g = |t: f64| alpha * 2.0 / 3.0 * self.shape(2.0 / 3.0 * t);
                let (before, after) = (g(x - (i - 1) as f64), g(x - (i + 1) as f64));
                vec![(i - 1, before), (i, 1.0 - before - after), (i + 1, after)]
            }
        }
    }

    /// y at (x, z), scene units; NaN in a hole. The caller stays in the domain.
    pub(super) fn height(&self, x: f64, z: f64) -> f64 {
        let (wx, wz) =
            (self.weights(x / self.terrain.cell.x), self.weights(z / self.terrain.cell.y));
        wx.iter().map(|(i, a)| wz.iter().map(|(j, b)| a * b * self.node(*i, *j)).sum::<f64>()).sum()
    }

    /// Whether (x, z) lies over the map and not in a hole: a node without data makes the weighted
    /// sum NaN, whatever its weight.
    pub(super) fn is_over(&self, x: f64, z: f64) -> bool {
        let t = self.terrain;
        let (a, b) = (x / t.cell.x, z / t.cell.y);
        (t.outside != Outside::Sky
            || (a >= 0.0
                && b >= 0.0
                && a < (t.map.columns() - 1) as f64
                && b < (t.map.rows() - 1) as f64))
            && !self.height(x, z).is_nan()
    }
}
