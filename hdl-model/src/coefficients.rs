//! The coefficients that the RTL is loaded with before a frame: their addresses and bits, and their
//! values from the emulator's set-up. The names are those of `terraline::unit::coefficient`.

use terraline::setup::Setup;
use terraline::unit::coefficient::{Bank, Coefficient, Kind};
use terraline::word::{Complete, Readout, Register};

/// Coefficients that the RTL has no register for: it has one ratio for both axes, which have one
/// format in stock words, and ones and the size of the root's table are constants of its modules.
const CONSTANT: [Coefficient; 5] = [
    Coefficient::RatioShiftZ,
    Coefficient::RatioBitsZ,
    Coefficient::WeightOne,
    Coefficient::ShadeOne,
    Coefficient::RsqrtLog2,
];

/// All coefficients of the RTL; the place in this list is the address.
pub fn all() -> impl Iterator<Item = Coefficient> {
    Coefficient::ALL.iter().copied().filter(|coefficient| !CONSTANT.contains(coefficient))
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
