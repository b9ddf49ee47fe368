//! `vectors`: the folder appears whole or not at all.

use super::Folder;
use super::bad_input::refused;

fn files(folder: &Folder, name: &str) -> Vec<String> {
    let entries = std::fs::read_dir(folder.path(name)).expect("the folder");
    let name = |entry: std::fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
    let mut names: Vec<String> = entries.map(|entry| name(entry.expect("an entry"))).collect();
    names.sort();
    names
}

#[test]
fn vectors_are_a_folder_of_files() {
    let folder = Folder::new();
    let text = folder.prints(&["vectors", "plane", "-o", "plane", "--size", "64x48"]);
    for word in ["4 of 48 lines", "256 pixels", "256 corner cases", "kB", "docs/vectors.md"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    assert_eq!(
        files(&folder, "plane"),
        ["checker.mem", "cycles.mem", "divider.mem", "projector.mem", "projector_coefficients.mem"]
    );
    // The same command writes the same files.
    folder.prints(&["vectors", "plane", "-o", "again", "--size", "64x48"]);
    for file in files(&folder, "plane") {
        assert_eq!(
            folder.read(&format!("plane/{file}")),
            folder.read(&format!("again/{file}")),
            "{file}"
        );
    }
    let object = folder.json(&[
        "vectors",
        "valley",
        "-o",
        "valley",
        "--size",
        "32x24",
        "--random",
        "50",
        "--seed",
        "3",
        "--corner-cases",
        "10000",
    ]);
    assert_eq!(object["pixels"], 50);
    assert_eq!(object["corner_cases"], 10_000);
    let listed = object["files"].as_array().expect("files");
    assert_eq!(listed.len(), files(&folder, "valley").len());
    for file in listed {
        let name = file["file"].as_str().expect("a name");
        let bytes = folder.read(&format!("valley/{name}")).len() as u64;
        assert_eq!(file["bytes"], bytes, "{name}");
        if name == "stepper.mem" {
            assert_eq!(file["rows"], 10_050);
        }
    }
    assert_eq!(folder.names(), ["again", "plane", "valley"], "nothing else is left behind");
}

#[test]
fn vectors_that_cannot_be_written() {
    let folder = Folder::new();
    folder.write("file", "a text\n");
    std::fs::create_dir(folder.path("there")).expect("a folder");
    let vectors = |options: &[&str], words: &[&str]| {
        let small = ["vectors", "plane", "--size", "8x8"];
        let output = if options.contains(&"-o") { &[][..] } else { &["-o", "out"] };
        let message = refused(&folder, &[&small[..], output, options].concat());
        for word in words {
            assert!(message.contains(word), "{options:?}: no {word:?} in {message}");
        }
    };
    vectors(&["-o", "file"], &["file", "exists already", "remove"]);
    vectors(&["-o", "there"], &["there", "exists already"]);
    vectors(&["-o", "."], &["exists already"]);
    vectors(&["-o", "file/out"], &["file is not a folder"]);
    vectors(&["-o", "missing/out"], &["there is no folder missing", "create it"]);
    for lines in ["0", "3..3", "5..2", "0..9", "8..9", "x", "1..", "..", "-1", "4294967296", ""] {
        vectors(&[&format!("--lines={lines}")], &["--lines", "at most 8"]);
    }
    vectors(&["--format", "weight=12.12:stochastic"], &["weight", "stochastic", "nearest"]);
    vectors(&["--set", "camera.pich=3"], &["camera.pitch"]);
    let under = ["vectors", "valley", "-o", "out", "--set", "camera.position=[232.0, 1.0, 168.0]"];
    assert!(refused(&folder, &under).contains("camera.position"));
    for options in [
        &["--random", "0"][..],
        &["--corner-cases", "99999999999"],
        &["--lines", "2", "--random", "2"],
    ] {
        let output = folder.run(&[&["vectors", "plane", "-o", "out"], options].concat());
        assert_eq!(output.status.code(), Some(2), "{options:?}");
    }
    assert_eq!(folder.names(), ["file", "there"]);
}
