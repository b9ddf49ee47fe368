//! The ray stepper, a packet of rays at a time: the same first sample under the surface as
//! `unit::stepper`.
//!
//! A ray visits the blocks of the map that its samples lie in, coarse ones where it is high, finer
//! ones near the ground. The last sample in a block is known from the block's far side and the
//! reciprocal of the step, rounded so that it never lies beyond. If first and last sample are at or
//! above the block's highest node, no sample between them hits (samples of a ray lie on a line, the
//! surface stays within its nodes), and the ray goes on with the first sample after it. In a single
//! cell that is not passed so, `solve` finds the first sample under the surface.

use fearless_simd::prelude::*;
use fearless_simd::u32x16;

use super::land::Land;
use super::map::Map;
use super::maxima::NOTHING;
use super::rays::{COLUMNS, PACKETS, Rays, Tile, any_walks};
use super::words::{Packed, Words};
use super::{beam, refine, shade, solve};
use crate::setup::TerrainUnits;
use crate::unit::Line;
use crate::unit::line::Work;
use crate::word::Lane as _;

/// Runs stepper, interpolator and shader on neighbouring lines: by packets where they have a map,
/// else as the processor does.
#[inline(always)]
pub fn draw<W: Packed, S: Simd>(
    simd: S,
    units: &TerrainUnits<W>,
    map: Option<&Map<W>>,
    lines: &mut [Line<W>],
) {
    let (stepper, surface) = (&units.stepper, &units.interpolator);
    let Some(map) = map else {
        let units = units.units();
        lines.iter_mut().for_each(|line| units.iter().for_each(|unit| unit.run(line)));
        return;
    };
    let land = Land { simd, stepper, surface, map };
    run(&land, lines);
    for line in lines {
        // Work is not counted here: skip tests are the processor's.
        line.work.fill(Work::default());
        shade::run(&land, &units.shader, line);
    }
}

/// Drives `hit`, `ground_x`, `ground_z` and `steps` of neighbouring lines as the stepper does.
#[inline(always)]
fn run<W: Packed, S: Simd>(land: &Land<'_, W, S>, lines: &mut [Line<W>]) {
    let columns = lines.first().map_or(0, Line::len);
    for from in (0..columns).step_by(PACKETS * COLUMNS) {
        let mut tile = [Rays::idle(land.simd); PACKETS];
        for (rays, from) in tile.iter_mut().zip((from..).step_by(COLUMNS)) {
            rays.start(land, lines, from);
        }
        beam::skip(land, &mut tile);
        march(land, &mut tile);
        refine::run(land, &mut tile);
        for (rays, from) in tile.iter().zip((from..).step_by(COLUMNS)) {
            rays.finish(lines, from);
        }
    }
}

/// Takes rays to their first samples under the surface, or out of the map.
#[inline(always)]
fn march<W: Packed, S: Simd>(land: &Land<'_, W, S>, tile: &mut Tile<W, S>) {
    while any_walks(tile) {
        while any_walks(tile) {
            for rays in &mut *tile {
                if rays.walks.any_true() {
                    visit(land, rays);
                }
            }
        }
        solve::run(land, tile);
    }
}

/// One block of every walking ray: passed, or looked at more closely.
#[inline(always)]
fn visit<W: Packed, S: Simd>(land: &Land<'_, W, S>, rays: &mut Rays<W, S>) {
    let (stepper, maxima) = (land.stepper, &land.map.maxima);
    let [x, y, z] = rays.place;
    let [dx, dy, dz] = rays.step;
    let (level, walks) = (rays.level, rays.walks);
    let (addresses, held) = maxima.addresses(level, x.cell(), z.cell());
    let bounds = maxima.bounds(addresses);

    let [inverse_x, inverse_z] = rays.inverse;
    let left = stepper.last - rays.index;
    let more = x.steps_within(dx, level, inverse_x).min(z.steps_within(dz, level, inverse_z));
    let more = more.min(left);
    let end = y.after(dy, more);
    let nothing = !held | bounds.simd_eq(i32::from(NOTHING));
    let clear = nothing | y.lesser(end).coarse(maxima.places()).simd_ge(bounds);
    let passes = walks & clear;
    let stays = walks & !clear;
    rays.more = more;
    rays.advance(passes.select(more + 1, u32x16::simd_from(land.simd, 0)));
    // Beside the map, a ray that falls under its base is over.
    let base = W::Words::splat(land.simd, stepper.base.int());
    let sinks = passes & nothing & rays.falls & end.less(base);
    let stands = stays & level.simd_eq(0);
    rays.near |= stands;
    rays.walks &= !(stands | sinks);
    let finer = stays.select(level.max(1) - 1, level);
    // Coarser blocks are worth a try where a ray comes into another one.
    let moved = (x.cell() ^ rays.place[0].cell()) | (z.cell() ^ rays.place[2].cell());
    let entered = (moved.bitcast::<u32x16<S>>() >> (level + 1)).simd_ne(0);
    rays.level = (passes & entered).select((level + 1).min(maxima.top()), finer);
    rays.end_walks(land);
}
