//! Where the craft gets to.

use glam::DVec3;
use terraline::engine::Engine;
use terraline::oracle::Oracle;
use terraline::scene::Scene;
use terraline::view::action::Action;
use terraline::view::camera::{Course, degrees};
use terraline::view::layout::Layout;
use terraline::view::session::Session;

use super::{run, scene};

fn session(scene: Scene, size: (usize, usize)) -> Session {
    let layout = Layout::new(size.0, size.1, 1);
    Session::new(scene, false, Some(String::new()), Engine::Fast, layout)
}

/// How far one second forward takes the craft from a place of `overview`.
fn second_from(position: &str) -> f64 {
    let scene = scene("overview", &[&format!("camera.position={position}")]);
    let mut session = session(scene, (64, 48));
    let from = session.scene().camera.position;
    session.act(Action::Fly(Course { forward: 1.0, ..Course::default() }, 1.0));
    session.scene().camera.position.distance(from)
}

#[test]
fn beside_the_map_speed_follows_the_height_above_its_base() {
    let scene = scene("overview", &[]);
    let terrain = scene.terrain().unwrap();
    let base = terrain.range().0 - terrain.base_depth();
    let width = 344.0;
    for height in [0.0, 40.0, 400.0] {
        let far = second_from(&format!("[172, {}, -300]", base + height));
        let expected = height / 2.0 + width / 300.0;
        assert!((far - expected).abs() < 1e-3, "{height}: {far}, not {expected}");
    }
    // Over the map it is the height above ground, which lies above the base.
    let over = second_from("[172, 192, 100]");
    let beside = second_from("[172, 192, -100]");
    assert!(over < beside && over > 0.8 * beside, "{over} {beside}");
}

#[test]
fn home_goes_back_to_the_camera_of_the_scene() {
    let size = (96, 64);
    let (start, _) = run(scene("flight", &[]), size, "tab 2");
    for home in ["home", "r"] {
        let (moved, _) = run(scene("flight", &[]), size, "tab 2 w up left wheel=3");
        let (back, _) = run(scene("flight", &[]), size, &format!("tab 2 w up left wheel=3 {home}"));
        assert!(moved != start && back == start, "{home}: the picture stays, the view goes back");
    }
}

/// The corners of the block of ground under a map.
fn corners(scene: &Scene) -> Vec<DVec3> {
    let terrain = scene.terrain().expect("a terrain");
    let (low, high) = terrain.range();
    let [east, south] = [terrain.map.columns(), terrain.map.rows()].map(|nodes| (nodes - 1) as f64);
    let ends = |end: f64| [0.0, end];
    let mut corners = Vec::new();
    for x in ends(east * terrain.cell.x) {
        for z in ends(south * terrain.cell.y) {
            for y in [low - terrain.base_depth(), high] {
                corners.push(DVec3::new(x, y, z));
            }
        }
    }
    corners
}

#[test]
fn the_whole_map_is_framed_from_where_one_looks() {
    let off_axis = ["screen.center=[0.2, -0.3]", "camera.offset=[0, 4, 3]"];
    for (size, sets) in [((300, 200), &[][..]), ((90, 240), &[]), ((300, 200), &off_axis)] {
        for [heading, pitch] in [[70.0, -35.0], [-90.0, -60.0], [10.0, 20.0], [160.0, -2.0]] {
            let turned = [format!("camera.heading={heading}"), format!("camera.pitch={pitch}")];
            let turned = turned.iter().map(String::as_str);
            let sets: Vec<&str> = sets.iter().copied().chain(turned).collect();
            let mut session = session(scene("flight", &sets), size);
            session.act(Action::Turn(0.0, 0.0, 20.0));
            session.act(Action::FrameMap);
            let scene = session.scene();
            let [h, p, roll] = degrees(&scene.camera);
            let kept = if pitch < -15.0 { pitch } else { -35.0 };
            assert!((h - heading).abs() < 1e-9 && (p - kept).abs() < 1e-9 && roll.abs() < 1e-9);
            let oracle = Oracle::new(scene, &scene.screens[0]);
            let mut room = [f64::INFINITY; 2];
            for corner in corners(scene) {
                let (line, column) = oracle.project(corner).expect("before the eye");
                let inside = |place: f64, count: usize| {
                    let last = count as f64 - 1.0;
                    assert!((0.0..=last).contains(&place), "{corner}: {line} {column}");
                    place.min(last - place) / last
                };
                room[0] = room[0].min(inside(line, size.1));
                room[1] = room[1].min(inside(column, size.0));
            }
            // Not farther than needed: along one axis the screen is used nearly to its edges, but for
            // corners of the block that stand above their ground.
            assert!(room[0].min(room[1]) < 0.1, "{heading} {pitch} {size:?}: {room:?}");
        }
    }
}

#[test]
fn what_cannot_be_framed_is_said() {
    let mut plane = session(scene("plane", &[]), (64, 48));
    plane.act(Action::FrameMap);
    assert!(plane.notice().is_some_and(|notice| notice.contains("Home")));
    // A screen that looks straight up from a level craft.
    let mut up = session(scene("flight", &["screen.mount={pitch=80}"]), (64, 48));
    let before = up.scene().camera.clone();
    up.act(Action::FrameMap);
    assert!(up.notice().is_some_and(|notice| notice.contains("Home")));
    assert_eq!(up.scene().camera, before);
}

#[test]
fn an_orbit_keeps_its_point_in_the_middle() {
    let mounted = ["camera.offset=[2, 1, -3]", "camera.roll=12", "screen.center=[0.1, -0.05]"];
    for sets in [&[][..], &mounted] {
        let mut session = session(scene("flight", sets), (300, 200));
        let seen = |session: &Session, point| {
            let scene = session.scene();
            Oracle::new(scene, &scene.screens[0]).project(point).expect("before the eye")
        };
        let middle = |session: &Session| {
            let scene = session.scene();
            Oracle::new(scene, &scene.screens[0]).pixel(99.5, 149.5).point
        };
        let point = middle(&session);
        let apart = session.eye().distance(point);
        let [heading, pitch, roll] = degrees(&session.scene().camera);
        session.act(Action::HoldGround);
        for (right, down) in [(40.0, 60.0), (300.0, 20.0), (-111.0, 7.0)] {
            session.act(Action::Orbit(right, down));
            let (line, column) = seen(&session, point);
            let off = (line - 99.5).hypot(column - 149.5);
            assert!(off < 0.05, "{right} {down}: {off} pixels");
            assert!((session.eye().distance(point) / apart - 1.0).abs() < 1e-5);
        }
        let [h, p, r] = degrees(&session.scene().camera);
        let turned = (heading - h - 0.3 * 229.0).rem_euclid(360.0);
        // Angles are kept to thousandths of a degree.
        assert!(turned.min(360.0 - turned) < 2e-3, "{turned}");
        assert!((pitch - p - 0.3 * 87.0).abs() < 2e-3 && (r - roll).abs() < 2e-3);
        session.act(Action::Approach(5.0));
        assert!((session.eye().distance(point) / apart - 0.88_f64.powi(5)).abs() < 1e-5);
        // A drag down: from higher up.
        let height = session.eye().y;
        session.act(Action::Orbit(0.0, 10.0));
        assert!(session.eye().y > height);
    }
    // By the hands: the wheel approaches, it does not zoom.
    let keys = "tab orbit=100,100,60,90,3";
    let (canvas, _) = run(scene("flight", &[]), (300, 200), keys);
    let mut session = session(scene("flight", &[]), (300, 200));
    for action in [Action::HoldGround, Action::Orbit(-40.0, -10.0), Action::Approach(3.0)] {
        session.act(action);
    }
    let expected = super::frame(session.scene(), (300, 200), Engine::Fast).color;
    assert_eq!(canvas.bytes(), expected);
}

#[test]
fn without_ground_in_the_middle_the_base_or_nothing_is_held() {
    let off_map = ["camera.position=[-50, 40, 100]", "camera.heading=180", "camera.pitch=-30"];
    let mut beside = session(scene("overview", &off_map), (300, 200));
    let from = beside.eye();
    beside.act(Action::HoldGround);
    beside.act(Action::Orbit(100.0, 0.0));
    assert!(beside.notice().is_none() && beside.eye().distance(from) > 10.0);
    let mut sky = session(scene("flight", &["camera.pitch=60"]), (300, 200));
    let from = sky.eye();
    sky.act(Action::HoldGround);
    assert!(sky.notice().is_some_and(|notice| notice.contains("no ground")));
    sky.act(Action::Orbit(100.0, 0.0));
    assert_eq!(sky.eye(), from);
}
