//! Co-simulation: a frame by the RTL beside the emulator, compared in every output of every unit
//! and in every cycle.

use terraline::clock::{Chain, Clock, Sink};
use terraline::frame::Hit;
use terraline::processor::Processor;
use terraline::scene::Hardware as Parameters;
use terraline::setup::{Back, Setup};
use terraline::unit::Line;
use terraline::unit::line::Entry;
use terraline::word::Complete;

use crate::coefficients::raw;
use crate::machine::{Machine, UNITS, Words, wires};

/// The first differences that are described.
const DESCRIBED: usize = 8;

/// What a co-simulation found.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Pixels compared.
    pub pixels: u64,
    /// Cycles of the RTL, from the first after start to the one in which the last pixel is taken.
    pub cycles: u64,
    /// Cycles of the emulator's recurrence.
    pub expected_cycles: u64,
    /// Per fitted unit: name, and cycles in which an item waited before it.
    pub waits: Vec<(&'static str, u64)>,
    /// Differences found.
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
    /// Per unit, the cycles in which it took its items.
    taken: Vec<Vec<u64>>,
    /// Per unit, what it handed on.
    passed: Vec<Vec<Words>>,
    waits: [u64; UNITS.len()],
}

/// Draws a frame with both, and compares.
///
/// # Errors
/// If the RTL cannot draw this set-up, the trace cannot be written, or the RTL reads beside its
/// memories.
pub fn compare<W: Complete>(
    setup: &Setup<W>,
    parameters: &Parameters,
    sink: Sink,
    trace: Option<(&str, Window)>,
) -> Result<Outcome, String> {
    let machine = Machine::new(setup, parameters)?;
    compare_with(machine, setup, parameters, sink, trace)
}

/// Compares the frame of a loaded machine with the emulator's frame of a set-up.
///
/// # Errors
/// As [`compare`].
pub fn compare_with<W: Complete>(
    mut machine: Machine<'_, W>,
    setup: &Setup<W>,
    parameters: &Parameters,
    sink: Sink,
    trace: Option<(&str, Window)>,
) -> Result<Outcome, String> {
    let chain = Chain::new(setup, parameters, false);
    let fitted: Vec<usize> = chain
        .stages
        .iter()
        .filter_map(|stage| UNITS.iter().position(|unit| *unit == stage.name))
        .collect();
    let pixels = u64::from(setup.columns) * u64::from(setup.lines);
    let mut clock = Clock::new(chain.clone()).with_sink(sink);
    let mut processor = Processor::new(setup);
    let mut line = processor.wires();
    while processor.run_line(&mut line) {
        clock.take_line(&line, |_, _| {});
    }
    let limit = clock.cycles() + clock.cycles() / 8 + 10_000;
    let drawn = draw(&mut machine, pixels, limit, sink, trace)?;
    let mut outcome = Outcome {
        pixels,
        cycles: drawn.taken[UNITS.len() - 1].last().map_or(0, |last| last + 1),
        expected_cycles: 0,
        waits: fitted.iter().map(|&unit| (UNITS[unit], drawn.waits[unit])).collect(),
        differences: 0,
        described: Vec::new(),
    };
    let mut clock = Clock::new(chain).with_sink(sink);
    let mut processor = Processor::new(setup);
    let mut at = 0;
    while processor.run_line(&mut line) {
        for column in 0..line.len() {
            clock.take(line.work[column]);
            let place =
                |unit: usize| format!("line {}, column {column}, {}", line.number, UNITS[unit]);
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
                for (wire, (&name, expected)) in
                    wires(unit).iter().zip(emulated(setup, &line, column, unit)).enumerate()
                {
                    if expected.is_some_and(|expected| expected != found[wire]) {
                        outcome.differs(|| {
                            format!(
                                "{}: {name} is {:#x}, not {:#x}",
                                place(unit),
                                found[wire],
                                expected.unwrap_or_default()
                            )
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
    machine: &mut Machine<'_, W>,
    pixels: u64,
    limit: u64,
    sink: Sink,
    trace: Option<(&str, Window)>,
) -> Result<Run, String> {
    let mut run = Run {
        taken: vec![Vec::new(); UNITS.len()],
        passed: vec![Vec::new(); UNITS.len()],
        waits: [0; UNITS.len()],
    };
    let window = trace.map(|(_, window)| window);
    if let Some((path, _)) = trace {
        machine.open_trace(path)?;
    }
    machine.start();
    let frame = UNITS.len() - 1;
    let mut cycle = 0;
    // A machine that falls far behind is wrong, and might never end.
    while cycle < limit && (run.taken[frame].len() as u64) < pixels {
        if let Some(window) = window {
            let (begun, done) = (run.taken[0].len() as u64, run.taken[frame].len() as u64);
            machine.trace(begun >= window.first && done < window.end);
        }
        let passed = &mut run.passed;
        let now = machine.cycle(sink, |unit, words| passed[unit].push(words))?;
        for unit in 0..UNITS.len() {
            if now.takes >> unit & 1 == 1 {
                run.taken[unit].push(cycle);
            }
            run.waits[unit] += now.waits >> unit & 1;
        }
        cycle += 1;
    }
    Ok(run)
}

/// What the emulator has on a unit's output wires; `None` where nobody looks at them.
fn emulated<W: Complete>(
    setup: &Setup<W>,
    line: &Line<W>,
    i: usize,
    unit: usize,
) -> [Option<i64>; 4] {
    let hit = line.hit[i];
    let only = |condition: bool, word: i64| condition.then_some(word);
    match unit {
        0 => {
            let projector = &setup.projector;
            [
                Some(raw(line.view_x[i])),
                only(projector.y.is_some(), raw(line.view_y[i])),
                Some(raw(line.view_z[i])),
                only(projector.denominator.is_some(), raw(line.denominator[i])),
            ]
        }
        1 => {
            let met = line.entry[i] == Entry::Met;
            // On a height map the stepper has gone on from there.
            let there = met && matches!(setup.back, Back::Plane(_));
            [
                Some(line.entry[i] as i64),
                only(there, raw(line.ground_x[i])),
                only(there, raw(line.ground_z[i])),
                None,
            ]
        }
        2 => {
            let walked = setup.divider.is_none() || line.entry[i] == Entry::Met;
            [
                Some(hit as i64),
                only(walked, raw(line.ground_x[i])),
                only(walked, raw(line.ground_z[i])),
                Some(line.steps[i].into()),
            ]
        }
        3 => {
            let met = matches!(hit, Hit::Surface | Hit::Side);
            [
                Some(hit as i64),
                only(met, raw(line.surface[i])),
                only(met, raw(line.slope_x[i])),
                only(met, raw(line.slope_z[i])),
            ]
        }
        4 => {
            let [red, green, blue] = line.color[i];
            let color = u32::from_le_bytes([red, green, blue, 0]);
            [Some(hit as i64), Some(color.into()), None, None]
        }
        _ => [None; 4],
    }
}
