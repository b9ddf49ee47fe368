//! `[[screen]]`: one table per channel.

use std::collections::HashSet;

use glam::DVec2;

use super::camera::Angles;
use super::error::SceneError;
use super::field::Fields;
use super::form::{Form, one_form};
use super::kind::{FARTHEST, Key, Kind, LENGTH, SMALLEST};
use super::table::{Declared, Table, keys, keys_of_other_form, names, open, table};
use super::writer::Writer;

/// Pixels in one direction.
pub const MAX_SIDE: u32 = 16384;

/// Pixels of one screen.
pub const MAX_PIXELS: u64 = 1 << 26;

/// One channel: a flat raster screen perpendicular to u.
#[derive(Clone, Debug, PartialEq)]
pub struct Screen {
    /// Name by which `--screen` asks for it.
    pub name: String,
    /// Pixels across.
    pub columns: u32,
    /// Scan lines.
    pub lines: u32,
    /// Distance and pixel pitch.
    pub extent: Extent,
    /// `(Ve, We)`: centre of the screen off the axis, up and to the right, in the unit of
    /// `distance` (with `fov`, the screen stands at distance 1).
    pub center: DVec2,
    /// Mounting angles of the screen in the cabin: `A A_mount` in place of `A`.
    pub mount: Angles,
}

table! {
    pub(super) struct ScreenKeys {
        /// Name of the channel, which files are named after.
        name: String = "front".to_owned(), Kind::Text {
            expected: "a name of 1 to 64 characters without slashes, as in \"front\"",
            refusal: "this cannot name a screen",
            fits: is_name,
        };
        /// Columns and lines.
        size: [u32; 2] = [1024, 1024],
            Kind::Array("[columns, lines]", Box::new(Kind::Whole(1..=MAX_SIDE.into())), 2..=2);
        /// How large the screen is.
        extent: Extent = Extent::default();
        /// Centre of the screen off the axis, in the unit of distance; with fov, at distance 1.
        center: DVec2 = DVec2::ZERO, Kind::pair("[up, right]", -FARTHEST..=FARTHEST);
        /// How the screen is turned in the cabin.
        mount: Angles = Angles::default(), Kind::Table(keys::<Angles>());
    }
}

impl From<ScreenKeys> for Screen {
    fn from(keys: ScreenKeys) -> Self {
        let ScreenKeys { name, size: [columns, lines], extent, center, mount } = keys;
        Self { name, columns, lines, extent, center, mount }
    }
}

impl From<Screen> for ScreenKeys {
    fn from(screen: Screen) -> Self {
        let Screen { name, columns, lines, extent, center, mount } = screen;
        Self { name, size: [columns, lines], extent, center, mount }
    }
}

impl Default for Screen {
    fn default() -> Self {
        ScreenKeys::default().into()
    }
}

impl Declared for Screen {
    type By = ScreenKeys;
}

impl Screen {
    /// `U1` in the unit of [`Screen::pitch`].
    pub fn distance(&self) -> f64 {
        match self.extent {
            Extent::FieldOfView(_) => 1.0,
            Extent::Pitch { distance, .. } => distance,
        }
    }

    /// Pixel pitch `(dz across, dy down)`.
    pub fn pitch(&self) -> DVec2 {
        match self.extent {
            Extent::FieldOfView(fov) => {
                DVec2::splat(2.0 * libm::tan(fov / 2.0) / f64::from(self.columns))
            }
            Extent::Pitch { pixel, .. } => pixel,
        }
    }

    /// The same screen with another raster: the field across the width stays.
    #[must_use]
    pub fn resized(&self, columns: u32, lines: u32) -> Self {
        let extent = match self.extent {
            Extent::Pitch { distance, pixel } => Extent::Pitch {
                distance,
                pixel: pixel * (f64::from(self.columns) / f64::from(columns)),
            },
            fov @ Extent::FieldOfView(_) => fov,
        };
        Self { columns, lines, extent, ..self.clone() }
    }
}

/// Reads all `[[screen]]` tables; without any there is one of defaults.
pub(super) fn read(scene: &Fields<'_>) -> Result<Vec<Screen>, SceneError> {
    let Some(field) = scene.get("screen") else { return Ok(vec![Screen::default()]) };
    let mut names = HashSet::new();
    let mut screens = Vec::new();
    for field in field.tables()? {
        let table = open::<Screen>(&field)?;
        let screen = Screen::read(&table, Screen::default())?;
        let (columns, lines) = (screen.columns, screen.lines);
        let pixels = u64::from(columns) * u64::from(lines);
        if let (Some(size), true) = (table.get("size"), pixels > MAX_PIXELS) {
            return Err(size.error(
                format!("{columns} x {lines} is {pixels} pixels"),
                format!("give a size of at most {MAX_PIXELS} pixels, such as [8192, 8192]"),
            ));
        }
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

/// Names end up in the names of files.
fn is_name(name: &str) -> bool {
    let unfit = |c: char| c.is_control() || c == '/' || c == '\\';
    !name.trim().is_empty() && name.chars().count() <= 64 && !name.contains(unfit)
}

/// How large the screen is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// Field of view in radians across the width; square pixels, distance 1.
    FieldOfView(f64),
    /// Distance `U1` and pitch `(dz across, dy down)` of one pixel, in one unit.
    Pitch {
        /// `U1`.
        distance: f64,
        /// `(dz, dy)`.
        pixel: DVec2,
    },
}

table! {
    struct FieldOfView {
        /// Field of view across the width; pixels are square.
        fov: f64 = 60_f64.to_radians(), Kind::Degrees(SMALLEST..=175.0);
    }
}

table! {
    struct Pitch {
        /// Distance of the screen from the eye, in any unit, in place of fov.
        distance: f64 = 1.0, LENGTH;
        /// Width and height of a pixel, in the unit of distance.
        pixel: DVec2 = DVec2::splat(0.001), Kind::pair("[dz, dy]", SMALLEST..=FARTHEST);
    }
}

impl Default for Extent {
    fn default() -> Self {
        Self::FieldOfView(FieldOfView::default().fov)
    }
}

impl Table for Extent {
    fn keys(_: &Self) -> Vec<Key> {
        [keys::<FieldOfView>(), keys_of_other_form::<Pitch>()].concat()
    }

    fn read(fields: &Fields<'_>, _: Self) -> Result<Self, SceneError> {
        if one_form::<FieldOfView, Pitch>(fields)? != Form::Second {
            let FieldOfView { fov } = Table::read(fields, FieldOfView::default())?;
            return Ok(Self::FieldOfView(fov));
        }
        let pitch = names::<Pitch>();
        let given = pitch.iter().find_map(|key| fields.get(key));
        let missing = pitch.iter().find(|key| fields.get(key).is_none());
        if let (Some(given), Some(missing)) = (given, missing) {
            let remedy = "give both in one unit, or use fov instead";
            return Err(given.error(format!("it needs `{missing}` beside it"), remedy));
        }
        let Pitch { distance, pixel } = Table::read(fields, Pitch::default())?;
        Ok(Self::Pitch { distance, pixel })
    }

    fn write(&self, out: &mut Writer) {
        match *self {
            Self::FieldOfView(fov) => {
                Table::write(&FieldOfView { fov }, out);
                out.aside(|out| Table::write(&Pitch::default(), out));
            }
            Self::Pitch { distance, pixel } => Table::write(&Pitch { distance, pixel }, out),
        }
    }
}
