//! TIFF files made by hand, as awkward as wanted.

use std::io::Write as _;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use ruzstd::encoding::CompressionLevel;

pub const SHORT: u16 = 3;
pub const LONG: u16 = 4;
pub const FLOAT: u16 = 11;
pub const DOUBLE: u16 = 12;
pub const LONG8: u16 = 16;

/// How samples are laid out in blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Layout {
    Strips(usize),
    Tiles(usize, usize),
}

/// A TIFF file to be. Entries may be changed before it is written.
#[derive(Clone, Debug)]
pub struct TiffFile {
    pub big_endian: bool,
    pub big: bool,
    /// Tag, type, and values: numbers as they are, doubles as their bits.
    pub entries: Vec<(u16, u16, Vec<u64>)>,
    pub texts: Vec<(u16, Vec<u8>)>,
    /// Packed strips or tiles.
    pub blocks: Vec<Vec<u8>>,
    pub tiled: bool,
    /// Offset of the next directory; the file's own begins after the blocks.
    pub next: u64,
}

/// What the samples of a file are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kind {
    /// 1 unsigned, 2 signed, 3 float.
    pub format: u64,
    pub bits: u64,
}

impl Kind {
    pub const ALL: [Self; 11] = [
        Self { format: 1, bits: 8 },
        Self { format: 2, bits: 8 },
        Self { format: 1, bits: 16 },
        Self { format: 2, bits: 16 },
        Self { format: 1, bits: 32 },
        Self { format: 2, bits: 32 },
        Self { format: 3, bits: 32 },
        Self { format: 3, bits: 64 },
        Self { format: 1, bits: 64 },
        Self { format: 2, bits: 64 },
        Self { format: 3, bits: 16 },
    ];

    /// A sample, highest byte first.
    fn bytes(self, value: f64) -> Vec<u8> {
        let all = match (self.format, self.bits) {
            (3, 16) => return half(value).to_be_bytes().to_vec(),
            (3, 32) => return (value as f32).to_be_bytes().to_vec(),
            (3, _) => return value.to_be_bytes().to_vec(),
            _ => (value as i64).to_be_bytes(),
        };
        all[8 - self.bits as usize / 8..].to_vec()
    }
}

/// The bits of a value that is a normal binary16 number or 0.
fn half(value: f64) -> u16 {
    let bits = (value as f32).to_bits();
    if value == 0.0 {
        return (bits >> 16) as u16;
    }
    // From 8 bits of exponent to 5, from 23 of fraction to 10.
    let exponent = ((bits >> 23) & 0xFF) + 15 - 127;
    assert!((1..31).contains(&exponent) && bits & 0x1FFF == 0, "{value}");
    ((bits >> 16) & 0x8000 | (exponent << 10) | (bits >> 13) & 0x3FF) as u16
}

/// How a file is written.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    pub kind: Kind,
    pub compression: u64,
    pub predictor: u64,
    pub layout: Layout,
    pub big_endian: bool,
    pub big: bool,
}

impl Form {
    /// Little-endian float32 in one strip, as plain as can be.
    pub fn plain() -> Self {
        Self {
            kind: Kind { format: 3, bits: 32 },
            compression: 1,
            predictor: 1,
            layout: Layout::Strips(usize::MAX),
            big_endian: false,
            big: false,
        }
    }
}

/// A row of samples through the predictor, in the file's byte order.
fn predict(row: &[f64], form: &Form) -> Vec<u8> {
    let samples: Vec<Vec<u8>> = row.iter().map(|&value| form.kind.bytes(value)).collect();
    match form.predictor {
        3 => {
            // All highest bytes, then all second ones, …; then differences from byte to byte.
            let width = samples[0].len();
            let shuffled: Vec<u8> =
                (0..width).flat_map(|place| samples.iter().map(move |s| s[place])).collect();
            (0..shuffled.len())
                .map(|k| shuffled[k].wrapping_sub(if k == 0 { 0 } else { shuffled[k - 1] }))
                .collect()
        }
        predictor => {
            let number = |bytes: &[u8]| bytes.iter().fold(0_u64, |n, &b| (n << 8) | u64::from(b));
            let mut out = Vec::new();
            let mut before = 0_u64;
            for sample in &samples {
                let value = number(sample);
                let stored = if predictor == 2 { value.wrapping_sub(before) } else { value };
                before = value;
                let mut bytes = stored.to_be_bytes()[8 - sample.len()..].to_vec();
                if !form.big_endian {
                    bytes.reverse();
                }
                out.extend(bytes);
            }
            out
        }
    }
}

/// Runs of at least three as repeats, the rest as it is.
fn packbits(bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let run = bytes[at..].iter().take(128).take_while(|&&byte| byte == bytes[at]).count();
        if run > 2 {
            out.extend([(257 - run) as u8, bytes[at]]);
            at += run;
        } else {
            let length = (bytes.len() - at).min(1 + at % 100);
            out.push(length as u8 - 1);
            out.extend(&bytes[at..at + length]);
            at += length;
        }
        if at % 5 == 0 {
            out.push(128);
        }
    }
    out
}

pub fn pack(bytes: &[u8], compression: u64) -> Vec<u8> {
    match compression {
        5 => weezl::encode::Encoder::with_tiff_size_switch(weezl::BitOrder::Msb, 8)
            .encode(bytes)
            .expect("bytes"),
        8 | 32946 => {
            let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
            encoder.write_all(bytes).expect("memory");
            encoder.finish().expect("memory")
        }
        32773 => packbits(bytes),
        50000 => ruzstd::encoding::compress_to_vec(bytes, CompressionLevel::Fastest),
        _ => bytes.to_vec(),
    }
}

impl TiffFile {
    /// A file of `columns` x `rows` samples.
    pub fn new(
        columns: usize,
        rows: usize,
        form: &Form,
        sample: impl Fn(usize, usize) -> f64,
    ) -> Self {
        let (width, height) = match form.layout {
            Layout::Strips(height) => (columns, height.min(rows)),
            Layout::Tiles(width, height) => (width, height),
        };
        let tiled = matches!(form.layout, Layout::Tiles(..));
        let mut blocks = Vec::new();
        for top in (0..rows).step_by(height) {
            for left in (0..columns).step_by(width) {
                let last = if tiled { top + height } else { rows.min(top + height) };
                let mut plain = Vec::new();
                for row in top..last {
                    // Padding repeats the edge.
                    let row: Vec<f64> = (left..left + width)
                        .map(|column| sample(column.min(columns - 1), row.min(rows - 1)))
                        .collect();
                    plain.extend(predict(&row, form));
                }
                blocks.push(pack(&plain, form.compression));
            }
        }
        let mut entries = vec![
            (256, LONG, vec![columns as u64]),
            (257, LONG, vec![rows as u64]),
            (258, SHORT, vec![form.kind.bits]),
            (259, SHORT, vec![form.compression]),
            (262, SHORT, vec![1]),
            (277, SHORT, vec![1]),
            (339, SHORT, vec![form.kind.format]),
        ];
        if form.predictor != 1 {
            entries.push((317, SHORT, vec![form.predictor]));
        }
        if tiled {
            entries.push((322, SHORT, vec![width as u64]));
            entries.push((323, SHORT, vec![height as u64]));
        } else {
            entries.push((278, LONG, vec![height as u64]));
        }
        Self {
            big_endian: form.big_endian,
            big: form.big,
            entries,
            texts: Vec::new(),
            blocks,
            tiled,
            next: 0,
        }
    }

    /// A plain file of 4 x 3 nodes, 0 to 11.
    pub fn small() -> Self {
        Self::new(4, 3, &Form::plain(), |i, j| (4 * j + i) as f64)
    }

    #[must_use]
    pub fn with(mut self, tag: u16, kind: u16, values: &[u64]) -> Self {
        self.entries.retain(|(other, ..)| *other != tag);
        self.entries.push((tag, kind, values.to_vec()));
        self
    }

    #[must_use]
    pub fn with_doubles(self, tag: u16, values: &[f64]) -> Self {
        let bits: Vec<u64> = values.iter().map(|value| value.to_bits()).collect();
        self.with(tag, DOUBLE, &bits)
    }

    #[must_use]
    pub fn with_text(mut self, tag: u16, text: &str) -> Self {
        self.texts.push((tag, [text.as_bytes(), b"\0"].concat()));
        self
    }

    #[must_use]
    pub fn without(mut self, tag: u16) -> Self {
        self.entries.retain(|(other, ..)| *other != tag);
        self
    }

    fn number(&self, value: u64, width: usize) -> Vec<u8> {
        let mut bytes = value.to_be_bytes()[8 - width..].to_vec();
        if !self.big_endian {
            bytes.reverse();
        }
        bytes
    }

    /// The bytes of the file: header, blocks, values, directory.
    pub fn bytes(&self) -> Vec<u8> {
        let offset_width = if self.big { 8 } else { 4 };
        let mut out = if self.big_endian { b"MM".to_vec() } else { b"II".to_vec() };
        out.extend(self.number(if self.big { 43 } else { 42 }, 2));
        if self.big {
            out.extend(self.number(8, 2));
            out.extend(self.number(0, 2));
        }
        let first_at = out.len();
        out.extend(vec![0; offset_width]);
        let mut entries = self.entries.clone();
        let mut offsets = Vec::new();
        for block in &self.blocks {
            offsets.push(if block.is_empty() { 0 } else { out.len() as u64 });
            out.extend(block);
        }
        let counts: Vec<u64> = self.blocks.iter().map(|block| block.len() as u64).collect();
        let (offsets_tag, counts_tag) = if self.tiled { (324, 325) } else { (273, 279) };
        let kind = if self.big { LONG8 } else { LONG };
        for (tag, values) in [(offsets_tag, offsets), (counts_tag, counts)] {
            if !entries.iter().any(|(other, ..)| *other == tag) {
                entries.push((tag, kind, values));
            }
        }
        let mut all: Vec<(u16, u16, usize, Vec<u8>)> = entries
            .iter()
            .map(|(tag, kind, values)| {
                let width = match *kind {
                    SHORT => 2,
                    LONG | FLOAT => 4,
                    _ => 8,
                };
                let bytes = values.iter().flat_map(|&value| self.number(value, width)).collect();
                (*tag, *kind, values.len(), bytes)
            })
            .collect();
        all.extend(self.texts.iter().map(|(tag, text)| (*tag, 2, text.len(), text.clone())));
        all.sort_by_key(|(tag, ..)| *tag);
        let mut fields = Vec::new();
        for (_, _, _, bytes) in &all {
            if bytes.len() <= offset_width {
                let mut field = bytes.clone();
                field.resize(offset_width, 0);
                fields.push(field);
            } else {
                fields.push(self.number(out.len() as u64, offset_width));
                out.extend(bytes);
                out.resize(out.len().next_multiple_of(2), 0);
            }
        }
        let directory = out.len() as u64;
        let offset = self.number(directory, offset_width);
        out[first_at..first_at + offset_width].copy_from_slice(&offset);
        out.extend(self.number(all.len() as u64, if self.big { 8 } else { 2 }));
        for ((tag, kind, count, _), field) in all.iter().zip(&fields) {
            out.extend(self.number(u64::from(*tag), 2));
            out.extend(self.number(u64::from(*kind), 2));
            out.extend(self.number(*count as u64, offset_width));
            out.extend(field);
        }
        out.extend(self.number(self.next, offset_width));
        out
    }
}
