//! What an engine hands to the sinks: one frame, and on request the buffers behind it.

mod buffers;
mod hit;

pub use buffers::{BufferRow, Buffers, Dtype, Element, Giver, Pixel, Scalars, TABLE};
pub use hit::Hit;

/// One frame, or some of its lines, line by line from the top, column by column from the left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Pixels across.
    pub columns: usize,
    /// Scan lines.
    pub lines: usize,
    /// sRGB bytes, `lines * columns`.
    pub color: Vec<[u8; 3]>,
    /// Outcomes, `lines * columns`.
    pub hit: Vec<Hit>,
    /// The quantities behind the colours, when they were asked for.
    pub buffers: Option<Buffers>,
}

impl Frame {
    /// Room for this many pixels, none drawn.
    #[must_use]
    pub fn with_room(columns: usize, lines: usize, buffers: bool) -> Self {
        let pixels = columns * lines;
        Self {
            columns,
            lines,
            color: Vec::with_capacity(pixels),
            hit: Vec::with_capacity(pixels),
            buffers: buffers.then(|| Buffers::with_room(pixels)),
        }
    }

    /// The lines of another frame of the same width and buffers after these.
    pub fn append(&mut self, other: Self) {
        if self.lines == 0 {
            *self = other;
            return;
        }
        self.lines += other.lines;
        self.color.extend(other.color);
        self.hit.extend(other.hit);
        if let (Some(to), Some(from)) = (&mut self.buffers, other.buffers) {
            to.append(from);
        }
    }

    /// All arrays that the frame holds, in the order of [`TABLE`].
    pub fn arrays(&self) -> impl Iterator<Item = (&'static BufferRow, Scalars<'_>)> {
        let buffers = self.buffers.as_ref().map(Buffers::scalars);
        let hit = Hit::scalars(&self.hit);
        let color = <[u8; 3]>::scalars(&self.color);
        let requested = match buffers {
            Some(arrays) => arrays.map(Some),
            None => [None; _],
        };
        let all = std::iter::once(Some(hit)).chain(requested).chain([Some(color)]);
        TABLE.iter().zip(all).filter_map(|(row, scalars)| {
            let scalars = scalars?;
            (row.giver == Giver::Engines || !scalars.is_empty()).then_some((row, scalars))
        })
    }
}
