//! Error against the oracle: the algorithm's own (oracle against the units in f64) and the
//! quantisation (units in f64 against fixed point), told apart.
//!
//! A pixel in which the oracle sees the surface is a *reference pixel*. The machine's point there is
//! compared with the oracle's where both lie on one sheet of the surface: the oracle finds no other
//! crossing between the two. Everywhere else the pixel is *lost*, and its error infinite: otherwise
//! a machine would look better for losing pixels.

mod report;
mod sample;
mod suspects;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use serde::Serialize;

use crate::engine::{Band, ErrorParts, Machine, Scan, Stop, WithSetup};
use crate::frame::Hit;
use crate::oracle::Oracle;
use crate::plan::Plan;
use crate::processor;
use crate::readout::Reader;
use crate::setup::{Setup, SetupError};
use crate::unit::Line;
use crate::word::Complete;
use crate::word::real::Real;
pub use report::{Counts, ErrorReport, Outcomes, Spread, SuspectReport, Worst};
pub use sample::Sample;
use sample::Row;
pub use suspects::Suspects;

/// What machine and oracle say of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Sheet {
    /// Neither meets the surface, and they agree in what they meet.
    Empty,
    /// Both meet the surface, with no other crossing between.
    Same,
    /// The oracle sees the surface, the machine another sheet of it or none.
    Lost,
    /// The machine shows the surface where the oracle sees none.
    Ghost,
    /// Neither meets the surface, and they differ in what they meet: sky, side or out of range.
    Flip,
}

impl Sheet {
    /// Whether the two disagree.
    #[must_use]
    pub fn is_silhouette(self) -> bool {
        matches!(self, Self::Lost | Self::Ghost | Self::Flip)
    }
}

/// Errors of one pixel. Lengths are infinite in a lost pixel, and NaN where the oracle does not see
/// the surface.
#[derive(Clone, Copy, Debug)]
pub struct PixelError {
    /// Scan line of the pixel, from the top.
    pub line: u32,
    /// Column of the pixel, from the left.
    pub column: u32,
    /// Which kind of pixel.
    pub sheet: Sheet,
    /// What the machine meets.
    pub machine: Hit,
    /// What the oracle sees.
    pub oracle: Hit,
    /// From the pixel's centre to the projection of the fixed ground point at its surface height.
    pub total_px: f64,
    /// The same of the units in f64, infinite where they lose the pixel.
    pub algorithm_px: f64,
    /// Between the two projections: infinite where one of the two loses the pixel, NaN where both
    /// do.
    pub quantisation_px: f64,
    /// From the oracle's ground point to the fixed one, scene units.
    pub total: f64,
    /// From the oracle's to the real one.
    pub algorithm: f64,
    /// From the real one to the fixed one.
    pub quantisation: f64,
    /// Of the interpolated surface height, at the fixed place, scene units; NaN in a lost pixel.
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

impl Machine<'_> {
    /// Errors of all sampled pixels, line by line.
    ///
    /// # Errors
    /// If the scene cannot be set up in f64.
    pub fn errors(&self, sample: &Sample) -> Result<Vec<PixelError>, SetupError> {
        let comparison = Comparison { machine: self, real: self.real()? };
        Ok(comparison.pixels(&sample.rows(), &|| false).unwrap_or_default())
    }

    /// The errors of sampled pixels, line by line.
    ///
    /// # Errors
    /// If the scene cannot be set up in f64.
    pub fn scan_errors(&self, sample: Sample) -> Result<Scan<'_>, SetupError> {
        let comparison = Comparison { machine: self, real: self.real()? };
        Ok(Scan::new(0..sample.lines.len() as u32, move |lines, stop| {
            let rows = &sample.rows()[lines.start as usize..lines.end as usize];
            Some(Band::of_errors(&comparison.pixels(rows, stop)?))
        }))
    }
}

impl Band {
    /// Errors of whole lines, as pictures show them.
    #[must_use]
    pub fn of_errors(pixels: &[PixelError]) -> Self {
        let parts = |pixel: &PixelError| ErrorParts {
            total: pixel.total_px,
            algorithm: pixel.algorithm_px,
            quantisation: pixel.quantisation_px,
        };
        Self {
            errors: pixels.iter().map(parts).collect(),
            silhouettes: pixels.iter().map(|pixel| pixel.sheet.is_silhouette()).collect(),
            ..Self::default()
        }
    }
}

/// A machine beside the same units in f64 and the oracle.
struct Comparison<'a> {
    machine: &'a Machine<'a>,
    real: &'a Setup<Real>,
}

impl Comparison<'_> {
    /// The errors of some lines, on all threads; `None` if that was stopped.
    fn pixels(&self, rows: &[Row<'_>], stop: Stop<'_>) -> Option<Vec<PixelError>> {
        let (plan, oracle) = (self.machine.plan(), self.machine.oracle());
        let row = |row: &Row<'_>| {
            if stop() {
                return None;
            }
            let look = Look { plan, row: *row };
            let both = self.machine.run(look).into_iter().zip(look.run(self.real));
            let pixel = |(&column, (fixed, real))| one(oracle, row.line, column, [fixed, real]);
            Some(row.columns.iter().zip(both).map(pixel).collect())
        };
        // Every line by itself: it costs a few additions for each line above it.
        let found: Option<Vec<Vec<PixelError>>> = rows.par_iter().map(row).collect();
        Some(found?.concat())
    }
}

/// Some pixels of one line of the line-by-line processor.
#[derive(Clone, Copy)]
struct Look<'a> {
    plan: &'a Plan,
    row: Row<'a>,
}

impl WithSetup for Look<'_> {
    type Output = Vec<Seen>;

    fn run<W: Complete>(self, setup: &Setup<W>) -> Self::Output {
        let Self { plan, row } = self;
        let reader = Reader::new(plan);
        let mut line = Line::new(&setup.world, row.columns.iter().copied());
        let mut pixels = Vec::with_capacity(row.columns.len());
        processor::run_lines(setup, &mut line, [row.line], |line| {
            pixels.extend((0..line.len()).map(|i| Seen {
                hit: line.hit[i],
                point: reader.pixel(line, i).map(|pixel| pixel.point()),
                color: line.color[i],
                surface: line.owner[i] as usize,
            }));
        });
        pixels
    }
}

/// A point that an engine shows, at the surface's exact height there.
#[derive(Clone, Copy)]
struct Placed {
    point: DVec3,
    /// Where it is seen, (line, column).
    at: DVec2,
    /// Its distance in the unit of the pixel's λ.
    lambda: f64,
}

/// A pixel of the machine and of the same units in f64, in this order, beside the oracle's.
fn one(oracle: &Oracle, line: u32, column: u32, engines: [Seen; 2]) -> PixelError {
    let (j, k) = (f64::from(line), f64::from(column));
    let placed = engines.map(|seen| {
        let point = seen.point.filter(|_| seen.hit == Hit::Surface)?;
        let y = oracle.height_of(seen.surface, point.x, point.z).unwrap_or(point.y);
        let point = DVec3::new(point.x, y, point.z);
        let (line, column) = oracle.project(point)?;
        let lambda = (point - oracle.eye()).length() / oracle.direction(j, k).length();
        Some(Placed { point, at: DVec2::new(line, column), lambda })
    });
    let others = placed.map(|placed| placed.map_or(f64::NAN, |placed| placed.lambda));
    let (sighting, sheets) = oracle.pixel_beside(j, k, others);
    let on_sheet = |engine: usize| {
        let same = sheets[engine] && engines[engine].surface == sighting.surface;
        placed[engine].filter(|_| same && sighting.hit == Hit::Surface)
    };
    let [fixed, real] = [0, 1].map(on_sheet);
    let machine = engines[0];
    let sheet = match (machine.hit, sighting.hit) {
        (_, Hit::Surface) if fixed.is_some() => Sheet::Same,
        (_, Hit::Surface) => Sheet::Lost,
        (Hit::Surface, _) => Sheet::Ghost,
        (machine, oracle) if machine == oracle => Sheet::Empty,
        _ => Sheet::Flip,
    };
    let centre = DVec2::new(j, k);
    let exact = Placed { point: sighting.point, at: centre, lambda: sighting.lambda };
    let apart = |a: Option<Placed>, b: Option<Placed>| match (a, b) {
        _ if sighting.hit != Hit::Surface => [f64::NAN; 2],
        (Some(a), Some(b)) => [a.at.distance(b.at), a.point.distance(b.point)],
        (None, None) => [f64::NAN; 2],
        _ => [f64::INFINITY; 2],
    };
    let [total_px, total] = apart(fixed, Some(exact));
    let [algorithm_px, algorithm] = apart(real, Some(exact));
    let [quantisation_px, quantisation] = apart(fixed, real);
    let height = fixed.zip(machine.point).map_or(f64::NAN, |(exact, read)| {
        (read.y - exact.point.y).abs()
    });
    let channels = machine.color.iter().zip(sighting.color);
    PixelError {
        line,
        column,
        sheet,
        machine: machine.hit,
        oracle: sighting.hit,
        total_px,
        algorithm_px,
        quantisation_px,
        total,
        algorithm,
        quantisation,
        height,
        color: channels.map(|(a, b)| a.abs_diff(b)).max().unwrap_or_default(),
    }
}
