//! Driving one unit: items in with gaps, items out with back-pressure, and the cycles in which
//! equation 28 has it take them.

// Each test file uses a part of this.
#![allow(dead_code)]

use terraline::clock::Sink;
use terraline_hdl::{Model, Port};

/// Work, latency and depth of a unit.
#[derive(Clone, Copy, Debug)]
pub struct Timing {
    pub work: u64,
    pub latency: u64,
    pub depth: usize,
}

/// What became of an item.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Passed {
    /// Cycle in which the unit took it.
    pub taken: u64,
    /// Cycle in which the next unit took it.
    pub left: u64,
    /// Words on the output ports.
    pub out: Vec<i64>,
}

/// A unit between a source that is there in some cycles and a sink that is ready in some.
pub struct Bench {
    pub rtl: Model,
    inputs: Vec<Port>,
    outputs: Vec<Port>,
    in_valid: Port,
    in_ready: Port,
    out_valid: Port,
    out_ready: Port,
}

impl Bench {
    pub fn new(name: &str, inputs: &[&str], outputs: &[&str]) -> Self {
        let rtl = Model::new(name);
        let ports = |names: &[&str]| names.iter().map(|name| rtl.port(name)).collect::<Vec<_>>();
        let (inputs, outputs) = (ports(inputs), ports(outputs));
        let [in_valid, in_ready, out_valid, out_ready] =
            ["in_valid", "in_ready", "out_valid", "out_ready"].map(|name| rtl.port(name));
        Self { rtl, inputs, outputs, in_valid, in_ready, out_valid, out_ready }
    }

    /// Sets a coefficient.
    pub fn coefficient(&mut self, name: &str, value: i64) {
        let port = self.rtl.port(name);
        self.rtl.set_signed(port, value);
    }

    /// A reset of one cycle.
    pub fn reset(&mut self) {
        let reset = self.rtl.port("reset");
        self.rtl.set(reset, 1);
        self.rtl.set(self.in_valid, 0);
        self.rtl.edge();
        self.rtl.set(reset, 0);
    }

    /// Sends items through, from cycle 0 on; `source` and `sink` say in which cycles the neighbours
    /// are there.
    pub fn pass(&mut self, items: &[Vec<i64>], source: Sink, sink: Sink) -> Vec<Passed> {
        self.reset();
        let mut passed: Vec<Passed> = Vec::with_capacity(items.len());
        let mut done = 0;
        let mut cycle = 0;
        while done < items.len() {
            let item = items.get(passed.len()).filter(|_| source.is_ready(cycle));
            self.rtl.set(self.in_valid, item.is_some().into());
            if let Some(item) = item {
                for (&port, &word) in self.inputs.iter().zip(item) {
                    self.rtl.set_signed(port, word);
                }
            }
            let ready = sink.is_ready(cycle);
            self.rtl.set(self.out_ready, ready.into());
            self.rtl.settle();
            if ready && self.rtl.is(self.out_valid) {
                let out = self.outputs.iter().map(|&port| self.rtl.signed(port)).collect();
                passed[done].left = cycle;
                passed[done].out = out;
                done += 1;
            }
            if item.is_some() && self.rtl.is(self.in_ready) {
                passed.push(Passed { taken: cycle, ..Passed::default() });
            }
            self.rtl.edge();
            cycle += 1;
            assert!(cycle < 1000 + 200 * items.len() as u64, "the unit is stuck at item {done}");
        }
        passed
    }
}

/// Equation 28 for one unit: the cycles in which it takes each item, and those in which it leaves.
pub fn recurrence(count: usize, timing: Timing, source: Sink, sink: Sink) -> Vec<(u64, u64)> {
    let mut out: Vec<(u64, u64)> = Vec::with_capacity(count);
    for i in 0..count {
        let mut taken = 0;
        if let Some(&(before, _)) = out.last() {
            taken = before + timing.work;
        }
        if i >= timing.depth {
            taken = taken.max(out[i - timing.depth].1 + 1);
        }
        while !source.is_ready(taken) {
            taken += 1;
        }
        let mut left = taken + timing.work - 1 + timing.latency;
        if let Some(&(_, before)) = out.last() {
            left = left.max(before + 1);
        }
        while !sink.is_ready(left) {
            left += 1;
        }
        out.push((taken, left));
    }
    out
}

/// Requires the timing of equation 28.
pub fn assert_timing(passed: &[Passed], timing: Timing, source: Sink, sink: Sink) {
    let expected = recurrence(passed.len(), timing, source, sink);
    for (i, (found, &(taken, left))) in passed.iter().zip(&expected).enumerate() {
        assert_eq!((found.taken, found.left), (taken, left), "item {i}: cycles taken and left");
    }
}

/// Neighbours from always there to mostly busy.
pub fn neighbours(seed: u64) -> [(Sink, Sink); 4] {
    let busy = |add, of_256| Sink::Busy { seed: seed.wrapping_add(add), of_256 };
    [
        (Sink::Ready, Sink::Ready),
        (busy(1, 90), Sink::Ready),
        (Sink::Ready, busy(2, 90)),
        (busy(3, 150), busy(4, 170)),
    ]
}
