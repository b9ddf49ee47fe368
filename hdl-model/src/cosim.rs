//! Co-simulation: a frame by the RTL beside the emulator, compared in every output of every unit
//! and in every cycle.

use terraline::clock::{Chain, Clock, Taker};
use terraline::processor::Processor;
use terraline::setup::Setup;
use terraline::word::Complete;

use crate::rtl::{Rtl, STAGES, Words, port_name};

/// Why there is no comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The RTL has no machine for this set-up, or the trace cannot be written: reason and remedy.
    Refused(String),
    /// The RTL did what it must never do: it reads beside its memories.
    Wrong(String),
}

/// The first differences that are described.
const DESCRIBED: usize = 8;

/// What a co-simulation found.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Pixels of the frame, all of which were compared.
    pub pixels: u64,
    /// Cycles of the RTL, from the first after start to the one in which the last pixel is taken.
    pub cycles: u64,
    /// Cycles of the emulator's recurrence.
    pub expected_cycles: u64,
    /// Per fitted unit: name, and cycles in which an item waited before it.
    pub waits: Vec<(&'static str, u64)>,
    /// Outputs and cycles that are not the emulator's.
    pub differences: u64,
    /// The first of them.
    pub described: Vec<String>,
}

impl Outcome {
    /// Whether everything was equal.
    pub fn is_equal(&self) -> bool {
        self.differences == 0 && self.cycles == self.expected_cycles
    }

    fn differs(&mut self, text: impl FnOnce() -> String) {
        self.differences += 1;
        if self.described.len() < DESCRIBED {
            self.described.push(text());
        }
    }
}

/// The pixels whose cycles are written to a trace: from the first one's start to the last one's end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// First pixel, counted in scan order.
    pub first: u64,
    /// One behind the last.
    pub end: u64,
}

/// What the RTL did with the frame.
struct Run {
    /// Per stage, the cycles in which it took its items.
    taken: Vec<Vec<u64>>,
    /// Per stage, what it handed on.
    passed: Vec<Vec<Words>>,
    waits: [u64; STAGES.len()],
}

/// Draws a frame with both, and compares.
///
/// # Errors
/// If the RTL cannot draw this set-up, the trace cannot be written, or the RTL reads beside its
/// memories.
pub fn compare<W: Complete>(
    setup: &Setup<W>,
    taker: Taker,
    trace: Option<(&str, Window)>,
) -> Result<Outcome, Fault> {
    let rtl = Rtl::new(setup).map_err(Fault::Refused)?;
    compare_with(rtl, setup, taker, trace)
}

/// Compares the frame of loaded RTL with the emulator's frame of a set-up.
///
/// # Errors
/// As [`compare`].
pub fn compare_with<W: Complete>(
    mut rtl: Rtl<'_, W>,
    setup: &Setup<W>,
    taker: Taker,
    trace: Option<(&str, Window)>,
) -> Result<Outcome, Fault> {
    let chain = Chain::new(setup);
    let fitted: Vec<usize> = chain
        .stages
        .iter()
        .filter_map(|stage| STAGES.iter().position(|unit| *unit == stage.name))
        .collect();
    let pixels = u64::from(setup.columns) * u64::from(setup.lines);
    let mut clock = Clock::new(chain.clone()).with_taker(taker);
    let mut processor = Processor::new(setup);
    let mut line = processor.wires();
    while processor.run_line(&mut line) {
        clock.take_line(&line, |_, _| {});
    }
    let limit = clock.cycles() + clock.cycles() / 8 + 10_000;
    let drawn = draw(&mut rtl, pixels, limit, taker, trace)?;
    let mut outcome = Outcome {
        pixels,
        cycles: drawn.taken[STAGES.len() - 1].last().map_or(0, |last| last + 1),
        expected_cycles: 0,
        waits: fitted.iter().map(|&unit| (STAGES[unit], drawn.waits[unit])).collect(),
        differences: 0,
        described: Vec::new(),
    };
    let mut clock = Clock::new(chain).with_taker(taker);
    let mut processor = Processor::new(setup);
    let mut at = 0;
    while processor.run_line(&mut line) {
        for column in 0..line.len() {
            clock.take(line.work[column]);
            let place =
                |unit: usize| format!("line {}, column {column}, {}", line.number, STAGES[unit]);
            for (&unit, expected) in fitted.iter().zip(clock.entered()) {
                let found = drawn.taken[unit].get(at).copied();
                if found != Some(expected) {
                    outcome.differs(|| {
                        let found =
                            found.map_or("never".into(), |cycle| format!("in cycle {cycle}"));
                        format!("{}: takes it {found}, not in cycle {expected}", place(unit))
                    });
                }
                let Some(found) = drawn.passed[unit].get(at) else { continue };
                for &(wire, found) in found {
                    let expected = line.bits(wire, column);
                    if line.is(wire.driven(), column) && expected != Some(found) {
                        outcome.differs(|| {
                            let name = port_name(STAGES[unit], wire);
                            let expected = expected.unwrap_or_default();
                            format!("{}: {name} is {found:#x}, not {expected:#x}", place(unit))
                        });
                    }
                }
            }
            at += 1;
        }
    }
    outcome.expected_cycles = clock.cycles();
    Ok(outcome)
}

fn draw<W: Complete>(
    rtl: &mut Rtl<'_, W>,
    pixels: u64,
    limit: u64,
    taker: Taker,
    trace: Option<(&str, Window)>,
) -> Result<Run, Fault> {
    let mut run = Run {
        taken: vec![Vec::new(); STAGES.len()],
        passed: vec![Vec::new(); STAGES.len()],
        waits: [0; STAGES.len()],
    };
    let window = trace.map(|(_, window)| window);
    if let Some((path, _)) = trace {
        rtl.open_trace(path).map_err(Fault::Refused)?;
    }
    rtl.start();
    let frame = STAGES.len() - 1;
    let mut cycle = 0;
    // RTL that falls far behind is wrong, and might never end.
    while cycle < limit && (run.taken[frame].len() as u64) < pixels {
        if let Some(window) = window {
            let (begun, done) = (run.taken[0].len() as u64, run.taken[frame].len() as u64);
            rtl.trace(begun >= window.first && done < window.end);
        }
        let passed = &mut run.passed;
        let now = rtl.cycle(taker, |unit, words| passed[unit].push(words)).map_err(Fault::Wrong)?;
        for unit in 0..STAGES.len() {
            if now.takes >> unit & 1 == 1 {
                run.taken[unit].push(cycle);
            }
            run.waits[unit] += now.waits >> unit & 1;
        }
        cycle += 1;
    }
    Ok(run)
}
