//! A module of the RTL, made into a program by Verilator.

use crate::ffi::{Declared, Handle};

/// A port of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Port {
    index: u32,
    width: u32,
    input: bool,
}

/// A module that runs.
#[derive(Debug)]
pub struct Model {
    handle: Handle,
    ports: Vec<Declared>,
    clock: Port,
    cycle: u64,
    /// It has been evaluated since the clock went low.
    low: bool,
    trace: bool,
}

impl Port {
    /// Bits of the port.
    pub fn width(self) -> u32 {
        self.width
    }
}

impl Model {
    /// The model of this name; `build.rs` lists them.
    ///
    /// # Panics
    /// If there is no such model, or it has no `clock`.
    pub fn new(name: &str) -> Self {
        let Some(handle) = Handle::new(name) else { panic!("build.rs makes no model {name}") };
        let ports = handle.ports();
        let clock = find(&ports, "clock");
        let mut model = Self { handle, ports, clock, cycle: 0, low: false, trace: false };
        model.set(clock, 0);
        // Without an evaluation at low clock the first edge would be none.
        model.handle.eval();
        model
    }

    /// A port by its name.
    ///
    /// # Panics
    /// If the module has no such port.
    pub fn port(&self, name: &str) -> Port {
        find(&self.ports, name)
    }

    /// A port by its name, if the module has it.
    pub fn find(&self, name: &str) -> Option<Port> {
        self.ports.iter().any(|port| port.name == name).then(|| self.port(name))
    }

    /// Drives an input of up to 64 bits with the low bits of a word.
    ///
    /// # Panics
    /// If the port is an output, or wider.
    pub fn set(&mut self, port: Port, word: u64) {
        assert!(port.input && port.width <= 64);
        self.handle.set(port.index, 0, word & mask(port.width));
    }

    /// Drives an input with a signed word.
    pub fn set_signed(&mut self, port: Port, word: i64) {
        self.set(port, word as u64);
    }

    /// Drives 64 bits of a wide input, or what is left of it: bits `64·at` and up.
    ///
    /// # Panics
    /// If the port is an output or has no such bits.
    pub fn set_part(&mut self, port: Port, at: u32, word: u64) {
        assert!(port.input && 64 * at < port.width);
        self.handle.set(port.index, at, word & mask(port.width - 64 * at));
    }

    /// A port of up to 64 bits. Outputs that follow from inputs without a register are up to date
    /// after [`Model::settle`].
    ///
    /// # Panics
    /// If the port is wider.
    pub fn get(&self, port: Port) -> u64 {
        assert!(port.width <= 64);
        self.handle.get(port.index, 0)
    }

    /// The same as a signed word.
    pub fn signed(&self, port: Port) -> i64 {
        sign_extended(self.get(port), port.width)
    }

    /// Whether a port of one bit is 1.
    pub fn is(&self, port: Port) -> bool {
        self.get(port) != 0
    }

    /// 64 bits of a wide port.
    ///
    /// # Panics
    /// If the port has no such bits.
    pub fn part(&self, port: Port, at: u32) -> u64 {
        assert!(64 * at < port.width);
        self.handle.get(port.index, at)
    }

    /// Up to 64 bits of a wide port, from bit `low` on.
    ///
    /// # Panics
    /// If the port has no such bits.
    pub fn bits(&self, port: Port, low: u32, count: u32) -> u64 {
        assert!(count <= 64 && low + count <= port.width);
        let (at, within) = (low / 64, low % 64);
        let mut word = self.handle.get(port.index, at) >> within;
        if within + count > 64 {
            word |= self.handle.get(port.index, at + 1) << (64 - within);
        }
        word & mask(count)
    }

    /// Lets inputs reach outputs within the cycle.
    pub fn settle(&mut self) {
        self.handle.eval();
        self.low = true;
    }

    /// The clock's edge, and the start of the next cycle. Outputs are up to date after
    /// [`Model::settle`].
    pub fn edge(&mut self) {
        // The model knows an edge by having seen the clock low.
        if self.trace || !self.low {
            self.handle.eval();
        }
        if self.trace {
            self.handle.dump(2 * self.cycle);
        }
        self.set(self.clock, 1);
        self.handle.eval();
        if self.trace {
            self.handle.dump(2 * self.cycle + 1);
        }
        self.set(self.clock, 0);
        self.low = false;
        self.cycle += 1;
    }

    /// Cycles since the model was made.
    pub fn cycle(&self) -> u64 {
        self.cycle
    }

    /// Opens an FST trace; nothing is written before [`Model::trace`] is called.
    ///
    /// # Errors
    /// If the file cannot be written, or the model cannot write traces.
    pub fn open_trace(&mut self, path: &str) -> Result<(), String> {
        if self.handle.open_trace(path) {
            Ok(())
        } else {
            Err(format!("{path}: the trace cannot be written; check its folder"))
        }
    }

    /// Whether the following cycles are written to the open trace.
    pub fn trace(&mut self, on: bool) {
        self.trace = on;
    }
}

fn find(ports: &[Declared], name: &str) -> Port {
    let Some(index) = ports.iter().position(|port| port.name == name) else {
        panic!("the module has no port {name}")
    };
    let Declared { width, input, .. } = ports[index];
    Port { index: index as u32, width, input }
}

fn mask(width: u32) -> u64 {
    if width >= 64 { u64::MAX } else { (1 << width) - 1 }
}

fn sign_extended(word: u64, width: u32) -> i64 {
    let spare = 64 - width.min(64);
    (word << spare) as i64 >> spare
}
