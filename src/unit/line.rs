//! The wires of one scan line: a structure of arrays, one entry per pixel in flight.
//!
//! Every wire is declared once, in the list at the end of this file. What passes wires on (test vectors,
//! co-simulation, explanations, overflow counts) names them by [`Wire`].

use crate::frame::Hit;
use crate::word::{Open, Readout, Register, Word, World};

/// What the divider says of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Entry {
    /// The ray meets the plane, or it starts at the eye.
    #[default]
    Met,
    /// The denominator is not positive: the ray never meets the plane.
    Sky,
    /// The quotient is out of range.
    OutOfRange,
}

/// What the stepper did for a pixel; its cycles follow from it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Skip tests: jumps tried against the pyramid.
    pub skip_tests: u32,
    /// Samples of the ray compared with the surface.
    pub samples: u32,
    /// Sample bursts: runs of samples streamed through the interpolator.
    pub bursts: u32,
    /// Bisection steps behind the hit.
    pub bisection_steps: u32,
    /// Hits: one, or none.
    pub hits: u32,
}

/// The projector's accumulators at the first column of a line; those that are absent stay as they are.
#[derive(Clone, Copy, Debug)]
pub struct LineStart<W: World> {
    /// View vector, x.
    pub x: W::View,
    /// View vector, y.
    pub y: W::View,
    /// View vector, z.
    pub z: W::View,
    /// Denominator.
    pub denominator: W::View,
}

impl<W: World> LineStart<W> {
    /// Accumulators at zero.
    pub fn idle(world: &W) -> Self {
        let zero = W::View::zero(world.view(Register::ViewX));
        Self { x: zero, y: zero, z: zero, denominator: zero }
    }
}

/// The pixels at which a wire says something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// All of them.
    Always,
    /// Those whose ray meets the plane of the divider, or starts at the eye.
    Entered,
    /// Those that show the surface or a side of the map.
    OnSurface,
    /// Those that show the surface.
    Lit,
}

impl When {
    /// What the header of a file adds to a meaning; nothing where it is always valid.
    pub fn note(self) -> &'static str {
        match self {
            Self::Always => "",
            Self::Entered => "; valid if met",
            Self::OnSurface => "; valid on surface and side",
            Self::Lit => "; valid on surface",
        }
    }
}

macro_rules! wires {
    ($($(#[$doc:meta])* $field:ident $wire:ident $class:ident.$format:ident $register:ident
        $when:ident $meaning:literal,)*
        ; colors $($(#[$color_doc:meta])* $color:ident($red:ident $green:ident $blue:ident),)*) => {
        /// The wires of one scan line. A unit that is not fitted leaves its wires as they are.
        #[derive(Clone, Debug)]
        pub struct Line<W: World> {
            /// Scan line from the top.
            pub number: u32,
            /// The accumulators of each surface's projector at the first column.
            pub start: Vec<LineStart<W>>,
            /// Column of each pixel.
            pub column: Vec<u32>,
            $($(#[$doc])* pub $field: Vec<W::$class>,)*
            $($(#[$color_doc])* pub $color: Vec<[W::Tone; 3]>,)*
            /// Outcome of the projection.
            pub entry: Vec<Entry>,
            /// Outcome of the pixel.
            pub hit: Vec<Hit>,
            /// Index of the sample that hit.
            pub steps: Vec<u32>,
            /// What the stepper did.
            pub work: Vec<Work>,
            /// sRGB bytes.
            pub color: Vec<[u8; 3]>,
            /// Index of the surface whose wires they are.
            pub owner: Vec<u32>,
            /// The wires of the nearest surface so far, where several compete.
            pub nearest: Option<Box<Line<W>>>,
        }

        impl<W: World> Line<W> {
            /// Idle wires for the given columns.
            pub fn new(world: &W, columns: impl IntoIterator<Item = u32>) -> Self {
                let column: Vec<u32> = columns.into_iter().collect();
                let n = column.len();
                Self {
                    number: 0,
                    start: vec![LineStart::idle(world)],
                    column,
                    $($field: vec![W::$class::zero(world.$format(Register::$register)); n],)*
                    $($color: vec![[W::Tone::zero(world.tone(Register::Channel)); 3]; n],)*
                    entry: vec![Entry::Met; n],
                    hit: vec![Hit::Sky; n],
                    steps: vec![0; n],
                    work: vec![Work::default(); n],
                    color: vec![[0; 3]; n],
                    owner: vec![0; n],
                    nearest: None,
                }
            }

            /// Takes over the wires of a pixel, but for the work on it.
            pub fn take_pixel(&mut self, from: &Self, i: usize) {
                $(self.$field[i] = from.$field[i];)*
                $(self.$color[i] = from.$color[i];)*
                self.entry[i] = from.entry[i];
                self.hit[i] = from.hit[i];
                self.steps[i] = from.steps[i];
                self.color[i] = from.color[i];
                self.owner[i] = from.owner[i];
            }

            /// Whether the word on a wire has overflowed its register.
            fn overflowed(&self, wire: Wire, i: usize) -> bool {
                match wire {
                    $(Wire::$wire => self.$field[i].overflowed(),)*
                    $(Wire::$red => self.$color[i][0].overflowed(),
                    Wire::$green => self.$color[i][1].overflowed(),
                    Wire::$blue => self.$color[i][2].overflowed(),)*
                    Wire::Entry | Wire::Hit | Wire::Steps | Wire::Color => false,
                }
            }
        }

        /// A wire between two units, by name.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Wire {
            $($(#[$doc])* $wire,)*
            $($(#[$color_doc])* $red, $(#[$color_doc])* $green, $(#[$color_doc])* $blue,)*
            /// Outcome of the projection.
            Entry,
            /// Outcome of the pixel.
            Hit,
            /// Index of the sample that hit.
            Steps,
            /// Colour of the pixel.
            Color,
        }

        impl Wire {
            /// The wires that carry words.
            pub const WORDS: &'static [Self] = &[
                $(Self::$wire,)* $(Self::$red, Self::$green, Self::$blue,)*
            ];

            /// Name in files, reports and hardware.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$wire => stringify!($field),)*
                    $(Self::$red => concat!(stringify!($color), "_red"),
                    Self::$green => concat!(stringify!($color), "_green"),
                    Self::$blue => concat!(stringify!($color), "_blue"),)*
                    Self::Entry => "entry",
                    Self::Hit => "hit",
                    Self::Steps => "steps",
                    Self::Color => "color",
                }
            }

            /// The register whose format the wire has, where it carries words.
            pub fn register(self) -> Option<Register> {
                match self {
                    $(Self::$wire => Some(Register::$register),)*
                    $(Self::$red | Self::$green | Self::$blue => Some(Register::Channel),)*
                    Self::Entry | Self::Hit | Self::Steps | Self::Color => None,
                }
            }

            /// The pixels at which the unit that drives the wire says something.
            pub fn when(self) -> When {
                match self {
                    $(Self::$wire => When::$when,)*
                    $(Self::$red | Self::$green | Self::$blue => When::Lit,)*
                    Self::Steps => When::OnSurface,
                    Self::Entry | Self::Hit | Self::Color => When::Always,
                }
            }

            /// The pixels at which it is driven: a ray that misses has walked all the same.
            pub fn driven(self) -> When {
                match self {
                    Self::GroundX | Self::GroundZ => When::Entered,
                    Self::Steps => When::Always,
                    _ => self.when(),
                }
            }

            /// What it carries, in half a sentence.
            pub fn meaning(self) -> &'static str {
                match self {
                    $(Self::$wire => $meaning,)*
                    $(Self::$red | Self::$green | Self::$blue => "channel, 0 to 255",)*
                    Self::Entry => "0 met, 1 sky, 2 out of range",
                    Self::Hit => "0 sky, 1 surface, 2 side, 3 out of range",
                    Self::Steps => "index of the sample that hit",
                    Self::Color => "red, green, blue, a byte each",
                }
            }
        }

        impl<W: Open> Line<W> {
            /// The bits on a wire; none where words have no bits.
            pub fn bits(&self, wire: Wire, i: usize) -> Option<i64> {
                match wire {
                    $(Wire::$wire => self.$field[i].raw(),)*
                    $(Wire::$red => self.$color[i][0].raw(),
                    Wire::$green => self.$color[i][1].raw(),
                    Wire::$blue => self.$color[i][2].raw(),)*
                    Wire::Entry => Some(self.entry[i] as i64),
                    Wire::Hit => Some(self.hit[i] as i64),
                    Wire::Steps => Some(self.steps[i].into()),
                    Wire::Color => {
                        let [red, green, blue] = self.color[i].map(i64::from);
                        Some(red << 16 | green << 8 | blue)
                    }
                }
            }

            /// The word on a wire as a number; none for a wire that carries no word.
            pub fn value(&self, wire: Wire, i: usize) -> Option<f64> {
                match wire {
                    $(Wire::$wire => Some(self.$field[i].value()),)*
                    $(Wire::$red => Some(self.$color[i][0].value()),
                    Wire::$green => Some(self.$color[i][1].value()),
                    Wire::$blue => Some(self.$color[i][2].value()),)*
                    Wire::Entry | Wire::Hit | Wire::Steps | Wire::Color => None,
                }
            }
        }
    };
}

impl<W: World> Line<W> {
    /// Number of pixels on the wires.
    pub fn len(&self) -> usize {
        self.column.len()
    }

    /// Whether there are no pixels on the wires.
    pub fn is_empty(&self) -> bool {
        self.column.is_empty()
    }

    /// Whether a pixel is one of those.
    pub fn is(&self, when: When, i: usize) -> bool {
        match when {
            When::Always => true,
            When::Entered => self.entry[i] == Entry::Met,
            When::OnSurface => matches!(self.hit[i], Hit::Surface | Hit::Side),
            When::Lit => self.hit[i] == Hit::Surface,
        }
    }

    /// Registers whose wires carry overflowed values: pixels, and the first pixel's column. Empty
    /// in stock worlds, whose ranges are proved.
    pub fn overflows(&self) -> Vec<(Register, u64, u32)> {
        let mut found = Vec::new();
        for &register in Register::ALL {
            let of_register = |wire: &&Wire| wire.register() == Some(register);
            let wires: Vec<Wire> = Wire::WORDS.iter().filter(of_register).copied().collect();
            let mut pixels = (0..self.len()).filter(|&i| {
                wires.iter().any(|&wire| self.is(wire.driven(), i) && self.overflowed(wire, i))
            });
            if let Some(first) = pixels.next() {
                found.push((register, 1 + pixels.count() as u64, self.column[first]));
            }
        }
        found
    }
}

wires! {
    /// View vector, x in cells (on a plane: along its first axis, in squares).
    view_x ViewX View.view ViewX Always "view vector along x",
    /// View vector, y in height units.
    view_y ViewY View.view ViewY Always "view vector along y",
    /// View vector, z in cells (on a plane: along its second axis, in squares).
    view_z ViewZ View.view ViewZ Always "view vector along z",
    /// Denominator of the projection.
    denominator Denominator View.view Denominator Always "positive towards the plane",
    /// 1/λ of the surface that shows, in the scale of all that compete; zero where none does.
    depth Depth View.view Denominator Always "nearness, greatest for what shows",
    /// Where the ray meets the plane of the divider, x.
    entry_x EntryX Ground.ground GroundX Entered "eye plus quotient, x",
    /// Where the ray meets the plane of the divider, z.
    entry_z EntryZ Ground.ground GroundZ Entered "eye plus quotient, z",
    /// Where the ray meets the surface, x.
    ground_x GroundX Ground.ground GroundX OnSurface "place of the hit, x",
    /// Where the ray meets the surface, z.
    ground_z GroundZ Ground.ground GroundZ OnSurface "place of the hit, z",
    /// Height of the surface there.
    surface Surface Height.height Surface OnSurface "surface height",
    /// Negated slope of the surface against x.
    slope_x SlopeX Height.height SlopeX OnSurface "negated slope along x",
    /// Negated slope of the surface against z.
    slope_z SlopeZ Height.height SlopeZ OnSurface "negated slope along z",
    /// Light that the surface reflects, from 0 to 1.
    shade Shade Tone.tone Shade Lit "ambient plus diffuse light",
    ; colors
    /// Colour of the ground before it is lit, channels from 0 to 255.
    albedo(AlbedoRed AlbedoGreen AlbedoBlue),
    /// Colour of the lit ground, channels from 0 to 255.
    lit(LitRed LitGreen LitBlue),
}
