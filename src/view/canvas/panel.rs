//! Text on a darkened ground.

use embedded_graphics::mono_font::{MonoFont, MonoTextStyle};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::{Drawable, Point};
use embedded_graphics::text::{Baseline, Text};

use super::Canvas;

/// Space around text, pixels.
pub(super) const MARGIN: i32 = 5;

/// Width of a text.
pub(super) fn width(font: &MonoFont<'_>, text: &str) -> i32 {
    let advance = font.character_size.width + font.character_spacing;
    text.chars().count() as i32 * advance as i32
}

/// Height of a line of text.
pub(super) fn height(font: &MonoFont<'_>) -> i32 {
    font.character_size.height as i32 + 2
}

/// Writes a text with its top left corner at a place.
pub(super) fn write(
    canvas: &mut Canvas,
    font: &MonoFont<'_>,
    x: i32,
    y: i32,
    text: &str,
    color: Rgb888,
) {
    let style = MonoTextStyle::new(font, color);
    let Ok(_) = Text::with_baseline(text, Point::new(x, y), style, Baseline::Top).draw(canvas);
}

/// Items in rows of at most `space` pixels, an item never parted unless it is longer than that.
pub(super) fn rows(font: &MonoFont<'_>, items: &[String], gap: &str, space: i32) -> Vec<String> {
    let most = (space / width(font, "m").max(1)).max(1) as usize;
    let mut rows: Vec<String> = Vec::new();
    for item in items {
        match rows.last_mut() {
            Some(row) if row.chars().count() + gap.len() + item.chars().count() <= most => {
                row.push_str(gap);
                row.push_str(item);
            }
            _ => rows.extend(wrapped(item, most)),
        }
    }
    rows
}

/// A text in rows of at most `most` characters, parted at spaces where there are any.
pub(super) fn wrapped(text: &str, most: usize) -> Vec<String> {
    let mut rows = vec![String::new()];
    for word in text.split(' ') {
        let mut word: String = word.to_owned();
        let row = rows.last_mut().unwrap_or_else(|| unreachable!("there is one row"));
        let used = row.chars().count();
        if used > 0 && used + 1 + word.chars().count() <= most {
            row.push(' ');
            row.push_str(&word);
            continue;
        }
        if used > 0 {
            rows.push(String::new());
        }
        while word.chars().count() > most {
            let head: String = word.chars().take(most).collect();
            word = word.chars().skip(most).collect();
            let last = rows.len() - 1;
            rows[last] = head;
            rows.push(String::new());
        }
        let last = rows.len() - 1;
        rows[last] = word;
    }
    rows
}
