//! Scenes built by hand.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use terraline::oracle::Oracle;
use terraline::plan::Plan;
use terraline::scene::{
    Angles, Attitude, Camera, Colors, HeightMap, KernelShape, MapSource, NoData, Outside, Scene,
    Screen, Surface, Terrain, load,
};

/// Names of the built-in scenes with a height map.
pub const TERRAINS: [&str; 3] = ["overview", "flight", "valley"];
/// Names of all built-in scenes.
pub const SCENES: [&str; 4] = ["overview", "flight", "valley", "plane"];
/// All shapes of the finite function.
pub const SHAPES: [KernelShape; 4] =
    [KernelShape::Cosine, KernelShape::Parabola, KernelShape::Exponential, KernelShape::Hat];

/// A built-in scene with options.
pub fn loaded(name: &str, sets: &[&str]) -> Scene {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    load(Some(name), &sets).unwrap_or_else(|error| panic!("{error}"))
}

/// A built-in scene in another raster.
pub fn builtin(name: &str, columns: u32, lines: u32) -> Scene {
    let mut scene = loaded(name, &[]);
    for screen in &mut scene.screens {
        *screen = screen.resized(columns, lines);
    }
    scene
}

/// Ground of square cells of side one, samples as heights.
pub fn land(map: HeightMap) -> Terrain {
    Terrain {
        source: MapSource::new("hand"),
        map: Arc::new(map),
        cell: DVec2::ONE,
        offset: 0.0,
        scale: 1.0,
        outside: Outside::Sky,
        nodata: NoData::Hole,
        base_depth: None,
    }
}

/// A scene over such ground, seen from above its middle.
pub fn over(map: HeightMap, columns: u32, lines: u32) -> Scene {
    let (width, depth) = ((map.columns() - 1) as f64, (map.rows() - 1) as f64);
    let highest = f64::from(map.range().1);
    let surface = Surface::Terrain(land(map));
    Scene {
        name: "hand".into(),
        unit_m: 1.0,
        camera: Camera {
            position: DVec3::new(width / 2.0, highest + 0.6 * width.max(depth), -depth / 4.0),
            attitude: Attitude::Directions {
                forward: DVec3::new(0.0, -1.0, 1.0),
                up: DVec3::new(0.0, 1.0, 0.0),
            },
            ..Camera::default()
        },
        screens: vec![Screen { columns, lines, ..Screen::default() }],
        color: Colors { far: [1, 2, 3], ..Colors::default() },
        ..Scene::of(surface)
    }
}

/// A map from a function of column and row.
pub fn map(columns: usize, rows: usize, height: impl Fn(usize, usize) -> f32) -> HeightMap {
    let samples = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    HeightMap::new(columns, rows, samples.map(|(i, j)| height(i, j)).collect())
}

/// The terrain of a scene that has one.
pub fn terrain(scene: &mut Scene) -> &mut Terrain {
    scene.terrain_mut().expect("a scene with a terrain")
}

/// All of a scene but the samples of its map, in every bit.
pub fn described(scene: &Scene) -> String {
    let mut scene = scene.clone();
    if let Some(terrain) = scene.terrain_mut() {
        terrain.map = Arc::new(HeightMap::new(1, 1, vec![0.0]));
    }
    format!("{:#?}", Scene { name: String::new(), ..scene })
}

/// The pruned plan of a scene's first screen, which must exist.
pub fn plan(scene: &Scene) -> Plan {
    Plan::new(scene, None, false).unwrap_or_else(|error| panic!("{}: {error}", scene.name))
}

/// Height of the surface under the eye of a scene with a terrain, by the oracle.
pub fn ground_under(scene: &Scene, x: f64, z: f64) -> Option<f64> {
    Oracle::new(scene, &scene.screens[0]).surface_height(x, z)
}

/// The scene with its craft turned, degrees.
pub fn turned(mut scene: Scene, heading: f64, pitch: f64, roll: f64) -> Scene {
    scene.camera.attitude = Attitude::Angles(Angles {
        heading: heading.to_radians(),
        pitch: pitch.to_radians(),
        roll: roll.to_radians(),
    });
    scene
}
