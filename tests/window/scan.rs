//! The scan that falls line by line.

use terraline::engine::Engine;
use terraline::view::layout::Layout;
use terraline::view::order::Order;
use terraline::view::pane::Pane;
use terraline::view::session::Session;
use terraline::view::snapshot::LineState;
use terraline::view::worker::RenderWorker;

use super::{frame, run, scene};

#[test]
fn lines_fall_as_they_are_granted() {
    let scene = scene("overview", &["screen.size=[80, 60]"]);
    let layout = Layout::new(80, 60, 1);
    let mut session = Session::new(scene.clone(), false, Some(String::new()), Engine::Fast, layout);
    let order = Order { by_lines: true, ..session.order().unwrap() };
    let worker = RenderWorker::start(order).unwrap();
    let whole = frame(&scene, (80, 60), Engine::Fast).color;
    let mut granted = 0;
    for more in [1, 1, 5, 20, 30, 3] {
        worker.grant(more, u32::MAX);
        worker.finish();
        granted += more as usize;
        let snapshot = worker.snapshot();
        let image = &snapshot.images[0];
        assert_eq!((image.drawn(), snapshot.scan), (granted, Some(granted as u32)));
        assert_eq!(image.pixels[..granted * 80], whole[..granted * 80]);
        assert!(image.states[granted..].iter().all(|&state| state != LineState::Drawn));
    }
    // The next line is the first of the next frame.
    worker.grant(1, u32::MAX);
    worker.finish();
    let drawn = || (worker.snapshot().images[0].drawn(), worker.snapshot().scan);
    assert_eq!(drawn(), (1, Some(1)));
    assert_eq!(worker.snapshot().images[0].pixels, whole);
    // No more than asked for wait to be drawn; what is over at the end is the next frame's.
    worker.grant(30, 5);
    worker.finish();
    assert_eq!(drawn(), (6, Some(6)));
    worker.grant(57, u32::MAX);
    worker.finish();
    assert_eq!(drawn(), (3, Some(3)));
}

#[test]
fn two_engines_fall_side_by_side() {
    let scene = scene("valley", &["screen.size=[80, 60]"]);
    let layout = Layout::new(80, 60, 1);
    let mut session = Session::new(scene.clone(), false, Some(String::new()), Engine::Fast, layout);
    let first = session.order().unwrap();
    let panes: Vec<Pane> = [Engine::Processor, Engine::Oracle]
        .map(|engine| Pane { engine, ..first.panes[0] })
        .to_vec();
    let worker = RenderWorker::start(Order { by_lines: true, panes, ..first }).unwrap();
    worker.grant(37, u32::MAX);
    worker.finish();
    let snapshot = worker.snapshot();
    for (image, engine) in snapshot.images.iter().zip([Engine::Fast, Engine::Oracle]) {
        assert_eq!(image.drawn(), 37);
        assert_eq!(image.pixels[..37 * 80], frame(&scene, (80, 60), engine).color[..37 * 80]);
    }
}

#[test]
fn keys_pause_and_step() {
    let scene = scene("overview", &[]);
    let whole = frame(&scene, (80, 60), Engine::Fast).color;
    // A pause at the full rate starts a scan that stands; every point is a line.
    let (canvas, _) = run(scene.clone(), (80, 60), "tab space . . . wait wait");
    let bytes = canvas.bytes();
    // The marks at both edges cover the ends of some lines.
    let middle = |line: usize| line * 80 + 12..line * 80 + 68;
    for line in 0..3 {
        assert_eq!(bytes[middle(line)], whole[middle(line)], "line {line}");
    }
    assert_eq!(bytes[middle(3)][0], [255, 214, 64], "the scan line is marked");
    for line in 4..60 {
        assert_ne!(bytes[middle(line)], whole[middle(line)], "line {line} is dimmed");
    }
    // 256 lines a second are 25.6 lines in a tenth of a second.
    let (canvas, _) = run(scene.clone(), (80, 60), "tab - - -");
    let marked = |bytes: &[[u8; 3]]| {
        (0..60).find(|line| bytes[middle(*line)].iter().all(|&pixel| pixel == [255, 214, 64]))
    };
    // Ticks at 4096 and 1024 lines a second, then two at 256: frames in between start anew.
    let line = marked(&canvas.bytes()).expect("a marked line");
    let lines = 409 + 102 + 25 + 26;
    assert!(line.abs_diff(lines % 60) <= 1, "{line}");
    let (canvas, _) = run(scene, (80, 60), "tab - - + + wait");
    assert_eq!(canvas.bytes(), whole, "back at the full rate all is true");
}
