//! Height files of every format: samples as they were written, one clear message for every bad file.

#[path = "height_files/ascii.rs"]
mod ascii;
#[path = "height_files/damaged.rs"]
mod damaged;
#[path = "height_files/forged.rs"]
mod forged;
#[path = "height_files/fuzz.rs"]
mod fuzz;
#[path = "height_files/georeference.rs"]
mod georeference;
#[path = "height_files/geotiff.rs"]
mod geotiff;
#[path = "height_files/hgt.rs"]
mod hgt;
#[path = "height_files/mosaic.rs"]
mod mosaic;
#[path = "height_files/odd.rs"]
mod odd;
#[path = "height_files/packed.rs"]
mod packed;
#[path = "height_files/real.rs"]
mod real;
#[path = "support/skipped.rs"]
mod skipped;
#[path = "height_files/stated.rs"]
mod stated;
#[path = "support/tiff_file.rs"]
mod tiff_file;

use terraline::scene::height_map::source;
use terraline::scene::{HeightFile, Interpretation};
use tiff_file::{SHORT, TiffFile};

/// Reads a file that must be sound.
#[track_caller]
fn read(bytes: &[u8], name: &str) -> HeightFile {
    source::decode(bytes, name, &Interpretation::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

/// The message for a bad file, which must be one line that holds all of the words.
#[track_caller]
fn refused(bytes: &[u8], name: &str, words: &[&str]) {
    let message = match source::decode(bytes, name, &Interpretation::default()) {
        Ok(_) => panic!("{name} was read"),
        Err(error) => error.to_string(),
    };
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(message.starts_with(name) && message.contains("; "), "{message}");
    for word in words {
        assert!(message.contains(word), "no {word:?} in: {message}");
    }
}

/// GeoKeys with values of their own, with numbers, and with texts.
fn with_keys(
    file: TiffFile,
    codes: &[(u64, u64)],
    numbers: &[(u64, f64)],
    texts: &[(u64, &str)],
) -> TiffFile {
    let mut values = vec![1, 1, 0, (codes.len() + numbers.len() + texts.len()) as u64];
    for (key, code) in codes {
        values.extend([*key, 0, 1, *code]);
    }
    for (at, (key, _)) in numbers.iter().enumerate() {
        values.extend([*key, 34736, 1, at as u64]);
    }
    let mut all = String::new();
    for (key, text) in texts {
        values.extend([*key, 34737, text.len() as u64 + 1, all.len() as u64]);
        all += &format!("{text}|");
    }
    let numbers: Vec<f64> = numbers.iter().map(|(_, number)| *number).collect();
    let mut file = file.with(34735, SHORT, &values);
    if !numbers.is_empty() {
        file = file.with_doubles(34736, &numbers);
    }
    if all.is_empty() { file } else { file.with_text(34737, &all) }
}
