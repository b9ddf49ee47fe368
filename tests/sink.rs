//! Files written by the sinks, read back, and damaged.

mod samples;
#[path = "support/skipped.rs"]
mod skipped;

use std::fs;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use samples::{folder, frame, image, write_image};
use skipped::skipped;
use terraline::frame::{Scalars, TABLE};
use terraline::sink::npy::{Dtype, Header};
use terraline::sink::npz::{self, Npz};
use terraline::sink::png;
use terraline::sink::{SinkError, check_writable, write_atomically};
use zip::write::SimpleFileOptions;

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a readable folder");
    entries.map(|entry| entry.expect("an entry").path()).collect()
}

/// A zip archive of files with the given contents.
fn archive(files: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        zip.start_file(*name, SimpleFileOptions::default()).expect("an entry");
        zip.write_all(bytes).expect("its bytes");
    }
    zip.finish().expect("an archive").into_inner()
}

fn array(dtype: Dtype, shape: &[usize], data: &[u8]) -> Vec<u8> {
    [Header { dtype, shape: shape.to_vec() }.to_bytes(), data.to_vec()].concat()
}

/// Reads every array of an archive, to the end or to the first error.
fn read_all(bytes: &[u8]) -> Result<Vec<Vec<f64>>, String> {
    let mut npz = Npz::new(Path::new("x.npz"), Cursor::new(bytes)).map_err(|e| e.to_string())?;
    let names = npz.names().to_vec();
    let read = |name: &String| npz.array(name)?.read_all();
    names.iter().map(read).collect::<Result<_, _>>().map_err(|error| error.to_string())
}

#[test]
fn pictures_survive_a_round_trip() {
    let folder = folder();
    let path = folder.path().join("frame.png");
    for image in [image(1, 1), image(33, 17)] {
        write_image(&path, &image);
        assert_eq!(png::read(&path).unwrap(), image);
        let bytes = fs::read(&path).unwrap();
        write_image(&path, &image);
        assert_eq!(fs::read(&path).unwrap(), bytes);
    }
    assert_eq!(entries(folder.path()), [path]);
}

#[test]
fn a_picture_of_sixteen_bits_is_refused() {
    let folder = folder();
    let path = folder.path().join("map.png");
    image::ImageBuffer::from_fn(4, 3, |x, y| image::Luma([(x * y) as u16])).save(&path).unwrap();
    let refused = png::read(&path).unwrap_err().to_string();
    assert!(refused.contains("8 bits"), "{refused}");
}

#[test]
fn failures_leave_no_file() {
    let folder = folder();
    let path = folder.path().join("frame.png");
    let error = png::write(&path, 3, 2, &[[0; 3]; 5]).unwrap_err();
    assert!(matches!(error, SinkError::Shape { found: 5, .. }), "{error}");
    // No encoder takes a picture without pixels.
    png::write(&path, 0, 0, &[]).unwrap_err();
    let failing = |out: &mut std::io::BufWriter<fs::File>| {
        out.write_all(&[1; 100_000])?;
        Err(std::io::Error::other("interrupted"))
    };
    let error = write_atomically(&path, failing).unwrap_err().to_string();
    assert!(error.contains("frame.png") && error.contains("interrupted"), "{error}");
    assert!(entries(folder.path()).is_empty());

    write_image(&path, &image(2, 2));
    let before = fs::read(&path).unwrap();
    write_atomically(&path, failing).unwrap_err();
    assert_eq!(fs::read(&path).unwrap(), before);
    assert_eq!(entries(folder.path()), [path]);
}

#[test]
fn bad_targets_say_what_to_do() {
    let folder = folder();
    let root = folder.path();
    fs::write(root.join("file"), "text").unwrap();
    let said = |path: &Path| {
        let error = png::write(path, 1, 1, &[[0; 3]]).unwrap_err();
        assert_eq!(check_writable(path).unwrap_err().to_string(), error.to_string());
        error
    };
    let none = said(&root.join("none/frame.png"));
    assert!(matches!(none, SinkError::NoFolder { .. }));
    let text = none.to_string();
    assert!(text.contains("none/frame.png") && text.contains("create it"), "{text}");
    assert!(matches!(said(&root.join("file/frame.png")), SinkError::NotAFolder { .. }));
    assert!(matches!(said(root), SinkError::IsFolder { .. }));
    assert!(matches!(said(&root.join("new/")), SinkError::IsFolder { .. }));
    assert!(matches!(said(Path::new("")), SinkError::IsFolder { .. }));
    assert!(matches!(said(&root.join("..")), SinkError::IsFolder { .. }));
    assert!(matches!(said(&root.join("file/a/b")), SinkError::NotAFolder { .. }));

    let locked = root.join("locked.png");
    fs::write(&locked, "text").unwrap();
    let mut permissions = fs::metadata(&locked).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&locked, permissions).unwrap();
    assert!(matches!(said(&locked), SinkError::ReadOnly { .. }));

    check_writable(&root.join("fine.png")).unwrap();
    assert_eq!(entries(root).len(), 2);
}

#[cfg(unix)]
#[test]
fn a_folder_without_permission_says_so() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let inner = folder.path().join("inner");
    fs::create_dir(&inner).unwrap();
    fs::set_permissions(&inner, fs::Permissions::from_mode(0o555)).unwrap();
    let path = inner.join("frame.png");
    if fs::write(&path, "probe").is_ok() {
        skipped("the superuser may write everywhere");
        return;
    }
    let error = png::write(&path, 1, 1, &[[0; 3]]).unwrap_err().to_string();
    assert!(error.contains("make its folder writable"), "{error}");
    assert!(entries(&inner).is_empty());
    fs::set_permissions(&inner, fs::Permissions::from_mode(0o755)).unwrap();
}

#[cfg(unix)]
#[test]
fn links_are_written_through_and_devices_directly() {
    use std::os::unix::fs::{FileTypeExt, symlink};
    let folder = folder();
    let (file, link) = (folder.path().join("file.png"), folder.path().join("link.png"));
    fs::write(&file, "old").unwrap();
    symlink(&file, &link).unwrap();
    write_image(&link, &image(2, 2));
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(png::read(&file).unwrap(), image(2, 2));

    write_image(Path::new("/dev/null"), &image(2, 2));
    npz::write(Path::new("/dev/null"), &frame(2, 2)).unwrap();
    assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
}

#[test]
fn damaged_pictures_are_refused() {
    let folder = folder();
    let path = folder.path().join("frame.png");
    let said = || {
        let error = png::read(&path).unwrap_err().to_string();
        assert!(error.contains("frame.png"), "{error}");
        error
    };
    assert!(said().contains("check the path"));
    fs::write(&path, "not a picture at all").unwrap();
    assert!(said().contains("no PNG"));
    fs::write(&path, "").unwrap();
    said();
    write_image(&path, &image(64, 64));
    let whole = fs::read(&path).unwrap();
    for length in [8, 20, 33, whole.len() / 2, whole.len() - 20] {
        fs::write(&path, &whole[..length]).unwrap();
        assert!(said().contains("whole PNG"), "{length}");
    }
    let wide = image(16385, 1);
    write_image(&path, &wide);
    assert!(said().contains("16384"));
    let glass = image::RgbaImage::from_pixel(2, 2, image::Rgba([1, 2, 3, 254]));
    glass.save(&path).unwrap();
    assert!(said().contains("transparent"));
    let opaque = image::RgbaImage::from_pixel(2, 2, image::Rgba([1, 2, 3, 255]));
    opaque.save(&path).unwrap();
    assert_eq!(png::read(&path).unwrap().pixels, [[1, 2, 3]; 4]);
}

#[test]
fn buffers_survive_a_round_trip() {
    let folder = folder();
    let path = folder.path().join("buffers.npz");
    // More elements than pass through memory at a time.
    let frame = frame(200, 101);
    npz::write(&path, &frame).unwrap();
    let bytes = fs::read(&path).unwrap();
    npz::write(&path, &frame).unwrap();
    assert_eq!(fs::read(&path).unwrap(), bytes, "the same frame gives the same bytes");

    let mut npz = Npz::open(&path).unwrap();
    assert_eq!(npz.names(), TABLE.each_ref().map(|row| row.name));
    let types = TABLE.each_ref().map(|row| (row.name, row.dtype, row.components));
    assert_eq!(
        types,
        [
            ("hit", Dtype::U1, 1),
            ("lambda", Dtype::F8, 1),
            ("ground_x", Dtype::F8, 1),
            ("ground_z", Dtype::F8, 1),
            ("height", Dtype::F8, 1),
            ("normal", Dtype::F8, 3),
            ("steps", Dtype::U4, 1),
            ("trials", Dtype::U4, 1),
            ("error_px", Dtype::F8, 1),
            ("cycles", Dtype::U4, 1),
            ("color", Dtype::U1, 3),
        ]
    );
    for (row, scalars) in frame.arrays() {
        let array = npz.array(row.name).unwrap();
        let mut shape = vec![101, 200];
        shape.extend((row.components > 1).then_some(row.components));
        assert_eq!(*array.header(), Header { dtype: row.dtype, shape });
        let read = array.read_all().unwrap();
        let given: Vec<f64> = match scalars {
            Scalars::F8(values) => values.to_vec(),
            Scalars::U4(values) => values.iter().map(|&value| value.into()).collect(),
            Scalars::U1(values) => values.iter().map(|&value| value.into()).collect(),
            Scalars::Hit(values) => values.iter().map(|&hit| f64::from(hit as u8)).collect(),
        };
        assert_eq!(read.len(), given.len());
        assert!(read.iter().zip(given).all(|(r, g)| r.to_bits() == g.to_bits()), "{}", row.name);
    }
    assert!(npz.array("depth").is_err());
    assert_eq!(entries(folder.path()), [path]);
}

#[test]
fn buffers_of_a_wrong_size_are_not_written() {
    let folder = folder();
    let path = folder.path().join("buffers.npz");
    let mut short = frame(4, 3);
    short.buffers.as_mut().unwrap().steps.pop();
    let error = npz::write(&path, &short).unwrap_err();
    assert!(matches!(error, SinkError::Shape { array: "steps", found: 11, .. }), "{error}");
    assert!(entries(folder.path()).is_empty());

    let mut bare = frame(4, 3);
    bare.buffers = None;
    npz::write(&path, &bare).unwrap();
    assert_eq!(Npz::open(&path).unwrap().names(), ["hit", "color"]);
}

#[test]
fn lying_archives_are_refused() {
    let good = archive(&[("a.npy", array(Dtype::U4, &[2], &[1, 0, 0, 0, 0, 1, 0, 0]))]);
    assert_eq!(read_all(&good), Ok(vec![vec![1.0, 256.0]]));
    let empty = archive(&[("a.npy", array(Dtype::F8, &[0, 3], &[]))]);
    assert_eq!(read_all(&empty), Ok(vec![vec![]]));
    let scalar = archive(&[("a.npy", array(Dtype::U1, &[], &[9]))]);
    assert_eq!(read_all(&scalar), Ok(vec![vec![9.0]]));

    let said = |bytes: &[u8], part: &str| {
        let error = read_all(bytes).unwrap_err();
        assert!(error.starts_with("cannot read x.npz: ") && error.contains(part), "{error}");
    };
    said(&archive(&[("a.npy", array(Dtype::F8, &[3], &[0; 23]))]), "its shape needs");
    said(&archive(&[("a.npy", array(Dtype::F8, &[3], &[0; 25]))]), "its shape needs");
    said(&archive(&[("a.npy", array(Dtype::F8, &[1 << 31], &[]))]), "more than");
    said(&archive(&[("a.npy", array(Dtype::F8, &[1 << 30], &[]))]), "its shape needs");
    said(&archive(&[("a.npy", b"\x93NUMPY".to_vec())]), "cut short");
    said(&archive(&[("a.npy", b"nothing of the kind".to_vec())]), "numpy");
    said(&archive(&[("a.txt", b"text".to_vec())]), "no arrays");
    said(&archive(&[]), "no arrays");
    let names: Vec<String> = (0..1025).map(|at| format!("{at}.npy")).collect();
    let many = |count: usize| {
        let files = names[..count].iter().map(|name| (&name[..], array(Dtype::U1, &[], &[9])));
        archive(&files.collect::<Vec<_>>())
    };
    assert_eq!(read_all(&many(1024)).map(|arrays| arrays.len()), Ok(1024));
    said(&many(1025), "more than 1024 files");
    said(b"text", "no .npz");
    said(b"", "no .npz");
    said(&good[..good.len() / 2], "no .npz");

    // The data does not match its checksum.
    let stored = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    zip.start_file("a.npy", stored).unwrap();
    zip.write_all(&array(Dtype::U1, &[4], b"\xAA\xBB\xCC\xDD")).unwrap();
    let mut bytes = zip.finish().unwrap().into_inner();
    let place = bytes.windows(4).position(|w| w == b"\xAA\xBB\xCC\xDD").unwrap();
    bytes[place] ^= 1;
    said(&bytes, "checksum");
}

#[test]
fn a_directory_that_claims_billions_of_files_is_refused() {
    // A zip64 end record, its locator, and the plain end record.
    let mut bytes = vec![0; 64];
    let end64 = bytes.len() as u64;
    bytes.extend(b"PK\x06\x06");
    bytes.extend(44_u64.to_le_bytes());
    bytes.extend([45, 0, 45, 0]);
    bytes.extend([0; 8]);
    for claim in [1_u64 << 33, 1 << 33, 1 << 45, 1 << 40] {
        bytes.extend(claim.to_le_bytes());
    }
    bytes.extend(b"PK\x06\x07");
    bytes.extend(0_u32.to_le_bytes());
    bytes.extend(end64.to_le_bytes());
    bytes.extend(1_u32.to_le_bytes());
    bytes.extend(b"PK\x05\x06");
    bytes.extend([0; 4]);
    bytes.extend([0xFF; 12]);
    bytes.extend([0; 2]);
    read_all(&bytes).unwrap_err();
}

/// A small archive as the sink writes it.
fn small_archive() -> Vec<u8> {
    let folder = folder();
    let path = folder.path().join("small.npz");
    npz::write(&path, &frame(3, 2)).expect("a file");
    fs::read(&path).expect("its bytes")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn damaged_archives_never_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        static WHOLE: std::sync::LazyLock<Vec<u8>> = std::sync::LazyLock::new(small_archive);
        let mut bytes = WHOLE.clone();
        for (place, byte) in changes {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        let _ = read_all(&bytes);
    }

    #[test]
    fn damaged_headers_never_panic(
        place in 0..128usize,
        byte: u8,
        data in prop::collection::vec(any::<u8>(), 0..40),
    ) {
        let mut bytes = array(Dtype::U4, &[2, 2], &data);
        bytes[place] = byte;
        let _ = read_all(&archive(&[("a.npy", bytes)]));
    }

    #[test]
    fn anything_called_png_never_panics(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let folder = folder();
        let path = folder.path().join("frame.png");
        write_image(&path, &image(8, 8));
        let mut bytes = fs::read(&path).expect("its bytes");
        for (place, byte) in changes {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        fs::write(&path, bytes).expect("a file");
        let _ = png::read(&path);
    }
}
