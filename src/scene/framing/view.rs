//! What the scene shows and from where: scale, exaggeration, camera.

use glam::{DMat3, DVec2, DVec3};

use super::overlook::{Sight, outline};
use super::ramp;
use super::reason::Reason;
use crate::scene::camera::{Angles, Attitude, Camera};
use crate::scene::height_map::{Georeference, HeightMap};
use crate::scene::light::{Colors, Light};
use crate::scene::maps::ReadMap;
use crate::scene::nodata::NoData;
use crate::scene::screen::{Extent, Screen};
use crate::scene::surface::Surface;
use crate::scene::tables::Scene;
use crate::scene::terrain::{Outside, Terrain};

/// Metres of a cell where nothing is known.
const ASSUMED_CELL_M: f64 = 30.0;

/// A height range below this share of the map's longer side looks flat.
const FLAT: f64 = 0.08;

/// What the height range is raised to, as a share of the longer side.
const RAISED: f64 = 0.1;

/// A height range above this share of the longer side is lowered: no ground is so steep over a whole map.
const NEEDLES: f64 = 2.0;

/// The same where the size of a cell is a guess.
const GUESSED_NEEDLES: f64 = 0.5;

/// What it is lowered to.
const LOWERED: f64 = 0.2;

/// Exaggerations to choose from: more would show trees and noise as needles.
const STEPS: [f64; 7] = [1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0];

/// Field of view across the width, in degrees.
const FIELD: f64 = 45.0;

/// Degrees down. With the field of view, no ray of a screen that is wider than high looks up.
pub const PITCH: f64 = -35.0;

/// A sample beyond this is no height.
const LARGEST: f64 = 1e9;

/// The choices for one map; lengths in scene units.
#[derive(Clone, Debug)]
pub(super) struct View {
    unit_m: f64,
    cell: DVec2,
    /// The lowest sample, in its own decimals.
    offset: f64,
    /// Scene units per unit of sample.
    scale: f64,
    base_depth: f64,
    position: DVec3,
    /// In degrees.
    heading: f64,
    size: (u32, u32),
    ramp: Vec<[u8; 3]>,
    /// What was chosen, a sentence each.
    pub(super) reasons: Vec<Reason>,
}

/// A number of few digits, so that the scene file reads well.
fn neat(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

impl View {
    /// Chooses; an error is a reason and a remedy.
    pub(super) fn new(
        map: &HeightMap,
        georeference: &Georeference,
        size: (u32, u32),
        asked: Option<f64>,
    ) -> Result<Self, (String, String)> {
        let (columns, rows) = (map.columns(), map.rows());
        let (low, high) = map.range();
        if columns < 2 || rows < 2 {
            return Err((
                format!("a map of {columns} x {rows} nodes encloses no ground"),
                "give a map of at least 2 x 2 nodes".to_owned(),
            ));
        }
        if f64::from(low).abs().max(f64::from(high).abs()) > LARGEST {
            return Err((
                format!("its samples go from {low:?} to {high:?}, which are no heights"),
                format!(
                    "where one of them marks nodes without data, add --nodata {}",
                    if -low > high { low } else { high }
                ),
            ));
        }
        let mut reasons = Vec::new();
        let known = georeference.cell_m(columns, rows);
        let cell_m = known.unwrap_or(DVec2::splat(ASSUMED_CELL_M));
        if known.is_none() {
            let text = format!(
                "the size of a cell is not known: {ASSUMED_CELL_M} m x {ASSUMED_CELL_M} m are \
                 assumed (surface.cell, unit_m)"
            );
            reasons.push(Reason::new(&["surface.cell", "unit_m"], text));
        }
        let height_unit_m = georeference.height_unit_m.unwrap_or(1.0);
        if let Some(text) = georeference.height_unit_remark() {
            reasons.push(Reason::new(&["surface.height.scale"], text));
        }

        let unit_m = neat((cell_m.x * cell_m.y).sqrt());
        let cell = DVec2::new(neat(cell_m.x / unit_m), neat(cell_m.y / unit_m));
        let (across, down) = cells(map);
        let extent = DVec2::new(across * cell.x, down * cell.y);
        let longer = extent.max_element();
        let range = (f64::from(high) - f64::from(low)) * height_unit_m / unit_m;
        let exaggeration = match asked {
            Some(asked) => asked,
            None => exaggeration(range / longer, known.is_some(), &mut reasons),
        };
        let scale = neat(height_unit_m * exaggeration / unit_m).max(1e-9);
        let top = (f64::from(high) - f64::from(low)) * scale;
        let base_depth = neat((top / 4.0).max(longer / 64.0));

        // From the south-south-west; over a long map from north to south, rather from its side.
        let heading = if extent.y > 2.0 * extent.x { 25.0 } else { 70.0 };
        let height = |sample: f32| (f64::from(sample) - f64::from(low)) * scale;
        let outline = outline(map, cell, -base_depth, height);
        let sight = sight(heading, size);
        let position = sight
            .overlooking(&outline, top)
            .unwrap_or_else(|| unreachable!("this camera looks down"));
        let position = DVec3::from_array(position.to_array().map(neat));
        let (ramp, sea) = ramp::choose(map, height_unit_m);
        reasons.extend(sea.map(|text| Reason::new(&["color.ramp"], text)));
        reasons.extend(holes(map).map(|text| Reason::new(&["surface.nodata"], text)));
        Ok(Self {
            unit_m,
            cell,
            offset: low.to_string().parse().unwrap_or(f64::from(low)),
            scale,
            base_depth,
            position,
            heading,
            size,
            ramp,
            reasons,
        })
    }

    /// The scene that shows a map so.
    pub(super) fn scene(&self, map: &ReadMap) -> Scene {
        let terrain = Terrain {
            source: map.source.clone(),
            map: map.map.clone(),
            cell: self.cell,
            offset: self.offset,
            scale: self.scale,
            outside: Outside::Sky,
            nodata: NoData::Hole,
            base_depth: Some(self.base_depth),
        };
        let angles = Angles {
            heading: self.heading.to_radians(),
            pitch: PITCH.to_radians(),
            ..Angles::default()
        };
        Scene {
            unit_m: self.unit_m,
            camera: Camera {
                position: self.position,
                attitude: Attitude::Angles(angles),
                ..Camera::default()
            },
            screens: vec![Screen {
                columns: self.size.0,
                lines: self.size.1,
                extent: Extent::FieldOfView(FIELD.to_radians()),
                ..Screen::default()
            }],
            light: Light { direction: DVec3::new(-1.0, 1.6, -0.3).normalize(), ambient: 0.35 },
            color: Colors {
                ramp: self.ramp.clone(),
                sky: [186, 208, 230],
                far: [186, 208, 230],
                side: [104, 92, 78],
                ..Colors::default()
            },
            ..Scene::of(Surface::Terrain(terrain))
        }
    }
}

/// Nodes of a map that make a scene's sides.
fn cells(map: &HeightMap) -> (f64, f64) {
    ((map.columns() - 1) as f64, (map.rows() - 1) as f64)
}

/// Keys that an exaggeration is made of.
const SCALES: [&str; 3] = ["surface.height.scale", "surface.cell", "unit_m"];

/// The vertical exaggeration for a height range given as a share of the map's longer side.
fn exaggeration(share: f64, known: bool, reasons: &mut Vec<Reason>) -> f64 {
    if share > if known { NEEDLES } else { GUESSED_NEEDLES } {
        let lowered = neat(LOWERED / share);
        let text = format!(
            "the height range is {share:.1} times the map's longer side, as if units were not what they \
             seem: heights are drawn {lowered} times as high (surface.height.scale)"
        );
        reasons.push(Reason::new(&SCALES, text));
        return lowered;
    }
    if share >= FLAT || share <= 0.0 {
        return 1.0;
    }
    let wanted = RAISED / share;
    let distance = |step: f64| (step / wanted).ln().abs();
    let chosen = STEPS.into_iter().min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
    let chosen = chosen.unwrap_or(1.0);
    if chosen != 1.0 {
        let text = format!(
            "the height range is {:.2} % of the map's longer side: heights are drawn {chosen} times life \
             size (surface.height.scale)",
            100.0 * share
        );
        reasons.push(Reason::new(&SCALES, text));
    }
    chosen
}

/// The camera of a heading in degrees, level across and [`PITCH`] down, with a screen of this size.
fn sight(heading: f64, size: (u32, u32)) -> Sight {
    let (sin, cos) = (libm::sin(heading.to_radians()), libm::cos(heading.to_radians()));
    let (dip, flat) = (libm::sin(PITCH.to_radians()), libm::cos(PITCH.to_radians()));
    let axes = DMat3::from_cols(
        DVec3::new(cos * flat, dip, -sin * flat),
        DVec3::new(-cos * dip, flat, sin * dip),
        DVec3::new(sin, 0.0, cos),
    );
    let across = libm::tan(FIELD.to_radians() / 2.0);
    let up = across * f64::from(size.1) / f64::from(size.0);
    Sight { axes, left: across, right: across, up, down: up }
}

/// What becomes of nodes without data.
fn holes(map: &HeightMap) -> Option<String> {
    let voids = map.voids();
    let share = 100.0 * voids as f64 / map.samples().len() as f64;
    (voids > 0).then(|| {
        let s = if voids == 1 { " has" } else { "s have" };
        format!(
            "{voids} node{s} no data ({share:.2} %) and become{} holes: surface.nodata=nearest \
             fills them",
            if voids == 1 { "s" } else { "" }
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view(columns: usize, rows: usize, range: f32, size: (u32, u32)) -> View {
        let samples = (0..columns * rows).map(|k| if k == 3 { range } else { 0.0 }).collect();
        let map = HeightMap::new(columns, rows, samples);
        View::new(&map, &Georeference::unknown(), size, None).unwrap()
    }

    #[test]
    fn all_ground_is_on_the_screen_and_the_eye_above() {
        for (columns, rows) in [(2, 2), (344, 344), (16384, 2), (2, 16384), (40, 1000)] {
            for range in [0.0, 1.0, 3000.0] {
                for size in [(1280, 800), (640, 640), (200, 900), (2000, 100)] {
                    let view = view(columns, rows, range, size);
                    let top = f64::from(range) * view.scale;
                    let high = view.position.y - top;
                    assert!(high > 0.999 * (top + view.base_depth) / 8.0, "{view:?}");
                    let cells = DVec2::new((columns - 1) as f64, (rows - 1) as f64);
                    let longer = (cells * view.cell).max_element();
                    assert!(view.base_depth > 0.999 * longer / 64.0, "{view:?}");
                    let psi = view.heading.to_radians();
                    let theta = PITCH.to_radians();
                    let (east, south) = (columns - 1, rows - 1);
                    let peak = (3 % columns, 3 / columns);
                    for (x, z) in [(0, 0), (east, 0), (0, south), (east, south), peak] {
                        for y in [-view.base_depth, if (x, z) == peak { top } else { 0.0 }] {
                            let corner =
                                DVec3::new(x as f64 * view.cell.x, y, z as f64 * view.cell.y);
                            let p = corner - view.position;
                            // Turned back: first about y, then about z.
                            let forward = p.x * psi.cos() - p.z * psi.sin();
                            let right = p.x * psi.sin() + p.z * psi.cos();
                            let depth = forward * theta.cos() + p.y * theta.sin();
                            let up = p.y * theta.cos() - forward * theta.sin();
                            let half = (FIELD / 2.0).to_radians().tan() * depth;
                            assert!(depth > 0.0 && right.abs() < half, "{view:?}");
                            let high = half * f64::from(size.1) / f64::from(size.0);
                            assert!(up.abs() < high, "{view:?}: {up} of {high}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn exaggeration_grows_with_flatness() {
        let of = |share| exaggeration(share, true, &mut Vec::new());
        assert_eq!(of(0.0), 1.0);
        assert_eq!(of(0.9), 1.0);
        assert_eq!(of(0.08), 1.0);
        assert_eq!(of(0.05), 2.0);
        assert_eq!(of(0.02), 5.0);
        assert_eq!(of(0.001), 20.0);
        assert_eq!(exaggeration(4.0, true, &mut Vec::new()), 0.05);
        assert_eq!(exaggeration(2.0, false, &mut Vec::new()), 0.1);
    }
}
