//! The coefficient registers: what is loaded before a frame and does not change within it.
//!
//! Every coefficient is declared once, in the list at the end of this file. Units put their values into
//! a [`Bank`]; test vectors and the RTL's register bank read them from there.

use crate::word::{Open, Readout, Register, World};

/// What a coefficient is, which says how many bits hold it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A word in the format of a register.
    Word(Register),
    /// A number of nodes of the map along an axis.
    Nodes,
    /// 0 or 1.
    Flag,
    /// One of up to four cases.
    Code,
    /// A whole number that is not negative, of this many bits in hardware.
    Count(u32),
    /// A power of two.
    Exponent,
    /// sRGB bytes, blue in the low byte.
    Color,
}

macro_rules! coefficients {
    ($($variant:ident $name:literal $kind:expr, $meaning:literal;)*) => {
        /// A coefficient register.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Coefficient { $(#[doc = $meaning] $variant,)* }

        impl Coefficient {
            /// All of them, in the order of the data flow.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// Name in files, reports and hardware.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// How it is loaded: its bits in hardware.
            pub const fn kind(self) -> Kind {
                match self { $(Self::$variant => $kind,)* }
            }

            /// What it holds, in half a sentence.
            pub const fn meaning(self) -> &'static str {
                match self { $(Self::$variant => $meaning,)* }
            }
        }
    };
}

/// A value of a coefficient.
#[derive(Clone, Copy, Debug)]
enum Value<W: World> {
    View(W::View),
    Ground(W::Ground),
    Height(W::Height),
    Weight(W::Weight),
    Tone(W::Tone),
    Number(i64),
}

/// Coefficients with their values, in the order in which units put them in.
#[derive(Clone, Debug)]
pub struct Bank<W: World>(Vec<(Coefficient, Value<W>)>);

impl<W: World> Default for Bank<W> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<W: World> Bank<W> {
    /// Puts in a word of class view.
    pub fn view(&mut self, coefficient: Coefficient, word: W::View) {
        self.0.push((coefficient, Value::View(word)));
    }

    /// Puts in a word of class ground.
    pub fn ground(&mut self, coefficient: Coefficient, word: W::Ground) {
        self.0.push((coefficient, Value::Ground(word)));
    }

    /// Puts in a word of class height.
    pub fn height(&mut self, coefficient: Coefficient, word: W::Height) {
        self.0.push((coefficient, Value::Height(word)));
    }

    /// Puts in a word of class weight.
    pub fn weight(&mut self, coefficient: Coefficient, word: W::Weight) {
        self.0.push((coefficient, Value::Weight(word)));
    }

    /// Puts in a word of class tone.
    pub fn tone(&mut self, coefficient: Coefficient, word: W::Tone) {
        self.0.push((coefficient, Value::Tone(word)));
    }

    /// Puts in a whole number.
    pub fn number(&mut self, coefficient: Coefficient, number: impl Into<i64>) {
        self.0.push((coefficient, Value::Number(number.into())));
    }

    /// Puts in a colour.
    pub fn color(&mut self, coefficient: Coefficient, [red, green, blue]: [u8; 3]) {
        self.number(coefficient, u32::from_be_bytes([0, red, green, blue]));
    }
}

impl<W: Open> Bank<W> {
    /// The coefficients with their bits; words without bits are zero.
    pub fn bits(&self) -> impl Iterator<Item = (Coefficient, i64)> + '_ {
        self.0.iter().map(|&(coefficient, value)| {
            let bits = match value {
                Value::View(word) => word.raw(),
                Value::Ground(word) => word.raw(),
                Value::Height(word) => word.raw(),
                Value::Weight(word) => word.raw(),
                Value::Tone(word) => word.raw(),
                Value::Number(number) => Some(number),
            };
            (coefficient, bits.unwrap_or_default())
        })
    }
}

use Kind::{Code, Color, Count, Exponent, Flag, Nodes, Word};
use Register as R;

coefficients! {
    Columns "columns" Count(16), "pixels across";
    Lines "lines" Count(16), "scan lines";
    ViewXStart "view_x_start" Word(R::ViewX), "view_x at line 0, column 0";
    ViewXPerLine "view_x_per_line" Word(R::ViewX), "its increment per line";
    ViewXPerColumn "view_x_per_column" Word(R::ViewX), "its increment per column";
    ViewYStart "view_y_start" Word(R::ViewY), "view_y at line 0, column 0";
    ViewYPerLine "view_y_per_line" Word(R::ViewY), "its increment per line";
    ViewYPerColumn "view_y_per_column" Word(R::ViewY), "its increment per column";
    ViewZStart "view_z_start" Word(R::ViewZ), "view_z at line 0, column 0";
    ViewZPerLine "view_z_per_line" Word(R::ViewZ), "its increment per line";
    ViewZPerColumn "view_z_per_column" Word(R::ViewZ), "its increment per column";
    DenominatorStart "denominator_start" Word(R::Denominator), "denominator at line 0, column 0";
    DenominatorPerLine "denominator_per_line" Word(R::Denominator), "its increment per line";
    DenominatorPerColumn "denominator_per_column" Word(R::Denominator), "its increment per column";
    EyeX "eye_x" Word(R::GroundX), "the eye, x: cells, or squares of a plane";
    EyeZ "eye_z" Word(R::GroundZ), "the eye, z";
    RatioShiftX "ratio_shift_x" Exponent,
        "places to shift the numerator left (right if negative) before the ratio, x";
    RatioShiftZ "ratio_shift_z" Exponent, "the same, z";
    RatioBitsX "ratio_bits_x" Count(6),
        "quotient bits, x: the quotient is in range from -2^(bits-1) to 2^(bits-1)-1";
    RatioBitsZ "ratio_bits_z" Count(6), "the same, z";
    FromEye "from_eye" Flag, "1 where rays start at the eye, not at the entry";
    EyeY "eye_y" Word(R::RayY), "the eye, y in height units";
    Highest "highest" Word(R::RayY), "the highest node: y of an entry";
    Base "base" Word(R::RayY), "base of the block under the map";
    Fineness "fineness" Count(3), "k: steps are 2^-k-1 to 2^-k cells";
    Last "last" Count(26), "index of the last sample";
    BisectionFixed "bisection_fixed" Flag, "1 where every hit takes bisection_cap steps";
    BisectionBias "bisection_bias" Exponent, "bisection steps are bias minus leading one";
    BisectionCap "bisection_cap" Count(6), "and at most this many";
    Skipping "skipping" Flag, "1 where the pyramid is fitted";
    PyramidTop "pyramid_top" Count(5), "highest level of the pyramid";
    BeyondSky "beyond_sky" Flag, "1 where an entry out of range is sky, else it stays out of range";
    MapColumns "map_columns" Nodes, "nodes of the map in x";
    MapRows "map_rows" Nodes, "nodes of the map in z";
    MapEdge "map_edge" Code, "beyond the edge: 0 the map ends, 1 its edge nodes go on, 2 it repeats";
    Sides "sides" Flag, "1 where the map has sides, drawn down to the base";
    VoidBits "void_bits" Flag, "1 where nodes may have no data";
    Form "form" Code, "weights: 0 the kernel's, 1 toward the hat's, 2 the hat's, 3 over 3x3 nodes";
    DeformationShift "deformation_shift" Count(6), "places that the difference to the hat is shifted right";
    KernelLog2 "kernel_log2" Count(5), "the kernel tables have 2^log2 entries a cell, and one";
    WeightOne "weight_one" Word(R::Weight), "the weight one";
    SlopeScaled "slope_scaled" Flag, "1 where slopes have factors";
    SlopeScaleX "slope_scale_x" Word(R::Weight), "factor on a slope, x: height unit over cell";
    SlopeScaleZ "slope_scale_z" Word(R::Weight), "the same, z";
    MemoryLatency "memory_latency" Count(7), "M: cycles from address to data";
    SkyColor "sky_color" Color, "colour where nothing is met";
    OutOfRangeColor "out_of_range_color" Color, "colour out of range";
    SideColor "side_color" Color, "colour of the map's side";
    Lit "lit" Flag, "1 where the light is fitted";
    LightX "light_x" Word(R::Shade), "direction towards the light, times the diffuse share, x";
    LightY "light_y" Word(R::Shade), "the same, y";
    LightZ "light_z" Word(R::Shade), "the same, z";
    Ambient "ambient" Word(R::Shade), "the ambient share";
    ShadeOne "shade_one" Word(R::Shade), "full light, full contrast";
    RsqrtLog2 "rsqrt_log2" Count(5), "reciprocal square roots have 2^log2 entries a unit";
    RampExponent "ramp_exponent" Exponent, "heights times two to this power lie in [0, 1)";
    RampGain "ramp_gain" Word(R::Ramp), "ramp segments per such height";
    RampLast "ramp_last" Count(4), "last segment of the ramp";
    MeanRed "mean_red" Word(R::Channel), "mean of the two colours, red";
    MeanGreen "mean_green" Word(R::Channel), "the same, green";
    MeanBlue "mean_blue" Word(R::Channel), "the same, blue";
    SwingRed "swing_red" Word(R::Channel), "half of what they differ by, red";
    SwingGreen "swing_green" Word(R::Channel), "the same, green";
    SwingBlue "swing_blue" Word(R::Channel), "the same, blue";
    ContrastExponent "contrast_exponent" Exponent, "power of two on the denominator";
    ContrastGain "contrast_gain" Word(R::Shade), "gain that makes it contrast plus one";
    FullFromFitted "full_from_fitted" Flag, "1 where some denominator has full contrast";
    FullFrom "full_from" Word(R::Denominator), "denominators from this on have full contrast";
}
