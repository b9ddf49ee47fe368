//! Nodes without data: what the scene's rule makes of them.

use std::sync::Arc;

use rayon::prelude::*;

use super::error::SceneError;
use super::field::Field;
use super::height_map::HeightMap;
use super::kind::Kind;
use super::value::{Value, quoted, word_or};

/// What nodes without data become.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoData {
    /// Cells that touch one are holes.
    Hole,
    /// The sample of the nearest node with data.
    Nearest,
    /// This sample, in the unit of the map.
    Sample(f64),
}

const WORDS: [(&str, NoData); 2] = [("hole", NoData::Hole), ("nearest", NoData::Nearest)];

impl Value for NoData {
    fn read(field: &Field<'_>, kind: &Kind) -> Result<Self, SceneError> {
        word_or(field, kind, &WORDS, Self::Sample)
    }

    fn write(&self, _: &Kind) -> String {
        match self {
            Self::Hole => quoted("hole"),
            Self::Nearest => quoted("nearest"),
            Self::Sample(sample) => format!("{sample:?}"),
        }
    }
}

/// The map under a rule: nodes without data are left where the rule makes holes of them, and have
/// a sample elsewhere.
pub(super) fn apply(map: Arc<HeightMap>, rule: NoData) -> Arc<HeightMap> {
    if map.samples().iter().all(|sample| !sample.is_nan()) {
        return map;
    }
    let samples = match rule {
        NoData::Hole => return map,
        NoData::Nearest => nearest(&map),
        NoData::Sample(fill) => {
            let fill = fill as f32;
            map.samples().iter().map(|&s| if s.is_nan() { fill } else { s }).collect()
        }
    };
    Arc::new(HeightMap::new(map.columns(), map.rows(), samples))
}

/// Per node, the sample of the nearest node with data, its distance measured in nodes. Of several
/// nearest ones the westernmost counts, and of these the northernmost.
///
/// In each column the nearest data are found by a pass in either direction. Along a row, column u
/// is then worth `(x − u)² + d(u)²`, d its distance to data; the least of these parabolas is kept
/// as a stack of columns and of the places from which each is the least (Meijster, Roerdink and
/// Hesselink). All numbers are integers, so that ties are decided exactly.
fn nearest(map: &HeightMap) -> Vec<f32> {
    let (columns, rows) = (map.columns(), map.rows());
    let in_columns = nearest_in_columns(map);
    let mut out = vec![0.0; columns * rows];
    out.par_chunks_exact_mut(columns).enumerate().for_each_init(Vec::new, |least, (j, out)| {
        let row = &in_columns[j * columns..(j + 1) * columns];
        least.clear();
        for (column, &data) in row.iter().enumerate() {
            if data == NOWHERE {
                continue;
            }
            let away = i64::from(data) - j as i64;
            push(least, Parabola { column: column as i64, height: away * away });
        }
        let mut at = 0;
        for (x, out) in out.iter_mut().enumerate() {
            // A map has data somewhere, so there is a first one.
            while at + 1 < least.len() && least[at + 1].0 <= x as i64 {
                at += 1;
            }
            let column = least[at].1.column as usize;
            *out = map.sample(column, row[column] as usize);
        }
    });
    out
}

/// A column without any data.
const NOWHERE: u32 = u32::MAX;

/// Per node, the row of the nearest data in its column, the northern one of two.
fn nearest_in_columns(map: &HeightMap) -> Vec<u32> {
    let (columns, rows) = (map.columns(), map.rows());
    let mut found = vec![NOWHERE; columns * rows];
    for j in 0..rows {
        for i in 0..columns {
            found[j * columns + i] = match j {
                _ if !map.sample(i, j).is_nan() => j as u32,
                0 => NOWHERE,
                _ => found[(j - 1) * columns + i],
            };
        }
    }
    for j in (0..rows.saturating_sub(1)).rev() {
        for i in 0..columns {
            let (north, south) = (found[j * columns + i], found[(j + 1) * columns + i]);
            let away = |row: u32| if row == NOWHERE { u32::MAX } else { row.abs_diff(j as u32) };
            if away(south) < away(north) {
                found[j * columns + i] = south;
            }
        }
    }
    found
}

/// `(x − column)² + height`.
#[derive(Clone, Copy)]
struct Parabola {
    column: i64,
    height: i64,
}

impl Parabola {
    fn at(self, x: i64) -> i64 {
        (x - self.column) * (x - self.column) + self.height
    }

    /// The first place at which a parabola further east is less than this one.
    fn gives_way_to(self, east: Self) -> i64 {
        let rise = east.column * east.column - self.column * self.column;
        let twice = rise + east.height - self.height;
        twice.div_euclid(2 * (east.column - self.column)) + 1
    }
}

/// Adds a parabola further east to those that are least somewhere, each with the place from which
/// it is.
fn push(least: &mut Vec<(i64, Parabola)>, new: Parabola) {
    while let Some(&(from, last)) = least.last() {
        if last.at(from) <= new.at(from) {
            least.push((last.gives_way_to(new), new));
            return;
        }
        least.pop();
    }
    least.push((0, new));
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The nearest node with data by looking at all, in the order that decides ties.
    fn searched(map: &HeightMap, i: usize, j: usize) -> f32 {
        let nodes = (0..map.columns()).flat_map(|x| (0..map.rows()).map(move |z| (x, z)));
        let away = |(x, z): (usize, usize)| x.abs_diff(i).pow(2) + z.abs_diff(j).pow(2);
        let (x, z) = nodes
            .filter(|&(x, z)| !map.sample(x, z).is_nan())
            .min_by_key(|&node| away(node))
            .unwrap();
        map.sample(x, z)
    }

    proptest! {
        #[test]
        fn every_node_gets_the_nearest_data(
            columns in 1..20_usize,
            rows in 1..20_usize,
            share in 0.0..1.0_f64,
            seed: u64,
        ) {
            let count = columns * rows;
            let random = |at: usize| crate::word::format::hash(seed, at as u64);
            let mut samples: Vec<f32> = (0..count)
                .map(|at| {
                    let void = ((random(at) % 1000) as f64) < 1000.0 * share;
                    if void { f32::NAN } else { at as f32 }
                })
                .collect();
            samples[random(count) as usize % count] = -1.0;
            let map = Arc::new(HeightMap::new(columns, rows, samples));
            let filled = apply(map.clone(), NoData::Nearest);
            for j in 0..rows {
                for i in 0..columns {
                    prop_assert_eq!(filled.sample(i, j), searched(&map, i, j), "({}, {})", i, j);
                }
            }
            let filled = apply(map.clone(), NoData::Sample(-7.5));
            for (new, old) in filled.samples().iter().zip(map.samples()) {
                prop_assert_eq!(*new, if old.is_nan() { -7.5 } else { *old });
            }
        }
    }

    #[test]
    fn holes_and_whole_maps_stay_as_they_are() {
        let holed = Arc::new(HeightMap::new(2, 2, vec![1.0, f32::NAN, 2.0, 3.0]));
        assert!(Arc::ptr_eq(&holed, &apply(holed.clone(), NoData::Hole)));
        let whole = Arc::new(HeightMap::new(2, 1, vec![1.0, 2.0]));
        assert!(Arc::ptr_eq(&whole, &apply(whole.clone(), NoData::Nearest)));
    }
}
