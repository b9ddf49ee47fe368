//! Projection onto a plane: its axes, and the proof that registers hold its coordinates.

use glam::DVec3;

use super::fitted::{Fit, UnitFit};
use super::formats::Formats;
use super::geometry::{Geometry, LinearScalar, LinearVector};
use super::proof::{Proof, Refusal, in_pixels};
use super::planned::{Planned, Projection};
use super::word_class::{LARGEST_PLACE, WordClass};
use crate::scene::Plane;
use crate::word::Register;

/// Projection onto a plane.
#[derive(Clone, Debug)]
pub struct PlanePlan {
    /// Unit normal of the plane, ground frame.
    pub normal: DVec3,
    /// Side of a square, scene units.
    pub checker: f64,
    /// In-plane axes of the two coordinates (equation 11).
    pub axes: [DVec3; 2],
    /// The eye along them, in squares.
    pub eye: [f64; 2],
    /// `F = d − n·r_h`, scene units.
    pub numerator: f64,
    /// Quotients lie within ±2^range squares.
    pub range: u32,
}

/// The last bit of a position in pixels of the nearest point: at most this.
const COARSEST: f64 = 0.5;
/// The same in words that the plan chooses while there are finer ones.
const FINE: f64 = 1.0 / 64.0;

impl PlanePlan {
    /// The projection in words of a size, proved or not.
    pub(super) fn new(plane: &Plane, geometry: &Geometry, words: WordClass) -> Self {
        let axes = plane_axes(plane.normal);
        Self {
            normal: plane.normal,
            checker: plane.checker,
            axes,
            eye: axes.map(|axis| axis.dot(geometry.eye) / plane.checker),
            numerator: plane.distance - plane.normal.dot(geometry.eye),
            range: libm::log2(words.ground_limit()) as u32 - 1,
        }
    }

    /// The eye's larger coordinate, and that plus the largest quotient: positions hold both.
    fn places(&self) -> (f64, f64) {
        let farthest = self.eye[0].abs().max(self.eye[1].abs());
        (farthest, farthest + libm::exp2(f64::from(self.range)))
    }

    fn too_far(&self, register: Register) -> Refusal {
        Refusal {
            field: "camera.position",
            reason: format!("the eye is {:.0} squares from the origin", self.places().0),
            remedy: "move it closer, or enlarge surface.checker",
            register,
        }
    }
}

impl Planned for PlanePlan {
    fn check_counters(&self) -> Result<(), Refusal> {
        if self.places().1 > LARGEST_PLACE {
            return Err(self.too_far(Register::GroundX));
        }
        Ok(())
    }

    fn proof(&self, geometry: &Geometry, formats: &Formats<'_>) -> Proof {
        use Register as R;
        let ground = [R::GroundX, R::GroundZ];
        let (shortest, limit) = formats.shortest(&ground);
        let place = self.places().1;
        let mut facts = format!("positions reach {place:.0} of {limit:.0} squares");
        let (mut refusals, mut reservations) = (Vec::new(), Vec::new());
        if place > limit {
            let mut refusal = self.too_far(shortest);
            // A short register may be to blame, and not the eye.
            if !formats.requests.is_empty() {
                refusal.reason =
                    format!("positions reach {place:.0} squares, the registers hold {limit:.0}");
            }
            refusals.push(refusal);
        }
        refusals.extend(formats.view_refusals(
            geometry,
            &[R::ViewX, R::ViewZ, R::Denominator],
            |drift| drift / geometry.finest_angle,
        ));
        if self.numerator != 0.0 {
            let register = formats.coarsest(&ground);
            // The nearest point of the plane is |F| away: a pixel is at least so large there.
            let pixel = self.numerator.abs() * geometry.finest_angle / self.checker;
            let ulp = formats.fixed(register).ulp();
            facts += &format!(", their last bit is {}", in_pixels(pixel / ulp));
            if ulp > pixel * FINE {
                let coarse = if ulp > pixel * COARSEST { &mut refusals } else { &mut reservations };
                coarse.push(Refusal {
                    field: "camera.position",
                    reason: format!(
                        "the eye is {:e} above the plane, where the last bit of a position is \
                         {:.2} pixel",
                        self.numerator.abs(),
                        ulp / pixel
                    ),
                    remedy: "move it away from the plane, or make surface.checker smaller",
                    register,
                });
            }
        }
        Proof { facts, refusals, reservations }
    }

    fn projection(&self, geometry: &Geometry) -> Projection {
        let along = self.axes.map(|axis| geometry.view.dot(axis).scaled(1.0 / self.checker));
        let pack =
            |pick: &dyn Fn(&LinearScalar) -> f64| DVec3::new(pick(&along[0]), 0.0, pick(&along[1]));
        Projection {
            view: LinearVector {
                start: pack(&|s| s.start),
                per_line: pack(&|s| s.per_line),
                per_column: pack(&|s| s.per_column),
            },
            g: geometry.view.dot(self.normal),
            f: self.numerator,
            eye: self.eye,
            range: self.range,
            divides: true,
            steps: false,
        }
    }

    fn units(&self, geometry: &Geometry, full: bool) -> Vec<UnitFit> {
        use Register as R;
        let divider = if self.numerator == 0.0 {
            "the eye lies in the plane, which is seen edge-on: nothing is met"
        } else {
            "plane coordinates are a ratio"
        };
        let without = |(name, saves)| {
            let why = if full {
                "idle, the scene has no height map"
            } else {
                "the scene has no height map"
            };
            UnitFit { name, fit: Fit::where_needed(false, full, why), registers: &[], saves }
        };
        let idle = [
            ("stepper", "all steps of all rays"),
            ("pyramid", "its memory"),
            ("kernel_rom", "its tables"),
            ("interpolator", "five lerps and two slopes per pixel"),
            ("light", "ten products and a table read per pixel"),
        ];
        let checker = UnitFit {
            name: "checker",
            fit: Fit::always(
                "colour of a plane: parity of the square, faded where squares are too small",
            ),
            registers: &[R::Shade, R::Channel],
            saves: "",
        };
        let projection =
            [UnitFit::projector(geometry, false), UnitFit::divider(Fit::always(divider))];
        projection.into_iter().chain(idle.map(without)).chain([checker]).collect()
    }
}

/// In-plane axes (equation 11): along n × z (n × x where n is nearly z), and across it; x and z
/// for a floor.
fn plane_axes(normal: DVec3) -> [DVec3; 2] {
    let across = if normal.z.abs() < 0.9 { DVec3::Z } else { DVec3::X };
    let first = normal.cross(across).normalize();
    [first, first.cross(normal)]
}
