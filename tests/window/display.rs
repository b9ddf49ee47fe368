//! The program in a real window, on a virtual display; skipped where there is no Xvfb.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};

use terraline::sink::png;

use super::skipped::skipped;

/// A virtual display that lives as long as this.
struct Display {
    server: Child,
    name: String,
}

impl Display {
    /// `None`, with a printed reason, where no window can be opened.
    fn new() -> Option<Self> {
        let server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp"])
            // It would start anew between two programs, and refuse one that comes at that moment.
            .arg("-noreset")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn();
        let Ok(mut server) = server else {
            skipped("there is no Xvfb here");
            return None;
        };
        let mut number = String::new();
        let out = server.stdout.take().expect("a pipe");
        let _ = BufReader::new(out).read_line(&mut number);
        let display = Self { server, name: format!(":{}", number.trim()) };
        if number.trim().is_empty() {
            skipped("Xvfb does not start here");
            return None;
        }
        Some(display)
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

fn terraline(folder: &Path, display: Option<&str>, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_terraline"));
    command.current_dir(folder).args(arguments).env_remove("DISPLAY");
    if let Some(display) = display {
        command.env("DISPLAY", display);
    }
    let output = command.output().expect("the program starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(!stderr.contains("panicked"), "{arguments:?}: {stderr}");
    output
}

#[track_caller]
fn succeeds(output: &Output) {
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{stderr}");
}

#[test]
fn a_window_shows_what_render_draws() {
    let Some(display) = Display::new() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let size = ["--size", "320x240"];
    let script = ["--frames", "3", "--keys", "tab", "--screenshot", "window.png"];
    let view = [&["view", "flight"][..], &size, &script].concat();
    let seen = terraline(folder.path(), Some(&display.name), &view);
    if String::from_utf8_lossy(&seen.stderr).contains("failed to load") {
        skipped(&String::from_utf8_lossy(&seen.stderr));
        return;
    }
    succeeds(&seen);
    let render = [&["render", "flight", "--sample", "0", "-o", "frame.png"][..], &size].concat();
    succeeds(&terraline(folder.path(), None, &render));
    let [window, frame] =
        ["window.png", "frame.png"].map(|name| png::read(&path(name)).expect("a picture"));
    assert_eq!(window, frame);

    // A scene that is copied out renders as it was seen; a screenshot takes a free name.
    std::fs::write(path("terraline-001.png"), "mine").expect("a file");
    let keys = "tab w w left j 2 1 c S";
    let script = ["--frames", "10", "--keys", keys, "--screenshot", "window.png"];
    let view = [&["view", "flight"][..], &size, &script].concat();
    let seen = terraline(folder.path(), Some(&display.name), &view);
    succeeds(&seen);
    let printed = String::from_utf8(seen.stdout).expect("text");
    let (scene, name) = printed.trim_end().rsplit_once('\n').expect("a scene and a name");
    assert_eq!(name, "terraline-002.png");
    std::fs::write(path("copied.toml"), scene).expect("a file");
    let render = ["render", "copied.toml", "--sample", "0", "-o", "frame.png"];
    succeeds(&terraline(folder.path(), None, &render));
    let [window, shot, frame] =
        ["window.png", name, "frame.png"].map(|name| png::read(&path(name)).expect("a picture"));
    assert!(window == frame && shot == frame);
}

#[test]
fn a_height_file_is_looked_over() {
    let Some(display) = Display::new() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    for name in ["maps", "scenes", "else"] {
        std::fs::create_dir(path(name)).expect("a folder");
    }
    // Heights packed in colours, and a hole.
    image::RgbaImage::from_fn(40, 30, |i, j| {
        let alpha = if (10..15).contains(&i) && (5..9).contains(&j) { 0 } else { 255 };
        image::Rgba([130, ((i * i + j * 30) / 8) as u8, 7, alpha])
    })
    .save(path("maps/tile.png"))
    .expect("a picture");
    let dem = ["maps/tile.png", "--set", "surface.encoding=terrarium", "--size", "300x170"];
    let keys = ["--frames", "3", "--keys", "tab c", "--screenshot", "window.png"];
    let out = ["--scene-out", "scenes/chosen.toml"];
    let view = [&["view"][..], &dem, &keys, &out].concat();
    let seen = terraline(folder.path(), Some(&display.name), &view);
    if String::from_utf8_lossy(&seen.stderr).contains("failed to load") {
        skipped(&String::from_utf8_lossy(&seen.stderr));
        return;
    }
    succeeds(&seen);
    assert!(
        String::from_utf8_lossy(&seen.stderr).contains("no data"),
        "what was chosen is reported"
    );
    std::fs::write(path("else/copied.toml"), &seen.stdout).expect("a file");
    let window = png::read(&path("window.png")).expect("a picture");
    // The size of the window fits the whole map in, as that of a picture does.
    let bare = [&["render"][..], &dem].concat();
    for (from, render) in [
        ("", &bare[..]),
        ("scenes", &["render", "chosen.toml"]),
        ("else", &["render", "copied.toml"]),
        ("maps", &["render", "../else/copied.toml"]),
    ] {
        let frame = path("frame.png");
        let to = ["--sample", "0", "-o", frame.to_str().expect("text")];
        succeeds(&terraline(&path(from), None, &[render, &to].concat()));
        assert_eq!(window, png::read(&frame).expect("a picture"), "{from}: {render:?}");
    }

    // Without a window nothing is written.
    let view = ["view", "maps/tile.png", "--set", "surface.encoding=terrarium"];
    for (options, names) in [
        (&["--scene-out", "no.toml"][..], "terraline render"),
        (&["--scene-out", "no/no.toml"], "no/no.toml"),
        (&["--scene-out", "maps/tile.png"], "maps/tile.png"),
        (&["--scene-out", "no.png", "--frames", "1", "--screenshot", "./no.png"], "two names"),
    ] {
        let output = terraline(folder.path(), None, &[&view[..], options].concat());
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{options:?}: {stderr}");
        assert!(stderr.contains(names) && stderr.lines().count() == 1, "{options:?}: {stderr}");
        assert!(!path("no.toml").exists() && !path("no.png").exists());
    }
}

#[test]
fn a_window_is_no_larger_than_the_screen() {
    // It has 800x600 pixels.
    let Some(display) = Display::new() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    for (options, size, note) in [
        (&["overview"][..], (600, 600), false),
        (&["overview", "--scale", "3"], (600, 600), false),
        (&["plane", "--set", "screen.size=[1600, 400]"], (800, 200), false),
        (&["plane", "--size", "640x480"], (640, 480), false),
        (&["plane", "--size", "900x500"], (900, 500), true),
    ] {
        let script = ["--frames", "1", "--screenshot", "window.png"];
        let seen = terraline(
            folder.path(),
            Some(&display.name),
            &[&["view"][..], options, &script].concat(),
        );
        let stderr = String::from_utf8_lossy(&seen.stderr);
        if stderr.contains("failed to load") {
            skipped(&stderr);
            return;
        }
        succeeds(&seen);
        let window = png::read(&folder.path().join("window.png")).expect("a picture");
        assert_eq!((window.columns, window.lines), size, "{options:?}");
        assert_eq!(stderr.contains("800x600"), note, "{options:?}: {stderr}");
    }
}

#[test]
fn without_a_display_one_message_names_render() {
    let folder = tempfile::tempdir().expect("a folder");
    for display in [None, Some(""), Some(":4711"), Some("nowhere")] {
        let arguments = ["view", "plane", "--frames", "1", "--screenshot", "no.png"];
        let output = terraline(folder.path(), display, &arguments);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{display:?}: {stderr}");
        assert!(stderr.contains("terraline render"), "{display:?}: {stderr}");
        assert_eq!(stderr.lines().count(), 1, "{display:?}: {stderr}");
        assert!(output.stdout.is_empty() && !folder.path().join("no.png").exists());
    }
}

#[test]
fn bad_options_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    for (arguments, names) in [
        (&["--frames", "1", "--keys", "w www"][..], "`www`"),
        (&["--frames", "1", "--keys", "w w"], "--frames 2"),
        (&["--keys", "w"], "--frames"),
        (&["--frames", "1", "--keys", "- -"], "--frames 2"),
        (&["--screenshot", "a.png"], "--frames"),
        (&["--scale", "0"], "--scale"),
        (&["--size", "16000x4000"], "--size"),
        (&["--frames", "1", "--screenshot", "no/a.png"], "no/a.png"),
        (&["--set", "camera.position=[232, -3, 168]"], "camera.position"),
    ] {
        let arguments = [&["view", "valley"][..], arguments].concat();
        let output = terraline(folder.path(), None, &arguments);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {stderr}");
        assert!(stderr.contains(names), "{arguments:?}: {stderr}");
    }
}
