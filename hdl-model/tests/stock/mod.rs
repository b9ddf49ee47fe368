//! Words of the stock worlds as bits, on ports and in lines.

use terraline::scene::WordSize;
use terraline::unit::description::SHADER_TIMING;
use terraline::word::stock::{Narrow, Wide};
use terraline::word::{Complete, Lane};

use crate::elastic::Timing;

/// A world of words that are integers of up to 64 bits.
pub trait Stock:
    Complete<
        View: Lane<Int: Into<i64> + TryFrom<i64>>,
        Ground: Lane<Int: Into<i64> + TryFrom<i64>>,
        Height: Lane<Int: Into<i64> + TryFrom<i64>>,
        Tone: Lane<Int: Into<i64> + TryFrom<i64>>,
    >
{
    const NAME: &'static str;
    const WORDS: WordSize;
    const WIDTH: u32;
}

impl Stock for Narrow {
    const NAME: &'static str = "narrow";
    const WORDS: WordSize = WordSize::Narrow;
    const WIDTH: u32 = 32;
}

impl Stock for Wide {
    const NAME: &'static str = "wide";
    const WORDS: WordSize = WordSize::Wide;
    const WIDTH: u32 = 64;
}

/// A word of these bits.
pub fn word<T: Lane<Int: TryFrom<i64>>>(bits: i64) -> T {
    let Ok(int) = T::Int::try_from(bits) else { panic!("{bits} is wider than a word") };
    T::of_int(int)
}

/// The bits of a word.
pub fn bits<T: Lane<Int: Into<i64>>>(word: T) -> i64 {
    word.int().into()
}

/// A colour on a port: red in the low byte.
pub fn packed(color: [u8; 3]) -> u64 {
    let [red, green, blue] = color.map(u64::from);
    red | green << 8 | blue << 16
}

/// Timing of the shader, and of the checker in its place.
pub const SHADING: Timing =
    Timing { work: 1, latency: SHADER_TIMING.latency as u64, depth: SHADER_TIMING.depth as usize };
