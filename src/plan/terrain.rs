//! Where registers can go: the walk over a height map, proved before the first line (equation 32).
//!
//! All lengths here are in cells (x, z) and height units (y).

mod units;

use glam::DVec3;

use super::fitted::UnitFit;
use super::formats::Formats;
use super::geometry::Geometry;
use super::proof::{Proof, Refusal, in_pixels};
use super::planned::{Planned, Projection};
use super::word_class::{LARGEST_PLACE, WordClass};
use crate::scene::{Bisection, Deformation, Outside, Scene, Terrain};
use crate::word::Register;
pub use units::Fitted;

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
pub struct TerrainPlan {
    /// The units that may be left out.
    pub fitted: Fitted,
    /// Whether the surface is made of 3×3 nodes, not 2×2.
    stretch: bool,
    /// How heights are loaded.
    pub scale: HeightScale,
    /// Scene units per cell and height unit: x, y, z.
    pub lengths: DVec3,
    /// The eye in cells and height units.
    pub eye: DVec3,
    /// The highest node, height units above the lowest.
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
    /// Bisection steps at distance one.
    pub bisection_bias: i32,
    /// k: the largest component of a step lies between 2^-k-1 and 2^-k.
    pub fineness: u32,
    needs: Needs,
}

/// What the registers of a walk must hold, whatever their formats.
#[derive(Clone, Debug)]
struct Needs {
    /// Largest magnitude of x and z.
    horizontal: f64,
    /// Largest magnitude of a ray's height.
    vertical: f64,
    /// The height range with three bits to spare, for differences and slopes per cell.
    heights: f64,
    /// Largest factor or slope on cells that are not squares of the height unit.
    steepest: f64,
    /// The largest slope and the bisection steps that it takes, where it takes any.
    cliffs: Option<(f64, i32)>,
    /// The base of the map is to blame for a walk too long.
    base_is_deep: bool,
    /// Steps of the longest walk.
    steps: f64,
}

/// A surface up to so steep takes no bisection steps of its own: the height at the middle of the last
/// interval is a quarter of a pixel off.
const GENTLE: f64 = 16.0;

/// The rounding of a step, in pixels: at most this.
const COARSEST: f64 = 0.5;
/// The same in words that the plan chooses while there are finer ones.
const FINE: f64 = 1.0 / 32.0;

/// Eyes less than this above the highest node start their rays at the eye: the ratio of so thin a
/// slab would have no bits.
const THIN_LAYER: f64 = 1.0 / 256.0;

impl TerrainPlan {
    /// The walk that a word size leads to, proved or not. A scene's own formats do not change it: it
    /// is that of the stock words beside them.
    pub(super) fn new(
        terrain: &Terrain,
        scene: &Scene,
        geometry: &Geometry,
        words: WordClass,
        full: bool,
    ) -> Self {
        let fineness = scene.stepper.fineness;
        let (lowest, highest) = terrain.range();
        let nodes = [terrain.map.columns() as f64, terrain.map.rows() as f64];
        let eye_x = geometry.eye.x / terrain.cell.x;
        let eye_z = geometry.eye.z / terrain.cell.y;

        let mut unit = (terrain.cell.x * terrain.cell.y).sqrt();
        // The height range and its slopes (kernel slopes are at most 2) need room in the height words.
        while (highest - lowest) / unit * 8.0 > words.ground_limit() {
            unit *= 2.0;
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
        let steps = walk * libm::exp2(f64::from(fineness) + 1.0);
        let range = libm::log2(reach).ceil().max(0.0) as u32;
        let quotient = libm::exp2(f64::from(range));
        let eye = eye_x.abs().max(eye_z.abs());
        let extent = match terrain.outside {
            Outside::Sky => nodes[0].max(nodes[1]).max(eye),
            Outside::Clamp | Outside::Wrap => eye + quotient,
        };
        let horizontal = (extent + 2.0 * walk).max(eye + quotient) + 2.0;
        let vertical = start_y.abs().max(base.abs()).max(eye_y.abs()) + 2.0 * walk + 2.0;
        // Step and distance lie along one ray, so their largest components are in the ratio of
        // their lengths: 2^-k · 2^-n <= 2^e · finest_angle / 32 (equation 22).
        let slope = steepest_slope(terrain);
        let steep = libm::log2(slope / GENTLE).ceil().max(0.0) as i32;
        let bisection_bias =
            libm::log2(32.0 / geometry.finest_angle).ceil() as i32 - fineness as i32 + steep;
        Self {
            fitted: Fitted::new(terrain, scene, words, full, from_eye, unit),
            stretch: scene.kernel.deformation == Deformation::Stretch,
            scale,
            lengths,
            eye: DVec3::new(eye_x, eye_y, eye_z),
            top,
            base,
            from_eye,
            last: steps as u32,
            reach,
            range,
            extreme: horizontal.max(vertical),
            bisection_bias,
            fineness,
            needs: Needs {
                horizontal,
                vertical,
                heights: (highest - lowest) / unit * 8.0,
                steepest: ((highest - lowest) * 2.25).max(unit) / terrain.cell.min_element(),
                cliffs: (steep > 0 && scene.stepper.halvings == Bisection::Footprint)
                    .then_some((slope, steep)),
                base_is_deep: deep > reach && -base > eye_y.abs(),
                steps,
            },
        }
    }

    /// How far the rounding of its steps moves a ray on the screen, pixels: at most this in registers
    /// of these formats (equation 36).
    pub fn step_rounding(&self, geometry: &Geometry, formats: &Formats<'_>) -> f64 {
        self.rounding_on(self.lengths, geometry, formats)
    }

    /// The same on cells and height units of these lengths.
    fn rounding_on(&self, lengths: DVec3, geometry: &Geometry, formats: &Formats<'_>) -> f64 {
        let ulp = |register| formats.fixed(register).ulp();
        let ulps = DVec3::new(ulp(Register::GroundX), ulp(Register::RayY), ulp(Register::GroundZ));
        let (largest, exponent) = libm::frexp(largest_view(geometry, lengths));
        // A register may round up to the power of two that its value is just below.
        let coarsest = formats.coarsest(&[Register::ViewX, Register::ViewY, Register::ViewZ]);
        let up = largest + formats.view_drift(geometry, coarsest) >= 1.0;
        let places = exponent + i32::from(up) + self.fineness as i32;
        geometry.pixels_off(lengths * ulps * libm::scalbn(0.5, places))
    }

    /// How far errors of the view registers of up to `drift` move a ray on the screen, pixels
    /// (equation 36).
    pub fn drift_in_pixels(&self, geometry: &Geometry, drift: f64) -> f64 {
        let exponent = libm::frexp(largest_view(geometry, self.lengths)).1;
        geometry.pixels_off(self.lengths * libm::scalbn(drift, exponent))
    }

    fn too_far(&self, reach: &str, (register, limit): (Register, f64)) -> Refusal {
        // Whatever is deepest under the highest node is to blame for a deep walk.
        let (field, remedy) = if self.needs.base_is_deep {
            ("surface.base_depth", "make it smaller")
        } else {
            ("camera.position", "move the eye closer to the map")
        };
        let reason = format!("{reach}, the registers hold {limit:.0}");
        Refusal { field, reason, remedy, register }
    }
}

impl Planned for TerrainPlan {
    /// Places to 2^24, steps below 2^26.
    fn check_counters(&self) -> Result<(), Refusal> {
        if self.extreme > LARGEST_PLACE {
            return Err(self.too_far(&positions(self.extreme), (Register::GroundX, LARGEST_PLACE)));
        }
        if self.needs.steps >= libm::exp2(26.0) {
            return Err(Refusal {
                field: "camera.position",
                reason: format!("a ray would take {:.0} steps, 2^26 are counted", self.needs.steps),
                remedy: "move the eye closer to the map",
                register: Register::GroundX,
            });
        }
        Ok(())
    }

    fn proof(&self, geometry: &Geometry, formats: &Formats<'_>) -> Proof {
        use Register as R;
        let needs = &self.needs;
        let (mut refusals, mut reservations) = (Vec::new(), Vec::new());

        // A direction is one rounding per step away from the view vector's.
        let step = self.step_rounding(geometry, formats);
        if step > FINE {
            let coarse = if step > COARSEST { &mut refusals } else { &mut reservations };
            // On cubes of the same number of pixels the cells would not be to blame.
            let on_cubes = self.rounding_on(DVec3::ONE, geometry, formats);
            let (field, remedy) = if on_cubes > FINE {
                ("screen.fov", "give the screen coarser pixels, or bring it nearer to its axis")
            } else {
                ("surface.cell", "make its sides more alike, or give the screen coarser pixels")
            };
            coarse.push(Refusal {
                field,
                reason: format!("the rounding of a step is {step:.2} pixel, more than 1/32"),
                remedy,
                register: formats.coarsest(&[R::GroundX, R::GroundZ, R::RayY]),
            });
        }
        let view = [R::ViewX, R::ViewY, R::ViewZ, R::Denominator];
        // Rays that start at the eye use no denominator.
        let used = if self.from_eye { &view[..3] } else { &view[..] };
        refusals.extend(formats.view_refusals(geometry, used, |drift| self.drift_in_pixels(geometry, drift)));

        let (node, limit) = formats.shortest(&[R::Node]);
        if needs.heights > limit {
            refusals.push(Refusal {
                field: "format",
                reason: format!(
                    "heights with three bits to spare reach {:.0}, the registers hold {limit:.0}",
                    needs.heights
                ),
                remedy: "give more bits before the point",
                register: node,
            });
        }
        if needs.steepest > limit {
            refusals.push(Refusal {
                field: "surface.height.scale",
                reason: format!(
                    "slopes reach {:.0}, the registers hold {limit:.0}",
                    needs.steepest
                ),
                remedy: "lower it, or enlarge surface.cell",
                register: node,
            });
        }

        let (ground, ray) =
            (formats.shortest(&[R::GroundX, R::GroundZ]), formats.shortest(&[R::RayY]));
        let mut facts = if ground.1 == ray.1 {
            if self.extreme > ground.1 {
                let register = if needs.vertical > needs.horizontal { ray } else { ground };
                refusals.push(self.too_far(&positions(self.extreme), register));
            }
            format!("positions reach {:.0} of {:.0} cells", self.extreme, ground.1)
        } else {
            if needs.horizontal > ground.1 {
                refusals.push(self.too_far(&positions(needs.horizontal), ground));
            }
            if needs.vertical > ray.1 {
                let heights = format!("heights of rays reach {:.0} units", needs.vertical);
                refusals.push(self.too_far(&heights, ray));
            }
            format!(
                "positions reach {:.0} of {:.0} cells, heights of rays {:.0} of {:.0}",
                needs.horizontal, ground.1, needs.vertical, ray.1
            )
        };
        facts += &format!(", a step's rounding is {}", in_pixels(step.recip()));
        if let Some((slope, steps)) = needs.cliffs {
            facts += &format!(", slopes of up to {slope:.0} take {steps} more bisection steps");
        }
        Proof { facts, refusals, reservations }
    }

    fn projection(&self, geometry: &Geometry) -> Projection {
        let view = geometry.view.scaled(self.lengths.recip());
        Projection {
            view,
            // The slab's top: n = y. Rays that start at the eye have no use for it.
            g: view.dot(DVec3::Y),
            f: if self.from_eye { -1.0 } else { self.top - self.eye.y },
            eye: [self.eye.x, self.eye.z],
            range: self.range,
            divides: self.fitted.divider.fitted,
            steps: true,
        }
    }

    fn units(&self, geometry: &Geometry, _: bool) -> Vec<UnitFit> {
        self.unit_fits(geometry)
    }
}

/// Largest component of a view vector on the screen, in cells or height units of these lengths.
fn largest_view(geometry: &Geometry, lengths: DVec3) -> f64 {
    let largest = geometry.corners().map(|view| (view / lengths).abs().max_element());
    largest.into_iter().fold(0.0, f64::max)
}

/// Bound of the surface's slope, height over ground: kernels are at most twice as steep as the line
/// between two nodes.
fn steepest_slope(terrain: &Terrain) -> f64 {
    let [x, z] = terrain.map.rises().map(|rise| 2.0 * f64::from(rise) * terrain.scale.abs());
    (x / terrain.cell.x).hypot(z / terrain.cell.y)
}

fn positions(reach: f64) -> String {
    format!("positions reach {reach:.0} cells")
}
