//! Surface heights of many places at a time: the interpolator's arithmetic in loops over lanes.

use super::march::LANES;
use crate::unit::interpolator::{Form, Interpolator, mix};
use crate::unit::stepper::SurfaceUnit;
use crate::word::{Cell, Interpolating, Site, World};

/// Nodes h1 to h4 around a place per lane.
pub type Nodes<W> = [[<W as World>::Height; LANES]; 4];

/// No stock world rounds at random, so operations need no addresses.
const ANYWHERE: u32 = 0;

/// Loads the nodes around places; lanes that are not asked for may stand anywhere.
#[inline(always)]
pub fn nodes<W: Interpolating>(
    unit: &Interpolator<W>,
    x: &[W::Ground; LANES],
    z: &[W::Ground; LANES],
) -> Nodes<W> {
    let first = unit.heights.at(0, 0);
    let mut nodes = [[first; LANES]; 4];
    for lane in 0..LANES {
        let [h1, h2, h3, h4] = unit.nodes(x[lane], z[lane]);
        nodes[0][lane] = h1;
        nodes[1][lane] = h2;
        nodes[2][lane] = h3;
        nodes[3][lane] = h4;
    }
    nodes
}

/// Heights at places in the cells of the nodes.
#[inline(always)]
pub fn heights<W: Interpolating>(
    unit: &Interpolator<W>,
    nodes: &Nodes<W>,
    x: &[W::Ground; LANES],
    z: &[W::Ground; LANES],
) -> [W::Height; LANES] {
    let site = Site::pixel(ANYWHERE, ANYWHERE);
    let mut out = nodes[0];
    if unit.form == Form::Stretch {
        for lane in 0..LANES {
            out[lane] = unit.height(x[lane], z[lane], site);
        }
        return out;
    }
    let mut kernel_x = [unit.one; LANES];
    let mut kernel_z = [unit.one; LANES];
    if let Some(rom) = &unit.rom {
        for lane in 0..LANES {
            kernel_x[lane] = rom.weight(rom.entry(x[lane].fraction()));
            kernel_z[lane] = rom.weight(rom.entry(z[lane].fraction()));
        }
    }
    let weights_x = weights(unit, x, &kernel_x, site);
    let weights_z = weights(unit, z, &kernel_z, site);
    for lane in 0..LANES {
        let four = [nodes[0][lane], nodes[1][lane], nodes[2][lane], nodes[3][lane]];
        out[lane] = mix(four, weights_x[lane], weights_z[lane], site);
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
    site: Site,
) -> [W::Weight; LANES] {
    let mut out = *kernel;
    match unit.form {
        Form::Plain if unit.rom.is_some() => {}
        Form::Blend(shift) if unit.rom.is_some() => {
            for lane in 0..LANES {
                out[lane] = unit.blend(place[lane].fraction(), kernel[lane], shift, site);
            }
        }
        _ => {
            for lane in 0..LANES {
                out[lane] = unit.hat(place[lane].fraction(), site);
            }
        }
    }
    out
}
