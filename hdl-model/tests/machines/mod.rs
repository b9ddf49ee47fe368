//! Random machines for the interpolator: kernels, maps and places, in the stock words.

use terraline::scene::KernelShape;
use terraline::setup::kernel;
use terraline::unit::height_memory::{Edge, HeightMemory};
use terraline::unit::kernel_rom::KernelRom;
use terraline::word::stock::{Narrow, Wide};
use terraline::word::{Interpolating, Lane, Load, Multiply, Readout, World};

use crate::random::Random;

/// The stock worlds, whose words are made of bits.
pub trait Bits:
    Interpolating
    + World<Height: Load + Readout + Multiply<Self::Weight>, Weight: Load<Format = ()> + Readout>
{
    /// In the names of models.
    const NAME: &'static str;
    /// Bits of a word.
    const WIDTH: u32;
    /// Fraction bits.
    const POINT: u32;
    /// Bits of a cell's index in the RTL.
    const CELL: u32;
    /// The word of these bits.
    fn ground(bits: i64) -> Self::Ground;
    /// The word of these bits.
    fn height(bits: i64) -> Self::Height;
    /// The word of these bits.
    fn weight(bits: i64) -> Self::Weight;
}

macro_rules! bits {
    ($world:ident $name:literal $int:ident $point:literal $cell:literal) => {
        impl Bits for $world {
            const NAME: &'static str = $name;
            const WIDTH: u32 = $int::BITS;
            const POINT: u32 = $point;
            const CELL: u32 = $cell;
            fn ground(bits: i64) -> Self::Ground {
                Lane::of_int(bits as $int)
            }
            fn height(bits: i64) -> Self::Height {
                Lane::of_int(bits as $int)
            }
            fn weight(bits: i64) -> Self::Weight {
                Lane::of_int(bits as $int)
            }
        }
    };
}
bits! { Narrow "narrow" i32 20 12 }
bits! { Wide "wide" i64 24 26 }

/// The bits of a word.
pub fn raw(word: impl Readout) -> i64 {
    word.raw().expect("stock words have bits")
}

/// A kernel as set-up makes it, or one of extreme and random entries.
pub fn rom<W: Bits>(
    shape: Option<KernelShape>,
    stretched: bool,
    log2: u32,
    random: &mut Random,
) -> KernelRom<W::Weight> {
    let one = 1_i64 << W::POINT;
    let entries = 1_u32 << log2;
    let (weights, slopes): (Vec<_>, Vec<_>) = (0..=entries)
        .map(|entry| {
            let t = f64::from(entry) / f64::from(entries);
            let load = |value| W::Weight::load(value, ()).expect("kernels fit");
            match shape {
                Some(shape) if stretched => (
                    load(kernel::stretched(shape, t + 0.5)),
                    load(kernel::stretched_slope(shape, t + 0.5)),
                ),
                Some(shape) => (load(kernel::value(shape, t)), load(kernel::slope(shape, t))),
                None => {
                    let weight = random.among(&[0, 1, one - 1, one, -1]);
                    let weight = if weight < 0 { random.below(one + 1) } else { weight };
                    let slope = random.among(&[0, 4 * one - 1, 1 - 4 * one, -one, one + 1, one]);
                    let slope =
                        if slope == one { random.below(8 * one - 1) - 4 * one + 1 } else { slope };
                    (<W as Bits>::weight(weight), <W as Bits>::weight(slope))
                }
            }
        })
        .unzip();
    KernelRom::new(log2, weights, slopes)
}

/// A map of random nodes: flat, small, of the plan's range, or of all words that are not negative.
pub fn heights<W: Bits>(random: &mut Random) -> HeightMemory<W::Height> {
    let sizes = [1, 2, 3, 4, 5, 8, 33, 64];
    // One node a side has no cell: such maps only go on.
    let edge = if random.below(2) == 0 { Edge::Ends } else { Edge::Clamps };
    let side = |random: &mut Random| match (edge, random.among(&sizes)) {
        (Edge::Ends, 1) => 2,
        (_, side) => side,
    };
    let (columns, rows) = (side(random), side(random));
    let limit =
        random.among(&[1, 7, 1 << W::POINT, 1 << (W::WIDTH - 4), i64::MAX >> (64 - W::WIDTH)]);
    let nodes = (0..columns * rows)
        .map(|_| match random.below(3) {
            0 => 0,
            1 => limit,
            _ => random.below(limit),
        })
        .map(<W as Bits>::height)
        .collect();
    let memory = HeightMemory::new(nodes, columns, rows, edge);
    match random.below(3) {
        0 => memory,
        1 => memory.with_voids((0..columns * rows).map(|_| random.below(9) == 0).collect()),
        _ => memory.with_voids(vec![false; columns * rows]),
    }
}

/// A position along an axis, most often on the map, with fractions about the kernel's entries.
pub fn place<W: Bits>(size: i32, random: &mut Random) -> i64 {
    let one = 1_i64 << W::POINT;
    let cells = 1_i64 << (W::CELL - 1);
    let cell = match random.below(8) {
        0 => random.among(&[-cells, 1 - cells, cells - 1, cells - 2]),
        1 => random.below(2 * cells) - cells,
        2 => random.among(&[-2, -1, i64::from(size) - 2, i64::from(size) - 1, i64::from(size)]),
        _ => random.below(i64::from(size) + 3) - 2,
    };
    let fraction = match random.below(4) {
        0 => random.among(&[0, 1, one - 1, one / 2, one / 2 - 1, one / 2 + 1]),
        // About the border between two entries.
        1 => ((random.below(64) << (W::POINT - 6)) + random.below(3) - 1) & (one - 1),
        _ => random.below(one),
    };
    cell * one + fraction
}
