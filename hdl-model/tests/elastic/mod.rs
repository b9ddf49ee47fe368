//! Items through one elastic unit: what comes out, and in which cycle (equation 28), between a source
//! and a taker that take their time.

use terraline_hdl::Model;

use crate::random::Random;

/// Work on an item, latency and depth of a unit.
#[derive(Clone, Copy, Debug)]
pub struct Timing {
    pub work: u64,
    pub latency: u64,
    pub depth: usize,
}

/// How source and taker behave.
#[derive(Clone, Debug)]
pub struct Pace {
    /// By item, the first cycle in which the source has it.
    arrivals: Vec<u64>,
    seed: u64,
    /// Cycles of 256 in which the taker does not take anything.
    stalls: i64,
    /// As a power of two, cycles that the taker's mood lasts.
    mood: u32,
}

impl Pace {
    /// A random pace for this many items: full speed, gaps and stalls of all kinds.
    pub fn random(random: &mut Random, items: usize) -> Self {
        let [gaps, stalls] = [(); 2].map(|()| [0, 0, 32, 128, 224][random.within(0, 4) as usize]);
        let mut cycle = random.within(1, 20) as u64;
        let arrivals = (0..items)
            .map(|_| {
                cycle += 1;
                while random.is(gaps) {
                    cycle += random.within(1, 3) as u64;
                }
                cycle
            })
            .collect();
        Self { arrivals, seed: random.bits(), stalls, mood: random.within(0, 5) as u32 }
    }

    /// Whether the taker takes an item in this cycle.
    fn ready(&self, cycle: u64) -> bool {
        !Random(self.seed ^ cycle >> self.mood).is(self.stalls)
    }
}

/// The cycles of a unit's items by equation 28: taken by it, visible behind it, taken from it.
struct Times {
    taken: Vec<u64>,
    visible: Vec<u64>,
    left: Vec<u64>,
}

impl Times {
    fn new(pace: &Pace, timing: Timing) -> Self {
        let mut times = Self { taken: Vec::new(), visible: Vec::new(), left: Vec::new() };
        for (item, &arrival) in pace.arrivals.iter().enumerate() {
            let free = times.taken.last().map_or(0, |before| before + timing.work);
            let room = item.checked_sub(timing.depth).map_or(0, |before| times.left[before] + 1);
            let taken = arrival.max(free).max(room);
            let behind = times.left.last().map_or(0, |before| before + 1);
            let visible = (taken + timing.work - 1 + timing.latency).max(behind);
            let left = (visible..).find(|&cycle| pace.ready(cycle)).unwrap_or(u64::MAX);
            times.taken.push(taken);
            times.visible.push(visible);
            times.left.push(left);
        }
        times
    }
}

/// Resets the unit and runs all items of the pace through it. `put` drives the ports of an item,
/// also of items that the unit must not take (then with `None`); `check` compares what came out.
///
/// # Panics
/// If anything comes in another cycle than equation 28 says.
pub fn run(
    unit: &mut Model,
    pace: &Pace,
    timing: Timing,
    mut put: impl FnMut(&mut Model, Option<usize>),
    mut check: impl FnMut(&Model, usize),
) {
    let [reset, in_valid, out_ready] =
        ["reset", "in_valid", "out_ready"].map(|name| unit.port(name));
    let [in_ready, out_valid] = ["in_ready", "out_valid"].map(|name| unit.port(name));
    let times = Times::new(pace, timing);
    unit.set(in_valid, 0);
    unit.set(reset, 1);
    unit.edge();
    unit.set(reset, 0);
    let (mut entering, mut leaving) = (0, 0);
    let mut cycle = 0;
    while leaving < times.left.len() {
        let offered = pace.arrivals.get(entering).is_some_and(|&arrival| arrival <= cycle);
        unit.set(in_valid, offered.into());
        put(unit, offered.then_some(entering));
        unit.set(out_ready, pace.ready(cycle).into());
        unit.settle();
        let visible = times.visible[leaving] <= cycle;
        assert_eq!(unit.is(out_valid), visible, "item {leaving} in cycle {cycle}");
        if offered {
            let taken = times.taken[entering] == cycle;
            assert_eq!(unit.is(in_ready), taken, "item {entering} in cycle {cycle}");
            entering += usize::from(taken);
        }
        if visible {
            check(unit, leaving);
            leaving += usize::from(times.left[leaving] == cycle);
        }
        unit.edge();
        cycle += 1;
    }
}
