//! The first crossing against dense marching over an independent surface.

use glam::DVec3;

use super::{Dice, Naive, kernels, oracle, rough_map, scene, terrain, with_holes};
use crate::frame::Hit;
use crate::oracle::{Oracle, Sighting};
use crate::scene::{HeightMap, Outside, Surface, Terrain};

/// Steps of the march per cell.
const FINENESS: f64 = 300.0;
/// Cells that a ray is followed over a map without end.
const REACH: f64 = 40.0;
/// Cells after which a ray has left a small map that ends.
const ACROSS: f64 = 130.0;

/// The march of one ray.
struct March<'a> {
    naive: Naive<'a>,
    eye: DVec3,
    direction: DVec3,
    /// λ from one sample to the next.
    step: f64,
}

impl<'a> March<'a> {
    fn new(
        terrain: &'a Terrain,
        kernel: crate::scene::Kernel,
        eye: DVec3,
        direction: DVec3,
    ) -> Self {
        let cells = (direction.x / terrain.cell.x).abs().max((direction.z / terrain.cell.y).abs());
        Self { naive: Naive { terrain, kernel }, eye, direction, step: 1.0 / (cells * FINENESS) }
    }

    /// Whether the point at λ is in the solid.
    fn is_inside(&self, lambda: f64) -> bool {
        let p = self.eye + self.direction * lambda;
        self.naive.is_over(p.x, p.z) && p.y < self.naive.height(p.x, p.z)
    }

    fn is_over(&self, lambda: f64) -> bool {
        let p = self.eye + self.direction * lambda;
        self.naive.is_over(p.x, p.z)
    }

    /// Index of the first sample in the solid, or the reason why there is none.
    fn first(&self) -> Result<usize, Hit> {
        let terrain = self.naive.terrain;
        let (low, high) = terrain.range();
        let ends = terrain.outside == Outside::Sky;
        for n in 0.. {
            let lambda = n as f64 * self.step;
            let y = self.eye.y + lambda * self.direction.y;
            if self.is_inside(lambda) {
                return Ok(n);
            }
            if y >= high && self.direction.y >= 0.0 {
                return Err(Hit::Sky);
            }
            if !self.is_over(lambda) {
                let below = y < low - terrain.base_depth() && self.direction.y <= 0.0;
                if below || (ends && n as f64 > ACROSS * FINENESS) {
                    return Err(Hit::Sky);
                }
            }
            if !ends && n as f64 > REACH * FINENESS {
                return Err(Hit::OutOfRange);
            }
        }
        unreachable!()
    }

    /// Compare with the oracle. The march may have jumped over a thin crossing; the oracle may
    /// not, so its hit may be earlier if it is real, and never later.
    fn check(&self, sighting: &Sighting) {
        let what = || {
            let kernel = self.naive.kernel;
            format!("{sighting:?} {kernel:?} {:?} {:?}", self.eye, self.direction)
        };
        if sighting.tangent {
            return;
        }
        let first = self.first();
        if matches!(sighting.hit, Hit::Sky | Hit::OutOfRange) {
            assert_eq!(first, Err(sighting.hit), "{}", what());
            return;
        }
        let lambda = sighting.lambda;
        let hair = 1e-9 * lambda.max(1.0);
        assert!(self.is_inside(lambda + hair), "not inside {}", what());
        assert!(!self.is_inside(lambda - hair), "inside before {}", what());
        let was_over = self.is_over(lambda - hair);
        assert_eq!(was_over, sighting.hit == Hit::Surface, "{}", what());
        if let Ok(n) = first {
            assert!(lambda <= n as f64 * self.step + hair, "late {}", what());
        }
    }
}

fn eyes(outside: Outside) -> Vec<(DVec3, DVec3)> {
    let mut eyes = vec![
        (DVec3::new(6.1, 1.9, 2.2), DVec3::new(0.4, -0.3, 0.9)),
        (DVec3::new(1.0, 2.5, 3.9), DVec3::new(1.0, -0.4, -0.6)),
        (DVec3::new(7.0, 8.0, 2.0), DVec3::new(0.1, -1.0, 0.05)),
    ];
    if outside == Outside::Sky {
        eyes.push((DVec3::new(-4.0, 0.4, 6.0), DVec3::new(1.0, 0.0, -0.6)));
        eyes.push((DVec3::new(15.0, -3.0, 2.0), DVec3::new(-1.0, 0.2, 0.1)));
    }
    eyes
}

fn check_all(outside: Outside, holes: f64, rays: usize) -> [usize; 4] {
    let mut outcomes = [0; 4];
    let mut dice = Dice(99);
    for kernel in kernels() {
        let map = rough_map(9, 7, 1 + dice.0 % 7);
        let terrain = terrain(with_holes(&map, holes, dice.0), outside);
        for (eye, forward) in eyes(outside) {
            let scene = scene(Surface::Terrain(terrain.clone()), kernel, eye, forward);
            let oracle: Oracle = oracle(&scene).with_reach_cells(REACH);
            for _ in 0..rays {
                let (line, column) = (dice.between(0.0, 47.0), dice.between(0.0, 63.0));
                let sighting = oracle.pixel(line, column);
                let march = March::new(&terrain, kernel, eye, oracle.direction(line, column));
                march.check(&sighting);
                outcomes[sighting.hit as usize] += 1;
                assert!(!sighting.tangent, "random rays are not tangent");
            }
        }
    }
    outcomes
}

#[test]
fn no_crossing_is_jumped_on_a_map_that_ends() {
    let [sky, surface, side, out_of_range] = check_all(Outside::Sky, 0.0, 40);
    assert!(sky > 100 && surface > 500 && side > 100 && out_of_range == 0);
}

#[test]
fn no_crossing_is_jumped_on_a_map_that_goes_on() {
    let [sky, surface, side, out_of_range] = check_all(Outside::Clamp, 0.0, 25);
    assert!(sky > 10 && surface > 500 && side == 0 && out_of_range > 10);
}

#[test]
fn no_crossing_is_jumped_on_a_map_that_repeats() {
    let [sky, surface, side, _] = check_all(Outside::Wrap, 0.0, 25);
    assert!(sky > 10 && surface > 500 && side == 0);
}

#[test]
fn no_side_of_a_hole_is_jumped() {
    for outside in [Outside::Sky, Outside::Clamp, Outside::Wrap] {
        for share in [0.04, 0.15] {
            let [sky, surface, side, _] = check_all(outside, share, 25);
            let found = format!("{outside:?} {share}: {sky} {surface} {side}");
            assert!(sky > 100 && surface > 200 && side > 40, "{found}");
        }
    }
}

/// A wide plain with a few high nodes: most of a traversal passes over blocks of several sizes.
#[test]
fn no_crossing_is_jumped_by_passing_over_blocks() {
    let mut dice = Dice(31);
    let mut outcomes = [0; 4];
    for outside in [Outside::Sky, Outside::Clamp, Outside::Wrap] {
        let samples =
            (0..150 * 90).map(|_| if dice.roll() < 0.003 { 100.0 } else { 50.0 }).collect();
        let whole = HeightMap::new(150, 90, samples);
        let holed = with_holes(&whole, 0.003, 5);
        for (kernel, map) in kernels().into_iter().flat_map(|k| [(k, &whole), (k, &holed)]) {
            let terrain = terrain(map.clone(), outside);
            let eye = DVec3::new(170.0, 1.2, 40.3);
            let scene = scene(Surface::Terrain(terrain.clone()), kernel, eye, DVec3::NEG_X);
            let oracle = oracle(&scene).with_reach_cells(REACH);
            for _ in 0..12 {
                let (line, column) = (dice.between(23.0, 25.0), dice.between(0.0, 63.0));
                let sighting = oracle.pixel(line, column);
                let march = March::new(&terrain, kernel, eye, oracle.direction(line, column));
                march.check(&sighting);
                outcomes[sighting.hit as usize] += 1;
                assert!(!sighting.tangent, "random rays are not tangent");
            }
        }
    }
    let [sky, surface, _, out_of_range] = outcomes;
    assert!(sky > 30 && surface > 200 && out_of_range > 30, "{outcomes:?}");
}

#[test]
fn hits_project_back_to_their_pixels() {
    for kernel in kernels() {
        let terrain = terrain(rough_map(40, 30, 5), Outside::Sky);
        let (eye, forward) = (DVec3::new(30.0, 6.0, 0.5), DVec3::new(0.0, -0.6, 1.0));
        let oracle = oracle(&scene(Surface::Terrain(terrain), kernel, eye, forward));
        let mut hits = 0;
        for n in 0..100 {
            let (line, column) = (f64::from(n % 48), f64::from(n * 7 % 64));
            let sighting = oracle.pixel(line, column);
            // The face of a step belongs to two heights.
            let height = oracle.surface_height(sighting.point.x, sighting.point.z);
            let ray = oracle.eye() + oracle.direction(line, column) * sighting.lambda;
            if sighting.hit == Hit::Surface && (ray.y - sighting.point.y).abs() < 1e-3 {
                let (j, k) = oracle.project(sighting.point).unwrap();
                assert!((j - line).abs() < 1e-9 && (k - column).abs() < 1e-9);
                assert!((height.unwrap() - sighting.point.y).abs() < 1e-12);
                hits += 1;
            }
        }
        assert!(hits > 50, "{kernel:?}: {hits} hits");
    }
}

#[test]
fn crossings_are_counted_as_the_march_counts_them() {
    let whole = rough_map(9, 7, 6);
    let holed = with_holes(&whole, 0.06, 6);
    let (mut crossed, mut sheets) = (0, 0);
    for (kernel, map) in kernels().into_iter().flat_map(|k| [(k, &whole), (k, &holed)]) {
        let terrain = terrain(map.clone(), Outside::Sky);
        // No sample of the march falls on the edge of the map.
        let (eye, forward) = (DVec3::new(-4.003, 0.4, 6.01), DVec3::new(1.0, 0.0, -0.6));
        let oracle = oracle(&scene(Surface::Terrain(terrain.clone()), kernel, eye, forward));
        let mut dice = Dice(12);
        for _ in 0..20 {
            let (line, column) = (dice.between(10.0, 30.0), dice.between(10.0, 50.0));
            let march = March::new(&terrain, kernel, eye, oracle.direction(line, column));
            let last = 12 * FINENESS as usize;
            let inside: Vec<bool> =
                (0..=last).map(|n| march.is_inside(n as f64 * march.step)).collect();
            let marched = inside.windows(2).filter(|w| w[0] != w[1]).count();
            let end = last as f64 * march.step;
            let counted = oracle.crossings(line, column, 0.0, end);
            // Two crossings between samples are not seen by the march.
            assert!(counted >= marched && (counted - marched).is_multiple_of(2));
            assert!(counted <= marched + 2, "{counted} {marched}");
            let reversed = oracle.crossings(line, column, end, 0.0);
            assert_eq!(reversed, counted);
            crossed += usize::from(counted > 1);
            sheets += usize::from(check_sheets(&oracle, (line, column), &inside, march.step));
        }
    }
    assert!(crossed > 200 && sheets > 200, "{crossed} rays with two crossings, {sheets} sheets");
}

/// Samples in the solid up to its first end are on the sheet of the hit, later ones are not. `false`
/// where there is nothing to compare.
fn check_sheets(oracle: &Oracle, (line, column): (f64, f64), inside: &[bool], step: f64) -> bool {
    let sighting = oracle.pixel(line, column);
    let Some(first) = inside.iter().position(|&inside| inside) else {
        return false;
    };
    if sighting.tangent || sighting.lambda < (first - 1) as f64 * step {
        return false;
    }
    let same = |n: usize| oracle.pixel_beside(line, column, [n as f64 * step, f64::NAN]).1[0];
    assert!(same(first) && same(first - 1) && same(1));
    let length = inside[first..].iter().position(|&inside| !inside);
    if let Some(length) = length {
        assert!(!same(first + length));
        if length > 1
            && oracle.crossings(
                line,
                column,
                sighting.lambda + 1e-9,
                (first + length - 1) as f64 * step,
            ) == 0
        {
            assert!(same(first + length - 1));
        }
    }
    assert_eq!(oracle.pixel_beside(line, column, [f64::NAN; 2]).1, [false; 2]);
    length.is_some()
}
