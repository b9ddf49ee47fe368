//! `--set` options: what they change, what they replace, and what is wrong with them.

use glam::{DVec2, DVec3};
use terraline::scene::{
    Angles, Attitude, Bisection, Extent, NoData, Outside, Scene, SceneError, Surface, load,
};

use super::{EVERY_TABLE, angles, assert_says, scene, terrain, try_scene};

fn set_over(name: &str, sets: &[&str]) -> Result<Scene, SceneError> {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    load(Some(name), &sets)
}

#[test]
fn options_override_the_file() {
    let sets = [
        "camera.position=[1,2,3]",
        "camera.heading=10",
        "screen.size=[64, 32]",
        "screen.1.size=[8,8]",
        "screen.1.fov=20",
        "surface.outside=clamp",
        "surface.0.nodata=\"nearest\"",
        "surface.height.offset = 5",
        "color.sky=[0,0,0]",
        "color.ramp.1=[9,9,9]",
        "format.height.width=20",
        "format.height={ width = 24, point = 3 }",
        "stepper.halvings=footprint",
        "seed=3",
        "seed=4",
    ];
    let scene = scene(EVERY_TABLE, &sets);
    assert_eq!(scene.camera.position, DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(angles(&scene).heading, 10.0_f64.to_radians());
    assert_eq!(angles(&scene).pitch, 5.5_f64.to_radians());
    assert_eq!((scene.screens[0].columns, scene.screens[0].lines), (64, 32));
    assert_eq!((scene.screens[1].columns, scene.screens[1].lines), (8, 8));
    // fov replaces distance and pixel.
    assert_eq!(scene.screens[1].extent, Extent::FieldOfView(20.0_f64.to_radians()));
    assert_eq!(terrain(&scene).outside, Outside::Clamp);
    assert_eq!(terrain(&scene).nodata, NoData::Nearest);
    assert_eq!((terrain(&scene).offset, terrain(&scene).scale), (5.0, 1.0));
    assert_eq!(scene.color.ramp, [[0, 0, 0], [9, 9, 9], [255, 255, 255]]);
    assert_eq!((scene.formats[2].0.name(), scene.formats[2].1.width), ("height", 24));
    assert_eq!((scene.stepper.halvings, scene.seed), (Bisection::Footprint, 4));
}

#[test]
fn options_without_a_table_in_the_file() {
    let scene = scene("", &["screen.size=[4,5]", "surface.0.cell=[2,2]", "camera.roll=1"]);
    assert_eq!((scene.screens[0].columns, scene.screens[0].lines), (4, 5));
    assert_eq!(terrain(&scene).cell, DVec2::splat(2.0));
    assert_eq!(angles(&scene).heading, 126.87_f64.to_radians());
}

#[test]
fn options_replace_the_other_form() {
    let forward = scene("[camera]\nheading = 3\nroll = 9", &["camera.forward=[0,0,1]"]);
    let expected = Attitude::Directions { forward: DVec3::Z, up: DVec3::Y };
    assert_eq!(forward.camera.attitude, expected);

    // North is -z: flight looks north-west; only the roll changes.
    let rolled = set_over("flight", &["camera.roll=10"]).unwrap();
    let Angles { heading, pitch, roll } = angles(&rolled);
    assert!((heading.to_degrees() - 126.87).abs() < 0.01, "{heading}");
    assert!((pitch.to_degrees() + 12.0).abs() < 0.01, "{pitch}");
    assert_eq!(roll, 10.0_f64.to_radians());

    let pitch = scene("[[screen]]\nfov = 9", &["screen.distance=2", "screen.pixel=[0.1,0.1]"]);
    let pixel = DVec2::splat(0.1);
    assert_eq!(pitch.screens[0].extent, Extent::Pitch { distance: 2.0, pixel });

    let plane = set_over("overview", &["surface.kind=plane", "surface.checker=2"]).unwrap();
    assert!(matches!(&plane.surfaces[..], [Surface::Plane(plane)] if plane.checker == 2.0));
    let terrain = set_over("plane", &["surface.kind=terrain"]).unwrap();
    assert!(matches!(&terrain.surfaces[..], [Surface::Terrain(_)]));
}

#[test]
fn wrong_options_are_named() {
    for (set, words) in [
        ("camera.hedding=3", &["in --set camera.hedding", "`camera.heading`"][..]),
        ("hedding=3", &["in --set hedding: unknown key"]),
        ("heading=3", &["did you mean `camera.heading`?"]),
        ("camera.position=[1,2]", &["in --set camera.position: found", "three numbers"]),
        ("camera.position=[1,nan,2]", &["in --set camera.position: ", "finite"]),
        ("camera.position=[1,2", &["in --set camera.position: ", "[1,2"]),
        ("camera={ positon = 3 }", &["in --set camera: camera.positon", "`camera.position`"]),
        ("camera.position.1=nan", &["in --set camera.position.1: camera.position", "finite"]),
        ("camera.position.1=1e10", &["in --set camera.position.1", "too far away"]),
        ("camera.position.3=1", &["camera.position.3", "no element 3", "0 to 2"]),
        ("camera.position.x=1", &["camera.position.x", "array of 3 values", "as a whole"]),
        ("unit_m.x=1", &["unit_m.x", "`unit_m` is 10", "as a whole"]),
        ("screen.2.fov=3", &["screen.2.fov", "no element 2", "0 to 1"]),
        ("screen.0.fov=0", &["in --set screen.0.fov", "above 0"]),
        ("surface.outside=klamp", &["in --set surface.outside: ", "did you mean \"clamp\"?"]),
        ("surface.map=nowhere.png", &["in --set surface.map: nowhere.png", "no such file"]),
        ("camera.heading", &["in --set camera.heading: there is no `=`", "path.to.key=value"]),
        ("=3", &["key of the path is empty"]),
        ("camera..heading=3", &["key of the path is empty"]),
        ("a.b.c.d.e.f.g.h.i=3", &["levels deep"]),
        ("camera.heading=", &["in --set camera.heading: found the text \"\""]),
        ("camera.heading=1\nunit_m=3", &["in --set camera.heading: found the text"]),
    ] {
        let error = try_scene(EVERY_TABLE, &[set]).map(|_| ()).expect_err(set);
        assert_says(&error, words);
    }
    let sets = ["camera.forward=[1,0,0]", "camera.heading=3"];
    let error = try_scene("", &sets).unwrap_err();
    assert_says(&error, &["--set camera.forward", "--set camera.heading", "keep either"]);
    let error = try_scene("", &["screen.distance=3"]).unwrap_err();
    assert_says(&error, &["in --set screen.distance: ", "pixel"]);
}
