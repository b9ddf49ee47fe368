//! The window without a window: sessions, render worker and canvas behind a glass of the tests' own.

#[path = "window/display.rs"]
mod display;
#[path = "window/errors.rs"]
mod errors;
#[path = "window/flight.rs"]
mod flight;
#[path = "window/golden.rs"]
mod golden;
#[path = "window/looks.rs"]
mod looks;
#[path = "window/measure.rs"]
mod measure;
#[path = "window/scan.rs"]
mod scan;
#[path = "support/skipped.rs"]
mod skipped;
mod support;

use std::collections::VecDeque;

use proptest::prelude::*;
use support::loaded as scene;
use terraline::engine::{Band, Engine, Machine, Memories, Wanted};
use terraline::frame::{Frame, Hit};
use terraline::oracle::Oracle;
use terraline::plan::Plan;
use terraline::scene::file::{Document, parse};
use terraline::scene::{Deformation, Scene};
use terraline::sink::picture::Picture;
use terraline::study::explain::text::text;
use terraline::view::action::Action;
use terraline::view::canvas::Canvas;
use terraline::view::input::Input;
use terraline::view::layout::Layout;
use terraline::view::order::Order;
use terraline::view::pane::Pane;
use terraline::view::run::{Glass, RunError, View};
use terraline::view::script;
use terraline::view::session::Session;
use terraline::view::worker::RenderWorker;

/// A glass whose size changes from frame to frame, the last one staying.
struct Sizes(VecDeque<(usize, usize)>);

impl Glass for Sizes {
    fn size(&self) -> (usize, usize) {
        self.0[0]
    }

    fn poll(&mut self) -> Option<Input> {
        if self.0.len() > 1 {
            self.0.pop_front();
        }
        Some(Input::default())
    }

    fn present(&mut self, canvas: &Canvas) -> Result<(), String> {
        assert_eq!(canvas.size(), self.size());
        assert_eq!(canvas.pixels().len(), self.size().0 * self.size().1);
        Ok(())
    }
}

/// A run in glasses of these sizes: the last canvas, and what was printed.
fn run_in(
    scene: Scene,
    scale: usize,
    sizes: &[(usize, usize)],
    keys: &str,
) -> Result<(Canvas, Vec<String>), RunError> {
    let script = script::parse(keys).expect("keys");
    let frames = (script.len() + 1).max(sizes.len()) as u32;
    let mut glass = Sizes(sizes.iter().copied().collect());
    let layout = Layout::new(sizes[0].0, sizes[0].1, scale);
    let mut session = Session::new(scene, false, Some("map.png".into()), Engine::Fast, layout);
    let worker = RenderWorker::start(session.order().expect("the first order"))
        .expect("a scene that can be drawn");
    let mut printed = Vec::new();
    let mut print = |text: &str| printed.push(text.to_owned());
    let mut view = View::new(&mut glass, session, worker, &mut print);
    let canvas = view.scripted(&script, frames)?.clone();
    drop(view);
    Ok((canvas, printed))
}

fn run(scene: Scene, size: (usize, usize), keys: &str) -> (Canvas, Vec<String>) {
    run_in(scene, 1, &[size], keys).expect("a window that stays open")
}

/// The frame of a scene as `render` draws it.
fn frame(scene: &Scene, size: (usize, usize), engine: Engine) -> Frame {
    drawn(scene, size, engine).frame
}

fn drawn(scene: &Scene, size: (usize, usize), engine: Engine) -> Band {
    let mut scene = scene.clone();
    scene.screens[0] = scene.screens[0].resized(size.0 as u32, size.1 as u32);
    let plan = Plan::new(&scene, None, false).expect("a scene that can be drawn");
    let wanted = Wanted { buffers: true, ..Wanted::default() };
    Machine::new(&scene, &plan, &Memories::default())
        .and_then(|machine| Ok(machine.scan(engine, wanted)?.finish()))
        .expect("a scene that can be drawn")
}

#[test]
fn the_window_shows_the_frames_of_all_engines() {
    let size = (96, 64);
    let engines = [Engine::Fast, Engine::Processor, Engine::Real, Engine::Oracle];
    for name in ["overview", "valley", "plane"] {
        let scene = scene(name, &[]);
        for (presses, engine) in engines.into_iter().enumerate() {
            let (canvas, _) = run(scene.clone(), size, &format!("tab {}", "g ".repeat(presses)));
            assert_eq!(canvas.bytes(), frame(&scene, size, engine).color, "{name} {engine:?}");
        }
        let heights = Picture::Height.of(&drawn(&scene, size, Engine::Fast)).unwrap();
        assert_eq!(run(scene, size, "2 tab").0.bytes(), heights.pixels, "{name}");
    }
}

#[test]
fn a_split_parts_two_pictures() {
    let (width, size) = (96, (96, 64));
    let scene = scene("flight", &[]);
    // The cursor is in the way of nothing: panels are off.
    let (canvas, _) = run(scene.clone(), size, "tab 3 shift+4 drag=48,20,24,20");
    let drawn = drawn(&scene, size, Engine::Fast);
    let [left, right] =
        [Picture::Normal, Picture::Steps].map(|picture| picture.of(&drawn).unwrap().pixels);
    for (index, pixel) in canvas.bytes().into_iter().enumerate() {
        let (x, y) = (index % width, index / width);
        // Rows of the grip, columns of the split.
        if (22..43).contains(&y) || (22..27).contains(&x) {
            continue;
        }
        assert_eq!(pixel, if x < 24 { left[index] } else { right[index] }, "{x},{y}");
    }
}

#[test]
fn a_raster_pixel_is_a_square_of_window_pixels() {
    let scene = scene("overview", &[]);
    let (canvas, _) = run_in(scene.clone(), 3, &[(100, 62)], "tab").unwrap();
    let frame = frame(&scene, (33, 20), Engine::Fast);
    for (index, pixel) in canvas.bytes().into_iter().enumerate() {
        let (x, y) = (index % 100, index / 100);
        // One pixel of 100 is over, and two of 62: they are black, on either side.
        let inside = (0..99).contains(&x) && (1..61).contains(&y);
        let expected = if inside { frame.color[(y - 1) / 3 * 33 + x / 3] } else { [0; 3] };
        assert_eq!(pixel, expected, "{x},{y}");
    }
}

#[test]
fn a_copied_scene_gives_the_frame_that_is_seen() {
    let size = (96, 64);
    let keys = "left up w d wheel=2 k ] drag=10,10,30,5 tab c";
    let (canvas, printed) = run(scene("flight", &[]), size, keys);
    assert_eq!(printed.len(), 1);
    let document = Document {
        name: "copied",
        file: "copied.toml",
        folder: std::path::Path::new(""),
        text: &printed[0],
    };
    let copied = parse(&document, &[]).unwrap();
    assert_eq!((copied.screens[0].columns, copied.screens[0].lines), (96, 64));
    assert_eq!(canvas.bytes(), frame(&copied, size, Engine::Fast).color);
}

#[test]
fn a_click_prints_what_explain_prints() {
    let scene = scene("valley", &["screen.size=[96, 64]"]);
    for keys in ["click=40,50", "move=40,50 x"] {
        let (_, printed) = run(scene.clone(), (96, 64), keys);
        let plan = Plan::new(&scene, None, false).unwrap();
        let machine = Machine::new(&scene, &plan, &Memories::default()).unwrap();
        let explanation = machine.explain(40, 50).unwrap();
        assert_eq!(printed, [text("valley", machine.world().name(), &explanation)], "{keys}");
    }
}

#[test]
fn the_pixel_under_the_cursor_is_that_of_the_frame() {
    let scene = scene("overview", &["screen.size=[96, 64]"]);
    let drawn = frame(&scene, (96, 64), Engine::Fast);
    let buffers = drawn.buffers.as_ref().unwrap();
    let layout = Layout::new(96, 64, 1);
    let mut session = Session::new(scene.clone(), false, Some(String::new()), Engine::Fast, layout);
    let order = session.order().unwrap();
    let worker = RenderWorker::start(order.clone()).unwrap();
    let plan = support::plan(&scene);
    let machine = support::machine(&scene, &plan).unwrap();
    let mut points = 0;
    for (column, line) in [(0, 0), (50, 40), (95, 63), (20, 20)] {
        worker.look(Some((column, line)));
        worker.finish();
        let probe = worker.snapshot().facts.probe.unwrap();
        let index = line as usize * 96 + column as usize;
        assert_eq!((probe.hit, probe.steps), (drawn.hit[index], buffers.steps[index]));
        let wanted = Wanted { first_line: line, cycles: true, ..Wanted::default() };
        let band = machine.scan(Engine::Processor, wanted).unwrap().draw(1, &|| false).unwrap();
        assert_eq!(probe.cycles, band.cycles[column as usize]);
        match probe.point {
            Some(point) => {
                let [x, z] = [buffers.ground_x[index], buffers.ground_z[index]];
                assert_eq!([point.x, point.y, point.z], [x, buffers.height[index], z]);
                assert!(probe.error_px.is_some_and(|error| error < 0.1));
                points += 1;
            }
            None => assert_eq!((probe.hit, probe.error_px), (Hit::Sky, None)),
        }
    }
    assert!((1..4).contains(&points), "{points} of 4 pixels show ground");
    assert!(worker.snapshot().facts.frame_rate.is_some_and(|m| m.fps > 1.0 && m.counted == 16));
    // A whole frame of the processor has all its cycles counted.
    let pane = Pane { engine: Engine::Processor, ..order.panes[0] };
    worker.order(Order { panes: vec![pane], ..order });
    worker.finish();
    assert!(worker.snapshot().facts.frame_rate.is_some_and(|m| m.fps > 1.0 && m.counted == 64));
}

#[test]
fn actions_change_what_they_name() {
    let scene = scene("overview", &["screen.size=[96, 64]", "kernel.deformation=2"]);
    let layout = Layout::new(96, 64, 1);
    let mut session = Session::new(scene.clone(), false, None, Engine::Fast, layout);
    let first = (scene.camera, scene.screens);
    session.act(Action::Zoom(3.0));
    session.act(Action::Turn(20.0, 5.0, 1.0));
    assert!(session.scene().camera != first.0 && session.scene().screens != first.1);
    session.act(Action::Reset);
    assert_eq!((&session.scene().camera, &session.scene().screens), (&first.0, &first.1));

    let shapes = [(); 5].map(|()| {
        session.act(Action::NextShape);
        session.scene().kernel.shape
    });
    assert_eq!(shapes[4], shapes[0]);
    assert!(support::SHAPES.iter().all(|shape| shapes.contains(shape)), "{shapes:?}");
    let mut shift = |by: i32| {
        session.act(Action::Weight(by));
        session.scene().kernel.deformation
    };
    let expected = [24, 23, 0, 1].map(|weight_shift| Deformation::TowardHat { weight_shift });
    assert_eq!([40, -1, -40, 1].map(&mut shift), expected);
    session.act(Action::ToggleSplit);
    for (place, split) in [(0.7, 0.7), (-1.0, 0.0), (1.5, 1.0)] {
        session.act(Action::MoveSplit(place));
        assert_eq!(session.split(), Some(split));
    }
}

#[test]
fn dragging_moves_the_scene_with_the_mouse() {
    // What is under the cursor at first is under it at the end, up to perspective.
    let scene = scene("overview", &[]);
    let size = (300, 200);
    let layout = Layout::new(size.0, size.1, 1);
    let mut session = Session::new(scene, false, Some(String::new()), Engine::Fast, layout);
    let place = |session: &Session| {
        let scene = session.scene();
        let oracle = Oracle::new(scene, &scene.screens[0]);
        move |point| oracle.project(point).unwrap()
    };
    let scene = session.scene();
    let point = Oracle::new(scene, &scene.screens[0]).pixel(100.0, 150.0).point;
    let before = place(&session)(point);
    session.act(Action::Drag(20.0, 10.0));
    let after = place(&session)(point);
    let (down, right) = (after.0 - before.0, after.1 - before.1);
    assert!((down - 10.0).abs() < 3.0 && (7.0..22.0).contains(&right), "{right} {down}");
}

#[test]
fn the_craft_stays_above_the_ground() {
    let (sunk, _) = run(scene("valley", &[]), (200, 120), &"q ".repeat(60));
    let (shown, _) = run(scene("valley", &[]), (200, 120), "wait");
    assert_ne!(sunk.pixels(), shown.pixels());

    let layout = Layout::new(64, 48, 1);
    let mut session =
        Session::new(scene("valley", &[]), false, Some(String::new()), Engine::Fast, layout);
    let down = terraline::view::camera::Course { up: -1.0, ..Default::default() };
    let ahead = terraline::view::camera::Course { forward: 1.0, up: -1.0, right: 0.3 };
    for step in 0..400 {
        let course = if step < 40 { down } else { ahead };
        session.act(Action::Fly(course, 0.1));
        let order = session.order().unwrap();
        let worker = RenderWorker::start(order);
        assert!(worker.is_ok(), "step {step}: {:?}", worker.err());
        if session.notice().is_some() && step > 200 {
            break;
        }
    }
    assert!(session.notice().is_some_and(|notice| notice.contains("above the ground")));
}

#[test]
fn a_closed_window_ends_the_script() {
    let result = run_in(scene("plane", &[]), 1, &[(40, 30)], "w w esc w");
    assert!(matches!(result, Err(RunError::Closed(2, 5))));
}

#[test]
fn a_new_order_and_the_end_do_not_wait_for_a_long_frame() {
    // A frame of errors of this size takes many seconds.
    let scene = scene("flight", &[]);
    let layout = Layout::new(3200, 2400, 1);
    let mut session = Session::new(scene, false, Some(String::new()), Engine::Fast, layout);
    let order = session.order().unwrap();
    let worker = RenderWorker::start(order.clone()).unwrap();
    let first = order.panes[0];
    let pane = |picture| vec![Pane { picture, ..first }];
    worker.order(Order { panes: pane(Picture::Error), ..order.clone() });
    std::thread::sleep(std::time::Duration::from_secs(1));
    let start = std::time::Instant::now();
    worker.order(Order { panes: pane(Picture::Error), ..order });
    drop(worker);
    assert!(start.elapsed().as_secs_f64() < 1.0, "{:?}", start.elapsed());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn any_keys_in_any_window_are_drawn(
        words in prop::collection::vec(
            prop::sample::select(vec![
                "w", "s", "a", "d", "e", "q", "W", "1", "2", "3", "4", "5", "6", "shift+1",
                "shift+5", "shift+6", "7", "shift+7", "8", "9", "0", "v", "V", "l", "O", "p", "g", "G", "k", "j", "[", "]", "/", "space", ".", "+", "-",
                "-", "h", "tab", "r", "home", "f", "left", "right", "up", "down", "shift+left", "wheel=5",
                "wheel=-5", "move=10,10", "click=3,4", "drag=5,5,30,9", "orbit=5,5,30,9,2", "drag=20,5,1,1", "wait",
            ]),
            0..14,
        ),
        sizes in prop::collection::vec((1..90_usize, 1..60_usize), 1..5),
        scale in 1..4_usize,
        name in prop::sample::select(vec!["overview", "valley", "plane"]),
    ) {
        let keys = words.join(" ");
        let (canvas, _) = run_in(scene(name, &[]), scale, &sizes, &keys).unwrap();
        // And the same again, bit for bit.
        let (again, _) = run_in(scene(name, &[]), scale, &sizes, &keys).unwrap();
        prop_assert!(canvas == again, "{}", keys);
    }
}
