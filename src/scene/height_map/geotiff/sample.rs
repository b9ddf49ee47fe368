//! Types of samples, and their values.

/// Type of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sample {
    /// One bit, as masks have it.
    Bit,
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F16,
    F32,
    F64,
}

impl Sample {
    pub(super) fn of(format: u64, bits: u64) -> Option<Self> {
        Some(match (format, bits) {
            (1, 1) => Self::Bit,
            // Format 4 is "undefined": integers without a sign, as other readers have it.
            (1 | 4, 8) => Self::U8,
            (1 | 4, 16) => Self::U16,
            (1 | 4, 32) => Self::U32,
            (1 | 4, 64) => Self::U64,
            (2, 8) => Self::I8,
            (2, 16) => Self::I16,
            (2, 32) => Self::I32,
            (2, 64) => Self::I64,
            (3, 16) => Self::F16,
            (3, 32) => Self::F32,
            (3, 64) => Self::F64,
            _ => return None,
        })
    }

    /// Name for reports.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Bit => "bit",
            Self::U8 => "uint8",
            Self::I8 => "int8",
            Self::U16 => "uint16",
            Self::I16 => "int16",
            Self::U32 => "uint32",
            Self::I32 => "int32",
            Self::U64 => "uint64",
            Self::I64 => "int64",
            Self::F16 => "float16",
            Self::F32 => "float32",
            Self::F64 => "float64",
        }
    }

    pub(super) fn bits(self) -> usize {
        match self {
            Self::Bit => 1,
            Self::U8 | Self::I8 => 8,
            Self::U16 | Self::I16 | Self::F16 => 16,
            Self::U32 | Self::I32 | Self::F32 => 32,
            Self::U64 | Self::I64 | Self::F64 => 64,
        }
    }

    /// Bytes of a row of samples.
    pub(super) fn row_bytes(self, columns: usize) -> usize {
        (columns * self.bits()).div_ceil(8)
    }

    pub(super) fn is_float(self) -> bool {
        matches!(self, Self::F16 | Self::F32 | Self::F64)
    }

    /// Whether a sample of this type can have a value.
    pub(super) fn can_be(self, value: f64) -> bool {
        // 64-bit marks are written as decimals, and compared as what `f64` makes of them.
        let (low, high) = match self {
            Self::F16 | Self::F32 | Self::F64 => return true,
            Self::Bit => (0.0, 1.0),
            Self::U8 => (0.0, f64::from(u8::MAX)),
            Self::I8 => (f64::from(i8::MIN), f64::from(i8::MAX)),
            Self::U16 => (0.0, f64::from(u16::MAX)),
            Self::I16 => (f64::from(i16::MIN), f64::from(i16::MAX)),
            Self::U32 => (0.0, f64::from(u32::MAX)),
            Self::I32 => (f64::from(i32::MIN), f64::from(i32::MAX)),
            Self::U64 => (0.0, u64::MAX as f64),
            Self::I64 => (i64::MIN as f64, i64::MAX as f64),
        };
        value.fract() == 0.0 && (low..=high).contains(&value)
    }

    /// Reads a row of samples, hands each to `put` as `f64`.
    pub(super) fn each(self, raw: &[u8], big_endian: bool, mut put: impl FnMut(f64)) {
        match self {
            Self::Bit => raw.iter().for_each(|byte| {
                (0..8).rev().for_each(|bit| put(f64::from((byte >> bit) & 1)));
            }),
            Self::U8 => raw.iter().for_each(|&byte| put(f64::from(byte))),
            Self::I8 => raw.iter().for_each(|&byte| put(f64::from(byte.cast_signed()))),
            Self::U16 => chunks(raw, big_endian, |b| put(f64::from(u16::from_le_bytes(b)))),
            Self::I16 => chunks(raw, big_endian, |b| put(f64::from(i16::from_le_bytes(b)))),
            Self::U32 => chunks(raw, big_endian, |b| put(f64::from(u32::from_le_bytes(b)))),
            Self::I32 => chunks(raw, big_endian, |b| put(f64::from(i32::from_le_bytes(b)))),
            Self::U64 => chunks(raw, big_endian, |b| put(u64::from_le_bytes(b) as f64)),
            Self::I64 => chunks(raw, big_endian, |b| put(i64::from_le_bytes(b) as f64)),
            Self::F16 => chunks(raw, big_endian, |b| put(half(u16::from_le_bytes(b)))),
            Self::F32 => chunks(raw, big_endian, |b| put(f64::from(f32::from_le_bytes(b)))),
            Self::F64 => chunks(raw, big_endian, |b| put(f64::from_le_bytes(b))),
        }
    }
}

/// Numbers of N bytes, lowest byte first.
fn chunks<const N: usize>(raw: &[u8], big_endian: bool, mut put: impl FnMut([u8; N])) {
    let (numbers, _) = raw.as_chunks::<N>();
    for &number in numbers {
        let mut bytes = number;
        if big_endian {
            bytes.reverse();
        }
        put(bytes);
    }
}

/// The value of an IEEE 754 binary16 number.
fn half(bits: u16) -> f64 {
    let sign = if bits >> 15 == 0 { 1.0 } else { -1.0 };
    let (exponent, fraction) = (i32::from((bits >> 10) & 0x1F), f64::from(bits & 0x3FF) / 1024.0);
    let size = match exponent {
        0 => fraction * 2.0_f64.powi(-14),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1.0 + fraction) * 2.0_f64.powi(exponent - 15),
    };
    sign * size
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves() {
        for (bits, value) in [
            (0x3C00, 1.0),
            (0xC000, -2.0),
            (0x7BFF, 65504.0),
            (0x0400, 6.103_515_625e-5),
            (0x0001, 5.960_464_477_539_063e-8),
            (0x7C00, f64::INFINITY),
            (0x8000, 0.0),
        ] {
            assert_eq!(half(bits), value, "{bits:#x}");
        }
        assert!(half(0x7E00).is_nan());
    }
}
