//! Scenes built by hand, for tests of single units.
#![allow(dead_code, reason = "every test file uses its own part")]

use glam::DVec3;
use terraline::engine::Memories;
use terraline::plan::Plan;
use terraline::scene::{
    Attitude, Camera, Colors, Deformation, Extent, Hardware, HeightMap, Kernel, Light, Outside,
    Plane, Scene, Screen, Surface, Terrain, WordSize,
};
use terraline::setup::{Setup, TerrainUnits};
use terraline::unit::interpolator::Interpolator;
use terraline::word::Complete;

use crate::support::{SHAPES, land};

pub const DEFORMATIONS: [Deformation; 7] = [
    Deformation::None,
    Deformation::Stretch,
    Deformation::TowardHat { weight_shift: 0 },
    Deformation::TowardHat { weight_shift: 1 },
    Deformation::TowardHat { weight_shift: 2 },
    Deformation::TowardHat { weight_shift: 9 },
    Deformation::TowardHat { weight_shift: 40 },
];

/// Every kernel under every deformation.
pub fn kernels() -> impl Iterator<Item = Kernel> {
    SHAPES.into_iter().flat_map(|shape| {
        DEFORMATIONS.map(|deformation| Kernel { shape, deformation, table: 1024 })
    })
}

/// Samples are heights in scene units, cells are unit squares.
pub fn terrain(columns: usize, rows: usize, samples: Vec<f32>) -> Terrain {
    land(HeightMap::new(columns, rows, samples))
}

/// The same map with something else beyond its edge.
pub fn with_outside(terrain: Terrain, outside: Outside) -> Terrain {
    Terrain { outside, ..terrain }
}

/// A small screen that looks down at 45°.
pub fn scene(surface: Surface, eye: DVec3, words: WordSize) -> Scene {
    Scene {
        name: "by hand".into(),
        unit_m: 1.0,
        camera: Camera {
            position: eye,
            attitude: Attitude::Directions { forward: DVec3::new(1.0, -1.0, 0.5), up: DVec3::Y },
            ..Camera::default()
        },
        screens: vec![Screen {
            columns: 16,
            lines: 12,
            extent: Extent::FieldOfView(1.0),
            ..Screen::default()
        }],
        kernel: Kernel { table: 1024, ..Kernel::default() },
        light: Light { direction: DVec3::Y, ambient: 0.3 },
        color: Colors { sky: [1, 2, 3], far: [4, 5, 6], side: [7, 8, 9], ..Colors::default() },
        machine: Hardware { words, ..Hardware::default() },
        ..Scene::of(surface)
    }
}

/// A checkered horizontal plane at height 0.
pub fn plane_scene(eye: DVec3, checker: f64, words: WordSize) -> Scene {
    scene(Surface::Plane(Plane { normal: DVec3::Y, distance: 0.0, checker }), eye, words)
}

/// A height map seen from well above it.
pub fn terrain_scene(terrain: Terrain, kernel: Kernel, words: WordSize) -> Scene {
    let eye = DVec3::new(4.0, terrain.range().1 + 20.0, 4.0);
    Scene { kernel, ..scene(Surface::Terrain(terrain), eye, words) }
}

/// The machine of a scene, everything fitted or pruned.
pub fn machine<W: Complete>(world: W, scene: &Scene, full: bool) -> (Plan, Setup<W>) {
    let plan = Plan::new(scene, None, full).expect("a scene that can be planned");
    let setup = Memories::default().set_up(world, scene, &plan).expect("registers that fit");
    (plan, setup)
}

/// The units behind the divider of a height map's machine.
pub fn units<W: Complete>(world: W, scene: &Scene, full: bool) -> TerrainUnits<W> {
    let (_, setup) = machine(world, scene, full);
    setup.surfaces[0].back.terrain().expect("a height map").clone()
}

/// Its interpolator.
pub fn interpolator<W: Complete>(world: W, scene: &Scene, full: bool) -> Interpolator<W> {
    units(world, scene, full).interpolator
}
