//! TOML under construction, bare or with the meaning of every key beside it.

use glam::DVec3;

/// Columns of a comment.
const WIDTH: usize = 100;

/// Key after key, table after table.
#[derive(Default)]
pub(super) struct Writer {
    text: String,
    comments: bool,
    /// Whether keys are written as comments: they could stand here and do not.
    aside: bool,
}

impl Writer {
    /// A writer that says of every key what it means and which values it takes.
    pub(super) fn with_comments() -> Self {
        Self { comments: true, ..Self::default() }
    }

    pub(super) fn finish(self) -> String {
        self.text
    }

    /// Lines of comment, if this writer makes any.
    pub(super) fn comment(&mut self, text: &str) {
        if !self.comments {
            return;
        }
        let mut line = String::from("#");
        for word in text.split_whitespace() {
            if line.len() + 1 + word.len() > WIDTH {
                self.text += &(line + "\n");
                line = String::from("#");
            }
            line = line + " " + word;
        }
        self.text += &(line + "\n");
    }

    pub(super) fn key(&mut self, key: &str, value: &str) {
        self.line(&format!("{key} = {value}"));
    }

    /// An empty line below what is there.
    pub(super) fn blank(&mut self) {
        if !self.text.is_empty() {
            self.text.push('\n');
        }
    }

    /// The head of a table, as in `[camera]` or `[[screen]]`.
    pub(super) fn head(&mut self, head: &str) {
        self.blank();
        self.line(head);
    }

    fn line(&mut self, line: &str) {
        self.text += if self.aside { "# " } else { "" };
        self.text += line;
        self.text.push('\n');
    }

    /// What could stand here and does not, as comments, if this writer makes any.
    pub(super) fn aside(&mut self, write: impl FnOnce(&mut Self)) {
        if self.comments {
            let before = std::mem::replace(&mut self.aside, true);
            write(self);
            self.aside = before;
        }
    }
}

/// Degrees that read back as these radians: the shortest of few decimals, or the nearest that do.
pub(super) fn degrees(radians: f64) -> f64 {
    let near = radians.to_degrees();
    let reads_back = |degrees: &f64| (degrees % 360.0).to_radians() == radians;
    let rounded = (0..=9).map(|digits| {
        let unit = 10.0_f64.powi(digits);
        (near * unit).round() / unit
    });
    let (mut above, mut below) = (near, near);
    let neighbours = std::iter::once(near).chain((0..8).flat_map(|_| {
        (above, below) = (above.next_up(), below.next_down());
        [above, below]
    }));
    rounded.chain(neighbours).find(reads_back).unwrap_or(near)
}

/// Whether a vector is as near to unit length as normalising makes one: it is then taken as it is,
/// so that directions that were written by the program are read back in every bit.
pub(super) fn is_unit(vector: DVec3) -> bool {
    (vector.length() - 1.0).abs() <= 1e-15
}

/// A vector of few decimals that is this unit vector when it is read, or the unit vector itself.
pub(super) fn direction(unit: DVec3) -> DVec3 {
    let parts = unit.to_array().map(f64::abs).into_iter().filter(|part| *part > 1e-3);
    let short = parts.flat_map(|part| {
        (0..=2).map(move |digits| {
            let decimal = 10.0_f64.powi(digits);
            (unit / part * decimal).round() / decimal
        })
    });
    let reads_back = |v: &DVec3| !is_unit(*v) && v.normalize() == unit;
    short.into_iter().find(reads_back).unwrap_or(unit)
}
