//! From the wires of a line to the frame: the way back from words to `f64`.
//!
//! All engines and the studies read their wires through here, so equal wires make equal frames.

use glam::DVec3;

use crate::frame::{Buffers, Frame, Giver, Hit, Pixel};
use crate::plan::{Plan, SurfacePlan, TerrainPlan};
use crate::unit::Line;
use crate::word::{Open, Readout};

/// Reads the wires of a plan's machine, in scene units.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'a> {
    plan: &'a Plan,
}

impl<'a> Reader<'a> {
    /// A reader for the wires of a plan.
    pub fn new(plan: &'a Plan) -> Self {
        Self { plan }
    }

    /// Pixel `i` of a line that met something; `None` for sky and out of range.
    pub fn pixel<W: Open>(&self, line: &Line<W>, i: usize) -> Option<Pixel> {
        if !matches!(line.hit[i], Hit::Surface | Hit::Side) {
            return None;
        }
        let (point, normal) = match &self.plan.surfaces[line.owner[i] as usize] {
            SurfacePlan::Terrain(walk) => {
                let (x, z) = (line.ground_x[i].value(), line.ground_z[i].value());
                let height = walk.scale.to_scene(line.surface[i].value());
                let point = DVec3::new(x * walk.lengths.x, height, z * walk.lengths.z);
                let (slope_x, slope_z) = (line.slope_x[i].value(), line.slope_z[i].value());
                (point, DVec3::new(slope_x, 1.0, slope_z).normalize())
            }
            SurfacePlan::Plane(plane) => {
                let (x, z) = (line.entry_x[i].value(), line.entry_z[i].value());
                let foot =
                    plane.normal * (plane.numerator + plane.normal.dot(self.plan.geometry.eye));
                let [first, second] = plane.axes;
                let point = foot + (first * x + second * z) * plane.checker;
                (point, plane.normal)
            }
        };
        let view = self.plan.geometry.view.at(line.number.into(), line.column[i].into());
        let mut away = point - self.plan.geometry.eye;
        let mut along = view;
        if line.hit[i] == Hit::Side {
            // The point's height is that of the rim above the place on the side.
            (away.y, along.y) = (0.0, 0.0);
        }
        let by_point = away.dot(along) / along.length_squared();
        let lambda = match &self.plan.surfaces[line.owner[i] as usize] {
            SurfacePlan::Terrain(walk) => along_the_ray(walk, line, i, view, by_point),
            SurfacePlan::Plane(_) => by_point,
        };
        Some(Pixel {
            lambda,
            ground_x: point.x,
            ground_z: point.z,
            height: point.y,
            normal: normal.to_array(),
            steps: if lambda.is_finite() { line.steps[i] } else { 0 },
            trials: line.work[i].skip_tests,
        })
    }

    /// Appends a line to buffers. Skip tests are counted on misses, too.
    pub fn read<W: Open>(&self, line: &Line<W>, giver: Giver, buffers: &mut Buffers) {
        for i in 0..line.len() {
            let miss = || Pixel { trials: line.work[i].skip_tests, ..Pixel::MISS };
            buffers.push(self.pixel(line, i).unwrap_or_else(miss), giver);
        }
    }

    /// Appends a line of the processor to a frame that was made with room for it.
    pub fn push<W: Open>(&self, line: &Line<W>, frame: &mut Frame) {
        frame.color.extend_from_slice(&line.color);
        frame.hit.extend_from_slice(&line.hit);
        if let Some(buffers) = &mut frame.buffers {
            self.read(line, Giver::Processor, buffers);
        }
    }
}

/// λ of a hit on a height map (equation 37): that of its point where it lies in the ray's step under
/// the surface. On steep ground the height of the surface says little of the ray: there λ follows
/// from the place alone, and failing that is the middle of the step.
fn along_the_ray<W: Open>(
    walk: &TerrainPlan,
    line: &Line<W>,
    i: usize,
    view: DVec3,
    by_point: f64,
) -> f64 {
    let view = (view / walk.lengths).to_array();
    let words = [line.view_x[i].value(), line.view_y[i].value(), line.view_z[i].value()];
    let places = [line.ground_x[i].value(), walk.top, line.ground_z[i].value()];
    let starts = [line.entry_x[i].value(), walk.top, line.entry_z[i].value()];
    let along = |places: [f64; 3], axis: usize| (places[axis] - walk.eye[axis]) / view[axis];
    let longer = |a: usize, b: usize| if words[b].abs() > words[a].abs() { b } else { a };
    let level = longer(0, 2);
    let longest = longer(level, 1);
    let start = if walk.from_eye { 0.0 } else { along(starts, longest) };
    // The view register shifted so that this component is below 2^-k (equation 20).
    let (part, _) = libm::frexp(words[longest].abs());
    let step = libm::scalbn(part, -(walk.fineness as i32)) / view[longest].abs();
    let middle = start + (f64::from(line.steps[i]) - 0.5) * step;
    // Half a step on either side is for roundings.
    let is_near = |lambda: &f64| *lambda > 0.0 && (lambda - middle).abs() < step;
    [by_point, along(places, level)].into_iter().find(is_near).unwrap_or(middle)
}
