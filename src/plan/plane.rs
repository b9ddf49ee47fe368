//! Projection onto a plane: its axes, and the proof that registers hold its coordinates.

use glam::DVec3;

use super::formats::Formats;
use super::geometry::Geometry;
use super::proof::{Finding, Proof, Refusal, in_pixels};
use super::{LARGEST_PLACE, PlanError, WordClass};
use crate::scene::{FormatRequest, Plane, Registers, WordSize};
use crate::word::Register;

/// Projection onto a plane.
#[derive(Clone, Debug)]
pub struct PlanePlan {
    /// Word size of its stock registers.
    pub words: WordClass,
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

/// The last bit of a position in pixels of the nearest point: at most this in a word size that was
/// asked for or is the last choice, and in formats of the scene's own.
const COARSEST: f64 = 0.5;
/// The same in narrow words that the plan chooses by itself.
const FINE: f64 = 1.0 / 64.0;

impl PlanePlan {
    /// Chooses the word size and proves it, or says what is not proved of the scene's own formats.
    ///
    /// # Errors
    /// If no word size holds the plane, or the one asked for does not.
    pub(super) fn new(
        plane: &Plane,
        geometry: &Geometry,
        asked: WordSize,
        requests: &[(Registers, FormatRequest)],
    ) -> Result<(Self, Finding), PlanError> {
        let of = |words| Self::in_words(plane, geometry, words);
        let stock = |words, coarsest| -> Result<Self, Refusal> {
            let plan = of(words);
            plan.proof(geometry, &Formats::stock(words), coarsest).holds().map(|_| plan)
        };
        if !requests.is_empty() {
            let plan = of(WordClass::of_sweep(asked, || stock(WordClass::NARROW, FINE).is_ok()));
            if plan.places().1 > LARGEST_PLACE {
                return Err(plan.too_far(Register::GroundX).into());
            }
            let formats = Formats { words: plan.words, requests };
            let finding = plan.proof(geometry, &formats, COARSEST).told(&formats);
            return Ok((plan, finding));
        }
        let wide = || stock(WordClass::WIDE, COARSEST);
        let (plan, why) = match asked {
            WordSize::Narrow => {
                (stock(WordClass::NARROW, COARSEST)?, "asked for, and proved".to_owned())
            }
            WordSize::Wide => (wide()?, "asked for".to_owned()),
            WordSize::Auto => match stock(WordClass::NARROW, FINE) {
                Ok(plan) => (plan, "positions and pixels fit".to_owned()),
                Err(refusal) => (wide()?, format!("32 bits are not enough: {}", refusal.reason)),
            },
        };
        Ok((plan, Finding::proved(why)))
    }

    fn in_words(plane: &Plane, geometry: &Geometry, words: WordClass) -> Self {
        let axes = plane_axes(plane.normal);
        Self {
            words,
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

    fn proof(&self, geometry: &Geometry, formats: &Formats<'_>, coarsest: f64) -> Proof {
        use Register as R;
        let ground = [R::GroundX, R::GroundZ];
        let (shortest, limit) = formats.shortest(&ground);
        let place = self.places().1;
        let mut facts = format!("positions reach {place:.0} of {limit:.0} squares");
        let mut refusals = Vec::new();
        if place > limit {
            let mut refusal = self.too_far(shortest);
            // A short register may be to blame, and not the eye.
            if !formats.requests.is_empty() {
                refusal.reason =
                    format!("positions reach {place:.0} squares, the registers hold {limit:.0}");
            }
            refusals.push(refusal);
        }
        refusals.extend(formats.view_refusals(geometry, &[R::ViewX, R::ViewZ, R::Denominator]));
        if self.numerator != 0.0 {
            let register = formats.coarsest(&ground);
            // The nearest point of the plane is |F| away: a pixel is at least so large there.
            let pixel = self.numerator.abs() * geometry.finest_angle / self.checker;
            let ulp = formats.fixed(register).ulp();
            facts += &format!(", their last bit is {}", in_pixels(pixel / ulp));
            if ulp > pixel * coarsest {
                refusals.push(Refusal {
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
        Proof { facts, refusals }
    }
}

/// In-plane axes (equation 11): along n × z (n × x where n is nearly z), and across it; x and z
/// for a floor.
pub(crate) fn plane_axes(normal: DVec3) -> [DVec3; 2] {
    let across = if normal.z.abs() < 0.9 { DVec3::Z } else { DVec3::X };
    let first = normal.cross(across).normalize();
    [first, first.cross(normal)]
}
