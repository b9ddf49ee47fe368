//! Where registers can go: the walk over a height map, proved before the first line (equation 32).
//!
//! All lengths here are in cells (x, z) and height units (y).

use glam::DVec3;

use super::geometry::Geometry;
use super::{PlanError, WordClass};
use crate::scene::{Outside, Terrain, WordSize};

/// Heights are loaded as `(y − datum) / unit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightScale {
    /// Height of the lowest node, scene units: zero in the registers.
    pub datum: f64,
    /// Scene units per height unit.
    pub unit: f64,
}

impl HeightScale {
    /// Register value of a height.
    pub fn to_register(self, y: f64) -> f64 {
        (y - self.datum) / self.unit
    }

    /// Height of a register value.
    pub fn to_scene(self, value: f64) -> f64 {
        self.datum + value * self.unit
    }
}

/// The walk of a ray over the map.
#[derive(Clone, Debug)]
pub struct WalkPlan {
    /// Word size that holds it.
    pub words: WordClass,
    /// Why that one.
    pub words_why: String,
    /// How heights are loaded.
    pub scale: HeightScale,
    /// Scene units per cell and height unit: x, y, z.
    pub lengths: DVec3,
    /// The eye in cells and height units.
    pub eye: DVec3,
    /// The highest node.
    pub top: f64,
    /// Base of the block under the map.
    pub base: f64,
    /// Rays start at the eye, not at the slab's top.
    pub from_eye: bool,
    /// Index of the last sample.
    pub last: u32,
    /// Farthest horizontal walk in cells.
    pub reach: f64,
    /// Quotients of the divider lie within ±2^range cells.
    pub range: u32,
    /// Largest magnitude a position register takes.
    pub extreme: f64,
    /// Halvings at distance one.
    pub halving_bias: i32,
}

/// Why a word size does not hold a walk.
#[derive(Debug)]
struct Refusal {
    field: &'static str,
    reason: String,
    remedy: &'static str,
}

impl From<Refusal> for PlanError {
    fn from(Refusal { field, reason, remedy }: Refusal) -> Self {
        Self::Range { field, reason, remedy }
    }
}

/// Eyes less than this above the highest node start their rays at the eye: the ratio of so thin a
/// layer would have no bits.
const THIN_LAYER: f64 = 1.0 / 256.0;

impl WalkPlan {
    /// Proves a walk, in the smaller word size that holds it.
    ///
    /// # Errors
    /// If no word size holds it, or the one asked for does not.
    pub fn new(
        terrain: &Terrain,
        geometry: &Geometry,
        fineness: u32,
        asked: WordSize,
    ) -> Result<Self, PlanError> {
        let narrow = Self::in_words(terrain, geometry, fineness, WordClass::NARROW);
        let wide = || Self::in_words(terrain, geometry, fineness, WordClass::WIDE);
        match (asked, narrow) {
            (WordSize::Narrow, Err(refusal)) => Err(PlanError::Range {
                field: "machine.words",
                reason: format!("32-bit words cannot be proved: {}", refusal.reason),
                remedy: "use words = \"auto\"",
            }),
            (WordSize::Narrow, Ok(plan)) => {
                Ok(Self { words_why: "asked for, and proved".into(), ..plan })
            }
            (WordSize::Wide, _) => Ok(Self { words_why: "asked for".into(), ..wide()? }),
            (WordSize::Auto, Ok(plan)) => Ok(plan),
            (WordSize::Auto, Err(refusal)) => {
                Ok(Self { words_why: format!("32 bits do not do: {}", refusal.reason), ..wide()? })
            }
        }
    }

    fn in_words(
        terrain: &Terrain,
        geometry: &Geometry,
        fineness: u32,
        words: WordClass,
    ) -> Result<Self, Refusal> {
        let limit = words.ground_limit();
        let (lowest, highest) = terrain.range();
        let nodes = [terrain.map.columns() as f64, terrain.map.rows() as f64];
        let eye_x = geometry.eye.x / terrain.cell.x;
        let eye_z = geometry.eye.z / terrain.cell.y;

        // A direction is one rounding per step away from the view vector's.
        let direction = libm::exp2(f64::from(fineness) - f64::from(words.ground_point));
        if direction > geometry.finest_angle / 64.0 {
            return Err(Refusal {
                field: "screen.fov",
                reason: format!(
                    "the rounding of a step is {:.2} pixel, more than 1/64",
                    direction / geometry.finest_angle
                ),
                remedy: "give the screen coarser pixels, or bring it nearer to its axis",
            });
        }
        let coefficients = f64::from(geometry.columns) + f64::from(geometry.lines);
        let drift = coefficients * libm::exp2(-1.0 - f64::from(words.view_point));
        if drift > geometry.finest_angle / 128.0 {
            return Err(Refusal {
                field: "screen.size",
                reason: "the roundings of the view coefficients add up to more than 1/128 pixel"
                    .into(),
                remedy: "draw fewer or coarser pixels",
            });
        }

        let mut unit = (terrain.cell.x * terrain.cell.y).sqrt();
        // The relief and its slopes (kernel slopes are at most 2) need room in the height words.
        while (highest - lowest) / unit * 8.0 > limit {
            unit *= 2.0;
        }
        let narrowest = terrain.cell.min_element();
        let steepest = ((highest - lowest) * 2.25).max(unit) / narrowest;
        if steepest > limit {
            return Err(Refusal {
                field: "surface.height.scale",
                reason: format!("slopes reach {steepest:.0}, the registers hold {limit:.0}"),
                remedy: "lower it, or enlarge surface.cell",
            });
        }
        let scale = HeightScale { datum: lowest, unit };
        let lengths = DVec3::new(terrain.cell.x, unit, terrain.cell.y);
        let top = scale.to_register(highest);
        let base = scale.to_register(lowest - terrain.base_depth());
        let eye_y = scale.to_register(geometry.eye.y);
        let from_eye = eye_y - top < THIN_LAYER;
        let start_y = if from_eye { eye_y } else { top };

        let (reach, deep) = match terrain.outside {
            Outside::Sky => {
                // An approaching ray crosses at most from the eye's side to the far edge; one that
                // moves mostly in y is over above the top or under the base.
                let across = |eye: f64, nodes: f64| eye.abs().max((eye - (nodes - 1.0)).abs());
                let reach = across(eye_x, nodes[0]).max(across(eye_z, nodes[1])) + 2.0;
                (reach, (start_y - base).max(top - start_y).max(0.0) + 2.0)
            }
            Outside::Clamp | Outside::Wrap => {
                let reach = (4.0 * nodes[0].max(nodes[1])).clamp(256.0, 4096.0);
                // An eye in a hole may be under the base.
                (reach, (start_y.max(top) - base.min(start_y)).max(0.0) + 2.0)
            }
        };
        let walk = reach.max(deep).ceil();
        // Steps are between 2^-k-1 and 2^-k in their largest component.
        let last = walk * libm::exp2(f64::from(fineness) + 1.0);
        let range = libm::log2(reach).ceil().max(0.0) as u32;
        let quotient = libm::exp2(f64::from(range));
        let extent = match terrain.outside {
            Outside::Sky => nodes[0].max(nodes[1]).max(eye_x.abs()).max(eye_z.abs()),
            Outside::Clamp | Outside::Wrap => eye_x.abs().max(eye_z.abs()) + quotient,
        };
        let extreme = (extent + 2.0 * walk)
            .max(eye_x.abs().max(eye_z.abs()) + quotient)
            .max(start_y.abs().max(base.abs()).max(eye_y.abs()) + 2.0 * walk)
            + 2.0;
        if extreme > limit {
            // Whatever is deepest under the highest node is to blame for a deep walk.
            let (field, remedy) = if deep > reach && -base > eye_y.abs() {
                ("surface.base_depth", "make it smaller")
            } else {
                ("camera.position", "move the eye closer to the map")
            };
            let reason =
                format!("positions reach {extreme:.0} cells, the registers hold {limit:.0}");
            return Err(Refusal { field, reason, remedy });
        }
        if last >= libm::exp2(26.0) {
            return Err(Refusal {
                field: "camera.position",
                reason: format!("a ray would take {last:.0} steps, 2^26 are counted"),
                remedy: "move the eye closer to the map",
            });
        }
        // Step and distance lie along one ray, so their largest components are in the ratio of
        // their lengths: 2^-k · 2^-n <= 2^e · finest_angle / 32 (equation 22).
        let halving_bias = libm::log2(32.0 / geometry.finest_angle).ceil() as i32 - fineness as i32;
        Ok(Self {
            words,
            words_why: format!(
                "positions reach {extreme:.0} of {limit:.0} cells, a step's \
                 rounding is 1/{:.0} pixel",
                geometry.finest_angle / direction
            ),
            scale,
            lengths,
            eye: DVec3::new(eye_x, eye_y, eye_z),
            top,
            base,
            from_eye,
            last: last as u32,
            reach,
            range,
            extreme,
            halving_bias,
        })
    }
}
