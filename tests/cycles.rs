//! The cycle recurrence against a simulation that goes cycle by cycle, and costs that can be
//! counted by hand.

mod support;
#[path = "cycles/worked.rs"]
mod worked;

use support::count;
use terraline::clock::{Chain, Clock, Taker};
use terraline::engine::Memories;
use terraline::frame::Hit;
use terraline::plan::Plan;
use terraline::processor::{self, Processor};
use terraline::scene::Scene;
use terraline::study::cost::Cost;
use terraline::study::error::Sample;
use terraline::unit::interpolator::LERP_LATENCY;
use terraline::unit::line::Work;
use terraline::unit::stepper::{RAY_END, RAY_START};
use terraline::word::stock::Narrow;

fn planned(name: &str, sets: &[&str]) -> (Scene, Plan) {
    let scene = support::loaded(name, sets);
    let plan = support::plan(&scene);
    (scene, plan)
}

/// The chain of a scene and the work of its pixels in scan order.
fn chain_and_work(name: &str, sets: &[&str]) -> (Chain, Vec<Work>) {
    let (scene, plan) = planned(name, sets);
    of_scene(&scene, &plan)
}

fn of_scene(scene: &Scene, plan: &Plan) -> (Chain, Vec<Work>) {
    let setup = Memories::default().set_up(Narrow, scene, plan).expect("set-up");
    let chain = Chain::new(&setup);
    let mut work = Vec::new();
    let mut line = Processor::new(&setup).wires();
    processor::run_lines(&setup, &mut line, 0..setup.lines, |line| work.extend(&line.work));
    (chain, work)
}

/// Cycles of work that do not depend on the item.
struct Case {
    reads: u64,
    divider: u64,
}

const PLAIN: Case = Case { reads: 1, divider: 1 };

/// Completion cycles of all items, by stepping a clock and asking every unit what it can do.
fn simulate(chain: &Chain, machine: &Case, work: &[Work], taker: Taker) -> Vec<u64> {
    let units = chain.stages.len();
    let stepper = chain.stages.iter().find(|stage| stage.name == "stepper");
    let cycles = |unit: usize, item: usize| -> u64 {
        match chain.stages[unit].name {
            "stepper" => stepper.map_or(0, |stage| stage.timing.work.of(work[item])).into(),
            "interpolator" => machine.reads,
            "divider" => machine.divider,
            _ => 1,
        }
    };
    // Items that each unit has taken, and the cycles in which it took them.
    let mut taken: Vec<Vec<u64>> = vec![Vec::new(); units];
    let mut now = 0;
    while taken[units - 1].len() < work.len() {
        let before: Vec<usize> = taken.iter().map(Vec::len).collect();
        for unit in 0..units {
            let item = before[unit];
            if item == work.len() {
                continue;
            }
            let arrived = unit == 0
                || taken[unit - 1].get(item).is_some_and(|&at| {
                    at + cycles(unit - 1, item) - 1
                        + u64::from(chain.stages[unit - 1].timing.latency)
                        <= now
                });
            let idle = item == 0 || taken[unit][item - 1] + cycles(unit, item - 1) <= now;
            // Places are freed the cycle after the next unit takes an item.
            let gone = if unit + 1 < units { before[unit + 1] } else { item };
            let room = item - gone < chain.stages[unit].timing.depth as usize;
            if arrived && idle && room && (unit + 1 < units || taker.is_ready(now)) {
                taken[unit].push(now);
            }
        }
        now += 1;
    }
    taken[units - 1].iter().map(|at| at + 1).collect()
}

fn recurrence(chain: &Chain, work: &[Work], taker: Taker) -> Vec<u64> {
    let mut clock = Clock::new(chain.clone()).with_taker(taker);
    work.iter().map(|&work| clock.take(work)).collect()
}

#[test]
fn the_recurrence_is_what_a_cycle_by_cycle_simulation_does() {
    let serial = |divider| Case { reads: 1, divider };
    for (name, case, set) in [
        ("overview", PLAIN, ""),
        ("overview", PLAIN, "machine.memory_latency=1"),
        ("flight", PLAIN, "machine.memory_latency=5"),
        ("valley", Case { reads: 4, ..PLAIN }, "kernel.deformation=1"),
        ("plane", PLAIN, ""),
        // Quotients of 31 bits, and bias, range and eye.
        ("plane", serial(34), "machine.ratio=serial"),
    ] {
        let sets: Vec<_> =
            ["screen.size=[24, 18]", set].into_iter().take(1 + set.len().min(1)).collect();
        let (chain, work) = chain_and_work(name, &sets);
        assert_eq!(work.len(), 24 * 18);
        for taker in [Taker::Ready, Taker::Busy { seed: 7, of_256: 100 }] {
            let expected = simulate(&chain, &case, &work, taker);
            assert_eq!(recurrence(&chain, &work, taker), expected, "{name} {set} {taker:?}");
        }
    }
}

#[test]
fn queues_fill_and_drain() {
    // Bursts of hard pixels among easy ones stall the units before the stepper.
    let (chain, _) = chain_and_work("overview", &["screen.size=[8, 8]"]);
    let hard = Work { skip_tests: 40, samples: 30, bursts: 6, bisection_steps: 12, hits: 1 };
    let work: Vec<Work> =
        (0..300).map(|i| if i % 50 < 5 { hard } else { Work::default() }).collect();
    let cycles = recurrence(&chain, &work, Taker::Ready);
    assert_eq!(cycles, simulate(&chain, &PLAIN, &work, Taker::Ready));
    let mut clock = Clock::new(chain);
    work.iter().for_each(|&work| {
        clock.take(work);
    });
    let stalled: u64 = clock.occupancy().map(|(_, occupancy)| occupancy.stalled).sum();
    assert!(stalled > 1000 && clock.limit() == "stepper");
}

fn stepper_work(chain: &Chain, work: Work) -> u32 {
    let stepper = chain.stages.iter().find(|stage| stage.name == "stepper");
    stepper.expect("a height map").timing.work.of(work)
}

#[test]
fn a_rays_work_is_the_sum_of_its_parts() {
    let (chain, _) = chain_and_work("overview", &["screen.size=[8, 8]"]);
    let memory = 2;
    let work = Work { skip_tests: 3, samples: 5, bursts: 2, bisection_steps: 4, hits: 1 };
    let answer = memory + LERP_LATENCY;
    let expected = RAY_START + 3 * (1 + memory) + 5 + 2 * answer + 4 * (1 + answer) + RAY_END;
    assert_eq!(stepper_work(&chain, work), expected);
    let (chain, _) = chain_and_work("overview", &["screen.size=[8, 8]", "kernel.deformation=1"]);
    let expected = RAY_START + 3 * (1 + memory) + 5 * 4 + 2 * answer + 4 * (4 + answer) + RAY_END;
    assert_eq!(stepper_work(&chain, work), expected);
    // With holes, the two places about the hit are read once more.
    let hole = |i, j| if (i, j) == (4, 4) { f32::NAN } else { 0.0 };
    let scene = support::over(support::map(9, 9, hole), 8, 8);
    let (chain, _) = of_scene(&scene, &support::plan(&scene));
    let hit = Work { hits: 1, ..Work::default() };
    assert_eq!(stepper_work(&chain, hit), RAY_START + RAY_END + 2 + answer);
}

fn cost(name: &str, sets: &[&str]) -> Cost {
    let (scene, plan) = planned(name, sets);
    let all = Sample::all(&plan);
    let machine = support::machine(&scene, &plan);
    machine.and_then(|machine| machine.cost(&all, &all)).expect("a cost")
}

#[test]
fn costs_that_can_be_counted_by_hand() {
    // A plane: per pixel one adder for the only increment along a line (level, looking east: z),
    // and 31 + 3 additions for each of two ratios below the horizon.
    let (scene, plan) = planned("plane", &["screen.size=[64, 64]"]);
    let plane = cost("plane", &["screen.size=[64, 64]"]);
    let unit = |name| plane.units.iter().find(|unit| unit.name == name).expect("the unit");
    assert_eq!(unit("projector").additions_per_pixel, 63.0 / 64.0);
    // Beside the ratios, the eye is added to both.
    let met = count(&support::drawn(&scene, &plan).expect("a frame"), Hit::Surface);
    let ratios = met as f64 * (2.0 * (31.0 + 3.0) + 2.0);
    assert_eq!(unit("divider").additions_per_pixel, ratios / 4096.0);
    // Every pixel that meets terrain costs five lerps and two slopes.
    let valley = cost("valley", &["screen.size=[64, 64]", "camera.pitch=-80"]);
    let unit = |name| valley.units.iter().find(|unit| unit.name == name).expect("fitted");
    let interpolator = unit("interpolator");
    assert_eq!(interpolator.products_per_pixel, 7.0);
    // A product adds 20 + 1 times, a lerp twice more, a slope once; an axis takes ten: for the hat
    // (2), the kernel's weight and slope (1 each), and what is shifted of either (3 each).
    assert_eq!(interpolator.additions_per_pixel, f64::from(7 * 21 + 5 * 2 + 2 + 2 * 10));
    assert_eq!(interpolator.memory_reads_per_pixel, 4.0);
    assert_eq!(interpolator.table_reads_per_pixel, 4.0);
    // One reciprocal square root.
    assert_eq!(unit("shader").table_reads_per_pixel, 1.0);
    // The units before the stepper wait for it; it waits for nobody.
    assert!(unit("projector").stalled_cycles_per_pixel > 50.0);
    assert_eq!(unit("stepper").stalled_cycles_per_pixel, 0.0);
    assert!(valley.units.iter().all(|u| u.name != "divider"), "the eye is in the slab");
}

#[test]
fn a_stepper_reads_for_its_samples_and_skip_tests() {
    // Ray steps add, they do not multiply: the stepper's products are its interpolations', three
    // each, at four node reads; the others are its skip tests', of rays that meet nothing too.
    let sets = ["screen.size=[64, 64]"];
    let (scene, plan) = planned("valley", &sets);
    let frame = support::drawn(&scene, &plan).expect("a frame");
    assert!(count(&frame, Hit::Sky) > 500);
    let trials: u32 = frame.buffers.expect("asked for").trials.iter().sum();
    let valley = cost("valley", &sets);
    let stepper = valley.units.iter().find(|unit| unit.name == "stepper").expect("fitted");
    let interpolations = stepper.table_reads_per_pixel / 2.0;
    assert_eq!(stepper.products_per_pixel, 3.0 * interpolations);
    let reads = 4.0 * interpolations + f64::from(trials) / 4096.0;
    assert_eq!(stepper.memory_reads_per_pixel, reads);
}

#[test]
fn sampled_lines_estimate_the_frame() {
    let (scene, plan) = planned("flight", &["screen.size=[96, 96]"]);
    let machine = support::machine(&scene, &plan).expect("a machine");
    let all = Sample::all(&plan);
    let some = Sample::whole_lines(&plan, 48, scene.seed);
    let exact = machine.cost(&all, &some).expect("a cost").cycles as f64;
    let scaled = machine.cost(&some, &some).expect("a cost").cycles as f64;
    assert!((scaled / exact - 1.0).abs() < 0.05, "{scaled} for {exact}");
    // Every pixel of a plane takes one cycle, and the pipeline fills once.
    let (scene, plan) = planned("plane", &["screen.size=[24, 18]"]);
    let machine = support::machine(&scene, &plan).expect("a machine");
    let all = Sample::all(&plan);
    let [exact, scaled] = [&all, &Sample::whole_lines(&plan, 3, scene.seed)]
        .map(|sample| machine.cost(sample, sample).expect("a cost"));
    let fill: u32 = exact.units.iter().map(|unit| unit.latency_cycles).sum();
    assert_eq!((exact.cycles, scaled.cycles), (24 * 18 + u64::from(fill), exact.cycles));
}

#[test]
fn the_longer_quotient_takes_the_time() {
    let latency = |sets: &[&str]| {
        let sets = [&["screen.size=[8, 8]"], sets].concat();
        let cost = cost("plane", &sets);
        cost.units.iter().find(|unit| unit.name == "divider").expect("fitted").latency_cycles
    };
    // 20 bits after the point in stock words, 30 here.
    let longer = "{ width = 48, point = 30 }";
    for axis in ["ground_x", "ground_z"] {
        let set = format!("format.{axis}={longer}");
        assert_eq!(latency(&[&set]), latency(&[]) + 10, "{axis}");
    }
}
