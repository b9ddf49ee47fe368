//! What `render` says of errors: the sample, the worst pixel, every kind of disagreement.

use terraline::sink::npz::Npz;

use super::{Folder, write_map};

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
fn buffers_hold_errors_and_cycles_where_they_are_asked_for() {
    let folder = Folder::new();
    // Steps of a cell lose ridges.
    let scene = ["render", "overview", "--size", "120x100", "--set", "stepper.fineness=0"];
    let render = |more: &[&str]| folder.json(&[&scene[..], more].concat());
    let array = |file: &str, name: &str| {
        let mut npz = Npz::open(&folder.path(file)).expect("buffers");
        npz.array(name).and_then(|array| array.read_all()).expect("an array")
    };
    let processor = ["--engine", "processor", "--with", "error,cycles"];
    let files = ["--buffers", "processor.npz", "-o", "with.png", "--sample", "all"];
    let summary = render(&[&processor[..], &files].concat());

    let (errors, found) = (array("processor.npz", "error_px"), &summary["errors"]);
    let count = |is: fn(&f64) -> bool| errors.iter().filter(|error| is(error)).count();
    assert_eq!(errors.len(), 120 * 100);
    assert_eq!(found["lost"]["total"], count(|error| error.is_infinite()));
    assert_eq!(found["reference"], count(|error| !error.is_nan()));
    assert!(count(|error| error.is_nan()) > 0 && count(|error| error.is_infinite()) > 0);
    let finite = errors.iter().copied().filter(|error| error.is_finite());
    assert_eq!(found["total_px"]["max"], finite.fold(0.0, f64::max));
    let at = |axis: &str| summary["worst"][axis].as_u64().expect("a pixel") as usize;
    assert!(errors[at("line") * 120 + at("column")].is_infinite(), "{}", summary["worst"]);

    let cycles = array("processor.npz", "cycles");
    assert_eq!(summary["cycles"].as_f64(), Some(cycles.iter().sum()));
    assert!(cycles.iter().any(|&one| one != cycles[1]), "they are no mean");

    // The same errors whoever draws the frame, whatever else is measured and drawn.
    let fast = ["--with", "error", "--buffers", "fast.npz", "--sample", "0"];
    render(&[&fast[..], &["--picture", "error", "-o", "errors.png"]].concat());
    render(&["--buffers", "plain.npz", "-o", "without.png", "--sample", "0"]);
    render(&["--picture", "error", "-o", "errors-alone.png", "--sample", "0"]);
    let bits = |errors: Vec<f64>| errors.into_iter().map(f64::to_bits).collect::<Vec<_>>();
    assert_eq!(bits(array("fast.npz", "error_px")), bits(errors));
    assert_eq!(folder.read("with.png"), folder.read("without.png"));
    assert_eq!(folder.read("errors.png"), folder.read("errors-alone.png"));

    // Comparing names them, and counts none that was not asked for.
    let text = folder.prints(&["compare", "processor.npz", "plain.npz", "--max-diff", "0"]);
    for name in ["trials", "error_px", "cycles"] {
        assert!(
            text.contains(&format!("{name}: only in the first, which no --max-diff")),
            "{text}"
        );
    }
    let text = folder.prints(&["compare", "processor.npz", "fast.npz", "--max-diff", "0"]);
    assert!(text.contains("error_px: identical, 12000 elements"), "{text}");
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

#[test]
fn relief_of_a_few_last_bits_is_told() {
    let folder = Folder::new();
    // Heights span 218 units of the map: 2 and 200 000 last bits of Q12.20.
    let cautions = |command: &str, scale: &str| {
        let scale = format!("surface.height.scale={scale}");
        let arguments = [command, "overview", "--set", &scale, "--size", "40x30"];
        let (json, text) = (folder.json(&arguments), folder.prints(&arguments));
        let told = json["cautions"].as_array().expect("a list").clone();
        for caution in &told {
            assert!(text.contains(&format!("  caution   {}", caution.as_str().unwrap())), "{text}");
        }
        assert_eq!(text.matches("  caution ").count(), told.len(), "{text}");
        told
    };
    for command in ["render", "plan"] {
        let told = cautions(command, "1e-8");
        assert!(
            told.len() == 1 && told[0].to_string().contains("last bits of register"),
            "{told:?}"
        );
        assert!(cautions(command, "1e-3").is_empty());
        assert!(cautions(command, "0.025").is_empty());
    }
}

#[test]
fn an_eye_at_the_ground_is_told() {
    let folder = Folder::new();
    let ground = 3.0;
    write_map(&folder.path("flat.png"), 20, 20, |i, j| if i + j == 0 { 30 } else { 3 });
    let scene = |y: f64| {
        format!(
            "[camera]\nposition = [9.5, {y:?}, 9.5]\nheading = 0.0\n[[screen]]\nsize = [40, 30]\n\
             [[surface]]\nmap = \"flat.png\"\nheight = {{ offset = 0.0, scale = 1.0 }}\n"
        )
    };
    let cautions = |up: f64| {
        folder.write("near.toml", scene(ground + up));
        folder.json(&["render", "near.toml"])["cautions"].as_array().expect("a list").clone()
    };
    assert!(cautions(1.0).is_empty());
    for up in [0.0, 1e-6] {
        let told = cautions(up);
        assert!(told.len() == 1 && told[0].to_string().contains("above the ground"), "{told:?}");
    }
    // The refusal's two numbers differ, and an eye at the second is not refused.
    folder.write("under.toml", scene(ground - 2e-6));
    let output = folder.run(&["render", "under.toml"]);
    assert_eq!(output.status.code(), Some(2));
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    let after = |words: &str| -> f64 {
        let rest = stderr.split_once(words).expect(words).1;
        let end = rest.find([',', ':', '\n']).expect("an end");
        rest[..end].trim().parse().unwrap_or_else(|_| panic!("{words}: {stderr}"))
    };
    assert!(after("at height ") < after("under it at "), "{stderr}");
    folder.write("raised.toml", scene(after("raise y above ")));
    folder.prints(&["render", "raised.toml"]);
}
