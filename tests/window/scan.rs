//! The scan that falls line by line.

use terraline::engine::Engine;
use terraline::sink::picture::Picture;
use terraline::view::action::{Action, Side};
use terraline::view::layout::Layout;
use terraline::view::order::Order;
use terraline::view::pane::Pane;
use terraline::view::session::Session;
use terraline::view::snapshot::LineState;
use terraline::view::worker::RenderWorker;

use super::{drawn, frame, run, scene};

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

/// A session with its worker, in step with each other.
struct Window {
    session: Session,
    worker: RenderWorker,
}

impl Window {
    fn open(name: &str) -> Self {
        let layout = Layout::new(80, 60, 1);
        let scene = scene(name, &[]);
        let mut session = Session::new(scene, false, Some(String::new()), Engine::Fast, layout);
        let order = session.order().expect("the first order");
        let worker = RenderWorker::start(order).expect("a scene that can be drawn");
        worker.finish();
        Self { session, worker }
    }

    /// Acts, and waits until the worker has done what follows.
    fn act(&mut self, action: Action) -> &mut Self {
        self.session.act(action);
        if let Some(order) = self.session.order() {
            self.worker.order(order);
        }
        self.worker.finish();
        self
    }

    fn grant(&mut self, lines: u32) -> &mut Self {
        self.worker.grant(lines, u32::MAX);
        self.worker.finish();
        self
    }

    /// The lines that have fallen, by the images and by the scan.
    fn fallen(&self) -> (Vec<usize>, Option<u32>) {
        let snapshot = self.worker.snapshot();
        (snapshot.images.iter().map(|image| image.drawn()).collect(), snapshot.scan)
    }

    fn pixels(&self, side: usize) -> Vec<[u8; 3]> {
        self.worker.snapshot().images[side].pixels.clone()
    }
}

#[test]
fn a_pause_at_the_full_rate_keeps_the_frame() {
    let mut window = Window::open("overview");
    let whole = window.pixels(0);
    window.act(Action::TogglePause);
    assert_eq!(window.fallen(), (vec![60], Some(60)));
    assert_eq!(window.pixels(0), whole);
    // The next line is the first of the next frame.
    window.grant(1);
    assert_eq!(window.fallen(), (vec![1], Some(1)));
    // And at the full rate again all is there.
    window.act(Action::TogglePause);
    assert_eq!((window.fallen(), window.pixels(0)), ((vec![60], None), whole));
}

#[test]
fn a_scan_that_stands_stays_where_it_was() {
    let size = (80, 60);
    let scene = scene("overview", &[]);
    let frames = drawn(&scene, size, Engine::Fast);
    let mut window = Window::open("overview");
    window.act(Action::Slower).act(Action::TogglePause).grant(23);
    assert_eq!(window.fallen(), (vec![23], Some(23)));
    for (action, sides) in [
        (Action::Picture(Side::Left, Picture::Height), 1),
        (Action::Picture(Side::Left, Picture::Cycles), 1),
        (Action::Picture(Side::Left, Picture::Error), 1),
        (Action::ToggleSplit, 2),
        (Action::NextEngine(Side::Right), 2),
        (Action::MoveSplit(0.3), 2),
        (Action::ToggleHelp, 2),
        (Action::TogglePanels, 2),
        (Action::CopyScene, 2),
        (Action::Point(Some((20, 50))), 2),
        (Action::Faster, 2),
        (Action::Slower, 2),
        (Action::ToggleSplit, 1),
        (Action::TogglePause, 1),
        (Action::TogglePause, 1),
        (Action::Picture(Side::Left, Picture::Height), 1),
    ] {
        window.act(action);
        window.session.resize(Layout::new(80, 60, 1));
        assert_eq!(window.fallen(), (vec![23; sides], Some(23)), "{action:?}");
    }
    let heights = Picture::Height.of(&drawn(&scene, (80, 60), Engine::Fast)).unwrap().pixels;
    // The ramp follows the lines that are drawn: all of them were, without buffers or with.
    window.grant(37);
    assert_eq!((window.fallen(), window.pixels(0)), ((vec![60], Some(60)), heights));
    window.act(Action::Picture(Side::Left, Picture::Color));
    assert_eq!((window.fallen().1, window.pixels(0)), (Some(60), frames.frame.color));
}

#[test]
fn a_pause_takes_back_lines_that_wait() {
    let mut window = Window::open("flight");
    window.act(Action::Slower).act(Action::Picture(Side::Left, Picture::Error));
    // So many that without the hold it would not be done today.
    window.worker.grant(u32::MAX, u32::MAX);
    window.worker.hold();
    window.worker.finish();
    let stands = window.fallen().1;
    window.grant(1);
    assert_eq!(window.fallen().1, stands.map(|line| line % 60 + 1));
}

#[test]
fn finished_frames_are_shown_again_and_not_drawn_again() {
    let mut window = Window::open("overview");
    let show = |window: &mut Window, picture| {
        window.act(Action::Picture(Side::Left, picture));
        let snapshot = window.worker.snapshot();
        assert_eq!((snapshot.images[0].drawn(), snapshot.scan), (60, None), "{picture:?}");
        // Drawn again, it would have taken another time, to the nanosecond.
        (snapshot.facts.timings.clone(), window.pixels(0))
    };
    let first = Picture::ALL.map(|picture| show(&mut window, picture));
    let again = Picture::ALL.map(|picture| show(&mut window, picture));
    assert_eq!(first[1..], again[1..]);
    // Height, normal and steps come from one frame, and from then on the colour as well.
    let times = again.each_ref().map(|(timings, _)| timings);
    assert!(times[0] == times[1] && times[1] == times[2] && times[2] == times[3]);
    assert_ne!(times[4], times[5]);
    assert_eq!(first[0].1, again[0].1);
    // Another view is drawn anew.
    window.act(Action::Turn(1.0, 0.0, 0.0)).act(Action::Turn(-1.0, 0.0, 0.0));
    let anew = show(&mut window, Picture::Height);
    assert_ne!(anew.0, again[1].0);
    assert_eq!(anew.1, again[1].1);
}
