//! The ray stepper, a packet of rays at a time: the same first sample under the surface as
//! `unit::stepper`.
//!
//! A ray visits the blocks of the map that its samples lie in, coarse ones where it is high, finer
//! ones near the ground. The last sample in a block is known from the block's far side and the
//! reciprocal of the step, rounded so that it never lies beyond. If first and last sample are at or
//! above the block's highest node, no sample between them hits (samples of a ray lie on a line, the
//! surface stays within its nodes), and the ray goes on with the first sample after it. In a single
//! cell that is not passed so, `solve` finds the first sample under the surface.
//!
//! Loops over lanes are plain and branch-free, so that they vectorise; loads stand in loops of
//! their own.

use super::maxima::{Maxima, NOTHING};
use super::{refine, solve};
use crate::frame::Hit;
use crate::setup::TerrainUnits;
use crate::unit::Line;
use crate::unit::interpolator::Interpolator;
use crate::unit::line::{Entry, Work};
use crate::unit::stepper::{Heading, Place, Stepper};
use crate::word::{Cell, Enter as _, Interpolating, Lane, Site, Word as _, World};

/// Rays that walk together.
pub const LANES: usize = 16;

/// One per lane: 1 where something holds, else 0. Numbers of the words' width mix with them in
/// vectors, `bool`s would not.
pub type Flags = [u32; LANES];

/// A world whose words are plain integers: the stock worlds.
pub trait Packed:
    Interpolating + World<View: Lane, Ground: Lane, Height: Lane, Weight: Lane>
{
}
impl<W> Packed for W where
    W: Interpolating + World<View: Lane, Ground: Lane, Height: Lane, Weight: Lane>
{
}

/// What a walk needs to know of the map.
pub struct Land<'a, W: World> {
    /// The machine's stepper.
    pub stepper: &'a Stepper<W>,
    /// The machine's interpolator.
    pub surface: &'a Interpolator<W>,
    /// Highest nodes.
    pub maxima: &'a Maxima,
}

/// A packet of rays, component by component.
pub struct Rays<W: World> {
    /// The first place that has not been tested.
    pub x: [W::Ground; LANES],
    /// Its height.
    pub y: [W::Height; LANES],
    /// Its z.
    pub z: [W::Ground; LANES],
    /// Step.
    pub dx: [W::Ground; LANES],
    /// Step in height.
    pub dy: [W::Height; LANES],
    /// Step in z.
    pub dz: [W::Ground; LANES],
    /// Index of the sample at that place.
    pub index: [u32; LANES],
    /// Cells outside of which the ray has left the map behind: first and last, x and z.
    within: [[i32; LANES]; 4],
    /// The ray does not fall.
    rises: Flags,
    /// The ray does not rise, and the map has a base.
    falls: Flags,
    level: [u32; LANES],
    /// Looks for a block that it does not pass.
    pub walks: Flags,
    /// Stands in a cell that it may not pass.
    pub near: Flags,
    /// More samples of the ray in that cell.
    pub more: [u32; LANES],
    /// Stands at its first sample under the surface.
    pub hits: Flags,
    /// What becomes of a ray that does not hit.
    pub outcome: [Hit; LANES],
    /// Reciprocals of the longest steps in x and z.
    inverse: [u32; 2],
    /// The longest steps in x and z.
    pub longest: [W::Ground; 2],
}

/// Whether any flag is set.
#[inline(always)]
pub fn any(flags: &Flags) -> bool {
    flags.iter().fold(0, |any, flag| any | flag) != 0
}

/// Runs the stepper on neighbouring lines: `run` where the map repeats nowhere and has maxima.
#[inline(always)]
pub fn walk<W: Packed>(units: &TerrainUnits<W>, lines: &mut [Line<W>]) {
    let (stepper, surface) = (&units.stepper, &units.interpolator);
    match units.maxima.as_deref() {
        Some(maxima) => run(&Land { stepper, surface, maxima }, lines),
        None => lines.iter_mut().for_each(|line| stepper.run(line, surface)),
    }
}

/// Drives `hit`, `ground_x`, `ground_z` and `steps` of neighbouring lines as the stepper does. Work
/// is not counted here: trials are the processor's.
#[inline(always)]
pub fn run<W: Packed>(land: &Land<'_, W>, lines: &mut [Line<W>]) {
    let shape = Shape { lines: lines.len(), width: LANES / lines.len() };
    let columns = lines.first().map_or(0, Line::len);
    let mut from = 0;
    while from < columns {
        let mut rays = start(land.stepper, lines, shape, from);
        while any(&rays.walks) {
            while any(&rays.walks) {
                trial(land, &mut rays);
            }
            if any(&rays.near) {
                solve::run(land, &mut rays);
            }
        }
        refine::run(land, &mut rays);
        finish(&rays, lines, shape, from);
        from += shape.width;
    }
}

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

impl<W: World> Rays<W> {
    /// The place of a lane.
    #[inline(always)]
    pub fn place(&self, lane: usize) -> Place<W> {
        Place { x: self.x[lane], y: self.y[lane], z: self.z[lane] }
    }

    /// The step of a lane.
    #[inline(always)]
    pub fn step(&self, lane: usize) -> Place<W> {
        Place { x: self.dx[lane], y: self.dy[lane], z: self.dz[lane] }
    }

    /// Moves a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, place: Place<W>) {
        (self.x[lane], self.y[lane], self.z[lane]) = (place.x, place.y, place.z);
    }

    /// Where a ray ends, from where it is heading.
    #[inline(always)]
    fn head(&mut self, lane: usize, heading: Heading, extent: Option<(i32, i32)>) {
        let within = extent.map_or([i32::MIN, i32::MAX, i32::MIN, i32::MAX], |(columns, rows)| {
            [
                if heading.west { 0 } else { i32::MIN },
                if heading.east { columns - 2 } else { i32::MAX },
                if heading.north { 0 } else { i32::MIN },
                if heading.south { rows - 2 } else { i32::MAX },
            ]
        });
        for (all, one) in self.within.iter_mut().zip(within) {
            all[lane] = one;
        }
        self.rises[lane] = u32::from(heading.rises);
        self.falls[lane] = u32::from(heading.falls && extent.is_some());
    }
}

/// The rays of a packet at their first samples; lanes without a ray are done.
#[inline(always)]
fn start<W: Packed>(
    stepper: &Stepper<W>,
    lines: &[Line<W>],
    shape: Shape,
    from: usize,
) -> Rays<W> {
    let eye = stepper.eye();
    let still = eye.minus(eye);
    let mut rays = Rays {
        x: [eye.x; LANES],
        y: [eye.y; LANES],
        z: [eye.z; LANES],
        dx: [still.x; LANES],
        dy: [still.y; LANES],
        dz: [still.z; LANES],
        index: [1; LANES],
        within: [[0; LANES]; 4],
        rises: [0; LANES],
        falls: [0; LANES],
        level: [0; LANES],
        walks: [0; LANES],
        near: [0; LANES],
        more: [0; LANES],
        hits: [0; LANES],
        outcome: [Hit::Sky; LANES],
        inverse: [0; 2],
        longest: [still.x, still.z],
    };
    for lane in 0..LANES {
        let (row, column) = shape.pixel(lane);
        let i = from + column;
        if row >= shape.lines || i >= lines[row].len() {
            continue;
        }
        let line = &lines[row];
        match if stepper.from_eye { Entry::Met } else { line.entry[i] } {
            Entry::Sky => continue,
            Entry::Far => {
                rays.outcome[lane] = stepper.beyond;
                continue;
            }
            Entry::Met => {}
        }
        let place = if stepper.from_eye {
            eye
        } else {
            Place { x: line.ground_x[i], y: stepper.top, z: line.ground_z[i] }
        };
        let site = Site::pixel(line.number, line.column[i]);
        let step = stepper.step(line.view_x[i], line.view_y[i], line.view_z[i], site);
        let heading = stepper.heading(step);
        if stepper.is_over(place, heading) {
            continue;
        }
        if stepper.last == 0 {
            rays.outcome[lane] = Hit::Far;
            continue;
        }
        rays.set(lane, place.plus(step));
        (rays.dx[lane], rays.dy[lane], rays.dz[lane]) = (step.x, step.y, step.z);
        rays.head(lane, heading, stepper.extent);
        rays.walks[lane] = 1;
    }
    for lane in 0..LANES {
        let (x, z) = (rays.dx[lane].magnitude(), rays.dz[lane].magnitude());
        let [longest_x, longest_z] = rays.longest;
        rays.longest = [
            if x > longest_x { x } else { longest_x },
            if z > longest_z { z } else { longest_z },
        ];
    }
    rays.inverse = [rays.longest[0].inverse(), rays.longest[1].inverse()];
    rays
}

/// One block of every walking lane: passed, or looked at more closely.
#[inline(always)]
fn trial<W: Packed>(land: &Land<'_, W>, rays: &mut Rays<W>) {
    let (stepper, maxima) = (land.stepper, land.maxima);
    let mut held = [1; LANES];
    let mut addresses = [0; LANES];
    for lane in 0..LANES {
        (addresses[lane], held[lane]) =
            maxima.address(rays.level[lane], rays.x[lane].cell(), rays.z[lane].cell());
    }
    let mut bounds = [0; LANES];
    for lane in 0..LANES {
        bounds[lane] = i32::from(maxima.at(addresses[lane]));
    }
    let [inverse_x, inverse_z] = rays.inverse;
    for lane in 0..LANES {
        let walks = rays.walks[lane];
        let level = rays.level[lane];
        let (x, y, z) = (rays.x[lane], rays.y[lane], rays.z[lane]);
        let (dx, dy, dz) = (rays.dx[lane], rays.dy[lane], rays.dz[lane]);
        let more = x.steps_within(dx, level, inverse_x);
        let more = more.min(z.steps_within(dz, level, inverse_z));
        let more = more.min(stepper.last.wrapping_sub(rays.index[lane]));
        let end = y.after(dy, more);
        let low = if end < y { end } else { y };
        let nothing = (held[lane] ^ 1) | u32::from(bounds[lane] == i32::from(NOTHING));
        let clear = nothing | u32::from(low.coarse(maxima.places()) >= bounds[lane]);
        let passes = walks & clear;
        let steps = if passes == 1 { more + 1 } else { 0 };
        rays.x[lane] = x.after(dx, steps);
        rays.y[lane] = y.after(dy, steps);
        rays.z[lane] = z.after(dz, steps);
        rays.index[lane] += steps;
        rays.more[lane] = more;
        // Beside the map, a ray that falls under its base is over.
        let sinks = passes & nothing & rays.falls[lane] & u32::from(end < stepper.base);
        let stands = walks & (clear ^ 1) & u32::from(level == 0);
        rays.near[lane] |= stands;
        rays.walks[lane] = walks & (stands ^ 1) & (sinks ^ 1);
        let finer = level.saturating_sub(walks & (clear ^ 1));
        rays.level[lane] = if passes == 1 { (level + 1).min(maxima.top()) } else { finer };
    }
    end(stepper, rays);
}

/// Ends the walks that can no longer meet the surface, as `Stepper::is_over` says, or whose samples
/// are used up.
#[inline(always)]
pub fn end<W: Packed>(stepper: &Stepper<W>, rays: &mut Rays<W>) {
    let mut out = [0; LANES];
    for lane in 0..LANES {
        out[lane] = rays.walks[lane] & u32::from(rays.index[lane] > stepper.last);
    }
    if any(&out) {
        for lane in 0..LANES {
            if out[lane] == 1 {
                let step = rays.step(lane);
                let last = rays.place(lane).minus(step);
                let over = stepper.is_over(last, stepper.heading(step));
                rays.outcome[lane] = if over { Hit::Sky } else { Hit::Far };
            }
        }
    }
    let [first_x, last_x, first_z, last_z] = &rays.within;
    for lane in 0..LANES {
        let (i, j) = (rays.x[lane].cell(), rays.z[lane].cell());
        let over = u32::from(i < first_x[lane])
            | u32::from(i > last_x[lane])
            | u32::from(j < first_z[lane])
            | u32::from(j > last_z[lane])
            | (rays.rises[lane] & u32::from(rays.y[lane] >= stepper.top));
        rays.walks[lane] &= (over | out[lane]) ^ 1;
    }
}

/// Puts the packet's ends on the wires.
#[inline(always)]
fn finish<W: World>(rays: &Rays<W>, lines: &mut [Line<W>], shape: Shape, from: usize) {
    for lane in 0..LANES {
        let (row, column) = shape.pixel(lane);
        let i = from + column;
        if row >= shape.lines || i >= lines[row].len() {
            continue;
        }
        let line = &mut lines[row];
        line.hit[i] = rays.outcome[lane];
        line.steps[i] = rays.index[lane];
        line.work[i] = Work::default();
        line.ground_x[i] = rays.x[lane];
        line.ground_z[i] = rays.z[lane];
    }
}
