//! The keys, over everything else.

use super::panel::{MARGIN, height, width, wrapped, write};
use super::{Canvas, MARK, TEXT};

/// Keys and what they do, as docs/window.md has them.
pub(super) const KEYS: [(&str, &str); 32] = [
    ("drag", "turn: the scene follows the mouse"),
    ("right drag", "orbit around the middle; wheel: nearer, farther"),
    ("wheel", "zoom; with Shift: move along the line of sight"),
    ("W S  A D", "fly forward, back, left, right; Shift: faster"),
    ("E Q", "climb, sink"),
    ("arrows", "turn; Shift with left, right: roll"),
    ("click, X", "explain the pixel under the cursor in the terminal"),
    ("1 2 3", "colour, height, normal"),
    ("4 5 6", "steps, error against the oracle, cycles"),
    ("7", "errors: total, algorithm, quantisation"),
    ("8 9 0", "range of errors: finer, coarser, as needed"),
    ("G", "engine: fast, processor, real, oracle"),
    ("/", "split; drag it"),
    ("Shift+1..7", "picture right of the split"),
    ("Shift+G", "engine right of the split"),
    ("K", "kernel: cosine, parabola, exponential, hat"),
    ("J", "deformation 0, 1, 2"),
    ("[ ]", "weight of deformation 2: 2^-d"),
    ("V  Shift+V", "heights: more, less exaggerated"),
    ("L  Shift+L", "sun: clockwise, back"),
    ("O  Shift+O", "sun: higher, lower"),
    ("P  Shift+P", "colours: next, previous ramp"),
    ("+ -", "speed of the scan"),
    ("Space", "pause the scan, go on"),
    (".", "one line"),
    ("Home, R", "back to the scene's camera and field of view"),
    ("F", "frame the whole map, looking as now"),
    ("Shift+S", "save the window as PNG"),
    ("C", "print the scene as TOML"),
    ("PageDown, Up", "more of this help, or of the status line"),
    ("Tab", "legends and status on, off"),
    ("H  Esc", "this help; quit"),
];

/// Draws the keys in the middle of the window, on as many pages as it takes; `page` counts on from one
/// to the next, round and round.
pub(super) fn draw(canvas: &mut Canvas, page: i32) {
    let font = canvas.font();
    let (row, letter) = (height(font), width(font, "m"));
    let (wide, tall) = (canvas.size().0 as i32, canvas.size().1 as i32);
    let inside = |length: i32, unit: i32| ((length - 4 * MARGIN) / unit).max(1) as usize;
    let pages = pages(inside(wide, letter), inside(tall, row));
    let Some(lines) = pages.get(page.rem_euclid(pages.len() as i32) as usize) else { return };
    let means = lines.iter().map(|(_, means)| width(font, means)).max().unwrap_or_default();
    let at = key_column() as i32 * letter;
    let (across, down) = (at + means + 4 * MARGIN, lines.len() as i32 * row + 4 * MARGIN);
    let (x, y) = (((wide - across) / 2).max(0), ((tall - down) / 2).max(0));
    // Twice as dark as other panels: it lies over them.
    canvas.shade(x, y, across as u32, down as u32);
    canvas.shade(x, y, across as u32, down as u32);
    for (line, (key, means)) in lines.iter().enumerate() {
        let (x, y) = (x + 2 * MARGIN, y + 2 * MARGIN + line as i32 * row);
        write(canvas, font, x, y, key, MARK);
        write(canvas, font, x + at, y, means, TEXT);
    }
}

/// Characters from the left to what the keys do.
fn key_column() -> usize {
    KEYS.iter().map(|(key, _)| key.chars().count()).max().unwrap_or_default() + 2
}

/// A key and what it does, or more of that under an empty key.
type Line = (&'static str, String);

/// The keys on pages of so many characters across and rows down; where there are several, the last
/// row says so.
pub(super) fn pages(across: usize, down: usize) -> Vec<Vec<Line>> {
    let room = across.saturating_sub(key_column()).max(1);
    let entries: Vec<Vec<Line>> = KEYS
        .iter()
        .map(|(key, means)| {
            let rows = wrapped(means, room).into_iter().enumerate();
            rows.map(|(row, text)| (if row == 0 { *key } else { "" }, text)).collect()
        })
        .collect();
    if entries.iter().map(Vec::len).sum::<usize>() <= down {
        return vec![entries.concat()];
    }
    let most = down.saturating_sub(1).max(1);
    let mut pages: Vec<Vec<Line>> = vec![Vec::new()];
    for entry in entries {
        let last = pages.len() - 1;
        if !pages[last].is_empty() && pages[last].len() + entry.len() > most {
            pages.push(entry);
        } else {
            pages[last].extend(entry);
        }
    }
    let count = pages.len();
    for (page, lines) in pages.iter_mut().enumerate() {
        lines.push(("PageDown", format!("{} of {count}", page + 1)));
    }
    pages
}
