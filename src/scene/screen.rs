//! `[[screen]]`: one table per channel.

use std::collections::HashSet;

use glam::DVec2;

use super::error::SceneError;
use super::field::{FARTHEST, Field, Fields, SMALLEST, is_length};
use super::file::{Form, one_form};
use super::{Angles, Extent, Screen, camera, keys};

/// Pixels in one direction.
pub const MAX_SIDE: u32 = 16384;

/// Pixels of one screen.
pub const MAX_PIXELS: u64 = 1 << 26;

pub(super) fn read(scene: &Fields<'_>) -> Result<Vec<Screen>, SceneError> {
    let Some(field) = scene.get("screen") else {
        return Ok(vec![screen(&scene.empty("screen"))?]);
    };
    let mut names = HashSet::new();
    let mut screens = Vec::new();
    for field in field.tables()? {
        let table = field.table(&keys::SCREEN)?;
        let screen = screen(&table)?;
        if !names.insert(screen.name.clone()) {
            let reason = format!("an earlier screen is named \"{}\" as well", screen.name);
            let remedy = "give every [[screen]] a name of its own";
            return Err(match table.get("name") {
                Some(name) => name.error(reason, remedy),
                None => table.error("name", reason, remedy),
            });
        }
        screens.push(screen);
    }
    Ok(screens)
}

fn screen(table: &Fields<'_>) -> Result<Screen, SceneError> {
    let [columns, lines] = table.read("size", [1024, 1024], size)?;
    let mount = table.table("mount", &keys::MOUNT)?;
    Ok(Screen {
        name: table.read("name", "front".to_owned(), name)?,
        columns,
        lines,
        extent: extent(table)?,
        center: table.read("center", DVec2::ZERO, |center| {
            center.pair("two numbers [up, right] up to 1e9", |length| length.abs() <= FARTHEST)
        })?,
        mount: camera::angles(&mount, Angles::default())?,
    })
}

fn name(field: &Field<'_>) -> Result<String, SceneError> {
    const EXPECTED: &str = "a name of 1 to 64 characters without slashes, as in \"front\"";
    let name = field.text(EXPECTED)?;
    // Names end up in the names of files.
    let unfit = |c: char| c.is_control() || c == '/' || c == '\\';
    if name.trim().is_empty() || name.chars().count() > 64 || name.contains(unfit) {
        return Err(field.error("this cannot name a screen", format!("give {EXPECTED}")));
    }
    Ok(name.to_owned())
}

fn size(field: &Field<'_>) -> Result<[u32; 2], SceneError> {
    let expected = format!("[columns, lines], two whole numbers from 1 to {MAX_SIDE}");
    let [columns, lines] = field.counts(&expected, 1..=MAX_SIDE)?;
    let pixels = u64::from(columns) * u64::from(lines);
    if pixels > MAX_PIXELS {
        return Err(field.error(
            format!("{columns} x {lines} is {pixels} pixels"),
            format!("give a size of at most {MAX_PIXELS} pixels, such as [8192, 8192]"),
        ));
    }
    Ok([columns, lines])
}

fn extent(table: &Fields<'_>) -> Result<Extent, SceneError> {
    let remedy = "keep either fov, or distance and pixel";
    if one_form(table, &["fov"], &["distance", "pixel"], remedy)? != Form::Second {
        let degrees = table.read("fov", 60.0, |fov| {
            fov.number("an angle above 0 (from 1e-9) and at most 175 degrees", |fov| {
                (SMALLEST..=175.0).contains(&fov)
            })
        })?;
        return Ok(Extent::FieldOfView(degrees.to_radians()));
    }
    match (table.get("distance"), table.get("pixel")) {
        (Some(distance), Some(pixel)) => Ok(Extent::Pitch {
            distance: distance.length()?,
            pixel: pixel.pair(
                "[dz, dy], the width and height of a pixel, both above 0 (from 1e-9 to 1e9)",
                is_length,
            )?,
        }),
        (Some(alone), None) => Err(alone.error(
            "`distance` needs `pixel` beside it",
            "give pixel = [dz, dy] in the same unit, or use fov instead",
        )),
        (None, Some(alone)) => Err(alone.error(
            "`pixel` needs `distance` beside it",
            "give the distance of the screen in the same unit, or use fov instead",
        )),
        (None, None) => Err(table.error("fov", "the screen has no extent", "give fov")),
    }
}
