//! Surface heights of a packet's places: the interpolator's arithmetic on vectors.

use fearless_simd::prelude::*;
use fearless_simd::{i32x16, u32x16};

use super::land::Land;
use super::map::MaskedTable;
use super::words::{LANES, Packed, Words, lanes};
use crate::unit::interpolator::Form;
use crate::unit::surface_unit::SurfaceUnit;
use crate::word::{Lane as _, Site};

/// Nodes h1 to h4 around a place per ray.
pub type Nodes<W, S> = [<W as Packed>::Words<S>; 4];

/// Loads the nodes of cells; rays that are not asked for may stand anywhere.
#[inline(always)]
pub fn nodes<W: Packed, S: Simd>(land: &Land<'_, W, S>, i: i32x16<S>, j: i32x16<S>) -> Nodes<W, S> {
    let cells = &land.map.cells;
    let (last_i, last_j) = cells.last;
    let (i, j) = (i.max(-1).min(last_i) + 1, j.max(-1).min(last_j) + 1);
    let addresses = (j * cells.stride + i).bitcast::<u32x16<S>>().to_array();
    W::Words::load_four(
        land.simd,
        lanes!(lane => {
            let [h1, h2, h3, h4] = cells.at(addresses[lane]);
            [h1.int(), h2.int(), h3.int(), h4.int()]
        }),
    )
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
        let heights = lanes!(lane => {
            let (x, z) = (W::Ground::of_int(x[lane]), W::Ground::of_int(z[lane]));
            land.surface.height(x, z, anywhere).int()
        });
        return W::Words::load(land.simd, heights);
    }
    let [h1, h2, h3, h4] = *nodes;
    let (x, z) = (x.fraction(), z.fraction());
    let weight_x = weight(land, x, entries(land, x).as_ref());
    let weight_z = weight(land, z, entries(land, z).as_ref());
    let west = h2 + (h1 - h2).weighted(weight_z);
    let east = h4 + (h3 - h4).weighted(weight_z);
    east + (west - east).weighted(weight_x)
}

/// Entries of the kernel ROM nearest to fractions within the cell; `None` where the hat is read.
#[inline(always)]
pub fn entries<W: Packed, S: Simd>(
    land: &Land<'_, W, S>,
    fraction: i32x16<S>,
) -> Option<[i32; LANES]> {
    let places = W::Words::<S>::POINT - land.map.weights.as_ref()?.log2;
    let nearest = (fraction + (1 << (places - 1))) >> places;
    Some((nearest & MaskedTable::MASK).to_array())
}

/// Weights of the lower nodes of an axis: `Interpolator::weight`.
#[inline(always)]
pub fn weight<W: Packed, S: Simd>(
    land: &Land<'_, W, S>,
    fraction: i32x16<S>,
    entries: Option<&[i32; LANES]>,
) -> i32x16<S> {
    let hat = (1 << W::Words::<S>::POINT) - fraction;
    let (Some(weights), Some(entries)) = (&land.map.weights, entries) else { return hat };
    let kernel = lanes!(lane => weights.weight.at(entries[lane]));
    let kernel = i32x16::simd_from(land.simd, kernel);
    match land.surface.form {
        Form::TowardHat(shift) => hat + shifted_toward_zero(kernel - hat, shift),
        Form::Plain | Form::Stretch | Form::Hat => kernel,
    }
}

/// Slopes of those weights: `Interpolator::arm`.
#[inline(always)]
pub fn slope<W: Packed, S: Simd>(
    land: &Land<'_, W, S>,
    entries: Option<&[i32; LANES]>,
) -> i32x16<S> {
    let one = i32x16::simd_from(land.simd, 1 << W::Words::<S>::POINT);
    let (Some(weights), Some(entries)) = (&land.map.weights, entries) else { return -one };
    let kernel = lanes!(lane => weights.slope.at(entries[lane]));
    let kernel = i32x16::simd_from(land.simd, kernel);
    match land.surface.form {
        // The hat falls with slope one.
        Form::TowardHat(shift) => shifted_toward_zero(kernel + one, shift) - one,
        Form::Plain | Form::Stretch | Form::Hat => kernel,
    }
}

/// As `Word::shift_toward_zero`.
#[inline(always)]
fn shifted_toward_zero<S: Simd>(words: i32x16<S>, shift: u32) -> i32x16<S> {
    let places = shift.min(31);
    (words + ((words >> 31) & ((1_u32 << places) - 1) as i32)) >> places
}
