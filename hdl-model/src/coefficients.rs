//! The coefficients that the RTL is loaded with before a frame: their addresses and bits, and their
//! values from the emulator's set-up. The names are those of `terraline::unit::coefficient`.

use terraline::setup::Setup;
use terraline::unit::coefficient::{Bank, Coefficient, Kind};
use terraline::word::{Complete, Readout, Register};

/// A part of the machine that holds its coefficients in a bank of registers of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Raster scan, projector and divider.
    Front,
    /// The height map and its kernel, for whatever interpolates.
    Map,
    /// The stepper.
    Walk,
    /// The shader of a height map.
    Shader,
    /// The checker of a plane.
    Checker,
}

impl Part {
    /// All parts, in the order of the chain.
    pub const ALL: [Self; 5] = [Self::Front, Self::Map, Self::Walk, Self::Shader, Self::Checker];

    /// Module of its bank.
    pub fn module(self) -> &'static str {
        match self {
            Self::Front => "registers_front",
            Self::Map => "registers_map",
            Self::Walk => "registers_walk",
            Self::Shader => "registers_shader",
            Self::Checker => "registers_checker",
        }
    }

    /// What the coefficients are about.
    pub fn about(self) -> &'static str {
        match self {
            Self::Front => "raster scan, projector and divider",
            Self::Map => "a height map, its kernel and its memory",
            Self::Walk => "the stepper",
            Self::Shader => "the shader of a height map",
            Self::Checker => "the checker of a plane",
        }
    }

    /// Its coefficients.
    pub fn coefficients(self) -> impl Iterator<Item = Coefficient> {
        all().filter(move |&coefficient| parts(coefficient).contains(&self))
    }
}

/// The parts that have a register for a coefficient, at most one of them in a machine.
fn parts(coefficient: Coefficient) -> &'static [Part] {
    use Coefficient as C;
    match coefficient {
        C::Columns
        | C::Lines
        | C::ViewXStart
        | C::ViewXPerLine
        | C::ViewXPerColumn
        | C::ViewYStart
        | C::ViewYPerLine
        | C::ViewYPerColumn
        | C::ViewZStart
        | C::ViewZPerLine
        | C::ViewZPerColumn
        | C::DenominatorStart
        | C::DenominatorPerLine
        | C::DenominatorPerColumn
        | C::EyeX
        | C::EyeZ
        | C::RatioShiftX
        | C::RatioBitsX
        | C::FromEye => &[Part::Front],
        C::EyeY
        | C::Highest
        | C::Base
        | C::Fineness
        | C::Last
        | C::BisectionFixed
        | C::BisectionBias
        | C::BisectionCap
        | C::Skipping
        | C::PyramidTop
        | C::BeyondSky
        | C::Sides => &[Part::Walk],
        C::MapColumns
        | C::MapRows
        | C::MapEdge
        | C::VoidBits
        | C::Form
        | C::DeformationShift
        | C::KernelLog2
        | C::SlopeScaled
        | C::SlopeScaleX
        | C::SlopeScaleZ
        | C::MemoryLatency => &[Part::Map],
        C::SkyColor | C::OutOfRangeColor => &[Part::Shader, Part::Checker],
        C::SideColor
        | C::Lit
        | C::LightX
        | C::LightY
        | C::LightZ
        | C::Ambient
        | C::RampExponent
        | C::RampGain
        | C::RampLast => &[Part::Shader],
        C::MeanRed
        | C::MeanGreen
        | C::MeanBlue
        | C::SwingRed
        | C::SwingGreen
        | C::SwingBlue
        | C::ContrastExponent
        | C::ContrastGain
        | C::FullFromFitted
        | C::FullFrom => &[Part::Checker],
        // There is one ratio for both axes, which have one format in stock words; ones and the size of
        // the root's table are constants of the modules.
        C::RatioShiftZ | C::RatioBitsZ | C::WeightOne | C::ShadeOne | C::RsqrtLog2 => &[],
    }
}

/// All coefficients of the RTL; the place in this list is the address.
pub fn all() -> impl Iterator<Item = Coefficient> {
    Coefficient::ALL.iter().copied().filter(|&coefficient| !parts(coefficient).is_empty())
}

/// Bits of a coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bits {
    /// A word of the machine, signed.
    Word,
    /// A number of nodes, as many bits as positions have before the point.
    Cell,
    /// So many bits, unsigned.
    Unsigned(u32),
    /// So many bits, signed.
    Signed(u32),
}

/// The bits of a register of the RTL.
pub fn bits(coefficient: Coefficient) -> Bits {
    match coefficient.kind() {
        Kind::Word(_) => Bits::Word,
        Kind::Nodes => Bits::Cell,
        Kind::Flag => Bits::Unsigned(1),
        Kind::Code => Bits::Unsigned(2),
        Kind::Count(bits) => Bits::Unsigned(bits),
        Kind::Exponent => Bits::Signed(8),
        Kind::Color => Bits::Unsigned(24),
    }
}

/// The bits of a stock word.
pub fn raw<T: Readout>(word: T) -> i64 {
    word.raw().unwrap_or_else(|| unreachable!("stock words have bits"))
}

/// Address and word of every coefficient of a set-up; those that it does not use are zero.
pub fn words<W: Complete>(setup: &Setup<W>) -> Vec<(usize, i64)> {
    let mut bank = Bank::default();
    setup.coefficients(&mut bank);
    let values: Vec<(Coefficient, i64)> = bank.bits().collect();
    let word = |coefficient: Coefficient| {
        let value = values.iter().find(|(known, _)| *known == coefficient);
        let value = value.map_or(0, |&(_, value)| value);
        match coefficient.kind() {
            // Shifts by more than a word leave nothing, whatever they are; a numerator that is
            // shifted further than that is out of range unless it is zero.
            Kind::Exponent if coefficient == Coefficient::RatioShiftX => {
                value.min(most_shift(setup)).clamp(-128, 127)
            }
            Kind::Exponent => value.clamp(-128, 127),
            // Red is in the low byte there.
            Kind::Color => i64::from((value as u32).swap_bytes() >> 8),
            // Without a ROM nobody looks; the smallest table has 16 entries.
            _ if coefficient == Coefficient::KernelLog2 => value.max(4),
            _ => value,
        }
    };
    all().map(word).enumerate().collect()
}

/// Places by which numerators may be shifted left.
fn most_shift<W: Complete>(setup: &Setup<W>) -> i64 {
    let width = setup.world.fixed(Register::ViewX).map_or(0, |fixed| fixed.width);
    let bits = setup.surfaces[0].divider.as_ref().map_or(0, |divider| divider.bits[0]);
    i64::from(width + bits) - 2
}
