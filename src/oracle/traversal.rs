//! The traversal of a ray over the patches, which finds every crossing of the surface.
//!
//! Along the ray the gap is `g(λ) = y_ray − y(x, z)`. In one patch the slopes bound its rate and
//! the curvatures bound the change of its rate by K, so that from a gap g > 0 with rate g′ no
//! crossing lies nearer than `g / (greatest possible rate of fall)`, nor nearer than the positive
//! root of `g + g′ δ − K δ²/2 = 0`. The traversal advances by the longer of the two: it cannot jump
//! over a crossing, and near a crossing it converges like Newton's method, from the front.
//! Patches, and blocks of them, whose nodes the ray clears are passed over whole.
//!
//! Patches without data are holes, which a ray passes through. It crosses a side where it leaves
//! a hole under the surface beside it, or leaves the ground into a hole.

use super::camera::Ray;
use super::extrema::Span;
use super::height_field::HeightField;
use super::patch::Patch;

/// Advances in one patch before the traversal gives up and calls the pixel tangent.
const ADVANCES: usize = 400;
/// Bisections of a bracket; more than the bits of a double.
const BISECTIONS: usize = 128;

/// A ray in patch coordinates: cells across, scene units upwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Track {
    start: [f64; 3],
    step: [f64; 3],
}

impl Track {
    /// The track of a ray over a ground.
    #[must_use]
    pub fn new(ground: &HeightField, ray: &Ray) -> Self {
        let cell = ground.terrain().cell;
        let (x, z) = ground.patch_coordinates(ray.eye.x, ray.eye.z);
        Self {
            start: [x, ray.eye.y, z],
            step: [ray.direction.x / cell.x, ray.direction.y, ray.direction.z / cell.y],
        }
    }

    /// (Px, y, Pz) at λ.
    #[must_use]
    pub fn at(&self, lambda: f64) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.start[axis] + lambda * self.step[axis])
    }

    /// Ray height at λ, scene units.
    #[must_use]
    pub fn height(&self, lambda: f64) -> f64 {
        self.start[1] + lambda * self.step[1]
    }

    /// (Px, y, Pz) per λ.
    #[must_use]
    pub fn step(&self) -> [f64; 3] {
        self.step
    }

    /// λ at which axis 0, 1 or 2 reaches a value; infinite or NaN where it never does.
    #[must_use]
    pub fn reaches(&self, axis: usize, value: f64) -> f64 {
        (value - self.start[axis]) / self.step[axis]
    }

    /// λ at which the track leaves a span of patches along an axis.
    fn leaves(&self, axis: usize, span: Span) -> f64 {
        if self.step[axis] > 0.0 {
            self.reaches(axis, span.end as f64)
        } else if self.step[axis] < 0.0 {
            self.reaches(axis, span.first as f64)
        } else {
            f64::INFINITY
        }
    }
}

/// A crossing of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Where on the ray.
    pub lambda: f64,
    /// Indices of the patch in which it lies, x and z.
    pub patch: (i64, i64),
    /// It is a side of a hole that is crossed, not the surface.
    pub side: bool,
}

/// A ray on its way over the ground.
#[derive(Clone, Debug)]
pub struct Traversal<'a> {
    ground: &'a HeightField,
    track: Track,
    lambda: f64,
    end: f64,
    patch: (i64, i64),
    /// The ray is out of the ground.
    above: bool,
    /// It has come into this patch out of a hole.
    from_hole: bool,
    /// Gap below which rounding may hide the sign, scene units.
    tolerance: f64,
    /// The gap has been clearly open since the start or the last crossing.
    open: bool,
    /// The gap has closed below the tolerance and not yet shown a change of sign.
    closing: bool,
    touches: usize,
}

impl<'a> Traversal<'a> {
    /// A traversal from λ `start` to `end`, which must lie in the domain, on the stated side of the
    /// surface: y ≥ surface is above.
    #[must_use]
    pub fn new(ground: &'a HeightField, track: Track, start: f64, end: f64, above: bool) -> Self {
        let [px, y, pz] = track.at(start);
        let (low, high) = ground.range();
        // A few roundings of the heights and of the position, by the slope it is seen through.
        let heights = y.abs().max(low.abs()).max(high.abs()).max(track.start[1].abs());
        let reach = if end.is_finite() { end } else { start };
        let [far_x, _, far_z] = track.at(reach);
        let place = [px, pz, far_x, far_z, track.start[0], track.start[2]]
            .iter()
            .fold(0.0f64, |most, p| most.max(p.abs()));
        Self {
            ground,
            track,
            lambda: start,
            end,
            patch: ground.patch_index(px, pz),
            above,
            from_hole: false,
            tolerance: 8.0 * f64::EPSILON * (heights + place * ground.slope_bound()),
            open: false,
            closing: false,
            touches: 0,
        }
    }

    /// How often the ray came closer to the surface than rounding can tell, without crossing it.
    #[must_use]
    pub fn touches(&self) -> usize {
        self.touches + usize::from(self.closing)
    }

    /// Whether the ray is above the surface where the traversal now is.
    #[must_use]
    pub fn above(&self) -> bool {
        self.above
    }

    /// Go on from a crossing up to another λ.
    #[must_use]
    pub fn until(mut self, end: f64) -> Self {
        self.end = end;
        self
    }

    /// The next crossing, either way, or `None` at the end of the traversal.
    pub fn next_crossing(&mut self) -> Option<Crossing> {
        while self.lambda < self.end && !self.is_clear_for_good() {
            if let Some((x, z)) = self.clear_block() {
                self.leave(x, z);
                continue;
            }
            let axes = self.ground.axes();
            let x = axes.0.patch_span(self.patch.0);
            let z = axes.1.patch_span(self.patch.1);
            let patch = self.ground.patch(self.patch);
            if self.ground.is_holed() && patch.is_hole() {
                if !self.above {
                    return Some(self.come_out());
                }
                self.leave(x, z);
                self.from_hole = true;
                continue;
            }
            if !self.clears(self.exit(x, z), patch.range()) {
                let found = self.cross(&patch, self.exit(x, z));
                if found.is_some() {
                    return found;
                }
            }
            self.leave(x, z);
        }
        None
    }

    /// From the ground into a hole.
    fn come_out(&mut self) -> Crossing {
        self.above = true;
        (self.open, self.closing) = (false, false);
        Crossing { lambda: self.lambda, patch: self.patch, side: true }
    }

    /// Nothing more can be crossed: above everything and rising, or below and falling.
    fn is_clear_for_good(&self) -> bool {
        let (low, high) = self.ground.range();
        let y = self.track.height(self.lambda);
        let rise = self.track.step[1];
        if self.above {
            y >= high && rise >= 0.0
        } else {
            // A ray in the ground may still come out into a hole.
            y < low && rise <= 0.0 && !self.ground.is_holed()
        }
    }

    /// λ at which the traversal leaves a rectangle of patches, or ends.
    fn exit(&self, x: Span, z: Span) -> f64 {
        let exit = self.track.leaves(0, x).min(self.track.leaves(2, z));
        exit.min(self.end).max(self.lambda)
    }

    /// Whether the ray stays on its side of heights between `low` and `high` up to λ `exit`.
    fn clears(&self, exit: f64, (low, high): (f64, f64)) -> bool {
        let (a, b) = (self.track.height(self.lambda), self.track.height(exit));
        if self.above { a.min(b) >= high } else { a.max(b) < low }
    }

    /// The largest block around the present patch that can be passed over.
    fn clear_block(&self) -> Option<(Span, Span)> {
        self.ground
            .blocks(self.patch)
            .filter(|block| self.above || !block.holed)
            .find(|block| self.clears(self.exit(block.x, block.z), block.range))
            .map(|block| (block.x, block.z))
    }

    /// Move to the first patch behind a rectangle of patches.
    fn leave(&mut self, x: Span, z: Span) {
        let (exit_x, exit_z) = (self.track.leaves(0, x), self.track.leaves(2, z));
        let exit = exit_x.min(exit_z);
        self.from_hole = false;
        if exit >= self.end {
            self.lambda = self.end;
            return;
        }
        self.lambda = exit.max(self.lambda);
        let [px, _, pz] = self.track.at(self.lambda);
        // The axis that leaves takes its patch from the border, not from a rounded position.
        let next = |axis: usize, leaving: bool, span: Span, p: f64| {
            if !leaving {
                (p.floor() as i64).clamp(span.first, span.end - 1)
            } else if self.track.step[axis] > 0.0 {
                span.end
            } else {
                span.first - 1
            }
        };
        self.patch = (next(0, exit_x <= exit_z, x, px), next(2, exit_z <= exit_x, z, pz));
    }

    /// Gap and its rate per λ, in a patch.
    fn gap(&self, patch: &Patch, lambda: f64) -> (f64, f64) {
        let [px, y, pz] = self.track.at(lambda);
        let height = patch.height(
            (px - self.patch.0 as f64).clamp(0.0, 1.0),
            (pz - self.patch.1 as f64).clamp(0.0, 1.0),
        );
        let [dx, dy, dz] = self.track.step;
        (y - height.y, dy - (height.dx * dx + height.dz * dz))
    }

    /// The next crossing in the present patch, up to λ `exit`.
    fn cross(&mut self, patch: &Patch, exit: f64) -> Option<Crossing> {
        let [dx, dy, dz] = self.track.step;
        let rates = patch.rates(dx, dz);
        let fall = if self.above { rates.high - dy } else { dy - rates.low };
        let mut before = self.lambda;
        let mut lambda = self.lambda;
        for advance in 0.. {
            let (gap, rate) = self.gap(patch, lambda);
            if (gap < 0.0) == self.above {
                // How deep a crossing at this rate surely goes; less may be a contact from rounding.
                let depth = (rate * rate / (2.0 * rates.bend)).max(gap.abs());
                self.touches += usize::from(depth < self.tolerance);
                let side = advance == 0 && self.from_hole;
                return Some(Crossing { side, ..self.turn(patch, before, lambda) });
            }
            self.watch(gap.abs());
            if lambda >= exit {
                break;
            }
            before = lambda;
            if advance == ADVANCES {
                self.touches += 1;
                lambda = exit;
                continue;
            }
            let rate = if self.above { rate } else { -rate };
            // A gap lost in rounding is stepped over as if it were the tolerance.
            let step = safe_step(gap.abs().max(self.tolerance), rate, fall, rates.bend);
            lambda = (lambda + step.max(4.0 * f64::EPSILON * lambda)).min(exit);
        }
        None
    }

    /// Keep count of contacts without a change of sign.
    fn watch(&mut self, gap: f64) {
        if gap < self.tolerance {
            self.closing = self.open;
        } else {
            self.touches += usize::from(self.closing);
            self.closing = false;
            self.open = true;
        }
    }

    /// Narrow a change of sign between two λ and go over to the other side.
    fn turn(&mut self, patch: &Patch, mut before: f64, mut behind: f64) -> Crossing {
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (before + behind);
            if middle <= before || middle >= behind {
                break;
            }
            if (self.gap(patch, middle).0 < 0.0) == self.above {
                behind = middle;
            } else {
                before = middle;
            }
        }
        self.lambda = behind;
        self.above = !self.above;
        self.open = false;
        self.closing = false;
        Crossing { lambda: 0.5 * (before + behind), patch: self.patch, side: false }
    }
}

/// A length in λ that surely holds no crossing, from a gap > 0 that changes by `rate`, falls by
/// `fall` at most and whose rate changes by `bend` at most, all per λ.
fn safe_step(gap: f64, rate: f64, fall: f64, bend: f64) -> f64 {
    let straight = if fall > 0.0 { gap / fall } else { f64::INFINITY };
    let root = (rate * rate + 2.0 * bend * gap).sqrt();
    // Two forms of the same root, neither of which subtracts like from like.
    let curved = if rate < 0.0 {
        2.0 * gap / (root - rate)
    } else if bend > 0.0 {
        (rate + root) / bend
    } else {
        f64::INFINITY
    };
    straight.max(curved)
}
