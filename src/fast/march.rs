//! The ray stepper, a packet of rays at a time: the same first sample under the surface as
//! `unit::stepper`.
//!
//! A ray visits the blocks of the map that its samples lie in, coarse ones where it is high, finer
//! ones near the ground. The last sample in a block is known from the block's far side and the
//! reciprocal of the step, rounded so that it never lies beyond. If first and last sample are at or
//! above the block's highest node, no sample between them hits (samples of a ray lie on a line, the
//! surface stays within its nodes), and the ray goes on with the first sample after it. In a single
//! cell that is not passed so, `solve` finds the first sample under the surface.

use fearless_simd::prelude::*;
use fearless_simd::{i32x16, mask32x16, u32x16};

use super::words::{LANES, Packed, Words};
use super::{beam, refine, shade, solve};
use crate::frame::Hit;
use crate::setup::maxima::NOTHING;
use crate::setup::{Relief, TerrainUnits};
use crate::unit::Line;
use crate::unit::interpolator::Interpolator;
use crate::unit::line::{Entry, Work};
use crate::unit::stepper::{Place, Stepper};
use crate::word::{Lane, World};

/// What a walk needs to know of the map.
pub struct Land<'a, W: World, S> {
    /// SIMD level.
    pub simd: S,
    /// The machine's stepper.
    pub stepper: &'a Stepper<W>,
    /// The machine's interpolator.
    pub surface: &'a Interpolator<W>,
    /// The map.
    pub relief: &'a Relief<W::Height>,
}

impl<W: World, S: Simd> Land<'_, W, S> {
    /// Where there is a surface in cell (i, j).
    #[inline(always)]
    pub fn inside(&self, i: i32x16<S>, j: i32x16<S>) -> mask32x16<S> {
        let finest = u32x16::simd_from(self.simd, 0);
        let maxima = &self.relief.maxima;
        let (addresses, held) = maxima.addresses(finest, i, j);
        if self.surface.heights.has_voids() {
            held & maxima.bounds(addresses).simd_ne(i32::from(NOTHING))
        } else {
            held
        }
    }
}

/// A packet of rays, component by component.
pub struct Rays<W: Packed, S: Simd> {
    /// The first place that has not been tested: x, y, z.
    pub place: [W::Words<S>; 3],
    /// The step.
    pub step: [W::Words<S>; 3],
    /// Index of the sample at that place.
    pub index: u32x16<S>,
    /// Block size that is tried next.
    level: u32x16<S>,
    /// Looks for a block that it does not pass.
    pub walks: mask32x16<S>,
    /// Stands in a cell that it may not pass.
    pub near: mask32x16<S>,
    /// More samples of the ray in that cell.
    pub more: u32x16<S>,
    /// Stands at its first sample under the surface.
    pub hits: mask32x16<S>,
    /// What becomes of a ray that does not hit.
    pub outcome: i32x16<S>,
    /// Cells outside of which the ray has left the map behind: first and last x, first and last z.
    within: [i32x16<S>; 4],
    /// The ray does not fall.
    rises: mask32x16<S>,
    /// The ray does not rise, and the map has a base.
    falls: mask32x16<S>,
    /// Reciprocals of the packet's longest steps in x and z.
    inverse: [u32; 2],
    /// The longest steps in x and z, 16 fraction bits, rounded up.
    pub longest: [u64; 2],
}

/// Runs stepper, interpolator and shader on neighbouring lines: by packets where set-up has made
/// maxima, else as the processor does.
#[inline(always)]
pub fn draw<W: Packed, S: Simd>(simd: S, units: &TerrainUnits<W>, lines: &mut [Line<W>]) {
    let (stepper, surface) = (&units.stepper, &units.interpolator);
    let Some(relief) = units.relief.as_deref() else {
        for line in lines {
            stepper.run(line, surface);
            units.shade(line);
        }
        return;
    };
    let land = Land { simd, stepper, surface, relief };
    run(&land, lines);
    for line in lines {
        shade::run(&land, &units.shader, line);
    }
}

/// Drives `hit`, `ground_x`, `ground_z` and `steps` of neighbouring lines as the stepper does. Work
/// is not counted here: trials are the processor's.
#[inline(always)]
fn run<W: Packed, S: Simd>(land: &Land<'_, W, S>, lines: &mut [Line<W>]) {
    let shape = Shape { lines: lines.len(), width: LANES / lines.len() };
    let columns = lines.first().map_or(0, Line::len);
    for from in (0..columns).step_by(TILE * shape.width) {
        let mut tile = [
            start(land, lines, shape, from),
            start(land, lines, shape, from + shape.width),
            start(land, lines, shape, from + 2 * shape.width),
            start(land, lines, shape, from + 3 * shape.width),
        ];
        beam::skip(land, &mut tile, 4);
        for pair in tile.chunks_exact_mut(SIDE_BY_SIDE) {
            march(land, pair);
            refine::run(land, pair);
        }
        for (packet, rays) in tile.iter().enumerate() {
            finish(rays, lines, shape, from + packet * shape.width);
        }
    }
}

/// Takes rays to their first samples under the surface, or out of the map.
#[inline(always)]
fn march<W: Packed, S: Simd>(land: &Land<'_, W, S>, packets: &mut [Rays<W, S>]) {
    while any_walks(packets) {
        while any_walks(packets) {
            for rays in &mut *packets {
                if rays.walks.any_true() {
                    trial(land, rays);
                }
            }
        }
        solve::run(land, packets);
    }
}

/// Whether there is a ray that walks.
#[inline(always)]
fn any_walks<W: Packed, S: Simd>(packets: &[Rays<W, S>]) -> bool {
    let mut any = false;
    for rays in packets {
        any |= rays.walks.any_true();
    }
    any
}

/// Packets that march side by side: a round is a long chain of operations that wait for each
/// other, so that two take little longer than one.
pub const SIDE_BY_SIDE: usize = 4;

/// Packets that start together.
const TILE: usize = 4;

/// Block size that rays try first.
const START_LEVEL: u32 = 0;

/// Outcomes by number.
const OUTCOMES: [Hit; 4] = [Hit::Sky, Hit::Surface, Hit::Side, Hit::Far];

/// How the pixels of a packet lie.
#[derive(Clone, Copy)]
struct Shape {
    lines: usize,
    width: usize,
}

impl Shape {
    /// Line and column of a lane.
    #[inline(always)]
    fn pixel(self, lane: usize) -> (usize, usize) {
        (lane / self.width, lane % self.width)
    }
}

/// The rays of a packet at their first samples; lanes without a ray are done.
#[inline(always)]
fn start<W: Packed, S: Simd>(
    land: &Land<'_, W, S>,
    lines: &[Line<W>],
    shape: Shape,
    from: usize,
) -> Rays<W, S> {
    let (simd, stepper) = (land.simd, land.stepper);
    let mut view = [[W::Int::default(); LANES]; 3];
    let mut ground = [[W::Int::default(); LANES]; 2];
    let mut met = [0; LANES];
    let mut outcome = [Hit::Sky as i32; LANES];
    for (row, line) in lines.iter().enumerate() {
        for column in 0..shape.width.min(line.len().saturating_sub(from)) {
            let (lane, i) = (row * shape.width + column, from + column);
            view[0][lane] = line.view_x[i].int();
            view[1][lane] = line.view_y[i].int();
            view[2][lane] = line.view_z[i].int();
            ground[0][lane] = line.ground_x[i].int();
            ground[1][lane] = line.ground_z[i].int();
            let entry = if stepper.from_eye { Entry::Met } else { line.entry[i] };
            met[lane] = -i32::from(entry == Entry::Met);
            outcome[lane] = if entry == Entry::Far { stepper.beyond } else { Hit::Sky } as i32;
        }
    }
    let mask = |flag: bool| mask32x16::simd_from(simd, flag);
    let number = |number: i32| i32x16::simd_from(simd, number);
    let splat = |word: W::Int| W::Words::splat(simd, word);
    let met = mask32x16::simd_from(simd, met);

    // The step, as `Stepper::step`: equation 20.
    let [x, y, z] = view;
    let (x, y, z) = (W::Words::load(simd, x), W::Words::load(simd, y), W::Words::load(simd, z));
    // The leading one is counted from the ground's point, so the points' difference cancels out.
    let places = W::Words::leading_one([x, y, z]) + (1 + stepper.fineness as i32);
    let (dx, dy, dz) = (x.scaled_down(places), y.scaled_down(places), z.scaled_down(places));
    let place = if stepper.from_eye {
        let eye = stepper.eye();
        [splat(eye.x.int()), splat(eye.y.int()), splat(eye.z.int())]
    } else {
        let [x, z] = ground;
        [W::Words::load(simd, x), splat(stepper.top.int()), W::Words::load(simd, z)]
    };

    let none = splat(W::Int::default());
    let (west, east) = (!none.less(dx), !dx.less(none));
    let (north, south) = (!none.less(dz), !dz.less(none));
    let (columns, rows) = stepper.extent.unwrap_or((0, 0));
    let ends = mask(stepper.extent.is_some());
    let within = [
        (ends & west).select(number(0), number(i32::MIN)),
        (ends & east).select(number(columns - 2), number(i32::MAX)),
        (ends & north).select(number(0), number(i32::MIN)),
        (ends & south).select(number(rows - 2), number(i32::MAX)),
    ];
    let longest = [longest::<W, S>(dx, met), longest::<W, S>(dz, met)];
    let mut rays = Rays {
        place,
        step: [dx, dy, dz],
        index: u32x16::simd_from(simd, 0),
        level: u32x16::simd_from(simd, START_LEVEL.min(land.relief.maxima.top())),
        walks: met,
        near: mask(false),
        more: u32x16::simd_from(simd, 0),
        hits: mask(false),
        outcome: i32x16::simd_from(simd, outcome),
        within,
        rises: !dy.less(none),
        falls: mask(stepper.sides) & !none.less(dy),
        inverse: longest.map(inverse::<W>),
        // 16 fraction bits.
        longest: longest.map(|step| u64::from(step >> (W::Ground::FRACTION - 16)) + 1),
    };
    // A ray may be over before its first sample, or have none.
    let fallen = rays.falls & place[1].less(splat(stepper.base.int()));
    rays.walks &= !fallen;
    end_walks(land, &mut rays);
    if stepper.last == 0 {
        rays.outcome = rays.walks.select(number(Hit::Far as i32), rays.outcome);
        rays.walks = mask(false);
    }
    rays.advance(u32x16::simd_from(simd, 1));
    rays
}

/// The longest of some steps, in bits.
#[inline(always)]
fn longest<W: Packed, S: Simd>(steps: W::Words<S>, of: mask32x16<S>) -> u32 {
    let lengths = steps.coarse_magnitude(0);
    let lengths = of.select(lengths, u32x16::simd_from(lengths.token(), 0)).to_array();
    lengths.into_iter().fold(0, u32::max)
}

/// `floor(2^(FRACTION + 20) / step)`, at most 2^26.
#[inline(always)]
fn inverse<W: Packed>(step: u32) -> u32 {
    ((1_u64 << (W::Ground::FRACTION + 20)) / u64::from(step.max(1))).min(1 << 26) as u32
}

impl<W: Packed, S: Simd> Rays<W, S> {
    /// Moves the rays that walk so many samples on.
    #[inline(always)]
    pub fn skip(&mut self, steps: u32) {
        let simd = self.index.token();
        let none = u32x16::simd_from(simd, 0);
        self.advance(self.walks.select(u32x16::simd_from(simd, steps), none));
    }

    /// Moves rays so many samples on.
    #[inline(always)]
    pub fn advance(&mut self, steps: u32x16<S>) {
        for (place, step) in self.place.iter_mut().zip(self.step) {
            *place = place.after(step, steps);
        }
        self.index += steps;
    }
}

/// One block of every walking ray: passed, or looked at more closely.
#[inline(always)]
fn trial<W: Packed, S: Simd>(land: &Land<'_, W, S>, rays: &mut Rays<W, S>) {
    let (stepper, maxima) = (land.stepper, &land.relief.maxima);
    let [x, y, z] = rays.place;
    let [dx, dy, dz] = rays.step;
    let (level, walks) = (rays.level, rays.walks);
    let (addresses, held) = maxima.addresses(level, x.cell(), z.cell());
    let bounds = maxima.bounds(addresses);

    let [inverse_x, inverse_z] = rays.inverse;
    let left = stepper.last - rays.index;
    let more = x.steps_within(dx, level, inverse_x).min(z.steps_within(dz, level, inverse_z));
    let more = more.min(left);
    let end = y.after(dy, more);
    let nothing = !held | bounds.simd_eq(i32::from(NOTHING));
    let clear = nothing | y.lesser(end).coarse(maxima.places()).simd_ge(bounds);
    let passes = walks & clear;
    let stays = walks & !clear;
    rays.more = more;
    rays.advance(passes.select(more + 1, u32x16::simd_from(land.simd, 0)));
    // Beside the map, a ray that falls under its base is over.
    let base = W::Words::splat(land.simd, stepper.base.int());
    let sinks = passes & nothing & rays.falls & end.less(base);
    let stands = stays & level.simd_eq(0);
    rays.near |= stands;
    rays.walks &= !(stands | sinks);
    let finer = stays.select(level.max(1) - 1, level);
    // Coarser blocks are worth a try where a ray comes into another one.
    let moved = (x.cell() ^ rays.place[0].cell()) | (z.cell() ^ rays.place[2].cell());
    let entered = (moved.bitcast::<u32x16<S>>() >> (level + 1)).simd_ne(0);
    rays.level = (passes & entered).select((level + 1).min(maxima.top()), finer);
    end_walks(land, rays);
}

/// Ends the walks that can no longer meet the surface, as `Stepper::is_over` says, or whose samples
/// are used up.
#[inline(always)]
pub fn end_walks<W: Packed, S: Simd>(land: &Land<'_, W, S>, rays: &mut Rays<W, S>) {
    let stepper = land.stepper;
    let used_up = rays.walks & rays.index.simd_gt(stepper.last);
    if used_up.any_true() {
        let ([x, y, z], [dx, dy, dz]) = (rays.place, rays.step);
        let (x, y, z) = ((x - dx).store(), (y - dy).store(), (z - dz).store());
        let [dx, dy, dz] = rays.step.map(Words::store);
        for lane in (0..LANES).filter(|&lane| used_up.test(lane)) {
            let last = place::<W>(x[lane], y[lane], z[lane]);
            let step = place::<W>(dx[lane], dy[lane], dz[lane]);
            let over = stepper.is_over(last, stepper.heading(step));
            rays.outcome[lane] = if over { Hit::Sky } else { Hit::Far } as i32;
        }
    }
    let [x, y, z] = rays.place;
    let [first_x, last_x, first_z, last_z] = rays.within;
    let (i, j) = (x.cell(), z.cell());
    let below_top = y.less(W::Words::splat(land.simd, stepper.top.int()));
    let over = i.simd_lt(first_x)
        | i.simd_gt(last_x)
        | j.simd_lt(first_z)
        | j.simd_gt(last_z)
        | (rays.rises & !below_top);
    rays.walks &= !(over | used_up);
}

/// A place from its bits.
#[inline(always)]
pub fn place<W: Packed>(x: W::Int, y: W::Int, z: W::Int) -> Place<W> {
    Place { x: W::Ground::of_int(x), y: W::Height::of_int(y), z: W::Ground::of_int(z) }
}

/// Puts the packet's ends on the wires.
#[inline(always)]
fn finish<W: Packed, S: Simd>(rays: &Rays<W, S>, lines: &mut [Line<W>], shape: Shape, from: usize) {
    let [x, _, z] = rays.place.map(Words::store);
    let (index, outcome) = (rays.index.to_array(), rays.outcome.to_array());
    for lane in 0..LANES {
        let (row, column) = shape.pixel(lane);
        let i = from + column;
        if row >= shape.lines || i >= lines[row].len() {
            continue;
        }
        let line = &mut lines[row];
        line.hit[i] = OUTCOMES[outcome[lane] as usize & 3];
        line.steps[i] = index[lane];
        line.work[i] = Work::default();
        line.ground_x[i] = W::Ground::of_int(x[lane]);
        line.ground_z[i] = W::Ground::of_int(z[lane]);
    }
}
