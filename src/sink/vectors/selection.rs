//! Which pixels of a scene become rows.

use crate::plan::Plan;
use crate::study::error::Sample;
use crate::word::format::hash;

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Whole lines from the first to the one before the second.
    Lines(u32, u32),
    /// As many whole lines, one at random out of each of equal strips.
    Strips(u32),
    /// As many single pixels, one at random out of each of equal stretches of the scan.
    Pixels(u32),
}

/// Columns of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Columns {
    /// All of them, this many.
    All(u32),
    /// These, ascending.
    Some(Vec<u32>),
}

impl Columns {
    /// Their numbers.
    pub fn list(&self) -> Vec<u32> {
        match self {
            Self::All(count) => (0..*count).collect(),
            Self::Some(columns) => columns.clone(),
        }
    }

    fn count(&self) -> u64 {
        match self {
            Self::All(count) => u64::from(*count),
            Self::Some(columns) => columns.len() as u64,
        }
    }
}

/// Pixels of a scene, in the order of the scan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selection {
    /// Lines, ascending, and columns on them.
    pub lines: Vec<(u32, Columns)>,
    /// The choice in words, for headers and reports.
    pub description: String,
}

impl Selection {
    /// The pixels of a choice. What a choice asks for beyond the raster is left out.
    pub fn new(plan: &Plan, choice: Choice, seed: u64) -> Self {
        let (columns, lines) = (plan.geometry.columns, plan.geometry.lines);
        let whole = |line| (line, Columns::All(columns));
        match choice {
            Choice::Lines(from, to) => {
                let to = to.min(lines);
                let last = to.saturating_sub(1);
                let description = format!("lines {from} to {last} of {lines}");
                Self { lines: (from..to).map(whole).collect(), description }
            }
            Choice::Strips(count) if count < lines => {
                let chosen = Sample::whole_lines(plan, count, seed).lines;
                let strips = if count == 1 { "" } else { "one out of each of as many strips, " };
                let description =
                    format!("{count} of {lines} lines at random, {strips}seed {seed}");
                Self { lines: chosen.into_iter().map(whole).collect(), description }
            }
            Choice::Strips(_) => Self {
                lines: (0..lines).map(whole).collect(),
                description: format!("all {lines} lines"),
            },
            Choice::Pixels(count) => {
                let all = u64::from(columns) * u64::from(lines);
                let count = u64::from(count).min(all);
                let mut chosen: Vec<(u32, Columns)> = Vec::new();
                for n in 0..count {
                    let (from, to) = (n * all / count, (n + 1) * all / count);
                    let pixel = from + hash(seed, n) % (to - from);
                    let line = (pixel / u64::from(columns)) as u32;
                    let column = (pixel % u64::from(columns)) as u32;
                    match chosen.last_mut() {
                        Some((last, Columns::Some(on_it))) if *last == line => on_it.push(column),
                        _ => chosen.push((line, Columns::Some(vec![column]))),
                    }
                }
                let description = format!("{count} of {all} pixels at random, seed {seed}");
                Self { lines: chosen, description }
            }
        }
    }

    /// Number of pixels.
    pub fn pixels(&self) -> u64 {
        self.lines.iter().map(|(_, columns)| columns.count()).sum()
    }
}
