//! Halvings of the last step of every ray that has hit, all rays of a packet at once.

use fearless_simd::prelude::*;
use fearless_simd::{i32x16, mask32x16, u32x16};

use super::heights::{Nodes, heights, nodes};
use super::march::{Land, Rays};
use super::words::{Packed, Words};
use crate::frame::Hit;
use crate::unit::stepper::HalvingRule;
use crate::word::Lane as _;

/// Moves rays that hit from their first sample under the surface to the place of the hit.
#[inline(always)]
pub fn run<W: Packed, S: Simd>(land: &Land<'_, W, S>, rays: &mut Rays<W, S>) {
    if !rays.hits.any_true() {
        return;
    }
    let number = |number: i32| i32x16::simd_from(land.simd, number);
    let hits = rays.hits;
    let (times, most) = halvings(land, rays);
    let times = hits.select(times, u32x16::simd_from(land.simd, 0));
    // Most of these steps lie in one cell, that of the sample.
    let mut known = Known::new(land, rays.place[0].cell(), rays.place[2].cell());
    let step = rays.step;
    // The last place found clear, and the last one found under the surface.
    let ([x, y, z], [dx, dy, dz]) = (rays.place, step);
    let mut clear = [x - dx, y - dy, z - dz];
    let mut met = rays.place;
    let before = Known::new(land, clear[0].cell(), clear[2].cell());
    for halving in 1..=most {
        let [x, y, z] = clear;
        let (x, y, z) = (x + dx.halved(halving), y + dy.halved(halving), z + dz.halved(halving));
        let middle = [x, y, z];
        let (i, j) = (x.cell(), z.cell());
        let (after, first) = (known.holds(i, j), before.holds(i, j));
        if (hits & !(after | first)).any_true() {
            known = Known::new(land, i, j);
        }
        let after = known.holds(i, j);
        let mut nodes = before.nodes;
        for (node, known) in nodes.iter_mut().zip(known.nodes) {
            *node = W::Words::select(after, known, *node);
        }
        let under = y.less(heights(land, &nodes, x, z)) & land.inside(i, j);
        let halves = times.simd_ge(halving);
        for axis in 0..3 {
            clear[axis] = W::Words::select(halves & !under, middle[axis], clear[axis]);
            met[axis] = W::Words::select(halves & under, middle[axis], met[axis]);
        }
    }
    let meets = land.inside(clear[0].cell(), clear[2].cell());
    // The middle of the last interval halves the error for one more addition.
    let mut middle = clear;
    for (middle, step) in middle.iter_mut().zip(step) {
        *middle = *middle + step.halved_each(times + 1);
    }
    let in_between = meets & land.inside(middle[0].cell(), middle[2].cell());
    for axis in 0..3 {
        let place = W::Words::select(in_between, middle[axis], met[axis]);
        rays.place[axis] = W::Words::select(hits, place, rays.place[axis]);
    }
    // As `Stepper::beside`: from beside the map or out of a hole a ray meets the side, down to the
    // base.
    let base = W::Words::splat(land.simd, land.stepper.base.int());
    let still = W::Words::splat(land.simd, W::Int::default());
    let fallen = rays.place[1].less(base) & !still.less(step[1]);
    let beside = fallen.select(number(Hit::Sky as i32), number(Hit::Side as i32));
    rays.outcome = hits.select(meets.select(number(Hit::Surface as i32), beside), rays.outcome);
}

/// Halvings of each ray, and the most of all: `Stepper::halvings_at`.
#[inline(always)]
fn halvings<W: Packed, S: Simd>(land: &Land<'_, W, S>, rays: &Rays<W, S>) -> (u32x16<S>, u32) {
    match land.stepper.halvings {
        HalvingRule::Fixed(times) => (u32x16::simd_from(land.simd, times), times),
        HalvingRule::Footprint { bias, cap } => {
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
