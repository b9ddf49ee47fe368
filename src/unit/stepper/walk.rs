//! The walk of one ray: samples and jumps to its end, and the bisection behind its hit.

use super::super::line::Work;
use super::super::surface_unit::SurfaceUnit;
use super::{Place, Stepper};
use crate::frame::Hit;
use crate::word::{Register, Site, Word as _, World};

/// Directions of a ray, decided once: where it can no longer meet the map.
#[derive(Clone, Copy, Debug)]
pub struct Heading {
    /// Not towards greater x.
    pub west: bool,
    /// Not towards smaller x.
    pub east: bool,
    /// Not towards greater z.
    pub north: bool,
    /// Not towards smaller z.
    pub south: bool,
    /// Not downwards.
    pub rises: bool,
    /// Not upwards, on a map with sides: below the base it can meet nothing.
    pub falls: bool,
}

/// The end of a walk.
#[derive(Clone, Copy, Debug)]
pub struct Walk<W: World> {
    /// What the ray meets.
    pub hit: Hit,
    /// Refined place of a hit; elsewhere the last place reached.
    pub place: Place<W>,
    /// Index of the sample that hit, or of the last one.
    pub index: u32,
    /// What the walk took.
    pub work: Work,
}

impl<W: World> Stepper<W> {
    /// Walks one ray to its end.
    pub fn walk(
        &self,
        start: Place<W>,
        step: Place<W>,
        surface: &impl SurfaceUnit<W>,
        site: Site,
    ) -> Walk<W> {
        let heading = self.heading(step, site);
        let mut work = Work::default();
        let mut place = start;
        let mut index = 0;
        // Rays from the eye start near the ground, those from the slab's top above it.
        let mut level = 0;
        loop {
            let here = at_sample(site, index);
            if self.is_over(place, heading, here) {
                return Walk { hit: Hit::Sky, place, index, work };
            }
            if index >= self.last {
                return Walk { hit: Hit::OutOfRange, place, index, work };
            }
            let mut run = 1;
            if let Some(pyramid) = &self.pyramid {
                let jump = 1 << (level + self.fineness);
                if jump <= self.last - index {
                    work.skip_tests += 1;
                    let ahead = place.plus(step.doubled(level + self.fineness));
                    let [i, j] = place.cell(here);
                    let there = at_sample(site, index + jump);
                    if pyramid.bound(level, i, j).is_none_or(|bound| {
                        !place.y.is_below(bound, here.at(Register::Node))
                            && !ahead.y.is_below(bound, there.at(Register::Node))
                    }) {
                        place = ahead;
                        index += jump;
                        level = (level + 1).min(pyramid.top());
                        continue;
                    }
                }
                if level > 0 {
                    level -= 1;
                    continue;
                }
                // No jump is clear: test the samples of one cell before trying again.
                run = (1 << self.fineness).min(self.last - index);
            }
            work.bursts += 1;
            for _ in 0..run {
                place = place.plus(step);
                index += 1;
                // Whether the surface exists there is known when the nodes have been read.
                work.samples += 1;
                let here = at_sample(site, index);
                if !surface.contains(place.x, place.z, here) {
                    if self.is_over(place, heading, here) {
                        break;
                    }
                    continue;
                }
                if place.is_under(surface, here) {
                    return self.refine(place, step, surface, site, index, work);
                }
            }
        }
    }

    /// Halves the step between the last clear place and the hit.
    pub fn refine(
        &self,
        hit: Place<W>,
        step: Place<W>,
        surface: &impl SurfaceUnit<W>,
        site: Site,
        index: u32,
        mut work: Work,
    ) -> Walk<W> {
        work.hits = 1;
        let times = self.bisection_steps_at(hit, at_sample(site, index));
        let (mut clear, mut met) = (hit.minus(step), hit);
        for round in 1..=times {
            work.bisection_steps += 1;
            let middle = clear.plus(step.halved(round));
            let here = at_bisection(site, round);
            if surface.contains(middle.x, middle.z, here) && middle.is_under(surface, here) {
                met = middle;
            } else {
                clear = middle;
            }
        }
        let site = at_bisection(site, times + 1);
        if surface.contains(clear.x, clear.z, site) {
            // The middle of the last interval halves the error for one more addition.
            let middle = clear.plus(step.halved(times + 1));
            let place = if surface.contains(middle.x, middle.z, site) { middle } else { met };
            Walk { hit: Hit::Surface, place, index, work }
        } else {
            Walk { hit: self.beside(met, step, site), place: met, index, work }
        }
    }

    /// What a ray meets where it comes from beside the map or out of a hole under the surface: the
    /// side, down to the base.
    #[inline(always)]
    pub fn beside(&self, place: Place<W>, step: Place<W>, site: Site) -> Hit {
        let fallen = !step.y.is_positive(site.at(Register::DRayY))
            && place.y.is_below(self.base, site.at(Register::RayY));
        if fallen { Hit::Sky } else { Hit::Side }
    }

    /// Where a ray of this step is heading.
    #[inline(always)]
    pub fn heading(&self, step: Place<W>, site: Site) -> Heading {
        let (x, y, z) =
            (site.at(Register::DGroundX), site.at(Register::DRayY), site.at(Register::DGroundZ));
        Heading {
            west: !step.x.is_positive(x),
            east: !step.x.is_negative(x),
            north: !step.z.is_positive(z),
            south: !step.z.is_negative(z),
            rises: !step.y.is_negative(y),
            falls: self.sides && !step.y.is_positive(y),
        }
    }

    /// Whether the ray can no longer meet the surface.
    #[inline(always)]
    pub fn is_over(&self, place: Place<W>, heading: Heading, site: Site) -> bool {
        let y = site.at(Register::RayY);
        if (heading.rises && !place.y.is_below(self.top, y))
            || (heading.falls && place.y.is_below(self.base, y))
        {
            return true;
        }
        let Some((columns, rows)) = self.extent else { return false };
        let [i, j] = place.cell(site);
        (heading.west && i < 0)
            || (heading.east && i >= columns - 1)
            || (heading.north && j < 0)
            || (heading.south && j >= rows - 1)
    }
}

/// Where a sample of the ray is looked at.
#[inline(always)]
fn at_sample(site: Site, index: u32) -> Site {
    site.step(index << 3)
}

/// Where a bisection step is, apart from all samples.
#[inline(always)]
fn at_bisection(site: Site, round: u32) -> Site {
    site.step(1 << 30 | round << 3)
}
