//! Whole windows as stored pictures; `UPDATE_GOLDEN=1` rewrites them.

use std::path::Path;

use terraline::sink::png;

use super::{run, scene};

#[track_caller]
fn is_golden(name: &str, of: &str, size: (usize, usize), keys: &str) {
    let (canvas, _) = run(scene(of, &[]), size, keys);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(name);
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        png::write(&path, size.0, size.1, &canvas.bytes()).expect("a golden picture");
    }
    let golden = png::read(&path).expect("a golden picture");
    let found = canvas.bytes();
    let differ = golden.pixels.iter().zip(&found).filter(|(a, b)| a != b).count();
    assert!(
        (golden.columns, golden.lines) == size && differ == 0,
        "{name}: {differ} pixels differ; look at the window and run `UPDATE_GOLDEN=1 cargo test \
         --test window golden` if it is right"
    );
}

#[test]
fn a_plane_with_its_pixel() {
    is_golden("plane.png", "plane", (480, 320), "move=240,200");
}

#[test]
fn two_pictures_beside_a_split() {
    is_golden("split.png", "plane", (560, 320), "2 shift+5 move=300,250");
}

#[test]
fn the_help() {
    is_golden("help.png", "plane", (520, 420), "h");
}

#[test]
fn a_standing_scan_in_a_small_window() {
    is_golden("scan.png", "plane", (240, 180), "- - - wait wait wait space");
}

#[test]
fn help_in_a_small_window_goes_on_on_further_pages() {
    is_golden("help-1.png", "plane", (420, 320), "h");
    is_golden("help-2.png", "plane", (420, 320), "h pagedown");
    let [first, second, back] = ["h", "h pagedown", "h pagedown pageup"]
        .map(|keys| run(scene("plane", &[]), (420, 320), keys).0);
    assert!(first != second && first == back);
}

#[test]
fn legends_and_status_fit_a_small_window() {
    is_golden("small.png", "overview", (420, 320), "2 shift+4 move=100,200");
    is_golden("small-2.png", "overview", (420, 320), "2 shift+4 move=100,200 pagedown");
}
