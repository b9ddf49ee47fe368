//! Whole frames of the built-in scenes, coefficient set-up in, maps and tables out; and the skip
//! pyramid of a 4096² map.

mod support;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use terraline::engine::{FixedWorld, InFastWorld, draw_by_lines};
use terraline::fast::{self, enter::Enterable};
use terraline::plan::Plan;
use terraline::scene::Scene;
use terraline::setup::{Memory, Setup};
use terraline::unit::height_memory::{Edge, HeightMemory};
use terraline::unit::pyramid::Pyramid;
use terraline::word::Load;
use terraline::word::stock::{Height32, Narrow};

struct Frames<'a> {
    criterion: &'a mut Criterion,
    name: String,
    scene: &'a Scene,
    plan: &'a Plan,
}

impl InFastWorld for Frames<'_> {
    type Output = ();

    fn run<W: Enterable>(self, world: W) {
        let Self { criterion, name, scene, plan } = self;
        let memory = Memory::new(&world, scene, plan).expect("the scene fits");
        let map = fast::Map::new(&world, scene, plan, memory.as_ref());
        let setup = || Setup::new(world, scene, plan, memory.as_ref()).expect("the scene fits");
        let mut group = criterion.benchmark_group(format!("frames/{name}"));
        let pixels = u64::from(plan.geometry.columns) * u64::from(plan.geometry.lines);
        group.sample_size(10).throughput(Throughput::Elements(pixels));
        group.bench_function("fast", |b| {
            b.iter(|| fast::render(&setup(), map.as_ref(), plan, false))
        });
        group.bench_function("processor", |b| {
            b.iter(|| draw_by_lines(&setup(), plan, false, |_| {}));
        });
        group.finish();
    }
}

fn frames(criterion: &mut Criterion) {
    for size in [512, 1024] {
        for name in ["overview", "flight", "valley", "plane"] {
            let (scene, plan) = support::planned(name, size, size);
            let world = FixedWorld::of(&scene, &plan).expect("a built-in scene has a world");
            let name = format!("{name}/{size}");
            world.run_fast(Frames { criterion, name, scene: &scene, plan: &plan });
        }
    }
}

fn pyramid(criterion: &mut Criterion) {
    const SIDE: usize = 4096;
    // The embedded map over and over, so that maxima vary as on real ground.
    let (scene, plan) = support::planned("overview", 64, 64);
    let memory = Memory::new(&Narrow, &scene, &plan).expect("the scene fits");
    let tile = memory.expect("overview has a map").heights;
    let nodes: Vec<Height32> =
        (0..SIDE * SIDE).map(|at| tile.at(at % SIDE % 344, at / SIDE % 344)).collect();
    assert!(nodes.iter().any(|node| Some(*node) != Height32::load(0.0, ())));
    let heights = HeightMemory::new(nodes, SIDE, SIDE, Edge::Ends);
    let mut group = criterion.benchmark_group("pyramid");
    group.sample_size(10).throughput(Throughput::Elements((SIDE * SIDE) as u64));
    for (name, radius) in [("4096, 2x2 nodes", 0), ("4096, 3x3 nodes", 1)] {
        group.bench_function(name, |b| b.iter(|| Pyramid::new(&heights, radius)));
    }
    group.finish();
}

criterion_group!(benches, frames, pyramid);
criterion_main!(benches);
