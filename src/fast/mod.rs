//! The fast engine: the processor's frame, bit for bit, by threads, direct entry and packets of
//! rays on vectors.
//!
//! A group of lines goes through projector and divider (`enter`), then tiles of four packets of
//! sixteen rays each (`rays`) through `beam` (what all rays of a tile pass), `march` (blocks of the
//! map), `solve` (single cells) and `refine` (the last step), then sixteen pixels at a time through
//! `shade`. `map` is the engine's copy of the height map (`cells` its nodes, `maxima` its blocks),
//! `land` what a packet needs to know, `heights` the surface, and `words` says what vectors do, which
//! `narrow` and `wide` implement.
//!
//! Functions on vectors are `#[inline(always)]` and do without closures: what is not inlined into
//! the function that `dispatch!` makes for a SIMD level is compiled without its instructions.
#![deny(clippy::float_arithmetic)]

mod beam;
mod cells;
pub mod enter;
mod heights;
mod land;
mod map;
mod march;
pub mod maxima;
mod narrow;
mod rays;
mod refine;
mod shade;
mod solve;
mod wide;
mod words;

use fearless_simd::{Level, Simd as _, dispatch};
use rayon::prelude::*;

use crate::frame::{Frame, Hit};
use crate::plan::Plan;
use crate::readout::BufferBuilder;
use crate::setup::{Back, Setup};
use crate::unit::Line;
use crate::unit::divider::Method;
use enter::Enterable;
pub use map::Map;
use words::Packed;

/// Lines that one task draws: enough to amortise its wires, few enough to balance two threads
/// between sky and ground.
const BAND: usize = 16;

/// Neighbouring lines whose rays walk together.
pub const GROUP: usize = 4;

/// Draws neighbouring lines, from `first` on, on wires that hold all columns. Any number of lines
/// will do; [`GROUP`] are drawn at a time.
pub fn run_lines<W: Enterable>(
    setup: &Setup<W>,
    map: Option<&Map<W>>,
    first: u32,
    lines: &mut [Line<W>],
) {
    for (group, number) in lines.chunks_mut(GROUP).zip((first..).step_by(GROUP)) {
        W::draw_group(Level::new(), setup, map, number, group);
    }
}

/// The SIMD levels of the processor that it runs on, the widest first.
pub fn levels() -> Vec<Level> {
    let widest = Level::new();
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    let levels = [
        widest.as_avx512().map(Level::Avx512),
        widest.as_avx2().map(Level::Avx2),
        widest.as_sse4_2().map(Level::Sse4_2),
        widest.as_sse2().map(Level::Sse2),
    ];
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    let levels = [Some(widest)];
    levels.into_iter().flatten().collect()
}

/// Draws a few neighbouring lines by packets.
fn on_vectors<W: Packed + Enterable>(
    level: Level,
    setup: &Setup<W>,
    map: Option<&Map<W>>,
    first: u32,
    lines: &mut [Line<W>],
) {
    dispatch!(level, simd => simd.vectorize(
        #[inline(always)]
        || {
            project(setup, first, lines);
            match &setup.back {
                Back::Terrain(units) => march::draw(simd, units, map, lines),
                Back::Plane(checker) => lines.iter_mut().for_each(|line| checker.run(line)),
            }
        }
    ));
}

/// Draws a few neighbouring lines ray by ray.
fn singly<W: Enterable>(setup: &Setup<W>, first: u32, lines: &mut [Line<W>]) {
    project(setup, first, lines);
    lines.iter_mut().for_each(|line| setup.run_back(line));
}

/// Runs projector and divider.
#[inline(always)]
fn project<W: Enterable>(setup: &Setup<W>, first: u32, lines: &mut [Line<W>]) {
    for (line, number) in lines.iter_mut().zip(first..) {
        line.number = number;
        let start = enter::line_start(&setup.projector, number);
        enter::fill(&setup.projector, &start, line);
        if let Some(divider) = &setup.divider {
            divider.run(line, Method::Direct);
        }
    }
}

/// Draws a whole frame on all threads.
pub fn render<W: Enterable>(
    setup: &Setup<W>,
    map: Option<&Map<W>>,
    plan: &Plan,
    buffers: bool,
) -> Frame {
    render_at(Level::new(), setup, map, plan, buffers)
}

/// The same frame at one of [`levels`].
pub fn render_at<W: Enterable>(
    level: Level,
    setup: &Setup<W>,
    map: Option<&Map<W>>,
    plan: &Plan,
    buffers: bool,
) -> Frame {
    draw(level, setup, map, plan, buffers, &|_| {})
}

/// Draws a whole frame and shows every finished line to `look`, in no particular order.
pub fn render_and_look<W: Enterable>(
    setup: &Setup<W>,
    map: Option<&Map<W>>,
    plan: &Plan,
    buffers: bool,
    look: &(impl Fn(&Line<W>) + Sync),
) -> Frame {
    draw(Level::new(), setup, map, plan, buffers, look)
}

fn draw<W: Enterable>(
    level: Level,
    setup: &Setup<W>,
    map: Option<&Map<W>>,
    plan: &Plan,
    buffers: bool,
    look: &(impl Fn(&Line<W>) + Sync),
) -> Frame {
    let (columns, lines) = (setup.columns as usize, setup.lines as usize);
    let mut color = vec![[0; 3]; columns * lines];
    let mut hit = vec![Hit::Sky; columns * lines];
    let band = BAND * columns;
    // Every band writes its own part of the picture.
    let parts: Vec<Option<BufferBuilder<'_>>> = color
        .par_chunks_mut(band)
        .zip(hit.par_chunks_mut(band))
        .enumerate()
        .map_init(
            || vec![Line::new(&setup.world, 0..setup.columns); GROUP],
            |wires, (band, (color, hit))| {
                let mut part = buffers.then(|| BufferBuilder::new(plan, BAND, false));
                let groups = color.chunks_mut(GROUP * columns).zip(hit.chunks_mut(GROUP * columns));
                for (group, (color, hit)) in groups.enumerate() {
                    let wires = &mut wires[..color.len() / columns];
                    let first = (band * BAND + group * GROUP) as u32;
                    W::draw_group(level, setup, map, first, wires);
                    let rows = color.chunks_exact_mut(columns).zip(hit.chunks_exact_mut(columns));
                    for (line, (color, hit)) in wires.iter().zip(rows) {
                        look(line);
                        color.copy_from_slice(&line.color);
                        hit.copy_from_slice(&line.hit);
                        if let Some(part) = &mut part {
                            part.push(line);
                        }
                    }
                }
                part
            },
        )
        .collect();
    let mut whole = buffers.then(|| BufferBuilder::new(plan, lines, false));
    for part in parts.into_iter().flatten() {
        if let Some(whole) = &mut whole {
            whole.append(part);
        }
    }
    Frame { columns, lines, color, hit, buffers: whole.map(BufferBuilder::finish) }
}
