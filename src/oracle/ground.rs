//! The ground under a point, without an oracle of the whole map.

use std::sync::Arc;

use glam::DVec3;

use super::Oracle;
use crate::scene::{HeightMap, Outside, Scene, Surface, Terrain};

/// Nodes beside the cell of the eye: more than any kernel reaches.
const AROUND: i64 = 3;

/// Height of the surface over the x and z of a point, scene units; `None` beside the map, where
/// nodes have no data, and on an upright plane.
///
/// The oracle's height, of a map cut out around the point: an oracle of a whole large map would
/// take too long to make for every step of a flight.
#[must_use]
pub fn height(scene: &Scene, at: DVec3) -> Option<f64> {
    let Some(terrain) = scene.terrain() else {
        return Oracle::new(scene, &scene.screens[0]).surface_height(at.x, at.z);
    };
    let cell = terrain.cell;
    let (columns, rows) = (terrain.map.columns() as i64, terrain.map.rows() as i64);
    let inside = |place: f64, nodes: i64| (0.0..=(nodes - 1) as f64).contains(&place);
    if terrain.outside == Outside::Sky
        && !(inside(at.x / cell.x, columns) && inside(at.z / cell.y, rows))
    {
        return None;
    }
    let (first_i, first_j) =
        ((at.x / cell.x).floor() as i64 - AROUND, (at.z / cell.y).floor() as i64 - AROUND);
    let node = |index: i64, nodes: i64| match terrain.outside {
        Outside::Wrap => index.rem_euclid(nodes) as usize,
        Outside::Sky | Outside::Clamp => index.clamp(0, nodes - 1) as usize,
    };
    let side = 2 * AROUND + 2;
    let samples: Vec<f32> = (0..side * side)
        .map(|index| {
            let (i, j) = (first_i + index % side, first_j + index / side);
            terrain.map.sample(node(i, columns), node(j, rows))
        })
        .collect();
    if samples.iter().any(|sample| !sample.is_finite()) {
        return None;
    }
    let map = Arc::new(HeightMap::new(side as usize, side as usize, samples));
    let around = Terrain { map, outside: Outside::Clamp, ..terrain.clone() };
    let scene = Scene { surfaces: vec![Surface::Terrain(around)], ..scene.clone() };
    let (x, z) = (at.x - first_i as f64 * cell.x, at.z - first_j as f64 * cell.y);
    Oracle::new(&scene, &scene.screens[0]).surface_height(x, z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::load;

    #[test]
    fn a_part_of_the_map_has_the_height_of_the_whole() {
        for deformation in 0..3 {
            for outside in ["sky", "clamp", "wrap"] {
                let sets = [
                    format!("kernel.deformation={deformation}"),
                    format!("surface.outside={outside}"),
                    "surface.cell=[1.0, 2.5]".to_owned(),
                ];
                let scene = load(Some("valley"), &sets).unwrap();
                let oracle = Oracle::new(&scene, &scene.screens[0]);
                for (x, z) in
                    [(0.0, 0.0), (0.3, 857.4), (171.7, 400.2), (342.9, 1.0), (-5.5, 900.0)]
                {
                    let whole = oracle.surface_height(x, z);
                    let part = height(&scene, DVec3::new(x, 0.0, z));
                    assert_eq!(whole.is_some(), part.is_some(), "{sets:?} {x} {z}");
                    let apart = whole.zip(part).map_or(0.0, |(whole, part)| (whole - part).abs());
                    assert!(apart < 1e-9, "{sets:?} {x} {z}: {whole:?} {part:?}");
                }
            }
        }
    }
}
