//! What shader and checker share: constant colours, and the rounding of channels into bytes.

use crate::word::Cell;

/// Colours of pixels that meet no lit surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flat {
    /// Nothing is met.
    pub sky: [u8; 3],
    /// Out of range.
    pub far: [u8; 3],
    /// The side of the map.
    pub side: [u8; 3],
}

/// The nearest byte.
#[inline(always)]
pub(super) fn byte<T: Cell>(channel: T) -> u8 {
    channel.nearest().clamp(0, 255) as u8
}
