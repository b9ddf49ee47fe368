//! Tie points, scales and transformations: where the nodes of a GeoTIFF lie.

use glam::DVec2;

use super::super::error::{MapError, gdal};
use super::super::georeference::{Georeference, PixelIs};
use super::directory::{Directory, Tiff, tag};
use super::image::{Image, unusable};

/// The raster's grid in its coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    /// Coordinates of the corner (area) or the node (point) at raster (0, 0).
    tie: DVec2,
    /// Eastward and northward step of a column and a row; the second is negative in most files.
    pub(super) step: DVec2,
}

/// A turn that moves no node by more than this share of a cell is a rounding.
const STRAIGHT: f64 = 1e-6;

impl Grid {
    /// Writes down where the nodes of so many rows lie, in coordinates of which one of the file is
    /// `factor`.
    pub(super) fn place(self, factor: f64, rows: usize, georeference: &mut Georeference) {
        let (mut tie, step) = (self.tie * factor, self.step * factor);
        // Nodes are the centres of samples.
        if georeference.pixel_is == Some(PixelIs::Area) {
            tie += step / 2.0;
        }
        if step.y > 0.0 {
            tie.y += step.y * (rows as f64 - 1.0);
        }
        georeference.origin = Some(tie);
        georeference.cell = Some(step.abs());
    }
}

/// Tie point and scale, or the transformation that stands for both.
pub(super) fn read(
    tiff: &Tiff<'_>,
    directory: &Directory,
    name: &str,
    image: &Image,
    notes: &mut Vec<String>,
) -> Result<Option<Grid>, MapError> {
    let damaged = |reason: String| unusable(name, &reason);
    let list = |tag| tiff.doubles(directory, tag).map_err(damaged);
    let (scale, ties) = (list(tag::PIXEL_SCALE)?, list(tag::TIE_POINTS)?);
    // A scale with its tie point counts more than a matrix beside them, as other readers have it.
    if (scale.is_none() || ties.is_none())
        && let Some(matrix) = list(tag::TRANSFORMATION)?
    {
        let [a, b, _, d, e, f, _, h, ..] = matrix.as_slice() else {
            return Err(damaged("its transformation has fewer than 8 numbers".to_owned()));
        };
        let moved = DVec2::new(b * image.rows as f64 / a, e * image.columns as f64 / f).abs();
        if *a <= 0.0 || *f == 0.0 || (moved.max_element() > STRAIGHT) {
            return Err(MapError::new(
                name,
                "its raster is rotated, sheared or mirrored against its coordinates",
                format!("resample it to rows that run east: {}", gdal("gdalwarp", name)),
            ));
        }
        return Ok(Some(Grid { tie: DVec2::new(*d, *h), step: DVec2::new(*a, *f) }));
    }
    let (Some(scale), Some(ties)) = (&scale, &ties) else {
        if ties.as_ref().is_some_and(|ties| ties.len() > 6) {
            notes.push(format!(
                "left out: ground control points, so the place is not known: {}",
                gdal("gdalwarp", name)
            ));
        } else if scale.is_some() || ties.is_some() {
            notes.push(
                "left out: tie points without a scale, or a scale without a tie point".to_owned(),
            );
        }
        return Ok(None);
    };
    let ([x_scale, y_scale, ..], [column, row, _, x, y, ..]) = (scale.as_slice(), ties.as_slice())
    else {
        return Err(damaged("its tie point or scale has too few numbers".to_owned()));
    };
    if *y_scale < 0.0 || *x_scale < 0.0 {
        return Err(MapError::new(
            name,
            "its scale is negative, which some programs read as south-up or mirrored, and others \
             as a slip",
            format!("write it with rows from north to south: {}", gdal("gdalwarp", name)),
        ));
    }
    if ties.len() > 6 {
        notes.push("left out: all tie points but the first".to_owned());
    }
    // Row 0 lies `row` rows north of the tie point's row.
    let step = DVec2::new(*x_scale, -*y_scale);
    Ok(Some(Grid { tie: DVec2::new(*x, *y) - DVec2::new(*column, *row) * step, step }))
}
