//! The first sample of a ray under the surface within one cell.
//!
//! Between two samples a and b of one cell, n steps apart, the gap g between ray and surface is
//! within `A(n)·s(1−s) + B` of the straight line from g(a) to g(b), s in 0..1 (equation 33 of
//! docs/mathematics.md). So no sample between them hits if g(a) and g(b) are at least
//! `A(n)/4 + B`, or if they are at least B and differ by at least A(n): few samples prove that all
//! others are clear. Where neither holds, the interval is divided.

use fearless_simd::prelude::*;
use fearless_simd::{i32x16, mask32x16, u32x16};

use super::heights::{Nodes, heights, nodes};
use super::land::Land;
use super::rays::{PACKETS, Rays, Tile};
use super::words::{Packed, Words};
use crate::unit::interpolator::Form;

/// Gaps are compared in coarse steps of this many fraction bits at most.
const GAP_BITS: u32 = 20;

/// No sample.
const NONE: u32 = u32::MAX;

/// A ray has at most this many samples in a cell: reciprocals end there.
const MOST_STEPS: u32 = 1 << 6;

/// Rays that stand in a cell walk on behind it, or hit.
#[inline(always)]
pub fn run<W: Packed, S: Simd>(land: &Land<'_, W, S>, tile: &mut Tile<W, S>) {
    let mut searches = [None; PACKETS];
    for (search, rays) in searches.iter_mut().zip(&*tile) {
        if rays.near.any_true() {
            *search = Some(Search::new(land, rays));
        }
    }
    loop {
        let mut any = false;
        for (search, rays) in searches.iter_mut().zip(&*tile) {
            if let Some(search) = search
                && search.active.any_true()
            {
                search.look(land, rays);
                any = true;
            }
        }
        if !any {
            break;
        }
    }
    for (search, rays) in searches.iter().zip(tile) {
        if let Some(search) = search {
            search.end(land, rays);
        }
    }
}

/// The search in one cell per ray.
#[derive(Clone, Copy)]
struct Search<W: Packed, S: Simd> {
    nodes: Nodes<W, S>,
    slack: Slack<S>,
    /// The last sample up to which all are clear, and its gap.
    low: u32x16<S>,
    gap_low: i32x16<S>,
    /// The first sample known to be under the surface, and its gap.
    under: u32x16<S>,
    gap_under: i32x16<S>,
    /// The sample that is looked at next.
    high: u32x16<S>,
    active: mask32x16<S>,
    hits: mask32x16<S>,
}

impl<W: Packed, S: Simd> Search<W, S> {
    #[inline(always)]
    fn new(land: &Land<'_, W, S>, rays: &Rays<W, S>) -> Self {
        let number = |number: u32| u32x16::simd_from(land.simd, number);
        let nodes = nodes(land, rays.place[0].cell(), rays.place[2].cell());
        let slack = Slack::new(land, rays, &nodes);
        let low = number(0);
        let gap_low = gaps(land, rays, &nodes, low);
        let hits = rays.near & gap_low.simd_lt(0);
        let under = hits.select(low, number(NONE));
        let active = rays.near & !hits & rays.more.simd_gt(0);
        let high = if every(land) { number(1) } else { rays.more };
        Self { nodes, slack, low, gap_low, under, gap_under: gap_low, high, active, hits }
    }

    /// Looks at one sample.
    #[inline(always)]
    fn look(&mut self, land: &Land<'_, W, S>, rays: &Rays<W, S>) {
        let Self { low, gap_low, under, gap_under, high, active, .. } = *self;
        let gap_high = gaps(land, rays, &self.nodes, high);
        let dips = active & gap_high.simd_lt(0);
        let clear = active & !dips & self.slack.clears(high - low, gap_low, gap_high);
        let under = dips.select(high, under);
        let gap_under = dips.select(gap_high, gap_under);
        let low = clear.select(high, low);
        let gap_low = clear.select(gap_high, gap_low);
        let met = active & under.simd_eq(low + 1);
        // The next sample: where the ray seems to cross, or the last one; half-way where clear ends
        // did not prove what lies between.
        let crosses = under.simd_ne(NONE);
        let doubtful = !(clear | dips);
        let target = crosses.select(under, rays.more);
        let target = doubtful.select(high, target);
        let span = (target - low).min(MOST_STEPS);
        let share = crosses.select(part(span, gap_low, gap_under), span);
        let share = doubtful.select(span >> 1, share);
        let limit = crosses.select(span - 1, span);
        let one = u32x16::simd_from(land.simd, 1);
        self.high = low + if every(land) { one } else { share.min(limit).max(1) };
        self.hits |= met;
        self.active = active & !(met | low.simd_eq(rays.more));
        (self.low, self.gap_low) = (low, gap_low);
        (self.under, self.gap_under) = (under, gap_under);
    }

    /// Moves the rays on.
    #[inline(always)]
    fn end(&self, land: &Land<'_, W, S>, rays: &mut Rays<W, S>) {
        let none = u32x16::simd_from(land.simd, 0);
        let steps = self.hits.select(self.under, rays.more + 1);
        rays.advance(rays.near.select(steps, none));
        rays.hits |= self.hits;
        rays.walks |= rays.near & !self.hits;
        rays.near = mask32x16::simd_from(land.simd, false);
        rays.end_walks(land);
    }
}

/// Over 3×3 nodes the surface is no patch of this kind: every sample is tested.
#[inline(always)]
fn every<W: Packed, S: Simd>(land: &Land<'_, W, S>) -> bool {
    land.surface.form == Form::Stretch
}

/// Gaps between rays and surface, this many samples on.
#[inline(always)]
fn gaps<W: Packed, S: Simd>(
    land: &Land<'_, W, S>,
    rays: &Rays<W, S>,
    nodes: &Nodes<W, S>,
    on: u32x16<S>,
) -> i32x16<S> {
    let ([x, y, z], [dx, dy, dz]) = (rays.place, rays.step);
    let (x, y, z) = (x.after(dx, on), y.after(dy, on), z.after(dz, on));
    (y - heights(land, nodes, x, z)).coarse(gap_places::<W, S>())
}

/// Bits of a height below a gap's last.
#[inline(always)]
fn gap_places<W: Packed, S: Simd>() -> u32 {
    W::Words::<S>::POINT.saturating_sub(GAP_BITS)
}

/// How far gaps may stray from straight lines, per ray (equation 33), in steps of gaps.
#[derive(Clone, Copy)]
struct Slack<S: Simd> {
    /// A of one step.
    bend: i32x16<S>,
    /// B.
    error: i32x16<S>,
}

/// Magnitude of a difference of heights in steps of gaps, rounded up.
#[inline(always)]
fn rise<W: Packed, S: Simd>(difference: W::Words<S>) -> u32x16<S> {
    difference.coarse_magnitude(gap_places::<W, S>()) + 1
}

/// Held to what a sum of four does not overflow.
#[inline(always)]
fn signed<S: Simd>(bits: u32x16<S>) -> i32x16<S> {
    bits.min(i32::MAX as u32 / 4).bitcast()
}

/// A(1) is held to this; beyond it nothing counts as straight.
const MOST_BEND: i32 = i32::MAX >> (2 * MOST_STEPS.ilog2());

impl<S: Simd> Slack<S> {
    #[inline(always)]
    fn new<W: Packed>(land: &Land<'_, W, S>, rays: &Rays<W, S>, nodes: &Nodes<W, S>) -> Self {
        let [x, z] = rays.longest;
        let straight = land.map.bend;
        let up = |product: u64| ((product >> 24) + 1).min(u64::from(u32::MAX)) as u32;
        let twist = up(x * z * straight.slope_squared);
        let bend_x = up(x * x * straight.half_curvature);
        let bend_z = up(z * z * straight.half_curvature);
        let [h1, h2, h3, h4] = *nodes;
        let rise_x = rise::<W, S>(h1 - h3).max(rise::<W, S>(h2 - h4));
        let rise_z = rise::<W, S>(h1 - h2).max(rise::<W, S>(h3 - h4));
        let crossed = rise::<W, S>((h1 - h2) - (h3 - h4));
        let factor = |factor: u32| u32x16::simd_from(land.simd, factor);
        let (low, high) = crossed.widening_mul(factor(twist));
        let (low_x, high_x) = rise_x.widening_mul(factor(bend_x));
        let (low_z, high_z) = rise_z.widening_mul(factor(bend_z));
        let bend = ((low + low_x + low_z) >> 16).saturating_narrow((high + high_x + high_z) >> 16);
        let (low, high) = (rise_x + rise_z).widening_mul(factor(straight.error));
        let error = (low >> 16).saturating_narrow(high >> 16);
        Self { bend: signed(bend) + 1, error: signed(error) + 8 }
    }

    /// Whether no sample hits between two samples this many steps apart, at and above the surface.
    #[inline(always)]
    fn clears(&self, steps: u32x16<S>, gap_low: i32x16<S>, gap_high: i32x16<S>) -> mask32x16<S> {
        let (least, most) = (gap_low.min(gap_high), gap_low.max(gap_high));
        let steps = steps.bitcast::<i32x16<S>>();
        let bow = self.bend * steps * steps;
        let counts = self.bend.simd_lt(MOST_BEND);
        let far = (least - (bow >> 2)).simd_ge(self.error);
        let steep = least.simd_ge(self.error) & (most - least).simd_ge(bow);
        steps.simd_eq(1) | (counts & (far | steep))
    }
}

/// About the share of `span` at which a line from `from` over zero to `to` under it crosses zero.
#[inline(always)]
fn part<S: Simd>(span: u32x16<S>, from: i32x16<S>, to: i32x16<S>) -> u32x16<S> {
    /// Bits of a share.
    const BITS: u32 = 6;
    let mut rest = from.bitcast::<u32x16<S>>() >> 1;
    let whole = rest + ((-to).bitcast::<u32x16<S>>() >> 1) + 1;
    let (none, one) = (u32x16::simd_from(span.token(), 0), u32x16::simd_from(span.token(), 1));
    let mut share = none;
    for _ in 0..BITS {
        // The difference wraps to a large number where `whole` does not fit.
        let twice = rest << 1;
        rest = twice.min(twice - whole);
        share = (share << 1) + twice.simd_ge(whole).select(one, none);
    }
    (span * share) >> BITS
}
