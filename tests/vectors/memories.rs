//! The memories of the files against those that are loaded, addressed as the page says.

use std::collections::BTreeMap;

use terraline::setup::TerrainUnits;
use terraline::word::{Complete, Readout};

use super::reader::File;

/// Memories, addressed as the page says.
pub fn check<W: Complete>(
    files: &BTreeMap<String, File>,
    units: &TerrainUnits<W>,
) -> Result<(), String> {
    let heights = &units.interpolator.heights;
    let (columns, rows) = (heights.columns(), heights.rows());
    let word = |file: &str, at: i64, column: usize| -> Result<i64, String> {
        let row = files[file].rows.get(at as usize).ok_or(format!("{file}: no row {at}"))?;
        row[column].ok_or(format!("{file} row {at}: x"))
    };
    let same = |file: &str, at: i64, column: usize, expected: Option<i64>| {
        let found = word(file, at, column)?;
        if Some(found) == expected {
            return Ok(());
        }
        Err(format!("{file} row {at}: {found:x}, not {expected:x?}"))
    };
    for j in 0..rows {
        for i in 0..columns {
            let at = i64::from(j) * i64::from(columns) + i64::from(i);
            same("height_memory", at, 0, heights.at(i as usize, j as usize).raw())?;
            if heights.has_voids() {
                same("void_bits", at, 0, Some(heights.any_void(i, j, 1).into()))?;
            }
        }
    }
    if let Some(pyramid) = &units.stepper.pyramid {
        let file = &files["pyramid"];
        let address = file.lines("address").next().ok_or("no address")?;
        let first: i64 = if address.ends_with("first -1") { -1 } else { 0 };
        let mut bounds = 0;
        for line in file.lines("level") {
            let words: Vec<&str> = line.split(' ').collect();
            let [level, "offset", offset, "columns", columns, "rows", rows] = words[..] else {
                return Err(format!("level {line}"));
            };
            let number = |text: &str| text.parse::<i64>().map_err(|error| error.to_string());
            let (level, offset) = (number(level)?, number(offset)?);
            let (columns, rows) = (number(columns)?, number(rows)?);
            for (b, c) in (0..rows).flat_map(|c| (0..columns).map(move |b| (b, c))) {
                // The first cell of the block.
                let cell = |block: i64| ((block + first) << level) as i32;
                let bound = pyramid.bound(level as u32, cell(b), cell(c));
                same("pyramid", offset + c * columns + b, 0, bound.and_then(Readout::raw))?;
                bounds += 1;
            }
        }
        if bounds != file.rows.len() {
            return Err(format!("{bounds} bounds in levels, {} rows", file.rows.len()));
        }
    }
    if let Some(rom) = &units.interpolator.rom {
        let entries = rom.weights().entries().iter().zip(rom.slopes().entries());
        for (entry, (weight, slope)) in (0..).zip(entries) {
            same("kernel_weight", entry, 0, weight.raw())?;
            same("kernel_slope", entry, 0, slope.raw())?;
        }
    }
    if let Some(light) = &units.shader.light {
        for (entry, root) in light.rsqrt.entries().iter().enumerate() {
            same("rsqrt", entry as i64, 0, root.raw())?;
        }
    }
    for (at, segment) in units.shader.ramp.segments.iter().enumerate() {
        for (channel, (start, rise)) in segment.iter().enumerate() {
            same("ramp_segments", at as i64, 2 * channel, start.raw())?;
            same("ramp_segments", at as i64, 2 * channel + 1, rise.raw())?;
        }
    }
    Ok(())
}
