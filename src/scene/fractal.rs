//! Height maps at any resolution: the same hills, with fractal detail between their nodes.
//!
//! The map is resampled by a cubic that passes through its nodes. Where nodes come closer than
//! the map's, octaves of gradient noise go on with its spectrum: an octave's features are half as
//! wide as those of the one before and 2^−H as high, and the first one's height follows from how
//! rough the map is there, so that lakes stay flat. Every octave's lattice is turned against the
//! one before, which hides the lattices. The ground is the same at any number of nodes; more of
//! them show more octaves.

use rayon::prelude::*;

use super::height_map::HeightMap;

/// Hurst exponent H of the detail; that of eroded hills is 0.8 to 0.9.
const HURST: f64 = 0.85;

/// Height of the octave whose lattice has the map's spacing, per root mean square of the second
/// differences around a place. With it second differences fall by 2^−H whenever their spacing
/// halves, from those between the map's own nodes on.
const GAIN: f64 = 1.1;

/// Second differences are averaged over the nodes up to this far away.
const NEIGHBOURHOOD: usize = 3;

/// Resamples a map to `side` × `side` nodes over the same ground, with detail drawn from `seed`.
///
/// With as many nodes as it has, a map stays as it is; with fewer it is smoothed first. The map
/// has no nodes without data.
pub(super) fn resample(map: &HeightMap, side: usize, seed: u64) -> HeightMap {
    let (columns, rows) = (map.columns(), map.rows());
    let heights: Vec<f64> = map.samples().iter().map(|&sample| f64::from(sample)).collect();
    let spacing = [columns, rows].map(|nodes| (nodes - 1) as f64 / (side - 1) as f64);
    let octaves = octaves(spacing[0].max(spacing[1]), seed);
    let [x, z] = [columns, rows].map(|nodes| Axis::new(nodes, side, cubic, 2.0));
    let [rough_x, rough_z] = [columns, rows].map(|nodes| Axis::new(nodes, side, hat, 1.0));
    let wide = x.along_rows(&heights);
    let wide_roughness = rough_x.along_rows(&roughness(&heights, columns, rows));

    let mut samples = vec![0.0_f32; side * side];
    samples.par_chunks_exact_mut(side).enumerate().for_each_init(
        || [vec![0.0; side], vec![0.0; side]],
        |[heights, roughness], (row, out)| {
            z.across_rows(&wide, row, heights);
            rough_z.across_rows(&wide_roughness, row, roughness);
            let place = row as f64 * spacing[1];
            for (column, out) in out.iter_mut().enumerate() {
                let amplitude = GAIN * roughness[column];
                let detail: f64 =
                    octaves.iter().map(|octave| octave.at(column as f64 * spacing[0], place)).sum();
                *out = (heights[column] + amplitude * detail) as f32;
            }
        },
    );
    HeightMap::new(side, side, samples)
}

/// How the nodes of one axis are made from those of the map: weights of some neighbours.
struct Axis {
    /// Neighbours per node.
    reach: usize,
    /// Index and weight of every neighbour, node after node.
    taps: Vec<(usize, f64)>,
    side: usize,
    nodes: usize,
}

impl Axis {
    /// Weights by a kernel that is zero from `radius` nodes on. With fewer nodes than the map it
    /// is widened, so that no detail turns into false hills. Beyond the edge the edge nodes go on.
    fn new(nodes: usize, side: usize, kernel: fn(f64) -> f64, radius: f64) -> Self {
        let (last, intervals) = (nodes - 1, side - 1);
        let width = (last as f64 / intervals as f64).max(1.0);
        let half = (radius * width).ceil() as usize;
        let reach = 2 * half;
        let mut taps = Vec::with_capacity(side * reach);
        for at in 0..side {
            // Whole nodes and fraction without rounding, so that the map's nodes stay themselves.
            let (node, part) = (at * last / intervals, at * last % intervals);
            let fraction = part as f64 / intervals as f64;
            let from = taps.len();
            for offset in 0..reach {
                let distance = offset as f64 - (half - 1) as f64 - fraction;
                let neighbour = (node + offset).saturating_sub(half - 1).min(last);
                taps.push((neighbour, kernel(distance / width)));
            }
            let sum: f64 = taps[from..].iter().map(|(_, weight)| weight).sum();
            taps[from..].iter_mut().for_each(|(_, weight)| *weight /= sum);
        }
        Self { reach, taps, side, nodes }
    }

    /// Every row of a map, resampled along itself.
    fn along_rows(&self, map: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; map.len() / self.nodes * self.side];
        out.par_chunks_exact_mut(self.side).zip(map.par_chunks_exact(self.nodes)).for_each(
            |(out, row)| {
                for (out, taps) in out.iter_mut().zip(self.taps.chunks_exact(self.reach)) {
                    *out = taps.iter().map(|&(at, weight)| row[at] * weight).sum();
                }
            },
        );
        out
    }

    /// One row of the result from the rows of a map that has the result's columns already.
    fn across_rows(&self, map: &[f64], row: usize, out: &mut [f64]) {
        out.fill(0.0);
        for &(at, weight) in &self.taps[row * self.reach..][..self.reach] {
            for (out, height) in out.iter_mut().zip(&map[at * self.side..]) {
                *out += height * weight;
            }
        }
    }
}

/// The cubic through four nodes whose slopes are those between the neighbours (Catmull and Rom).
fn cubic(t: f64) -> f64 {
    let t = t.abs();
    if t < 1.0 {
        (1.5 * t - 2.5) * t * t + 1.0
    } else if t < 2.0 {
        ((2.5 - 0.5 * t) * t - 4.0) * t + 2.0
    } else {
        0.0
    }
}

fn hat(t: f64) -> f64 {
    (1.0 - t.abs()).max(0.0)
}

/// Per node, the root mean square of the second differences in its neighbourhood.
fn roughness(heights: &[f64], columns: usize, rows: usize) -> Vec<f64> {
    let at = |i: usize, j: usize| heights[j * columns + i];
    // Edge nodes have no second difference across the edge: that of the next node stands in.
    let inner = |i: usize, nodes: usize| i.clamp(1, nodes.saturating_sub(2).max(1));
    let bend = |i: usize, nodes: usize, at: &dyn Fn(usize) -> f64| {
        let i = inner(i, nodes);
        if nodes < 3 { 0.0 } else { at(i - 1) - 2.0 * at(i) + at(i + 1) }
    };
    let mut squares: Vec<f64> = (0..heights.len())
        .map(|index| {
            let (i, j) = (index % columns, index / columns);
            let (x, z) = (bend(i, columns, &|i| at(i, j)), bend(j, rows, &|j| at(i, j)));
            (x * x + z * z) / 2.0
        })
        .collect();
    squares = averaged(&squares, columns);
    squares = transposed(&averaged(&transposed(&squares, columns), rows), rows);
    squares.iter().map(|&square| libm::sqrt(square)).collect()
}

/// The mean of every element's neighbourhood in its row.
fn averaged(map: &[f64], columns: usize) -> Vec<f64> {
    map.chunks_exact(columns)
        .flat_map(|row| {
            (0..columns).map(|i| {
                let near =
                    &row[i.saturating_sub(NEIGHBOURHOOD)..columns.min(i + NEIGHBOURHOOD + 1)];
                near.iter().sum::<f64>() / near.len() as f64
            })
        })
        .collect()
}

fn transposed(map: &[f64], columns: usize) -> Vec<f64> {
    (0..columns).flat_map(|i| map.iter().skip(i).step_by(columns).copied()).collect()
}

/// One octave of noise.
struct Octave {
    /// Turns and scales a place on the map into the octave's lattice.
    turn: [f64; 2],
    height: f64,
    seed: u32,
}

/// The octaves that nodes `spacing` apart can show, in distances of the map's own nodes.
fn octaves(spacing: f64, seed: u64) -> Vec<Octave> {
    let mut octaves = Vec::new();
    let (mut wide, mut height) = (1.0, 1.0);
    // A turn by an angle no multiple of which is a right one.
    let (mut cos, mut sin) = (0.8, 0.6);
    while wide > spacing {
        // The last octave fades in, since its features are hardly wider than two nodes.
        let shown = (wide / spacing - 1.0).min(1.0);
        octaves.push(Octave {
            turn: [cos / wide, sin / wide],
            height: height * shown,
            seed: hash(octaves.len() as u32, (seed >> 32) as u32, seed as u32),
        });
        (cos, sin) = (0.8 * cos - 0.6 * sin, 0.6 * cos + 0.8 * sin);
        wide /= 2.0;
        height *= libm::exp2(-HURST);
    }
    octaves
}

impl Octave {
    fn at(&self, x: f64, z: f64) -> f64 {
        let [cos, sin] = self.turn;
        self.height * self.noise(cos * x - sin * z, sin * x + cos * z)
    }

    /// Gradient noise: a random slope at every point of the lattice, interpolated between four.
    fn noise(&self, x: f64, z: f64) -> f64 {
        let (floor_x, floor_z) = (x.floor(), z.floor());
        let (i, j) = (floor_x as i32, floor_z as i32);
        let (x, z) = (x - floor_x, z - floor_z);
        let slope = |di: i32, dj: i32| {
            let hash = hash(i.wrapping_add(di) as u32, j.wrapping_add(dj) as u32, self.seed);
            let part = |bits: u32| f64::from(bits & 0xFFFF) / 32768.0 - 1.0;
            part(hash) * (x - f64::from(di)) + part(hash >> 16) * (z - f64::from(dj))
        };
        let (u, v) = (fade(x), fade(z));
        let north = slope(0, 0) + (slope(1, 0) - slope(0, 0)) * u;
        let south = slope(0, 1) + (slope(1, 1) - slope(0, 1)) * u;
        north + (south - north) * v
    }
}

/// From 0 to 1 with no slope and no curvature at either end.
fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// Three words to one that looks random.
fn hash(a: u32, b: u32, c: u32) -> u32 {
    let mut h = a.wrapping_mul(0x9E37_79B1) ^ b.wrapping_mul(0x85EB_CA77).rotate_left(16) ^ c;
    h = (h ^ (h >> 16)).wrapping_mul(0x7FEB_352D);
    h = (h ^ (h >> 15)).wrapping_mul(0x846C_A68B);
    h ^ (h >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin;

    fn jacksboro() -> HeightMap {
        (*builtin::map("jacksboro").unwrap().unwrap()).clone()
    }

    /// Root mean square of the second differences over `step` nodes.
    fn bend(map: &HeightMap, step: usize) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for j in step..map.rows() - step {
            for i in step..map.columns() - step {
                let at = |i, j| f64::from(map.sample(i, j));
                let x = at(i - step, j) - 2.0 * at(i, j) + at(i + step, j);
                let z = at(i, j - step) - 2.0 * at(i, j) + at(i, j + step);
                sum += (x * x + z * z) / 2.0;
                count += 1.0;
            }
        }
        libm::sqrt(sum / count)
    }

    #[test]
    fn as_many_nodes_are_the_map_itself() {
        let map = jacksboro();
        assert_eq!(resample(&map, 344, 7), map);
    }

    #[test]
    fn the_spectrum_goes_on_below_the_nodes() {
        let large = resample(&jacksboro(), 343 * 8 + 1, 7);
        // The last halving lacks the octave that fades in.
        let bends = [bend(&jacksboro(), 1), bend(&large, 4), bend(&large, 2)];
        for pair in bends.windows(2) {
            let exponent = libm::log2(pair[0] / pair[1]);
            assert!((exponent - HURST).abs() < 0.1, "{bends:?}");
        }
    }

    #[test]
    fn hills_stay_where_they_are() {
        let map = jacksboro();
        let large = resample(&map, 343 * 3 + 1, 7);
        let small = resample(&map, 172, 7);
        let far = |of: &dyn Fn(usize, usize) -> f32, step: usize| {
            let (mut sum, mut count) = (0.0, 0.0);
            for j in (0..344).step_by(step) {
                for i in (0..344).step_by(step) {
                    let off = f64::from(of(i, j) - map.sample(i, j));
                    (sum, count) = (sum + off * off, count + 1.0);
                }
            }
            libm::sqrt(sum / count)
        };
        // Heights range over 640 m.
        let (off, mean) = (far(&|i, j| large.sample(3 * i, 3 * j), 1), bend(&map, 1));
        assert!(off < mean, "{off} {mean}");
        let off = far(&|i, j| small.sample(i * 171 / 343, j * 171 / 343), 343);
        assert!(off < 3.0 * mean, "{off} {mean}");
    }

    #[test]
    fn flat_ground_stays_flat_and_seeds_differ() {
        let flat = HeightMap::new(5, 4, vec![3.5; 20]);
        assert!(resample(&flat, 50, 1).samples().iter().all(|&sample| sample == 3.5));
        let map = jacksboro();
        assert_eq!(resample(&map, 500, 1), resample(&map, 500, 1));
        assert_ne!(resample(&map, 500, 1), resample(&map, 500, 2));
    }

    #[test]
    fn any_number_of_nodes() {
        let map = jacksboro();
        for side in [2, 3, 50, 256, 343, 345] {
            let other = resample(&map, side, 1);
            assert_eq!((other.columns(), other.rows()), (side, side));
            let (low, high) = map.range();
            let (lowest, highest) = other.range();
            assert!(lowest > low - 30.0 && highest < high + 30.0);
        }
    }
}
