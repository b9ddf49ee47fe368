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

use std::ops::Range;

use fearless_simd::{Level, Simd as _, dispatch};
use rayon::prelude::*;

use crate::frame::{Buffers, Frame, Giver, Hit};
use crate::plan::{Plan, SurfacePlan};
use crate::readout::Reader;
use crate::scene::Scene;
use crate::setup::{Back, Memory, Setup, SurfaceUnits};
use crate::unit::divider::Method;
use crate::unit::{Line, Unit};
use crate::word::World;
use enter::Enterable;
pub use map::Map;
use words::Packed;

/// Lines that one task draws: enough to amortise its wires, few enough to balance two threads
/// between sky and ground.
const BAND: usize = 16;

/// Neighbouring lines whose rays walk together.
const GROUP: usize = 4;

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
    maps: &[Option<Map<W>>],
    first: u32,
    lines: &mut [Line<W>],
) {
    dispatch!(level, simd => simd.vectorize(
        #[inline(always)]
        || {
            for (units, map) in setup.surfaces.iter().zip(maps) {
                project(units, first, lines);
                match &units.back {
                    Back::Terrain(units) => march::draw(simd, units, map.as_ref(), lines),
                    Back::Plane(checker) => lines.iter_mut().for_each(|line| checker.run(line)),
                }
                if let Some(depth) = units.depth {
                    lines.iter_mut().for_each(|line| depth.run(line));
                }
            }
        }
    ));
}

/// Draws a few neighbouring lines ray by ray.
fn singly<W: Enterable>(setup: &Setup<W>, first: u32, lines: &mut [Line<W>]) {
    for units in &setup.surfaces {
        project(units, first, lines);
        let mut behind = units.back.units();
        behind.extend(units.depth.iter().map(|depth| depth as &dyn Unit<W>));
        lines.iter_mut().for_each(|line| behind.iter().for_each(|unit| unit.run(line)));
    }
}

/// Runs projector and divider of a surface.
#[inline(always)]
fn project<W: Enterable>(units: &SurfaceUnits<W>, first: u32, lines: &mut [Line<W>]) {
    for (line, number) in lines.iter_mut().zip(first..) {
        line.number = number;
        let start = enter::line_start(&units.projector, number);
        enter::fill(&units.projector, &start, line);
        if let Some(divider) = &units.divider {
            divider.run_by(Method::Direct, line);
        }
    }
}

/// The copies of the surfaces' maps that packets read; `None` for a surface whose rays are drawn one
/// by one: in worlds whose words are no plain integers, and where [`Map::new`] gives none.
pub fn maps<W: Enterable>(
    world: &W,
    scene: &Scene,
    plan: &Plan,
    memories: &[Option<Memory<W>>],
) -> Vec<Option<Map<W>>> {
    let map = |(surface, memory): (&SurfacePlan, &Option<Memory<W>>)| {
        let (walk, memory) = (surface.terrain()?, memory.as_ref()?);
        W::PACKED.then(|| Map::new(world, &scene.kernel, walk, memory)).flatten()
    };
    plan.surfaces.iter().zip(memories).map(map).collect()
}

/// What the fast engine draws from.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a, W: World> {
    /// The machine's coefficients and memories.
    pub setup: &'a Setup<W>,
    /// The map of each surface as packets read it; rays are drawn one by one without.
    pub maps: &'a [Option<Map<W>>],
    /// The plan of both.
    pub plan: &'a Plan,
}

/// Draws lines of a frame on all threads and shows every finished one to `look`, in no particular
/// order. `None` if `stop`, which is asked every few lines, said so.
pub fn draw<W: Enterable>(
    source: Source<'_, W>,
    lines: Range<u32>,
    buffers: bool,
    look: &(dyn Fn(&Line<W>) + Sync),
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Frame> {
    draw_at(Level::new(), source, lines, buffers, look, stop)
}

/// A whole frame at one of [`levels`].
pub fn render_at<W: Enterable>(level: Level, source: Source<'_, W>, buffers: bool) -> Frame {
    draw_at(level, source, 0..source.setup.lines, buffers, &|_| {}, &|| false)
        .unwrap_or_else(|| unreachable!("nobody stops it"))
}

fn draw_at<W: Enterable>(
    level: Level,
    source: Source<'_, W>,
    lines: Range<u32>,
    buffers: bool,
    look: &(dyn Fn(&Line<W>) + Sync),
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Frame> {
    let Source { setup, maps, plan } = source;
    let (columns, count) = (setup.columns as usize, lines.len());
    let mut color = vec![[0; 3]; columns * count];
    let mut hit = vec![Hit::Sky; columns * count];
    // Few lines are shared by all threads, too.
    let band =
        count.div_ceil(rayon::current_num_threads()).next_multiple_of(GROUP).clamp(GROUP, BAND);
    let reader = Reader::new(plan);
    // Every band writes its own part of the picture.
    let parts: Option<Vec<Option<Buffers>>> = color
        .par_chunks_mut(band * columns)
        .zip(hit.par_chunks_mut(band * columns))
        .enumerate()
        .map_init(
            || vec![Line::new(&setup.world, 0..setup.columns); GROUP],
            |wires, (at, (color, hit))| {
                let mut part = buffers.then(|| Buffers::with_room(color.len()));
                let groups = color.chunks_mut(GROUP * columns).zip(hit.chunks_mut(GROUP * columns));
                for (group, (color, hit)) in groups.enumerate() {
                    if stop() {
                        return None;
                    }
                    let wires = &mut wires[..color.len() / columns];
                    let first = lines.start + (at * band + group * GROUP) as u32;
                    W::draw_group(level, setup, maps, first, wires);
                    let rows = color.chunks_exact_mut(columns).zip(hit.chunks_exact_mut(columns));
                    for (line, (color, hit)) in wires.iter().zip(rows) {
                        look(line);
                        color.copy_from_slice(&line.color);
                        hit.copy_from_slice(&line.hit);
                        if let Some(part) = &mut part {
                            reader.read(line, Giver::Engines, part);
                        }
                    }
                }
                Some(part)
            },
        )
        .collect();
    let mut whole = buffers.then(|| Buffers::with_room(columns * count));
    for part in parts?.into_iter().flatten() {
        if let Some(whole) = &mut whole {
            whole.append(part);
        }
    }
    Some(Frame { columns, lines: count, color, hit, buffers: whole })
}
