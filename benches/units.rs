//! Each unit, in time per pixel, in each number world: one line through the middle of `overview`,
//! and the checker on a line of `plane`.

mod support;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use terraline::engine::{FixedWorld, Memories};
use terraline::fast::enter;
use terraline::plan::Plan;
use terraline::plan::formats::Formats;
use terraline::processor::Processor;
use terraline::scene::Scene;
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
    processor.run_line(&mut line);
    let mut group = criterion.benchmark_group(format!("units/{name}"));
    group.throughput(Throughput::Elements(COLUMNS.into()));
    for unit in setup.chain() {
        group.bench_function(unit.description().name, |b| b.iter(|| unit.run(&mut line)));
    }
    if let Some(divider) = &setup.surfaces[0].divider {
        group.bench_function("divider direct", |b| {
            b.iter(|| divider.run_by(Method::Direct, &mut line));
        });
    }
    group.finish();
}

fn worlds(criterion: &mut Criterion) {
    for name in ["overview", "plane"] {
        let (scene, plan) = support::planned(name, COLUMNS, COLUMNS);
        let sweep =
            Formats::stock(plan.words).sweep(scene.seed).expect("the stock formats are formats");
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
    let projector = &setup.surfaces[0].projector;
    let start = enter::line_start(projector, LINE);
    let mut group = criterion.benchmark_group("units/overview/narrow");
    group.throughput(Throughput::Elements(COLUMNS.into()));
    group.bench_function("projector, direct entry", |b| {
        b.iter(|| enter::fill(projector, &start, &mut line));
    });
    group.finish();
}

criterion_group!(benches, worlds, direct_entry);
criterion_main!(benches);
