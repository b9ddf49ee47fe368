//! Scenes from files and from options, drawn by the program.

use super::{Folder, write_map};

const SMALL: [&str; 4] = ["--size", "40x30", "--sample", "4"];

fn draw(folder: &Folder, scene: &str, name: &str, more: &[&str]) -> Vec<u8> {
    let picture = format!("{name}.png");
    let options = [&["render", scene, "-o", &picture], &SMALL[..], more].concat();
    folder.prints(&options);
    folder.read(&picture)
}

#[test]
fn printed_scenes_render_as_they_are() {
    let folder = Folder::new();
    for name in ["overview", "flight", "valley", "plane"] {
        let text = folder.prints(&["scenes", name]);
        let file = format!("my-{name}.toml");
        folder.write(&file, text);
        let built_in = draw(&folder, name, "built-in", &["--buffers", "built-in.npz"]);
        let from_file = draw(&folder, &file, "from-file", &["--buffers", "from-file.npz"]);
        assert_eq!(built_in, from_file, "{name}");
        folder.prints(&["compare", "built-in.npz", "from-file.npz", "--max-diff", "0"]);
        let object = folder.json(&["scenes", name]);
        assert!(object["scenes"].is_null() && object["name"] == name);
    }
    let listed = folder.json(&["scenes"]);
    assert_eq!(listed["scenes"].as_array().unwrap().len(), 4);
    assert!(listed["maps"][0]["description"].as_str().unwrap().contains("@N"));
    let text = folder.prints(&["scenes"]);
    assert!(text.lines().count() == 6 && text.contains("builtin:jacksboro"), "{text}");
}

#[test]
fn the_default_scene_is_the_overview() {
    let folder = Folder::new();
    folder.prints(&[&["render", "-o", "default.png"], &SMALL[..]].concat());
    assert_eq!(folder.read("default.png"), draw(&folder, "overview", "overview", &[]));
}

#[test]
fn whole_turns_change_nothing() {
    let folder = Folder::new();
    for scene in ["plane", "flight"] {
        let set = |heading: &str, pitch: &str, roll: &str| {
            [("heading", heading), ("pitch", pitch), ("roll", roll)]
                .map(|(name, degrees)| format!("camera.{name}={degrees}"))
        };
        let drawn = |sets: [String; 3]| {
            let options: Vec<&str> = sets.iter().flat_map(|set| ["--set", set.as_str()]).collect();
            draw(&folder, scene, "turned", &options)
        };
        let reduced = drawn(set("30", "-20", "10.5"));
        assert_eq!(reduced, drawn(set("7230", "-20", "10.5")), "{scene}");
        assert_eq!(reduced, drawn(set("30", "-7220", "10.5")), "{scene}");
        assert_eq!(reduced, drawn(set("-7170", "340", "-7189.5")), "{scene}");
        assert_eq!(reduced, drawn(set("360000000030", "3600000000340.0", "10.5")), "{scene}");
        assert_ne!(reduced, drawn(set("30", "-20", "11")), "{scene}");
    }
}

/// A scene over a map of its own, seen from high above.
fn scene_over(map: &str, outside: &str) -> String {
    format!(
        "[camera]\nposition = [3.0, 20.0, 3.0]\nforward = [0.1, -1.0, 0.2]\n\
         [[screen]]\nsize = [40, 30]\n\
         [[surface]]\nmap = \"{map}\"\noutside = \"{outside}\"\n\
         height = {{ offset = 0.0, scale = 0.001 }}\n"
    )
}

#[test]
fn small_and_constant_maps_are_drawn() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("maps")).unwrap();
    for (columns, rows) in [(1, 1), (1, 7), (7, 1), (2, 2), (9, 5)] {
        for constant in [true, false] {
            let height = |i, j| if constant { 1500 } else { (i * 700 + j * 300) as u16 };
            write_map(&folder.path("maps/map.png"), columns, rows, height);
            for outside in ["sky", "clamp", "wrap"] {
                // Maps are found from the folder of the scene file.
                folder.write("maps/scene.toml", scene_over("map.png", outside));
                let what = format!("{columns}x{rows}, {outside}, constant {constant}");
                if outside == "sky" && columns.min(rows) < 2 {
                    let output = folder.run(&["render", "maps/scene.toml"]);
                    assert_eq!(output.status.code(), Some(2), "{what}");
                    continue;
                }
                let fast = draw(&folder, "maps/scene.toml", "fast", &[]);
                let engine = ["--engine", "processor"];
                assert_eq!(fast, draw(&folder, "maps/scene.toml", "slow", &engine), "{what}");
                let object = folder.json(&["render", "maps/scene.toml"]);
                let least = if outside == "sky" { 1 } else { 600 };
                assert!(object["hits"]["surface"].as_u64() >= Some(least), "{what}: {object}");
                assert_eq!(object["scene"], "scene");
            }
        }
    }
}

#[test]
fn formats_draw_coarse_frames() {
    let folder = Folder::new();
    let whole = draw(&folder, "flight", "whole", &[]);
    let coarse = ["--format", "ground=16.4", "--format", "weight=4.6:stochastic"];
    let fast = draw(&folder, "flight", "fast", &coarse);
    assert_ne!(whole, fast);
    let processor = [&coarse[..], &["--engine", "processor"]].concat();
    assert_eq!(fast, draw(&folder, "flight", "processor", &processor));
    let saturate = ["--format", "tone=10.4:nearest:saturate", "--engine", "processor"];
    draw(&folder, "flight", "saturated", &saturate);
    let buffers = |more: &[&str]| {
        draw(&folder, "flight", "buffers", &[&["--buffers", "all.npz"], more].concat());
        folder.read("all.npz")
    };
    let stock = buffers(&[]);
    assert!(stock == buffers(&["--format", "height=12.20"]), "the stock format is stock");
    assert!(stock == buffers(&["--format", "view_y=2.30"]), "the stock format is stock");
    assert!(stock != buffers(&["--format", "height=12.20:floor"]), "another rounding is not");
    let narrow = ["render", "flight", "--engine", "processor", "--format", "slope_x=4.4"];
    assert_eq!(folder.run(&narrow).status.code(), Some(2), "it follows another register");
}

#[test]
fn what_formats_do_not_hold_is_told() {
    let folder = Folder::new();
    let coarse = ["--format", "ground=24.8", "--size", "64x48"];
    let wide = ["--format", "ground=24.30", "--size", "64x48"];
    for command in ["render", "plan"] {
        let run = |formats: &[&str], json: &[&str]| {
            let output = folder.run(&[&[command, "flight"], formats, json].concat());
            assert_eq!(output.status.code(), Some(0), "{command} {formats:?}");
            String::from_utf8(output.stdout).unwrap()
        };
        let claim = "more than 1/32 (ground_x Q24.8)";
        let text = run(&coarse, &[]);
        let told: Vec<_> = text.lines().filter(|line| line.contains("not proved: ")).collect();
        assert!(told.len() == 1 && told[0].ends_with(claim), "{text}");
        assert!(text.lines().next().unwrap().contains("of 8388608 cells"), "{text}");
        let json: serde_json::Value = serde_json::from_str(&run(&coarse, &["--json"])).unwrap();
        let told = json["not_proved"].as_array().unwrap();
        assert!(told.len() == 1 && told[0].as_str().unwrap().ends_with(claim), "{json}");
        assert!(!run(&wide, &[]).contains("not proved"));
        let json: serde_json::Value = serde_json::from_str(&run(&wide, &["--json"])).unwrap();
        assert_eq!(json["not_proved"].as_array().unwrap().len(), 0);
    }
}

#[test]
fn overflows_are_located() {
    let folder = Folder::new();
    let overflows = |options: &[&str]| {
        let object = folder.json(&[&["render", "overview"], &SMALL[..], options].concat());
        object["overflows"].as_array().unwrap().clone()
    };
    assert!(overflows(&[]).is_empty());
    // 256 of the map's 344 columns and rows: its far corner is on both engines' frames.
    let coarse = ["--format", "ground=9.20", "--engine"];
    let found = overflows(&[&coarse[..], &["processor"]].concat());
    assert_eq!(found, overflows(&[&coarse[..], &["fast"]].concat()));
    let registers: Vec<_> = found.iter().map(|overflow| &overflow["register"]).collect();
    assert_eq!(registers, ["ground_x", "ground_z"]);
    for overflow in found {
        assert!((20..400).contains(&overflow["pixels"].as_u64().unwrap()), "{overflow}");
        // The first of them: the ground's left edge, seen below the sky.
        assert_eq!((&overflow["line"], &overflow["column"]), (&8.into(), &0.into()));
    }
}

#[test]
fn scenes_are_written_with_their_options() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("maps")).unwrap();
    std::fs::create_dir(folder.path("out")).unwrap();
    write_map(&folder.path("maps/map.png"), 20, 20, |i, j| (i * 700 + j * 300) as u16);
    folder.write(
        "maps/scene.toml",
        scene_over("map.png", "sky") + "\n[[screen]]\nname = \"left\"\nsize = [30, 20]\nfov = 20\n",
    );
    let formats = ["--format", "height=12.8:stochastic", "--set", "seed=7"];
    const OWN_MAP: [&str; 6] = [
        "--set",
        "surface.map=maps/map.png",
        "--set",
        "surface.height.scale=0.0005",
        "--set",
        "camera.position=[9, 20, -5]",
    ];
    for (scene, options) in [
        ("overview", &["--set", "camera.pitch=-31.7", "--set", "kernel.shape=hat"][..]),
        ("flight", &["--size", "50x30", "--set", "light.direction=[1, 2, 0.3]"]),
        ("plane", &["--set", "surface.checker=3.3", "--set", "camera.roll=12.1"]),
        ("valley", &formats),
        ("overview", &OWN_MAP),
        ("maps/scene.toml", &["--set", "camera.position=[3.0, 40.0, 4.1]"]),
        ("maps/scene.toml", &["--screen", "left"]),
    ] {
        let small: &[&str] = if scene.starts_with("maps") { &[] } else { &["--size", "64x48"] };
        let small = if options.contains(&"--size") { &[] } else { small };
        let out = ["-o", "a.png", "--sample", "0", "--scene-out", "out/written.toml"];
        folder.prints(&[&["render", scene], options, small, &out].concat());
        folder.prints(&["render", "out/written.toml", "--sample", "0", "-o", "b.png"]);
        assert_eq!(folder.read("a.png"), folder.read("b.png"), "{scene} {options:?}");
        folder.prints(&["render", scene, "--sample", "0", "-o", "plain.png", "--size", "64x48"]);
        assert_ne!(folder.read("a.png"), folder.read("plain.png"), "{scene} {options:?}");
    }
}

#[test]
fn heights_are_exaggerated_on_demand() {
    let folder = Folder::new();
    // The scene has 0.025 units per metre, of 80 m each: twice life size.
    let as_it_is = draw(&folder, "flight", "plain", &[]);
    assert!(as_it_is == draw(&folder, "flight", "twice", &["--exaggeration", "2"]));
    let flat = draw(&folder, "flight", "flat", &["--exaggeration", "1"]);
    assert!(flat == draw(&folder, "flight", "set", &["--set", "surface.height.scale=0.0125"]));
    assert!(flat != as_it_is);

    // A height file, whose camera is chosen for the heights as they are drawn.
    super::write_map(&folder.path("map.png"), 40, 30, |i, j| (i * j * 3) as u16);
    let args = ["render", "map.png", "--size", "64x48", "--scene-out", "out.toml"];
    folder.prints(&[&args[..], &["--exaggeration", "4"]].concat());
    let scene = String::from_utf8(folder.read("out.toml")).expect("text");
    // Cells of 30 m are assumed: 4/30.
    assert!(scene.contains("scale = 0.133333"), "{scene}");

    for (arguments, names) in [
        (&["plane", "--exaggeration", "2"][..], "no terrain"),
        (&["flight", "--exaggeration", "0"], "1 is life size"),
        (&["flight", "--exaggeration", "x"], "1 is life size"),
        (&["flight", "--exaggeration", "2", "--set", "surface.height.scale=1"], "one of the two"),
    ] {
        let output = folder.run(&[&["render"][..], arguments].concat());
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {stderr}");
        assert!(stderr.contains(names), "{arguments:?}: {stderr}");
    }
}

#[test]
fn pictures_of_errors_are_parted_and_ranged() {
    let folder = Folder::new();
    let error = |name: &str, more: &[&str]| {
        draw(&folder, "flight", name, &[&["--picture", "error"], more].concat())
    };
    let total = error("total", &[]);
    assert!(total == error("named", &["--error", "total"]));
    let algorithm = error("algorithm", &["--error", "algorithm"]);
    let quantisation = error("quantisation", &["--error", "quantisation"]);
    assert!(total != algorithm && algorithm != quantisation && total != quantisation);
    let arguments = ["render", "flight", "--picture", "error", "--range", "0.5", "--size", "64x48"];
    let output = folder.run(&[&arguments[..], &["-o", "ranged.png"]].concat());
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(stderr.contains("to 0.5"), "{stderr}");
    for (more, names) in [
        (&["--error", "total"][..], "--picture error"),
        (&["--range", "1"], "--picture error"),
        (&["--picture", "error", "--range", "0"], "above 0"),
    ] {
        let output = folder.run(&[&["render", "flight"][..], more].concat());
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{more:?}: {stderr}");
        assert!(stderr.contains(names), "{more:?}: {stderr}");
    }
}
