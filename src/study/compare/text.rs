//! Comparisons in words.

use std::fmt;

use super::{ArrayComparison, BufferComparison, Comparison, PictureComparison, PixelDifference};
use crate::study::ssim::WINDOW;

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Picture(picture) => picture.fmt(f),
            Self::Buffers(buffers) => buffers.fmt(f),
        }
    }
}

impl fmt::Display for PictureComparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} x {} pixels: ", self.columns, self.lines)?;
        let (Some(first), Some(worst)) = (self.first, self.worst) else {
            return f.write_str("identical");
        };
        writeln!(f, "{} differ ({:.3} %)", self.differing_pixels, 100.0 * self.differing_share)?;
        writeln!(
            f,
            "difference: max {}, 95 % of the pixels that differ within {}, RMS {:.4}, PSNR {:.2} dB",
            self.max_difference, self.p95_difference, self.rms, self.psnr_db
        )?;
        match self.ssim {
            Some(ssim) => writeln!(f, "SSIM: {ssim:.6}")?,
            None => writeln!(f, "SSIM: none, its window needs {WINDOW} pixels on each side")?,
        }
        writeln!(f, "first: {first}")?;
        write!(f, "worst: {worst}")
    }
}

impl fmt::Display for PixelDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { column, line, a, b, difference } = self;
        write!(f, "column {column}, line {line}: {a:?} and {b:?}, {difference} apart")
    }
}

impl fmt::Display for BufferComparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.identical { "identical" } else { "different" })?;
        for array in &self.arrays {
            write!(f, "\n{array}")?;
        }
        for (names, which) in [(&self.only_in_a, "first"), (&self.only_in_b, "second")] {
            for name in names {
                write!(f, "\n{name}: only in the {which}")?;
                if self.not_counted.contains(name) {
                    f.write_str(", which no --max-diff counts: not every engine gives it")?;
                }
            }
        }
        Ok(())
    }
}

impl fmt::Display for ArrayComparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, elements, differing, .. } = self;
        if *differing == 0 {
            return write!(f, "{name}: identical, {elements} elements");
        }
        let share = 100.0 * self.differing_share;
        write!(f, "{name}: {differing} of {elements} differ ({share:.3} %)")?;
        write!(f, ", max {:.4e}, RMS {:.4e}", self.max_difference, self.rms)?;
        if let Some(worst) = &self.worst {
            write!(f, ", worst at {worst:?}")?;
        }
        if self.unmatched > 0 {
            write!(f, ", {} with no finite difference", self.unmatched)?;
        }
        Ok(())
    }
}
