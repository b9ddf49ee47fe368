//! `[machine]`: the hardware of the emulated processor.

use super::kind::{Kind, LENGTH};
use super::table::{table, words};
use super::words::Words;

table! {
    /// Clock and memory of the emulated machine, and the word size asked for.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Hardware {
        /// Clock in MHz, which cycles are turned into frame rates by.
        clock_mhz: f64 = 100.0, LENGTH;
        /// Cycles from address to data.
        memory_latency: u32 = 2, Kind::Whole(1..=64);
        /// Word size of the stock world; "auto": the smaller one whose ranges and precision the
        /// plan can prove.
        words: WordSize = WordSize::Auto, WordSize::kind();
        /// Form of the divider: pixels are the same, cycles are not.
        ratio: RatioForm = RatioForm::Array, RatioForm::kind();
    }
}

impl Hardware {
    /// Frames per second at this many cycles a frame.
    pub fn frames_per_second(&self, cycles: u64) -> f64 {
        self.clock_mhz * 1e6 / cycles.max(1) as f64
    }
}

words! {
    /// Form of the divider: quotients and remainders are the same, cycles are not.
    pub enum RatioForm {
        /// A pipelined array, one stage per quotient bit: a pixel per cycle.
        Array = "array",
        /// One stage for all bits, one bit per cycle.
        Serial = "serial",
    }
}

words! {
    /// Word size of the stock world.
    pub enum WordSize {
        /// The smaller one whose ranges and precision the plan can prove.
        Auto = "auto",
        /// 32 bits: 20 after the point on the ground, 30 in the view.
        Narrow = "narrow",
        /// 64 bits: 24 after the point on the ground, 38 in the view.
        Wide = "wide",
    }
}
