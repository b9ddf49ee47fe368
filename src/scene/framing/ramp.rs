//! Colours from the lowest node to the highest.

use crate::scene::height_map::HeightMap;

/// Lowland, meadow, steppe, rock, scree, snow.
pub const LAND: [[u8; 3]; 6] = [
    [66, 110, 66],
    [142, 166, 96],
    [214, 198, 138],
    [170, 128, 92],
    [150, 138, 132],
    [248, 248, 250],
];

const SEA: [u8; 3] = [70, 116, 158];

/// A ramp has no more colours.
const MOST: usize = 16;

/// Nodes at exactly 0, as a share of those with data, that make a sea.
const FLOODED: f64 = 0.05;

/// Metres between two colours above which the blue of a sea would reach far inland.
const SHARPEST: f64 = 50.0;

/// The ramp for a map, and a remark on it, if there is one.
pub(super) fn choose(map: &HeightMap, height_unit_m: f64) -> (Vec<[u8; 3]>, Option<String>) {
    let (low, high) = map.range();
    let step = (f64::from(high) - f64::from(low)) / (MOST - 1) as f64;
    let share = |part: &dyn Fn(&&f32) -> bool, of: usize| {
        map.samples().iter().filter(part).count() as f64 / of as f64
    };
    let data = map.samples().len() - map.voids();
    // The first colour that is land is the second or the third.
    let floods = step > 0.0
        && step * height_unit_m <= SHARPEST
        && low <= 0.0
        && -f64::from(low) <= step
        && share(&|&&sample| sample == 0.0, data) >= FLOODED;
    if !floods {
        return (LAND.to_vec(), None);
    }
    let blue = if -f64::from(low) > step / 4.0 { 2 } else { 1 };
    let land = MOST - blue;
    let ramp = (0..MOST)
        .map(|at| match at.checked_sub(blue) {
            None => SEA,
            Some(at) => between(at as f64 / (land - 1) as f64),
        })
        .collect();
    let reason = format!(
        "{:.0} % of the nodes lie at exactly 0: they are taken for water, and what lies no more \
         than {:.2} above it is bluish too (color.ramp)",
        100.0 * share(&|&&sample| sample == 0.0, data),
        f64::from(low) + step * blue as f64
    );
    (ramp, Some(reason))
}

/// The colour of the land's ramp at a place from 0 to 1.
fn between(place: f64) -> [u8; 3] {
    let place = place * (LAND.len() - 1) as f64;
    let below = (place as usize).min(LAND.len() - 2);
    let share = place - below as f64;
    std::array::from_fn(|channel| {
        let [a, b] = [LAND[below], LAND[below + 1]].map(|color| f64::from(color[channel]));
        (a + (b - a) * share).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(samples: &[f32]) -> Vec<[u8; 3]> {
        choose(&HeightMap::new(samples.len() / 4, 4, samples.to_vec()), 1.0).0
    }

    #[test]
    fn a_sea_is_blue_and_nothing_else_is() {
        let coast = |low: f32, high: f32| {
            let mut samples = vec![0.0; 40];
            (samples[0], samples[1], samples[2]) = (low, high, f32::NAN);
            samples
        };
        // Below and at 0 the whole sea has one colour or nearly so.
        assert_eq!(ramp(&coast(0.0, 150.0))[..2], [SEA, LAND[0]]);
        assert_eq!(ramp(&coast(-9.0, 150.0))[..3], [SEA, SEA, LAND[0]]);
        assert_eq!(ramp(&coast(-9.0, 150.0)).last(), LAND.last());
        // Alps: 0 is no more than the lowest of many heights. Deep basins: 0 is somewhere in them.
        assert_eq!(ramp(&coast(0.0, 3000.0)), LAND);
        assert_eq!(ramp(&coast(-100.0, 150.0)), LAND);
        assert_eq!(ramp(&[0.0; 40]), LAND);
        assert_eq!(ramp(&(0..40).map(|k| k as f32).collect::<Vec<_>>()), LAND);
    }
}
