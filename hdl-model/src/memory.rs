//! Memories beside the machine: they answer in order, a number of cycles after the address.

use std::collections::VecDeque;

/// Reads under way in a memory.
#[derive(Clone, Debug)]
pub struct Delay<T> {
    latency: u64,
    under_way: VecDeque<(u64, T)>,
}

impl<T> Delay<T> {
    /// A memory that answers `latency` cycles after the address.
    pub fn new(latency: u32) -> Self {
        Self { latency: latency.into(), under_way: VecDeque::new() }
    }

    /// An address, read in a cycle.
    pub fn read(&mut self, cycle: u64, data: T) {
        self.under_way.push_back((cycle + self.latency, data));
    }

    /// The answer of a cycle, if there is one.
    pub fn answer(&mut self, cycle: u64) -> Option<T> {
        let due = self.under_way.front().is_some_and(|(due, _)| *due == cycle);
        if due { self.under_way.pop_front().map(|(_, data)| data) } else { None }
    }
}
