//! Pixels of a drawn frame where errors are likely, whatever they are: at rims, where a ray that
//! lands a little off lands on another sheet or far along the ground, and far away, where a pixel
//! covers most of it.
//!
//! They are chosen from the frame alone, so that the oracle is asked about few pixels. Being
//! chosen, they say nothing of the share of errors: that is what a random sample is for.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use super::sample::{Row, Sample};
use super::{Comparison, PixelError};
use crate::engine::{Band, Engine, Machine, Wanted};
use crate::frame::Hit;
use crate::setup::SetupError;
use crate::word::format::hash;

/// Neighbours whose distances differ by no more than this share are no rim. A pixel covers a
/// thousandth of its distance where ground is seen face on.
const JUMP: f64 = 1.0 / 512.0;

/// Of the suspects that are wanted, one of so many is far away, not at a rim.
const FAR: usize = 6;

/// Lines that are drawn at once.
const LINES: u32 = 64;

/// Pixels of a frame where errors are likely.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Suspects {
    /// How many were chosen as neighbours of a pixel with another outcome or distance.
    pub rims: usize,
    /// How many were chosen for their distance.
    pub far: usize,
    /// Columns of each line that has any, both ascending.
    lines: BTreeMap<u32, Vec<u32>>,
}

impl Suspects {
    /// Number of pixels.
    pub fn len(&self) -> usize {
        self.rims + self.far
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Machine<'_> {
    /// Up to `most` pixels of the frame that are not in a sample, where errors are likely: first
    /// those beside a pixel with another outcome, then by how far the distances of neighbours
    /// differ; a sixth of them by distance alone.
    ///
    /// # Errors
    /// As [`Machine::scan`].
    pub fn suspects(&self, most: usize, apart_from: &Sample) -> Result<Suspects, SetupError> {
        // Both engines draw the same frame, but registers that saturate only one can draw.
        let engine = if self.world().wraps() { Engine::Fast } else { Engine::Processor };
        let mut scan =
            self.scan(engine, Wanted { buffers: true, first_line: 0, cycles: false })?;
        let lines = self.plan().geometry.lines;
        let (mut rims, mut far) = (Ranked::new(most - most / FAR), Ranked::new(most / FAR));
        let mut above: Option<Distances> = None;
        for from in (0..lines).step_by(LINES as usize) {
            let Some(band) = scan.draw(LINES.min(lines - from), &|| false) else { break };
            for distances in Distances::of(&band, from) {
                if let Some(above) = &mut above {
                    distances.compare(above);
                    above.hand_out(apart_from, &mut rims, &mut far);
                }
                above = Some(distances);
            }
        }
        if let Some(above) = &above {
            above.hand_out(apart_from, &mut rims, &mut far);
        }
        let rims = rims.best();
        let mut suspects = Suspects { rims: rims.len(), ..Suspects::default() };
        for place in rims {
            suspects.lines.entry(place.line).or_default().push(place.column);
        }
        for place in far.best() {
            let columns = suspects.lines.entry(place.line).or_default();
            if !columns.contains(&place.column) {
                columns.push(place.column);
                suspects.far += 1;
            }
        }
        suspects.lines.values_mut().for_each(|columns| columns.sort_unstable());
        Ok(suspects)
    }

    /// Errors of suspects, line by line.
    ///
    /// # Errors
    /// If the scene cannot be set up in f64.
    pub fn suspect_errors(&self, suspects: &Suspects) -> Result<Vec<PixelError>, SetupError> {
        let lines = suspects.lines.iter();
        let rows: Vec<Row<'_>> = lines.map(|(&line, columns)| Row { line, columns }).collect();
        let comparison = Comparison { machine: self, real: self.real()? };
        Ok(comparison.pixels(&rows, &|| false).unwrap_or_default())
    }
}

/// One line of a frame: what was met, how far away, and how much that differs from neighbours.
struct Distances {
    line: u32,
    hit: Vec<Hit>,
    lambda: Vec<f64>,
    /// Largest difference from a neighbour, as a share of the nearer distance; infinite beside
    /// another outcome.
    jump: Vec<f64>,
}

impl Distances {
    /// The lines of a band that begins with line `from`, compared with their neighbours in the
    /// line.
    fn of(band: &Band, from: u32) -> impl Iterator<Item = Self> {
        let columns = band.frame.columns.max(1);
        let lambda = band.frame.buffers.as_ref().map_or(&[][..], |buffers| &buffers.lambda);
        let lines = band.frame.hit.chunks(columns).zip(lambda.chunks(columns));
        lines.zip(from..).map(|((hit, lambda), line)| {
            let (hit, lambda) = (hit.to_vec(), lambda.to_vec());
            let mut jump = vec![0.0_f64; hit.len()];
            for at in 1..hit.len() {
                let apart = apart((hit[at - 1], lambda[at - 1]), (hit[at], lambda[at]));
                jump[at - 1] = jump[at - 1].max(apart);
                jump[at] = apart;
            }
            Self { line, hit, lambda, jump }
        })
    }

    /// Compares the line with the one above it, in both.
    fn compare(&self, above: &mut Self) {
        for at in 0..self.hit.len() {
            let apart = apart((self.hit[at], self.lambda[at]), (above.hit[at], above.lambda[at]));
            above.jump[at] = above.jump[at].max(apart);
        }
    }

    fn hand_out(&self, apart_from: &Sample, rims: &mut Ranked, far: &mut Ranked) {
        for column in 0..self.hit.len() {
            let (jump, lambda) = (self.jump[column], self.lambda[column]);
            let is_far = self.hit[column] == Hit::Surface && far.wants(lambda);
            let is_rim = jump > JUMP && rims.wants(jump);
            if !(is_far || is_rim) || apart_from.contains(self.line, column as u32) {
                continue;
            }
            let place = |rank| Place::new(rank, self.line, column as u32);
            if is_rim {
                rims.add(place(jump));
            }
            if is_far {
                far.add(place(lambda));
            }
        }
    }
}

/// How far two pixels differ, as [`Distances::jump`].
fn apart(a: (Hit, f64), b: (Hit, f64)) -> f64 {
    if a.0 != b.0 {
        return f64::INFINITY;
    }
    let apart = (a.1 - b.1).abs() / a.1.min(b.1);
    if apart.is_nan() { 0.0 } else { apart }
}

/// A pixel with its rank; of equal ranks chance decides, so that no part of the frame is preferred.
#[derive(Clone, Copy, Debug)]
struct Place {
    rank: f64,
    chance: u64,
    line: u32,
    column: u32,
}

impl Place {
    fn new(rank: f64, line: u32, column: u32) -> Self {
        let chance = hash(line.into(), column.into());
        Self { rank, chance, line, column }
    }

    /// The higher rank first.
    fn order(&self, other: &Self) -> Ordering {
        other.rank.total_cmp(&self.rank).then(self.chance.cmp(&other.chance))
    }
}

/// The pixels of highest rank.
struct Ranked {
    most: usize,
    places: Vec<Place>,
    /// Ranks below this are not among them.
    least: f64,
}

impl Ranked {
    fn new(most: usize) -> Self {
        Self { most, places: Vec::new(), least: f64::NEG_INFINITY }
    }

    fn wants(&self, rank: f64) -> bool {
        self.most > 0 && rank >= self.least
    }

    fn add(&mut self, place: Place) {
        self.places.push(place);
        if self.places.len() >= 4 * self.most {
            self.cut();
        }
    }

    fn cut(&mut self) {
        if self.places.len() > self.most {
            self.places.select_nth_unstable_by(self.most - 1, Place::order);
            self.places.truncate(self.most);
            self.least = self.places[self.most - 1].rank;
        }
    }

    fn best(mut self) -> Vec<Place> {
        self.cut();
        self.places
    }
}
