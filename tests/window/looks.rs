//! Heights, sun and colours by keys.

use std::path::Path;

use terraline::engine::Engine;
use terraline::scene::file::{Document, parse};
use terraline::view::action::Action;
use terraline::view::layout::Layout;
use terraline::view::session::Session;

use super::{frame, run, scene};

#[test]
fn what_keys_change_is_drawn_and_copied_out() {
    let size = (96, 64);
    let (before, _) = run(scene("flight", &[]), size, "tab");
    for keys in ["v", "V V", "l l", "L o", "O", "p", "P", "v l o p p"] {
        // Heights are loaded once: what was loaded for others must not be used.
        let (canvas, printed) = run(scene("flight", &[]), size, &format!("tab {keys} c"));
        assert!(canvas != before, "{keys}");
        let document = Document {
            name: "copied",
            file: "copied.toml",
            folder: Path::new(""),
            text: &printed[0],
        };
        let copied = parse(&document, &[]).expect("a scene");
        assert_eq!(canvas.bytes(), frame(&copied, size, Engine::Fast).color, "{keys}");
    }
}

#[test]
fn heights_sun_and_colours_go_in_steps() {
    let open = |name: &str| {
        let scene = scene(name, &[]);
        Session::new(scene, false, Some(String::new()), Engine::Fast, Layout::new(96, 64, 1))
    };
    let mut session = open("flight");
    let mut after = |steps| {
        session.act(Action::Exaggerate(steps));
        session.exaggeration().expect("a terrain")
    };
    // The scene has twice life size: 0.025 of a unit of 80 m.
    for (steps, times) in [(1, 3.0), (-1, 2.0), (-1, 1.5), (-1, 1.0), (-1, 0.7), (1, 1.0)] {
        assert!((after(steps) - times).abs() < 1e-9, "{steps} to {times}");
    }
    assert!((0..20).map(|_| after(1)).all(|times| times < 50.1));
    assert!(session.notice().is_some_and(|notice| notice.contains("no key")));
    // North-west at first: a quarter turn clockwise is north-east.
    let from = session.scene().light.direction;
    session.act(Action::TurnSun(90.0, 0.0));
    let to = session.scene().light.direction;
    assert!((to.x + from.z).abs() < 0.02 && (to.z - from.x).abs() < 0.02, "{from} {to}");
    session.act(Action::TurnSun(0.0, 500.0));
    assert!(session.scene().light.direction.y > 0.999_999);
    session.act(Action::TurnSun(0.0, -60.0));
    let high = session.scene().light.direction.y.asin().to_degrees();
    assert!((high - 30.0).abs() < 1e-6, "{high}");
    let ramp = session.scene().color.ramp.clone();
    let ramps = [(); 5].map(|()| {
        session.act(Action::NextRamp(1));
        session.scene().color.ramp.clone()
    });
    assert!(ramps[4] == ramp && ramps[0] != ramp);
    session.act(Action::NextRamp(-1));
    assert_eq!(session.scene().color.ramp, ramps[3]);

    let mut plane = open("plane");
    for action in [Action::Exaggerate(1), Action::TurnSun(1.0, 0.0), Action::NextRamp(1)] {
        plane.act(action);
        assert!(plane.notice().is_some_and(|notice| notice.starts_with("a plane has n")));
    }
}
