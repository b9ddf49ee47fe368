//! A grid of height samples, row 0 north, and its reader for 8- and 16-bit PNG.

use std::path::Path;

/// A grid of height samples as the file holds them.
///
/// Samples are kept as `f32`: exact for every 8- and 16-bit value.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    columns: usize,
    rows: usize,
    /// Row by row, row 0 north.
    samples: Vec<f32>,
    range: (f32, f32),
}

impl HeightMap {
    /// A map from its samples, row by row.
    ///
    /// # Panics
    /// If the number of samples is not `columns * rows`, if it is zero, or if one is not finite:
    /// the readers have checked that.
    pub fn new(columns: usize, rows: usize, samples: Vec<f32>) -> Self {
        assert!(!samples.is_empty() && samples.len() == columns * rows);
        let range = samples
            .iter()
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &s| (low.min(s), high.max(s)));
        assert!(samples.iter().all(|s| s.is_finite()));
        Self { columns, rows, samples, range }
    }

    /// Nodes in x.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Nodes in z.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Sample of node (column i, row j).
    pub fn sample(&self, i: usize, j: usize) -> f32 {
        self.samples[j * self.columns + i]
    }

    /// All samples, row by row.
    pub fn samples(&self) -> &[f32] {
        &self.samples
    }

    /// Lowest and highest sample.
    pub fn range(&self) -> (f32, f32) {
        self.range
    }
}
