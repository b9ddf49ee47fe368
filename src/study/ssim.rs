//! Structural similarity of two pictures.
//!
//! Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment: from error visibility to
//! structural similarity" (2004): Gaussian window of 11 x 11 with sigma 1.5, K1 = 0.01, K2 = 0.03,
//! range 255, population covariance, mean over the windows that lie inside the picture, then over
//! the three channels. scikit-image gives the same with `structural_similarity(a, b,
//! gaussian_weights=True, sigma=1.5, use_sample_covariance=False, channel_axis=-1,
//! data_range=255)`.

use rayon::prelude::*;

/// Side of the window in pixels.
pub const WINDOW: usize = 11;

const SIGMA: f64 = 1.5;
const C1: f64 = (0.01 * 255.0) * (0.01 * 255.0);
const C2: f64 = (0.03 * 255.0) * (0.03 * 255.0);

/// Lines of windows that one thread takes at a time.
const BAND: usize = 64;

/// Weighted sums over a window: a, b, a², b², ab.
type Sums = [f64; 5];

/// Structural similarity of two pictures of `lines * columns` pixels, -1..=1, 1 for equal ones;
/// the same on any number of threads. `None` if a side is shorter than [`WINDOW`].
///
/// # Panics
/// If a slice has not `columns * lines` pixels.
pub fn ssim(columns: usize, lines: usize, a: &[[u8; 3]], b: &[[u8; 3]]) -> Option<f64> {
    assert!(a.len() == columns * lines && b.len() == columns * lines);
    if columns < WINDOW || lines < WINDOW {
        return None;
    }
    let (across, down) = (columns + 1 - WINDOW, lines + 1 - WINDOW);
    let bands: Vec<f64> = (0..down.div_ceil(BAND))
        .into_par_iter()
        .map(|band| {
            let windows = band * BAND..down.min((band + 1) * BAND);
            let pixels = windows.start * columns..(windows.end + WINDOW - 1) * columns;
            let (a, b) = (&a[pixels.clone()], &b[pixels]);
            (0..3).map(|channel| band_sum(columns, a, b, channel)).sum()
        })
        .collect();
    Some(bands.iter().sum::<f64>() / (3 * across * down) as f64)
}

/// Sum of the similarities of all windows that lie in some lines, one channel.
fn band_sum(columns: usize, a: &[[u8; 3]], b: &[[u8; 3]], channel: usize) -> f64 {
    let weights = weights();
    // The last WINDOW lines, summed across.
    let mut ring = vec![vec![[0.0; 5]; columns + 1 - WINDOW]; WINDOW];
    let mut products: Vec<Sums> = Vec::with_capacity(columns);
    let mut sum = 0.0;
    for (line, (a, b)) in a.chunks(columns).zip(b.chunks(columns)).enumerate() {
        products.clear();
        products.extend(a.iter().zip(b).map(|(a, b)| {
            let (a, b) = (f64::from(a[channel]), f64::from(b[channel]));
            [a, b, a * a, b * b, a * b]
        }));
        for (to, from) in ring[line % WINDOW].iter_mut().zip(products.windows(WINDOW)) {
            *to = weighted(&weights, from.iter());
        }
        if line + 1 >= WINDOW {
            // The oldest line is the one that is overwritten next.
            let order: [&[Sums]; WINDOW] =
                std::array::from_fn(|k| &ring[(line + 1 + k) % WINDOW][..]);
            sum += (0..order[0].len())
                .map(|x| similarity(weighted(&weights, order.iter().map(|line| &line[x]))))
                .sum::<f64>();
        }
    }
    sum
}

/// The window along one axis; sums to 1.
fn weights() -> [f64; WINDOW] {
    let bell: [f64; WINDOW] = std::array::from_fn(|k| {
        let t = (k as f64 - (WINDOW / 2) as f64) / SIGMA;
        libm::exp(-0.5 * t * t)
    });
    let sum: f64 = bell.iter().sum();
    bell.map(|w| w / sum)
}

fn weighted<'a>(weights: &[f64; WINDOW], values: impl Iterator<Item = &'a Sums>) -> Sums {
    let mut sums = [0.0; 5];
    for (w, value) in weights.iter().zip(values) {
        for (sum, v) in sums.iter_mut().zip(value) {
            *sum += w * v;
        }
    }
    sums
}

/// Similarity in one window.
fn similarity([a, b, aa, bb, ab]: Sums) -> f64 {
    let (va, vb, vab) = (aa - a * a, bb - b * b, ab - a * b);
    (2.0 * a * b + C1) * (2.0 * vab + C2) / ((a * a + b * b + C1) * (va + vb + C2))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture by a formula in integers.
    fn picture(columns: usize, lines: usize, kind: char) -> Vec<[u8; 3]> {
        let pixel = |place: usize| -> [u8; 3] {
            let (c, l) = (place % columns, place / columns);
            std::array::from_fn(|ch| {
                let base = (c * 7 + l * 13 + ch * 50 + c * l / 3) % 256;
                let value = match kind {
                    'a' => base,
                    'b' => (base + (c * 31 + l * 17 + ch * 5) % 23).saturating_sub(11).min(255),
                    'c' => (c * c + l * 3 + ch * 90) % 256,
                    'd' => 255 - base,
                    'e' => 100 + ch,
                    'f' => 101 + ch + (c + l) % 2,
                    'g' if l == 9 => 0,
                    'g' => base,
                    other => unreachable!("{other}"),
                };
                u8::try_from(value).unwrap()
            })
        };
        (0..columns * lines).map(pixel).collect()
    }

    /// Values of scikit-image 0.26.0 with numpy 2.4.6.
    const SCIKIT_IMAGE: [(usize, usize, &str, f64); 20] = [
        (32, 24, "ab", 0.987728597605127),
        (32, 24, "ac", 0.07318850021763396),
        (32, 24, "ad", -0.7727215770843768),
        (32, 24, "ef", 0.9956381276087588),
        (32, 24, "ag", 0.832782770944),
        (11, 11, "ab", 0.9755708555843584),
        (11, 11, "ac", 0.40452297816515287),
        (11, 11, "ad", -0.7344994193009463),
        (11, 11, "ef", 0.9956381276101318),
        (11, 11, "ag", 0.8673506445792997),
        (17, 40, "ab", 0.9874380378787674),
        (17, 40, "ac", 0.13587871248711733),
        (17, 40, "ad", -0.7630457295610742),
        (17, 40, "ef", 0.9956381276087592),
        (17, 40, "ag", 0.9167727958385647),
        (90, 170, "ab", 0.9950662457136996),
        (90, 170, "ac", 0.01238042336601488),
        (90, 170, "ad", -0.9423854976856684),
        (90, 170, "ef", 0.9956381276087591),
        (90, 170, "ag", 0.9867249084563975),
    ];

    #[test]
    fn agrees_with_scikit_image() {
        for (columns, lines, pair, expected) in SCIKIT_IMAGE {
            let mut kinds = pair.chars().map(|kind| picture(columns, lines, kind));
            let (a, b) = (kinds.next().unwrap(), kinds.next().unwrap());
            let found = ssim(columns, lines, &a, &b).unwrap();
            // Both sum in f64; a flat picture cancels to about 1e-12.
            assert!((found - expected).abs() < 1e-11, "{pair} {columns}x{lines}: {found}");
        }
    }

    #[test]
    fn equal_pictures_give_exactly_one() {
        let a = picture(40, 90, 'b');
        assert_eq!(ssim(40, 90, &a, &a), Some(1.0));
    }

    #[test]
    fn small_pictures_have_none() {
        assert_eq!(ssim(10, 40, &picture(10, 40, 'a'), &picture(10, 40, 'b')), None);
        assert_eq!(ssim(40, 10, &picture(40, 10, 'a'), &picture(40, 10, 'b')), None);
        assert_eq!(ssim(0, 0, &[], &[]), None);
    }
}
