//! Where the raster lies in the window: enlarged by a whole number, in the middle.

/// Places of the raster and of its pixels in a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Window, pixels across.
    pub width: usize,
    /// Window, pixels down.
    pub height: usize,
    /// Window pixels per raster pixel, in both directions.
    pub scale: usize,
    /// Raster, pixels across.
    pub columns: usize,
    /// Raster, lines.
    pub lines: usize,
    /// Window column of the raster's left edge.
    pub left: usize,
    /// Window line of the raster's top edge.
    pub top: usize,
}

impl Layout {
    /// The largest raster that fits the window at a scale; of one pixel at least.
    #[must_use]
    pub fn new(width: usize, height: usize, scale: usize) -> Self {
        let scale = scale.max(1);
        let fit = |side: usize| (side / scale).max(1);
        let (columns, lines) = (fit(width), fit(height));
        let margin = |side: usize, pixels: usize| side.saturating_sub(pixels * scale) / 2;
        Self {
            width,
            height,
            scale,
            columns,
            lines,
            left: margin(width, columns),
            top: margin(height, lines),
        }
    }

    /// Raster pixel (column, line) at a place of the window.
    #[must_use]
    pub fn pixel(&self, x: i32, y: i32) -> Option<(u32, u32)> {
        let place = |at: i32, side: usize, start: usize, count: usize| {
            let at = usize::try_from(at).ok().filter(|&at| at < side)?;
            let pixel = at.checked_sub(start)? / self.scale;
            (pixel < count).then_some(pixel as u32)
        };
        let column = place(x, self.width, self.left, self.columns)?;
        Some((column, place(y, self.height, self.top, self.lines)?))
    }

    /// Window column of a place across the raster, 0..=1.
    #[must_use]
    pub fn across(&self, share: f64) -> usize {
        self.left + (share * (self.columns * self.scale) as f64).round() as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_raster_pixel_is_a_square_of_the_window() {
        for (width, height, scale) in [(640, 480, 1), (641, 483, 3), (7, 5, 2), (1, 1, 4)] {
            let layout = Layout::new(width, height, scale);
            let mut counts = vec![0; layout.columns * layout.lines];
            for y in 0..height as i32 {
                for x in 0..width as i32 {
                    if let Some((column, line)) = layout.pixel(x, y) {
                        counts[line as usize * layout.columns + column as usize] += 1;
                    }
                }
            }
            let whole = (scale * scale).min(width * height);
            assert!(counts.iter().all(|&count| count == whole), "{layout:?}");
            assert_eq!(layout.pixel(-1, 0), None);
            assert_eq!(layout.pixel(0, height as i32), None);
        }
    }

    #[test]
    fn the_rest_of_a_division_is_left_on_both_sides() {
        let layout = Layout::new(105, 64, 10);
        assert_eq!((layout.columns, layout.lines, layout.left, layout.top), (10, 6, 2, 2));
        assert_eq!((layout.pixel(1, 2), layout.pixel(2, 2)), (None, Some((0, 0))));
        assert_eq!((layout.across(0.0), layout.across(1.0)), (2, 102));
    }
}
