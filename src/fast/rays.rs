//! The rays of a packet: four neighbouring pixels on each of four neighbouring lines.

use fearless_simd::prelude::*;
use fearless_simd::{i32x16, mask32x16, u32x16};

use super::GROUP;
use super::land::Land;
use super::words::{LANES, Packed, Words};
use crate::frame::Hit;
use crate::unit::Line;
use crate::unit::line::Entry;
use crate::unit::stepper::Place;
use crate::word::{Lane, Site};

/// Neighbouring pixels of a line in a packet.
pub const COLUMNS: usize = LANES / GROUP;

/// Packets of a tile. They start together, and go on side by side: what one does is a long chain of
/// operations that wait for each other, and while it waits the processor works at the others'.
pub const PACKETS: usize = 4;

/// Packets that lie side by side.
pub type Tile<W, S> = [Rays<W, S>; PACKETS];

/// Outcomes by number.
const OUTCOMES: [Hit; 4] = [Hit::Sky, Hit::Surface, Hit::Side, Hit::OutOfRange];

/// A packet of rays, component by component.
#[derive(Clone, Copy)]
pub struct Rays<W: Packed, S: Simd> {
    /// The first place that has not been tested: x, y, z.
    pub place: [W::Words<S>; 3],
    /// ΔP of each ray: x, y, z.
    pub step: [W::Words<S>; 3],
    /// Index of the sample at that place.
    pub index: u32x16<S>,
    /// Block size that is tried next; behind a common start, the finest first.
    pub level: u32x16<S>,
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
    pub within: [i32x16<S>; 4],
    /// The ray does not fall.
    pub rises: mask32x16<S>,
    /// The ray does not rise, and the map has a base.
    pub falls: mask32x16<S>,
    /// Reciprocals of the packet's longest steps in x and z.
    pub inverse: [u32; 2],
    /// The longest steps in x and z, 16 fraction bits, rounded up.
    pub longest: [u64; 2],
}

impl<W: Packed, S: Simd> Rays<W, S> {
    /// A packet in which no ray walks.
    #[inline(always)]
    pub fn idle(simd: S) -> Self {
        let nowhere = [W::Words::splat(simd, W::Int::default()); 3];
        let none = u32x16::simd_from(simd, 0);
        let nothing = mask32x16::simd_from(simd, false);
        Self {
            place: nowhere,
            step: nowhere,
            index: none,
            level: none,
            walks: nothing,
            near: nothing,
            more: none,
            hits: nothing,
            outcome: i32x16::simd_from(simd, Hit::Sky as i32),
            within: [i32x16::simd_from(simd, 0); 4],
            rises: nothing,
            falls: nothing,
            inverse: [0; 2],
            longest: [0; 2],
        }
    }

    /// Takes idle rays to their first samples; lanes without a pixel stay idle.
    #[inline(always)]
    pub fn start(&mut self, land: &Land<'_, W, S>, lines: &[Line<W>], from: usize) {
        let (simd, stepper) = (land.simd, land.stepper);
        let mut entries = [Entry::Sky as i32; LANES];
        let mut view = [[W::Int::default(); LANES]; 3];
        let mut ground = [[W::Int::default(); LANES]; 2];
        for (row, line) in lines.iter().enumerate() {
            let to = row * COLUMNS;
            load(&line.entry, from, &mut entries, to, |entry| {
                // A full machine's divider speaks of rays that start at the eye, too.
                (if stepper.from_eye { Entry::Met } else { entry }) as i32
            });
            load(&line.view_x, from, &mut view[0], to, Lane::int);
            load(&line.view_y, from, &mut view[1], to, Lane::int);
            load(&line.view_z, from, &mut view[2], to, Lane::int);
            load(&line.entry_x, from, &mut ground[0], to, Lane::int);
            load(&line.entry_z, from, &mut ground[1], to, Lane::int);
        }
        let entries = i32x16::simd_from(simd, entries);
        let met = entries.simd_eq(Entry::Met as i32);
        let beyond = entries.simd_eq(Entry::OutOfRange as i32);
        let mask = |flag: bool| mask32x16::simd_from(simd, flag);
        let number = |number: i32| i32x16::simd_from(simd, number);
        let splat = |word: W::Int| W::Words::splat(simd, word);

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
        self.place = place;
        self.step = [dx, dy, dz];
        self.outcome = beyond.select(number(stepper.beyond as i32), number(Hit::Sky as i32));
        self.within = within;
        self.rises = !dy.less(none);
        self.falls = mask(stepper.sides) & !none.less(dy);
        self.inverse = [inverse::<W>(longest[0]), inverse::<W>(longest[1])];
        // 16 fraction bits.
        let places = W::Ground::FRACTION - 16;
        self.longest = [u64::from(longest[0] >> places) + 1, u64::from(longest[1] >> places) + 1];
        // A ray may be over before its first sample, or have none.
        let fallen = self.falls & place[1].less(splat(stepper.base.int()));
        self.walks = met & !fallen;
        self.end_walks(land);
        if stepper.last == 0 {
            self.outcome = self.walks.select(number(Hit::OutOfRange as i32), self.outcome);
            self.walks = mask(false);
        }
        self.advance(u32x16::simd_from(simd, 1));
    }

    /// Puts the rays' ends on the wires.
    #[inline(always)]
    pub fn finish(&self, lines: &mut [Line<W>], from: usize) {
        let (x, z) = (self.place[0].store(), self.place[2].store());
        let (index, outcome) = (self.index.to_array(), self.outcome.to_array());
        for (row, line) in lines.iter_mut().enumerate() {
            let row = row * COLUMNS;
            store(&outcome, row, &mut line.hit, from, |at| OUTCOMES[at as usize & 3]);
            store(&index, row, &mut line.steps, from, |index| index);
            store(&x, row, &mut line.ground_x, from, Lane::of_int);
            store(&z, row, &mut line.ground_z, from, Lane::of_int);
        }
    }

    /// Moves the rays that walk this many samples on.
    #[inline(always)]
    pub fn skip(&mut self, steps: u32) {
        let simd = self.index.token();
        let none = u32x16::simd_from(simd, 0);
        self.advance(self.walks.select(u32x16::simd_from(simd, steps), none));
    }

    /// Moves rays this many samples on.
    #[inline(always)]
    pub fn advance(&mut self, steps: u32x16<S>) {
        for (place, step) in self.place.iter_mut().zip(self.step) {
            *place = place.after(step, steps);
        }
        self.index += steps;
    }

    /// Ends the walks that can no longer meet the surface, as `Stepper::is_over` says, or whose
    /// samples are used up.
    #[inline(always)]
    pub fn end_walks(&mut self, land: &Land<'_, W, S>) {
        let stepper = land.stepper;
        let used_up = self.walks & self.index.simd_gt(stepper.last);
        if used_up.any_true() {
            let ([x, y, z], [dx, dy, dz]) = (self.place, self.step);
            let (x, y, z) = ((x - dx).store(), (y - dy).store(), (z - dz).store());
            let [dx, dy, dz] = self.step.map(Words::store);
            for lane in (0..LANES).filter(|&lane| used_up.test(lane)) {
                let last = place::<W>(x[lane], y[lane], z[lane]);
                let step = place::<W>(dx[lane], dy[lane], dz[lane]);
                // No stock world looks at the place of a decision.
                let anywhere = Site::pixel(0, 0);
                let over = stepper.is_over(last, stepper.heading(step, anywhere), anywhere);
                self.outcome[lane] = if over { Hit::Sky } else { Hit::OutOfRange } as i32;
            }
        }
        let [x, y, z] = self.place;
        let [first_x, last_x, first_z, last_z] = self.within;
        let (i, j) = (x.cell(), z.cell());
        let below_top = y.less(W::Words::splat(land.simd, stepper.top.int()));
        let over = i.simd_lt(first_x)
            | i.simd_gt(last_x)
            | j.simd_lt(first_z)
            | j.simd_gt(last_z)
            | (self.rises & !below_top);
        self.walks &= !(over | used_up);
    }
}

/// Whether there is a ray that walks.
#[inline(always)]
pub fn any_walks<W: Packed, S: Simd>(tile: &Tile<W, S>) -> bool {
    let mut any = false;
    for rays in tile {
        any |= rays.walks.any_true();
    }
    any
}

/// Copies a line's part of a packet from a wire, as far as the line goes. A whole part has a length
/// that the compiler knows: it is copied at once.
#[inline(always)]
fn load<T: Copy, U>(
    wire: &[T],
    from: usize,
    lanes: &mut [U; LANES],
    to: usize,
    of: impl Fn(T) -> U,
) {
    let wire = wire.get(from..).unwrap_or_default();
    let lanes = &mut lanes[to..to + COLUMNS];
    if let Some(wire) = wire.first_chunk::<COLUMNS>() {
        for (lane, &word) in lanes.iter_mut().zip(wire) {
            *lane = of(word);
        }
    } else {
        for (lane, &word) in lanes.iter_mut().zip(wire) {
            *lane = of(word);
        }
    }
}

/// Copies a line's part of a packet to a wire, as far as the line goes; see [`load`].
#[inline(always)]
fn store<T: Copy, U>(
    lanes: &[T; LANES],
    from: usize,
    wire: &mut [U],
    to: usize,
    of: impl Fn(T) -> U,
) {
    let wire = wire.get_mut(to..).unwrap_or_default();
    let lanes = &lanes[from..from + COLUMNS];
    if let Some(wire) = wire.first_chunk_mut::<COLUMNS>() {
        for (word, &lane) in wire.iter_mut().zip(lanes) {
            *word = of(lane);
        }
    } else {
        for (word, &lane) in wire.iter_mut().zip(lanes) {
            *word = of(lane);
        }
    }
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

/// A place from its bits.
#[inline(always)]
fn place<W: Packed>(x: W::Int, y: W::Int, z: W::Int) -> Place<W> {
    Place { x: W::Ground::of_int(x), y: W::Height::of_int(y), z: W::Ground::of_int(z) }
}
