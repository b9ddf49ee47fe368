//! Surface heights of many places at a time: the interpolator's arithmetic in loops over lanes.

use crate::unit::interpolator::{Form, Interpolator, mix};
use crate::unit::stepper::SurfaceUnit;
use crate::word::{Cell, Interpolating, Site};

/// Rays that walk together: one vector of 32-bit words at the widest SIMD level.
pub const LANES: usize = 16;

/// Heights at places over the map; whatever stands in lanes that are not asked for is ignored.
#[inline(always)]
pub fn heights<W: Interpolating>(
    unit: &Interpolator<W>,
    x: &[W::Ground; LANES],
    z: &[W::Ground; LANES],
    sites: &[Site; LANES],
) -> [W::Height; LANES] {
    let memory = &*unit.heights;
    let first = memory.at(0, 0);
    let mut out = [first; LANES];
    if unit.form == Form::Stretch {
        for lane in 0..LANES {
            out[lane] = unit.height(x[lane], z[lane], sites[lane]);
        }
        return out;
    }
    // Loads from map and ROM, lane by lane.
    let mut nodes = [[first; LANES]; 4];
    let mut kernel_x = [unit.one; LANES];
    let mut kernel_z = [unit.one; LANES];
    for lane in 0..LANES {
        let [h1, h2, h3, h4] = unit.nodes(x[lane], z[lane]);
        nodes[0][lane] = h1;
        nodes[1][lane] = h2;
        nodes[2][lane] = h3;
        nodes[3][lane] = h4;
    }
    if let Some(rom) = &unit.rom {
        for lane in 0..LANES {
            kernel_x[lane] = rom.weight(rom.entry(x[lane].fraction()));
            kernel_z[lane] = rom.weight(rom.entry(z[lane].fraction()));
        }
    }
    // The axes' operations are set apart as in the unit.
    let weights_x = weights(unit, x, &kernel_x, sites, 1);
    let weights_z = weights(unit, z, &kernel_z, sites, 0);
    for lane in 0..LANES {
        let four = [nodes[0][lane], nodes[1][lane], nodes[2][lane], nodes[3][lane]];
        out[lane] = mix(four, weights_x[lane], weights_z[lane], sites[lane]);
    }
    out
}

/// Weights of one axis from the places and the ROM's entries: `Interpolator::weight` with its
/// choice of form outside the loops.
#[inline(always)]
fn weights<W: Interpolating>(
    unit: &Interpolator<W>,
    place: &[W::Ground; LANES],
    kernel: &[W::Weight; LANES],
    sites: &[Site; LANES],
    axis: u32,
) -> [W::Weight; LANES] {
    match unit.form {
        Form::Plain if unit.rom.is_some() => *kernel,
        Form::Blend(shift) if unit.rom.is_some() => {
            each(place, kernel, sites, axis, |place, kernel, site| {
                unit.blend(place.fraction(), kernel, shift, site)
            })
        }
        _ => each(place, kernel, sites, axis, |place, _, site| unit.hat(place.fraction(), site)),
    }
}

/// One weight per lane.
#[inline(always)]
fn each<G: Copy, T: Copy>(
    place: &[G; LANES],
    kernel: &[T; LANES],
    sites: &[Site; LANES],
    axis: u32,
    weight: impl Fn(G, T, Site) -> T,
) -> [T; LANES] {
    let mut out = *kernel;
    for lane in 0..LANES {
        let site = sites[lane].step(sites[lane].operation ^ axis);
        out[lane] = weight(place[lane], kernel[lane], site);
    }
    out
}
