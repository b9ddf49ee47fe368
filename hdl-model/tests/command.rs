//! The command as its user meets it.
#![cfg(rtl)]

use std::process::{Command, Output};

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_terraline-hdl"))
        .args(arguments)
        .output()
        .expect("the command runs")
}

fn refused(arguments: &[&str], parts: &[&str]) {
    let output = run(arguments);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    for part in parts {
        assert!(message.contains(part), "{arguments:?}: `{part}` is not in: {message}");
    }
}

#[test]
fn cosim_reports_equality_and_cycles() {
    let output = run(&["cosim", "valley", "--size", "24x16", "--busy", "90", "--json"]);
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    assert_eq!(output.status.code(), Some(0), "{text}");
    for part in [r#""command":"cosim""#, r#""equal":true"#, r#""pixels":384"#, r#""differences":0"#]
    {
        assert!(text.contains(part), "`{part}` is not in: {text}");
    }
    let number = |key: &str| -> u64 {
        let rest = text.split_once(&format!("\"{key}\":")).expect("the key").1;
        rest.split([',', '}']).next().and_then(|digits| digits.parse().ok()).expect("a number")
    };
    assert_eq!(number("cycles"), number("emulator_cycles"));
    assert!(number("cycles") > 384);
}

#[test]
fn a_trace_is_small_and_has_a_save_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let trace = |name: &str, pixels: &str| {
        let path = folder.path().join(name);
        let file = path.to_str().expect("UTF-8");
        let output =
            run(&["cosim", "plane", "--size", "32x24", "--trace", file, "--trace-pixels", pixels]);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let waves = std::fs::read_to_string(path.with_extension("gtkw")).expect("a save file");
        assert!(waves.contains("[fpshift_count] 30\nTOP.terraline.view_x[31:0]"), "{waves}");
        std::fs::metadata(&path).expect("a trace").len()
    };
    let (few, all) = (trace("few.fst", "400..420"), trace("all.fst", "0..768"));
    assert!(few > 0 && 2 * few < all, "{few} and {all} bytes");
}

#[test]
fn bad_input_is_refused() {
    refused(&["cosim", "nowhere"], &["nowhere"]);
    refused(
        &["cosim", "overview", "--set", "surface.outside=wrap"],
        &["surface.outside", "use sky"],
    );
    refused(&["cosim", "overview", "--format", "ground=24.8"], &["format", "stock words"]);
    refused(&["cosim", "plane", "--full"], &["--full"]);
    refused(
        &["cosim", "overview", "--set", "machine.ratio=serial", "--set", "machine.words=wide"],
        &["machine.ratio", "use array"],
    );
    let far = ["cosim", "plane", "--size", "8x8", "--trace", "x.fst", "--trace-pixels", "60..70"];
    refused(&far, &["--trace-pixels", "8 lines of 8 pixels"]);
    refused(&["cosim", "plane", "--trace", "no/such/folder/x.fst"], &["folder does not exist"]);
    refused(&["cosim", "plane", "--trace-lines", "0..1"], &["--trace"]);
}
