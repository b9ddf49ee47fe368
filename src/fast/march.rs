//! The ray stepper, many rays at a time: the same first sample under the surface as
//! `unit::stepper`, found by lanes that walk in step.
//!
//! Loops over lanes are plain and branch-free, so that they vectorise; loads from the pyramid and
//! the map stand in loops of their own. Lanes alternate between trials of the pyramid and single
//! samples. A sample at or above its cell's highest node is clear without interpolation, which is
//! exact because every kernel stays within its nodes.

use super::heights::{LANES, heights};
use crate::frame::Hit;
use crate::unit::Line;
use crate::unit::interpolator::Interpolator;
use crate::unit::line::{Entry, Work};
use crate::unit::pyramid::Pyramid;
use crate::unit::stepper::{Heading, Place, Stepper, SurfaceUnit};
use crate::word::{Cell, Interpolating, Site, Word as _, World};

/// One per lane: 1 where something holds, else 0. Numbers of the words' width mix with them in
/// vectors, `bool`s would not.
type Flags = [u32; LANES];

/// The rays of a group, component by component.
struct Lanes<W: World> {
    x: [W::Ground; LANES],
    y: [W::Height; LANES],
    z: [W::Ground; LANES],
    dx: [W::Ground; LANES],
    dy: [W::Height; LANES],
    dz: [W::Ground; LANES],
    /// Cells outside of which the ray has left the map behind: first and last, x and z.
    within: [[i32; LANES]; 4],
    /// The ray does not fall.
    rises: Flags,
    /// The ray does not rise, and the map has sides.
    falls: Flags,
    index: [u32; LANES],
    level: [u32; LANES],
    /// Samples left before jumps are tried again.
    run: [u32; LANES],
    /// Tries jumps.
    walks: Flags,
    /// Tests single samples.
    samples: Flags,
    /// Has found its first sample under the surface.
    hits: Flags,
    outcome: [Hit; LANES],
    site: [Site; LANES],
}

#[inline(always)]
fn any(flags: &Flags) -> bool {
    flags.iter().fold(0, |any, flag| any | flag) != 0
}

/// Drives `hit`, `ground_x`, `ground_z` and `steps` of one line as the stepper does. Work is not
/// counted here: trials are the processor's.
#[inline(always)]
pub fn run<W: Interpolating>(stepper: &Stepper<W>, surface: &Interpolator<W>, line: &mut Line<W>) {
    let Some(pyramid) = stepper.pyramid.as_deref() else {
        // Without bounds every sample is tested, as the processor does.
        return stepper.run(line, surface);
    };
    let mut from = 0;
    while from < line.len() {
        let to = (from + LANES).min(line.len());
        let mut lanes = start(stepper, line, from, to);
        while any(&lanes.walks) {
            while any(&lanes.walks) {
                trial(stepper, pyramid, &mut lanes);
            }
            while any(&lanes.samples) {
                sample(stepper, surface, pyramid, &mut lanes);
            }
        }
        miss(stepper, &mut lanes);
        refine(stepper, surface, &mut lanes);
        finish(&lanes, line, from, to);
        from = to;
    }
}

impl<W: World> Lanes<W> {
    #[inline(always)]
    fn place(&self, lane: usize) -> Place<W> {
        Place { x: self.x[lane], y: self.y[lane], z: self.z[lane] }
    }

    #[inline(always)]
    fn step(&self, lane: usize) -> Place<W> {
        Place { x: self.dx[lane], y: self.dy[lane], z: self.dz[lane] }
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
        self.falls[lane] = u32::from(heading.falls);
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, place: Place<W>) {
        (self.x[lane], self.y[lane], self.z[lane]) = (place.x, place.y, place.z);
    }
}

/// The rays `from..to` of a line at their starts; lanes without a ray are done.
#[inline(always)]
fn start<W: World>(stepper: &Stepper<W>, line: &Line<W>, from: usize, to: usize) -> Lanes<W> {
    let eye = stepper.eye();
    let site = Site::pixel(line.number, 0);
    let mut lanes = Lanes {
        x: [eye.x; LANES],
        y: [eye.y; LANES],
        z: [eye.z; LANES],
        dx: [eye.x; LANES],
        dy: [eye.y; LANES],
        dz: [eye.z; LANES],
        within: [[0; LANES]; 4],
        rises: [0; LANES],
        falls: [0; LANES],
        index: [0; LANES],
        level: [0; LANES],
        run: [0; LANES],
        walks: [0; LANES],
        samples: [0; LANES],
        hits: [0; LANES],
        outcome: [Hit::Sky; LANES],
        site: [site; LANES],
    };
    for (lane, i) in (from..to).enumerate() {
        let entry = if stepper.from_eye { Entry::Met } else { line.entry[i] };
        lanes.site[lane] = Site { column: line.column[i], ..site };
        match entry {
            Entry::Sky => continue,
            Entry::Far => {
                lanes.outcome[lane] = stepper.beyond;
                continue;
            }
            Entry::Met => {}
        }
        if !stepper.from_eye {
            lanes.x[lane] = line.ground_x[i];
            lanes.y[lane] = stepper.top;
            lanes.z[lane] = line.ground_z[i];
        }
        let step = stepper.step(line.view_x[i], line.view_y[i], line.view_z[i], lanes.site[lane]);
        (lanes.dx[lane], lanes.dy[lane], lanes.dz[lane]) = (step.x, step.y, step.z);
        lanes.head(lane, stepper.heading(step), stepper.extent);
        lanes.walks[lane] = 1;
    }
    lanes
}

/// One trial of every walking lane.
#[inline(always)]
fn trial<W: World>(stepper: &Stepper<W>, pyramid: &Pyramid<W::Height>, lanes: &mut Lanes<W>) {
    let (cells_x, cells_z) = cells(&lanes.x, &lanes.z);
    // Loads, lane by lane; a lane out of reach of the map has no bound.
    let mut bound = [stepper.base; LANES];
    let mut free = [1; LANES];
    let mut addresses = [0; LANES];
    for lane in 0..LANES {
        let (stored, address) = pyramid.address(lanes.level[lane], cells_x[lane], cells_z[lane]);
        free[lane] = u32::from(!stored);
        addresses[lane] = if stored { address } else { 0 };
    }
    for lane in 0..LANES {
        bound[lane] = pyramid.at(addresses[lane]);
    }
    let over = over(stepper, lanes, &cells_x, &cells_z);
    let top = pyramid.top();
    for lane in 0..LANES {
        let walks = lanes.walks[lane];
        let left = stepper.last.wrapping_sub(lanes.index[lane]);
        let level = lanes.level[lane];
        let shift = level + stepper.fineness;
        let jump = 1_u32 << shift;
        let x = lanes.x[lane] + lanes.dx[lane].shift_left(shift);
        let y = lanes.y[lane] + lanes.dy[lane].shift_left(shift);
        let z = lanes.z[lane] + lanes.dz[lane].shift_left(shift);
        let above = u32::from(lanes.y[lane] >= bound[lane]) & u32::from(y >= bound[lane]);
        let ends = over[lane] | u32::from(left == 0);
        let goes_on = walks & (ends ^ 1);
        let clear = goes_on & u32::from(jump <= left) & (free[lane] | above);
        let jumps = clear == 1;
        lanes.x[lane] = if jumps { x } else { lanes.x[lane] };
        lanes.y[lane] = if jumps { y } else { lanes.y[lane] };
        lanes.z[lane] = if jumps { z } else { lanes.z[lane] };
        lanes.index[lane] += if jumps { jump } else { 0 };
        let tests = goes_on & (clear ^ 1) & u32::from(level == 0);
        let lower = level.saturating_sub(goes_on);
        lanes.level[lane] = if jumps { (level + 1).min(top) } else { lower };
        let run = (1 << stepper.fineness).min(left);
        lanes.run[lane] = if tests == 1 { run } else { lanes.run[lane] };
        lanes.samples[lane] |= tests;
        lanes.walks[lane] = goes_on & (tests ^ 1);
    }
}

/// Cells of all lanes.
#[inline(always)]
fn cells<T: Cell>(x: &[T; LANES], z: &[T; LANES]) -> ([i32; LANES], [i32; LANES]) {
    let (mut cells_x, mut cells_z) = ([0; LANES], [0; LANES]);
    for lane in 0..LANES {
        cells_x[lane] = x[lane].cell();
        cells_z[lane] = z[lane].cell();
    }
    (cells_x, cells_z)
}

/// Whether lanes can no longer meet the surface, as `Stepper::is_over` says.
#[inline(always)]
fn over<W: World>(
    stepper: &Stepper<W>,
    lanes: &Lanes<W>,
    cells_x: &[i32; LANES],
    cells_z: &[i32; LANES],
) -> Flags {
    let mut over = [0; LANES];
    let [first_x, last_x, first_z, last_z] = &lanes.within;
    for lane in 0..LANES {
        let (i, j) = (cells_x[lane], cells_z[lane]);
        over[lane] = u32::from(i < first_x[lane])
            | u32::from(i > last_x[lane])
            | u32::from(j < first_z[lane])
            | u32::from(j > last_z[lane])
            | (lanes.rises[lane] & u32::from(lanes.y[lane] >= stepper.top))
            | (lanes.falls[lane] & u32::from(lanes.y[lane] < stepper.base));
    }
    over
}

/// One sample of every sampling lane.
#[inline(always)]
fn sample<W: Interpolating>(
    stepper: &Stepper<W>,
    surface: &Interpolator<W>,
    pyramid: &Pyramid<W::Height>,
    lanes: &mut Lanes<W>,
) {
    for lane in 0..LANES {
        let samples = lanes.samples[lane];
        let steps = samples == 1;
        let x = lanes.x[lane] + lanes.dx[lane];
        let y = lanes.y[lane] + lanes.dy[lane];
        let z = lanes.z[lane] + lanes.dz[lane];
        lanes.x[lane] = if steps { x } else { lanes.x[lane] };
        lanes.y[lane] = if steps { y } else { lanes.y[lane] };
        lanes.z[lane] = if steps { z } else { lanes.z[lane] };
        lanes.index[lane] += samples;
        lanes.run[lane] = lanes.run[lane].wrapping_sub(samples);
    }
    let (cells_x, cells_z) = cells(&lanes.x, &lanes.z);
    let over = over(stepper, lanes, &cells_x, &cells_z);
    let memory = &*surface.heights;
    let mut inside = [0; LANES];
    for lane in 0..LANES {
        inside[lane] = u32::from(memory.contains(cells_x[lane], cells_z[lane]));
    }
    let mut highest = [stepper.base; LANES];
    for lane in 0..LANES {
        highest[lane] = pyramid.cell(memory.column(cells_x[lane]), memory.row(cells_z[lane]));
    }
    let mut near = [0; LANES];
    for lane in 0..LANES {
        let samples = lanes.samples[lane];
        near[lane] = inside[lane] & samples & u32::from(lanes.y[lane] < highest[lane]);
        let back = samples & ((inside[lane] ^ 1) & over[lane] | u32::from(lanes.run[lane] == 0));
        lanes.samples[lane] = samples & (back ^ 1);
        lanes.walks[lane] |= back;
    }
    // Few lanes are this near to the surface at once: one by one is faster than all together.
    for lane in 0..LANES {
        if near[lane] == 1 && !surface.is_hole(lanes.x[lane], lanes.z[lane]) {
            let site = lanes.site[lane].step(lanes.index[lane] << 3);
            if lanes.y[lane] < surface.height(lanes.x[lane], lanes.z[lane], site) {
                (lanes.hits[lane], lanes.samples[lane], lanes.walks[lane]) = (1, 0, 0);
            }
        }
    }
}

/// Outcomes of the lanes that walked and did not hit: the last index came before the ray was over.
#[inline(always)]
fn miss<W: World>(stepper: &Stepper<W>, lanes: &mut Lanes<W>) {
    let (cells_x, cells_z) = cells(&lanes.x, &lanes.z);
    let over = over(stepper, lanes, &cells_x, &cells_z);
    for lane in 0..LANES {
        let stopped = lanes.hits[lane] == 0 && lanes.index[lane] >= stepper.last;
        if stopped && over[lane] == 0 {
            lanes.outcome[lane] = Hit::Far;
        }
    }
}

/// Halves the last step of every lane that has hit, all lanes at once.
#[inline(always)]
fn refine<W: Interpolating>(stepper: &Stepper<W>, surface: &Interpolator<W>, lanes: &mut Lanes<W>) {
    if !any(&lanes.hits) {
        return;
    }
    let mut times = [0_u32; LANES];
    let samples: [Place<W>; LANES] = std::array::from_fn(|lane| lanes.place(lane));
    for lane in 0..LANES {
        let hit = lanes.hits[lane] == 1;
        times[lane] = if hit { stepper.halvings_at(lanes.place(lane)) } else { 0 };
        if hit {
            lanes.set(lane, lanes.place(lane).minus(lanes.step(lane)));
        }
    }
    let most = times.iter().fold(0, |most, &t| most.max(t));
    for halving in 1..=most {
        let mut x = lanes.x;
        let mut y = lanes.y;
        let mut z = lanes.z;
        let mut sites = lanes.site;
        for lane in 0..LANES {
            let middle = lanes.place(lane).plus(lanes.step(lane).halved(halving));
            (x[lane], y[lane], z[lane]) = (middle.x, middle.y, middle.z);
            sites[lane] = lanes.site[lane].step(1 << 30 | halving << 3);
        }
        let surfaces = heights(surface, &x, &z, &sites);
        for lane in 0..LANES {
            let inside = u32::from(surface.contains(x[lane], z[lane]));
            let under = inside & u32::from(y[lane] < surfaces[lane]);
            let moves = u32::from(halving <= times[lane]) & (under ^ 1) == 1;
            lanes.x[lane] = if moves { x[lane] } else { lanes.x[lane] };
            lanes.y[lane] = if moves { y[lane] } else { lanes.y[lane] };
            lanes.z[lane] = if moves { z[lane] } else { lanes.z[lane] };
        }
    }
    for lane in 0..LANES {
        if lanes.hits[lane] == 0 {
            continue;
        }
        let (clear, step) = (lanes.place(lane), lanes.step(lane));
        let middle = clear.plus(step.halved(times[lane] + 1));
        if surface.contains(clear.x, clear.z) && surface.contains(middle.x, middle.z) {
            lanes.outcome[lane] = Hit::Surface;
            lanes.set(lane, middle);
        } else {
            // At sides, which are few, the stepper itself.
            let (site, index) = (lanes.site[lane], lanes.index[lane]);
            let walk = stepper.refine(samples[lane], step, surface, site, index, Work::default());
            lanes.outcome[lane] = walk.hit;
            lanes.set(lane, walk.place);
        }
    }
}

/// Puts the group's ends on the wires.
#[inline(always)]
fn finish<W: World>(lanes: &Lanes<W>, line: &mut Line<W>, from: usize, to: usize) {
    for (lane, i) in (from..to).enumerate() {
        line.hit[i] = lanes.outcome[lane];
        line.steps[i] = lanes.index[lane];
        line.work[i] = Work::default();
        line.ground_x[i] = lanes.x[lane];
        line.ground_z[i] = lanes.z[lane];
    }
}
