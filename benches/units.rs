//! Each unit, in time per pixel, in each number world: one line through the middle of `overview`,
//! and the checker on a line of `plane`.

mod support;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use terraline::engine::{FixedWorld, Memories};
use terraline::fast::enter;
use terraline::plan::Plan;
use terraline::processor::Processor;
use terraline::scene::Scene;
use terraline::setup::{Back, formats};
use terraline::unit::divider::Method;
use terraline::word::Complete;
use terraline::word::real::Real;
use terraline::word::stock::{Narrow, Wide};
use terraline::word::tally::Tally;

const COLUMNS: u32 = 1024;
const LINE: u32 = 600;

fn units<W: Complete>(criterion: &mut Criterion, name: &str, world: W, scene: &Scene, plan: &Plan) {
    let setup = Memories::default().set_up(world, scene, plan).expect("the scene fits the world");
    let mut processor = Processor::new(&setup);
    let mut line = processor.wires();
    for _ in 0..LINE {
        processor.skip_line();
    }
    let start = *processor.line_start();
    processor.run_line(&mut line);
    let mut group = criterion.benchmark_group(format!("units/{name}"));
    group.throughput(Throughput::Elements(COLUMNS.into()));
    group.bench_function("projector", |b| b.iter(|| setup.projector.run(&start, &mut line)));
    if let Some(divider) = &setup.divider {
        divider_benches(&mut group, |method| divider.run(&mut line, method));
    }
    if let Back::Terrain(units) = &setup.back {
        // The stepper starts from the entries that the divider left, every time.
        let entered = line.clone();
        group.bench_function("stepper", |b| {
            b.iter(|| {
                line.ground_x.copy_from_slice(&entered.ground_x);
                line.ground_z.copy_from_slice(&entered.ground_z);
                units.stepper.run(&mut line, &units.interpolator);
            });
        });
        group.bench_function("interpolator", |b| b.iter(|| units.interpolator.run(&mut line)));
        group.bench_function("shader", |b| b.iter(|| units.shader.run(&mut line)));
    }
    if let Back::Plane(checker) = &setup.back {
        group.bench_function("checker", |b| b.iter(|| checker.run(&mut line)));
    }
    group.finish();
}

fn divider_benches(group: &mut BenchmarkGroup<'_, WallTime>, mut run: impl FnMut(Method)) {
    group.bench_function("divider array", |b| b.iter(|| run(Method::Array)));
    group.bench_function("divider direct", |b| b.iter(|| run(Method::Direct)));
}

fn worlds(criterion: &mut Criterion) {
    for name in ["overview", "plane"] {
        let (scene, plan) = support::planned(name, COLUMNS, COLUMNS);
        let sweep = formats::sweep(&scene, &plan).expect("the stock formats are formats");
        units(criterion, &format!("{name}/narrow"), Narrow, &scene, &plan);
        units(criterion, &format!("{name}/wide"), Wide, &scene, &plan);
        units(criterion, &format!("{name}/sweep"), sweep, &scene, &plan);
        units(criterion, &format!("{name}/real"), Real, &scene, &plan);
        units(criterion, &format!("{name}/tally"), Tally(Narrow), &scene, &plan);
    }
}

fn direct_entry(criterion: &mut Criterion) {
    let (scene, plan) = support::planned("overview", COLUMNS, COLUMNS);
    assert!(matches!(FixedWorld::of(&scene, &plan), Ok(FixedWorld::Narrow(_))));
    let setup = Memories::default().set_up(Narrow, &scene, &plan).expect("the scene fits");
    let mut line = Processor::new(&setup).wires();
    let start = enter::line_start(&setup.projector, LINE);
    let mut group = criterion.benchmark_group("units/overview/narrow");
    group.throughput(Throughput::Elements(COLUMNS.into()));
    group.bench_function("projector, direct entry", |b| {
        b.iter(|| enter::fill(&setup.projector, &start, &mut line));
    });
    group.finish();
}

criterion_group!(benches, worlds, direct_entry);
criterion_main!(benches);
