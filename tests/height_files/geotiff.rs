//! GeoTIFF: every sample type, compression, predictor, layout, byte order and header.

use std::io::Cursor;

use terraline::scene::HeightFile;
use tiff::decoder::{Decoder, DecodingResult};

use super::tiff_file::{Form, Kind, LONG, Layout, SHORT, TiffFile};
use super::{read, refused};

const COLUMNS: usize = 37;
const ROWS: usize = 21;

/// A value that a sample of the kind can have: large and small ones, and both signs.
fn value(kind: Kind, i: usize, j: usize) -> f64 {
    let k = (j * COLUMNS + i) as f64;
    let rough = ((i * 7919 + j * 104_729) % 65_536) as f64;
    match (kind.format, kind.bits) {
        (1, 8) => (i * 3 + j) as f64,
        (2, 8) => k % 256.0 - 128.0,
        (1, 16) => rough,
        (2, 16) => rough - 32_768.0,
        // What 32-bit floats hold exactly.
        (1, 32) => rough * 65_536.0,
        (2, 32) => (rough - 32_768.0) * 65_536.0,
        (1, 64) => rough * f64::from(1 << 20) * f64::from(1 << 20),
        (2, 64) => (rough - 32_768.0) * f64::from(1 << 20) * f64::from(1 << 20),
        // What 16-bit floats hold exactly.
        (3, 16) => (k % 1024.0 - 500.0) / 8.0,
        (3, 32) => (rough - 30_000.0) / 128.0,
        _ => (rough - 30_000.0) / 1024.0,
    }
}

fn forms() -> Vec<Form> {
    let mut forms = Vec::new();
    for kind in Kind::ALL {
        for compression in [1, 5, 8, 32946, 32773, 50000] {
            for predictor in [1, 2, 3] {
                // Elsewhere the tag means nothing.
                let packed = !matches!(compression, 1 | 32773);
                if predictor != 1 && !packed || predictor == 3 && kind.format != 3 {
                    continue;
                }
                for layout in [Layout::Strips(usize::MAX), Layout::Strips(4), Layout::Tiles(16, 16)]
                {
                    for order in 0..4 {
                        let (big_endian, big) = (order & 1 > 0, order & 2 > 0);
                        forms.push(Form { kind, compression, predictor, layout, big_endian, big });
                    }
                }
            }
        }
    }
    forms
}

/// What the `tiff` crate makes of a file: another reader, where it can read it.
fn other_reader(bytes: &[u8]) -> Option<Vec<f64>> {
    let mut decoder = Decoder::new(Cursor::new(bytes)).ok()?;
    Some(match decoder.read_image().ok()? {
        DecodingResult::U8(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::I8(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::U16(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::I16(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::U32(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::I32(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::F32(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::F64(values) => values,
        _ => return None,
    })
}

#[test]
fn every_form_reads_as_it_was_written() {
    let mut confirmed = 0;
    let forms = forms();
    assert_eq!(forms.len(), 1464);
    for form in &forms {
        let bytes = TiffFile::new(COLUMNS, ROWS, form, |i, j| value(form.kind, i, j)).bytes();
        let file = read(&bytes, "all.tif");
        assert_eq!((file.map.columns(), file.map.rows()), (COLUMNS, ROWS));
        for j in 0..ROWS {
            for i in 0..COLUMNS {
                let expected = value(form.kind, i, j) as f32;
                assert_eq!(file.map.sample(i, j), expected, "{form:?} at {i}, {j}");
            }
        }
        assert_eq!(file.map.voids(), 0);
        if let Some(values) = other_reader(&bytes) {
            let ours: Vec<f64> = file.map.samples().iter().map(|&s| f64::from(s)).collect();
            assert_eq!(ours, values, "{form:?}");
            confirmed += 1;
        }
    }
    // It has neither Zstandard nor 16-bit floats, and gives up on some LZW tiles.
    assert!(confirmed > 800, "{confirmed}");
}

#[test]
fn storage_is_said() {
    let form = Form {
        kind: Kind { format: 3, bits: 64 },
        compression: 8,
        predictor: 3,
        layout: Layout::Tiles(32, 16),
        big_endian: true,
        big: true,
    };
    let storage = read(&TiffFile::new(40, 20, &form, |i, _| i as f64).bytes(), "a.tif").storage;
    assert_eq!(storage.format, "BigTIFF");
    assert_eq!(storage.sample, "float64");
    assert_eq!(storage.compression.as_deref(), Some("deflate with predictor 3"));
    assert_eq!(storage.layout.as_deref(), Some("tiles of 32 x 16"));
    assert_eq!(storage.byte_order, Some("big-endian"));
}

fn with_nodata(kind: Kind, text: &str, sample: impl Fn(usize, usize) -> f64) -> HeightFile {
    let form = Form { kind, ..Form::plain() };
    read(&TiffFile::new(4, 3, &form, sample).with_text(42113, text).bytes(), "n.tif")
}

#[test]
fn nodata_becomes_nan() {
    let float = Kind { format: 3, bits: 32 };
    let double = Kind { format: 3, bits: 64 };
    let short = Kind { format: 2, bits: 16 };
    let corner = |mark: f64| move |i, j| if (i, j) == (1, 2) { mark } else { 7.5 };
    for (kind, text, mark) in [
        (float, "-9999", -9999.0),
        (float, " -9999 ", -9999.0),
        (float, "-3.4028234663852886e+38", f64::from(f32::MIN)),
        (float, "-3.40282e+38", f64::from(-3.40282e38_f32)),
        (float, "0.1", f64::from(0.1_f32)),
        (float, "nan", f64::NAN),
        (double, "-1.7976931348623157e+308", f64::MIN),
        (double, "NaN", f64::NAN),
        (short, "-32768", -32768.0),
    ] {
        let file = with_nodata(kind, text, corner(mark));
        assert!(file.map.sample(1, 2).is_nan(), "{text}");
        assert_eq!(file.map.voids(), 1, "{text}");
        let declared = file.nodata.expect("a declared value");
        assert!(declared.is_nan() || declared == text.trim().parse::<f64>().unwrap());
    }
    // NaN and the infinite are no data whatever is declared.
    let file = with_nodata(float, "-9999", |i, _| [f64::NAN, f64::INFINITY, 5.0, -9999.0][i]);
    assert_eq!((file.map.voids(), file.map.range()), (9, (5.0, 5.0)));
    assert!(file.notes.iter().any(|note| note.contains("3 infinite")), "{:?}", file.notes);
    // A mark that cannot occur, and one that is no number, are said.
    let file = with_nodata(Kind { format: 1, bits: 16 }, "-9999", |i, _| i as f64);
    assert!(file.notes.iter().any(|note| note.contains("cannot occur")), "{:?}", file.notes);
    let file = with_nodata(float, "none", |i, _| i as f64);
    assert!(file.notes.iter().any(|note| note.contains("`none`")), "{:?}", file.notes);
    // Lowest samples that look like a mark are said as well.
    let file = read(&TiffFile::new(4, 3, &Form::plain(), corner(-9999.0)).bytes(), "m.tif");
    assert!(file.notes.iter().any(|note| note.contains("-9999")), "{:?}", file.notes);
}

#[test]
fn blocks_that_are_not_stored_hold_no_data() {
    let form = Form { layout: Layout::Tiles(16, 16), ..Form::plain() };
    let mut file = TiffFile::new(32, 16, &form, |i, _| i as f64);
    file.blocks[1].clear();
    let zero = read(&file.bytes(), "sparse.tif");
    assert_eq!((zero.map.sample(31, 3), zero.map.sample(15, 3)), (0.0, 15.0));
    assert!(zero.notes.iter().any(|note| note.contains("height 0")), "{:?}", zero.notes);
    let marked = read(&file.clone().with_text(42113, "-1").bytes(), "sparse.tif");
    assert_eq!(marked.map.voids(), 256);
    file.blocks[0].clear();
    refused(&file.bytes(), "sparse.tif", &["none of its strips or tiles is stored"]);
}

#[test]
fn the_first_image_of_full_resolution_is_read() {
    // A thumbnail first, then the map, then another page.
    let page = |first: f64, kind: u64| {
        TiffFile::new(4, 3, &Form::plain(), move |i, _| first + i as f64).with(254, LONG, &[kind])
    };
    let chain = |pages: &[TiffFile]| {
        // Later pages first in the file, each with the offset of the next.
        let mut bytes: Vec<u8> = vec![0; 8];
        let mut next = 0_u64;
        for page in pages.iter().rev() {
            let mut page = page.clone();
            page.next = next;
            // Its own offsets begin where it stands.
            let at = bytes.len() as u64;
            let block = page.blocks[0].clone();
            page = page.with(273, LONG, &[at]).with(279, LONG, &[block.len() as u64]);
            bytes.extend(&block);
            let alone = page.bytes();
            let directory = u32::from_le_bytes(alone[4..8].try_into().unwrap()) as usize;
            next = bytes.len() as u64;
            bytes.extend(&alone[directory..]);
        }
        bytes[..4].copy_from_slice(b"II\x2A\0");
        bytes[4..8].copy_from_slice(&(next as u32).to_le_bytes());
        bytes
    };
    let file = read(&chain(&[page(100.0, 1), page(200.0, 0), page(300.0, 0)]), "pages.tif");
    assert_eq!(file.map.range(), (200.0, 203.0));
    let notes = file.notes.join("\n");
    assert!(notes.contains("1 x image of lower") && notes.contains("1 x further image"), "{notes}");
    // A mask is 0 where there are no data; one of another size is left out.
    let masked = page(0.0, 4);
    let file = read(&chain(&[page(100.0, 0), page(200.0, 1), masked.clone()]), "pages.tif");
    assert_eq!((file.map.range(), file.map.voids()), ((101.0, 103.0), 3));
    let bits = Form { kind: Kind { format: 1, bits: 1 }, ..Form::plain() };
    let mut mask = TiffFile::new(4, 3, &bits, |_, _| 0.0).with(254, LONG, &[4]);
    // A byte a row, its highest bits first.
    mask.blocks[0] = vec![0b1010_0000, 0b1111_1111, 0b0111_0000];
    let file = read(&chain(&[page(100.0, 0), mask]), "pages.tif");
    let voids: Vec<usize> = (0..12).filter(|&at| file.map.samples()[at].is_nan()).collect();
    assert_eq!(voids, [1, 3, 8]);
    let small = TiffFile::new(2, 1, &Form::plain(), |_, _| 0.0).with(254, LONG, &[4]);
    let file = read(&chain(&[page(100.0, 0), small]), "pages.tif");
    assert_eq!(file.map.voids(), 0);
    assert!(file.notes.join("\n").contains("left out: a mask of 2 x 1"), "{:?}", file.notes);
}

#[test]
fn what_is_no_height_map_is_refused_by_name() {
    let small = TiffFile::small;
    for (file, words) in [
        (small().with(277, SHORT, &[3]), &["3 bands", "gdal_translate -b 1"][..]),
        (small().with(262, SHORT, &[3]), &["palette"]),
        (small().with(262, SHORT, &[2]), &["colour"]),
        (
            small().with(258, SHORT, &[24]),
            &["floats of 24 bits", "gdal_translate -ot Float32 no.tif"],
        ),
        (small().with(339, SHORT, &[5]), &["complex"]),
        (small().with(259, SHORT, &[50001]), &["WebP", "COMPRESS=DEFLATE no.tif no-new.tif"]),
        (small().with(259, SHORT, &[34887]), &["cannot be unpacked"]),
        (small().with(259, SHORT, &[50000]), &["cannot be unpacked"]),
        (small().with(259, SHORT, &[7]), &["JPEG"]),
        (small().with(259, SHORT, &[999]), &["999"]),
        (small().with(259, SHORT, &[8]).with(317, SHORT, &[9]), &["predictor 9"]),
        (small().with(266, SHORT, &[2]), &["fill order 2", "gdal_translate no.tif"]),
        (small().with(284, SHORT, &[7]), &["planes"]),
    ] {
        refused(&file.bytes(), "no.tif", words);
    }
    // One band in planes of its own is one band.
    assert_eq!(read(&small().with(284, SHORT, &[2]).bytes(), "p.tif").map.range(), (0.0, 11.0));
    let ints = Form { kind: Kind { format: 2, bits: 16 }, ..Form::plain() };
    let ints = Form { compression: 8, ..ints };
    let file = TiffFile::new(4, 3, &ints, |i, _| i as f64).with(317, SHORT, &[3]);
    refused(&file.bytes(), "no.tif", &["predictor 3 does not fit int16"]);
}
