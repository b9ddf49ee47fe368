//! Bisection of the last step of every ray that has hit, all rays of a packet at once.

use fearless_simd::prelude::*;
use fearless_simd::{i32x16, mask32x16, u32x16};

use super::heights::{Nodes, heights, nodes};
use super::land::Land;
use super::rays::{PACKETS, Rays, Tile};
use super::words::{Packed, Words};
use crate::frame::Hit;
use crate::unit::stepper::BisectionRule;
use crate::word::Lane as _;

/// Moves rays that hit from their first sample under the surface to the place of the hit.
#[inline(always)]
pub fn run<W: Packed, S: Simd>(land: &Land<'_, W, S>, tile: &mut Tile<W, S>) {
    let mut searches = [None; PACKETS];
    let mut most = 0;
    for (search, rays) in searches.iter_mut().zip(&*tile) {
        if rays.hits.any_true() {
            let (times, most_here) = bisection_steps(land, rays);
            *search = Some(Refinement::new(land, rays, times));
            most = most_here.max(most);
        }
    }
    for round in 1..=most {
        for (search, rays) in searches.iter_mut().zip(&*tile) {
            if let Some(search) = search {
                search.halve(land, rays, round);
            }
        }
    }
    for (search, rays) in searches.iter().zip(tile) {
        if let Some(search) = search {
            search.end(land, rays);
        }
    }
}

/// The last step of every ray that has hit.
#[derive(Clone, Copy)]
struct Refinement<W: Packed, S: Simd> {
    times: u32x16<S>,
    /// The last place found clear.
    clear: [W::Words<S>; 3],
    /// The last place found under the surface.
    met: [W::Words<S>; 3],
    /// Most of a step lies in two cells: that of the sample before it, and that of the sample.
    before: Known<W, S>,
    known: Known<W, S>,
}

impl<W: Packed, S: Simd> Refinement<W, S> {
    #[inline(always)]
    fn new(land: &Land<'_, W, S>, rays: &Rays<W, S>, times: u32x16<S>) -> Self {
        let times = rays.hits.select(times, u32x16::simd_from(land.simd, 0));
        let ([x, y, z], [dx, dy, dz]) = (rays.place, rays.step);
        let clear = [x - dx, y - dy, z - dz];
        let before = Known::new(land, clear[0].cell(), clear[2].cell());
        let known = Known::new(land, x.cell(), z.cell());
        Self { times, clear, met: rays.place, before, known }
    }

    /// Halves the interval between clear and met once more.
    #[inline(always)]
    fn halve(&mut self, land: &Land<'_, W, S>, rays: &Rays<W, S>, round: u32) {
        let ([x, y, z], [dx, dy, dz]) = (self.clear, rays.step);
        let (x, y, z) = (x + dx.halved(round), y + dy.halved(round), z + dz.halved(round));
        let (i, j) = (x.cell(), z.cell());
        let (after, first) = (self.known.holds(i, j), self.before.holds(i, j));
        if (rays.hits & !(after | first)).any_true() {
            self.known = Known::new(land, i, j);
        }
        let after = self.known.holds(i, j);
        let mut nodes = self.before.nodes;
        for (node, known) in nodes.iter_mut().zip(self.known.nodes) {
            *node = W::Words::select(after, known, *node);
        }
        let under = y.less(heights(land, &nodes, x, z)) & land.inside(i, j);
        let halves = self.times.simd_ge(round);
        for (axis, middle) in [x, y, z].into_iter().enumerate() {
            self.clear[axis] = W::Words::select(halves & !under, middle, self.clear[axis]);
            self.met[axis] = W::Words::select(halves & under, middle, self.met[axis]);
        }
    }

    /// Moves the rays to the middle of the last interval, which halves the error for one more
    /// addition.
    #[inline(always)]
    fn end(&self, land: &Land<'_, W, S>, rays: &mut Rays<W, S>) {
        let number = |number: i32| i32x16::simd_from(land.simd, number);
        let (hits, step) = (rays.hits, rays.step);
        let meets = land.inside(self.clear[0].cell(), self.clear[2].cell());
        let mut middle = self.clear;
        for (middle, step) in middle.iter_mut().zip(step) {
            *middle = *middle + step.halved_each(self.times + 1);
        }
        let in_between = meets & land.inside(middle[0].cell(), middle[2].cell());
        for (place, (middle, met)) in rays.place.iter_mut().zip(middle.into_iter().zip(self.met)) {
            let refined = W::Words::select(in_between, middle, met);
            *place = W::Words::select(hits, refined, *place);
        }
        // As `Stepper::beside`: from beside the map or out of a hole a ray meets the side, down to
        // the base.
        let base = W::Words::splat(land.simd, land.stepper.base.int());
        let still = W::Words::splat(land.simd, W::Int::default());
        let fallen = rays.place[1].less(base) & !still.less(step[1]);
        let beside = fallen.select(number(Hit::Sky as i32), number(Hit::Side as i32));
        rays.outcome = hits.select(meets.select(number(Hit::Surface as i32), beside), rays.outcome);
    }
}

/// Bisection steps of each ray, and the most of all: `Stepper::bisection_steps_at`.
#[inline(always)]
fn bisection_steps<W: Packed, S: Simd>(
    land: &Land<'_, W, S>,
    rays: &Rays<W, S>,
) -> (u32x16<S>, u32) {
    match land.stepper.bisection {
        BisectionRule::Fixed(times) => (u32x16::simd_from(land.simd, times), times),
        BisectionRule::Footprint { bias, cap } => {
            let eye = land.stepper.eye();
            let eye = [eye.x.int(), eye.y.int(), eye.z.int()];
            let mut away = rays.place;
            for (away, eye) in away.iter_mut().zip(eye) {
                *away = *away - W::Words::splat(land.simd, eye);
            }
            let leading = W::Words::leading_one(away);
            let times = (bias - leading).max(0).min(cap as i32);
            let of_hits = rays.hits.select(times, i32x16::simd_from(land.simd, 0)).to_array();
            (times.bitcast(), of_hits.into_iter().fold(0, i32::max) as u32)
        }
    }
}

/// Nodes of a cell per ray.
#[derive(Clone, Copy)]
struct Known<W: Packed, S: Simd> {
    i: i32x16<S>,
    j: i32x16<S>,
    nodes: Nodes<W, S>,
}

impl<W: Packed, S: Simd> Known<W, S> {
    #[inline(always)]
    fn new(land: &Land<'_, W, S>, i: i32x16<S>, j: i32x16<S>) -> Self {
        Self { i, j, nodes: nodes(land, i, j) }
    }

    /// Where these are the cells.
    #[inline(always)]
    fn holds(&self, i: i32x16<S>, j: i32x16<S>) -> mask32x16<S> {
        self.i.simd_eq(i) & self.j.simd_eq(j)
    }
}
