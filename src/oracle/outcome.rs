//! What a ray meets on a terrain: surface, side of the map, sky, or nothing within reach.
//!
//! The solid is the set of points over the domain of the map, but for its holes, with
//! y < surface(x, z).

use super::camera::Ray;
use super::height_field::HeightField;
use super::traversal::{Track, Traversal};
use crate::frame::Hit;
use crate::scene::Outside;

/// The end of a ray.
#[derive(Clone, Debug)]
pub struct Outcome<'a> {
    /// What was met.
    pub hit: Hit,
    /// Where; NaN on a miss.
    pub lambda: f64,
    /// The patch that was met.
    pub patch: (i64, i64),
    /// The ray came closer to the surface than rounding can tell.
    pub tangent: bool,
    /// The traversal, behind the hit and below the surface; `None` on a miss.
    pub behind: Option<Traversal<'a>>,
}

impl Outcome<'_> {
    fn miss(hit: Hit, tangent: bool) -> Self {
        Self { hit, lambda: f64::NAN, patch: (0, 0), tangent, behind: None }
    }

    /// Whether the hit of the ray and its point at another λ lie on one sheet of the surface: no
    /// crossing lies between them other than the hit itself. A point somewhat behind the surface,
    /// but not through to the other side of the ground, is on the same sheet.
    #[must_use]
    pub fn is_same_sheet(&self, ground: &HeightField, ray: &Ray, other: f64) -> bool {
        let Some(traversal) = &self.behind else {
            return false;
        };
        if !other.is_finite() || other < 0.0 {
            return false;
        }
        if other <= self.lambda {
            // Nothing is crossed before the first hit; a contact would be taken for a crossing.
            return !self.tangent;
        }
        match over_domain(ground, &Track::new(ground, ray), self.lambda, other) {
            Some((_, end)) if end >= other => {
                let mut traversal = traversal.clone().until(other);
                traversal.next_crossing().is_none() && traversal.touches() == 0
            }
            _ => false,
        }
    }
}

/// The first entry of a ray into the solid for λ > 0. On a map that goes on for ever the traversal ends
/// `reach_cells` from the eye, along the axis on which the ray moves most.
///
/// An eye under the ground meets the surface at λ = 0.
#[must_use]
pub fn first_entry<'a>(ground: &'a HeightField, ray: &Ray, reach_cells: f64) -> Outcome<'a> {
    let track = Track::new(ground, ray);
    let (low, high) = ground.range();
    let rise = track.step()[1];
    let ends = ground.terrain().outside == Outside::Sky;

    let reach = if ends { f64::INFINITY } else { reach_lambda(&track, reach_cells) };
    let Some((from, to)) = over_domain(ground, &track, 0.0, reach) else {
        return Outcome::miss(Hit::Sky, false);
    };

    let (start_x, start_z) = position(&track, from);
    let patch = ground.patch_index(start_x, start_z);
    let y = track.height(from);
    let inside = is_inside(ground, &track, from);
    if (from > 0.0 || !inside) && is_below_base(ground, y, rise) {
        return Outcome::miss(Hit::Sky, false);
    }
    if inside {
        return Outcome {
            hit: if from > 0.0 { Hit::Side } else { Hit::Surface },
            lambda: from,
            patch,
            tangent: false,
            behind: Some(Traversal::new(ground, track, from, to, false)),
        };
    }

    let top = track.reaches(1, high);
    // Past every height that could be crossed, but with room for rounding, and past the base.
    let floor = track.reaches(1, (low - 1.0 - (high - low)).min(ground.base()));
    let (start, end) = if rise < 0.0 {
        (from.max(top), to.min(floor))
    } else if rise > 0.0 {
        (from, to.min(top.max(0.0)))
    } else {
        (from, to)
    };
    let mut tangent = false;
    if start < end && (rise < 0.0 || y < high) {
        let mut traversal = Traversal::new(ground, track, start, end, true);
        let crossing = traversal.next_crossing();
        tangent = traversal.touches() > 0;
        if let Some(crossing) = crossing {
            let hit = if crossing.side { Hit::Side } else { Hit::Surface };
            if crossing.side && is_below_base(ground, track.height(crossing.lambda), rise) {
                return Outcome::miss(Hit::Sky, tangent);
            }
            return Outcome {
                hit,
                lambda: crossing.lambda,
                patch: crossing.patch,
                tangent,
                behind: Some(traversal),
            };
        }
    }
    let rises_clear = if rise > 0.0 { top <= to } else { rise == 0.0 && y >= high };
    let falls_clear = rise < 0.0 && track.reaches(1, ground.base()) <= to;
    let hit = if ends || rises_clear || falls_clear { Hit::Sky } else { Hit::OutOfRange };
    Outcome::miss(hit, tangent)
}

/// Whether a ray out of the ground can meet no side any more: it is below the base and does not
/// rise.
fn is_below_base(ground: &HeightField, y: f64, rise: f64) -> bool {
    rise <= 0.0 && y < ground.base()
}

/// How often a ray goes into the solid or out of it between two λ: crossings of the surface,
/// of the sides of the map, and contacts closer than rounding can tell.
#[must_use]
pub fn count_crossings(ground: &HeightField, ray: &Ray, from: f64, to: f64) -> usize {
    let track = Track::new(ground, ray);
    let Some((start, end)) = over_domain(ground, &track, from, to) else {
        return 0;
    };
    let inside = is_inside(ground, &track, start);
    let mut count = usize::from(inside && start > from);
    let mut traversal = Traversal::new(ground, track, start, end, !inside);
    while traversal.next_crossing().is_some() {
        count += 1;
    }
    count + traversal.touches() + usize::from(!traversal.above() && end < to)
}

/// λ at which a track is `reach_cells` away from the eye.
fn reach_lambda(track: &Track, reach_cells: f64) -> f64 {
    let [dx, _, dz] = track.step();
    reach_cells / dx.abs().max(dz.abs())
}

/// The part of (from, to) over which a track is over the domain.
fn over_domain(ground: &HeightField, track: &Track, from: f64, to: f64) -> Option<(f64, f64)> {
    let mut part = (from, to);
    for (axis, (low, high)) in [0, 2].into_iter().zip(ground.domain()) {
        let place = track.at(0.0)[axis];
        if track.step()[axis] == 0.0 {
            if place < low || place >= high {
                return None;
            }
            continue;
        }
        let (a, b) = (track.reaches(axis, low), track.reaches(axis, high));
        part = (part.0.max(a.min(b)), part.1.min(a.max(b)));
    }
    (part.0 < part.1).then_some(part)
}

fn position(track: &Track, lambda: f64) -> (f64, f64) {
    let [px, _, pz] = track.at(lambda);
    (px, pz)
}

/// Whether y < surface at λ, where there is one.
fn is_inside(ground: &HeightField, track: &Track, lambda: f64) -> bool {
    let [px, y, pz] = track.at(lambda);
    let patch = ground.patch_index(px, pz);
    let local = |p: f64, index: i64| (p - index as f64).clamp(0.0, 1.0);
    let height = ground.patch(patch).height(local(px, patch.0), local(pz, patch.1));
    // In a hole the height is NaN, and nothing is under it.
    y < height.y
}
