//! Bad input: exit code 2, one line that begins with the program's name, and no file left behind.

use super::{Folder, unchanged, write_map};

/// Runs the program on bad input and returns its message.
#[track_caller]
pub fn refused(folder: &Folder, arguments: &[&str]) -> String {
    let before = folder.names();
    let output = folder.run(arguments);
    let stderr = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {stderr}");
    assert!(output.stdout.is_empty(), "{arguments:?} prints nothing else");
    assert!(stderr.starts_with("terraline: "), "{arguments:?}: {stderr}");
    assert_eq!(stderr.trim_end().lines().count(), 1, "{arguments:?}: {stderr}");
    unchanged(folder, &before, arguments);
    stderr
}

/// Renders with options, which must be refused with all of the words in the message.
#[track_caller]
fn render(folder: &Folder, options: &[&str], words: &[&str]) {
    let output = ["-o", "out.png", "--buffers", "out.npz"];
    let message = refused(folder, &[&["render"], options, &output].concat());
    for word in words {
        assert!(message.contains(word), "{options:?}: no {word:?} in {message}");
    }
    // Every message ends with what to do, so it has more than a name and a reason.
    assert!(message.len() > 40, "{message}");
}

#[test]
fn missing_and_unknown_scenes() {
    let folder = Folder::new();
    render(&folder, &["missing.toml"], &["missing.toml"]);
    render(&folder, &["no/such/folder/scene.toml"], &["no/such/folder/scene.toml"]);
    render(&folder, &["overwiev"], &["did you mean `overview`"]);
    render(&folder, &["fligth"], &["did you mean `flight`"]);
    render(&folder, &["Valley"], &["`valley`"]);
    render(&folder, &["zzzzzzzz"], &["overview", "plane"]);
    render(&folder, &[""], &["overview"]);
    render(&folder, &["./"], &[]);
    assert!(refused(&folder, &["scenes", "plain"]).contains("did you mean `plane`"));
}

#[test]
fn files_that_are_no_scenes() {
    let folder = Folder::new();
    folder.write("binary.toml", [0_u8, 255, 254, 13, 10, 0]);
    folder.write("text.toml", "this is not TOML\n");
    folder.write("open.toml", "[camera\nposition = [1, 2, 3]\n");
    folder.write("key.toml", "[camera]\nposition = [0, 50, 0]\npich = -20\n");
    folder.write("number.toml", "[camera]\nposition = [0, nan, 0]\nheading = 0\n");
    folder.write("huge.toml", "seed = 99999999999999999999\n");
    render(&folder, &["binary.toml"], &["binary.toml"]);
    render(&folder, &["text.toml"], &["text.toml", "line 1"]);
    render(&folder, &["open.toml"], &["open.toml", "line 1"]);
    render(&folder, &["key.toml"], &["key.toml", "line 3", "pich", "pitch"]);
    render(&folder, &["number.toml"], &["number.toml", "line 2", "camera.position"]);
    render(&folder, &["huge.toml"], &["huge.toml"]);
}

#[test]
fn maps_that_cannot_be_read() {
    let folder = Folder::new();
    write_map(&folder.path("whole.png"), 64, 64, |i, j| (i * 31 + j * 977) as u16);
    let whole = folder.read("whole.png");
    folder.write("truncated.png", &whole[..whole.len() / 2]);
    folder.write("header.png", &whole[..20]);
    folder.write("text.png", "a text, whatever its name says\n");
    folder.write("empty.png", "");
    image::RgbImage::new(4, 4).save(folder.path("color.png")).unwrap();
    let mut damaged = whole.clone();
    for at in (60..whole.len() - 16).step_by(7) {
        damaged[at] ^= 0x55;
    }
    folder.write("damaged.png", damaged);
    // A header that claims far more than the file holds.
    let mut boasting = whole.clone();
    boasting[16..24].copy_from_slice(&[0, 0, 0x3f, 0xff, 0, 0, 0x20, 0]);
    folder.write("boasting.png", boasting);
    for map in ["truncated", "header", "text", "empty", "color", "damaged", "boasting", "missing"] {
        let option = format!("surface.map={map}.png");
        render(&folder, &["flight", "--set", &option], &["surface.map", &format!("{map}.png")]);
    }
    render(&folder, &["flight", "--set", "surface.map=builtin:jackson"], &["builtin:jacksboro"]);
    render(&folder, &["flight", "--set", "surface.map=."], &["surface.map"]);
}

#[test]
fn height_files_that_are_none() {
    let folder = Folder::new();
    folder.write("text.tif", "a text, whatever its name says\n");
    folder.write("circle.tif", b"II\x2A\0\x08\0\0\0\0\0\x08\0\0\0");
    folder.write("grid.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3,5 4\n");
    folder.write("row.asc", "ncols 3\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n");
    folder.write(
        "marks.asc",
        "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 -3e38 4\n",
    );
    folder.write("sound.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3 4\n");
    for (file, words) in [
        ("missing.tif", &["missing.tif", "no such file", "built-in"][..]),
        ("text.tif", &["not a TIFF"]),
        ("circle.tif", &["circle"]),
        ("grid.asc", &["line 6", "decimal comma"]),
        ("row.asc", &["3 x 1"]),
        ("marks.asc", &["-3e38", "--nodata -3"]),
        ("nowhere/dem.hgt", &["no such file"]),
    ] {
        render(&folder, &[file], words);
        if !file.starts_with("row") && !file.starts_with("marks") {
            assert!(refused(&folder, &["info", file]).contains(file));
        }
    }
    render(&folder, &["sound.asc", "--scene-out", "out.png"], &["--scene-out", "same file"]);
    render(&folder, &["sound.asc", "--scene-out", "sound.asc"], &["sound.asc", "overwritten"]);
    render(&folder, &["sound.asc", "--scene-out", "no/scene.toml"], &["no folder"]);
    render(&folder, &["sound.asc", "--set", "surface.encoding=terrain-rgb"], &["PNG files"]);
    render(&folder, &["sound.asc", "--set", "surface.encoding=rgb"], &["terrain-rgb"]);
    render(&folder, &["sound.asc", "--set", "camera.pich=3"], &["camera.pitch"]);
    render(&folder, &["sound.asc", "--size", "0x3"], &["--size"]);
}

#[test]
fn values_that_no_scene_can_have() {
    let folder = Folder::new();
    for (option, word) in [
        ("camera.position=[nan, 0, 0]", "camera.position"),
        ("camera.position=[0, inf, 0]", "camera.position"),
        ("camera.pitch=nan", "camera.pitch"),
        ("camera.heading=-inf", "camera.heading"),
        ("camera.forward=[0, 0, 0]", "camera.forward"),
        ("camera.forward=[0, nan, 1]", "camera.forward"),
        ("surface.cell=[0, 1]", "surface.cell"),
        ("surface.cell=[inf, 1]", "surface.cell"),
        ("surface.height.scale=nan", "surface.height.scale"),
        ("surface.height.scale=0", "surface.height.scale"),
        ("light.ambient=nan", "light.ambient"),
        ("light.ambient=1.5", "light.ambient"),
        ("light.direction=[0, 0, 0]", "light.direction"),
        ("screen.fov=0", "fov"),
        ("screen.fov=nan", "fov"),
        ("screen.fov=180", "fov"),
        ("screen.size=[0, 10]", "size"),
        ("screen.size=[-1, 10]", "size"),
        ("screen.size=[1e99, 10]", "size"),
        ("kernel.table=100", "kernel.table"),
        ("kernel.weight_shift=-1", "kernel.weight_shift"),
        ("stepper.fineness=7", "stepper.fineness"),
        ("stepper.halvings=21", "stepper.halvings"),
        ("machine.clock_mhz=inf", "machine.clock_mhz"),
        ("machine.memory_latency=0", "machine.memory_latency"),
        ("color.ramp=[]", "color.ramp"),
        ("camera.pich=3", "camera.pitch"),
        ("camra.pitch=3", "camra"),
        ("no equals sign", "--set"),
        ("=3", "--set"),
        ("camera.pitch=", "camera.pitch"),
        ("camera.pitch=[[[", "camera.pitch"),
    ] {
        render(&folder, &["flight", "--set", option], &[word]);
    }
}

#[test]
fn eyes_under_the_ground() {
    let folder = Folder::new();
    let under = ["--set", "camera.position=[232.0, 1.0, 168.0]"];
    render(&folder, &[&["valley"], &under[..]].concat(), &["camera.position", "ground", "raise"]);
    for engine in ["processor", "fast", "real", "oracle"] {
        let options = [&["valley", "--size", "8x8", "--engine", engine], &under[..]].concat();
        render(&folder, &options, &["camera.position"]);
    }
    let pixel = ["explain", "valley", "--pixel", "1,1"];
    assert!(refused(&folder, &[&pixel[..], &under].concat()).contains("camera.position"));
    assert!(refused(&folder, &[&["cycles", "valley"], &under[..]].concat()).contains("raise"));
}

#[test]
fn screens_of_impossible_sizes() {
    let folder = Folder::new();
    for size in [
        "0x10",
        "10x0",
        "0x0",
        "100000x100000",
        "16385x1",
        "4294967296x1",
        "1x4294967297",
        "99999999999999999999x1",
        "16384x16384",
        "-1x5",
        "5",
        "x",
        "5x",
        "x5",
        "5x5x5",
        "axb",
        "",
        "1.5x2",
        "５x５",
        "0x1F",
    ] {
        let option = format!("--size={size}");
        render(&folder, &["flight", &option], &["--size", "640x480"]);
        assert!(refused(&folder, &["plan", "flight", &option]).contains("--size"));
    }
    render(&folder, &["flight", "--screen", "left"], &["--screen", "front"]);
}

#[test]
fn pixels_outside_the_screen() {
    let folder = Folder::new();
    for pixel in ["1024,0", "0,1024", "4294967296,0", "-1,0", "5", "", ",", "a,b", "1,2,3", "1;2"] {
        let option = format!("--pixel={pixel}");
        let message = refused(&folder, &["explain", "flight", &option]);
        assert!(message.contains("--pixel") && message.contains("1023,1023"), "{message}");
    }
    let small = ["explain", "flight", "--size", "10x8", "--pixel", "9,8"];
    assert!(refused(&folder, &small).contains("9,7"));
}

#[test]
fn formats_that_no_register_can_have() {
    let folder = Folder::new();
    for format in [
        "ground",
        "ground=",
        "ground=24",
        "ground=a.b",
        "ground=24.8:sideways",
        "ground=24.8:floor:explode",
        "ground=24.8:floor:wrap:more",
        "ground=0.1",
        "ground=40.40",
        "ground=4294967295.4294967295",
        "ground=-1.8",
        "=24.8",
        "grund=24.8",
        "dground_x=24.8",
        "weight=1.10",
        "tone=4.10",
        "view=0.20",
    ] {
        render(&folder, &["flight", "--format", format], &["format"]);
    }
    render(&folder, &["flight", "--format", "grund=24.8"], &["ground"]);
    render(&folder, &["flight", "--format", "ground=4.8"], &["ground"]);
    for name in ["view", "view_y", "denominator", "ground", "ground_x", "ray_y"] {
        for rounding in ["floor", "toward_zero", "nearest_even", "stochastic"] {
            let asked = format!("{name}=12.20:{rounding}");
            let told =
                [&format!("format.{name}"), rounding, "would act nowhere", "leave the rounding"];
            render(&folder, &["flight", "--format", &asked], &told);
        }
    }
    let saturating = ["flight", "--format", "ground=24.8:nearest:saturate"];
    render(&folder, &saturating, &["--engine processor"]);
    render(&folder, &[&saturating[..], &["--engine", "fast"]].concat(), &["--engine processor"]);
}

#[test]
fn output_that_cannot_be_written() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("folder")).unwrap();
    let small = ["render", "plane", "--size", "8x8"];
    for output in [
        ["-o", "missing/out.png"],
        ["-o", "folder"],
        ["--buffers", "missing/out.npz"],
        ["--buffers", "folder"],
    ] {
        let message = refused(&folder, &[&small[..], &output].concat());
        assert!(message.contains(output[1]), "{message}");
    }
    // Neither file is written where one of them cannot be.
    refused(&folder, &[&small[..], &["-o", "good.png", "--buffers", "missing/out.npz"]].concat());
    refused(&folder, &[&small[..], &["-o", "good.png", "--picture", "cycles"]].concat());
    let large = ["render", "plane", "--size", "8192x8192", "--buffers", "large.npz"];
    assert!(refused(&folder, &large).contains("--size"));
    let both = refused(&folder, &[&small[..], &["-o", "one", "--buffers", "one"]].concat());
    assert!(both.contains("one"), "two outputs in one file: {both}");
}

#[test]
fn arrays_that_cannot_be_given() {
    let folder = Folder::new();
    let small = ["render", "plane", "--size", "8x8"];
    let buffers = ["--buffers", "out.npz"];
    for (options, file, remedy) in [
        (&["--with", "error"][..], &[][..], "add --buffers OUT.npz"),
        (&["--with", "cycles"], &buffers, "add --engine processor"),
        (&["--with", "cycles", "--engine", "real"], &buffers, "add --engine processor"),
        (&["--with", "error,cycles", "--engine", "oracle"], &buffers, "add --engine processor"),
        (
            &["--with", "error", "--engine", "real"],
            &buffers,
            "give --engine fast or --engine processor",
        ),
        (
            &["--with", "error", "--engine", "oracle"],
            &buffers,
            "give --engine fast or --engine processor",
        ),
    ] {
        let message = refused(&folder, &[&small[..], options, file].concat());
        assert!(message.contains("terraline: --with") && message.contains(remedy), "{message}");
    }
}

#[test]
fn pictures_that_cannot_be_compared() {
    let folder = Folder::new();
    write_map(&folder.path("whole.png"), 8, 8, |i, j| (i * j) as u16);
    let whole = folder.read("whole.png");
    folder.write("cut.png", &whole[..whole.len() / 2]);
    folder.write("text.png", "a text\n");
    folder.write("text.npz", "a text\n");
    folder.write("text.txt", "a text\n");
    for (a, b) in [
        ("whole.png", "cut.png"),
        ("text.png", "whole.png"),
        ("text.npz", "text.npz"),
        ("text.txt", "text.txt"),
        ("missing.png", "whole.png"),
        (".", "whole.png"),
    ] {
        refused(&folder, &["compare", a, b, "-o", "difference.png"]);
    }
    for limit in ["nan", "inf", "-1"] {
        let option = format!("--max-diff={limit}");
        refused(&folder, &["compare", "whole.png", "whole.png", &option]);
    }
}

#[test]
fn options_that_do_not_exist() {
    let folder = Folder::new();
    for arguments in [
        &["fly"][..],
        &["render", "--engine", "quick"],
        &["render", "--repeat", "0"],
        &["render", "--sample", "99999999999"],
        &["explain", "flight"],
        &["compare", "a.png"],
        &["plan", "--sice", "8x8"],
    ] {
        let output = folder.run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty(), "{arguments:?}");
    }
    assert!(folder.names().is_empty());
}
