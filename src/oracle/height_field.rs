//! The terrain as a continuous surface y(x, z).

use glam::DVec3;

use super::extrema::{Axis, Block, Extrema};
use super::kernel::Stencil;
use super::patch::{Height, Patch};
use crate::scene::{Kernel, Outside, Terrain};

/// A terrain, its kernel and its bounds.
#[derive(Clone, Debug)]
pub struct HeightField {
    terrain: Terrain,
    stencil: Stencil,
    axes: (Axis, Axis),
    extrema: Extrema,
    range: (f64, f64),
    holed: bool,
}

impl HeightField {
    /// The surface of a terrain under a kernel.
    #[must_use]
    pub fn new(terrain: &Terrain, kernel: Kernel) -> Self {
        let stencil = Stencil::new(kernel);
        let axes = (
            Axis::new(terrain.map.columns(), terrain.outside),
            Axis::new(terrain.map.rows(), terrain.outside),
        );
        Self {
            terrain: terrain.clone(),
            stencil,
            axes,
            extrema: Extrema::new(terrain, stencil, axes),
            range: terrain.range(),
            holed: terrain.map.voids() > 0,
        }
    }

    /// The terrain of the scene.
    #[must_use]
    pub fn terrain(&self) -> &Terrain {
        &self.terrain
    }

    /// Lowest and highest node, scene units.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        self.range
    }

    /// Whether the map has holes.
    #[must_use]
    pub fn is_holed(&self) -> bool {
        self.holed
    }

    /// Height down to which the sides of the map and of its holes are seen by a falling ray, scene
    /// units.
    #[must_use]
    pub fn base(&self) -> f64 {
        self.range.0 - self.terrain.base_depth()
    }

    /// The greatest slope the map could have, scene units per cell.
    #[must_use]
    pub fn slope_bound(&self) -> f64 {
        2.0 * self.stencil.slope_bound() * (self.range.1 - self.range.0)
    }

    /// The axes of the patch grid.
    #[must_use]
    pub fn axes(&self) -> (Axis, Axis) {
        self.axes
    }

    /// Patch coordinates (Px, Pz) of (x, z): cells, counted from the beginning of patch 0.
    #[must_use]
    pub fn patch_coordinates(&self, x: f64, z: f64) -> (f64, f64) {
        let shift = self.stencil.shift();
        let cell = self.terrain.cell;
        (x / cell.x + shift, z / cell.y + shift)
    }

    /// The domain in patch coordinates, one (from, to) per axis, `to` itself outside: the
    /// rectangle of the nodes, or everything where the map goes on.
    #[must_use]
    pub fn domain(&self) -> [(f64, f64); 2] {
        if self.terrain.outside != Outside::Sky {
            return [(f64::NEG_INFINITY, f64::INFINITY); 2];
        }
        let shift = self.stencil.shift();
        [self.terrain.map.columns(), self.terrain.map.rows()]
            .map(|nodes| (shift, shift + (nodes - 1) as f64))
    }

    /// Index of the patch at patch coordinates. Points on the far edge of a map that ends belong
    /// to its last patch.
    #[must_use]
    pub fn patch_index(&self, px: f64, pz: f64) -> (i64, i64) {
        let [x, z] = self.domain();
        let index = |p: f64, (from, to): (f64, f64)| {
            let last = (to.ceil() - 1.0).max(from.floor());
            p.floor().clamp(from.floor(), last) as i64
        };
        (index(px, x), index(pz, z))
    }

    /// The patch with an index.
    #[must_use]
    pub fn patch(&self, (x, z): (i64, i64)) -> Patch {
        let offsets = self.stencil.nodes();
        let columns = offsets.map(|offset| self.axes.0.node(x + offset));
        let rows = offsets.map(|offset| self.axes.1.node(z + offset));
        Patch::new(self.stencil, columns.map(|i| rows.map(|j| self.terrain.node(i, j))))
    }

    /// The blocks around a patch, coarse to fine.
    pub fn blocks(&self, (x, z): (i64, i64)) -> impl Iterator<Item = Block> + '_ {
        self.extrema.blocks(self.axes, x, z)
    }

    /// Height and slopes at (x, z) as patch `index` gives them: on a border two patches meet, and
    /// under deformation 1 they need not agree there.
    #[must_use]
    pub fn height_in(&self, index: (i64, i64), x: f64, z: f64) -> Height {
        let (px, pz) = self.patch_coordinates(x, z);
        self.patch(index)
            .height((px - index.0 as f64).clamp(0.0, 1.0), (pz - index.1 as f64).clamp(0.0, 1.0))
    }

    /// The patch at (x, z), scene units; `None` outside the domain and in a hole.
    #[must_use]
    pub fn index_at(&self, x: f64, z: f64) -> Option<(i64, i64)> {
        let (px, pz) = self.patch_coordinates(x, z);
        let [domain_x, domain_z] = self.domain();
        let holds = |p: f64, (from, to): (f64, f64)| p >= from && p < to;
        if !holds(px, domain_x) || !holds(pz, domain_z) {
            return None;
        }
        let index = self.patch_index(px, pz);
        (!self.holed || !self.patch(index).is_hole()).then_some(index)
    }

    /// Unit normal `(−∂y/∂x, 1, −∂y/∂z)` of a height, by the cell's size.
    #[must_use]
    pub fn normal(&self, height: Height) -> DVec3 {
        let cell = self.terrain.cell;
        DVec3::new(-height.dx / cell.x, 1.0, -height.dz / cell.y).normalize()
    }
}
