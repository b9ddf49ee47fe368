//! From the wires of a line to the frame: the way back from words to `f64`.
//!
//! Both engines and the studies read their wires through here, so equal wires make equal frames.

use glam::DVec3;

use crate::frame::{Buffers, Frame, Hit};
use crate::plan::{Ground, Plan};
use crate::unit::Line;
use crate::word::{Open, Readout};

/// What one pixel's wires say, in scene units.
#[derive(Clone, Copy, Debug)]
pub struct PixelReadout {
    /// λ of `r_p = r_h + λ V` (equation 8; thesis 2.15).
    pub lambda: f64,
    /// The ground point; y is the surface's height there.
    pub point: DVec3,
    /// Unit normal.
    pub normal: DVec3,
}

/// Reads pixels of a plan's machine.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'a> {
    plan: &'a Plan,
}

impl<'a> Reader<'a> {
    /// A reader for the wires of a plan.
    pub fn new(plan: &'a Plan) -> Self {
        Self { plan }
    }

    /// Pixel `i` of a line that met something; `None` for sky and far.
    pub fn pixel<W: Open>(&self, line: &Line<W>, i: usize) -> Option<PixelReadout> {
        if !matches!(line.hit[i], Hit::Surface | Hit::Side) {
            return None;
        }
        let (x, z) = (line.ground_x[i].value(), line.ground_z[i].value());
        let (point, normal) = match &self.plan.ground {
            Ground::Terrain(walk) => {
                let height = walk.scale.to_scene(line.surface[i].value());
                let point = DVec3::new(x * walk.lengths.x, height, z * walk.lengths.z);
                let (slope_x, slope_z) = (line.slope_x[i].value(), line.slope_z[i].value());
                (point, DVec3::new(slope_x, 1.0, slope_z).normalize())
            }
            Ground::Plane(plane) => {
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
        let lambda = away.dot(along) / along.length_squared();
        Some(PixelReadout { lambda, point, normal })
    }
}

/// A frame under construction, line by line.
#[derive(Debug)]
pub struct FrameBuilder<'a> {
    columns: usize,
    lines: usize,
    color: Vec<[u8; 3]>,
    hit: Vec<Hit>,
    buffers: Option<BufferBuilder<'a>>,
}

impl<'a> FrameBuilder<'a> {
    /// An empty frame of a plan's size.
    pub fn new(plan: &'a Plan, lines: usize, buffers: bool, trials: bool) -> Self {
        let columns = plan.geometry.columns as usize;
        Self {
            columns,
            lines,
            color: Vec::with_capacity(columns * lines),
            hit: Vec::with_capacity(columns * lines),
            buffers: buffers.then(|| BufferBuilder::new(plan, lines, trials)),
        }
    }

    /// The next line.
    pub fn push<W: Open>(&mut self, line: &Line<W>) {
        self.color.extend_from_slice(&line.color);
        self.hit.extend_from_slice(&line.hit);
        if let Some(buffers) = &mut self.buffers {
            buffers.push(line);
        }
    }

    /// Another builder's lines after these.
    pub fn append(&mut self, other: FrameBuilder<'_>) {
        self.color.extend(other.color);
        self.hit.extend(other.hit);
        if let (Some(to), Some(from)) = (&mut self.buffers, other.buffers) {
            to.append(from);
        }
    }

    /// The frame.
    pub fn finish(self) -> Frame {
        let Self { columns, lines, color, hit, buffers } = self;
        Frame { columns, lines, color, hit, buffers: buffers.map(BufferBuilder::finish) }
    }
}

/// The quantities behind a frame's colours under construction, line by line.
#[derive(Debug)]
pub struct BufferBuilder<'a> {
    reader: Reader<'a>,
    buffers: Buffers,
}

impl<'a> BufferBuilder<'a> {
    /// Empty buffers for so many lines of a plan's width.
    pub fn new(plan: &'a Plan, lines: usize, trials: bool) -> Self {
        let pixels = plan.geometry.columns as usize * lines;
        let buffers = Buffers {
            lambda: Vec::with_capacity(pixels),
            ground_x: Vec::with_capacity(pixels),
            ground_z: Vec::with_capacity(pixels),
            height: Vec::with_capacity(pixels),
            normal: Vec::with_capacity(pixels),
            steps: Vec::with_capacity(pixels),
            trials: trials.then(|| Vec::with_capacity(pixels)),
        };
        Self { reader: Reader::new(plan), buffers }
    }

    /// The next line.
    pub fn push<W: Open>(&mut self, line: &Line<W>) {
        let buffers = &mut self.buffers;
        for i in 0..line.len() {
            let pixel = self.reader.pixel(line, i).unwrap_or(PixelReadout {
                lambda: f64::NAN,
                point: DVec3::NAN,
                normal: DVec3::NAN,
            });
            buffers.lambda.push(pixel.lambda);
            buffers.ground_x.push(pixel.point.x);
            buffers.ground_z.push(pixel.point.z);
            buffers.height.push(pixel.point.y);
            buffers.normal.push(pixel.normal.to_array());
            let met = pixel.lambda.is_finite();
            buffers.steps.push(if met { line.steps[i] } else { 0 });
            if let Some(trials) = &mut buffers.trials {
                trials.push(line.work[i].trials);
            }
        }
    }

    /// Another builder's lines after these.
    pub fn append(&mut self, other: BufferBuilder<'_>) {
        let (to, from) = (&mut self.buffers, other.buffers);
        to.lambda.extend(from.lambda);
        to.ground_x.extend(from.ground_x);
        to.ground_z.extend(from.ground_z);
        to.height.extend(from.height);
        to.normal.extend(from.normal);
        to.steps.extend(from.steps);
        if let (Some(to), Some(from)) = (&mut to.trials, from.trials) {
            to.extend(from);
        }
    }

    /// The buffers.
    pub fn finish(self) -> Buffers {
        self.buffers
    }
}
