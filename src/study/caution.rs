//! What registers hold, but so coarsely that a picture should not be trusted unseen.

use crate::engine::{FixedWorld, Machine};
use crate::oracle::ground;
use crate::plan::{Plan, SurfacePlan, TerrainPlan};
use crate::scene::{Scene, Terrain};
use crate::study::figures::digits;
use crate::word::Register;

/// Last bits of height that a level of colour should have: with fewer, the rounding of a height shows.
const BITS_A_LEVEL: f64 = 2.0;

/// Pixels that the nearest ground may move by roundings of heights.
const MOVED: f64 = 1.0;

/// Height maps whose relief is only a few last bits of the registers of heights: fewer than two for
/// a level of the colour ramp. A sentence each.
#[must_use]
pub fn coarse_relief(scene: &Scene, plan: &Plan, world: &FixedWorld) -> Vec<String> {
    let segments = scene.color.ramp.windows(2);
    let largest = |pair: &[[u8; 3]]| (0..3).map(|c| pair[0][c].abs_diff(pair[1][c])).max();
    let levels: f64 = segments.filter_map(largest).map(f64::from).sum();
    let relief = |walk: &TerrainPlan| {
        let (register, ulp) = coarsest(world, &[Register::Node, Register::Surface])?;
        let bits = walk.top / ulp;
        (bits > 0.0 && bits < BITS_A_LEVEL * levels).then(|| {
            format!(
                "heights span {} last bits of register {register}, the ramp {levels} levels: colours are up to \
                 {:.0} levels off; enlarge surface.height.scale",
                digits(bits),
                (levels / bits).min(levels).ceil()
            )
        })
    };
    plan.surfaces.iter().filter_map(SurfacePlan::terrain).filter_map(relief).collect()
}

impl Machine<'_> {
    /// What should be known before the picture is trusted, a sentence each: relief of few last bits,
    /// and an eye so near the ground that roundings of heights move what is seen.
    #[must_use]
    pub fn cautions(&self) -> Vec<String> {
        let mut cautions = coarse_relief(self.scene(), self.plan(), &self.world());
        cautions.extend(self.eye_near_ground());
        cautions
    }

    /// A ground seen from `up` above it is `up` away at the nearest, where a height that is off by an
    /// error looks like one that is `error / (up · angle)` pixels aside.
    fn eye_near_ground(&self) -> Option<String> {
        let (scene, plan) = (self.scene(), self.plan());
        let walk = plan.surfaces.iter().find_map(SurfacePlan::terrain)?;
        let eye = plan.geometry.eye;
        let up = eye.y - ground::height(scene, eye)?;
        let (register, ulp) = coarsest(&self.world(), &[Register::RayY, Register::Surface])?;
        let ulp = ulp * walk.scale.unit;
        // A kernel's table is read at the nearest entry: half of one off, at slopes of at most 2.
        let table = match walk.fitted.kernel_rom.fitted {
            true => around(scene.terrain()?, eye.x, eye.z) / f64::from(scene.kernel.table),
            false => 0.0,
        };
        let moved = (ulp + table) / (up.abs() * plan.geometry.finest_angle);
        (moved > MOVED).then(|| {
            let moved = match moved.is_finite() {
                true => format!("{} pixels", digits(moved)),
                false => "without limit".to_owned(),
            };
            format!(
                "the eye is {} m above the ground, {} last bits of register {register}: what its heights \
                 are rounded by moves the nearest ground by up to {moved}; raise camera.position",
                digits(up * scene.unit_m),
                digits(up / ulp)
            )
        })
    }
}

/// Height range of the nodes around a place, scene units; 0 where they have no data.
fn around(terrain: &Terrain, x: f64, z: f64) -> f64 {
    let index = |place: f64, cell: f64, nodes: usize| {
        let first = (place / cell).floor().clamp(0.0, (nodes - 1) as f64) as usize;
        [first, (first + 1).min(nodes - 1)]
    };
    let columns = index(x, terrain.cell.x, terrain.map.columns());
    let rows = index(z, terrain.cell.y, terrain.map.rows());
    let nodes = columns.into_iter().flat_map(|i| rows.map(|j| terrain.node(i, j)));
    let (low, high) = nodes
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    (high - low).max(0.0)
}

/// The register with the largest last bit, and that.
fn coarsest(world: &FixedWorld, registers: &[Register]) -> Option<(Register, f64)> {
    let ulp = |&register: &Register| Some((register, world.fixed(register)?.ulp()));
    registers.iter().filter_map(ulp).reduce(|a, b| if b.1 > a.1 { b } else { a })
}
