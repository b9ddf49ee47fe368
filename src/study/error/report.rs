//! Errors summed up.

use serde::Serialize;

use super::{PixelError, Sample, Sheet, Suspects};
use crate::frame::Hit;

/// Median, 99.9th percentile and maximum of a quantity over the pixels that have it.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Spread {
    /// Half of the pixels are at most this; infinite (null in JSON) where that takes a lost one.
    pub median: f64,
    /// 99.9 % are at most this; infinite (null in JSON) where that takes a lost one.
    pub p999: f64,
    /// The largest finite value; NaN (null in JSON) where there is none.
    pub max: f64,
}

impl Spread {
    /// Of all values but NaN; `None` where there are none.
    pub fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.filter(|v| !v.is_nan()).collect();
        if values.is_empty() {
            return None;
        }
        values.sort_by(f64::total_cmp);
        let at = |share: f64| {
            // The smallest value that at least this share of all values does not exceed.
            let rank = (share * values.len() as f64).ceil() as usize;
            values[rank.max(1) - 1]
        };
        let max = values.iter().rev().find(|value| value.is_finite());
        Some(Self { median: at(0.5), p999: at(0.999), max: max.copied().unwrap_or(f64::NAN) })
    }
}

/// Pixels by outcome.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Outcomes {
    /// All of them.
    pub total: usize,
    /// The surface; of lost pixels, another sheet of it.
    pub surface: usize,
    /// A side of the map or of a hole.
    pub side: usize,
    /// Sky.
    pub sky: usize,
    /// Out of range.
    pub out_of_range: usize,
}

impl Outcomes {
    fn add(&mut self, hit: Hit) {
        self.total += 1;
        *match hit {
            Hit::Surface => &mut self.surface,
            Hit::Side => &mut self.side,
            Hit::Sky => &mut self.sky,
            Hit::OutOfRange => &mut self.out_of_range,
        } += 1;
    }
}

/// What machine and oracle say of some pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// All of them.
    pub pixels: usize,
    /// Reference pixels: those in which the oracle sees the surface, on the same sheet or lost.
    pub reference: usize,
    /// Both on one sheet.
    pub same_sheet: usize,
    /// Lost pixels, by what the machine shows instead.
    pub lost: Outcomes,
    /// Ghosts, by what the oracle sees instead of surface.
    pub ghosts: Outcomes,
    /// Pixels without surface in which the two differ, by what the machine shows.
    pub flips: Outcomes,
}

impl Counts {
    /// Counts pixels.
    pub fn of(pixels: &[PixelError]) -> Self {
        let mut counts = Self { pixels: pixels.len(), ..Self::default() };
        for pixel in pixels {
            match pixel.sheet {
                Sheet::Empty => {}
                Sheet::Same => counts.same_sheet += 1,
                Sheet::Lost => counts.lost.add(pixel.machine),
                Sheet::Ghost => counts.ghosts.add(pixel.oracle),
                Sheet::Flip => counts.flips.add(pixel.machine),
            }
        }
        counts.reference = counts.same_sheet + counts.lost.total;
        counts
    }
}

/// The pixel to look at first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// Column from the left.
    pub column: u32,
    /// Line from the top.
    pub line: u32,
    /// Which kind of pixel.
    pub sheet: Sheet,
    /// What the machine shows.
    pub machine: Hit,
    /// What the oracle sees.
    pub oracle: Hit,
    /// Error in pixels where both are on one sheet.
    pub error_px: Option<f64>,
    /// Largest difference of a channel, 0..=255.
    color: u8,
}

impl Worst {
    /// A lost pixel, else a ghost, else the one with the largest error, else any that differs; of
    /// several, that whose colour is off most, and of these the first.
    fn of(pixels: &[PixelError]) -> Option<Self> {
        pixels.iter().filter(|pixel| pixel.sheet != Sheet::Empty).map(Self::from).reduce(Self::or)
    }

    /// The worse of two, the first of equals.
    fn or(self, other: Self) -> Self {
        let key = |worst: &Self| match (worst.sheet, f64::from(worst.color)) {
            (Sheet::Lost, color) => (3, color),
            (Sheet::Ghost, color) => (2, color),
            (Sheet::Same, _) => (1, worst.error_px.unwrap_or_default()),
            (Sheet::Flip | Sheet::Empty, color) => (0, color),
        };
        if key(&other) > key(&self) { other } else { self }
    }
}

impl From<&PixelError> for Worst {
    fn from(pixel: &PixelError) -> Self {
        let &PixelError { column, line, sheet, machine, oracle, total_px, color, .. } = pixel;
        let error_px = Some(total_px).filter(|error| error.is_finite());
        Self { column, line, sheet, machine, oracle, error_px, color }
    }
}

/// What suspects add to a sample.
#[derive(Clone, Debug, Serialize)]
pub struct SuspectReport {
    /// How many were chosen at rims.
    pub rims: usize,
    /// How many were chosen for their distance.
    pub far: usize,
    /// What machine and oracle say of them.
    #[serde(flatten)]
    pub counts: Counts,
}

/// Errors over a sample, and over suspects where there are any. Quantiles are those of the sample
/// over its reference pixels, in which a lost pixel is infinitely far off; maxima are those of both.
#[derive(Clone, Debug, Serialize)]
pub struct ErrorReport {
    /// Lines and columns of the sample.
    pub sampled_lines: usize,
    /// See `sampled_lines`.
    pub sampled_columns: usize,
    /// What machine and oracle say of the sample.
    #[serde(flatten)]
    pub counts: Counts,
    /// The suspects.
    pub suspects: Option<SuspectReport>,
    /// Fixed point against the oracle, pixels.
    pub total_px: Option<Spread>,
    /// The algorithm alone, pixels.
    pub algorithm_px: Option<Spread>,
    /// The quantisation alone, pixels.
    pub quantisation_px: Option<Spread>,
    /// Fixed point against the oracle on the ground, metres.
    pub total_m: Option<Spread>,
    /// The algorithm alone, metres.
    pub algorithm_m: Option<Spread>,
    /// The quantisation alone, metres.
    pub quantisation_m: Option<Spread>,
    /// The interpolated surface height against the oracle's at the same place, metres.
    pub height_m: Option<Spread>,
    /// Share of the sample whose colour is within 2 levels of the oracle's.
    pub color_within_2: f64,
    /// The pixel to look at first, of sample and suspects.
    #[serde(skip)]
    pub worst: Option<Worst>,
}

impl ErrorReport {
    /// Sums up pixels of a sample.
    pub fn new(sample: &Sample, pixels: &[PixelError], unit_m: f64) -> Self {
        let spread = |value: &dyn Fn(&PixelError) -> f64| Spread::of(pixels.iter().map(value));
        let close = pixels.iter().filter(|p| p.color <= 2).count();
        Self {
            sampled_lines: sample.lines.len(),
            sampled_columns: sample.columns.len(),
            counts: Counts::of(pixels),
            suspects: None,
            total_px: spread(&|p| p.total_px),
            algorithm_px: spread(&|p| p.algorithm_px),
            quantisation_px: spread(&|p| p.quantisation_px),
            total_m: spread(&|p| p.total * unit_m),
            algorithm_m: spread(&|p| p.algorithm * unit_m),
            quantisation_m: spread(&|p| p.quantisation * unit_m),
            height_m: spread(&|p| p.height * unit_m),
            color_within_2: close as f64 / pixels.len().max(1) as f64,
            worst: Worst::of(pixels),
        }
    }

    /// The same with suspects beside the sample: they count for maxima and the worst pixel, not for
    /// quantiles and shares.
    #[must_use]
    pub fn with_suspects(
        self,
        suspects: &Suspects,
        pixels: &[PixelError],
        unit_m: f64,
    ) -> Self {
        let larger = |spread: Option<Spread>, value: &dyn Fn(&PixelError) -> f64| {
            let largest =
                pixels.iter().map(value).filter(|v| v.is_finite()).fold(f64::NAN, f64::max);
            spread.map(|spread| Spread { max: spread.max.max(largest), ..spread })
        };
        Self {
            suspects: Some(SuspectReport {
                rims: suspects.rims,
                far: suspects.far,
                counts: Counts::of(pixels),
            }),
            total_px: larger(self.total_px, &|p| p.total_px),
            algorithm_px: larger(self.algorithm_px, &|p| p.algorithm_px),
            quantisation_px: larger(self.quantisation_px, &|p| p.quantisation_px),
            total_m: larger(self.total_m, &|p| p.total * unit_m),
            algorithm_m: larger(self.algorithm_m, &|p| p.algorithm * unit_m),
            quantisation_m: larger(self.quantisation_m, &|p| p.quantisation * unit_m),
            height_m: larger(self.height_m, &|p| p.height * unit_m),
            worst: match (self.worst, Worst::of(pixels)) {
                (Some(own), Some(other)) => Some(Worst::or(own, other)),
                (own, other) => own.or(other),
            },
            ..self
        }
    }
}
