//! The interpolator: constant and tilted maps, bounds by its nodes, and the pruned machine
//! against the full one.

mod scenes;
mod support;

use std::sync::Arc;

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use scenes::{interpolator, kernels, terrain, terrain_scene, units};
use terraline::frame::Hit;
use terraline::plan::formats::Formats;
use terraline::plan::{Plan, WordClass};
use terraline::scene::{Deformation, Kernel, KernelShape, Outside, Scene, WordSize};
use terraline::unit::height_memory::{Edge, HeightMemory};
use terraline::unit::interpolator::{Form, Interpolator};
use terraline::unit::surface_unit::SurfaceUnit;
use terraline::unit::{Line, Unit as _};
use terraline::word::stock::{Narrow, Wide};
use terraline::word::sweep::{Sweep, SweepFormat};
use terraline::word::{
    Complete, Interpolating, Load, Open, Readout, Register, Rounding, Site, Word,
};

const COLUMNS: usize = 9;
const ROWS: usize = 7;
const HAT: Kernel = Kernel { shape: KernelShape::Hat, deformation: Deformation::None, table: 1024 };

/// A place in 1/2^20 cells, on the map, at its edges, and beyond them.
fn place() -> impl Strategy<Value = (i64, i64)> {
    let axis = |cells: i64| {
        prop_oneof![
            0..cells << 20,
            -(cells << 20)..cells << 21,
            (-2..=cells + 2, -1..=1_i64).prop_map(|(cell, by)| (cell << 20) + by),
            (-2..=cells + 2, -1..=1_i64).prop_map(|(cell, by)| (cell << 20) + (1 << 19) + by),
        ]
    };
    (axis(COLUMNS as i64), axis(ROWS as i64))
}

/// Heights in scene units, from flat to the largest height range that a narrow word takes.
fn heights() -> impl Strategy<Value = Vec<f32>> {
    let node =
        |most: i32| (0..=most, 0..16_i32).prop_map(|(y, part)| y as f32 + part as f32 / 16.0);
    prop_oneof![
        proptest::collection::vec(node(3), COLUMNS * ROWS),
        proptest::collection::vec(node(250), COLUMNS * ROWS),
        proptest::collection::vec(prop_oneof![Just(-120.0_f32), Just(120.0)], COLUMNS * ROWS),
        proptest::collection::vec(-1e-3..1e-3_f32, COLUMNS * ROWS),
    ]
}

fn ground<W: Open>(world: &W, bits: i64) -> W::Ground {
    let value = bits as f64 / f64::from(1 << 20);
    W::Ground::load(value, world.ground(Register::GroundX)).expect("a place near the map")
}

fn site(number: u32) -> Site {
    Site { register: Register::Surface, line: number / 7, column: number, operation: number << 3 }
}

/// A world of its stock formats but for the rounding.
fn sweep(words: WordClass, rounding: Rounding) -> Sweep {
    let stock = Formats::stock(words).sweep(5).expect("stock formats");
    Sweep::new(|register| SweepFormat { rounding, ..stock.format(register) })
}

/// Runs a check in every fixed world.
macro_rules! in_every_world {
    ($world:ident, $words:ident => $check:expr) => {{
        {
            let ($world, $words) = (Narrow, WordSize::Narrow);
            $check;
        }
        {
            let ($world, $words) = (Wide, WordSize::Wide);
            $check;
        }
        for rounding in Rounding::ALL {
            let ($world, $words) = (sweep(WordClass::NARROW, rounding), WordSize::Narrow);
            $check;
        }
    }};
}

fn raw<T: Readout>(word: T) -> i64 {
    word.raw().expect("bits")
}

fn some_scene(kernel: Kernel, words: WordSize) -> Scene {
    let samples = (0..COLUMNS * ROWS).map(|i| (i * i % 37) as f32).collect();
    terrain_scene(terrain(COLUMNS, ROWS, samples), kernel, words)
}

/// The same datapath over other nodes.
fn over<W: Complete>(
    interpolator: Interpolator<W>,
    nodes: Vec<W::Height>,
    edge: Edge,
) -> Interpolator<W> {
    let heights = Arc::new(HeightMemory::new(nodes, COLUMNS, ROWS, edge));
    Interpolator { heights, ..interpolator }
}

/// Highest and lowest of the nodes that a sample reads.
fn bounds<W: Interpolating + Open>(
    unit: &Interpolator<W>,
    x: W::Ground,
    z: W::Ground,
) -> (i64, i64) {
    let site = Site::pixel(0, 0);
    let nodes: Vec<i64> = if unit.form == Form::Stretch {
        unit.stencil(x, z, site).nodes.as_flattened().iter().map(|&node| raw(node)).collect()
    } else {
        unit.nodes(x, z, site).map(raw).to_vec()
    };
    (*nodes.iter().min().expect("nodes"), *nodes.iter().max().expect("nodes"))
}

fn constant_is_exact<W: Complete>(world: W, words: WordSize, places: &[(i64, i64)], y: f64) {
    for kernel in kernels() {
        let unit = interpolator(world, &some_scene(kernel, words), false);
        let node = W::Height::load(y, world.height(Register::Node)).expect("a height");
        for edge in [Edge::Ends, Edge::Clamps, Edge::Wraps] {
            let unit = over(unit.clone(), vec![node; COLUMNS * ROWS], edge);
            for (at, &(x, z)) in places.iter().enumerate() {
                let (x, z) = (ground(&world, x), ground(&world, z));
                let sample = unit.sample(x, z, site(at as u32));
                let found = [sample.surface, sample.slope_x, sample.slope_z].map(raw);
                assert_eq!(found, [raw(node), 0, 0], "{kernel:?} at {x:?}, {z:?}");
            }
        }
    }
}

fn stays_within<W: Complete>(world: W, words: WordSize, nodes: &[f32], places: &[(i64, i64)]) {
    for kernel in kernels() {
        for outside in [Outside::Sky, Outside::Wrap] {
            let map = terrain(COLUMNS, ROWS, nodes.to_vec());
            let scene = terrain_scene(scenes::with_outside(map, outside), kernel, words);
            let unit = interpolator(world, &scene, false);
            for (at, &(x, z)) in places.iter().enumerate() {
                let (x, z) = (ground(&world, x), ground(&world, z));
                let site = site(at as u32);
                let surface = unit.sample(x, z, site).surface;
                let (low, high) = bounds(&unit, x, z);
                let name = format!("{kernel:?} at {x:?}, {z:?}");
                assert!((low..=high).contains(&raw(surface)), "{low} {surface:?} {high}: {name}");
                // What the stepper compares with is what the interpolator draws.
                assert_eq!(raw(surface), raw(unit.height(x, z, site)), "{name}");
                assert!(!surface.overflowed(), "{name}");
            }
        }
    }
}

/// Outputs of the interpolator for pixels that met the surface at the given places.
fn outputs<W: Complete>(
    world: W,
    scene: &Scene,
    full: bool,
    places: &[(i64, i64)],
) -> Vec<[i64; 3]> {
    let unit = units(world, scene, full).interpolator;
    let mut line = Line::new(&world, 0..places.len() as u32);
    line.number = 3;
    for (at, &(x, z)) in places.iter().enumerate() {
        line.hit[at] = if at % 5 == 4 { Hit::Side } else { Hit::Surface };
        line.ground_x[at] = ground(&world, x);
        line.ground_z[at] = ground(&world, z);
    }
    unit.run(&mut line);
    (0..line.len())
        .map(|at| [line.surface[at], line.slope_x[at], line.slope_z[at]].map(raw))
        .collect()
}

fn full_is_pruned<W: Complete>(world: W, scene: &Scene, places: &[(i64, i64)]) -> TestCaseResult {
    let pruned = outputs(world, scene, false, places);
    prop_assert_eq!(pruned, outputs(world, scene, true, places), "{:?}", scene.kernel);
    Ok(())
}

/// Round to nearest, ties upward, of `a·b / 2^20`.
fn product(a: i64, b: i64) -> i64 {
    (2 * a * b + (1 << 20)).div_euclid(2 << 20)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn constant_maps_are_exact(
        places in proptest::collection::vec(place(), 24), y in prop_oneof![Just(0.0), -250.0..250.0_f64],
    ) {
        in_every_world!(world, words => constant_is_exact(world, words, &places, y));
    }

    #[test]
    fn the_surface_stays_within_its_nodes(
        nodes in heights(), places in proptest::collection::vec(place(), 24),
    ) {
        in_every_world!(world, words => stays_within(world, words, &nodes, &places));
    }

    #[test]
    fn full_and_pruned_give_the_same_bits(
        nodes in heights(), flat in any::<bool>(), places in proptest::collection::vec(place(), 24),
        wraps in any::<bool>(), cell in prop_oneof![Just((1.0, 1.0)), Just((2.0, 2.0)), Just((3.0, 1.25))],
    ) {
        let nodes = if flat { vec![nodes[0]; nodes.len()] } else { nodes };
        let outside = if wraps { Outside::Wrap } else { Outside::Sky };
        for kernel in kernels() {
            let mut map = scenes::with_outside(terrain(COLUMNS, ROWS, nodes.clone()), outside);
            map.cell = cell.into();
            let at = |words| terrain_scene(map.clone(), kernel, words);
            full_is_pruned(Narrow, &at(WordSize::Narrow), &places)?;
            full_is_pruned(Wide, &at(WordSize::Wide), &places)?;
            let rounding = Rounding::Nearest;
            full_is_pruned(sweep(WordClass::NARROW, rounding), &at(WordSize::Narrow), &places)?;
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    /// With slopes of whole units the products g·xd and h·zd are words, so nothing is rounded.
    #[test]
    fn tilted_maps_are_exact_under_the_hat(
        g in -12..=12_i64, h in -12..=12_i64,
        places in proptest::collection::vec((0..8_i64 << 20, 0..6_i64 << 20), 32),
    ) {
        let (unit, lowest) = tilted(g << 20, h << 20);
        for (at, &(x, z)) in places.iter().enumerate() {
            let sample = unit.sample(ground(&Narrow, x), ground(&Narrow, z), site(at as u32));
            prop_assert_eq!(raw(sample.surface), g * x + h * z - lowest);
            // Slopes are negated: they are components of the normal.
            prop_assert_eq!(raw(sample.slope_x), -g << 20);
            prop_assert_eq!(raw(sample.slope_z), -h << 20);
        }
    }

    /// With slopes of sixteenths each of the two lerps rounds once, to nearest: the same product
    /// on the west and the east side, whose difference is g exactly.
    #[test]
    fn gently_tilted_maps_are_rounded_once_per_lerp(
        g in -99..=99_i64, h in -99..=99_i64,
        places in proptest::collection::vec((0..8_i64 << 20, 0..6_i64 << 20), 32),
    ) {
        // In last bits per cell.
        let (g, h) = (g << 16, h << 16);
        let (unit, lowest) = tilted(g, h);
        let one = 1 << 20;
        for (at, &(x, z)) in places.iter().enumerate() {
            let sample = unit.sample(ground(&Narrow, x), ground(&Narrow, z), site(at as u32));
            let (i, j) = (x >> 20, z >> 20);
            let south_east = g * (i + 1) + h * (j + 1) - lowest;
            let (wx, wz) = (one - x % one, one - z % one);
            let expected = south_east + product(-h, wz) + product(-g, wx);
            prop_assert_eq!(raw(sample.surface), expected);
            prop_assert_eq!(raw(sample.slope_x), -g);
            prop_assert_eq!(raw(sample.slope_z), -h);
            // Where the fractions have 16 bits, products are words and the plane is exact.
            let (x, z) = (x >> 4 << 4, z >> 4 << 4);
            let exact = ((g * x + h * z) >> 20) - lowest;
            let sample = unit.sample(ground(&Narrow, x), ground(&Narrow, z), site(at as u32));
            prop_assert_eq!(raw(sample.surface), exact);
        }
    }
}

/// A plane with slopes in last bits per cell, under the hat, and its lowest node.
fn tilted(g: i64, h: i64) -> (Interpolator<Narrow>, i64) {
    let nodes = (0..ROWS as i64).flat_map(|j| (0..COLUMNS as i64).map(move |i| i * g + j * h));
    let lowest = nodes.clone().min().expect("nodes");
    let samples = nodes.map(|bits| bits as f32 / (1 << 20) as f32).collect();
    let scene = terrain_scene(terrain(COLUMNS, ROWS, samples), HAT, WordSize::Narrow);
    (interpolator(Narrow, &scene, false), lowest)
}

fn rom_is_symmetric<W: Complete>(world: W, words: WordSize) {
    let one = 1 << world.fixed(Register::Weight).expect("a fixed world").point;
    for kernel in kernels().filter(|kernel| kernel.deformation != Deformation::Stretch) {
        for table in [1, 2, 4, 64, 1024, 4096] {
            let scene = some_scene(Kernel { table, ..kernel }, words);
            let unit = interpolator(world, &scene, true);
            let rom = unit.rom.as_ref().expect("a full machine has its ROM");
            for entry in 0..=table as usize {
                let [a, b] = rom.weights().both_ways(entry).map(raw);
                assert_eq!(b, raw(rom.weights().at(table as usize - entry)));
                // Each is rounded once: half a last bit.
                assert!((a + b - one).abs() <= 1, "{kernel:?}: {a} + {b} at {entry} of {table}");
                assert!((0..=one).contains(&a));
                assert!(entry == 0 || a <= raw(rom.weights().at(entry - 1)), "{kernel:?} falls");
            }
            assert_eq!(rom.weights().both_ways(0).map(raw), [one, 0]);
        }
    }
}

#[test]
fn kernel_roms_are_symmetric() {
    rom_is_symmetric(Narrow, WordSize::Narrow);
    rom_is_symmetric(Wide, WordSize::Wide);
}

#[test]
fn the_pruned_machine_fits_what_the_kernel_needs() {
    let form = |kernel| interpolator(Narrow, &some_scene(kernel, WordSize::Narrow), false).form;
    for kernel in kernels() {
        let expected = match kernel.deformation {
            Deformation::Stretch => Form::Stretch,
            _ if kernel.shape == KernelShape::Hat => Form::Hat,
            Deformation::None => Form::Plain,
            Deformation::TowardHat { weight_shift } if weight_shift >= 31 => Form::Hat,
            Deformation::TowardHat { weight_shift } => Form::TowardHat(weight_shift),
        };
        assert_eq!(form(kernel), expected, "{kernel:?}");
        let plan = Plan::new(&some_scene(kernel, WordSize::Narrow), None, false).expect("a plan");
        let terrain = plan.surfaces[0].terrain().expect("a height map");
        assert_eq!(terrain.fitted.kernel_rom.fitted, expected != Form::Hat);
    }
}
