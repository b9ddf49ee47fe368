//! Whole frames of the built-in scenes, with coefficient set-up, without maps and tables; and the skip
//! pyramid of a 4096² map.

mod support;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use terraline::engine::{Engine, Machine, Memories};
use terraline::setup::Memory;
use terraline::unit::height_memory::{Edge, HeightMemory};
use terraline::unit::pyramid::Pyramid;
use terraline::word::Load;
use terraline::word::stock::{Height32, Narrow};

fn frames(criterion: &mut Criterion) {
    for size in [512, 1024] {
        for name in ["overview", "flight", "valley", "plane"] {
            let (scene, plan) = support::planned(name, size, size);
            let memories = Memories::default();
            let draw = |engine| {
                let machine = Machine::new(&scene, &plan, &memories).expect("the scene fits");
                machine.frame(engine, false).expect("the scene fits")
            };
            let mut group = criterion.benchmark_group(format!("frames/{name}/{size}"));
            let pixels = u64::from(plan.geometry.columns) * u64::from(plan.geometry.lines);
            group.sample_size(10).throughput(Throughput::Elements(pixels));
            for engine in [Engine::Fast, Engine::Processor] {
                group.bench_function(engine.name(), |b| b.iter(|| draw(engine)));
            }
            group.finish();
        }
    }
}

fn pyramid(criterion: &mut Criterion) {
    const SIDE: usize = 4096;
    // The embedded map over and over, so that maxima vary as on real ground.
    let (scene, plan) = support::planned("overview", 64, 64);
    let memories = Memory::of_surfaces(&Narrow, &scene, &plan).expect("the scene fits");
    let tile = memories[0].as_ref().expect("overview has a map").heights.clone();
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
