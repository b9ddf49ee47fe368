//! One pixel, register by register, from set-up to colour: fixed, real and oracle side by side.

use glam::DVec3;
use serde::Serialize;

use super::bounds;
use crate::engine::{self, FixedWorld, InFixedWorld};
use crate::fast::enter::Enterable;
use crate::frame::Hit;
use crate::oracle::Sighting;
use crate::plan::{Ground, Plan};
use crate::processor;
use crate::scene::Scene;
use crate::setup::coefficients::Coefficients;
use crate::setup::table;
use crate::setup::{Back, Memory, Setup, SetupError, TerrainUnits};
use crate::unit::Line;
use crate::unit::divider::Method;
use crate::unit::line::{Entry, Work};
use crate::unit::stepper::Place;
use crate::word::real::Real;
use crate::word::{Complete, Fixed, Readout, Register, Site};

/// One register of one pixel.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Unit that drives the register.
    pub unit: &'static str,
    /// What it is.
    pub what: String,
    /// Register.
    pub register: &'static str,
    /// Its format.
    pub format: String,
    /// Its bits.
    pub raw: Option<i64>,
    /// Its value.
    pub value: f64,
    /// The same in the real world.
    pub real: Option<f64>,
    /// The closed form.
    pub oracle: Option<f64>,
    /// Value minus real.
    pub error: Option<f64>,
    /// Derived bound of the error, where there is one.
    pub bound: Option<f64>,
    /// Equation numbers.
    pub equations: &'static str,
}

/// A pixel explained.
#[derive(Clone, Debug, Serialize)]
pub struct Explanation {
    /// Column.
    pub column: u32,
    /// Line.
    pub line: u32,
    /// Outcome in fixed point.
    pub hit: &'static str,
    /// Outcome in the real world.
    pub real_hit: &'static str,
    /// Outcome of the oracle.
    pub oracle_hit: &'static str,
    /// Index of the sample that hit.
    pub steps: u32,
    /// Trials, samples, halvings.
    pub trials: u32,
    /// See `trials`.
    pub samples: u32,
    /// See `trials`.
    pub halvings: u32,
    /// sRGB bytes: fixed.
    pub color: [u8; 3],
    /// sRGB bytes: oracle.
    pub oracle_color: [u8; 3],
    /// Registers in the order of the data flow.
    pub rows: Vec<Row>,
}

/// A register as one world has it.
#[derive(Clone, Debug)]
struct Reading {
    unit: &'static str,
    register: Register,
    what: String,
    raw: Option<i64>,
    value: f64,
}

/// What one world says of the pixel.
#[derive(Clone, Debug)]
struct Trace {
    unit: &'static str,
    hit: Hit,
    steps: u32,
    work: Work,
    color: [u8; 3],
    readings: Vec<Reading>,
    formats: Vec<Option<Fixed>>,
}

impl Trace {
    /// The unit that drives the readings that follow.
    fn unit(&mut self, unit: &'static str) {
        self.unit = unit;
    }

    fn read(&mut self, register: Register, what: impl Into<String>, word: impl Readout) {
        let (raw, value) = (word.raw(), word.value());
        self.readings.push(Reading { unit: self.unit, register, what: what.into(), raw, value });
    }

    fn place<W: Complete>(&mut self, what: &str, place: Place<W>) {
        self.read(Register::GroundX, format!("{what}, x"), place.x);
        self.read(Register::RayY, format!("{what}, y"), place.y);
        self.read(Register::GroundZ, format!("{what}, z"), place.z);
    }

    fn value(&self, what: &str) -> Option<f64> {
        self.readings.iter().find(|reading| reading.what == what).map(|reading| reading.value)
    }
}

struct Walk<'a> {
    scene: &'a Scene,
    plan: &'a Plan,
    column: u32,
    line: u32,
    /// Take the ray's position at this sample instead of the world's own hit.
    index: Option<u32>,
}

impl InFixedWorld for Walk<'_> {
    type Output = Result<Trace, SetupError>;
    fn run<W: Complete + Enterable>(self, world: W) -> Self::Output {
        self.trace(world)
    }
}

impl Walk<'_> {
    fn trace<W: Complete>(&self, world: W) -> Result<Trace, SetupError> {
        let memory = Memory::new(&world, self.scene, self.plan)?;
        let setup = Setup::new(world, self.scene, self.plan, memory.as_ref())?;
        let mut line = Line::new(&world, [self.column]);
        // The units up to the entry first, then the rest on the same wires.
        let mut entered = line.clone();
        let mut processor = processor::Processor::new(&setup);
        for _ in 0..self.line {
            processor.skip_line();
        }
        let start = processor.line_start();
        entered.number = self.line;
        setup.projector.run(start, &mut entered);
        if let Some(divider) = &setup.divider {
            divider.run(&mut entered, Method::Array);
        }
        processor.run_line(&mut line);
        let mut trace = Trace {
            unit: "projector",
            hit: line.hit[0],
            steps: line.steps[0],
            work: line.work[0],
            color: line.color[0],
            readings: Vec::new(),
            formats: Register::ALL.iter().map(|&register| world.fixed(register)).collect(),
        };
        trace.read(Register::ViewX, "view, x", line.view_x[0]);
        if setup.projector.y.is_some() {
            trace.read(Register::ViewY, "view, y", line.view_y[0]);
        }
        trace.read(Register::ViewZ, "view, z", line.view_z[0]);
        if setup.divider.is_some() {
            trace.read(Register::Denominator, "denominator", line.denominator[0]);
            if entered.entry[0] == Entry::Met {
                trace.unit("divider");
                trace.read(Register::GroundX, "entry, x", entered.ground_x[0]);
                trace.read(Register::GroundZ, "entry, z", entered.ground_z[0]);
            }
        }
        match &setup.back {
            Back::Terrain(units) => self.terrain(units, &entered, &line, &mut trace),
            Back::Plane(shader) => {
                if line.entry[0] == Entry::Met {
                    let site = Site::pixel(self.line, self.column);
                    trace.unit("shader");
                    let contrast = shader.contrast(line.denominator[0], site);
                    trace.read(Register::Shade, "contrast of the squares", contrast);
                }
            }
        }
        Ok(trace)
    }

    fn terrain<W: Complete>(
        &self,
        units: &TerrainUnits<W>,
        entered: &Line<W>,
        line: &Line<W>,
        trace: &mut Trace,
    ) {
        let stepper = &units.stepper;
        if !stepper.from_eye && entered.entry[0] != Entry::Met {
            return;
        }
        let site = Site::pixel(self.line, self.column);
        let step = stepper.step(line.view_x[0], line.view_y[0], line.view_z[0], site);
        let mut place = if stepper.from_eye {
            stepper.eye()
        } else {
            Place { x: entered.ground_x[0], y: stepper.top, z: entered.ground_z[0] }
        };
        trace.unit("stepper");
        trace.place("start of the ray", place);
        trace.read(Register::DGroundX, "step, x", step.x);
        trace.read(Register::DRayY, "step, y", step.y);
        trace.read(Register::DGroundZ, "step, z", step.z);
        for _ in 0..self.index.unwrap_or(trace.steps) {
            place = Place { x: place.x + step.x, y: place.y + step.y, z: place.z + step.z };
        }
        trace.place("last sample", place);
        if !matches!(trace.hit, Hit::Surface | Hit::Side) {
            return;
        }
        let (x, z) = (line.ground_x[0], line.ground_z[0]);
        trace.read(Register::GroundX, "hit, x", x);
        trace.read(Register::GroundZ, "hit, z", z);
        trace.unit("interpolator");
        self.interpolation(units, x, z, trace);
        trace.read(Register::Surface, "surface height", line.surface[0]);
        trace.read(Register::SlopeX, "slope, x", line.slope_x[0]);
        trace.read(Register::SlopeZ, "slope, z", line.slope_z[0]);
        if trace.hit == Hit::Surface {
            let tones = units.shader.tones(line.surface[0], line.slope_x[0], line.slope_z[0], site);
            trace.read(Register::Ramp, "place on the ramp", tones.ramp);
            if let Some(shade) = tones.shade {
                trace.read(Register::Shade, "light", shade);
            }
            for (channel, name) in tones.channels.into_iter().zip(["red", "green", "blue"]) {
                trace.read(Register::Channel, name, channel);
            }
        }
    }

    fn interpolation<W: Complete>(
        &self,
        units: &TerrainUnits<W>,
        x: W::Ground,
        z: W::Ground,
        trace: &mut Trace,
    ) {
        use crate::unit::interpolator::Form;
        use crate::word::Cell;
        let site = Site::pixel(self.line, self.column);
        let interpolator = &units.interpolator;
        if interpolator.form == Form::Stretch {
            let stencil = interpolator.stencil(x, z);
            for (i, column) in stencil.nodes.iter().enumerate() {
                for (j, node) in column.iter().enumerate() {
                    trace.read(
                        Register::Node,
                        format!("node ({}, {})", i as i32 - 1, j as i32 - 1),
                        *node,
                    );
                }
            }
            for (side, at) in [("before", 0), ("after", 1)] {
                trace.read(
                    Register::Weight,
                    format!("weight {side}, x"),
                    stencil.weights_x.weights[at],
                );
                trace.read(
                    Register::Weight,
                    format!("weight {side}, z"),
                    stencil.weights_z.weights[at],
                );
            }
        } else {
            for (node, name) in interpolator.nodes(x, z).into_iter().zip(["h1", "h2", "h3", "h4"]) {
                trace.read(Register::Node, format!("node {name}"), node);
            }
            let arm_x = interpolator.arm(x.fraction(), site);
            let arm_z = interpolator.arm(z.fraction(), site);
            trace.read(Register::Weight, "weight, x", arm_x.weight);
            trace.read(Register::Weight, "weight, z", arm_z.weight);
            trace.read(Register::WeightSlope, "weight slope, x", arm_x.slope);
            trace.read(Register::WeightSlope, "weight slope, z", arm_z.slope);
        }
    }
}

/// Name of an outcome.
pub fn hit_name(hit: Hit) -> &'static str {
    match hit {
        Hit::Sky => "sky",
        Hit::Surface => "surface",
        Hit::Side => "side",
        Hit::Far => "far",
    }
}

/// Explains a pixel.
///
/// # Errors
/// If the scene cannot be set up.
pub fn explain(
    scene: &Scene,
    plan: &Plan,
    world: &FixedWorld,
    column: u32,
    line: u32,
) -> Result<Explanation, SetupError> {
    let fixed = world.run(Walk { scene, plan, column, line, index: None })?;
    let index = Some(fixed.steps);
    let real = Walk { scene, plan, column, line, index }.trace(Real)?;
    let oracle = engine::oracle(scene, plan);
    let sighting = oracle.pixel(line.into(), column.into());
    let closed = Closed {
        scene,
        plan,
        coefficients: Coefficients::new(plan),
        direction: oracle.direction(line.into(), column.into()),
        eye: oracle.eye(),
        sighting,
    };
    let rows = fixed
        .readings
        .iter()
        .map(|reading| {
            let format = fixed.formats[reading.register as usize];
            let real_value = real.value(&reading.what);
            let entry = table::entry(reading.register);
            Row {
                unit: reading.unit,
                what: reading.what.clone(),
                register: reading.register.name(),
                format: format.map_or_else(|| "f64".into(), |format| format.to_string()),
                raw: reading.raw,
                value: reading.value,
                real: real_value,
                oracle: closed.value(&reading.what),
                error: real_value.map(|real| reading.value - real),
                bound: bound(&fixed, reading, &closed.coefficients, column, line),
                equations: entry.equations,
            }
        })
        .collect();
    Ok(Explanation {
        column,
        line,
        hit: hit_name(fixed.hit),
        real_hit: hit_name(real.hit),
        oracle_hit: hit_name(sighting.hit),
        steps: fixed.steps,
        trials: fixed.work.trials,
        samples: fixed.work.samples,
        halvings: fixed.work.halvings,
        color: fixed.color,
        oracle_color: sighting.color,
        rows,
    })
}

/// Closed forms of a pixel's registers.
struct Closed<'a> {
    scene: &'a Scene,
    plan: &'a Plan,
    coefficients: Coefficients,
    direction: DVec3,
    eye: DVec3,
    sighting: Sighting,
}

impl Closed<'_> {
    fn ramp(&self, top: f64) -> f64 {
        let Ground::Terrain(walk) = &self.plan.ground else { return 0.0 };
        let height = walk.scale.to_register(self.sighting.point.y);
        let segments = (self.scene.color.ramp.len() - 1) as f64;
        if top == 0.0 { 0.0 } else { height / top * segments }
    }

    fn light(&self) -> f64 {
        let light = &self.scene.light;
        let diffuse = self.sighting.normal.dot(light.direction).max(0.0);
        light.ambient + (1.0 - light.ambient) * diffuse
    }

    fn value(&self, what: &str) -> Option<f64> {
        match &self.plan.ground {
            Ground::Terrain(walk) => {
                let view = self.direction / walk.lengths;
                let eye = walk.eye;
                let scale = libm::scalbn(1.0, self.coefficients.view_exponent);
                let lambda = (walk.top - eye.y) / view.y;
                let met = self.sighting.point.is_finite();
                let slope = |at: usize| {
                    let n = self.sighting.normal;
                    met.then(|| n.to_array()[at] / n.y)
                };
                match what {
                    "view, x" => Some(view.x * scale),
                    "view, y" => Some(view.y * scale),
                    "view, z" => Some(view.z * scale),
                    "denominator" if !walk.from_eye => {
                        let scale = libm::scalbn(1.0, self.coefficients.denominator_exponent);
                        Some(view.y / (walk.top - eye.y) * scale)
                    }
                    "entry, x" => Some(eye.x + lambda * view.x),
                    "entry, z" => Some(eye.z + lambda * view.z),
                    "hit, x" => met.then(|| self.sighting.point.x / walk.lengths.x),
                    "hit, z" => met.then(|| self.sighting.point.z / walk.lengths.z),
                    "surface height" => met.then(|| walk.scale.to_register(self.sighting.point.y)),
                    "place on the ramp" if met => Some(self.ramp(walk.top)),
                    "light" if met => Some(self.light()),
                    "slope, x" => slope(0),
                    "slope, z" => slope(2),
                    _ => None,
                }
            }
            Ground::Plane(plane) => {
                let along = |at: usize| plane.axes[at].dot(self.direction) / plane.checker;
                let scale = libm::scalbn(1.0, self.coefficients.view_exponent);
                let g = plane.normal.dot(self.direction);
                let point = |at: usize| {
                    let met = self.sighting.point.is_finite();
                    met.then(|| {
                        plane.axes[at].dot(self.eye + g.recip() * plane.numerator * self.direction)
                            / plane.checker
                    })
                };
                match what {
                    "view, x" => Some(along(0) * scale),
                    "view, z" => Some(along(1) * scale),
                    "denominator" if plane.numerator != 0.0 => {
                        let scale = libm::scalbn(1.0, self.coefficients.denominator_exponent);
                        Some(g / plane.numerator * scale)
                    }
                    "entry, x" => point(0),
                    "entry, z" => point(1),
                    _ => None,
                }
            }
        }
    }
}

/// The derived bound of a reading, where there is one.
fn bound(
    trace: &Trace,
    reading: &Reading,
    coefficients: &Coefficients,
    column: u32,
    line: u32,
) -> Option<f64> {
    let format = |register: Register| trace.formats[register as usize];
    let view = |register| format(register).map(|f| bounds::view(f, line, column));
    let exponent = coefficients.denominator_exponent - coefficients.view_exponent;
    let entry = |register, numerator, view_register| {
        Some(bounds::entry(
            format(register)?,
            trace.value(numerator)? / trace.value("denominator")? * libm::scalbn(1.0, exponent),
            trace.value("denominator")?,
            exponent,
            view(view_register)?,
            view(Register::Denominator)?,
        ))
    };
    let ray = |register, start, view_register, step: &str, view_name: &str| {
        // The shift that made the step, read back from its size: both are powers of two apart.
        let (step, view_value) = (trace.value(step)?, trace.value(view_name)?);
        let shift = if view_value == 0.0 { 0 } else { libm::frexp((step / view_value).abs()).1 };
        Some(bounds::ray(format(register)?, start, trace.steps, view(view_register)?, shift))
    };
    let start = |what| match what {
        "x" => entry(Register::GroundX, "view, x", Register::ViewX),
        _ => entry(Register::GroundZ, "view, z", Register::ViewZ),
    };
    let half = |register| format(register).map(|f| f.ulp() / 2.0);
    match reading.what.as_str() {
        "view, x" | "view, y" | "view, z" | "denominator" => view(reading.register),
        "entry, x" => start("x"),
        "entry, z" => start("z"),
        "last sample, x" => {
            let from = start("x").or(half(Register::GroundX))?;
            ray(Register::GroundX, from, Register::ViewX, "step, x", "view, x")
        }
        "last sample, z" => {
            let from = start("z").or(half(Register::GroundZ))?;
            ray(Register::GroundZ, from, Register::ViewZ, "step, z", "view, z")
        }
        "last sample, y" => {
            ray(Register::RayY, half(Register::RayY)?, Register::ViewY, "step, y", "view, y")
        }
        _ => None,
    }
}

/// Whether every bounded row keeps its bound.
pub fn keeps_bounds(explanation: &Explanation) -> bool {
    explanation.rows.iter().all(|row| match (row.error, row.bound) {
        (Some(error), Some(bound)) => error.abs() <= bound,
        _ => true,
    })
}
