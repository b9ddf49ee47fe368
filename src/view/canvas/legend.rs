//! Legends: what each side shows, and what its colours stand for.

use embedded_graphics::mono_font::MonoFont;
use embedded_graphics::mono_font::iso_8859_1::FONT_6X10;
use embedded_graphics::pixelcolor::Rgb888;

use crate::scene::Surface;
use crate::sink::picture::{self, Legend, NOTHING, Picture, SILHOUETTE};

use super::panel::{MARGIN, height, width, wrapped, write};
use super::{ALERT, Canvas, TEXT};
use crate::view::session::Session;
use crate::view::snapshot::{Image, LineState, Snapshot};

/// Distance of legends from the corners of the window.
const CORNER: i32 = 8;

/// Characters across a legend, and at least in a narrow side.
const ACROSS: (i32, i32) = (30, 12);

/// A colour and what it means.
type Swatch = ([u8; 3], &'static str);

/// Draws a legend in the upper corner of each side, above `bottom`.
pub(super) fn draw(
    canvas: &mut Canvas,
    session: &Session,
    snapshot: &Snapshot,
    split: Option<usize>,
    bottom: i32,
) {
    let sides = session.panes().len();
    for (index, image) in snapshot.images.iter().take(sides).enumerate() {
        let window = canvas.size().0 as i32;
        // The part of the window that the side has to itself.
        let (from, to) = match (split.map(|x| x as i32), index) {
            (None, _) => (0, window),
            (Some(x), 0) => (0, x),
            (Some(x), _) => (x, window),
        };
        box_of(canvas, session, image, index, (from, to), bottom);
    }
}

fn box_of(
    canvas: &mut Canvas,
    session: &Session,
    image: &Image,
    index: usize,
    (from, to): (i32, i32),
    bottom: i32,
) {
    // The font of the window, or else the smallest: a legend that fits with neither is left out, for
    // a part of one would mislead.
    let Some((font, inner, rows)) = [canvas.font(), &FONT_6X10].into_iter().find_map(|font| {
        let letter = width(font, "m");
        let across = ((to - from - 2 * (CORNER + MARGIN)) / letter).min(ACROSS.0);
        let rows = narrowed(contents(session, image), font, across);
        let tall = rows.len() as i32 * height(font) + 2 * MARGIN;
        let fits = across >= ACROSS.1 && bottom >= tall + 2 * CORNER;
        fits.then_some((font, across * letter, rows))
    }) else {
        return;
    };
    let (wide, row) = (inner + 2 * MARGIN, height(font));
    let tall = rows.len() as i32 * row + 2 * MARGIN;
    let x = if index == 0 { from + CORNER } else { to - CORNER - wide };
    canvas.shade(x, CORNER, wide as u32, tall as u32);
    for (at, content) in rows.iter().enumerate() {
        let (x, y) = (x + MARGIN, CORNER + MARGIN + at as i32 * row);
        match content {
            Row::Text(text) => write(canvas, font, x, y, text, TEXT),
            Row::Note(text) => write(canvas, font, x, y, text, ALERT),
            Row::Ends(low, high) => {
                write(canvas, font, x, y, low, TEXT);
                write(canvas, font, x + inner - width(font, high), y, high, TEXT);
            }
            Row::Bar(ramp) => bar(canvas, x, y + 2, inner, row - 5, ramp),
            Row::Swatches(swatches) => paint_swatches(canvas, font, x, y, swatches),
        }
    }
}

enum Row {
    Text(String),
    Note(String),
    /// Texts at both ends.
    Ends(String, String),
    Bar(Box<dyn Fn(f64) -> [u8; 3]>),
    Swatches(Vec<Swatch>),
}

/// Rows of at most so many characters: those that are longer go on in the next.
fn narrowed(rows: Vec<Row>, font: &MonoFont<'_>, across: i32) -> Vec<Row> {
    let most = across.max(1) as usize;
    let fits = |texts: [&str; 2]| texts.iter().map(|text| text.chars().count()).sum::<usize>() < most;
    let mut narrow = Vec::new();
    for row in rows {
        match row {
            Row::Text(text) => narrow.extend(wrapped(&text, most).into_iter().map(Row::Text)),
            Row::Note(text) => narrow.extend(wrapped(&text, most).into_iter().map(Row::Note)),
            Row::Ends(low, high) if !fits([&low, &high]) => {
                let ends = format!("{low} to {high}");
                narrow.extend(wrapped(&ends, most).into_iter().map(Row::Text));
            }
            Row::Swatches(swatches) => {
                let mut used = 0;
                for swatch in swatches {
                    let wide = swatch_width(font, &swatch);
                    let space = across * width(font, "m");
                    match narrow.last_mut() {
                        Some(Row::Swatches(row)) if used > 0 && used + wide <= space => {
                            row.push(swatch);
                        }
                        _ => {
                            used = 0;
                            narrow.push(Row::Swatches(vec![swatch]));
                        }
                    }
                    used += wide + 2 * MARGIN;
                }
            }
            row => narrow.push(row),
        }
    }
    narrow
}

/// Pixels of a swatch with its name.
fn swatch_width(font: &MonoFont<'_>, (_, name): &Swatch) -> i32 {
    height(font) + width(font, name)
}

fn contents(session: &Session, image: &Image) -> Vec<Row> {
    let title = image.pane.title();
    // While lines fall, all that is not true is dimmed.
    let preview = session.pace().is_full()
        && image.note.is_none()
        && image.states.contains(&LineState::Preview);
    let title = if preview { format!("{title}: preview") } else { title };
    let mut rows = vec![Row::Text(title)];
    if let Some(note) = image.note {
        rows.push(Row::Note(note.into()));
        return rows;
    }
    match image.pane.picture {
        Picture::Color => color(session, &mut rows),
        Picture::Normal => {
            rows.push(Row::Swatches(vec![
                ([255, 128, 128], "east"),
                ([128, 255, 128], "up"),
                ([128, 128, 255], "south"),
            ]));
            rows.push(Row::Text("x, y, z: -1 to 1 = 0 to 255".into()));
        }
        other => {
            if let Some(Legend { low, high, unit, logarithmic }) = image.legend {
                rows.push(Row::Bar(Box::new(move |t| other.ramp(t).unwrap_or(NOTHING))));
                rows.push(Row::Ends(figure(low), figure(high)));
                if other == Picture::Height {
                    rows.push(in_metres(session, (low, high)));
                }
                let scale = if logarithmic { ", logarithmic" } else { "" };
                rows.push(Row::Text(format!("{unit}{scale}")));
            }
            let nothing = (NOTHING, "nothing");
            match other {
                Picture::Error => {
                    rows.push(Row::Swatches(vec![(SILHOUETTE, "silhouette"), nothing]));
                }
                Picture::Height => rows.push(Row::Swatches(vec![nothing])),
                _ => {}
            }
        }
    }
    rows
}

/// The scene's own colours.
fn color(session: &Session, rows: &mut Vec<Row>) {
    let scene = session.scene();
    for surface in &scene.surfaces {
        match surface {
            Surface::Terrain(terrain) => {
                let ramp = scene.color.ramp.clone();
                let (low, high) = terrain.range();
                rows.push(Row::Bar(Box::new(move |t| picture::ramp(&ramp, t))));
                rows.push(Row::Ends(figure(low), figure(high)));
                rows.push(in_metres(session, (low, high)));
                rows.push(Row::Text("height, scene units; lit".into()));
            }
            Surface::Plane(plane) => {
                let squares = scene.color.checker.map(|color| (color, "square"));
                rows.push(Row::Swatches(squares.to_vec()));
                let side = plane.checker;
                let metres = session.measure().distance_m(side);
                let (units, metres) = (figure(side), figure(metres));
                rows.push(Row::Text(format!("of {units} scene units, {metres} m")));
            }
        }
    }
}

/// Heights in scene units, as metres.
fn in_metres(session: &Session, (low, high): (f64, f64)) -> Row {
    let [low, high] = [low, high].map(|y| format!("{} m", figure(session.measure().height_m(y))));
    Row::Ends(low, high)
}

fn bar(canvas: &mut Canvas, x: i32, y: i32, wide: i32, tall: i32, ramp: &dyn Fn(f64) -> [u8; 3]) {
    for column in 0..wide {
        let [r, g, b] = ramp(f64::from(column) / f64::from((wide - 1).max(1)));
        canvas.fill(x + column, y, 1, tall as u32, Rgb888::new(r, g, b));
    }
}

fn paint_swatches(
    canvas: &mut Canvas,
    font: &MonoFont<'_>,
    mut x: i32,
    y: i32,
    swatches: &[Swatch],
) {
    let side = height(font) - 5;
    for ([r, g, b], name) in swatches {
        // A frame, so that dark colours are seen on the dark ground.
        canvas.fill(x, y + 1, side as u32 + 2, side as u32 + 2, TEXT);
        canvas.fill(x + 1, y + 2, side as u32, side as u32, Rgb888::new(*r, *g, *b));
        write(canvas, font, x + side + 2 + 3, y, name, TEXT);
        x += swatch_width(font, &([*r, *g, *b], name)) + 2 * MARGIN;
    }
}

/// A number of about four digits.
pub(super) fn figure(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        format!("{value:.2e}")
    } else if value.fract() == 0.0 {
        format!("{value:.0}")
    } else if size >= 100.0 {
        format!("{value:.1}")
    } else if size >= 1.0 {
        format!("{value:.2}")
    } else {
        format!("{value:.4}")
    }
}
