//! The header of a `.npy` array, version 1.0: a magic, a length, and a Python dictionary.
//!
//! Only what this program writes is read: `|u1`, `<u4` and `<f8` in C order.

use std::io::{self, Read};

pub use crate::frame::Dtype;

/// Most elements that an array may claim to have.
pub const MAX_ELEMENTS: u64 = 1 << 30;

/// Most axes that an array may have.
pub const MAX_AXES: usize = 8;

/// Longest dictionary that is read, in bytes.
const MAX_DICTIONARY: usize = 1 << 14;

const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// Type and shape of an array in C order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    /// Type of the elements.
    pub dtype: Dtype,
    /// Length of each axis, the slowest first; no axis for a scalar.
    pub shape: Vec<usize>,
}

impl Header {
    /// The bytes before the first element, a multiple of 64.
    ///
    /// # Panics
    /// If `shape` has so many axes that its text exceeds 64 KiB.
    pub fn to_bytes(&self) -> Vec<u8> {
        let shape: String = self.shape.iter().map(|axis| format!("{axis}, ")).collect();
        let shape =
            if self.shape.len() == 1 { shape.trim_end() } else { shape.trim_end_matches(", ") };
        let mut text = format!(
            "{{'descr': '{}', 'fortran_order': False, 'shape': ({shape}), }}",
            self.dtype.name()
        );
        let before = MAGIC.len() + 2 + 2;
        let padded = (before + text.len() + 1).next_multiple_of(64) - before;
        text.extend(std::iter::repeat_n(' ', padded - text.len() - 1));
        text.push('\n');
        let length = u16::try_from(text.len()).expect("a shape of a few axes");
        [&MAGIC[..], &[1, 0], &length.to_le_bytes(), text.as_bytes()].concat()
    }

    /// Number of elements; `None` if the shape exceeds [`MAX_ELEMENTS`] or [`MAX_AXES`].
    pub fn elements(&self) -> Option<u64> {
        let product =
            self.shape.iter().try_fold(1, |n: u64, &axis| n.checked_mul(axis.try_into().ok()?))?;
        (product <= MAX_ELEMENTS && self.shape.len() <= MAX_AXES).then_some(product)
    }

    /// Reads a header, versions 1.0 to 3.0, and leaves `input` at the first element.
    ///
    /// # Errors
    /// `InvalidData` with the reason when the header is not one that this program reads or its
    /// shape exceeds the limits; what `input` gives.
    pub fn read(input: &mut impl Read) -> io::Result<Self> {
        let mut start = [0; 8];
        input.read_exact(&mut start)?;
        if start[..6] != *MAGIC {
            return Err(invalid("it does not begin as a numpy array"));
        }
        let length = match start[6] {
            1 => {
                let mut length = [0; 2];
                input.read_exact(&mut length)?;
                u16::from_le_bytes(length).into()
            }
            2 | 3 => {
                let mut length = [0; 4];
                input.read_exact(&mut length)?;
                u32::from_le_bytes(length) as usize
            }
            version => return Err(invalid(format!("its version {version} is unknown"))),
        };
        if length > MAX_DICTIONARY {
            return Err(invalid(format!("its header claims {length} bytes")));
        }
        let mut text = vec![0; length];
        input.read_exact(&mut text)?;
        let header = Parser { rest: &text }.dictionary()?;
        if header.elements().is_none() {
            let shape = &header.shape;
            return Err(invalid(format!(
                "its shape {shape:?} has more than {MAX_ELEMENTS} elements or {MAX_AXES} axes"
            )));
        }
        Ok(header)
    }
}

fn invalid(reason: impl Into<String>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, reason.into())
}

/// The few literals of Python that a header may hold.
struct Parser<'a> {
    rest: &'a [u8],
}

impl Parser<'_> {
    /// `{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }`, the keys in any order.
    fn dictionary(mut self) -> io::Result<Header> {
        let (mut dtype, mut order, mut shape) = (None, None, None);
        self.expect(b'{')?;
        while !self.next_is(b'}') {
            let key = self.string()?;
            self.expect(b':')?;
            match &key[..] {
                b"descr" if dtype.is_none() => dtype = Some(self.dtype()?),
                b"fortran_order" if order.is_none() => order = Some(self.truth()?),
                b"shape" if shape.is_none() => shape = Some(self.shape()?),
                _ => return Err(damaged()),
            }
            if !self.next_is(b',') {
                self.expect(b'}')?;
                break;
            }
        }
        self.skip_spaces();
        match (dtype, order, shape) {
            (_, Some(true), _) => Err(invalid("it is in Fortran order; C order is needed")),
            (Some(dtype), Some(false), Some(shape)) if self.rest.is_empty() => {
                Ok(Header { dtype, shape })
            }
            _ => Err(damaged()),
        }
    }

    fn dtype(&mut self) -> io::Result<Dtype> {
        let name = self.string()?;
        let known = [Dtype::U1, Dtype::U4, Dtype::F8];
        known.into_iter().find(|dtype| dtype.name().as_bytes() == name).ok_or_else(|| {
            let name = String::from_utf8_lossy(&name).into_owned();
            invalid(format!("its type is {name:?}; |u1, <u4 or <f8 is needed"))
        })
    }

    fn truth(&mut self) -> io::Result<bool> {
        self.skip_spaces();
        for (text, value) in [(&b"False"[..], false), (b"True", true)] {
            if let Some(rest) = self.rest.strip_prefix(text) {
                self.rest = rest;
                return Ok(value);
            }
        }
        Err(damaged())
    }

    fn shape(&mut self) -> io::Result<Vec<usize>> {
        let mut shape = Vec::new();
        self.expect(b'(')?;
        while !self.next_is(b')') {
            self.skip_spaces();
            let digits = self.rest.iter().take_while(|c| c.is_ascii_digit()).count();
            let (number, rest) = self.rest.split_at(digits);
            self.rest = rest;
            let number = std::str::from_utf8(number).ok().and_then(|text| text.parse().ok());
            shape.push(number.ok_or_else(damaged)?);
            if !self.next_is(b',') {
                self.expect(b')')?;
                break;
            }
        }
        Ok(shape)
    }

    /// A string in quotes, without escapes.
    fn string(&mut self) -> io::Result<Vec<u8>> {
        self.skip_spaces();
        let (&quote, rest) = self.rest.split_first().ok_or_else(damaged)?;
        if quote != b'\'' && quote != b'"' {
            return Err(damaged());
        }
        let length = rest.iter().position(|&c| c == quote).ok_or_else(damaged)?;
        self.rest = &rest[length + 1..];
        Ok(rest[..length].to_vec())
    }

    fn skip_spaces(&mut self) {
        self.rest = self.rest.trim_ascii_start();
    }

    /// Takes `character` if it comes next.
    fn next_is(&mut self, character: u8) -> bool {
        self.skip_spaces();
        let found = self.rest.first() == Some(&character);
        if found {
            self.rest = &self.rest[1..];
        }
        found
    }

    fn expect(&mut self, character: u8) -> io::Result<()> {
        if self.next_is(character) { Ok(()) } else { Err(damaged()) }
    }
}

fn damaged() -> io::Error {
    invalid("its header is damaged")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn parse(dictionary: &str) -> Result<Header, String> {
        let length = u16::try_from(dictionary.len()).unwrap().to_le_bytes();
        let bytes = [&MAGIC[..], &[1, 0], &length, dictionary.as_bytes()].concat();
        Header::read(&mut &bytes[..]).map_err(|error| error.to_string())
    }

    #[test]
    fn a_header_is_what_numpy_writes() {
        let header = Header { dtype: Dtype::F8, shape: vec![2, 3] };
        let bytes = header.to_bytes();
        assert_eq!(bytes.len(), 128);
        assert_eq!(bytes[..10], *b"\x93NUMPY\x01\x00\x76\x00");
        let text = std::str::from_utf8(&bytes[10..]).unwrap();
        assert_eq!(text.trim_end(), "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }");
        assert!(text.ends_with(" \n"));
    }

    #[test]
    fn one_axis_has_a_comma_and_none_has_not() {
        for (shape, text) in [(vec![], "()"), (vec![5], "(5,)"), (vec![1, 0, 3], "(1, 0, 3)")] {
            let header = Header { dtype: Dtype::U1, shape };
            let bytes = header.to_bytes();
            assert!(String::from_utf8_lossy(&bytes).contains(&format!("'shape': {text}, }}")));
            assert_eq!(Header::read(&mut &bytes[..]).unwrap(), header);
        }
    }

    #[test]
    fn other_spellings_are_read_and_other_arrays_refused() {
        let ok = Header { dtype: Dtype::U4, shape: vec![4, 3] };
        assert_eq!(parse("{\"shape\":(4,3,),\"descr\":\"<u4\",'fortran_order':False}\n"), Ok(ok));
        let refused = [
            ("{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3), }", "Fortran"),
            ("{'descr': '>f8', 'fortran_order': False, 'shape': (2, 3), }", ">f8"),
            ("{'descr': '<i8', 'fortran_order': False, 'shape': (2, 3), }", "<i8"),
            ("{'descr': '|u1', 'fortran_order': False, 'shape': (-1, 3), }", "damaged"),
            ("{'descr': '|u1', 'fortran_order': False, 'shape': (1 3), }", "damaged"),
            ("{'descr': '|u1', 'fortran_order': False, }", "damaged"),
            ("{'descr': '|u1', 'descr': '|u1', 'shape': ()}", "damaged"),
            ("{'descr': '|u1', 'fortran_order': False, 'shape': ()} x", "damaged"),
            ("{'descr': '|u1', 'fortran_order': False, 'shape': (1073741825,)}", "more than"),
            ("{'descr': '|u1', 'fortran_order': False, 'shape': (65536, 65536)}", "more than"),
            ("{'descr': '|u1', 'fortran_order': False, 'shape': (1,1,1,1,1,1,1,1,1)}", "axes"),
            (
                "{'descr': '|u1', 'fortran_order': False, 'shape': (99999999999999999999,)}",
                "damaged",
            ),
            ("", "damaged"),
            ("{", "damaged"),
            ("{'descr", "damaged"),
        ];
        for (text, reason) in refused {
            let error = parse(text).unwrap_err();
            assert!(error.contains(reason), "{text}: {error}");
        }
        let lying = b"\x93NUMPY\x02\x00\xff\xff\xff\xff{'descr'";
        assert!(Header::read(&mut &lying[..]).unwrap_err().to_string().contains("claims"));
    }

    proptest! {
        #[test]
        fn headers_survive(dtype in 0..3usize, shape in prop::collection::vec(0..70usize, 0..5)) {
            let header = Header { dtype: [Dtype::U1, Dtype::U4, Dtype::F8][dtype], shape };
            let bytes = header.to_bytes();
            prop_assert_eq!(bytes.len() % 64, 0);
            prop_assert_eq!(Header::read(&mut &bytes[..]).unwrap(), header);
        }

        #[test]
        fn damage_never_panics(place in 0..128usize, byte: u8, length in 0..129usize) {
            let mut bytes = Header { dtype: Dtype::F8, shape: vec![4, 3] }.to_bytes();
            bytes[place] = byte;
            let _ = Header::read(&mut &bytes[..length.min(bytes.len())]);
        }
    }
}
