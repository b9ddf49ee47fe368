//! Halvings of the last step of every ray that has hit, all lanes at once.

use super::heights::{heights, nodes};
use super::march::{LANES, Land, Packed, Rays, any};
use crate::frame::Hit;
use crate::word::{Cell as _};

/// Moves lanes that hit from their first sample under the surface to the place of the hit.
#[inline(always)]
pub fn run<W: Packed>(land: &Land<'_, W>, rays: &mut Rays<W>) {
    let (stepper, surface) = (land.stepper, land.surface);
    if !any(&rays.hits) {
        return;
    }
    let mut times = [0_u32; LANES];
    for lane in 0..LANES {
        let hit = rays.hits[lane] == 1;
        times[lane] = if hit { stepper.halvings_at(rays.place(lane)) } else { 0 };
        if hit {
            rays.set(lane, rays.place(lane).minus(rays.step(lane)));
        }
    }
    let most = times.iter().fold(0, |most, &t| most.max(t));
    let memory = &*surface.heights;
    for halving in 1..=most {
        let (mut x, mut y, mut z) = (rays.x, rays.y, rays.z);
        for lane in 0..LANES {
            let middle = rays.place(lane).plus(rays.step(lane).halved(halving));
            (x[lane], y[lane], z[lane]) = (middle.x, middle.y, middle.z);
        }
        let nodes = nodes(surface, &x, &z);
        let surfaces = heights(surface, &nodes, &x, &z);
        for lane in 0..LANES {
            let inside = u32::from(memory.contains(x[lane].cell(), z[lane].cell()));
            let under = inside & u32::from(y[lane] < surfaces[lane]);
            let moves = u32::from(halving <= times[lane]) & (under ^ 1) == 1;
            rays.x[lane] = if moves { x[lane] } else { rays.x[lane] };
            rays.y[lane] = if moves { y[lane] } else { rays.y[lane] };
            rays.z[lane] = if moves { z[lane] } else { rays.z[lane] };
        }
    }
    for lane in 0..LANES {
        if rays.hits[lane] == 0 {
            continue;
        }
        let (clear, step) = (rays.place(lane), rays.step(lane));
        let meets = memory.contains(clear.x.cell(), clear.z.cell());
        let place = clear.plus(step.halved(times[lane] + u32::from(meets)));
        rays.outcome[lane] = if meets { Hit::Surface } else { stepper.beside(place, step) };
        rays.set(lane, place);
    }
}
