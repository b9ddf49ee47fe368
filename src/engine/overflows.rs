//! Overflows of a sweep, counted and located at the wires.

use crate::unit::Line;
use crate::word::{Complete, Register};

/// Overflows of some lines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Overflows {
    /// Register, pixels whose wire carries an overflow, the first of them as (line, column).
    pub registers: Vec<(Register, u64, (u32, u32))>,
}

impl Overflows {
    /// Looks at the wires of a finished line.
    pub fn inspect<W: Complete>(&mut self, line: &Line<W>) {
        for (register, count, first) in line.overflows() {
            self.add(register, count, (line.number, first));
        }
    }

    /// Those of other lines, too.
    pub fn append(&mut self, other: Self) {
        for (register, count, first) in other.registers {
            self.add(register, count, first);
        }
    }

    fn add(&mut self, register: Register, count: u64, first: (u32, u32)) {
        match self.registers.iter_mut().find(|(known, ..)| *known == register) {
            Some((_, total, known)) => {
                *total += count;
                *known = (*known).min(first);
            }
            None => self.registers.push((register, count, first)),
        }
    }
}
