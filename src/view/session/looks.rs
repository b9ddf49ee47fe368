//! What keys change of a scene beside the camera: kernel, exaggeration, sun, colours.

use glam::DVec3;

use super::Session;
use crate::scene::framing::ramp::LAND;
use crate::scene::{Deformation, KernelShape};
use crate::sink::picture::Picture;
use crate::view::camera;

/// Largest d of a weight 2^-d that a key reaches; the words have no more bits.
const LARGEST_SHIFT: u32 = 24;

/// Exaggerations that keys choose from, times life size.
const EXAGGERATIONS: [f64; 16] =
    [0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0, 50.0];

/// Lowest and highest sun, degrees above the horizon.
const SUN: (f64, f64) = (5.0, 90.0);

impl Session {
    /// Whether the scene has a kernel; says so if it has none.
    fn has_kernel(&mut self) -> bool {
        let terrain = self.scene.terrain().is_some();
        if !terrain {
            self.notice = Some("a plane has no kernel".into());
        }
        terrain
    }

    pub(super) fn next_shape(&mut self) {
        if !self.has_kernel() {
            return;
        }
        let next = match self.scene.kernel.shape {
            KernelShape::Cosine => KernelShape::Parabola,
            KernelShape::Parabola => KernelShape::Exponential,
            KernelShape::Exponential => KernelShape::Hat,
            KernelShape::Hat => KernelShape::Cosine,
        };
        self.change_scene().kernel.shape = next;
        self.keep_above_ground();
    }

    pub(super) fn next_deformation(&mut self) {
        if !self.has_kernel() {
            return;
        }
        let weight_shift = self.weight_shift;
        let next = match self.scene.kernel.deformation {
            Deformation::None => Deformation::Stretch,
            Deformation::Stretch => Deformation::TowardHat { weight_shift },
            Deformation::TowardHat { .. } => Deformation::None,
        };
        self.change_scene().kernel.deformation = next;
        self.keep_above_ground();
    }

    pub(super) fn add_weight(&mut self, step: i32) {
        if !self.has_kernel() {
            return;
        }
        let Deformation::TowardHat { weight_shift } = self.scene.kernel.deformation else {
            self.notice = Some("only deformation 2 has a weight: press J".into());
            return;
        };
        // A scene may ask for more than the keys reach.
        let largest = LARGEST_SHIFT.max(weight_shift);
        let weight_shift = weight_shift.saturating_add_signed(step).min(largest);
        self.weight_shift = weight_shift;
        self.change_scene().kernel.deformation = Deformation::TowardHat { weight_shift };
        self.keep_above_ground();
    }

    /// How many times life size heights are drawn.
    #[must_use]
    pub fn exaggeration(&self) -> Option<f64> {
        self.scene.exaggeration(self.measure().sample_m())
    }

    /// The next exaggeration up or down.
    pub(super) fn exaggerate(&mut self, steps: i32) {
        let Some(now) = self.exaggeration() else {
            self.notice = Some("a plane has no heights to exaggerate".into());
            return;
        };
        // A hair aside, so that rounding does not find the same one again.
        let next = if steps > 0 {
            EXAGGERATIONS.into_iter().find(|&times| times > now * 1.001)
        } else {
            EXAGGERATIONS.into_iter().rev().find(|&times| times < now * 0.999)
        };
        let Some(times) = next else {
            self.notice = Some(format!("no key goes beyond {now:.1} times life size"));
            return;
        };
        let sample_m = self.measure().sample_m();
        self.change_scene().exaggerate(times, sample_m);
        self.keep_above_ground();
        self.notice.get_or_insert(format!("heights are drawn {times} times life size"));
    }

    /// Turns the sun clockwise and up, by degrees.
    pub(super) fn turn_sun(&mut self, clockwise: f64, up: f64) {
        if !self.is_lit() {
            return;
        }
        let towards = self.scene.light.direction;
        let course = towards.x.atan2(-towards.z).to_degrees();
        let course = (course + clockwise).round().rem_euclid(360.0);
        let height = (towards.y.asin().to_degrees() + up).round().clamp(SUN.0, SUN.1);
        let (sin, cos) = course.to_radians().sin_cos();
        let (high, flat) = height.to_radians().sin_cos();
        let towards = DVec3::new(sin * flat, high, -cos * flat);
        self.change_scene().light.direction = towards.normalize();
        let (_, point) = camera::compass(90.0 - course);
        self.notice = Some(format!("sun from {course}° ({point}), {height}° high"));
    }

    /// Another ramp from the lowest to the highest node.
    pub(super) fn next_ramp(&mut self, steps: i32) {
        if !self.is_lit() {
            return;
        }
        let of = |picture: Picture| {
            (0..8).filter_map(|at| picture.ramp(f64::from(at) / 7.0)).collect::<Vec<_>>()
        };
        let ramps = [
            ("of the scene", self.ramp.0.clone()),
            ("land", LAND.to_vec()),
            ("of the picture of heights", of(Picture::Height)),
            ("of the picture of steps", of(Picture::Steps)),
            ("grey", vec![[24; 3], [248; 3]]),
        ];
        let at = (self.ramp.1 as i32 + steps).rem_euclid(ramps.len() as i32) as usize;
        let (name, ramp) = ramps[at].clone();
        self.ramp.1 = at;
        self.change_scene().color.ramp = ramp;
        self.notice = Some(format!("colours {name}"));
    }

    /// Whether the scene has anything that sun and ramp change; says so if it has not.
    fn is_lit(&mut self) -> bool {
        let terrain = self.scene.terrain().is_some();
        if !terrain {
            self.notice = Some("a plane has neither light nor ramp".into());
        }
        terrain
    }
}
