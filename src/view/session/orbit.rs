//! Flight around a point of the ground, which stays where it is on the screen.

use glam::DVec3;

use super::Session;
use crate::frame::Hit;
use crate::oracle::Oracle;
use crate::plan::geometry::Geometry;
use crate::view::camera;

/// Degrees per window pixel of a drag.
const TURN: f64 = 0.3;

/// Factor of a notch of the wheel on the distance.
const NOTCH: f64 = 0.88;

impl Session {
    /// Takes hold of the ground in the middle of the screen; beside a map, of the level of its base.
    pub(super) fn hold_ground(&mut self) {
        let screen = &self.scene.screens[0];
        let middle = |count: u32| f64::from(count - 1) / 2.0;
        let oracle = Oracle::new(&self.scene, screen);
        let (line, column) = (middle(screen.lines), middle(screen.columns));
        let seen = oracle.pixel(line, column);
        self.pivot = if matches!(seen.hit, Hit::Surface | Hit::Side) {
            Some(seen.point)
        } else {
            let direction = oracle.direction(line, column);
            let base = self.scene.terrain().map(|terrain| terrain.range().0 - terrain.base_depth());
            let steps = base.map(|base| (base - oracle.eye().y) / direction.y);
            steps.filter(|steps| *steps > 0.0).map(|steps| oracle.eye() + direction * steps)
        };
        if self.pivot.is_none() {
            self.notice =
                Some("no ground in the middle of the screen to orbit around: turn to it".into());
        }
    }

    /// Orbits as if the scene were dragged by window pixels around the point that is held.
    pub(super) fn orbit(&mut self, right: f64, down: f64) {
        let Some(pivot) = self.pivot else { return };
        let from = Geometry::new(&self.scene.camera, &self.scene.screens[0]).eye - pivot;
        let [heading, pitch, _] = camera::degrees(&self.scene.camera);
        let mut turned = self.scene.camera.clone();
        camera::turn(&mut turned, -right * TURN, -down * TURN, 0.0);
        let [to_heading, to_pitch, _] = camera::degrees(&turned);
        // The rigid turn that the attitude has made: pitch about the level axis across the old
        // heading, then heading about the vertical.
        let level = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            (DVec3::new(cos, 0.0, -sin), DVec3::new(sin, 0.0, cos))
        };
        let (ahead, across) = level(heading);
        let (sin, cos) = (to_pitch - pitch).to_radians().sin_cos();
        let (a, b) = (from.dot(ahead), from.y);
        let (to_ahead, to_across) = level(to_heading);
        let to = to_ahead * (a * cos - b * sin)
            + DVec3::Y * (a * sin + b * cos)
            + to_across * from.dot(across);
        self.stand(turned, pivot + to);
    }

    /// Comes nearer to the point that is held.
    pub(super) fn approach(&mut self, notches: f64) {
        let Some(pivot) = self.pivot else { return };
        let eye = self.eye();
        let craft = self.scene.camera.clone();
        self.stand(craft, pivot + (eye - pivot) * NOTCH.powf(notches));
    }
}
