//! Compressed strips and tiles as streams: a stream holds a few buffers, whatever a block claims
//! to unpack to.

use std::io::{self, BufReader, Read};

use flate2::read::ZlibDecoder;
use ruzstd::decoding::StreamingDecoder;
use weezl::{BitOrder, LzwStatus, decode};

use super::compression::Compression;

/// Zstandard keeps so many unpacked bytes at most: GDAL's writers stay far below.
const ZSTANDARD_WINDOW: u64 = 128 << 20;

/// The unpacked bytes of a block, of LERC the block itself.
pub(super) fn stream(
    packed: &[u8],
    compression: Compression,
) -> Result<Box<dyn Read + '_>, String> {
    Ok(match compression {
        Compression::None | Compression::Lerc(_) => Box::new(packed),
        Compression::Zstandard => Box::new(
            StreamingDecoder::new_with_max_window_size(packed, ZSTANDARD_WINDOW)
                .map_err(|error| error.to_string())?,
        ),
        Compression::Deflate => Box::new(ZlibDecoder::new(packed)),
        Compression::Lzw => Box::new(BufReader::new(Lzw {
            packed,
            decoder: decode::Configuration::with_tiff_size_switch(BitOrder::Msb, 8).build(),
        })),
        Compression::PackBits => Box::new(BufReader::new(PackBits { packed, run: Run::Done })),
    })
}

struct Lzw<'a> {
    packed: &'a [u8],
    decoder: decode::Decoder,
}

impl Read for Lzw<'_> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        loop {
            let done = self.decoder.decode_bytes(self.packed, to);
            self.packed = &self.packed[done.consumed_in..];
            if done.consumed_out > 0 {
                // What came before an error is sound; without more, the error comes again.
                return Ok(done.consumed_out);
            }
            match done.status {
                Ok(LzwStatus::Ok) if done.consumed_in > 0 => {}
                // Some writers leave out the code for the end.
                Ok(_) => return Ok(0),
                Err(error) => return Err(io::Error::new(io::ErrorKind::InvalidData, error)),
            }
        }
    }
}

/// Byte-wise run lengths: n < 128 is followed by n + 1 bytes as they are, n > 128 by one byte that
/// stands 257 - n times, 128 means nothing.
struct PackBits<'a> {
    packed: &'a [u8],
    run: Run,
}

enum Run {
    Done,
    /// Bytes as they are.
    Plain(usize),
    Repeated(u8, usize),
}

impl Read for PackBits<'_> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        loop {
            match self.run {
                Run::Plain(left) if left > 0 => {
                    let length = left.min(to.len()).min(self.packed.len());
                    let (plain, rest) = self.packed.split_at(length);
                    to[..length].copy_from_slice(plain);
                    self.packed = rest;
                    self.run = Run::Plain(left - length);
                    return Ok(length);
                }
                Run::Repeated(byte, left) if left > 0 => {
                    let length = left.min(to.len());
                    to[..length].fill(byte);
                    self.run = Run::Repeated(byte, left - length);
                    return Ok(length);
                }
                _ => {}
            }
            let Some((&head, rest)) = self.packed.split_first() else { return Ok(0) };
            self.packed = rest;
            self.run = match (head, rest.split_first()) {
                (128, _) => Run::Done,
                (0..128, _) => Run::Plain(usize::from(head) + 1),
                (_, Some((&byte, rest))) => {
                    self.packed = rest;
                    Run::Repeated(byte, 257 - usize::from(head))
                }
                (_, None) => Run::Done,
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packbits_as_the_specification_shows() {
        // The example of Apple's Technical Note 1023.
        let packed = [
            0xFE, 0xAA, 0x02, 0x80, 0x00, 0x2A, 0xFD, 0xAA, 0x03, 0x80, 0x00, 0x2A, 0x22, 0xF7,
            0xAA,
        ];
        let mut unpacked = Vec::new();
        stream(&packed, Compression::PackBits).unwrap().read_to_end(&mut unpacked).unwrap();
        let mut expected = vec![0xAA, 0xAA, 0xAA, 0x80, 0x00, 0x2A, 0xAA, 0xAA, 0xAA, 0xAA];
        expected.extend([0x80, 0x00, 0x2A, 0x22]);
        expected.extend([0xAA; 10]);
        assert_eq!(unpacked, expected);
    }

    #[test]
    fn lzw_in_portions_of_any_size_and_without_an_end() {
        let plain: Vec<u8> = (0..20_000_u32).map(|k| (k / 7 % 5 * k % 251) as u8).collect();
        let mut encoder = weezl::encode::Encoder::with_tiff_size_switch(BitOrder::Msb, 8);
        let packed = encoder.encode(&plain).unwrap();
        for portion in [1, 14, 64, 8192, 20_000] {
            // The code for the end takes one or two bytes.
            for packed in [&packed[..], &packed[..packed.len() - 1]] {
                let mut unpacked = vec![0; plain.len()];
                let mut stream = stream(packed, Compression::Lzw).unwrap();
                for part in unpacked.chunks_mut(portion) {
                    stream.read_exact(part).unwrap();
                }
                assert_eq!(unpacked, plain);
            }
        }
    }
}
