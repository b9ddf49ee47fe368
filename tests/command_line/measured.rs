//! What `render` says of errors: the sample, the worst pixel, every kind of disagreement.

use super::Folder;

#[test]
fn a_sample_says_what_it_cannot_show() {
    let folder = Folder::new();
    let render = |more: &[&str]| {
        let arguments = [&["render", "overview", "--size", "200x200"], more].concat();
        (folder.prints(&arguments), folder.json(&arguments))
    };
    let (text, json) = render(&["--sample", "8"]);
    assert!(text.contains("a random grid of 8 lines x 8 columns"), "{text}");
    assert!(text.contains("rarer than 1 in 64 pixels"), "{text}");
    let suspects = &json["errors"]["suspects"];
    let count = |field: &str| suspects[field].as_u64().expect("a number");
    assert_eq!(count("pixels"), count("rims") + count("far"));
    assert!(count("pixels") > 300 && count("pixels") <= 6 * 64, "{suspects}");

    // The command that it offers measures every pixel, and says no more of samples.
    let command = text.lines().find_map(|line| line.split_once("every pixel: terraline "));
    let words: Vec<&str> = command.expect("a command").1.split_whitespace().collect();
    let whole = folder.prints(&words);
    assert!(whole.contains("on all 40000 pixels"), "{whole}");
    assert!(!whole.contains("unseen") && !whole.contains("suspects"), "{whole}");
    let (_, json) = render(&["--sample", "all"]);
    assert_eq!(json["errors"]["pixels"], 200 * 200);
    assert!(json["errors"]["suspects"].is_null());

    for wrong in ["some", "-1", "4097"] {
        let output = folder.run(&["render", "overview", "--sample", wrong]);
        assert_eq!(output.status.code(), Some(2), "{wrong}");
    }
    let huge = folder.run(&["render", "overview", "--size", "8192x8192", "--sample", "all"]);
    assert_eq!(huge.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&huge.stderr).contains("--sample 1024"));
}

#[test]
fn worst_is_a_lost_pixel_or_an_overflow_where_there_is_one() {
    let folder = Folder::new();
    let worst = |scene: &[&str]| {
        let arguments = [&["render"], scene, &["--sample", "all"]].concat();
        let json = folder.json(&arguments);
        let text = folder.prints(&arguments);
        let worst = json["worst"].clone();
        let line = text.lines().find(|line| line.contains("  worst ")).expect("a line");
        assert!(line.contains(worst["why"].as_str().expect("a reason")), "{line}");
        (worst, json["errors"].clone())
    };
    // Steps of a cell lose ridges.
    let coarse = ["overview", "--size", "200x200", "--set", "stepper.fineness=0"];
    let (lost, errors) = worst(&coarse);
    assert!(errors["lost"]["total"].as_u64() > Some(10), "{errors}");
    assert!(lost["error_px"].is_null() && lost["why"].as_str().unwrap().starts_with("lost"));
    // The first pixel that overflows, where no lost one is known.
    let narrow =
        ["render", "overview", "--size", "48x36", "--format", "ground=9.20", "--sample", "0"];
    let json = folder.json(&narrow);
    let (over, first) = (&json["worst"], &json["overflows"][0]);
    assert_eq!(over["why"], "ground_x overflows");
    assert_eq!((&over["line"], &over["column"]), (&first["line"], &first["column"]));
    let (plain, errors) = worst(&["plane", "--size", "60x40", "--set", "camera.pitch=-40"]);
    assert_eq!(errors["lost"]["total"], 0);
    assert!(plain["error_px"].is_number() && plain["why"].as_str().unwrap().contains("off"));
}

#[test]
fn flips_are_told() {
    let folder = Folder::new();
    let horizon = ["render", "plane", "--size", "64x49", "--set", "camera.pitch=0"];
    let all = [&horizon[..], &["--sample", "all"]].concat();
    let text = folder.prints(&all);
    assert!(text.contains("  flips     64 (64 out of range) of all pixels"), "{text}");
    let flips = folder.json(&all)["errors"]["flips"].clone();
    assert_eq!((&flips["total"], &flips["out_of_range"]), (&64.into(), &64.into()));
}

#[test]
fn endings_say_what_is_written() {
    let folder = Folder::new();
    folder.prints(&["render", "plane", "--size", "8x6", "-o", "a.PNG", "--sample", "0"]);
    folder.prints(&["render", "plane", "--size", "8x6", "-o", "bare", "--sample", "0"]);
    let before = folder.names();
    let render = ["render", "plane", "--size", "8x6", "--sample", "0"];
    for (arguments, remedy) in [
        (&[&render[..], &["-o", "a.jpg"]].concat()[..], "give --output a.png"),
        (&[&render[..], &["-o", "a.png", "--buffers", "b.npy"]].concat(), "give --buffers b.npz"),
        (&[&render[..], &["--scene-out", "c.json"]].concat(), "give --scene-out c.toml"),
        (&["compare", "a.PNG", "bare", "-o", "d.bmp"], "give --output d.png"),
    ] {
        let output = folder.run(arguments);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {stderr}");
        assert!(stderr.contains(remedy) && stderr.lines().count() == 1, "{stderr}");
        assert_eq!(folder.names(), before, "{arguments:?}");
    }
}
