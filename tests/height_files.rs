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
#[path = "height_files/packed.rs"]
mod packed;
#[path = "height_files/real.rs"]
mod real;
#[path = "support/tiff_file.rs"]
mod tiff_file;

use terraline::scene::height_map::source;
use terraline::scene::{Encoding, HeightFile};

/// Reads a file that must be sound.
#[track_caller]
fn read(bytes: &[u8], name: &str) -> HeightFile {
    source::decode(bytes, name, Encoding::Stored).unwrap_or_else(|error| panic!("{error}"))
}

/// The message for a bad file, which must be one line that holds all of the words.
#[track_caller]
fn refused(bytes: &[u8], name: &str, words: &[&str]) {
    let message = match source::decode(bytes, name, Encoding::Stored) {
        Ok(_) => panic!("{name} was read"),
        Err(error) => error.to_string(),
    };
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(message.starts_with(name) && message.contains("; "), "{message}");
    for word in words {
        assert!(message.contains(word), "no {word:?} in: {message}");
    }
}
