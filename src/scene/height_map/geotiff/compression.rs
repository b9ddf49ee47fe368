//! How strips and tiles are compressed.

use super::super::error::DEFLATE_RATIO;

/// How strips and tiles are compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compression {
    None,
    Lzw,
    Deflate,
    PackBits,
    Zstandard,
    /// ESRI's raster compression, and what its output was packed by in turn.
    Lerc(Packed),
}

/// What the output of LERC was packed by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Packed {
    Plain,
    Deflate,
    Zstandard,
}

impl Compression {
    /// By its number; `lerc` are the values of the tag of LERC's parameters. The error names a
    /// method that is not supported.
    pub(super) fn of(number: u64, lerc: &[u64]) -> Result<Self, &'static str> {
        match number {
            1 => Ok(Self::None),
            5 => Ok(Self::Lzw),
            8 | 32946 => Ok(Self::Deflate),
            32773 => Ok(Self::PackBits),
            50000 => Ok(Self::Zstandard),
            34887 => match lerc.get(1) {
                None | Some(0) => Ok(Self::Lerc(Packed::Plain)),
                Some(1) => Ok(Self::Lerc(Packed::Deflate)),
                Some(2) => Ok(Self::Lerc(Packed::Zstandard)),
                Some(_) => Err("LERC with an unknown method on top"),
            },
            2..=4 => Err("fax"),
            6 | 7 => Err("JPEG"),
            34712 => Err("JPEG 2000"),
            34925 => Err("LZMA"),
            50001 => Err("WebP"),
            50002 => Err("JPEG XL"),
            _ => Err("an unknown method"),
        }
    }

    /// The most bytes that one byte can stand for.
    pub(super) fn ratio(self) -> u64 {
        match self {
            Self::None => 1,
            // A code of at least 9 bits stands for at most 4096 bytes.
            Self::Lzw => 4096,
            Self::Deflate => DEFLATE_RATIO,
            Self::PackBits => 64,
            // A block of 3 bytes and one of a repeated byte stands for 128 KiB.
            Self::Zstandard => 1 << 17,
            // A header stands for a whole block of one height; what it claims is compared with
            // the block before it is decoded.
            Self::Lerc(_) => u64::MAX,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::None => "uncompressed",
            Self::Lzw => "LZW",
            Self::Deflate => "deflate",
            Self::PackBits => "PackBits",
            Self::Zstandard => "Zstandard",
            Self::Lerc(Packed::Plain) => "LERC",
            Self::Lerc(Packed::Deflate) => "LERC with deflate",
            Self::Lerc(Packed::Zstandard) => "LERC with Zstandard",
        }
    }
}
