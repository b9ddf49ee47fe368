//! One clear message for everything a scene file can get wrong.

use terraline::scene::keys::sections;

use super::support::keys::{file_with, illegal};
use super::{assert_says, try_scene};

/// The text fails with a message that holds the words and, after them, a remedy.
#[track_caller]
pub(super) fn assert_fails(text: &str, words: &[&str]) {
    let error = try_scene(text, &[]).map(|_| ()).expect_err(text);
    assert_says(&error, &["my.toml, line ", ", column ", "; "]);
    assert_says(&error, words);
}

#[test]
fn syntax_errors() {
    assert_fails("unit_m = 1\n[camera\n", &["line 2", "not valid TOML", "terraline scenes"]);
    assert_fails("a = 1\na = 2", &["line 2", "duplicate"]);
    assert_fails("x = [1,\n\n", &["TOML"]);
    assert_fails(&"[".repeat(50_000), &["line 1"]);
}

#[test]
fn unknown_keys_suggest_the_nearest() {
    assert_fails(
        "\n\n[camera]\n  hedding = 3",
        &[
            "my.toml, line 4, column 3: camera.hedding: unknown key",
            "did you mean `camera.heading`?",
        ],
    );
    assert_fails("[camra]", &["line 1", "camra", "did you mean `camera`?"]);
    assert_fails("fov = 50", &["did you mean `screen.fov`?"]);
    assert_fails("[[screen]]\nsizes = [1, 1]", &["screen.sizes", "`screen.size`"]);
    assert_fails(
        "[[screen]]\nmount = { yaw = 1 }",
        &["screen.mount.yaw", "heading, pitch and roll"],
    );
    assert_fails("[[surface]]\nheight = { ofset = 1 }", &["line 2", "`surface.height.offset`"]);
    assert_fails("[[surface]]\nkind = \"plane\"\nmap = \"a.png\"", &["line 3", "surface.map"]);
    assert_fails("[format]\nview = { with = 3 }", &["format.view.with", "width"]);
    assert_fails(
        "[format]\ngrund = { width = 32, point = 8 }",
        &["line 2, column 9: format.grund: no register or class", "did you mean `ground`?"],
    );
    assert_fails("[format]\nqqqq = 3", &["format.qqqq", "view, ground, height, weight and tone"]);
    assert_fails(
        "[format]\nsurface = { width = 32, point = 8 }",
        &["format.surface: this register has the format of node", "set node instead"],
    );
    for table in ["kernel", "stepper", "light", "color", "machine"] {
        assert_fails(&format!("[{table}]\nzzz = 1"), &["line 2", &format!("{table}.zzz")]);
    }
}

#[test]
fn every_key_refuses_what_it_does_not_take() {
    for section in sections() {
        for key in &section.keys {
            let path = format!("{}.{}", section.path, key.name).replace("NAME", "view");
            let path = path.trim_start_matches('.');
            for bad in illegal(&key.kind) {
                assert_fails(&file_with(&section, key, &bad), &["line 2", path]);
            }
        }
    }
}

#[test]
fn vectors_are_refused_at_the_element() {
    for bad in ["nan", "inf", "\"1\""] {
        let text = format!("\ncamera.position = [1.0,\n 2.0,\n {bad}]");
        assert_fails(&text, &["line 4, column 2", "camera.position", "three numbers"]);
    }
}

#[test]
fn values_out_of_range() {
    for (line, words) in [
        ("light.direction = [0, 0, 0]", ["light.direction", "not all 0"]),
        ("camera.forward = [0, 0, 0]", ["camera.forward", "not all 0"]),
        ("camera.forward = [0, -3, 0]", ["parallel", "camera.up"]),
        ("camera.up = [0, 1, 0]", ["camera.up", "camera.forward"]),
        ("camera.position = [0, 1.1e9, 0]", ["too far away", "1e9"]),
        ("machine.memory_latency = 65", ["found 65", "from 1 to 64"]),
        ("machine.words = \"narow\"", ["narow", "did you mean \"narrow\"?"]),
        ("stepper.halvings = \"feet\"", ["footprint", "from 0 to 20"]),
        ("stepper.mode = \"thesis\"", ["not built yet", "skipping"]),
        ("stepper.mode = \"plane\"", ["stepper.mode", "did you mean \"plain\"?"]),
        ("kernel.table = 100", ["not a power of two", "64 or 128"]),
        ("kernel.deformation = 1.0", ["kernel.deformation", "whole number"]),
        ("kernel.shape = \"cosin\"", ["kernel.shape", "did you mean \"cosine\"?"]),
        ("color.ramp = [[0, 0, 0]]", ["array of 1 value", "2 to 16"]),
        ("color.ramp = [[0, 0, 0], [0, 256, 0]]", ["color.ramp.1", "0 to 255"]),
        ("format.view = 3", ["format.view", "table"]),
        ("format.view = { width = 8 }", ["`point` is missing", "width and point"]),
        ("format.view = { width = 8, point = 9 }", ["format.view.point", "from 0 to 8"]),
        ("screen = []", ["screen", "[[screen]]"]),
        ("screen = { fov = 3 }", ["screen", "[[screen]]"]),
        ("surface = []", ["surface", "[[surface]]"]),
        ("surface = [{}, {}]", ["surface.1", "not built yet"]),
        ("camera = 3", ["camera", "table"]),
    ] {
        assert_fails(&format!("\n{line}"), &["line 2"]);
        assert_fails(&format!("\n{line}"), &words);
    }
    for (line, words) in [
        ("size = [16384, 16384]", ["268435456 pixels", "67108864"]),
        ("size = [4.5, 4]", ["found 4.5", "whole number"]),
        ("fov = 0", ["screen.fov", "above 0"]),
        ("fov = 175.5", ["screen.fov", "to 175"]),
        // In radians these would be no angle any more.
        ("fov = 5e-324", ["screen.fov", "from 1e-9"]),
        ("name = \"../x\"", ["screen.name", "without slashes"]),
        ("distance = 1", ["screen.distance", "pixel"]),
        ("pixel = [1, 1]", ["screen.pixel", "distance"]),
    ] {
        assert_fails(&format!("[[screen]]\n{line}"), &["line 2", words[0], words[1]]);
    }
    for (line, words) in [
        ("kind = \"sphere\"", ["surface.kind", "not built yet"]),
        ("kind = \"facets\"", ["surface.kind", "not built yet"]),
        ("kind = \"terain\"", ["surface.kind", "did you mean \"terrain\"?"]),
        ("cell = [1e8, 1]", ["surface.cell", "smaller cells"]),
        ("height = { scale = 1e9 }", ["surface.height", "smaller height.scale"]),
        ("height = { offset = 900, scale = 2e6 }", ["surface.height", "heights reach"]),
        ("outside = \"clmp\"", ["surface.outside", "did you mean \"clamp\"?"]),
        ("nodata = \"fill\"", ["surface.nodata", "nearest"]),
        ("map = \"\"", ["surface.map", "builtin:jacksboro"]),
        ("map = \"builtin:jaksboro\"", ["no such map", "builtin:jacksboro"]),
        (
            "map = \"no/such.png\"",
            ["surface.map: no/such.png: there is no such file", "check the name"],
        ),
    ] {
        assert_fails(&format!("[[surface]]\n{line}"), &["line 2", words[0], words[1]]);
    }
}

#[test]
fn odd_names_stay_on_one_line() {
    for (text, word) in [
        ("[format]\n\"a\\nb\" = 3", "format.a\\nb"),
        ("\"a\\nb\" = 3", "`a\\nb`"),
        ("[[surface]]\nmap = \"a\\nb.asc\"", "a\\nb.asc: there is no such file"),
        (
            "[[surface]]\nmap = \"builtin:\\u0085jacksboro\"",
            "builtin:\\u{85}jacksboro: the program has",
        ),
        (
            "[[surface]]\nmap = \"builtin:a\\nb\"\nencoding = \"terrarium\"",
            "builtin:a\\nb: maps of the program",
        ),
    ] {
        assert_fails(text, &[word]);
    }
    let error = try_scene("", &["format.a\nb=3"]).unwrap_err();
    assert_says(&error, &["--set format.a\\nb: no register or class has this name"]);
}

#[test]
fn the_same_thing_said_twice() {
    let text = "[camera]\nheading = 3\n\nforward = [1, 0, 0]";
    assert_fails(text, &["line 4", "camera.forward", "`camera.heading` (line 2)", "keep either"]);
    let text = "[camera]\nup = [0, 1, 0]\nroll = 3";
    assert_fails(text, &["line 3", "camera.roll", "`camera.up` (line 2)"]);
    let text = "[[screen]]\nfov = 3\ndistance = 3\npixel = [1, 1]";
    assert_fails(text, &["line 3", "screen.distance", "`screen.fov` (line 2)", "keep either"]);
    let text = "[[screen]]\n[[screen]]\nfov = 3";
    assert_fails(text, &["line 2", "screen.1.name", "\"front\"", "name of its own"]);
    let text = "[[screen]]\nname = \"a\"\n[[screen]]\nname = \"a\"";
    assert_fails(text, &["line 4", "screen.1.name"]);
}
