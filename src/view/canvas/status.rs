//! The status line: craft, machine, time, and the pixel under the cursor.

use embedded_graphics::pixelcolor::Rgb888;

use crate::frame::Hit;
use crate::scene::{Deformation, Extent};
use crate::study::error::Sheet;
use crate::study::probe::Probe;

use super::legend::figure;
use super::panel::{MARGIN, height, rows, width, write};
use super::{ALERT, Canvas, MARK, TEXT};
use crate::view::camera;
use crate::view::pane::Source;
use crate::view::session::Session;
use crate::view::snapshot::{FrameRate, Snapshot, Timing};

/// Draws the status line at the bottom and returns where it begins.
pub(super) fn draw(
    canvas: &mut Canvas,
    session: &Session,
    snapshot: &Snapshot,
    timed: bool,
) -> i32 {
    let font = canvas.font();
    let (wide, tall) = (canvas.size().0 as i32, canvas.size().1 as i32);
    let space = wide - 2 * MARGIN;
    let mut parts: Vec<(Vec<String>, Rgb888)> = Vec::new();
    if let Some(trouble) = &snapshot.facts.trouble {
        parts.push((vec![format!("cannot draw: {trouble}")], ALERT));
    }
    if let Some(notice) = session.notice() {
        parts.push((vec![notice.to_owned()], ALERT));
    }
    match &snapshot.facts.probe {
        Some(found) if session.pointed() == Some((found.column, found.line)) => {
            parts.push((probe(session, found), TEXT));
        }
        _ => {}
    }
    parts.push((craft(session), TEXT));
    parts.push((work(session, snapshot, timed), TEXT));
    let lines = |space: i32| -> Vec<(String, Rgb888)> {
        let of = |(items, color): &(Vec<String>, Rgb888)| {
            let color = *color;
            rows(font, items, "   ", space).into_iter().map(move |row| (row, color))
        };
        parts.iter().flat_map(of).collect()
    };

    let row = height(font);
    // In a small window the picture keeps two thirds; what is most urgent stands first, the rest on
    // further pages.
    let most = ((tall / 3 - 2 * MARGIN) / row).max(0) as usize;
    let mut all = lines(space);
    if most == 0 || all.is_empty() {
        return tall;
    }
    let mut mark = String::new();
    if all.len() > most {
        all = lines(space - width(font, "PageDown 9/9 "));
        let pages = all.len().div_ceil(most);
        let page = session.status_page().rem_euclid(pages as i32) as usize;
        mark = format!("PageDown {}/{pages}", page + 1);
        all = all.split_off(page * most);
        all.truncate(most);
    }
    let lines = all;
    let top = tall - lines.len() as i32 * row - 2 * MARGIN;
    canvas.shade(0, top, wide as u32, (tall - top) as u32);
    for (at, (text, color)) in lines.iter().enumerate() {
        write(canvas, font, MARGIN, top + MARGIN + at as i32 * row, text, *color);
    }
    write(canvas, font, wide - MARGIN - width(font, &mark), top + MARGIN, &mark, MARK);
    top
}

fn craft(session: &Session) -> Vec<String> {
    let (scene, measure) = (session.scene(), session.measure());
    // What rounds to nothing has no sign.
    let tenth = |degrees: f64| (degrees * 10.0).round() / 10.0 + 0.0;
    let [heading, pitch, roll] = camera::degrees(&scene.camera).map(tenth);
    let (course, point) = camera::compass(heading);
    let place = scene.camera.position;
    let mut items = vec![
        format!("at {:.2} {:.2} {:.2}", place.x, place.y, place.z),
        format!("eye at {} m", figure(measure.height_m(session.eye().y))),
        format!("heading {heading:.1}° (compass {course:.1}° {point})"),
        format!("pitch {pitch:+.1}°"),
        format!("roll {roll:+.1}°"),
    ];
    if let Some(above) = session.eye_above_ground() {
        let metres = figure(measure.rise_m(above));
        items.insert(2, format!("{} above ground, {metres} m", figure(above)));
    }
    if let Extent::FieldOfView(fov) = scene.screens[0].extent {
        items.push(format!("field {:.1}°", fov.to_degrees()));
    }
    items.push("H help".into());
    items
}

fn work(session: &Session, snapshot: &Snapshot, timed: bool) -> Vec<String> {
    let scene = session.scene();
    let mut items = Vec::new();
    if scene.terrain().is_some() {
        let shape = scene.kernel.shape.name();
        items.push(match scene.kernel.deformation {
            Deformation::None => format!("{shape}, deformation 0"),
            Deformation::Stretch => format!("{shape}, deformation 1"),
            Deformation::TowardHat { weight_shift } => {
                format!("{shape}, deformation 2, weight 2^-{weight_shift}")
            }
        });
    }
    if let Some(times) = session.exaggeration() {
        // Scales in scene files are rounded: to three digits they are what was chosen.
        let times = format!("{times:.2}");
        items.push(format!("heights x {}", times.trim_end_matches('0').trim_end_matches('.')));
    }
    let layout = session.layout();
    let scale = if layout.scale > 1 { format!(" x {}", layout.scale) } else { String::new() };
    let raster = format!("{}x{}{scale}", layout.columns, layout.lines);
    items.push(format!("{raster}, {}", snapshot.facts.world));
    items.push(pace(session, snapshot));
    if timed && !snapshot.facts.timings.is_empty() {
        let times: Vec<String> = snapshot.facts.timings.iter().map(time).collect();
        items.push(times.join(", "));
    }
    items.extend(snapshot.facts.frame_rate.as_ref().map(frame_rate));
    items
}

fn pace(session: &Session, snapshot: &Snapshot) -> String {
    let pace = session.pace();
    let line = match snapshot.scan.filter(|_| snapshot.by_lines) {
        Some(line) if line as usize >= session.layout().lines => ", all lines".into(),
        Some(line) => format!(", line {line}"),
        None => String::new(),
    };
    match pace.lines_per_second() {
        _ if pace.is_paused() => format!("paused{line}"),
        None => "full rate".into(),
        Some(1) => format!("1 line/s{line}"),
        Some(speed) => format!("{speed} lines/s{line}"),
    }
}

fn time(Timing { source, ms }: &Timing) -> String {
    let name = match source {
        Source::Frame(engine) => engine.name(),
        Source::Error => "errors",
    };
    if *ms < 10.0 { format!("{name} {ms:.1} ms") } else { format!("{name} {ms:.0} ms") }
}

fn frame_rate(FrameRate { fps, clock_mhz, counted, lines }: &FrameRate) -> String {
    let sampled =
        if counted < lines { format!(" ({counted} of {lines} lines)") } else { String::new() };
    format!("machine {} frames/s at {} MHz{sampled}", figure(*fps), figure(*clock_mhz))
}

fn probe(session: &Session, probe: &Probe) -> Vec<String> {
    let measure = session.measure();
    let mut items = vec![format!("pixel {},{}", probe.column, probe.line)];
    match probe.point {
        Some(point) => {
            let what = if probe.hit == Hit::Side { "side, rim" } else { "ground" };
            items.push(format!("{what} {:.3} {:.3} {:.3}", point.x, point.y, point.z));
            // Less than the registers hold is no height.
            let height = measure.height_m(point.y);
            let least = 1e-5 * measure.rise_m(1.0).abs();
            let height = if height.abs() < least { 0.0 } else { height };
            items.push(format!("{} m high", figure(height)));
            items.extend(measure.place(point.x, point.z));
            let away = (point - session.eye()).with_y(0.0).length();
            let metres = figure(measure.distance_m(away));
            items.push(format!("{} away over ground, {metres} m", figure(away)));
            items.push(format!("step {}", probe.steps));
        }
        None => items.push(probe.hit.name().into()),
    }
    items.push(match probe.cycles {
        1 => "1 cycle".into(),
        cycles => format!("{cycles} cycles"),
    });
    items.push(match (probe.error_px, probe.sheet) {
        (Some(error), _) => format!("error {} px", figure(error)),
        (None, Sheet::Lost) if probe.hit == Hit::Surface => {
            "lost: the oracle sees another sheet".into()
        }
        (None, Sheet::Lost) => "lost: the oracle sees the surface".into(),
        (None, Sheet::Ghost) => "ghost: the oracle sees no surface".into(),
        (None, Sheet::Flip) => "the oracle says otherwise".into(),
        (None, _) => "as the oracle".into(),
    });
    items
}
