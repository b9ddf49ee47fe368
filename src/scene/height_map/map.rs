//! The samples of a map.

/// A grid of height samples as the file holds them.
///
/// Samples are kept as `f32`: exact for every 8- and 16-bit value. A node without data is NaN.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    columns: usize,
    rows: usize,
    /// Row by row, row 0 north.
    samples: Vec<f32>,
    range: (f32, f32),
    voids: usize,
    rises: [f32; 2],
}

impl HeightMap {
    /// A map from its samples, row by row.
    ///
    /// # Panics
    /// If the number of samples is not `columns * rows`, if one is infinite, or if none has data:
    /// the readers have checked that.
    pub fn new(columns: usize, rows: usize, samples: Vec<f32>) -> Self {
        assert!(!samples.is_empty() && samples.len() == columns * rows);
        let range = samples
            .iter()
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &s| (low.min(s), high.max(s)));
        assert!(range.0.is_finite() && range.1.is_finite());
        let voids = samples.iter().filter(|sample| sample.is_nan()).count();
        let rises = rises(&samples, columns);
        Self { columns, rows, samples, range, voids, rises }
    }

    /// The same with no data where a sample has a value; `None` if that is everywhere.
    pub(in crate::scene) fn without(&self, mark: f32) -> Option<Self> {
        let kept = |&sample: &f32| if sample == mark { f32::NAN } else { sample };
        let samples: Vec<f32> = self.samples.iter().map(kept).collect();
        let data = samples.iter().any(|sample| !sample.is_nan());
        data.then(|| Self::new(self.columns, self.rows, samples))
    }

    /// Nodes in x.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Nodes in z.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Sample of node (column i, row j); NaN without data.
    pub fn sample(&self, i: usize, j: usize) -> f32 {
        self.samples[j * self.columns + i]
    }

    /// All samples, row by row; NaN without data.
    pub fn samples(&self) -> &[f32] {
        &self.samples
    }

    /// Number of nodes without data.
    pub fn voids(&self) -> usize {
        self.voids
    }

    /// Lowest and highest sample of the nodes with data.
    pub fn range(&self) -> (f32, f32) {
        self.range
    }

    /// Largest differences of neighbouring samples with data, along rows and along columns.
    pub fn rises(&self) -> [f32; 2] {
        self.rises
    }
}

fn rises(samples: &[f32], columns: usize) -> [f32; 2] {
    // The greater of a number and NaN is the number.
    let rise = |most: f32, (a, b): (&f32, &f32)| most.max((a - b).abs());
    let along = |row: &[f32]| row.iter().zip(&row[1..]).fold(0.0, rise);
    [
        samples.chunks_exact(columns).map(along).fold(0.0, f32::max),
        samples.iter().zip(samples.iter().skip(columns)).fold(0.0, rise),
    ]
}
