//! What a ray meets.

/// Outcome of a pixel, the `hit` buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Hit {
    /// The ray meets nothing.
    #[default]
    Sky = 0,
    /// The ray meets the surface.
    Surface = 1,
    /// The ray enters the map below ground: it meets the side of the map.
    Side = 2,
    /// The ray meets the ground beyond the registers' range, or its walk ended undecided.
    OutOfRange = 3,
}

impl Hit {
    /// Name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sky => "sky",
            Self::Surface => "surface",
            Self::Side => "side",
            Self::OutOfRange => "out of range",
        }
    }
}
