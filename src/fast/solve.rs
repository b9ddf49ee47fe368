//! The first sample of a ray under the surface within one cell.
//!
//! Between two samples a and b of one cell, n steps apart, the gap g between ray and surface is
//! within `A(n)·s(1−s) + B` of the straight line from g(a) to g(b), s in 0..1 (equation 33 of
//! docs/mathematics.md). So no sample between them hits if g(a) and g(b) are at least
//! `A(n)/4 + B`, or if they are at least B and differ by at least A(n): few samples prove that all
//! others are clear. Where neither holds, the interval is divided.

use super::heights::{Nodes, heights, nodes};
use super::march::{Flags, LANES, Land, Packed, Rays, any, end};
use crate::unit::interpolator::Form;
use crate::word::{Enter as _, Lane, Word as _};

/// Gaps are compared in coarse steps of this many fraction bits at most.
const GAP_BITS: u32 = 20;

/// No sample.
const NONE: u32 = u32::MAX;

/// A ray has at most so many samples in a cell: reciprocals end there.
const MOST_STEPS: u32 = 1 << 6;

/// Lanes that stand in a cell walk on behind it, or hit.
#[inline(always)]
pub fn run<W: Packed>(land: &Land<'_, W>, rays: &mut Rays<W>) {
    let places = <W::Height as Lane>::FRACTION.saturating_sub(GAP_BITS);
    let nodes = nodes(land.surface, &rays.x, &rays.z);
    let (bend, error) = slack(land, rays, &nodes, places);
    // Over 3×3 nodes the surface is no patch of this kind: every sample is tested.
    let every = land.surface.form == Form::Stretch;

    // The first sample known to be under the surface.
    let mut under = [NONE; LANES];
    // The last sample up to which all are clear.
    let mut low = [0; LANES];
    let mut gap_low = gaps(land, rays, &nodes, &low, places);
    let mut active: Flags = rays.near;
    let mut hits: Flags = [0; LANES];
    for lane in 0..LANES {
        hits[lane] = active[lane] & u32::from(gap_low[lane] < 0);
        under[lane] = if hits[lane] == 1 { 0 } else { NONE };
        active[lane] &= (hits[lane] ^ 1) & u32::from(rays.more[lane] > 0);
    }
    let mut high = rays.more;
    if every {
        high = [1; LANES];
    }
    let mut gap_under = [0; LANES];
    while any(&active) {
        let gap_high = gaps(land, rays, &nodes, &high, places);
        for lane in 0..LANES {
            let (from, to) = (gap_low[lane], gap_high[lane]);
            let steps = high[lane].wrapping_sub(low[lane]);
            let least = from.min(to);
            let bow = bow(bend[lane], steps);
            let adjacent = u32::from(steps == 1);
            let far = u32::from(least >= (bow >> 2).saturating_add(error[lane]));
            let steep = u32::from(least >= error[lane]) & u32::from(from.abs_diff(to) >= bow as u32);
            let clear = u32::from(to >= 0) & (adjacent | far | steep);
            let is_under = active[lane] & u32::from(to < 0);
            under[lane] = if is_under == 1 { high[lane] } else { under[lane] };
            gap_under[lane] = if is_under == 1 { to } else { gap_under[lane] };
            low[lane] = if clear == 1 { high[lane] } else { low[lane] };
            gap_low[lane] = if clear == 1 { to } else { from };
            let met = active[lane] & u32::from(low[lane] + 1 == under[lane]);
            let passed = active[lane] & u32::from(low[lane] == rays.more[lane]);
            hits[lane] |= met;
            active[lane] &= (met | passed) ^ 1;
            // The next sample: towards the crossing, or to the end; half-way where a clear end did
            // not prove what lies between.
            let crossed = u32::from(under[lane] != NONE);
            let target = if crossed == 1 { under[lane] } else { rays.more[lane] };
            let target = if (clear | is_under) == 0 { high[lane] } else { target };
            let span = target.wrapping_sub(low[lane]).clamp(1, MOST_STEPS);
            let share = if (clear | is_under) == 0 {
                span / 2
            } else if crossed == 1 {
                part(span, gap_low[lane], gap_under[lane])
            } else {
                span
            };
            let limit = if crossed == 1 { span - 1 } else { span };
            let share = if every { 1 } else { share.min(limit).max(1) };
            high[lane] = low[lane] + share;
        }
    }
    for lane in 0..LANES {
        let near = rays.near[lane];
        let steps = if hits[lane] == 1 { under[lane] } else { rays.more[lane] + 1 };
        let steps = steps * near;
        rays.x[lane] = rays.x[lane].after(rays.dx[lane], steps);
        rays.y[lane] = rays.y[lane].after(rays.dy[lane], steps);
        rays.z[lane] = rays.z[lane].after(rays.dz[lane], steps);
        rays.index[lane] += steps;
        rays.hits[lane] |= hits[lane];
        rays.walks[lane] |= near & (hits[lane] ^ 1);
        rays.near[lane] = 0;
    }
    end(land.stepper, rays);
}

/// Gaps between rays and surface, so many samples on.
#[inline(always)]
fn gaps<W: Packed>(
    land: &Land<'_, W>,
    rays: &Rays<W>,
    nodes: &Nodes<W>,
    on: &[u32; LANES],
    places: u32,
) -> [i32; LANES] {
    let (mut x, mut y, mut z) = (rays.x, rays.y, rays.z);
    for lane in 0..LANES {
        x[lane] = x[lane].after(rays.dx[lane], on[lane]);
        y[lane] = y[lane].after(rays.dy[lane], on[lane]);
        z[lane] = z[lane].after(rays.dz[lane], on[lane]);
    }
    let surface = heights(land.surface, nodes, &x, &z);
    let mut gaps = [0; LANES];
    for lane in 0..LANES {
        gaps[lane] = (y[lane] - surface[lane]).coarse(places);
    }
    gaps
}

/// Per lane, A of one step and B, in coarse steps of height (equation 33).
#[inline(always)]
fn slack<W: Packed>(
    land: &Land<'_, W>,
    rays: &Rays<W>,
    nodes: &Nodes<W>,
    places: u32,
) -> ([i32; LANES], [i32; LANES]) {
    // Longest steps of the packet, 16 fraction bits, rounded up.
    let [x, z] = rays.longest.map(|step| {
        1 + step.coarse(<W::Ground as Lane>::FRACTION - 16).unsigned_abs()
    });
    let [x, z] = [u64::from(x), u64::from(z)];
    let straight = land.maxima.bend();
    let twist = (x * z * straight.slope_squared >> 24) + 1;
    let bend_x = (x * x * straight.half_curvature >> 24) + 1;
    let bend_z = (z * z * straight.half_curvature >> 24) + 1;
    let (mut bend, mut error) = ([0; LANES], [0; LANES]);
    for lane in 0..LANES {
        let [h1, h2, h3, h4] = [0, 1, 2, 3].map(|at| nodes[at][lane]);
        let rise = |from: W::Height, to: W::Height| 1 + (to - from).magnitude().coarse(places) as u32;
        let rise_x = rise(h1, h3).max(rise(h2, h4));
        let rise_z = rise(h1, h2).max(rise(h3, h4));
        let crossed = rise(h1 - h2, h3 - h4);
        let [rise_x, rise_z, crossed] = [rise_x, rise_z, crossed].map(u64::from);
        let bows = (crossed * twist + rise_x * bend_x + rise_z * bend_z) >> 16;
        bend[lane] = (bows + 1).min(MOST) as i32;
        error[lane] = (((rise_x + rise_z) * straight.error >> 16) + 8).min(MOST) as i32;
    }
    (bend, error)
}

/// Bends and errors are held to this, which no gap reaches.
const MOST: u64 = i32::MAX as u64;

/// A(n) of n steps from that of one.
#[inline(always)]
fn bow(bend: i32, steps: u32) -> i32 {
    let steps = u64::from(steps.min(MOST_STEPS));
    (bend as u64 * (steps * steps)).min(MOST) as i32
}

/// About the share of `span` at which a line from `from` over zero to `to` under it crosses zero.
#[inline(always)]
fn part(span: u32, from: i32, to: i32) -> u32 {
    let mut rest = from as u32 >> 1;
    let whole = rest + (to.unsigned_abs() >> 1) + 1;
    let mut share = 0;
    for _ in 0..PART_BITS {
        rest <<= 1;
        let fits = u32::from(rest >= whole);
        rest -= whole & 0_u32.wrapping_sub(fits);
        share = share << 1 | fits;
    }
    (span * share) >> PART_BITS
}

/// Bits of a share.
const PART_BITS: u32 = 6;
