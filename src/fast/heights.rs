//! Surface heights of a packet's places: the interpolator's arithmetic on vectors.

use fearless_simd::i32x16;
use fearless_simd::prelude::*;

use super::march::Land;
use super::words::{Packed, Words};
use crate::unit::interpolator::Form;
use crate::unit::stepper::SurfaceUnit;
use crate::word::{Lane as _, Site};

/// Nodes h1 to h4 around a place per ray.
pub type Nodes<W, S> = [<W as Packed>::Words<S>; 4];

/// Loads the nodes of cells; rays that are not asked for may stand anywhere.
#[inline(always)]
pub fn nodes<W: Packed, S: Simd>(land: &Land<'_, W, S>, i: i32x16<S>, j: i32x16<S>) -> Nodes<W, S> {
    let memory = &*land.surface.heights;
    let (columns, rows) = (memory.columns(), memory.rows());
    let (west, east) = (i.max(0).min(columns - 1), (i + 1).max(0).min(columns - 1));
    let (north, south) = (j.max(0).min(rows - 1) * columns, (j + 1).max(0).min(rows - 1) * columns);
    let load = |address: i32x16<S>| {
        let at = address.to_array();
        let node = |lane: usize| memory.nodes()[at[lane] as usize].int();
        W::Words::load(land.simd, std::array::from_fn(node))
    };
    [load(north + west), load(south + west), load(north + east), load(south + east)]
}

/// Heights at places in the cells of the nodes.
#[inline(always)]
pub fn heights<W: Packed, S: Simd>(
    land: &Land<'_, W, S>,
    nodes: &Nodes<W, S>,
    x: W::Words<S>,
    z: W::Words<S>,
) -> W::Words<S> {
    if land.surface.form == Form::Stretch {
        // No stock world rounds at random, so operations need no addresses.
        let anywhere = Site::pixel(0, 0);
        let (x, z) = (x.store(), z.store());
        let height = |lane: usize| {
            let (x, z) = (W::Ground::of_int(x[lane]), W::Ground::of_int(z[lane]));
            land.surface.height(x, z, anywhere).int()
        };
        return W::Words::load(land.simd, std::array::from_fn(height));
    }
    let [h1, h2, h3, h4] = *nodes;
    let (weight_x, weight_z) = (weights(land, x.fraction()), weights(land, z.fraction()));
    let west = h2 + (h1 - h2).weighted(weight_z);
    let east = h4 + (h3 - h4).weighted(weight_z);
    east + (west - east).weighted(weight_x)
}

/// Weights of the lower nodes of an axis at fractions within the cell: `Interpolator::weight`.
#[inline(always)]
fn weights<W: Packed, S: Simd>(land: &Land<'_, W, S>, fraction: i32x16<S>) -> i32x16<S> {
    let point = W::Words::<S>::POINT;
    let hat = (1 << point) - fraction;
    let Some(rom) = &land.surface.rom else { return hat };
    let shift = match land.surface.form {
        Form::Blend(shift) => shift,
        Form::Hat => return hat,
        Form::Plain | Form::Stretch => 0,
    };
    // The nearest entry.
    let places = point - rom.log2();
    let entries = ((fraction + (1 << (places - 1))) >> places).to_array();
    let weight = |lane: usize| -> i64 { rom.weight(entries[lane] as usize).int().into() };
    let kernel = i32x16::simd_from(land.simd, std::array::from_fn(|lane| weight(lane) as i32));
    if shift == 0 {
        return kernel;
    }
    // The difference is shifted toward zero; a shift by all bits leaves the hat.
    let difference = kernel - hat;
    let places = shift.min(31);
    let up = (difference >> 31) & (((1_u32 << places) - 1) as i32);
    hat + ((difference + up) >> places)
}
