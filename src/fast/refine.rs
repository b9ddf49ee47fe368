//! Halvings of the last step of every ray that has hit, all rays of a packet at once.

use fearless_simd::prelude::*;
use fearless_simd::u32x16;

use super::heights::{heights, nodes};
use super::march::{Land, Rays, place};
use super::words::{LANES, Packed, Words};
use crate::frame::Hit;
use crate::word::{Cell as _, Lane as _};

/// Moves rays that hit from their first sample under the surface to the place of the hit.
#[inline(always)]
pub fn run<W: Packed, S: Simd>(land: &Land<'_, W, S>, rays: &mut Rays<W, S>) {
    let (stepper, memory) = (land.stepper, &*land.surface.heights);
    if !rays.hits.any_true() {
        return;
    }
    let [x, y, z] = rays.place.map(Words::store);
    let mut times = [0; LANES];
    for lane in (0..LANES).filter(|&lane| rays.hits.test(lane)) {
        times[lane] = stepper.halvings_at(place(x[lane], y[lane], z[lane]));
    }
    let most = times.iter().fold(0, |most, &t| most.max(t));
    let halvings = u32x16::simd_from(land.simd, times);
    for (place, step) in rays.place.iter_mut().zip(rays.step) {
        *place = *place - step;
    }
    for halving in 1..=most {
        let middle: [_; 3] =
            std::array::from_fn(|axis| rays.place[axis] + rays.step[axis].halved(halving));
        let [x, y, z] = middle;
        let nodes = nodes(land, x.cell(), z.cell());
        let under = y.less(heights(land, &nodes, x, z)) & land.inside(x.cell(), z.cell());
        let moves = halvings.simd_ge(halving) & !under;
        for (place, middle) in rays.place.iter_mut().zip(middle) {
            *place = W::Words::select(moves, middle, *place);
        }
    }
    let [mut x, y, mut z] = rays.place.map(Words::store);
    let [dx, dy, dz] = rays.step.map(Words::store);
    for lane in (0..LANES).filter(|&lane| rays.hits.test(lane)) {
        let clear = place::<W>(x[lane], y[lane], z[lane]);
        let step = place::<W>(dx[lane], dy[lane], dz[lane]);
        let meets = memory.contains(clear.x.cell(), clear.z.cell());
        let place = clear.plus(step.halved(times[lane] + u32::from(meets)));
        rays.outcome[lane] = if meets { Hit::Surface } else { stepper.beside(place, step) };
        (x[lane], z[lane]) = (place.x.int(), place.z.int());
    }
    rays.place[0] = W::Words::load(land.simd, x);
    rays.place[2] = W::Words::load(land.simd, z);
}
