//! Pictures of buffers: what a frame knows about its pixels, as colours.
//!
//! Every function takes plain slices, one value per pixel, and gives one sRGB triple per pixel
//! with the range that its ramp stands for. Pixels without a value are [`NOTHING`].

pub mod errors;

use crate::engine::Band;
use errors::{ErrorView, error};

/// Colour of a pixel without a value (a miss): a dark neutral grey that no ramp passes through.
pub const NOTHING: [u8; 3] = [56, 56, 56];

/// Colour of a silhouette pixel in a picture of errors.
pub const SILHOUETTE: [u8; 3] = [255, 0, 255];

/// What a picture shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Picture {
    /// The frame itself.
    #[default]
    Color,
    /// Height of the ground that is seen.
    Height,
    /// Normal of the ground that is seen.
    Normal,
    /// Index of the sample that hit.
    Steps,
    /// Distance to the oracle's ground point, in pixels.
    Error,
    /// Clock cycles spent on a pixel.
    Cycles,
}

/// What the two ends of a ramp stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Legend {
    /// Value at the dark end; smaller values have the same colour.
    pub low: f64,
    /// Value at the bright end; larger values have the same colour.
    pub high: f64,
    /// Unit of both.
    pub unit: &'static str,
    /// The ramp is even in the logarithm of the value.
    pub logarithmic: bool,
}

/// A picture and its legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Painted {
    /// sRGB bytes, in the order of the values.
    pub pixels: Vec<[u8; 3]>,
    /// `None` for colours as they are, and when no pixel has a value.
    pub legend: Option<Legend>,
}

impl Picture {
    /// All pictures, in the order of the window's keys 1 to 6.
    pub const ALL: [Self; 6] =
        [Self::Color, Self::Height, Self::Normal, Self::Steps, Self::Error, Self::Cycles];

    /// Name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Color => "color",
            Self::Height => "height",
            Self::Normal => "normal",
            Self::Steps => "steps",
            Self::Error => "error",
            Self::Cycles => "cycles",
        }
    }

    /// True if the picture is drawn from [`buffers`](crate::frame::Frame::buffers).
    pub fn needs_buffers(self) -> bool {
        matches!(self, Self::Height | Self::Normal | Self::Steps)
    }

    /// Colour at place `t`, 0..=1, between the two ends of the picture's ramp; `None` where its
    /// colours are no ramp.
    pub fn ramp(self, t: f64) -> Option<[u8; 3]> {
        match self {
            Self::Color | Self::Normal => None,
            Self::Height => Some(ramp(&ELEVATION, t)),
            Self::Steps | Self::Error | Self::Cycles => Some(ramp(&SEQUENCE, t)),
        }
    }

    /// The picture of what was drawn or measured, of errors in all; `None` if it lacks what the picture
    /// shows.
    #[must_use]
    pub fn of(self, band: &Band) -> Option<Painted> {
        self.with(band, ErrorView::default())
    }

    /// The same, with errors shown so.
    #[must_use]
    pub fn with(self, band: &Band, view: ErrorView) -> Option<Painted> {
        let buffers = band.frame.buffers.as_ref();
        Some(match self {
            Self::Color => Painted { pixels: band.frame.color.clone(), legend: None },
            Self::Height => height(&buffers?.height),
            Self::Normal => normal(&buffers?.normal),
            Self::Steps => steps(&buffers?.steps),
            Self::Error if !band.errors.is_empty() => {
                let errors: Vec<f64> = band.errors.iter().map(|&e| view.part.of(e)).collect();
                error(&errors, &band.silhouettes, view.high)
            }
            Self::Cycles if !band.cycles.is_empty() => cycles(&band.cycles),
            Self::Error | Self::Cycles => return None,
        })
    }
}

/// Heights in scene units, from the lowest to the highest finite one; others are [`NOTHING`].
pub fn height(heights: &[f64]) -> Painted {
    let (low, high) = heights
        .iter()
        .filter(|h| h.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &h| (low.min(h), high.max(h)));
    let pixels = heights
        .iter()
        .map(|&h| if h.is_finite() { ramp(&ELEVATION, share(h, low, high)) } else { NOTHING })
        .collect();
    let legend =
        (low <= high).then_some(Legend { low, high, unit: "scene units", logarithmic: false });
    Painted { pixels, legend }
}

/// Unit normals as `(n + 1) / 2 * 255`, x red, y green, z blue; a normal with a component that is
/// not finite is [`NOTHING`].
pub fn normal(normals: &[[f64; 3]]) -> Painted {
    let pixels = normals
        .iter()
        .map(|n| {
            if n.iter().all(|c| c.is_finite()) {
                n.map(|c| byte((c + 1.0) / 2.0 * 255.0))
            } else {
                NOTHING
            }
        })
        .collect();
    let legend = Some(Legend { low: -1.0, high: 1.0, unit: "normal", logarithmic: false });
    Painted { pixels, legend }
}

/// Step indices, from 0 to the 99.5th percentile of those that are not 0.
pub fn steps(steps: &[u32]) -> Painted {
    counts(steps, "steps")
}

/// Clock cycles per pixel, from 0 to the 99.5th percentile of those that are not 0.
pub fn cycles(cycles: &[u32]) -> Painted {
    counts(cycles, "cycles")
}

fn counts(counts: &[u32], unit: &'static str) -> Painted {
    let high = percentile(counts);
    let pixels = counts
        .iter()
        .map(|&n| ramp(&SEQUENCE, if n == 0 { 0.0 } else { share(n.into(), 0.0, high.into()) }))
        .collect();
    let legend = (!counts.is_empty()).then_some(Legend {
        low: 0.0,
        high: high.into(),
        unit,
        logarithmic: false,
    });
    Painted { pixels, legend }
}

/// Nearest-rank 99.5th percentile of the counts that are not 0; 0 without any.
fn percentile(counts: &[u32]) -> u32 {
    let mut counts: Vec<u32> = counts.iter().copied().filter(|&n| n > 0).collect();
    // ceil(0.995 n) - 1, in integers.
    let Some(rank) = counts.len().checked_sub(counts.len() / 200 + 1) else { return 0 };
    *counts.select_nth_unstable(rank).1
}

/// Place of a value between two others; the middle if they are equal.
fn share(value: f64, low: f64, high: f64) -> f64 {
    // Halved, so that no difference overflows.
    let span = high / 2.0 - low / 2.0;
    if span > 0.0 { (value / 2.0 - low / 2.0) / span } else { 0.5 }
}

/// Black over purple, blue and green to yellow; each colour lighter than the one before.
const SEQUENCE: [[u8; 3]; 8] = [
    [4, 2, 14],
    [52, 12, 84],
    [72, 48, 136],
    [52, 96, 148],
    [32, 140, 142],
    [62, 184, 108],
    [156, 216, 58],
    [254, 236, 42],
];

/// Deep blue over green and sand to near white; each colour lighter than the one before.
const ELEVATION: [[u8; 3]; 6] =
    [[18, 36, 86], [22, 86, 104], [56, 130, 88], [150, 158, 80], [222, 184, 122], [253, 240, 222]];

/// Colour at place `t` of a ramp, clamped to 0..=1, between evenly spaced sRGB colours.
pub fn ramp(colors: &[[u8; 3]], t: f64) -> [u8; 3] {
    let last = colors.len() - 1;
    let place = t.clamp(0.0, 1.0) * last as f64;
    let below = (place as usize).min(last - 1);
    let part = place - below as f64;
    let (from, to) = (colors[below], colors[below + 1]);
    std::array::from_fn(|c| {
        let (from, to) = (f64::from(from[c]), f64::from(to[c]));
        byte(from + (to - from) * part)
    })
}

/// Rounded and clamped to a byte.
fn byte(value: f64) -> u8 {
    value.clamp(0.0, 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::ErrorParts;

    /// Relative luminance of an sRGB colour.
    fn luminance(color: [u8; 3]) -> f64 {
        let [r, g, b] = color.map(|c| (f64::from(c) / 255.0).powf(2.2));
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    #[test]
    fn ramps_grow_lighter_and_never_pass_through_grey() {
        for colors in [&SEQUENCE[..], &ELEVATION[..]] {
            let steps: Vec<_> = (0..=200).map(|i| ramp(colors, f64::from(i) / 200.0)).collect();
            assert!(steps.windows(2).all(|w| luminance(w[0]) < luminance(w[1])));
            assert!(!steps.contains(&NOTHING) && !steps.contains(&SILHOUETTE));
            assert_eq!(steps[0], colors[0]);
            assert_eq!(steps[200], colors[colors.len() - 1]);
        }
    }

    #[test]
    fn heights_span_the_finite_ones() {
        let painted = height(&[2.0, f64::NAN, -1.0, f64::INFINITY, 0.5]);
        let legend = painted.legend.unwrap();
        assert_eq!((legend.low, legend.high, legend.unit), (-1.0, 2.0, "scene units"));
        assert_eq!(painted.pixels[0], ELEVATION[5]);
        assert_eq!(painted.pixels[1], NOTHING);
        assert_eq!(painted.pixels[2], ELEVATION[0]);
        assert_eq!(painted.pixels[3], NOTHING);
        assert_eq!(painted.pixels[4], ramp(&ELEVATION, 0.5));

        let flat = height(&[3.0, 3.0]);
        assert_eq!(flat.legend.map(|l| (l.low, l.high)), Some((3.0, 3.0)));
        assert_eq!(flat.pixels[0], ramp(&ELEVATION, 0.5));

        let wide = height(&[-f64::MAX, 0.0, f64::MAX]);
        assert_eq!(wide.pixels, [ELEVATION[0], ramp(&ELEVATION, 0.5), ELEVATION[5]]);

        assert_eq!(height(&[f64::NAN]), Painted { pixels: vec![NOTHING], legend: None });
        assert_eq!(height(&[]), Painted { pixels: vec![], legend: None });
    }

    #[test]
    fn normals_map_to_bytes() {
        let painted = normal(&[[0.0, 1.0, -1.0], [f64::NAN; 3], [1.5, -2.0, 0.2]]);
        assert_eq!(painted.pixels, [[128, 255, 0], NOTHING, [255, 0, 153]]);
    }

    #[test]
    fn counts_end_at_the_percentile_of_those_that_count() {
        let mut values = vec![0; 10_000];
        values.extend(1..=1000);
        let painted = steps(&values);
        let legend = painted.legend.unwrap();
        assert_eq!((legend.low, legend.high, legend.unit), (0.0, 995.0, "steps"));
        assert_eq!(painted.pixels[0], SEQUENCE[0]);
        assert_eq!(painted.pixels[10_994], SEQUENCE[7]);
        assert_eq!(painted.pixels[10_999], SEQUENCE[7]);

        assert_eq!(cycles(&[7]).legend.unwrap().high, 7.0);
        let none = cycles(&[0, 0]);
        assert_eq!((none.legend.unwrap().high, none.pixels[1]), (0.0, SEQUENCE[0]));
        assert_eq!(cycles(&[]).legend, None);
    }

    #[test]
    #[cfg(feature = "cli")]
    fn names_are_those_of_the_command_line() {
        use clap::ValueEnum as _;
        for picture in Picture::ALL {
            let value = picture.to_possible_value().unwrap();
            assert_eq!(value.get_name(), picture.name());
        }
    }

    #[test]
    fn a_band_gives_what_it_has() {
        let mut band = Band::default();
        band.frame.color = vec![[1, 2, 3]];
        let given = |band: &Band| Picture::ALL.map(|p| p.of(band).is_some());
        assert_eq!(given(&band), [true, false, false, false, false, false]);
        band.frame.buffers = Some(Default::default());
        assert_eq!(given(&band), [true, true, true, true, false, false]);
        let parts = ErrorParts { total: 0.5, algorithm: 2.0, quantisation: 8.0 };
        (band.errors, band.silhouettes, band.cycles) = (vec![parts], vec![false], vec![1]);
        assert_eq!(given(&band), [true; 6]);
        assert_eq!(Picture::Color.of(&band).unwrap().pixels, [[1, 2, 3]]);
    }
}
