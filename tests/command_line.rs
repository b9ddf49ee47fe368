//! The program itself: what it writes, what it prints, and how it ends.

#[path = "command_line/bad_input.rs"]
mod bad_input;
#[path = "command_line/height_files.rs"]
mod height_files;
#[path = "command_line/json_page.rs"]
mod json_page;
#[path = "command_line/measured.rs"]
mod measured;
#[path = "command_line/scenes.rs"]
mod scenes;
#[path = "command_line/vectors.rs"]
mod vectors;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

/// A folder of its own to run the program in.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.path(name), bytes).expect("a file");
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Names of all files, sorted.
    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("a readable folder");
        let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
        let mut names: Vec<String> = entries.map(|entry| name(entry.expect("an entry"))).collect();
        names.sort();
        names
    }

    /// Runs the program here.
    fn run(&self, arguments: &[&str]) -> Output {
        let output = Command::new(env!("CARGO_BIN_EXE_terraline"))
            .current_dir(self.0.path())
            .args(arguments)
            .output()
            .expect("the program starts");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(!stderr.contains("panicked"), "{arguments:?}: {stderr}");
        output
    }

    /// Runs it, which must succeed, and returns what it prints.
    #[track_caller]
    fn prints(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {stderr}");
        String::from_utf8(output.stdout).expect("text")
    }

    /// Runs it with `--json`: one object with the fields of every command.
    #[track_caller]
    fn json(&self, arguments: &[&str]) -> Value {
        let text = self.prints(&[arguments, &["--json"]].concat());
        let object: Value = serde_json::from_str(&text).expect("one JSON value on stdout");
        assert_eq!(object["schema"], 3);
        assert_eq!(object["command"], arguments[0]);
        assert_eq!(object["version"], env!("CARGO_PKG_VERSION"));
        object
    }

    /// The size of a picture.
    fn size(&self, name: &str) -> (u32, u32) {
        image::image_dimensions(self.path(name)).expect("a picture")
    }
}

fn fraction(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is a number"))
}

#[test]
fn without_a_command_it_says_what_to_try() {
    let folder = Folder::new();
    let text = folder.prints(&[]);
    for word in
        ["terraline view", "terraline render", "terraline explain", "terraline scenes", "--help"]
    {
        assert!(text.contains(word), "{text}");
    }
    assert!(folder.names().is_empty());
}

#[test]
fn every_command_explains_itself() {
    let folder = Folder::new();
    for command in
        ["view", "render", "explain", "plan", "cycles", "vectors", "compare", "scenes", "info"]
    {
        let text = folder.prints(&[command, "--help"]);
        assert!(text.contains(&format!("Example: terraline {command}")), "{text}");
    }
    assert!(folder.prints(&["--version"]).contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn render_writes_a_picture_of_the_size_asked_for() {
    let folder = Folder::new();
    for size in [(64, 48), (37, 23), (1, 1), (1, 40), (50, 1)] {
        let text = format!("{}x{}", size.0, size.1);
        for scene in ["overview", "flight", "valley", "plane"] {
            folder.prints(&["render", scene, "-o", "out.png", "--size", &text]);
            assert_eq!(folder.size("out.png"), size, "{scene}");
        }
    }
    // An existing file is replaced, nothing else is left behind.
    assert_eq!(folder.names(), ["out.png"]);
}

#[test]
fn all_engines_and_pictures_are_drawn() {
    let folder = Folder::new();
    for engine in ["processor", "fast", "real", "oracle"] {
        for picture in ["color", "height", "normal", "steps", "error"] {
            let name = format!("{engine}-{picture}.png");
            let engine = ["--engine", engine, "--picture", picture, "-o", &name];
            folder.prints(&[&["render", "flight", "--size", "24x18"], &engine[..]].concat());
            assert_eq!(folder.size(&name), (24, 18));
        }
    }
    folder.prints(&[
        "render",
        "plane",
        "--size",
        "24x18",
        "--engine",
        "processor",
        "--picture",
        "cycles",
        "-o",
        "cycles.png",
    ]);
    assert_eq!(folder.size("cycles.png"), (24, 18));
    // One answer: two engines, one picture.
    assert_eq!(folder.read("processor-color.png"), folder.read("fast-color.png"));
    assert_eq!(folder.read("processor-steps.png"), folder.read("fast-steps.png"));
}

#[test]
fn render_reports_in_json() {
    let folder = Folder::new();
    let small = ["--size", "48x36", "--sample", "16"];
    for engine in ["fast", "processor", "real", "oracle"] {
        let options = [&["render", "flight", "--engine", engine, "--repeat", "3"], &small[..]];
        let object = folder.json(&options.concat());
        assert_eq!(object["scene"], "flight");
        assert_eq!(object["engine"], engine);
        assert_eq!((&object["columns"], &object["lines"]), (&48.into(), &36.into()));
        let ms = |name| fraction(&object["frame_ms"][name]);
        assert!(0.0 < ms("min") && ms("min") <= ms("median") && ms("median") <= ms("max"));
        assert_eq!(object["frame_ms"]["runs"], 3);
        assert!(fraction(&object["setup_ms"]) >= 0.0);
        let hits = object["hits"].as_object().expect("hits");
        assert_eq!(hits.values().map(|count| count.as_u64().unwrap()).sum::<u64>(), 48 * 36);
        assert!(hits["surface"].as_u64() > Some(400));
        for counted in ["cycles", "additions"] {
            assert!(object[counted].as_u64() > Some(48 * 36), "{counted}: {}", object[counted]);
        }
        if engine == "fast" || engine == "processor" {
            let errors = &object["errors"];
            assert!(errors["same_sheet"].as_u64() > Some(50), "{errors}");
            for kind in ["total", "algorithm", "quantisation"] {
                assert!(fraction(&errors[format!("{kind}_px")]["p999"]) < 0.25, "{errors}");
                assert!(fraction(&errors[format!("{kind}_m")]["max"]) > 0.0, "{errors}");
            }
            let explain = object["worst"]["explain"].as_str().expect("a command");
            let words: Vec<&str> = explain.split_whitespace().skip(1).collect();
            assert!(folder.prints(&words).contains("flight"), "{explain}");
        } else {
            assert!(object["errors"].is_null());
        }
    }
    let without = folder.json(&["render", "plane", "--size", "8x8", "--sample", "0"]);
    assert!(without["errors"].is_null());
    assert!(folder.names().is_empty());
}

#[test]
fn cycles_are_the_same_by_every_way() {
    let folder = Folder::new();
    let size = ["--size", "40x30"];
    let render = ["render", "valley", "--engine", "processor"];
    let cycles = folder.json(&[&["cycles", "valley"], &size[..]].concat());
    let rendered = folder.json(&[&render[..], &size].concat());
    assert_eq!(cycles["cycles"], rendered["cycles"]);
    assert_eq!(cycles["additions"], rendered["additions"]);
    assert!(fraction(&cycles["modelled_fps"]) > 0.0);
    let names: Vec<&str> =
        cycles["units"].as_array().unwrap().iter().map(|u| u["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"projector") && names.contains(&"stepper"), "{names:?}");
}

#[test]
fn plan_reports_units_in_json() {
    let folder = Folder::new();
    let fitted = |object: &Value| {
        let units = object["units"].as_array().expect("units").clone();
        assert!(units.iter().all(|unit| !unit["why"].as_str().unwrap().is_empty()));
        units.iter().filter(|unit| unit["fitted"].as_bool().unwrap()).count()
    };
    for scene in ["overview", "flight", "valley", "plane"] {
        let object = folder.json(&["plan", scene]);
        assert_eq!(object["scene"], scene);
        let full = folder.json(&["plan", scene, "--full"]);
        assert!(fitted(&object) < fitted(&full), "{scene}");
        let names = |o: &Value| -> Vec<Value> {
            o["units"].as_array().unwrap().iter().map(|unit| unit["name"].clone()).collect()
        };
        assert_eq!(names(&object), names(&full));
        assert!(!folder.prints(&["plan", scene]).is_empty());
    }
}

#[test]
fn explain_reports_rows_in_json() {
    let folder = Folder::new();
    for (scene, pixel) in [("overview", "400,700"), ("plane", "10,900"), ("valley", "0,0")] {
        let object = folder.json(&["explain", scene, "--pixel", pixel]);
        let rows = object["rows"].as_array().expect("rows");
        let mut bounded = 0;
        for row in rows {
            assert!(row["register"].is_string() && row["value"].is_number(), "{row}");
            if let (Some(error), Some(bound)) = (row["error"].as_f64(), row["bound"].as_f64()) {
                assert!(error.abs() <= bound && row["beyond_bound"] == false, "{row}");
                bounded += 1;
            }
        }
        assert!(bounded >= 3, "{scene}: {bounded} of {} rows have a bound", rows.len());
        let text = folder.prints(&["explain", scene, "--pixel", pixel]);
        assert!(text.contains("view_x"), "{text}");
    }
}

#[test]
fn explain_marks_what_is_beyond_its_bound() {
    let folder = Folder::new();
    // 256 of the map's 344 columns and rows: positions wrap in the far corner.
    let narrow =
        ["explain", "overview", "--size", "48x36", "--format", "ground=9.20", "--pixel", "0,10"];
    let (object, text) = (folder.json(&narrow), folder.prints(&narrow));
    let marked: Vec<&str> = object["rows"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|row| row["beyond_bound"] == true)
        .map(|row| row["what"].as_str().unwrap())
        .collect();
    assert!(!marked.is_empty(), "{text}");
    let told = format!("beyond their bounds (marked !): {}", marked.join(", "));
    assert!(text.contains(&told), "{told}: {text}");
    let marks = text.lines().filter(|line| line.contains(" ! ")).count();
    assert_eq!(marks, marked.len(), "{text}");

    // The powers of two of equations 6 and 9; an eye below the highest node divides nothing.
    let sound = ["explain", "overview", "--pixel", "400,700"];
    let (object, text) = (folder.json(&sound), folder.prints(&sound));
    assert!(!text.contains("beyond their bounds"), "{text}");
    let told = format!(
        "hold V 2^{} (equation 6), the denominator D 2^{} (equation 9)",
        object["view_exponent"], object["denominator_exponent"]
    );
    assert!(text.contains(&told), "{told}: {text}");
    let valley = folder.json(&["explain", "valley", "--pixel", "400,700"]);
    assert!(valley["denominator_exponent"].is_null() && valley["view_exponent"].is_number());
}

#[test]
fn compare_ends_by_what_it_finds() {
    let folder = Folder::new();
    let draw = |name: &str, engine: &str, more: &[&str]| {
        let buffers = format!("{name}.npz");
        let picture = format!("{name}.png");
        let options =
            ["render", "flight", "--size", "32x24", "-o", &picture, "--buffers", &buffers];
        folder.prints(&[&options[..], &["--engine", engine], more].concat());
    };
    draw("fast", "fast", &[]);
    draw("processor", "processor", &[]);
    draw("full", "processor", &["--full"]);
    draw("coarse", "processor", &["--format", "ground=16.4"]);
    let code = |arguments: &[&str]| folder.run(&[&["compare"], arguments].concat()).status.code();
    for kind in ["png", "npz"] {
        let names = ["fast", "processor", "full", "coarse"].map(|name| format!("{name}.{kind}"));
        let [fast, processor, full, coarse] = names.each_ref().map(String::as_str);
        assert_eq!(code(&[processor, full, "--max-diff", "0"]), Some(0));
        // The processor's buffers have one array more, `trials`: the fast engine has none.
        assert_eq!(code(&[processor, fast, "--max-diff", "0"]), Some(0));
        assert_eq!(code(&[processor, coarse]), Some(0));
        assert_eq!(code(&[processor, coarse, "--max-diff", "0"]), Some(1));
        // No picture differs by more, but a pixel that hits on one side only does.
        let far = if kind == "png" { 0 } else { 1 };
        assert_eq!(code(&[processor, coarse, "--max-diff", "1e9"]), Some(far), "{kind}");
        assert_eq!(code(&[processor, "missing.png", "--max-diff", "0"]), Some(2));
        assert_eq!(code(&[processor, coarse, "--max-diff", "-1"]), Some(2));
        let object = folder.json(&["compare", processor, coarse]);
        assert!(object["scene"].is_null() && object.as_object().unwrap().len() > 4, "{object}");
    }
    let why = folder.run(&["compare", "processor.npz", "coarse.npz", "--max-diff", "0"]);
    let why = String::from_utf8_lossy(&why.stderr).into_owned();
    assert!(why.starts_with("beyond --max-diff 0: ") && why.contains("ground_x"), "{why}");
    let drawn = folder.run(&["compare", "fast.png", "coarse.png", "-o", "difference.png"]);
    assert_eq!(drawn.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&drawn.stderr).contains("95 % lie within"));
    assert_eq!(folder.size("difference.png"), (32, 24));
    folder.prints(&["render", "flight", "--size", "24x32", "-o", "other.png"]);
    assert_eq!(code(&["fast.png", "other.png"]), Some(2), "pictures of other sizes");
    assert_eq!(code(&["fast.png", "fast.npz"]), Some(2), "a picture and buffers");
}

/// Whether a file was left in a folder that must stay as it was.
fn unchanged(folder: &Folder, before: &[String], arguments: &[&str]) {
    assert_eq!(folder.names(), before, "{arguments:?} leaves nothing behind");
}

/// The picture of a height map: 16-bit grey.
fn write_map(path: &Path, columns: u32, rows: u32, height: impl Fn(u32, u32) -> u16) {
    image::ImageBuffer::from_fn(columns, rows, |i, j| image::Luma([height(i, j)]))
        .save(path)
        .expect("a map");
}
