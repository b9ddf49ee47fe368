//! Random scenes: small recipes that print and shrink well, and the scenes made of them.
#![expect(missing_docs, reason = "fields are named as the scene's keys are")]

use glam::{DVec2, DVec3};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use terraline::plan::geometry::Geometry;
use terraline::scene::{
    Angles, Attitude, Bisection, Deformation, Extent, HeightMap, Kernel, KernelShape, Outside,
    Scene, Screen, StepperMode,
};
use terraline::word::format::hash;

use crate::scenes::{SHAPES, ground_under, map, over, terrain};

/// What the nodes of a random map are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Landscape {
    Noise,
    Slopes,
    Spikes,
    Terraces,
    Constant,
}

/// Which nodes have no data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Voids {
    None,
    /// A share of all nodes, here and there.
    Scattered(f64),
    /// Whole blocks, of this many nodes a side.
    Blocks(usize),
    /// The outermost nodes.
    Border,
    /// Every second node in both directions.
    Grid,
}

/// Where the eye is; lengths are shares of the map's extent, heights shares of its height range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Eye {
    /// Over the map and over its highest node.
    Above { x: f64, z: f64, up: f64 },
    /// Over the ground and under the highest node.
    Inside { x: f64, z: f64, up: f64 },
    /// Beside the map, at any height where the map ends.
    Beside { x: f64, z: f64, up: f64, away: f64 },
}

/// How the craft is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turn {
    /// Heading, pitch and roll in degrees.
    Degrees(f64, f64, f64),
    /// Forward and up, of any length.
    Directions([f64; 3], [f64; 3]),
    /// Towards a place on the map, by shares of its extent.
    Towards(f64, f64),
}

/// A random scene.
#[derive(Clone, Debug)]
pub struct Recipe {
    pub nodes: (usize, usize),
    pub landscape: Landscape,
    pub voids: Voids,
    pub seed: u64,
    pub cell: (f64, f64),
    /// Height range in cells of mean size.
    pub steepness: f64,
    pub offset: f64,
    pub outside: Outside,
    pub base_depth: Option<f64>,
    pub kernel: Kernel,
    pub mode: StepperMode,
    pub fineness: u32,
    pub bisection: Bisection,
    pub eye: Eye,
    /// Eye on whole cells, angles in steps of 45 degrees.
    pub snapped: bool,
    pub turn: Turn,
    pub raster: (u32, u32),
    pub extent: Extent,
    pub center: (f64, f64),
    pub mount: (f64, f64, f64),
    pub offset_in_craft: (f64, f64, f64),
    pub ambient: f64,
    pub ramp: Vec<[u8; 3]>,
}

impl Recipe {
    fn heights(&self) -> HeightMap {
        let (columns, rows) = self.nodes;
        let random = |i: usize, j: usize| {
            (hash(self.seed, (j * columns + i) as u64) >> 40) as f32 / (1 << 23) as f32 - 1.0
        };
        let (a, b) = (random(columns, rows), random(rows, columns + 1));
        map(columns, rows, |i, j| {
            let chance = |i: usize, j: usize| hash(!self.seed, (j * columns + i) as u64) % 1000;
            let void = match self.voids {
                Voids::None => false,
                Voids::Scattered(share) => (chance(i, j) as f64) < 1000.0 * share,
                Voids::Blocks(size) => chance(i / size, j / size) < 300,
                Voids::Border => i == 0 || j == 0 || i == columns - 1 || j == rows - 1,
                Voids::Grid => i % 2 == 1 && j % 2 == 1,
            };
            // Somewhere there must be data.
            if void && (i, j) != (columns / 2, rows / 2) {
                return f32::NAN;
            }
            let noise = random(i, j);
            100.0
                * match self.landscape {
                    Landscape::Noise => noise,
                    Landscape::Slopes => a * i as f32 / columns as f32 + b * j as f32 / rows as f32,
                    Landscape::Spikes if noise > 0.93 => 1.0,
                    Landscape::Spikes if noise < -0.97 => -1.0,
                    Landscape::Spikes => noise / 64.0,
                    Landscape::Terraces => (noise * 2.0).round() / 2.0,
                    Landscape::Constant => -0.375,
                }
        })
    }

    /// The scene; its eye is never under the ground.
    pub fn scene(&self) -> Scene {
        let heights = self.heights();
        let (low, high) = heights.range();
        let range = f64::from(high - low);
        let mut scene = over(heights, self.raster.0, self.raster.1);
        let cell = DVec2::new(self.cell.0, self.cell.1);
        let mean = (cell.x * cell.y).sqrt();
        let land = terrain(&mut scene);
        land.cell = cell;
        land.offset = self.offset;
        land.scale = if range > 0.0 { self.steepness * mean / range } else { mean };
        land.outside = self.outside;
        land.base_depth = self.base_depth.map(|depth| depth * mean);
        scene.seed = self.seed;
        scene.kernel = self.kernel;
        scene.stepper.mode = self.mode;
        scene.stepper.fineness = self.fineness;
        scene.stepper.halvings = self.bisection;
        scene.light.ambient = self.ambient;
        scene.color.ramp.clone_from(&self.ramp);
        let angles = |(heading, pitch, roll): (f64, f64, f64)| Angles {
            heading: heading.to_radians(),
            pitch: pitch.to_radians(),
            roll: roll.to_radians(),
        };
        scene.screens = vec![Screen {
            name: "front".into(),
            columns: self.raster.0,
            lines: self.raster.1,
            extent: self.extent,
            center: DVec2::new(self.center.0, self.center.1),
            mount: angles(self.mount),
        }];
        let eye = self.place(&scene);
        scene.camera.attitude = self.attitude(&mut scene, eye);
        let (u, v, w) = self.offset_in_craft;
        scene.camera.offset = DVec3::new(u, v, w) * mean;
        scene.camera.position = eye;
        // The craft is where its eye is in the right place.
        let off = Geometry::new(&scene.camera, &scene.screens[0]).eye - eye;
        scene.camera.position = eye - off;
        scene
    }

    /// Extent of the map, scene units.
    fn extent(&self) -> DVec2 {
        DVec2::new(
            (self.nodes.0 - 1).max(1) as f64 * self.cell.0,
            (self.nodes.1 - 1).max(1) as f64 * self.cell.1,
        )
    }

    fn place(&self, scene: &Scene) -> DVec3 {
        let mut land = scene.clone();
        let land = terrain(&mut land);
        let (low, high) = land.range();
        let extent = self.extent();
        let unit = (self.cell.0 * self.cell.1).sqrt();
        let snap = |value: f64, cell: f64| {
            if self.snapped { (value / cell).round() * cell } else { value }
        };
        let at =
            |x: f64, z: f64| (snap(x * extent.x, self.cell.0), snap(z * extent.y, self.cell.1));
        let range = high - low;
        match self.eye {
            Eye::Above { x, z, up } => {
                let (x, z) = at(x, z);
                DVec3::new(x, high + up * up * (range + extent.min_element()), z)
            }
            Eye::Inside { x, z, up } => {
                let (x, z) = at(x * 0.98 + 0.01, z * 0.98 + 0.01);
                // In a hole, and on the far edge, whose nodes are of no patch, eyes may be lower.
                let ground = ground_under(scene, x, z).unwrap_or(low - 0.3 * range);
                // Patches may meet in a step.
                DVec3::new(x, ground + up * (high - ground) + 0.01 * unit, z)
            }
            Eye::Beside { x, z, up, away } => {
                let (out_x, out_z) = if x < z { (1.0 + away, 0.0) } else { (0.0, 1.0 + away) };
                let sign =
                    |share: f64, out: f64| if share < 0.5 { share - out } else { share + out };
                let (x, z) = at(sign(x, out_x), sign(z, out_z));
                let y = match self.outside {
                    Outside::Sky => low + (3.0 * up - 1.5) * (range + unit),
                    Outside::Clamp | Outside::Wrap => high + up * (range + unit),
                };
                DVec3::new(x, y, z)
            }
        }
    }

    fn attitude(&self, scene: &mut Scene, eye: DVec3) -> Attitude {
        let (low, high) = terrain(scene).range();
        match self.turn {
            Turn::Degrees(heading, pitch, roll) => {
                let snap = |degrees: f64| {
                    if self.snapped { (degrees / 45.0).round() * 45.0 } else { degrees }
                };
                Attitude::Angles(Angles {
                    heading: snap(heading).to_radians(),
                    pitch: snap(pitch).to_radians(),
                    roll: snap(roll).to_radians(),
                })
            }
            Turn::Directions(forward, up) => {
                let (forward, up) = (DVec3::from_array(forward), DVec3::from_array(up));
                let parallel = forward.cross(up).length() < 1e-3 * forward.length() * up.length();
                let up = if parallel { forward.any_orthogonal_vector() } else { up };
                Attitude::Directions { forward, up }
            }
            Turn::Towards(x, z) => {
                let extent = self.extent();
                let to = DVec3::new(x * extent.x, (low + high) / 2.0, z * extent.y);
                let forward = to - eye + DVec3::new(0.0, 0.0, 1e-3);
                let level = forward.cross(DVec3::Y).length() > 1e-6 * forward.length();
                Attitude::Directions { forward, up: if level { DVec3::Y } else { DVec3::X } }
            }
        }
    }
}

fn share() -> BoxedStrategy<f64> {
    prop_oneof![4 => 0.0..1.0, 1 => select(vec![0.0, 0.25, 0.5, 1.0])].boxed()
}

/// Every kernel under every deformation.
pub fn kernels() -> BoxedStrategy<Kernel> {
    let deformation = prop_oneof![
        1 => Just(Deformation::None),
        1 => Just(Deformation::Stretch),
        2 => select(vec![0, 1, 2, 3, 4, 5, 6, 40])
            .prop_map(|weight_shift| Deformation::TowardHat { weight_shift }),
    ];
    (select(SHAPES.to_vec()), deformation, select(vec![16, 256, 4096]))
        .prop_map(|(shape, deformation, table): (KernelShape, _, _)| Kernel {
            shape,
            deformation,
            table,
        })
        .boxed()
}

fn eyes() -> BoxedStrategy<Eye> {
    prop_oneof![
        (share(), share(), share()).prop_map(|(x, z, up)| Eye::Above { x, z, up }),
        (share(), share(), share()).prop_map(|(x, z, up)| Eye::Inside { x, z, up }),
        (share(), share(), share(), share()).prop_map(|(x, z, up, away)| Eye::Beside {
            x,
            z,
            up,
            away
        }),
    ]
    .boxed()
}

fn turns() -> BoxedStrategy<Turn> {
    let angle = || prop_oneof![-180.0..180.0, -9000.0..9000.0_f64];
    let direction = || [-3.0..3.0, -3.0..3.0, -3.0..3.0_f64];
    let nonzero = |v: &[f64; 3]| v.iter().any(|c| c.abs() > 0.01);
    prop_oneof![
        2 => (angle(), angle(), angle()).prop_map(|(h, p, r)| Turn::Degrees(h, p, r)),
        2 => (direction().prop_filter("a direction", nonzero),
              direction().prop_filter("a direction", nonzero))
            .prop_map(|(forward, up)| Turn::Directions(forward, up)),
        3 => (share(), share()).prop_map(|(x, z)| Turn::Towards(x, z)),
    ]
    .boxed()
}

fn extents() -> BoxedStrategy<Extent> {
    prop_oneof![
        3 => (10.0..120.0_f64).prop_map(|fov| Extent::FieldOfView(fov.to_radians())),
        1 => (0.1..10.0, 0.005..0.05, 0.005..0.05).prop_map(|(distance, across, down): (f64, f64, f64)| {
            Extent::Pitch { distance, pixel: DVec2::new(across, down) * distance }
        }),
    ]
    .boxed()
}

/// Random scenes.
pub fn recipes() -> BoxedStrategy<Recipe> {
    let landscape = select(vec![
        Landscape::Noise,
        Landscape::Noise,
        Landscape::Slopes,
        Landscape::Spikes,
        Landscape::Terraces,
        Landscape::Constant,
    ]);
    let side = || prop_oneof![2 => 2..=40_usize, 1 => select(vec![2, 3, 7, 17, 31, 33, 65, 130])];
    let cell = prop_oneof![
        2 => Just((1.0, 1.0)),
        1 => (0.1..8.0_f64).prop_map(|side| (side, side)),
        2 => (0.2..5.0_f64, 0.2..5.0_f64),
        1 => select(vec![(30.0, 30.0), (0.01, 0.02), (1000.0, 700.0)]),
    ];
    let steepness = prop_oneof![0.05..1.0, 1.0..12.0, 12.0..60.0_f64];
    let outside = select(vec![Outside::Sky, Outside::Sky, Outside::Clamp, Outside::Wrap]);
    let bisection =
        prop_oneof![Just(Bisection::Footprint), (0..=20_u32).prop_map(Bisection::Fixed)];
    let voids = prop_oneof![
        6 => Just(Voids::None),
        2 => (0.002..0.3_f64).prop_map(Voids::Scattered),
        2 => (1..=9_usize).prop_map(Voids::Blocks),
        1 => Just(Voids::Border),
        1 => Just(Voids::Grid),
    ];
    let land = (
        (side(), side()),
        (landscape, voids),
        any::<u64>(),
        cell,
        steepness,
        -200.0..200.0_f64,
        outside,
        prop_oneof![Just(None), (0.01..5.0_f64).prop_map(Some)],
    );
    let walk = (kernels(), 0..=4_u32, bisection, eyes(), prop::bool::weighted(0.2), turns());
    let small = || -0.5..0.5_f64;
    let angle = || prop_oneof![3 => Just(0.0), 1 => -170.0..170.0_f64];
    let look = (
        (3..=40_u32, 3..=28_u32),
        extents(),
        prop_oneof![2 => Just((0.0, 0.0)), 1 => (small(), small())],
        prop_oneof![2 => Just((0.0, 0.0, 0.0)), 1 => (angle(), angle(), angle())],
        prop_oneof![2 => Just((0.0, 0.0, 0.0)), 1 => (small(), small(), small())],
        prop_oneof![3 => 0.0..1.0, 1 => select(vec![0.0, 1.0])],
        vec(any::<[u8; 3]>(), 2..=5),
    );
    (land, walk, look)
        .prop_map(|(land, walk, look)| Recipe {
            nodes: land.0,
            landscape: land.1.0,
            voids: land.1.1,
            seed: land.2,
            cell: land.3,
            steepness: land.4,
            offset: land.5,
            outside: land.6,
            base_depth: land.7,
            kernel: walk.0,
            mode: StepperMode::Skipping,
            fineness: walk.1,
            bisection: walk.2,
            eye: walk.3,
            snapped: walk.4,
            turn: walk.5,
            raster: look.0,
            extent: look.1,
            center: look.2,
            mount: look.3,
            offset_in_craft: look.4,
            ambient: look.5,
            ramp: look.6,
        })
        .boxed()
}
