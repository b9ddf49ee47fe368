//! Pictures of errors: which of them, on which ramp.

use super::{Legend, NOTHING, Painted, SEQUENCE, SILHOUETTE, ramp};
use crate::engine::ErrorParts;

/// Upper end of the ramp of [`error`] over its lower end.
pub const ERROR_SPAN: f64 = 1024.0;

/// Which errors a picture shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum ErrorPart {
    /// Fixed point against the oracle.
    #[default]
    Total,
    /// The units in f64 against the oracle.
    Algorithm,
    /// Fixed point against the units in f64.
    Quantisation,
}

impl ErrorPart {
    /// Name on the command line and in legends.
    pub fn name(self) -> &'static str {
        match self {
            Self::Total => "total",
            Self::Algorithm => "algorithm",
            Self::Quantisation => "quantisation",
        }
    }

    /// The part of a pixel's errors.
    pub fn of(self, errors: ErrorParts) -> f64 {
        match self {
            Self::Total => errors.total,
            Self::Algorithm => errors.algorithm,
            Self::Quantisation => errors.quantisation,
        }
    }
}

/// How a picture shows errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorView {
    /// Which of them.
    pub part: ErrorPart,
    /// Pixels at the bright end, positive; `None`: as what is drawn needs.
    pub high: Option<f64>,
}

/// Errors in pixels (their sign is dropped) on a logarithmic ramp that ends at `high` and begins at
/// the [`ERROR_SPAN`]th part of it; NaN is [`NOTHING`], and a pixel marked in `silhouette` is
/// [`SILHOUETTE`], whatever its error. A `silhouette` that is too short marks nothing beyond its end.
/// Without `high` the ramp ends at the power of two at or above the 99.5th percentile.
pub fn error(errors: &[f64], silhouette: &[bool], high: Option<f64>) -> Painted {
    let high = high.unwrap_or_else(|| range(errors));
    let low = high / ERROR_SPAN;
    let marks = silhouette.iter().copied().chain(std::iter::repeat(false));
    let span = libm::log2(ERROR_SPAN);
    let pixels = errors
        .iter()
        .zip(marks)
        .map(|(&e, marked)| match e.abs() {
            _ if marked => SILHOUETTE,
            e if e.is_nan() => NOTHING,
            e if e <= low => ramp(&SEQUENCE, 0.0),
            e => ramp(&SEQUENCE, libm::log2(e / low) / span),
        })
        .collect();
    let legend = Some(Legend { low, high, unit: "pixels", logarithmic: true });
    Painted { pixels, legend }
}

/// The power of two at or above the 99.5th percentile of finite errors; 1 without any but 0.
fn range(errors: &[f64]) -> f64 {
    let mut sizes: Vec<f64> =
        errors.iter().map(|e| e.abs()).filter(|e| e.is_finite() && *e > 0.0).collect();
    let Some(rank) = sizes.len().checked_sub(sizes.len() / 200 + 1) else { return 1.0 };
    let (_, &mut at, _) = sizes.select_nth_unstable_by(rank, f64::total_cmp);
    libm::exp2(libm::ceil(libm::log2(at)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_logarithmic_and_silhouettes_marked() {
        let errors = [0.0, 1.0 / 256.0, 0.125, -4.0, f64::INFINITY, f64::NAN, 1.0, f64::NAN];
        let marks = [false, false, false, false, false, false, true, true];
        let painted = error(&errors, &marks, Some(4.0));
        let expected = [
            SEQUENCE[0],
            SEQUENCE[0],
            ramp(&SEQUENCE, 0.5),
            SEQUENCE[7],
            SEQUENCE[7],
            NOTHING,
            SILHOUETTE,
            SILHOUETTE,
        ];
        assert_eq!(painted.pixels, expected);
        assert_eq!(error(&errors, &[], None).pixels.len(), errors.len());
        let ends = |errors: &[f64]| error(errors, &[], None).legend.map(|l| (l.low, l.high));
        assert_eq!(ends(&[0.003, -0.0011, f64::NAN]), Some((1.0 / 262_144.0, 1.0 / 256.0)));
        assert_eq!(ends(&[0.0, f64::NAN]), Some((1.0 / 1024.0, 1.0)));
    }
}
