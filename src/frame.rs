//! What an engine hands to the sinks: one frame, and on request the buffers behind it.

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
    Far = 3,
}

/// One frame, line by line from the top, column by column from the left.
#[derive(Clone, Debug, PartialEq)]
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

/// Per-pixel quantities, `lines * columns` each; misses are NaN in floats and 0 in integers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Buffers {
    /// λ of `r_p = r_h + λ V`, V as the scene's screen defines it (length `U1` at its foot point).
    pub lambda: Vec<f64>,
    /// x of the ground point, scene units.
    pub ground_x: Vec<f64>,
    /// z of the ground point, scene units.
    pub ground_z: Vec<f64>,
    /// Surface height at (`ground_x`, `ground_z`), scene units.
    pub height: Vec<f64>,
    /// Unit normal of the surface there.
    pub normal: Vec<[f64; 3]>,
    /// Index of the sample that hit.
    pub steps: Vec<u32>,
    /// Trials of the skip pyramid; only the processor counts them.
    pub trials: Option<Vec<u32>>,
}
