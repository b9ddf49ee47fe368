//! The keys, over everything else.

use super::panel::{MARGIN, height, width, write};
use super::{Canvas, MARK, TEXT};

/// Keys and what they do, as docs/window.md has them.
pub(super) const KEYS: [(&str, &str); 29] = [
    ("drag", "turn: the scene follows the mouse"),
    ("right drag", "orbit around the middle; wheel: nearer, farther"),
    ("wheel", "zoom; with Shift: move along the line of sight"),
    ("W S  A D", "fly forward, back, left, right; Shift: faster"),
    ("E Q", "climb, sink"),
    ("arrows", "turn; Shift with left, right: roll"),
    ("click, X", "explain the pixel under the cursor in the terminal"),
    ("1 2 3", "colour, height, normal"),
    ("4 5 6", "steps, error against the oracle, cycles"),
    ("G", "engine: fast, processor, real, oracle"),
    ("/", "split; drag it"),
    ("Shift+1..6", "picture right of the split"),
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
    ("Tab", "legends and status on, off"),
    ("H  Esc", "this help; quit"),
];

/// Draws the keys in the middle of the window, as many as it holds.
pub(super) fn draw(canvas: &mut Canvas) {
    let font = canvas.font();
    let row = height(font);
    let column = |texts: &mut dyn Iterator<Item = &str>| {
        texts.map(|text| width(font, text)).max().unwrap_or_default()
    };
    let keys = column(&mut KEYS.iter().map(|(key, _)| *key));
    let means = column(&mut KEYS.iter().map(|(_, means)| *means));
    let gap = 2 * width(font, "m");
    let (wide, tall) = (keys + gap + means + 4 * MARGIN, KEYS.len() as i32 * row + 4 * MARGIN);
    let (width, height) = (canvas.size().0 as i32, canvas.size().1 as i32);
    let (x, y) = (((width - wide) / 2).max(0), ((height - tall) / 2).max(0));
    // Twice as dark as other panels: it lies over them.
    canvas.shade(x, y, wide as u32, tall as u32);
    canvas.shade(x, y, wide as u32, tall as u32);
    for (at, (key, means)) in KEYS.iter().enumerate() {
        let y = y + 2 * MARGIN + at as i32 * row;
        write(canvas, font, x + 2 * MARGIN, y, key, MARK);
        write(canvas, font, x + 2 * MARGIN + keys + gap, y, means, TEXT);
    }
}
