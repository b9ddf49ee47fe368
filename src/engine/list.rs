//! The engines by name.

/// What draws a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Engine {
    /// Line by line, units in their order.
    Processor,
    /// Threads, direct entry, vectorised loops; the same frame.
    Fast,
    /// The processor's units in f64.
    Real,
    /// Closed form in f64.
    Oracle,
}

impl Engine {
    /// Name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Processor => "processor",
            Self::Fast => "fast",
            Self::Real => "real",
            Self::Oracle => "oracle",
        }
    }

    /// Whether it draws the machine's own frame, in fixed point.
    #[must_use]
    pub fn is_fixed(self) -> bool {
        matches!(self, Self::Processor | Self::Fast)
    }
}
