//! Two frames, or the buffers of two frames, side by side.

mod text;

use std::fs::File;
use std::io::{Read, Seek};
use std::path::{Path, PathBuf};

use serde::Serialize;
use thiserror::Error;

use super::ssim::ssim;
use crate::frame::{Giver, TABLE};
use crate::sink::ReadError;
use crate::sink::npz::Npz;
use crate::sink::png::{self, Image};

/// Why two files could not be compared.
#[derive(Debug, Error)]
pub enum CompareError {
    /// One of them could not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// One is a picture, the other holds buffers.
    #[error(
        "cannot compare {picture} with {buffers}: one is a picture, the other holds buffers; \
         give two .png files or two .npz files"
    )]
    Kind {
        /// The file that is a picture.
        picture: PathBuf,
        /// The file that holds buffers.
        buffers: PathBuf,
    },
    /// Pictures of different sizes.
    #[error(
        "cannot compare a picture of {} x {} pixels with one of {} x {}; \
         render both at one size", a[0], a[1], b[0], b[1]
    )]
    Size {
        /// Columns and lines of the first picture.
        a: [usize; 2],
        /// Columns and lines of the second picture.
        b: [usize; 2],
    },
    /// Arrays of one name and different shapes.
    #[error("cannot compare `{name}` of shape {a:?} with {b:?}; render both at one size")]
    Shape {
        /// Name of the arrays.
        name: String,
        /// Shape of the first.
        a: Vec<usize>,
        /// Shape of the second.
        b: Vec<usize>,
    },
}

/// Result of comparing two files.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Comparison {
    /// Of two pictures.
    Picture(PictureComparison),
    /// Of two sets of buffers.
    Buffers(BufferComparison),
}

impl Comparison {
    /// What differs by more than `max_difference` (levels of 255 in pictures, the units of each
    /// array in buffers), a few words each: also values that are finite or NaN on one side only,
    /// and arrays that are missing on one side, but for those that not every engine gives.
    pub fn beyond(&self, max_difference: f64) -> Vec<String> {
        match self {
            Self::Picture(picture) => (f64::from(picture.max_difference) > max_difference)
                .then(|| format!("a channel differs by {}", picture.max_difference))
                .into_iter()
                .collect(),
            Self::Buffers(buffers) => {
                let array = |a: &ArrayComparison| match (a.unmatched, a.max_difference) {
                    (0, difference) if difference <= max_difference => None,
                    (0, difference) => Some(format!("{} differs by {difference:e}", a.name)),
                    (count, _) => Some(format!("{} is finite on one side only, {count} times", a.name)),
                };
                let missing = |names: &[String], which: &str| -> Vec<String> {
                    let names = names.iter().filter(|name| !buffers.not_counted.contains(name));
                    names.map(|name| format!("{name} is only in the {which}")).collect()
                };
                let arrays = buffers.arrays.iter().filter_map(array);
                let only_in_a = missing(&buffers.only_in_a, "first");
                arrays.chain(only_in_a).chain(missing(&buffers.only_in_b, "second")).collect()
            }
        }
    }

    /// Whether nothing is [`beyond`](Self::beyond) a difference.
    pub fn is_within(&self, max_difference: f64) -> bool {
        self.beyond(max_difference).is_empty()
    }
}

/// Differences between two pictures, in levels of 0..=255.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PictureComparison {
    /// Pixels across.
    pub columns: usize,
    /// Scan lines.
    pub lines: usize,
    /// No pixel differs.
    pub identical: bool,
    /// Largest difference in a channel.
    pub max_difference: u8,
    /// 95 % of the pixels that differ do so by no more than this; 0 where none does.
    pub p95_difference: u8,
    /// Root of the mean square over pixels and channels.
    pub rms: f64,
    /// `20 log10(255 / rms)`; infinite for identical pictures (null in JSON).
    pub psnr_db: f64,
    /// Structural similarity, see [`ssim`]; `None` for pictures narrower or lower than 11 pixels.
    pub ssim: Option<f64>,
    /// Pixels that differ in at least one channel.
    pub differing_pixels: usize,
    /// Their share of all pixels, 0..=1.
    pub differing_share: f64,
    /// First pixel that differs, line by line from the top.
    pub first: Option<PixelDifference>,
    /// Pixel with the largest difference in a channel, the first of equals.
    pub worst: Option<PixelDifference>,
}

/// One pixel of two pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct PixelDifference {
    /// Column from the left, from 0.
    pub column: usize,
    /// Line from the top, from 0.
    pub line: usize,
    /// sRGB bytes in the first picture.
    pub a: [u8; 3],
    /// sRGB bytes in the second picture.
    pub b: [u8; 3],
    /// Largest difference in a channel.
    pub difference: u8,
}

/// Differences between two sets of buffers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BufferComparison {
    /// No element of any array differs, and no array is missing on one side.
    pub identical: bool,
    /// Arrays of both, in the order of the first.
    pub arrays: Vec<ArrayComparison>,
    /// Names of arrays that only the first has.
    pub only_in_a: Vec<String>,
    /// Names of arrays that only the second has.
    pub only_in_b: Vec<String>,
    /// Those of them that no maximum is asked of, since not every engine gives them.
    pub not_counted: Vec<String>,
}

/// Differences between two arrays, in their own unit. NaN equals NaN.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ArrayComparison {
    /// Name of the array.
    pub name: String,
    /// Length of each axis.
    pub shape: Vec<usize>,
    /// Number of elements.
    pub elements: usize,
    /// Elements that differ.
    pub differing: usize,
    /// Their share of all elements, 0..=1.
    pub differing_share: f64,
    /// Elements that differ without a finite distance: NaN or an infinity on at least one side.
    pub unmatched: usize,
    /// Largest difference, unmatched elements left out.
    pub max_difference: f64,
    /// Root of the mean square difference, unmatched elements left out; infinite (null in JSON)
    /// where a square exceeds an `f64`.
    pub rms: f64,
    /// Index of the first element that differs, one number per axis.
    pub first: Option<Vec<usize>>,
    /// Index of the element with the largest difference, the first of equals; unmatched elements
    /// are left out.
    pub worst: Option<Vec<usize>>,
}

/// Compares two PNG files or two `.npz` files; `.npz` is recognised by its name or its first bytes.
///
/// # Errors
/// [`CompareError`] when a file cannot be read, the two are of different kinds, or their sizes
/// differ.
pub fn compare_files(a: &Path, b: &Path) -> Result<Comparison, CompareError> {
    match (holds_buffers(a)?, holds_buffers(b)?) {
        (false, false) => {
            let (a, b) = (png::read(a)?, png::read(b)?);
            Ok(Comparison::Picture(compare_pictures(&a, &b)?))
        }
        (true, true) => {
            let (mut a, mut b) = (Npz::open(a)?, Npz::open(b)?);
            Ok(Comparison::Buffers(compare_buffers(&mut a, &mut b)?))
        }
        (false, true) => Err(CompareError::Kind { picture: a.to_owned(), buffers: b.to_owned() }),
        (true, false) => Err(CompareError::Kind { picture: b.to_owned(), buffers: a.to_owned() }),
    }
}

fn holds_buffers(path: &Path) -> Result<bool, ReadError> {
    let mut start = Vec::new();
    File::open(path)
        .and_then(|file| file.take(4).read_to_end(&mut start))
        .map_err(|error| ReadError::open(path, &error))?;
    let named = path.extension().is_some_and(|name| name.eq_ignore_ascii_case("npz"));
    Ok(start == *b"PK\x03\x04" || named)
}

/// Compares two pictures.
///
/// # Errors
/// [`CompareError::Size`] when their sizes differ.
///
/// # Panics
/// If a picture has not `columns * lines` pixels.
pub fn compare_pictures(a: &Image, b: &Image) -> Result<PictureComparison, CompareError> {
    same_size(a, b)?;
    let (mut squares, mut differing_pixels) = (0_u64, 0);
    let (mut first, mut worst) = (None, None::<PixelDifference>);
    let mut counts = [0_usize; 256];
    for (place, (&p, &q)) in a.pixels.iter().zip(&b.pixels).enumerate() {
        if p == q {
            continue;
        }
        let apart = apart(p, q);
        let pixel = PixelDifference {
            column: place % a.columns,
            line: place / a.columns,
            a: p,
            b: q,
            difference: apart[0].max(apart[1]).max(apart[2]),
        };
        differing_pixels += 1;
        counts[usize::from(pixel.difference)] += 1;
        squares += apart.iter().map(|&d| u64::from(d) * u64::from(d)).sum::<u64>();
        first.get_or_insert(pixel);
        if worst.is_none_or(|worst| pixel.difference > worst.difference) {
            worst = Some(pixel);
        }
    }
    let pixels = a.pixels.len();
    let mut below = 0;
    let p95_difference = (0..=u8::MAX).find(|&difference| {
        below += counts[usize::from(difference)];
        20 * below >= 19 * differing_pixels
    });
    let rms = (squares as f64 / (3 * pixels).max(1) as f64).sqrt();
    Ok(PictureComparison {
        columns: a.columns,
        lines: a.lines,
        identical: differing_pixels == 0,
        max_difference: worst.map_or(0, |worst| worst.difference),
        p95_difference: p95_difference.unwrap_or_default(),
        rms,
        psnr_db: 20.0 * libm::log10(255.0 / rms),
        ssim: ssim(a.columns, a.lines, &a.pixels, &b.pixels),
        differing_pixels,
        differing_share: differing_pixels as f64 / pixels.max(1) as f64,
        first,
        worst,
    })
}

/// Absolute differences between two pictures, each channel times `gain`, at most 255.
///
/// # Errors
/// [`CompareError::Size`] when their sizes differ.
pub fn difference_picture(a: &Image, b: &Image, gain: u32) -> Result<Image, CompareError> {
    same_size(a, b)?;
    let amplify = |d: u8| u32::from(d).saturating_mul(gain).min(255) as u8;
    let pixels = a.pixels.iter().zip(&b.pixels).map(|(&p, &q)| apart(p, q).map(amplify)).collect();
    Ok(Image { columns: a.columns, lines: a.lines, pixels })
}

/// Largest factor by which differences up to `difference` can be multiplied within 255; 1 for none.
pub fn gain(difference: u8) -> u32 {
    255_u32.checked_div(difference.into()).unwrap_or(1)
}

fn same_size(a: &Image, b: &Image) -> Result<(), CompareError> {
    let (a, b) = ([a.columns, a.lines], [b.columns, b.lines]);
    if a == b { Ok(()) } else { Err(CompareError::Size { a, b }) }
}

fn apart(a: [u8; 3], b: [u8; 3]) -> [u8; 3] {
    std::array::from_fn(|c| a[c].abs_diff(b[c]))
}

/// Compares two sets of buffers, array by array and piece by piece.
///
/// # Errors
/// [`CompareError::Read`] when an array is damaged, [`CompareError::Shape`] when two arrays of
/// one name have different shapes.
pub fn compare_buffers<R: Read + Seek, S: Read + Seek>(
    a: &mut Npz<R>,
    b: &mut Npz<S>,
) -> Result<BufferComparison, CompareError> {
    let only = |names: &[String], others: &[String]| -> Vec<String> {
        names.iter().filter(|name| !others.contains(name)).cloned().collect()
    };
    let (only_in_a, only_in_b) = (only(a.names(), b.names()), only(b.names(), a.names()));
    let names: Vec<_> =
        a.names().iter().filter(|name| !only_in_a.contains(name)).cloned().collect();
    let arrays = names
        .iter()
        .map(|name| compare_arrays(a, b, name))
        .collect::<Result<Vec<_>, CompareError>>()?;
    let identical = only_in_a.is_empty()
        && only_in_b.is_empty()
        && arrays.iter().all(|array| array.differing == 0);
    let by_some = |name: &&String| {
        let row = TABLE.iter().find(|row| row.name == **name);
        row.is_some_and(|row| row.giver != Giver::Engines)
    };
    let not_counted = only_in_a.iter().chain(&only_in_b).filter(by_some).cloned().collect();
    Ok(BufferComparison { identical, arrays, only_in_a, only_in_b, not_counted })
}

fn compare_arrays<R: Read + Seek, S: Read + Seek>(
    a: &mut Npz<R>,
    b: &mut Npz<S>,
    name: &str,
) -> Result<ArrayComparison, CompareError> {
    let (mut a, mut b) = (a.array(name)?, b.array(name)?);
    let shape = a.header().shape.clone();
    if shape != b.header().shape {
        let b = b.header().shape.clone();
        return Err(CompareError::Shape { name: name.to_owned(), a: shape, b });
    }
    let (mut elements, mut differing, mut unmatched) = (0, 0, 0);
    let (mut squares, mut max_difference) = (0.0, 0.0);
    let (mut first, mut worst) = (None, None);
    let (mut piece_a, mut piece_b) = (Vec::new(), Vec::new());
    loop {
        a.next_piece(&mut piece_a)?;
        b.next_piece(&mut piece_b)?;
        if piece_a.is_empty() {
            break;
        }
        for (place, (&p, &q)) in (elements..).zip(piece_a.iter().zip(&piece_b)) {
            if p == q || (p.is_nan() && q.is_nan()) {
                continue;
            }
            differing += 1;
            first.get_or_insert(place);
            let difference = (p - q).abs();
            if !difference.is_finite() {
                unmatched += 1;
                continue;
            }
            squares += difference * difference;
            if difference > max_difference {
                max_difference = difference;
                worst = Some(place);
            }
        }
        elements += piece_a.len();
    }
    Ok(ArrayComparison {
        name: name.to_owned(),
        elements,
        differing,
        differing_share: differing as f64 / elements.max(1) as f64,
        unmatched,
        max_difference,
        rms: (squares / (elements - unmatched).max(1) as f64).sqrt(),
        first: first.map(|place| index(place, &shape)),
        worst: worst.map(|place| index(place, &shape)),
        shape,
    })
}

/// Index per axis of an element at a place in C order.
fn index(mut place: usize, shape: &[usize]) -> Vec<usize> {
    let mut index: Vec<usize> = shape
        .iter()
        .rev()
        .map(|&axis| {
            let along = place % axis;
            place /= axis;
            along
        })
        .collect();
    index.reverse();
    index
}
