//! SRTM `.hgt`: a tile of big-endian 16-bit heights in metres, one degree wide and high, corner
//! nodes included.

use glam::DVec2;

use super::error::{MapError, check_size, gdal};
use super::found::{Found, HeightFile, Storage, thinned};
use super::georeference::{Coordinates, Georeference, PixelIs};
use super::interpretation::Interpretation;
use super::marks::Conversion;

/// What marks a node without data.
const VOID: i16 = i16::MIN;

/// Rows of the usual tiles: cells of 3 and of 1 arc seconds.
const USUAL_ROWS: [usize; 2] = [1201, 3601];

/// Cells are as high as wide, or, towards the poles, wider by one of these factors in halves.
const USUAL_WIDTHS: [usize; 6] = [2, 3, 4, 6, 8, 12];

/// Columns and rows of so many bytes: those of a usual tile, or else a square.
fn sides(bytes: usize) -> Option<(usize, usize)> {
    let samples = bytes / 2;
    let square = samples.isqrt();
    let usual = USUAL_ROWS.into_iter().find_map(|rows| {
        let columns = samples / rows;
        let cells = columns.saturating_sub(1);
        let is_usual = USUAL_WIDTHS.iter().any(|wide| cells * wide == (rows - 1) * 2);
        (cells > 0 && columns * rows == samples && is_usual).then_some((columns, rows))
    });
    let square = (square > 1 && square * square == samples).then_some((square, square));
    usual.or(square).filter(|_| bytes.is_multiple_of(2))
}

/// Whether a file of this length may be taken for a tile without its name saying so.
pub(super) fn usual_size(bytes: usize) -> bool {
    sides(bytes).is_some_and(|(columns, rows)| columns == rows && USUAL_ROWS.contains(&rows))
}

/// Decodes a tile; the name gives its place.
pub(super) fn decode(
    bytes: &[u8],
    name: &str,
    asked: &Interpretation,
) -> Result<HeightFile, MapError> {
    if let Some(order) = looks_like_floats(bytes) {
        return Err(MapError::new(
            name,
            format!(
                "its samples look like 32-bit floats ({order}), not like the 16-bit heights of a tile"
            ),
            format!(
                "give it a header that says so (ENVI's .hdr beside it, as radar programs write), \
                 then {}",
                gdal("gdal_translate", name)
            ),
        ));
    }
    let Some((columns, rows)) = sides(bytes.len()) else {
        return Err(MapError::new(
            name,
            format!("{} bytes are not a tile of 16-bit heights", bytes.len()),
            "a tile has 1201 x 1201 heights (2884802 bytes), 3601 x 3601 (25934402), fewer columns \
             towards the poles (1801 x 3601 are 12970802), or is another square",
        ));
    };
    check_size(name, columns as u64, rows as u64)?;
    let conversion = Conversion::of_integers(Some(f64::from(VOID)), asked.nodata);
    let (pairs, _) = bytes.as_chunks::<2>();
    let samples = pairs
        .iter()
        .map(|&pair| conversion.height(f64::from(i16::from_be_bytes(pair))).0)
        .collect();
    let mut notes = Vec::new();
    let origin = corner(name).map(|corner| corner + DVec2::new(0.0, 1.0));
    if origin.is_none() {
        notes.push(
            "the name is not that of a tile, as in N36W085.hgt, so the place is not known: cells \
             are taken as on the equator"
                .to_owned(),
        );
    }
    if !USUAL_ROWS.contains(&rows) {
        notes.push(format!(
            "{columns} x {rows} is no usual size; the tile is taken as one degree wide"
        ));
    }
    let georeference = Georeference {
        coordinates: Coordinates::Degrees,
        epsg: Some(4326),
        citation: Some("WGS 84".to_owned()),
        // Without a name, the middle of the tile is put on the equator.
        origin: Some(origin.unwrap_or(DVec2::new(0.0, 0.5))),
        cell: Some(DVec2::new(1.0 / (columns as f64 - 1.0), 1.0 / (rows as f64 - 1.0))),
        height_unit_m: Some(1.0),
        pixel_is: Some(PixelIs::Point),
        ..Georeference::unknown()
    };
    let storage = Storage { byte_order: Some("big-endian"), ..Storage::of("SRTM HGT", "int16") };
    let nodata = Some(f64::from(VOID));
    let every = asked.every(name, columns as u64, rows as u64)?;
    let samples = thinned(samples, columns, every);
    Found {
        columns,
        rows,
        samples,
        storage,
        georeference,
        nodata,
        turned_over: false,
        conversion,
        notes,
    }
    .finish(name, every, asked)
}

/// The byte order in which the samples make sense as 32-bit floats and not as 16-bit integers.
///
/// Radar programs call such rasters `.hgt` too. Heights change little from sample to sample; the
/// halves of floats taken for heights jump about.
fn looks_like_floats(bytes: &[u8]) -> Option<&'static str> {
    let (words, rest) = bytes.as_chunks::<4>();
    let (pairs, _) = bytes.as_chunks::<2>();
    if !rest.is_empty() || words.len() < 16 {
        return None;
    }
    /// Larger heights or phases are none.
    const LARGEST: f32 = 1e5;
    const SMALLEST: f32 = 1e-6;
    let share = |is: fn([u8; 4]) -> f32| {
        let sound = |&&word: &&[u8; 4]| {
            let value = is(word);
            value == 0.0 || value.is_nan() || (SMALLEST..LARGEST).contains(&value.abs())
        };
        words.iter().filter(sound).count() as f64 / words.len() as f64
    };
    // Between neighbouring samples of one kind.
    let jumps = pairs.windows(2).filter(|pair| {
        let [a, b] = [pair[0], pair[1]].map(|pair| i32::from(i16::from_be_bytes(pair)));
        (a - b).abs() > 2000 && a != i32::from(VOID) && b != i32::from(VOID)
    });
    if jumps.count() < pairs.len() / 4 {
        return None;
    }
    let sound = |read| share(read) > 0.95;
    match (sound(f32::from_le_bytes), sound(f32::from_be_bytes)) {
        (true, _) => Some("little-endian"),
        (_, true) => Some("big-endian"),
        _ => None,
    }
}

/// The south-west corner (east, north) in degrees that a tile is named after.
fn corner(name: &str) -> Option<DVec2> {
    let file = name.rsplit(['/', '\\', ':']).next()?;
    let tile = file.as_bytes().get(..7)?.to_ascii_uppercase();
    let degrees = |digits: &[u8]| -> Option<f64> {
        digits.iter().try_fold(0.0, |sum, digit| {
            digit.is_ascii_digit().then(|| sum * 10.0 + f64::from(digit - b'0'))
        })
    };
    // What follows the name is an ending or another name, never more digits.
    if file.as_bytes().get(7).is_some_and(u8::is_ascii_alphanumeric) {
        return None;
    }
    let (north, east) = (degrees(&tile[1..3])?, degrees(&tile[4..7])?);
    let north = match tile[0] {
        b'N' => north,
        b'S' => -north,
        _ => return None,
    };
    let east = match tile[3] {
        b'E' => east,
        b'W' => -east,
        _ => return None,
    };
    ((-90.0..90.0).contains(&north) && east.abs() <= 180.0).then_some(DVec2::new(east, north))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_are_named_after_their_corners() {
        assert_eq!(corner("N36W085.hgt"), Some(DVec2::new(-85.0, 36.0)));
        assert_eq!(corner("some/s01e010.HGT"), Some(DVec2::new(10.0, -1.0)));
        assert_eq!(corner("x.zip:d/N53E028.SRTMGL1.hgt"), Some(DVec2::new(28.0, 53.0)));
        for name in ["", "N36", "tile.hgt", "N3AW085.hgt", "N36X085.hgt", "N36W0851.hgt"] {
            assert_eq!(corner(name), None, "{name}");
        }
        assert_eq!(corner("N91E000.hgt"), None);
        assert_eq!(corner("N36W085ä.hgt"), Some(DVec2::new(-85.0, 36.0)));
    }

    #[test]
    fn sizes_of_tiles() {
        for (columns, rows) in [(1201, 1201), (3601, 3601), (1801, 3601), (601, 1201), (50, 50)] {
            assert_eq!(sides(2 * columns * rows), Some((columns, rows)));
        }
        for bytes in [0, 1, 2, 2 * 1201 * 1202, 2 * 1201 * 1201 + 1] {
            assert_eq!(sides(bytes), None, "{bytes}");
        }
    }
}
