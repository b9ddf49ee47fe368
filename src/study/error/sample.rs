//! Which pixels a study looks at.

use crate::plan::Plan;
use crate::word::format::hash;

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

    /// Whether a pixel is in it.
    pub fn contains(&self, line: u32, column: u32) -> bool {
        self.lines.binary_search(&line).is_ok() && self.columns.binary_search(&column).is_ok()
    }

    /// Its pixels, line by line.
    pub(super) fn rows(&self) -> Vec<Row<'_>> {
        self.lines.iter().map(|&line| Row { line, columns: &self.columns }).collect()
    }
}

/// Pixels of one line that a study looks at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<'a> {
    pub(super) line: u32,
    /// Ascending.
    pub(super) columns: &'a [u32],
}
