//! From stored samples to heights: marks of nodes without data, scale and offset.

use std::ops::RangeInclusive;

use super::map::HeightMap;
use crate::scene::shown::shown;

/// What stored samples mean.
#[derive(Clone, Debug)]
pub(super) struct Conversion {
    /// Samples that mark nodes without data: what the file declares, and what the user says.
    marks: [RangeInclusive<f64>; 2],
    /// A height is `sample * scale + offset`.
    scale: f64,
    offset: f64,
    /// Stored samples are integers.
    whole: bool,
}

/// Beyond this a sample of 32 bits is no height, and near a mark as large it is that mark.
const HUGE: f64 = 1e30;

/// Samples that count as a mark.
///
/// Marks stand in files as decimals, and samples as 32-bit floats at most times: what is nearer
/// than 4 roundings of such a float is the mark, as GDAL has it; and of marks near the largest float,
/// which are written with two digits or with seventeen, any sample as huge.
fn like(mark: f64) -> RangeInclusive<f64> {
    let slack = 4.0 * f64::from(f32::EPSILON) * mark.abs();
    if mark <= -HUGE {
        f64::NEG_INFINITY..=-HUGE
    } else if mark >= HUGE {
        HUGE..=f64::INFINITY
    } else {
        mark - slack..=mark + slack
    }
}

impl Conversion {
    /// Of samples that are floats.
    pub(super) fn of_floats(declared: Option<f64>, asked: Option<f64>) -> Self {
        let range = |mark: Option<f64>| like(mark.unwrap_or(f64::NAN));
        Self { marks: [range(declared), range(asked)], scale: 1.0, offset: 0.0, whole: false }
    }

    /// Of samples that are integers, which are a mark or are not.
    pub(super) fn of_integers(declared: Option<f64>, asked: Option<f64>) -> Self {
        let range = |mark: Option<f64>| {
            let mark = mark.unwrap_or(f64::NAN);
            mark..=mark
        };
        Self { marks: [range(declared), range(asked)], scale: 1.0, offset: 0.0, whole: true }
    }

    pub(super) fn scaled(self, scale: f64, offset: f64) -> Self {
        Self { scale, offset, ..self }
    }

    pub(super) fn is_scaled(&self) -> bool {
        (self.scale, self.offset) != (1.0, 0.0)
    }

    /// The height of a sample, NaN of a mark; and whether it had to be rounded, which is not asked
    /// of samples with a scale.
    #[inline]
    pub(super) fn height(&self, sample: f64) -> (f32, bool) {
        if self.marks[0].contains(&sample) || self.marks[1].contains(&sample) {
            return (f32::NAN, false);
        }
        if self.is_scaled() {
            return ((sample * self.scale + self.offset) as f32, false);
        }
        let height = sample as f32;
        (height, f64::from(height) != sample && sample.is_finite())
    }
}

/// Samples that usually mark nodes without data.
const USUAL: [f64; 12] = [
    -9999.0,
    -99999.0,
    -32768.0,
    -32767.0,
    -10000.0,
    9999.0,
    32767.0,
    65535.0,
    99999.0,
    -2_147_483_648.0,
    2_147_483_647.0,
    4_294_967_295.0,
];

/// An extreme farther from all other heights than so many times their range stands out.
const FAR_OFF: f64 = 2.0;

/// Extremes that look like marks which the file does not declare, a sentence each.
pub(super) fn suspicions(map: &HeightMap, conversion: &Conversion) -> Vec<String> {
    let (low, high) = map.range();
    // The extremes but for their equals.
    let (mut above, mut below) = (f32::INFINITY, f32::NEG_INFINITY);
    let (mut lowest, mut highest) = (0_usize, 0_usize);
    for &height in map.samples() {
        lowest += usize::from(height == low);
        highest += usize::from(height == high);
        above = above.min(if height > low { height } else { f32::INFINITY });
        below = below.max(if height < high { height } else { f32::NEG_INFINITY });
    }
    if low == high {
        return Vec::new();
    }
    let [low64, high64, above, below] = [low, high, above, below].map(f64::from);
    [
        ("lowest", low64, lowest, above - low64, high64 - above),
        ("highest", high64, highest, high64 - below, below - low64),
    ]
    .into_iter()
    .filter_map(|(which, extreme, nodes, gap, range)| {
        let usual = USUAL.iter().any(|&mark| f64::from(conversion.height(mark).0) == extreme);
        let far_off = gap > FAR_OFF * range && range > 0.0;
        let why = if usual || extreme.abs() > HUGE {
            "a usual mark of nodes without data"
        } else if far_off {
            "far off all others"
        } else {
            return None;
        };
        // As it is stored, so that the option that is named marks it.
        let stored = (extreme - conversion.offset) / conversion.scale;
        let usual = USUAL.iter().find(|&&mark| f64::from(conversion.height(mark).0) == extreme);
        let stored =
            usual.copied().unwrap_or(if conversion.whole { stored.round() } else { stored });
        let have = if nodes == 1 { "1 node has".to_owned() } else { format!("{nodes} nodes have") };
        Some(format!(
            "{have} the {which} height, {}, which is {why} and not declared by the file: where it \
             means no data, add --nodata {}",
            brief(extreme),
            brief(stored)
        ))
    })
    .collect()
}

/// A number without the point of a whole one.
fn brief(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 { format!("{value:.0}") } else { shown(value) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_mark(mark: f64, sample: f64) -> bool {
        Conversion::of_floats(Some(mark), None).height(sample).0.is_nan()
    }

    #[test]
    fn marks_are_compared_as_floats_of_32_bits() {
        let lowest = f64::from(f32::MIN);
        for mark in [-3.402_823_466_385_288_6e38, -3.402_823_466_4e38, -3.4e38, -3.402_823e38] {
            assert!(is_mark(mark, lowest) && is_mark(mark, mark), "{mark}");
            assert!(!is_mark(mark, 0.0) && !is_mark(mark, -11_000.0) && !is_mark(mark, -mark));
        }
        assert!(is_mark(-9999.9, f64::from(-9999.9_f32)));
        assert!(is_mark(0.0, 0.0) && !is_mark(0.0, f64::from(f32::MIN_POSITIVE)));
        assert!(!is_mark(-9999.0, -9998.0) && !is_mark(-9999.0, -9998.9));
        assert!(is_mark(1e38, f64::INFINITY));
        assert!(!is_mark(f64::NAN, 5.0));
        let integers = Conversion::of_integers(Some(-1e9), Some(7.0));
        assert!(integers.height(-1e9).0.is_nan() && integers.height(7.0).0.is_nan());
        assert_eq!(integers.height(-1e9 + 1.0).0, -1e9);
    }

    #[test]
    fn scale_and_offset() {
        let scaled = Conversion::of_integers(Some(-32768.0), None).scaled(0.1, -100.0);
        assert_eq!(scaled.height(1539.0).0, 53.9);
        assert!(scaled.height(-32768.0).0.is_nan());
        assert_eq!(Conversion::of_floats(None, None).height(0.1), (0.1, true));
    }

    fn suspicious(samples: &[f32]) -> String {
        let map = HeightMap::new(samples.len(), 1, samples.to_vec());
        suspicions(&map, &Conversion::of_floats(None, None)).join("\n")
    }

    #[test]
    fn extremes_at_both_ends_are_named() {
        assert_eq!(suspicious(&[1.0, 2.0, 3.5]), "");
        assert_eq!(suspicious(&[7.0, 7.0]), "");
        let low = suspicious(&[-9999.0, 2.0, 3.5, -9999.0]);
        assert!(low.contains("2 nodes have the lowest height, -9999,") && !low.contains("highest"));
        assert!(suspicious(&[65535.0, 153.0, 700.0]).contains("--nodata 65535"));
        assert!(suspicious(&[f32::MIN, 153.0, 700.0]).contains("a usual mark"));
        assert!(suspicious(&[-2000.0, 153.0, 700.0]).contains("far off"));
        assert!(suspicious(&[2_147_483_647.0, 153.0, 700.0]).contains("--nodata 2147483647"));
        let both = suspicious(&[-32768.0, 32767.0, 5.0]);
        assert!(both.contains("lowest") && both.contains("highest"));
        // As stored, where heights are scaled.
        let map = HeightMap::new(3, 1, vec![-3276.8 - 100.0, 153.0, 700.0]);
        let scaled = Conversion::of_integers(None, None).scaled(0.1, -100.0);
        let found = suspicions(&map, &scaled).join("\n");
        assert!(found.contains("--nodata -32768"), "{found}");
    }
}
