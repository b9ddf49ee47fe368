//! The worked examples of docs/cycles.md: what the page adds up by hand, the clock gives.

use terraline::clock::{Clock, Taker};
use terraline::unit::line::Work;

use super::{chain_and_work, recurrence, stepper_work};

const PAGE: &str = include_str!("../../docs/cycles.md");

/// A row of the page's table.
struct Example {
    name: &'static str,
    /// Its overrides.
    sets: Vec<&'static str>,
    /// What stands in the other columns.
    numbers: Vec<Option<u32>>,
}

/// All of them.
fn examples() -> Vec<Example> {
    let section = PAGE.split("## Worked examples").nth(1).expect("the section");
    let section = section.split("\n## ").next().expect("its text");
    let rows = section.lines().filter(|line| line.starts_with('|')).skip(2);
    rows.map(|row| {
        let mut cells = row.trim_matches('|').split('|').map(str::trim);
        let mut scene = cells.next().expect("a scene").split(", ");
        let name = scene.next().expect("a name");
        let number =
            |cell: &str| if cell == "none" { None } else { Some(cell.parse().expect(cell)) };
        Example { name, sets: scene.collect(), numbers: cells.map(number).collect() }
    })
    .collect()
}

#[test]
fn the_clock_adds_up_as_the_page_does() {
    let examples = examples();
    assert!(examples.len() >= 6);
    for Example { name, sets, numbers } in examples {
        let sets = [&["screen.size=[8, 8]"], &sets[..]].concat();
        let (chain, _) = chain_and_work(name, &sets);
        let [bits, reads, memory] = [0, 1, 2].map(|at: usize| numbers[at]);
        let [skip_tests, samples, bursts, bisection_steps, hits, stepper, first, second] =
            [3, 4, 5, 6, 7, 8, 9, 10].map(|at: usize| numbers[at].expect("a number"));
        let work = Work { skip_tests, samples, bursts, bisection_steps, hits };
        assert_eq!(stepper_work(&chain, work), stepper, "{name} {sets:?}");
        let leaves = recurrence(&chain, &[work, work], Taker::Ready);
        assert_eq!(leaves, [u64::from(first), u64::from(second)], "{name} {sets:?}");
        // The page's own columns are those of the machine.
        let stage = |name| chain.stages.iter().find(|stage| stage.name == name);
        let serial = sets.contains(&"machine.ratio=serial");
        let divider = stage("divider")
            .map(|stage| if serial { stage.timing.work.of(work) } else { stage.timing.latency });
        assert_eq!(divider, bits.map(|bits| bits + 3), "{name} {sets:?}");
        let interpolator = stage("interpolator").expect("a height map").timing;
        assert_eq!(Some(interpolator.work.of(work)), reads, "{name} {sets:?}");
        let nodes = memory.expect("M").max(2);
        assert_eq!(interpolator.latency, nodes + 7, "{name} {sets:?}");
        assert_eq!(Clock::new(chain).cycles(), 0);
    }
}
