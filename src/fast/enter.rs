//! Direct entry into the projector's recurrence: any line, any column.
//!
//! In wrapping fixed point `start + k·step` is k additions (equation 7 of docs/mathematics.md),
//! so lines are independent of each other and a line's columns fill in parallel.

use fearless_simd::Level;

use super::{Map, on_vectors, singly};
use crate::setup::Setup;
use crate::unit::Line;
use crate::unit::line::LineStart;
use crate::unit::projector::{Linear, Projector};
use crate::word::stock::{Narrow, Wide};
use crate::word::sweep::Sweep;
use crate::word::{Complete, Enter, World};

/// A world whose accumulators may be entered anywhere.
///
/// Its lines are drawn by a method without type parameters, so that the vectorised code of each
/// world is compiled once, in this library.
pub trait Enterable: Complete + World<View: Enter> {
    /// Whether its words are plain integers, whose rays walk by packets.
    const PACKED: bool;

    /// Draws a few neighbouring lines from `first` on, on wires that hold all columns, at a SIMD
    /// level.
    fn draw_group(
        level: Level,
        setup: &Setup<Self>,
        maps: &[Option<Map<Self>>],
        first: u32,
        lines: &mut [Line<Self>],
    );
}

macro_rules! packed {
    ($($world:ty),*) => {
        $(impl Enterable for $world {
            const PACKED: bool = true;

            fn draw_group(
                level: Level,
                setup: &Setup<Self>,
                maps: &[Option<Map<Self>>],
                first: u32,
                lines: &mut [Line<Self>],
            ) {
                on_vectors(level, setup, maps, first, lines);
            }
        })*
    };
}

packed! { Narrow, Wide }

impl Enterable for Sweep {
    const PACKED: bool = false;

    fn draw_group(
        _: Level,
        setup: &Setup<Self>,
        _: &[Option<Map<Self>>],
        first: u32,
        lines: &mut [Line<Self>],
    ) {
        singly(setup, first, lines);
    }
}

/// The projector's accumulators at the first column of line `number`.
pub fn line_start<W: Enterable>(projector: &Projector<W>, number: u32) -> LineStart<W> {
    projector.line_start(|c| c.start.after(c.per_line, number))
}

/// Drives the view wires of one whole line.
pub fn fill<W: Enterable>(projector: &Projector<W>, start: &LineStart<W>, line: &mut Line<W>) {
    let columns = &line.column;
    let wire = |start: W::View, c: &Linear<W::View>, wire: &mut [W::View]| {
        for (out, &column) in wire.iter_mut().zip(columns) {
            *out = start.after(c.per_column, column);
        }
    };
    wire(start.x, &projector.x, &mut line.view_x);
    wire(start.z, &projector.z, &mut line.view_z);
    if let Some(c) = &projector.y {
        wire(start.y, c, &mut line.view_y);
    }
    if let Some(c) = &projector.denominator {
        wire(start.denominator, c, &mut line.denominator);
    }
}
