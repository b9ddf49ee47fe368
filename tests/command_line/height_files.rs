//! Height files on the command line: `info`, and scenes chosen for files that have none.

use std::fmt::Write as _;

use super::{Folder, write_map};

const SKY: [u8; 3] = [186, 208, 230];

/// An ESRI ASCII grid with cells of `cell` from `origin` on.
fn grid(
    columns: usize,
    rows: usize,
    cell: f64,
    origin: f64,
    height: impl Fn(usize, usize) -> f64,
) -> String {
    let mut text = format!(
        "ncols {columns}\nnrows {rows}\nxllcorner {origin}\nyllcorner {origin}\ncellsize {cell}\n"
    );
    for j in 0..rows {
        for i in 0..columns {
            let _ = write!(text, "{} ", height(i, j));
        }
        text.push('\n');
    }
    text
}

fn hills(i: usize, j: usize) -> f64 {
    let (x, z) = (i as f64 / 9.0, j as f64 / 7.0);
    500.0 + 80.0 * (x.sin() + z.cos()) + 30.0 * (x * z).sin()
}

#[test]
fn any_map_is_whole_on_the_screen() {
    let folder = Folder::new();
    for (name, text) in [
        ("square.asc", grid(60, 60, 30.0, 500_000.0, hills)),
        ("tiny.asc", grid(2, 2, 30.0, 500_000.0, |i, j| (i + j) as f64)),
        ("wide.asc", grid(300, 2, 30.0, 500_000.0, hills)),
        ("long.asc", grid(2, 300, 30.0, 500_000.0, hills)),
        ("constant.asc", grid(40, 30, 30.0, 500_000.0, |_, _| 12.5)),
        ("flat.asc", grid(40, 30, 30.0, 500_000.0, |i, _| i as f64 * 1e-3)),
        ("needle.asc", grid(20, 20, 1.0, 500_000.0, |i, j| if i * j == 100 { 900.0 } else { 0.0 })),
        ("below.asc", grid(30, 30, 0.000_278, 31.0, |i, j| -430.0 + hills(i, j) / 9.0)),
        ("degrees.asc", grid(50, 40, 0.25, 40.0, hills)),
        ("giant.asc", grid(30, 30, 1e6, 1e7, |i, j| (i * j) as f64 * 1e5)),
    ] {
        folder.write(name, text);
        for size in ["160x100", "90x90", "40x120"] {
            let frame = folder.json(&["render", name, "-o", "out.png", "--size", size]);
            let pixels = image::open(folder.path("out.png")).unwrap().into_rgb8();
            let (columns, lines) = pixels.dimensions();
            let hits = &frame["hits"];
            let ground = hits["surface"].as_u64().unwrap() + hits["side"].as_u64().unwrap();
            // A strip of one cell is a line of a few pixels on any screen.
            assert!(ground > 20, "{name} at {size}: {hits}");
            assert_eq!(hits["out_of_range"], 0, "{name} at {size}");
            let edge = |x: u32, y: u32| x == 0 || y == 0 || x + 1 == columns || y + 1 == lines;
            for (x, y, pixel) in pixels.enumerate_pixels() {
                assert!(!edge(x, y) || pixel.0 == SKY, "{name} at {size}: ground at {x}, {y}");
            }
        }
    }
}

#[test]
fn the_scene_that_is_written_draws_the_same() {
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path("maps/deep")).unwrap();
    folder.write("maps/deep/a \"b\".asc", grid(50, 40, 0.001, 45.0, hills));
    for options in [
        &[][..],
        &["--size", "64x48"],
        &["--set", "camera.pitch=-50", "--set", "kernel.shape=hat"],
        &["--set", "camera.forward=[1, -1, -1]"],
        &["--set", "surface.height.scale=0.02", "--set", "surface.cell=[1.5, 1.0]"],
        &["--set", "color.ramp.5=[255, 0, 0]", "--set", "camera.position.1=90"],
        &["--set", "surface.outside=clamp", "--set", "light.ambient=0.5"],
        &[
            "--set",
            "screen.size=[70, 50]",
            "--set",
            "screen.distance=1",
            "--set",
            "screen.pixel=[0.02, 0.02]",
        ],
        &["--set", "screen.mount.heading=5", "--set", "surface.nodata=7"],
        &["--set", "surface.kind=plane"],
        &["--format", "height=24.12:floor", "--format", "ground_x=24.14"],
    ] {
        let dem = ["render", "maps/deep/a \"b\".asc", "--sample", "0"];
        let small = if options.contains(&"--size") { &[][..] } else { &["--set", "seed=3"] };
        let out = ["-o", "a.png", "--scene-out", "maps/scene.toml"];
        folder.prints(&[&dem[..], options, small, &out].concat());
        folder.prints(&["render", "maps/scene.toml", "--sample", "0", "-o", "b.png"]);
        assert_eq!(folder.read("a.png"), folder.read("b.png"), "{options:?}");
    }
    let text = String::from_utf8(folder.read("maps/scene.toml")).unwrap();
    assert!(text.contains("# Note:"), "{text}");
}

#[test]
fn other_commands_take_height_files() {
    let folder = Folder::new();
    folder.write("dem.asc", grid(50, 40, 30.0, 500_000.0, hills));
    let pixel = folder.json(&["explain", "dem.asc", "--pixel", "640,400"]);
    assert_eq!(pixel["hit"], "surface");
    assert_eq!(folder.json(&["plan", "dem.asc"])["columns"], 1280);
    assert_eq!(folder.json(&["cycles", "dem.asc", "--size", "64x40"])["lines"], 40);
    let frame = folder.json(&["render", "dem.asc", "--size", "64x40"]);
    assert!(frame["chosen"].to_string().contains("metres are assumed"), "{frame}");
    assert!(folder.prints(&["render", "dem.asc", "--size", "64x40"]).contains("  chosen "));
    write_map(&folder.path("map.png"), 40, 40, |i, j| (i * j * 40) as u16);
    let frame = folder.json(&["render", "map.png", "--size", "64x40"]);
    assert!(frame["chosen"].to_string().contains("30 m x 30 m"), "{frame}");
    // Colours that are heights, by an option.
    image::RgbImage::from_fn(20, 20, |i, j| image::Rgb([1, 134 + (i / 4) as u8, (j * 9) as u8]))
        .save(folder.path("tile.png"))
        .unwrap();
    let set = ["--set", "surface.encoding=terrain-rgb", "--size", "64x40"];
    folder.prints(
        &[&["render", "tile.png", "-o", "a.png", "--scene-out", "t.toml"], &set[..]].concat(),
    );
    folder.prints(&["render", "t.toml", "-o", "b.png"]);
    assert_eq!(folder.read("a.png"), folder.read("b.png"));
}

#[test]
fn files_that_are_no_maps_are_named_for_what_they_are() {
    let folder = Folder::new();
    folder.write("junk", [0x80, 1, 2, 3]);
    folder.write("dem.asc", grid(20, 15, 30.0, 500_000.0, hills));
    std::fs::create_dir(folder.path("folder")).unwrap();
    for (arguments, words) in [
        (&["render", "junk"][..], &["junk", "TOML", "terraline info"][..]),
        (&["plan", "folder"], &["folder", "is a folder"]),
        (&["info", "dem.tif"], &["dem.tif", "no such file", "check the name"]),
        (
            &["explain", "dem.asc", "--pixel", "1,1", "--set", "camera.position=[9, -9, 9]"],
            &["dem.asc: camera.position", "raise y"],
        ),
    ] {
        let output = folder.run(arguments);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {stderr}");
        assert_eq!(stderr.lines().count(), 1, "{stderr}");
        for word in words {
            assert!(stderr.contains(word), "no {word:?} in {stderr}");
        }
    }
}

#[test]
fn info_says_what_was_understood() {
    let folder = Folder::new();
    folder.write("a.asc", grid(50, 40, 0.001, 45.0, hills));
    write_map(&folder.path("b.png"), 4, 3, |i, j| (i + j) as u16);
    let text = folder.prints(&["info", "a.asc", "b.png"]);
    for word in [
        "a.asc",
        "ESRI ASCII grid",
        "50 x 40 nodes",
        "degrees: ",
        "none declared; 0 of 2000 nodes",
        "terraline render a.asc -o a-view.png",
        "b.png",
        "PNG, uint16",
        "not known",
        "0 to 5",
    ] {
        assert!(text.contains(word), "no {word:?} in {text}");
    }
    let json = folder.json(&["info", "a.asc", "b.png"]);
    let files = json["files"].as_array().unwrap();
    assert_eq!(files.len(), 2);
    assert_eq!((&files[0]["columns"], &files[0]["rows"]), (&50.into(), &40.into()));
    assert_eq!(files[0]["coordinates"], "degrees");
    assert_eq!(files[0]["nodata_nodes"], 0);
    assert!(files[1]["cell_m"].is_null() && files[1]["epsg"].is_null());
    // What it says to type works.
    folder.prints(&["render", "a.asc", "-o", "a-view.png", "--size", "64x40"]);
    assert!(folder.path("a-view.png").exists());
}

#[test]
fn info_goes_on_after_a_bad_file() {
    let folder = Folder::new();
    folder.write("a.asc", grid(5, 4, 30.0, 500_000.0, hills));
    folder.write("bad.asc", "ncols x\n");
    folder.write("c.asc", grid(6, 4, 30.0, 500_000.0, hills));
    let all = ["info", "a.asc", "bad.asc", "missing.tif", "c.asc"];
    let output = folder.run(&all);
    assert_eq!(output.status.code(), Some(2));
    let (stdout, stderr) =
        (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(stdout.contains("5 x 4 nodes") && stdout.contains("6 x 4 nodes"), "{stdout}");
    let messages: Vec<&str> = stderr.lines().collect();
    assert_eq!(messages.len(), 3, "{stderr}");
    assert!(messages[0].contains("bad.asc") && messages[1].contains("missing.tif"), "{stderr}");
    assert!(messages[2].contains("2 of 4 files"), "{stderr}");
    let output = folder.run(&[&all[..], &["--json"]].concat());
    assert_eq!(output.status.code(), Some(2));
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["files"].as_array().map(Vec::len), Some(2));
    assert_eq!(json["errors"][1]["file"], "missing.tif");
}

#[test]
fn options_settle_what_a_file_leaves_open() {
    let folder = Folder::new();
    let height = |i: usize, j: usize| if (i, j) == (3, 2) { 7.0 } else { 500.0 + hills(i, j) };
    folder.write("dem.asc", grid(50, 40, 100.0, 500_000.0, height));
    let asked = ["--unit", "ft", "--height-unit", "ft", "--nodata", "7"];
    let info = folder.json(&[&["info", "dem.asc"], &asked[..]].concat());
    let file = &info["files"][0];
    assert_eq!(file["cell_m"][0].as_f64(), Some(30.48));
    assert_eq!((&file["height_unit_m"], &file["nodata_nodes"]), (&0.3048.into(), &1.into()));
    // The command that it names draws the same.
    let render = file["render"].as_str().unwrap();
    assert!(render.contains("--unit 0.3048 --height-unit 0.3048 --nodata 7.0"), "{render}");
    let outputs = ["-o", "a.png", "--size", "64x40", "--scene-out", "s.toml"];
    let frame = folder.json(&[&["render", "dem.asc"], &asked[..], &outputs].concat());
    assert!(frame["chosen"].to_string().contains("1 node has no data"), "{frame}");
    folder.prints(&["render", "s.toml", "-o", "b.png"]);
    assert_eq!(folder.read("a.png"), folder.read("b.png"));
    let scene = String::from_utf8(folder.read("s.toml")).unwrap();
    assert!(scene.contains("unit_m = 30.48") && scene.contains("nodata_value = 7.0"), "{scene}");
    // A scene has keys of its own.
    for option in [&["--unit", "ft"][..], &["--height-unit", "ft"]] {
        let output = folder.run(&[&["render", "s.toml"], option].concat());
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{stderr}");
        assert!(stderr.contains(option[0]) && stderr.contains("surface.cell"), "{stderr}");
    }
}

#[test]
fn several_files_are_one_map() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("maps")).unwrap();
    std::fs::create_dir(folder.path("scenes")).unwrap();
    let part = |west: usize, columns: usize| {
        let text = grid(columns, 30, 30.0, 0.0, |i, j| hills(west + i, j));
        text.replace("xllcorner 0", &format!("xllcorner {}", 30 * west))
    };
    folder.write("whole.asc", part(0, 41));
    folder.write("maps/a.asc", part(0, 21));
    folder.write("b.asc", part(20, 21));
    let size = ["--size", "96x60"];
    folder.prints(&[&["render", "whole.asc", "-o", "whole.png"], &size[..]].concat());
    let tiles =
        ["render", "maps/a.asc", "b.asc", "-o", "tiles.png", "--scene-out", "scenes/s.toml"];
    let text = folder.prints(&[&tiles[..], &size].concat());
    assert!(text.contains("2 files make one map of 41 x 30 nodes"), "{text}");
    assert_eq!(folder.read("whole.png"), folder.read("tiles.png"));
    folder.prints(&["render", "scenes/s.toml", "-o", "again.png"]);
    assert_eq!(folder.read("whole.png"), folder.read("again.png"));
    let output = folder.run(&["render", "flight", "maps/a.asc"]);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert!(stderr.contains("maps/a.asc") && stderr.contains("flight is a scene"), "{stderr}");
}

#[test]
fn packed_files_are_drawn_as_they_are_described() {
    let folder = Folder::new();
    let mut gzip = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    std::io::Write::write_all(&mut gzip, grid(20, 15, 30.0, 500_000.0, hills).as_bytes()).unwrap();
    folder.write("dem.asc.gz", gzip.finish().unwrap());
    assert!(folder.prints(&["info", "dem.asc.gz"]).contains("ESRI ASCII grid in a gzip file"));
    folder.prints(&["render", "dem.asc.gz", "-o", "a.png", "--size", "64x40"]);
    folder.write("cut.asc.gz", b"\x1f\x8b\x08\0\0\0\0\0\0\0");
    let message = |command: &str| {
        let output = folder.run(&[command, "cut.asc.gz"]);
        assert_eq!(output.status.code(), Some(2), "{command}");
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    assert_eq!(message("info"), message("render"));
}

#[test]
fn notes_follow_the_options() {
    let folder = Folder::new();
    // Flat, with a hole.
    let height = |i, j| if (i, j) == (7, 7) { -9999.0 } else { (i + j) as f64 / 9.0 };
    folder.write("dem.asc", grid(50, 40, 30.0, 500_000.0, height));
    let chosen = |options: &[&str]| {
        let render = ["render", "dem.asc", "--size", "64x40", "--sample", "0"];
        folder.json(&[&render, options].concat())["chosen"].to_string()
    };
    let all = chosen(&[]);
    for (sets, gone) in [
        (&["surface.nodata=nearest"][..], &["holes"][..]),
        (&["surface.0.nodata=nearest"], &["holes"]),
        (&["surface.height.scale=0.01"], &["times life size", "unit of heights is not stated"]),
        (&["surface.height={ offset = 0, scale = 0.01 }"], &["times life size"]),
        (&["surface.cell=[1, 2]"], &["times life size"]),
        (&["unit_m=7"], &["times life size"]),
        (
            &["surface.map=builtin:jacksboro", "camera.position=[20, 900, 60]"],
            &["times life size", "holes"],
        ),
    ] {
        let options: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
        let left = chosen(&options);
        for words in gone {
            assert!(all.contains(words), "no {words:?} in {all}");
            assert!(!left.contains(words), "{sets:?}: {left}");
        }
    }
    let left = chosen(&["--set", "surface.nodata=nearest"]);
    assert!(left.contains("times life size"), "{left}");
    let out = ["--size", "64x40", "--sample", "0", "--scene-out"];
    folder.prints(&[&["render", "dem.asc"], &out[..], &["a.toml"]].concat());
    folder.prints(
        &[&["render", "dem.asc", "--set", "camera.pitch=-50"], &out[..], &["b.toml"]].concat(),
    );
    let [a, b] = ["a.toml", "b.toml"].map(|name| String::from_utf8(folder.read(name)).unwrap());
    assert!(a.contains("from above one of its sides") && !b.contains("from above one of"));
}

#[test]
fn a_map_is_thinned_to_the_memory_that_it_may_take() {
    let folder = Folder::new();
    folder.write("dem.asc", grid(200, 150, 30.0, 500_000.0, hills));
    let limited = ["render", "dem.asc", "--memory", "1M", "--size", "64x40", "--sample", "0"];
    let text = folder.prints(&[&limited[..], &["-o", "a.png", "--scene-out", "s.toml"]].concat());
    assert!(text.contains("of 200 x 150 nodes every 2nd of every 2nd row is read"), "{text}");
    let scene = String::from_utf8(folder.read("s.toml")).unwrap();
    assert!(scene.contains("thin = 2"), "{scene}");
    folder.prints(&["render", "s.toml", "-o", "b.png", "--sample", "0"]);
    assert_eq!(folder.read("a.png"), folder.read("b.png"));
    for (arguments, word) in [
        (&["dem.asc", "--memory", "much"][..], "2.5G"),
        (&["flight", "--memory", "1G"], "surface.thin"),
    ] {
        let output = folder.run(&[&["render"], arguments].concat());
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{stderr}");
        assert!(stderr.contains(word), "{stderr}");
    }
}

/// Without the check, an allocation would fail in the middle of it.
#[cfg(target_os = "linux")]
#[test]
fn a_map_that_there_is_no_memory_for_is_refused() {
    let folder = Folder::new();
    let map = "surface.map=builtin:jacksboro@8192";
    let command =
        format!("ulimit -v 1000000; {} plan --set {map}", env!("CARGO_BIN_EXE_terraline"));
    let output = std::process::Command::new("sh")
        .args(["-c", &command])
        .current_dir(folder.path("."))
        .output();
    let output = output.unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert_eq!(stderr.lines().count(), 1, "{stderr}");
    assert!(stderr.contains("takes about 5.0 GB") && stderr.contains("jacksboro@"), "{stderr}");
}
