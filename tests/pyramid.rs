//! The skip pyramid against a maximum over its definition's window.

use proptest::prelude::*;
use terraline::fast::maxima::{Maxima, NOTHING};
use terraline::unit::height_memory::{Edge, HeightMemory};
use terraline::unit::pyramid::{Pyramid, cell_maxima};

const EDGES: [Edge; 3] = [Edge::Ends, Edge::Clamps, Edge::Wraps];

#[derive(Clone, Debug)]
struct Map {
    columns: i32,
    rows: i32,
    nodes: Vec<i16>,
}

impl Map {
    fn at(&self, i: i32, j: i32) -> i16 {
        self.nodes[(j * self.columns + i) as usize]
    }

    /// The highest of the nodes whose indices lie in two windows; what lies beyond the map is as
    /// the edge says. `None` where the windows hold no node.
    fn highest(&self, x: (i32, i32), z: (i32, i32), edge: Edge) -> Option<i16> {
        let rows = indices(z, self.rows, edge);
        indices(x, self.columns, edge)
            .iter()
            .flat_map(|&i| rows.iter().map(move |&j| (i, j)))
            .map(|(i, j)| self.at(i, j))
            .max()
    }
}

fn indices((first, last): (i32, i32), size: i32, edge: Edge) -> Vec<i32> {
    let mut inside: Vec<i32> = match edge {
        Edge::Ends => (first..=last).filter(|i| (0..size).contains(i)).collect(),
        Edge::Clamps => (first..=last).map(|i| i.clamp(0, size - 1)).collect(),
        Edge::Wraps => (first..=last).map(|i| i.rem_euclid(size)).collect(),
    };
    inside.sort_unstable();
    inside.dedup();
    inside
}

/// `[(b−1)·2^m − r, (b+2)·2^m + r]`.
fn window(block: i32, level: u32, r: i32) -> (i32, i32) {
    (((block - 1) << level) - r, ((block + 2) << level) + r)
}

/// Whether a jump of at most 2^m from somewhere in the block ends or passes in a cell of the map.
fn reaches_a_cell(block: i32, level: u32, nodes: i32) -> bool {
    let (first, after_last) = ((block - 1) << level, (block + 2) << level);
    first.max(0) < after_last.min(nodes - 1)
}

/// The highest node of a box of cells by looking at all of them; `None` where it holds none.
fn highest_of_box(map: &Map, x: (i64, i64), z: (i64, i64), edge: Edge, r: i32) -> Option<i16> {
    let nodes = |(first, last): (i64, i64), cells: i32| {
        let (first, last) = (first as i32, last as i32);
        let (first, last) =
            if edge == Edge::Ends { (first.max(0), last.min(cells - 1)) } else { (first, last) };
        (first <= last).then_some((first - r, last + 1 + r))
    };
    map.highest(nodes(x, map.columns - 1)?, nodes(z, map.rows - 1)?, edge)
}

fn map() -> impl Strategy<Value = Map> {
    let side = || prop_oneof![Just(1), Just(2), Just(3), 1..=40_i32];
    (side(), side()).prop_flat_map(|(columns, rows)| {
        let count = (columns * rows) as usize;
        // Few distinct heights in one kind of map, a single peak in another.
        let nodes = prop_oneof![
            proptest::collection::vec(-1000..1000_i16, count),
            proptest::collection::vec(-2..2_i16, count),
            (0..count).prop_map(move |peak| (0..count).map(|i| i16::from(i == peak)).collect()),
        ];
        nodes.prop_map(move |nodes| Map { columns, rows, nodes })
    })
}

/// Cells to ask for: every block from far outside to far outside, at a few places within.
fn cells(nodes: i32, level: u32) -> impl Iterator<Item = i32> {
    let blocks = ((nodes - 1) >> level) + 1;
    let size = 1 << level;
    (-4..blocks + 4).flat_map(move |b| {
        let mut inside = vec![b * size, b * size + size / 3, b * size + size - 1];
        inside.dedup();
        inside
    })
}

fn check(map: &Map, edge: Edge, r: i32) -> Result<(), TestCaseError> {
    let (columns, rows) = (map.columns as usize, map.rows as usize);
    let heights = HeightMemory::new(map.nodes.clone(), columns, rows, edge);
    let pyramid = Pyramid::new(&heights, r);
    prop_assert!(pyramid.stored_bounds() > 0);
    let highest_of_cells = cell_maxima(&heights, r);
    for j in 0..map.rows {
        for i in 0..map.columns {
            let highest = map.highest((i - r, i + 1 + r), (j - r, j + 1 + r), edge);
            prop_assert_eq!(
                Some(highest_of_cells[(j * map.columns + i) as usize]),
                highest,
                "({}, {})",
                i,
                j
            );
        }
    }
    for level in 0..=pyramid.top() {
        for j in cells(map.rows, level) {
            for i in cells(map.columns, level) {
                let place = format!("level {level}, cell ({i}, {j}), {edge:?}, r = {r}");
                let bound = pyramid.bound(level, i, j);
                // Where the map repeats, blocks are counted within one period.
                let (bi, bj) = match edge {
                    Edge::Wraps => {
                        (i.rem_euclid(map.columns) >> level, j.rem_euclid(map.rows) >> level)
                    }
                    _ => (i >> level, j >> level),
                };
                let reaches =
                    reaches_a_cell(bi, level, map.columns) && reaches_a_cell(bj, level, map.rows);
                let (x, z) = (window(bi, level, r), window(bj, level, r));
                let highest = map.highest(x, z, edge);
                match (edge, bound) {
                    (Edge::Ends, None) => prop_assert!(!reaches, "no bound at {}", place),
                    (Edge::Ends, Some(bound)) => prop_assert_eq!(Some(bound), highest, "{}", place),
                    (_, None) => prop_assert!(false, "no bound at {}", place),
                    (_, Some(bound)) => {
                        prop_assert!(Some(bound) >= highest, "{} at {}", bound, place);
                        // Seen from the ray: all nodes that a jump from this very cell can read.
                        let near = |i: i32| (i - (1 << level) - r, i + (1 << level) + 1 + r);
                        prop_assert!(Some(bound) >= map.highest(near(i), near(j), edge), "{place}");
                    }
                }
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn bounds_cover_their_windows(map in map()) {
        for edge in EDGES {
            for r in [0, 1] {
                check(&map, edge, r)?;
            }
        }
    }

    #[test]
    fn a_single_row_or_column_is_a_map_too(nodes in proptest::collection::vec(-9..9_i16, 1..=70)) {
        let count = nodes.len() as i32;
        for (columns, rows) in [(1, count), (count, 1)] {
            let map = Map { columns, rows, nodes: nodes.clone() };
            for edge in EDGES {
                for r in [0, 1] {
                    check(&map, edge, r)?;
                }
            }
        }
    }

    #[test]
    fn no_cell_of_a_box_is_higher_than_the_bound_around_it(
        map in map(),
        x in (-100..100_i64, prop_oneof![Just(0), 0..10_i64, 0..300_i64]),
        z in (-100..100_i64, prop_oneof![Just(0), 0..10_i64, 0..300_i64]),
        ends in any::<bool>(),
        r in 0..2_i32,
    ) {
        let edge = if ends { Edge::Ends } else { Edge::Clamps };
        prop_assume!(!ends || map.columns > 1 && map.rows > 1);
        let (columns, rows) = (map.columns as usize, map.rows as usize);
        let heights = HeightMemory::new(map.nodes.clone(), columns, rows, edge);
        let maxima = Maxima::new(&heights, r, 0);
        let (x, z) = ((x.0, x.0 + x.1), (z.0, z.0 + z.1));
        let bound = maxima.around(x, z);
        let highest = highest_of_box(&map, x, z, edge, r);
        prop_assert!(Some(bound) >= highest, "{bound} around {x:?}, {z:?}, not {highest:?}");
        if ends && x.0 == x.1 && z.0 == z.1 {
            prop_assert_eq!(bound, highest.unwrap_or(NOTHING), "cell {}, {}", x.0, z.0);
        }
    }

    #[test]
    fn the_top_level_covers_the_map(map in map(), r in 0..=1_i32) {
        for edge in [Edge::Ends, Edge::Clamps] {
            let (columns, rows) = (map.columns as usize, map.rows as usize);
            let heights = HeightMemory::new(map.nodes.clone(), columns, rows, edge);
            let pyramid = Pyramid::new(&heights, r);
            let size = 1 << pyramid.top();
            prop_assert!(size >= map.columns && size >= map.rows);
            prop_assert_eq!(pyramid.bound(pyramid.top(), 0, 0), map.nodes.iter().copied().max());
        }
        // Where the map repeats, no block is larger than a period.
        let (columns, rows) = (map.columns as usize, map.rows as usize);
        let heights = HeightMemory::new(map.nodes.clone(), columns, rows, Edge::Wraps);
        let pyramid = Pyramid::new(&heights, r);
        let size = 1 << pyramid.top();
        prop_assert!(size <= map.columns && size <= map.rows);
        prop_assert!(pyramid.bound(pyramid.top(), 0, 0).is_some());
    }
}

#[test]
fn far_blocks_have_no_bound_where_the_map_ends() {
    let heights = HeightMemory::new(vec![5_i16; 33 * 17], 33, 17, Edge::Ends);
    let pyramid = Pyramid::new(&heights, 1);
    for level in 0..=pyramid.top() {
        let size = 1 << level;
        // The block west of the map is next to it, the one west of that is not.
        assert_eq!(pyramid.bound(level, -1, 0), Some(5));
        assert_eq!(pyramid.bound(level, -size - 1, 0), None);
        assert_eq!(pyramid.bound(level, 0, -size - 1), None);
        assert_eq!(pyramid.bound(level, 33 + 2 * size, 0), None);
        assert_eq!(pyramid.bound(level, -(1 << 30), 1 << 30), None);
    }
}
