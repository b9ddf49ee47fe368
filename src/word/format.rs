//! Fixed-point formats with their rounding and overflow, on plain integers.

/// Rounding of a fixed-point result; by default that of stock registers. Where the algorithm fixes
/// a rounding (quotients are floored, steps of a ray go to nearest) the format's does not matter; a
/// plan refuses it for registers that know no other ([`Register::is_rounded`](super::Register::is_rounded)).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Rounding {
    /// Toward minus infinity: bits are dropped.
    Floor,
    /// Toward zero.
    TowardZero,
    /// To nearest, ties upward.
    #[default]
    Nearest,
    /// To nearest, ties to even.
    NearestEven,
    /// Up with the probability of the dropped fraction, drawn from the scene's seed and the
    /// place of the operation.
    Stochastic,
}

/// Overflow of a fixed-point result; by default that of stock registers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Overflow {
    /// Modulo 2^width.
    #[default]
    Wrap,
    /// To the nearest end of the range.
    Saturate,
}

/// Width and binary point of a two's-complement register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fixed {
    /// Bits in all, sign included.
    pub width: u32,
    /// Bits after the point.
    pub point: u32,
}

impl Fixed {
    /// Value of the last bit.
    pub fn ulp(self) -> f64 {
        libm::exp2(-f64::from(self.point))
    }

    /// First value above the range, `2^(width-1-point)`.
    pub fn limit(self) -> f64 {
        libm::exp2(f64::from(self.width) - 1.0 - f64::from(self.point))
    }
}

impl std::fmt::Display for Fixed {
    /// `Q12.20`: bits before the point (sign included), bits after it.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Q{}.{}", i64::from(self.width) - i64::from(self.point), self.point)
    }
}

impl Overflow {
    /// Both, in the order in which messages list them.
    pub const ALL: [Self; 2] = [Self::Wrap, Self::Saturate];

    /// Name in scene files, options and headers of test vectors.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Wrap => "wrap",
            Self::Saturate => "saturate",
        }
    }

    /// The overflow of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|overflow| overflow.name() == name)
    }
}

impl Rounding {
    /// All of them, in the order in which messages list them.
    pub const ALL: [Self; 5] =
        [Self::Floor, Self::TowardZero, Self::Nearest, Self::NearestEven, Self::Stochastic];

    /// Name in scene files, options and headers of test vectors.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Floor => "floor",
            Self::TowardZero => "toward_zero",
            Self::Nearest => "nearest",
            Self::NearestEven => "nearest_even",
            Self::Stochastic => "stochastic",
        }
    }

    /// The rounding of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rounding| rounding.name() == name)
    }

    /// `value / 2^places`, rounded; `random` supplies the bits of stochastic rounding.
    pub fn shift_right(self, value: i128, places: u32, random: impl FnOnce() -> u64) -> i128 {
        if places == 0 {
            return value;
        }
        // Beyond 126 places every value below 2^126 is a fraction below one half.
        let places = places.min(126);
        let floor = value >> places;
        let rest = value - (floor << places);
        let half = 1_i128 << (places - 1);
        let up = match self {
            Self::Floor => false,
            Self::TowardZero => value < 0 && rest != 0,
            Self::Nearest => rest >= half,
            Self::NearestEven => rest > half || (rest == half && floor & 1 == 1),
            Self::Stochastic => {
                // The dropped fraction, cut to 63 bits, against 63 random bits.
                let fraction =
                    if places > 63 { rest >> (places - 63) } else { rest << (63 - places) };
                i128::from(random() >> 1) < fraction
            }
        };
        floor + i128::from(up)
    }
}

/// A hash of two words whose bits all depend on all bits (the finaliser of SplitMix64, applied twice): the source of
/// random bits, a function of its place alone, so that the order of operations does not matter.
pub fn hash(seed: u64, place: u64) -> u64 {
    let round = |mut z: u64| {
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    round(round(seed.wrapping_add(0x9e37_79b9_7f4a_7c15)).wrapping_add(place))
}
