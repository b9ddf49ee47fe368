//! Error against the oracle, on a stated sample of pixels: the algorithm's own (oracle against
//! the units in f64) and the quantisation (units in f64 against fixed point), told apart.
//!
//! Pixels are compared where both see the same sheet of the surface: both hit, and the oracle
//! finds no other crossing between its point and ours. All others are silhouettes, counted.

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use serde::Serialize;

use crate::engine::{Band, ErrorParts, Machine, Scan, WithSetup};
use crate::frame::Hit;
use crate::oracle::Oracle;
use crate::plan::Plan;
use crate::processor;
use crate::readout::Reader;
use crate::setup::{Setup, SetupError};
use crate::unit::Line;
use crate::word::Complete;
use crate::word::format::hash;
use crate::word::real::Real;

/// Lines and columns that a study looks at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sample {
    /// Lines of the sample, ascending.
    pub lines: Vec<u32>,
    /// Columns of the sample, ascending.
    pub columns: Vec<u32>,
}

impl Sample {
    /// The sample that is the whole frame.
    pub fn all(plan: &Plan) -> Self {
        Self {
            lines: (0..plan.geometry.lines).collect(),
            columns: (0..plan.geometry.columns).collect(),
        }
    }

    /// One line and column at random out of each of `count` equal strips, or all where the screen
    /// has fewer.
    pub fn strips(plan: &Plan, count: u32, seed: u64) -> Self {
        let pick = |size: u32, axis: u64| -> Vec<u32> {
            if size <= count {
                return (0..size).collect();
            }
            let edge = |strip: u32| (u64::from(strip) * u64::from(size) / u64::from(count)) as u32;
            (0..count)
                .map(|strip| {
                    let (from, to) = (edge(strip), edge(strip + 1));
                    from + (hash(seed ^ axis, strip.into()) % u64::from(to - from)) as u32
                })
                .collect()
        };
        Self { lines: pick(plan.geometry.lines, 0), columns: pick(plan.geometry.columns, 1 << 32) }
    }

    /// Whole lines, one out of each of `count` strips.
    pub fn whole_lines(plan: &Plan, count: u32, seed: u64) -> Self {
        Self { lines: Self::strips(plan, count, seed).lines, ..Self::all(plan) }
    }

    /// Number of pixels in the sample.
    pub fn len(&self) -> usize {
        self.lines.len() * self.columns.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// What a pixel's engines disagree about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Sheet {
    /// Neither meets the surface: both miss, or both meet the side of the map.
    Empty,
    /// Both hit, with no other crossing between.
    Same,
    /// The machine says `OutOfRange`: what the oracle sees lies beyond the registers' range.
    Beyond,
    /// One hits and the other does not, they meet different kinds of surface, or another sheet.
    Silhouette,
}

/// Errors of one pixel; lengths are NaN but on the same sheet.
#[derive(Clone, Copy, Debug)]
pub struct PixelError {
    /// Scan line of the pixel, from the top.
    pub line: u32,
    /// Column of the pixel, from the left.
    pub column: u32,
    /// Which kind of pixel.
    pub sheet: Sheet,
    /// From the pixel's centre to the projection of the fixed ground point at its surface height.
    pub total_px: f64,
    /// The same of the units in f64.
    pub algorithm_px: f64,
    /// Between the two projections.
    pub quantisation_px: f64,
    /// From the oracle's ground point to the fixed one, scene units.
    pub total: f64,
    /// From the oracle's to the real one.
    pub algorithm: f64,
    /// From the real one to the fixed one.
    pub quantisation: f64,
    /// Of the interpolated surface height, at the fixed place, scene units.
    pub height: f64,
    /// Largest difference of a channel, fixed against oracle, 0..=255.
    pub color: u8,
}

/// One engine's pixel, as the study needs it.
#[derive(Clone, Copy, Debug)]
struct Seen {
    hit: Hit,
    point: Option<DVec3>,
    color: [u8; 3],
    /// The surface that shows, by its place in the scene.
    surface: usize,
}

/// Lines that are compared with the oracle at once, on all threads.
const AT_ONCE: usize = 4;

impl Machine<'_> {
    /// Errors of all sampled pixels, line by line.
    ///
    /// # Errors
    /// If the scene cannot be set up in f64.
    pub fn errors(&self, sample: &Sample) -> Result<Vec<PixelError>, SetupError> {
        Ok(Comparison { machine: self, real: self.real()? }.pixels(sample))
    }

    /// The errors of sampled pixels, line by line.
    ///
    /// # Errors
    /// If the scene cannot be set up in f64.
    pub fn scan_errors(&self, sample: Sample) -> Result<Scan<'_>, SetupError> {
        let comparison = Comparison { machine: self, real: self.real()? };
        Ok(Scan::new(0..sample.lines.len() as u32, move |lines, stop| {
            let mut band = Band::default();
            for lines in sample.lines[lines.start as usize..lines.end as usize].chunks(AT_ONCE) {
                if stop() {
                    return None;
                }
                let part = Sample { lines: lines.to_vec(), columns: sample.columns.clone() };
                for pixel in comparison.pixels(&part) {
                    band.errors.push(ErrorParts {
                        total: pixel.total_px,
                        algorithm: pixel.algorithm_px,
                        quantisation: pixel.quantisation_px,
                    });
                    band.silhouettes.push(pixel.sheet == Sheet::Silhouette);
                }
            }
            Some(band)
        }))
    }
}

/// A machine beside the same units in f64 and the oracle.
struct Comparison<'a> {
    machine: &'a Machine<'a>,
    real: &'a Setup<Real>,
}

impl Comparison<'_> {
    fn pixels(&self, sample: &Sample) -> Vec<PixelError> {
        let (plan, oracle) = (self.machine.plan(), self.machine.oracle());
        let look = Look { plan, sample };
        let real = look.run(self.real);
        let fixed = self.machine.run(look);
        let lines: Vec<_> = sample.lines.iter().zip(fixed.iter().zip(&real)).collect();
        lines
            .par_iter()
            .flat_map_iter(|(line, (fixed, real))| {
                sample
                    .columns
                    .iter()
                    .zip(fixed.iter().zip(real.iter()))
                    .map(move |(&column, (fixed, real))| one(oracle, **line, column, *fixed, *real))
            })
            .collect()
    }
}

/// The sampled pixels of the line-by-line processor, by line.
#[derive(Clone, Copy)]
struct Look<'a> {
    plan: &'a Plan,
    sample: &'a Sample,
}

impl WithSetup for Look<'_> {
    type Output = Vec<Vec<Seen>>;

    fn run<W: Complete>(self, setup: &Setup<W>) -> Self::Output {
        let Self { plan, sample } = self;
        let reader = Reader::new(plan);
        let mut line = Line::new(&setup.world, sample.columns.iter().copied());
        let mut lines = Vec::with_capacity(sample.lines.len());
        processor::run_lines(setup, &mut line, sample.lines.iter().copied(), |line| {
            let seen = (0..line.len()).map(|i| Seen {
                hit: line.hit[i],
                point: reader.pixel(line, i).map(|pixel| pixel.point()),
                color: line.color[i],
                surface: line.owner[i] as usize,
            });
            lines.push(seen.collect());
        });
        lines
    }
}

fn one(oracle: &Oracle, line: u32, column: u32, fixed: Seen, real: Seen) -> PixelError {
    let (j, k) = (f64::from(line), f64::from(column));
    let sighting = oracle.pixel(j, k);
    let color =
        (0..3).map(|c| fixed.color[c].abs_diff(sighting.color[c])).max().unwrap_or_default();
    let mut error = PixelError {
        line,
        column,
        sheet: Sheet::Silhouette,
        total_px: f64::NAN,
        algorithm_px: f64::NAN,
        quantisation_px: f64::NAN,
        total: f64::NAN,
        algorithm: f64::NAN,
        quantisation: f64::NAN,
        height: f64::NAN,
        color,
    };
    let misses = |hit| matches!(hit, Hit::Sky | Hit::OutOfRange);
    if misses(fixed.hit) && misses(sighting.hit) {
        error.sheet = Sheet::Empty;
        return error;
    }
    if fixed.hit == Hit::OutOfRange {
        error.sheet = Sheet::Beyond;
        return error;
    }
    let centre = DVec2::new(j, k);
    let placed = |seen: Seen| {
        let same = (seen.hit, seen.surface) == (sighting.hit, sighting.surface);
        let point = same.then_some(seen.point).flatten()?;
        let y = oracle.height_of(seen.surface, point.x, point.z).unwrap_or(point.y);
        let point = DVec3::new(point.x, y, point.z);
        let (line, column) = oracle.project(point)?;
        let lambda = (point - oracle.eye()).length() / oracle.direction(j, k).length();
        oracle.same_sheet(j, k, lambda).then_some((point, DVec2::new(line, column)))
    };
    // A pixel that meets the side of the map shows its colour alone: there is no surface point.
    if sighting.hit == Hit::Side && fixed.hit == Hit::Side {
        error.sheet = Sheet::Empty;
        return error;
    }
    if let Some((point, at)) = placed(fixed) {
        error.sheet = Sheet::Same;
        error.total_px = at.distance(centre);
        error.total = point.distance(sighting.point);
        error.height = fixed.point.map_or(f64::NAN, |read| (read.y - point.y).abs());
        // Where the units in f64 fall on another sheet, the two parts cannot be told apart.
        if let Some((exact, exact_at)) = placed(real) {
            error.algorithm_px = exact_at.distance(centre);
            error.algorithm = exact.distance(sighting.point);
            error.quantisation_px = at.distance(exact_at);
            error.quantisation = point.distance(exact);
        }
    }
    error
}

/// Median, 99.9th percentile and maximum of a quantity over the pixels that have it.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Spread {
    /// Half of the pixels are at most this.
    pub median: f64,
    /// 99.9 % are at most this.
    pub p999: f64,
    /// The largest.
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
        Some(Self { median: at(0.5), p999: at(0.999), max: at(1.0) })
    }
}

/// Errors over a sample.
#[derive(Clone, Debug, Serialize)]
pub struct ErrorReport {
    /// Pixels of the sample.
    pub pixels: usize,
    /// Lines and columns they come from.
    pub sampled_lines: usize,
    /// See `sampled_lines`.
    pub sampled_columns: usize,
    /// Pixels on the same sheet.
    pub same_sheet: usize,
    /// Pixels where the two see different sheets.
    pub silhouettes: usize,
    /// Pixels that the machine calls out of range.
    pub beyond: usize,
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
    /// Share of all pixels whose colour is within 2 levels of the oracle's.
    pub color_within_2: f64,
    /// The pixel with the largest total error, as (column, line).
    pub worst: Option<(u32, u32)>,
}

impl ErrorReport {
    /// Sums up pixels of a sample.
    pub fn new(sample: &Sample, pixels: &[PixelError], unit_m: f64) -> Self {
        let spread = |value: &dyn Fn(&PixelError) -> f64| Spread::of(pixels.iter().map(value));
        let count = |sheet| pixels.iter().filter(|p| p.sheet == sheet).count();
        let worst = pixels
            .iter()
            .filter(|p| p.total_px.is_finite())
            .max_by(|a, b| a.total_px.total_cmp(&b.total_px))
            .map(|p| (p.column, p.line));
        let close = pixels.iter().filter(|p| p.color <= 2).count();
        Self {
            pixels: pixels.len(),
            sampled_lines: sample.lines.len(),
            sampled_columns: sample.columns.len(),
            same_sheet: count(Sheet::Same),
            silhouettes: count(Sheet::Silhouette),
            beyond: count(Sheet::Beyond),
            total_px: spread(&|p| p.total_px),
            algorithm_px: spread(&|p| p.algorithm_px),
            quantisation_px: spread(&|p| p.quantisation_px),
            total_m: spread(&|p| p.total * unit_m),
            algorithm_m: spread(&|p| p.algorithm * unit_m),
            quantisation_m: spread(&|p| p.quantisation * unit_m),
            height_m: spread(&|p| p.height * unit_m),
            color_within_2: close as f64 / pixels.len().max(1) as f64,
            worst,
        }
    }
}
