//! The table of buffers: all that can be known of a pixel, written down once.
//!
//! A new buffer is a line of [`TABLE`] and its value in the two places that make a [`Pixel`]:
//! `readout` for the engines, `oracle::draw` for the oracle. Buffers that no engine gives are added
//! to a frame by whoever measures them.

use glam::DVec3;

use super::hit::Hit;

/// Type of an array's elements, little-endian.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dtype {
    /// `|u1`
    U1,
    /// `<u4`
    U4,
    /// `<f8`
    F8,
}

impl Dtype {
    /// As numpy writes it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::U1 => "|u1",
            Self::U4 => "<u4",
            Self::F8 => "<f8",
        }
    }

    /// Bytes of an element.
    #[must_use]
    pub fn bytes(self) -> usize {
        match self {
            Self::U1 => 1,
            Self::U4 => 4,
            Self::F8 => 8,
        }
    }
}

/// An array without its type: the scalars of all pixels, those of one pixel side by side.
#[derive(Clone, Copy, Debug)]
pub enum Scalars<'a> {
    /// Floats.
    F8(&'a [f64]),
    /// Integers.
    U4(&'a [u32]),
    /// Bytes.
    U1(&'a [u8]),
    /// Outcomes, as their discriminants.
    Hit(&'a [Hit]),
}

impl Scalars<'_> {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::F8(values) => values.len(),
            Self::U4(values) => values.len(),
            Self::U1(values) => values.len(),
            Self::Hit(values) => values.len(),
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The little-endian bytes, some `count` scalars at a time.
    pub fn pieces(&self, count: usize) -> impl Iterator<Item = Vec<u8>> {
        fn bytes<T, const N: usize>(values: &[T], bytes: impl Fn(&T) -> [u8; N]) -> Vec<u8> {
            values.iter().flat_map(bytes).collect()
        }
        let scalars = *self;
        (0..self.len()).step_by(count.max(1)).map(move |from| {
            let piece = from..scalars.len().min(from + count);
            match scalars {
                Scalars::F8(values) => bytes(&values[piece], |value| value.to_le_bytes()),
                Scalars::U4(values) => bytes(&values[piece], |value| value.to_le_bytes()),
                Scalars::U1(values) => values[piece].to_vec(),
                Scalars::Hit(values) => bytes(&values[piece], |&hit| [hit as u8]),
            }
        })
    }
}

/// What a buffer holds of one pixel.
pub trait Element: Copy {
    /// Type of its scalars.
    const DTYPE: Dtype;
    /// Number of its scalars; more than one are the array's third axis.
    const COMPONENTS: usize;
    /// What stands where the ray meets nothing.
    const MISS: Self;

    /// Many of them as scalars.
    fn scalars(values: &[Self]) -> Scalars<'_>;
}

macro_rules! element {
    ($type:ty, $dtype:ident, $components:literal, $miss:expr, $values:ident => $scalars:expr) => {
        impl Element for $type {
            const DTYPE: Dtype = Dtype::$dtype;
            const COMPONENTS: usize = $components;
            const MISS: Self = $miss;

            fn scalars($values: &[Self]) -> Scalars<'_> {
                $scalars
            }
        }
    };
}

element!(f64, F8, 1, f64::NAN, values => Scalars::F8(values));
element!([f64; 3], F8, 3, [f64::NAN; 3], values => Scalars::F8(values.as_flattened()));
element!(u32, U4, 1, 0, values => Scalars::U4(values));
element!([u8; 3], U1, 3, [0; 3], values => Scalars::U1(values.as_flattened()));
element!(Hit, U1, 1, Hit::Sky, values => Scalars::Hit(values));

/// Who gives a buffer; of the engines, each also gives what those before it give.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Giver {
    /// All engines and the oracle.
    Engines,
    /// The units in their order only, in fixed point or in f64.
    Processor,
    /// The study of errors, beside a frame in fixed point.
    Errors,
    /// The clock of the processor.
    Clock,
}

/// A row of the table: one array of a frame.
#[derive(Clone, Copy, Debug)]
pub struct BufferRow {
    /// Name of the array.
    pub name: &'static str,
    /// Type of its scalars.
    pub dtype: Dtype,
    /// Scalars of a pixel.
    pub components: usize,
    /// Who gives it.
    pub giver: Giver,
    /// What it holds, with its unit.
    pub holds: &'static str,
}

impl BufferRow {
    const fn of<T: Element>(name: &'static str, giver: Giver, holds: &'static str) -> Self {
        Self { name, dtype: T::DTYPE, components: T::COMPONENTS, giver, holds }
    }

    /// The array's axes for a frame of this many lines and columns.
    #[must_use]
    pub fn shape(&self, lines: usize, columns: usize) -> Vec<usize> {
        let third = (self.components > 1).then_some(self.components);
        [lines, columns].into_iter().chain(third).collect()
    }
}

macro_rules! table {
    (
        always { hit: $hit:literal, color: $color:literal }
        on request { $($name:ident: $type:ty, $giver:ident, $holds:literal;)* }
        measured { $($added:ident: $added_type:ty, $by:ident, $added_holds:literal;)* }
    ) => {
        /// What is known of one pixel beside its outcome and colour.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Pixel {
            $(#[doc = concat!($holds, ".")] pub $name: $type,)*
        }

        impl Pixel {
            /// A pixel that meets nothing.
            pub const MISS: Self = Self { $($name: <$type as Element>::MISS,)* };
        }

        /// The requested buffers of a frame, a value per pixel each; [`Element::MISS`] where the
        /// ray meets nothing, empty where the engine does not give it or nobody has measured it.
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct Buffers {
            $(#[doc = concat!($holds, ".")] pub $name: Vec<$type>,)*
            $(#[doc = concat!($added_holds, ".")] pub $added: Vec<$added_type>,)*
        }

        impl Buffers {
            /// Room for this many pixels of an engine.
            #[must_use]
            pub fn with_room(pixels: usize) -> Self {
                Self {
                    $($name: Vec::with_capacity(pixels),)*
                    $($added: Vec::new(),)*
                }
            }

            /// The next pixel, from who gives it.
            #[inline]
            pub fn push(&mut self, pixel: Pixel, giver: Giver) {
                $(if Giver::$giver <= giver {
                    self.$name.push(pixel.$name);
                })*
            }

            /// Other pixels after these.
            pub fn append(&mut self, other: Self) {
                $(self.$name.extend(other.$name);)*
                $(self.$added.extend(other.$added);)*
            }

            /// All arrays, in the order of the table.
            #[must_use]
            pub fn scalars(&self) -> [Scalars<'_>; REQUESTED] {
                [
                    $(<$type>::scalars(&self.$name),)*
                    $(<$added_type>::scalars(&self.$added),)*
                ]
            }
        }

        /// Arrays that frames have on request only.
        const REQUESTED: usize = [$(stringify!($name),)* $(stringify!($added),)*].len();

        /// All arrays of a frame, in the order of files.
        pub static TABLE: [BufferRow; REQUESTED + 2] = [
            BufferRow::of::<Hit>("hit", Giver::Engines, $hit),
            $(BufferRow::of::<$type>(stringify!($name), Giver::$giver, $holds),)*
            $(BufferRow::of::<$added_type>(stringify!($added), Giver::$by, $added_holds),)*
            BufferRow::of::<[u8; 3]>("color", Giver::Engines, $color),
        ];
    };
}

table! {
    always {
        hit: "outcome: 0 sky, 1 surface, 2 side of the map or of a hole, 3 out of range: beyond the registers' range",
        color: "sRGB"
    }
    on request {
        lambda: f64, Engines,
            "λ of r_h + λ V, V the view vector of the pixel with the screen at its own distance";
        ground_x: f64, Engines, "x of the place on the ground, scene units";
        ground_z: f64, Engines, "z of the place on the ground, scene units";
        height: f64, Engines,
            "surface height at that place, scene units; on a side of the map that of its rim";
        normal: [f64; 3], Engines, "unit normal of the surface at that place";
        steps: u32, Engines, "index of the sample that hit; the oracle has none (0)";
        trials: u32, Processor, "skip tests: reads of the skip pyramid";
    }
    measured {
        error_px: f64, Errors,
            "total error against the oracle, pixels; infinite where the pixel is lost, NaN where the oracle sees no surface";
        cycles: u32, Clock,
            "cycles that the machine takes from the pixel before it, or the start, to this one, misses too; their sum is the frame's";
    }
}

impl Buffers {
    /// The place on the surface that a pixel shows, scene units.
    #[must_use]
    pub fn point(&self, pixel: usize) -> DVec3 {
        DVec3::new(self.ground_x[pixel], self.height[pixel], self.ground_z[pixel])
    }
}

impl Pixel {
    /// The place on the surface, scene units.
    #[must_use]
    pub fn point(&self) -> DVec3 {
        DVec3::new(self.ground_x, self.height, self.ground_z)
    }
}
