//! How the samples of a file stand for heights.

use crate::scene::words::Words;

/// How the samples of a file stand for heights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// A sample is a height.
    #[default]
    Stored,
    /// Colour PNG: `-10000 + (R·65536 + G·256 + B)/10` metres.
    TerrainRgb,
    /// Colour PNG: `R·256 + G + B/256 - 32768` metres.
    Terrarium,
}

impl Encoding {
    /// Names in scene files and on the command line.
    pub const NAMES: [(&'static str, Self); 3] = [
        ("stored", Self::Stored),
        ("terrain-rgb", Self::TerrainRgb),
        ("terrarium", Self::Terrarium),
    ];

    /// The encoding of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(other, _)| *other == name).map(|(_, encoding)| *encoding)
    }

    /// Name in scene files.
    pub fn name(self) -> &'static str {
        self.word()
    }
}
