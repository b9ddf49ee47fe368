//! Everything that is seen, as one picture: the panes enlarged by whole numbers, the split, the
//! scan, legends, status, help.

mod help;
mod legend;
mod panel;
mod status;

use std::convert::Infallible;

use embedded_graphics::Pixel;
use embedded_graphics::mono_font::MonoFont;
use embedded_graphics::mono_font::iso_8859_1::{FONT_6X10, FONT_7X13, FONT_10X20};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::prelude::{Dimensions, DrawTarget, Point, Primitive, Size};
use embedded_graphics::primitives::{PrimitiveStyle, Rectangle, StyledDrawable, Triangle};

use super::layout::Layout;
use super::session::Session;
use super::snapshot::{BLANK, Image, LineState, Snapshot};

/// Colour beside the raster, where the window is no multiple of it.
const BESIDE: [u8; 3] = [0, 0, 0];

/// Colour of marks: split, scan line.
const MARK: Rgb888 = Rgb888::new(255, 214, 64);

/// Colour of text.
const TEXT: Rgb888 = Rgb888::new(236, 236, 236);

/// Colour of text that wants to be read.
const ALERT: Rgb888 = Rgb888::new(255, 170, 120);

/// A picture to draw on, as windows take it: 0x00RRGGBB, line by line from the top.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<u32>,
}

impl Canvas {
    /// Pixels across and down.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// 0x00RRGGBB, line by line from the top.
    #[must_use]
    pub fn pixels(&self) -> &[u32] {
        &self.pixels
    }

    /// The picture as sRGB bytes, line by line.
    #[must_use]
    pub fn bytes(&self) -> Vec<[u8; 3]> {
        self.pixels
            .iter()
            .map(|pixel| [(pixel >> 16) as u8, (pixel >> 8) as u8, *pixel as u8])
            .collect()
    }

    /// Draws what is shown of a session. Wall times are left out unless `timed`.
    pub fn compose(&mut self, session: &Session, snapshot: &Snapshot, timed: bool) {
        let layout = session.layout();
        (self.width, self.height) = (layout.width, layout.height);
        self.pixels.clear();
        self.pixels.resize(self.width * self.height, packed(BESIDE));
        let split = session.split().map(|place| layout.across(place));
        self.raster(&layout, snapshot, split);
        if let Some(x) = split {
            self.split_line(&layout, x);
        }
        if let Some(line) = snapshot.scan {
            self.scan(&layout, snapshot, line);
        }
        if session.shows_panels() {
            let bottom = status::draw(self, session, snapshot, timed);
            legend::draw(self, session, snapshot, split, bottom);
        }
        if session.shows_help() {
            help::draw(self, session.help_page());
        }
    }

    fn raster(&mut self, layout: &Layout, snapshot: &Snapshot, split: Option<usize>) {
        let [left, right] = [0, 1].map(|i| snapshot.images.get(i).or(snapshot.images.first()));
        let boundary = split.map_or(layout.width, |x| x.clamp(layout.left, layout.width));
        let end = (layout.left + layout.columns * layout.scale).min(layout.width);
        let mut row = vec![packed(BLANK); layout.columns];
        for line in 0..layout.lines {
            let top = layout.top + line * layout.scale;
            for (image, from, to) in
                [(left, layout.left, boundary.min(end)), (right, boundary, end)]
            {
                let Some(image) = image.filter(|_| from < to) else { continue };
                enlarge(image, line, layout, snapshot.by_lines, &mut row);
                for y in (top..top + layout.scale).take_while(|&y| y < self.height) {
                    let out = &mut self.pixels[y * self.width..][from..to];
                    for (x, pixel) in (from..).zip(out) {
                        *pixel = row[(x - layout.left) / layout.scale];
                    }
                }
            }
        }
    }

    fn split_line(&mut self, layout: &Layout, x: usize) {
        let (x, top) = (x as i32, layout.top as i32);
        let tall = (layout.lines * layout.scale) as u32;
        self.fill(x - 1, top, 3, tall, Rgb888::BLACK);
        self.fill(x, top, 1, tall, MARK);
        let middle = top + tall as i32 / 2;
        for side in [-1, 1] {
            let tip = Point::new(x + side * 12, middle);
            let base = [-6, 6].map(|dy| Point::new(x + side * 5, middle + dy));
            self.shape(&Triangle::new(tip, base[0], base[1]), MARK);
        }
    }

    fn scan(&mut self, layout: &Layout, snapshot: &Snapshot, line: u32) {
        let lines = snapshot.images.first().map_or(0, |image| image.lines).max(1);
        let place = (line as usize).min(lines) * layout.lines * layout.scale / lines;
        let y = (layout.top + place) as i32;
        let (left, width) = (layout.left as i32, layout.columns * layout.scale);
        if snapshot.by_lines && (line as usize) < lines {
            self.fill(left, y, width as u32, 1, MARK);
        }
        for (edge, side) in [(left, 1), (left + width as i32 - 1, -1)] {
            let base = [-5, 5].map(|dy| Point::new(edge, y + dy));
            self.shape(&Triangle::new(Point::new(edge + side * 9, y), base[0], base[1]), MARK);
        }
    }

    fn fill(&mut self, x: i32, y: i32, width: u32, height: u32, color: Rgb888) {
        self.shape(&Rectangle::new(Point::new(x, y), Size::new(width, height)), color);
    }

    fn shape<S>(&mut self, shape: &S, color: Rgb888)
    where
        S: Primitive + StyledDrawable<PrimitiveStyle<Rgb888>, Color = Rgb888>,
    {
        let Ok(_) = shape.draw_styled(&PrimitiveStyle::with_fill(color), self);
    }

    /// Darkens a rectangle so that text can be read on it.
    fn shade(&mut self, x: i32, y: i32, width: u32, height: u32) {
        let part = |from: i32, length: u32, all: usize| {
            let end = i64::from(from) + i64::from(length);
            (from.max(0) as usize).min(all)..(end.max(0) as usize).min(all)
        };
        let columns = part(x, width, self.width);
        for row in part(y, height, self.height) {
            for pixel in &mut self.pixels[row * self.width..][columns.clone()] {
                // A quarter of every channel, on nearly black.
                *pixel = ((*pixel >> 2) & 0x003f_3f3f) + 0x000a_0a0c;
            }
        }
    }

    /// The font that fits the window.
    fn font(&self) -> &'static MonoFont<'static> {
        match (self.width, self.height) {
            (1600.., 1200..) => &FONT_10X20,
            (420.., 300..) => &FONT_7X13,
            _ => &FONT_6X10,
        }
    }
}

/// A raster line of an image, one value per column of the layout.
fn enlarge(image: &Image, line: usize, layout: &Layout, by_lines: bool, row: &mut [u32]) {
    // Image and layout differ for the moment between a new window size and its first frame.
    let from = line * image.lines / layout.lines.max(1);
    let Some(pixels) = image.pixels.get(from * image.columns..(from + 1) * image.columns) else {
        row.fill(packed(BLANK));
        return;
    };
    let dim = by_lines && image.states.get(from) != Some(&LineState::Drawn);
    for (column, out) in row.iter_mut().enumerate() {
        let pixel = packed(pixels[column * image.columns / layout.columns]);
        // Two fifths or so: it is clearly not the picture, and can be seen all the same.
        *out =
            if dim { ((pixel >> 2) & 0x003f_3f3f) + ((pixel >> 3) & 0x001f_1f1f) } else { pixel };
    }
}

fn packed([red, green, blue]: [u8; 3]) -> u32 {
    u32::from_be_bytes([0, red, green, blue])
}

impl Dimensions for Canvas {
    fn bounding_box(&self) -> Rectangle {
        Rectangle::new(Point::zero(), Size::new(self.width as u32, self.height as u32))
    }
}

impl DrawTarget for Canvas {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<Rgb888>>,
    {
        for Pixel(at, color) in pixels {
            let (Ok(x), Ok(y)) = (usize::try_from(at.x), usize::try_from(at.y)) else { continue };
            if x < self.width && y < self.height {
                self.pixels[y * self.width + x] = packed([color.r(), color.g(), color.b()]);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
