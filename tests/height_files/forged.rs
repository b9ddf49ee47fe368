//! Files with wild contents in a sound shell: checksums, lengths and directories are as they should
//! be, so that what they guard is reached.

use std::io::{Cursor, Write as _};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use flate2::Compression;
use flate2::write::ZlibEncoder;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::fuzz::{cases, try_all};
use super::tiff_file::{DOUBLE, Form, Kind, LONG, LONG8, Layout, SHORT, TiffFile};

pub fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).expect("memory");
    encoder.finish().expect("memory")
}

fn crc(bytes: &[u8]) -> u32 {
    let mut crc = flate2::Crc::new();
    crc.update(bytes);
    crc.sum()
}

/// A PNG of chunks with the right lengths and checksums.
pub fn png(chunks: &[(&[u8; 4], Vec<u8>)]) -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    for (name, data) in chunks {
        let guarded = [&name[..], data].concat();
        bytes.extend((data.len() as u32).to_be_bytes());
        bytes.extend(&guarded);
        bytes.extend(crc(&guarded).to_be_bytes());
    }
    bytes
}

/// Numbers at an end of some range, and others.
fn wild() -> BoxedStrategy<u64> {
    let edges = vec![
        0,
        1,
        2,
        3,
        4,
        7,
        8,
        16,
        17,
        31,
        255,
        256,
        1024,
        2048,
        3072,
        4326,
        9001,
        9102,
        16384,
        16385,
        32767,
        32768,
        65535,
        65536,
        0x7fff_ffff,
        0x8000_0000,
        0xffff_ffff,
        1 << 32,
        1 << 62,
        1 << 63,
        u64::MAX,
    ];
    prop_oneof![6 => select(edges), 3 => 0..300_u64, 1 => any::<u64>()].boxed()
}

/// Doubles as their bits.
fn wild_double() -> BoxedStrategy<u64> {
    let edges = vec![
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.001,
        -0.001,
        90.0,
        180.0,
        360.0,
        1e-9,
        1e9,
        -1e9,
        1e300,
        -1e300,
        5e-324,
        f64::MAX,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ];
    prop_oneof![2 => select(edges), 1 => -400.0..400.0_f64, 1 => any::<f64>()]
        .prop_map(f64::to_bits)
        .boxed()
}

/// A sample or a cell of a text grid.
fn wild_word() -> BoxedStrategy<String> {
    let edges =
        ["-9999", "nan", "inf", "1e39", "-1e308", "1e999", "1,5", "0x10", "+3", "-", "1e-320"];
    prop_oneof![
        8 => (-500..3000_i32).prop_map(|height| height.to_string()),
        1 => (-1e4..1e4_f64).prop_map(|height| format!("{height:?}")),
        1 => select(edges.to_vec()).prop_map(str::to_owned),
        1 => any::<f64>().prop_map(|height| format!("{height:e}")),
    ]
    .boxed()
}

/// Cases of a test, and how many of them were read as a map.
struct Seen(AtomicUsize, AtomicUsize);

impl Seen {
    const fn nothing() -> Self {
        Self(AtomicUsize::new(0), AtomicUsize::new(0))
    }

    /// Reads a file. Of the first 200, `least` must have been sound, or little is reached.
    fn read(&self, bytes: &[u8], name: &str, least: usize) {
        let sound = self.1.fetch_add(usize::from(try_all(bytes, name)), Relaxed);
        if self.0.fetch_add(1, Relaxed) == 200 {
            println!("{name}: {sound} of 200 are maps");
            assert!(sound >= least, "{sound} of 200 are maps");
        }
    }
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn pngs(
        columns in prop_oneof![9 => 1..20_u32, 1 => any::<u32>()],
        rows in prop_oneof![9 => 1..20_u32, 1 => any::<u32>()],
        depth in select(vec![1_u8, 2, 4, 8, 8, 8, 16, 16]),
        color in select(vec![0_u8, 0, 2, 2, 3, 4, 6, 6]),
        interlaced in 0..2_u8,
        filters in vec(prop_oneof![99 => 0..5_u8, 1 => Just(5)], 20),
        noise in vec(any::<u8>(), 1..400),
        lengthen in prop_oneof![3 => Just(0_isize), 1 => -20..20_isize],
        parts in 1..4_usize,
        palette in prop::option::weighted(0.25, vec(any::<u8>(), 0..30)),
        transparent in prop::option::weighted(0.25, vec(any::<u8>(), 0..8)),
        extra in prop::option::weighted(0.25, (select(vec![b"gAMA", b"iCCP", b"tEXt", b"acTL", b"fcTL", b"eXIf", b"zzzZ", b"IHDR"]), vec(any::<u8>(), 0..40))),
    ) {
        let channels = [1, 0, 3, 1, 2, 0, 4][color as usize];
        let row = (columns.min(64) as usize * channels * depth as usize).div_ceil(8);
        let length = ((row + 1) * rows.min(64) as usize).saturating_add_signed(lengthen);
        let raw: Vec<u8> = (0..length)
            .map(|at| if at % (row + 1) == 0 { filters[at / (row + 1) % 20] } else { noise[at % noise.len()] })
            .collect();
        let packed = deflated(&raw);
        let header = [&columns.to_be_bytes()[..], &rows.to_be_bytes(), &[depth, color, 0, 0, interlaced]];
        let mut chunks = vec![(b"IHDR", header.concat())];
        chunks.extend(extra);
        chunks.extend(palette.map(|palette| (b"PLTE", palette)));
        chunks.extend(transparent.map(|transparent| (b"tRNS", transparent)));
        chunks.extend(packed.chunks(packed.len().div_ceil(parts)).map(|part| (b"IDAT", part.to_vec())));
        chunks.push((b"IEND", Vec::new()));
        static SEEN: Seen = Seen::nothing();
        SEEN.read(&png(&chunks), "a.png", 5);
    }

    #[test]
    fn tiffs(
        kind in select(Kind::ALL.to_vec()),
        compression in select(vec![1_u64, 5, 8, 32946, 32773]),
        predictor in 1..4_u64,
        layout in select(vec![Layout::Strips(7), Layout::Strips(100), Layout::Tiles(16, 16), Layout::Tiles(32, 16)]),
        big_endian: bool,
        big: bool,
        size in (1..40_usize, 1..40_usize),
        entries in vec(
            (
                select(vec![254_u16, 256, 257, 258, 259, 262, 266, 273, 274, 277, 278, 279, 284, 317, 322, 323, 324, 325, 338, 339]),
                select(vec![SHORT, LONG, LONG8, 1, 2, 5, 9, 11, 13, 99]),
                vec(wild(), 0..5),
            ),
            0..3,
        ),
        places in vec(
            (select(vec![33550_u16, 33922, 34264, 34736, 42113]), select(vec![DOUBLE, DOUBLE, DOUBLE, 11, SHORT]), vec(wild_double(), 0..17)),
            0..3,
        ),
        keys in prop::option::of(vec((select(vec![1024_u64, 1025, 2048, 2052, 2054, 2055, 3072, 3076, 3077, 4096, 4099, 9]), select(vec![0_u64, 0, 0, 34736, 34737]), 0..3_u64, wild()), 0..6)),
        texts in vec((select(vec![42113_u16, 42112, 34737]), "\\PC{0,20}|-9999|nan|1e400|<GDALMetadata>\\PC*"), 0..2),
        damage in vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), any::<u8>()), 0..4),
        next in prop_oneof![9 => Just(0), 1 => wild()],
    ) {
        let predictor = if predictor == 3 && kind.format != 3 { 2 } else { predictor };
        let form = Form { kind, compression, predictor, layout, big_endian, big };
        let mut file = TiffFile::new(size.0, size.1, &form, |i, j| (i * 3 + j) as f64);
        for (tag, kind, values) in entries.into_iter().chain(places) {
            file = file.with(tag, kind, &values);
        }
        if let Some(keys) = keys {
            let mut values = vec![1, 1, 0, keys.len() as u64];
            keys.iter().for_each(|(key, place, count, value)| values.extend([*key, *place, *count, *value]));
            file = file.with(34735, SHORT, &values);
        }
        for (tag, text) in texts {
            file.entries.retain(|(other, ..)| *other != tag);
            file.texts.retain(|(other, _)| *other != tag);
            file = file.with_text(tag, &text);
        }
        for (block, at, byte) in damage {
            let block = block.index(file.blocks.len());
            if !file.blocks[block].is_empty() {
                let at = at.index(file.blocks[block].len());
                file.blocks[block][at] = byte;
            }
        }
        file.next = next;
        static SEEN: Seen = Seen::nothing();
        SEEN.read(&file.bytes(), "a.tif", 5);
    }

    #[test]
    fn tiles(
        name in "[NSns]?[0-9]{1,3}[EWew]?[0-9]{1,4}(\\.hgt|\\.HGT|\\.bil|)|\\PC{0,12}\\.hgt",
        side in 0..40_usize,
        lengthen in prop_oneof![8 => Just(0_isize), 1 => -3..4_isize],
        heights in vec(prop_oneof![4 => any::<i16>(), 1 => Just(i16::MIN)], 1..50),
        others in 0..3_usize,
        stored: bool,
        packed: bool,
    ) {
        let length = (2 * side * side).saturating_add_signed(lengthen);
        let bytes: Vec<u8> =
            heights.iter().flat_map(|height| height.to_be_bytes()).cycle().take(length).collect();
        static SEEN: Seen = Seen::nothing();
        if !packed {
            SEEN.read(&bytes, &name, 5);
            return Ok(());
        }
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        let method = if stored { zip::CompressionMethod::Stored } else { zip::CompressionMethod::Deflated };
        let options = SimpleFileOptions::default().compression_method(method);
        for (entry, content) in (0..others).map(|at| (format!("{at}.txt"), name.as_bytes())).chain([(name.clone(), &bytes[..])]) {
            zip.start_file(entry, options).expect("memory");
            zip.write_all(content).expect("memory");
        }
        SEEN.read(&zip.finish().expect("memory").into_inner(), "a.zip", 5);
    }

    #[test]
    fn grids(
        size in (1..9_usize, 1..9_usize),
        claimed in prop::option::weighted(0.1, wild_word()),
        keys in (wild_word(), wild_word(), prop_oneof![3 => Just("10".to_owned()), 1 => Just("0.001".to_owned()), 1 => wild_word()]),
        names in (select(vec!["xllcorner", "XLLCENTER", "xllcentre"]), select(vec!["yllcorner", "yllcenter"]), select(vec!["cellsize", "dx", "DY"])),
        nodata in prop::option::of(wild_word()),
        heights in vec(prop_oneof![9 => (-500..3000_i32).prop_map(|height| height.to_string()), 1 => wild_word()], 81),
        end in select(vec!["\n", "\r\n", "", " \u{0}", "\n7"]),
    ) {
        let (columns, rows) = size;
        let claim = claimed.unwrap_or_else(|| columns.to_string());
        let mut text = format!("ncols {claim}\nnrows {rows}\n{} {}\n{} {}\n{} {}\n", names.0, keys.0, names.1, keys.1, names.2, keys.2);
        if let Some(nodata) = nodata {
            text += &format!("NODATA_value {nodata}\n");
        }
        for row in heights.chunks(9).take(rows) {
            text += &row[..columns].join(" ");
            text += "\n";
        }
        static SEEN: Seen = Seen::nothing();
        SEEN.read(format!("{}{end}", text.trim_end()).as_bytes(), "a.asc", 5);
    }
}
