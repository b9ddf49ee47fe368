//! Where the craft of a session is, and how it gets elsewhere.

use glam::DVec3;

use super::Session;
use crate::plan::geometry::Geometry;
use crate::scene::framing::PITCH;
use crate::scene::framing::overlook::{Sight, outline};
use crate::scene::{Angles, Attitude, Camera, Screen, Surface, Terrain};
use crate::view::layout::Layout;
use crate::oracle::ground;
use crate::view::camera;

/// Notch of the wheel along the line of sight, seconds of flight.
const DOLLY_SECONDS: f64 = 0.25;

/// Speed: this share of the height above ground a second, and that of the map's width.
const SPEED: (f64, f64) = (0.5, 1.0 / 300.0);

/// Eyes are kept above the ground by this share of a cell.
const CLEARANCE: f64 = 0.01;

/// Pitches in degrees that are kept when the map is framed: from higher up it would be a plan, from
/// lower down its far side would be a line.
const KEPT_PITCHES: std::ops::RangeInclusive<f64> = -89.0..=-15.0;

impl Session {
    /// Changes the camera; the function is given the grain of positions.
    pub(super) fn fly(&mut self, change: impl FnOnce(&mut Camera, f64)) {
        let grain = self.scene.surfaces.iter().map(Surface::grain).fold(f64::INFINITY, f64::min);
        change(&mut self.change_scene().camera, grain);
        self.keep_above_ground();
    }

    /// Scene units per second.
    pub(super) fn speed(&self) -> f64 {
        let height = self.eye_above_ground().unwrap_or_else(|| self.eye_above_base()).abs();
        let width = self.scene.surfaces.iter().map(Surface::width).fold(0.0, f64::max);
        SPEED.0 * height + SPEED.1 * width
    }

    /// Height of the eye above the surface, scene units; `None` beside the map.
    #[must_use]
    pub fn eye_above_ground(&self) -> Option<f64> {
        let eye = self.eye();
        ground::height(&self.scene, eye).map(|height| eye.y - height)
    }

    /// Height of the eye above the base of the map, scene units; 0 without a map.
    fn eye_above_base(&self) -> f64 {
        let base = |terrain: &Terrain| terrain.range().0 - terrain.base_depth();
        self.scene.terrain().map_or(0.0, |terrain| self.eye().y - base(terrain))
    }

    /// Centre of projection, scene units.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        Geometry::new(&self.scene.camera, &self.scene.screens[0]).eye
    }

    /// No engine draws from under the ground of a height map: the craft is lifted above it.
    pub(super) fn keep_above_ground(&mut self) {
        let Some(terrain) = self.scene.terrain() else { return };
        let clearance = CLEARANCE * terrain.cell.max_element();
        if let Some(above) = self.eye_above_ground()
            && above < clearance
        {
            self.change_scene().camera.position.y += clearance - above;
            self.notice = Some("kept above the ground: E climbs".into());
        }
    }

    /// Puts a craft where its eye is at a place.
    pub(super) fn stand(&mut self, craft: Camera, eye: DVec3) {
        let now = Geometry::new(&craft, &self.scene.screens[0]).eye;
        self.fly(|camera, grain| {
            let position = camera::rounded(craft.position + eye - now, grain);
            *camera = Camera { position, ..craft };
        });
    }

    /// Back to the scene's camera and field of view; what else keys have changed stays.
    pub(super) fn reset(&mut self) {
        let Layout { columns, lines, .. } = self.layout;
        let (camera, screen) = self.first.clone();
        let scene = self.change_scene();
        scene.camera = camera;
        scene.screens[0] = screen.resized(columns as u32, lines as u32);
        // What was ground before may have risen since.
        self.keep_above_ground();
    }

    /// Moves along the line of sight by notches of the wheel.
    pub(super) fn dolly(&mut self, notches: f64) {
        let distance = self.speed() * DOLLY_SECONDS * notches;
        self.fly(|craft, grain| camera::dolly(craft, distance, grain));
    }

    /// Moves to where the whole map is on the screen, with the heading and, where the ground can be
    /// seen so, the pitch of now.
    pub(super) fn frame_map(&mut self) {
        let Some(terrain) = self.scene.terrain() else {
            self.notice = Some("a plane has no end to frame: Home goes back".into());
            return;
        };
        let (low, top) = terrain.range();
        let bottom = low - terrain.base_depth();
        let points = outline(&terrain.map, terrain.cell, bottom, |sample| terrain.height(sample));
        let screen = &self.scene.screens[0];
        let [heading, pitch, _] = camera::degrees(&self.scene.camera);
        let pitch = if KEPT_PITCHES.contains(&pitch) { pitch } else { PITCH };
        let attitude = Attitude::Angles(Angles {
            heading: heading.to_radians(),
            pitch: pitch.to_radians(),
            roll: 0.0,
        });
        let level = Camera { attitude, ..self.scene.camera.clone() };
        let geometry = Geometry::new(&level, screen);
        let Some(eye) = sight(&geometry, screen).overlooking(&points, top) else {
            self.notice =
                Some("this screen does not look down at the map: turn, or press Home".into());
            return;
        };
        self.stand(level, eye);
    }
}

/// What a screen sees in the direction of its camera.
fn sight(geometry: &Geometry, screen: &Screen) -> Sight {
    let half = screen.pitch() * glam::DVec2::new(screen.columns.into(), screen.lines.into()) / 2.0;
    let share = |length: f64| length / screen.distance();
    Sight {
        axes: geometry.axes,
        left: share(half.x - screen.center.y),
        right: share(half.x + screen.center.y),
        up: share(half.y + screen.center.x),
        down: share(half.y - screen.center.x),
    }
}
