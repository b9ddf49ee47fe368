//! What one number world says of one pixel, register by register.

use crate::engine::InFixedWorld;
use crate::frame::Hit;
use crate::plan::Plan;
use crate::processor;
use crate::scene::Scene;
use crate::setup::{Back, Memory, Setup, SetupError, TerrainUnits};
use crate::unit::Line;
use crate::unit::divider::Method;
use crate::unit::interpolator::{AT_THE_HIT, Form};
use crate::unit::line::{Entry, Work};
use crate::unit::stepper::Place;
use crate::word::{Cell, Complete, Fixed, Readout, Register, Site};

/// A register as one world has it.
#[derive(Clone, Debug)]
pub(super) struct Reading {
    pub unit: &'static str,
    pub register: Register,
    pub what: String,
    pub raw: Option<i64>,
    pub value: f64,
}

/// What one world says of the pixel.
#[derive(Clone, Debug)]
pub(super) struct Trace {
    unit: &'static str,
    pub hit: Hit,
    pub steps: u32,
    pub work: Work,
    pub color: [u8; 3],
    /// Why the divider turned the ray away, if it did.
    pub turned_away: Option<&'static str>,
    /// What a hole has to do with the end of the ray, if anything.
    pub hole: Option<&'static str>,
    /// Power of two from view vector to step.
    pub exponent: i32,
    pub readings: Vec<Reading>,
    pub formats: Vec<Option<Fixed>>,
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

    pub fn value(&self, what: &str) -> Option<f64> {
        self.readings.iter().find(|reading| reading.what == what).map(|reading| reading.value)
    }
}

/// One pixel to be walked in some world.
pub(super) struct Walk<'a> {
    pub scene: &'a Scene,
    pub plan: &'a Plan,
    pub column: u32,
    pub line: u32,
    /// Take the ray's position at this sample instead of the world's own hit.
    pub index: Option<u32>,
}

impl InFixedWorld for Walk<'_> {
    type Output = Result<Trace, SetupError>;
    fn run<W: Complete>(self, world: W) -> Self::Output {
        self.trace(world)
    }
}

impl Walk<'_> {
    pub fn trace<W: Complete>(&self, world: W) -> Result<Trace, SetupError> {
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
            turned_away: None,
            hole: None,
            exponent: 0,
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
            trace.turned_away = match entered.entry[0] {
                Entry::Met => None,
                Entry::Sky => {
                    Some("the denominator is not positive: the ray does not meet the plane")
                }
                Entry::Far => Some("the quotient is out of range: the entry lies beyond it"),
            };
            if entered.entry[0] == Entry::Met {
                trace.unit("divider");
                trace.read(Register::GroundX, "entry, x", entered.ground_x[0]);
                trace.read(Register::GroundZ, "entry, z", entered.ground_z[0]);
            }
        }
        match &setup.back {
            Back::Terrain(units) => self.terrain(units, &entered, &line, &mut trace),
            Back::Plane(checker) => {
                if line.entry[0] == Entry::Met {
                    let site = Site::pixel(self.line, self.column);
                    trace.unit("checker");
                    let contrast = checker.contrast(line.denominator[0], site);
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
        if stepper.from_eye {
            // A full machine's divider runs for nothing here.
            trace.turned_away = None;
        }
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
        trace.exponent = stepper.exponent(line.view_x[0], line.view_y[0], line.view_z[0], site);
        trace.read(Register::DGroundX, "step, x", step.x);
        trace.read(Register::DRayY, "step, y", step.y);
        trace.read(Register::DGroundZ, "step, z", step.z);
        for _ in 0..self.index.unwrap_or(trace.steps) {
            place = Place { x: place.x + step.x, y: place.y + step.y, z: place.z + step.z };
        }
        trace.place("last sample", place);
        trace.hole = at_hole(
            units,
            trace.hit,
            place.minus(step),
            [line.ground_x[0], line.ground_z[0]],
            site,
        );
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
            let shader = &units.shader;
            trace.unit("ramp");
            let place = shader.ramp.place(line.surface[0], site);
            trace.read(Register::Ramp, "place on the ramp", place);
            if shader.light.is_some() {
                trace.unit("light");
                trace.read(Register::Shade, "light", line.shade[0]);
            }
            trace.unit("mixer");
            for (channel, name) in line.lit[0].into_iter().zip(["red", "green", "blue"]) {
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
        let site = Site::pixel(self.line, self.column);
        let interpolator = &units.interpolator;
        if interpolator.form == Form::Stretch {
            let stencil = interpolator.stencil(x, z, site);
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
            for (node, name) in
                interpolator.nodes(x, z, site).into_iter().zip(["h1", "h2", "h3", "h4"])
            {
                trace.read(Register::Node, format!("node {name}"), node);
            }
            let arm_x = interpolator.arm(x.fraction(), site.step(AT_THE_HIT ^ 1));
            let arm_z = interpolator.arm(z.fraction(), site.step(AT_THE_HIT));
            trace.read(Register::Weight, "weight, x", arm_x.weight);
            trace.read(Register::Weight, "weight, z", arm_z.weight);
            trace.read(Register::WeightSlope, "weight slope, x", arm_x.slope);
            trace.read(Register::WeightSlope, "weight slope, z", arm_z.slope);
        }
    }
}

/// What a hole has to do with the end of a ray, from the place before its last sample and the one
/// on the wires.
fn at_hole<W: Complete>(
    units: &TerrainUnits<W>,
    hit: Hit,
    before: Place<W>,
    [x, z]: [W::Ground; 2],
    site: Site,
) -> Option<&'static str> {
    let interpolator = &units.interpolator;
    let holed = interpolator.heights.has_voids();
    match hit {
        // What is on the map and no surface is a hole.
        Hit::Side if holed && interpolator.is_on_map(before.x, before.z, site) => {
            Some("the ray comes out of a hole under the surface and meets its side")
        }
        Hit::Sky
            if holed && interpolator.is_on_map(x, z, site) && interpolator.is_hole(x, z, site) =>
        {
            Some("the ray leaves the map through a hole")
        }
        Hit::Surface | Hit::Side | Hit::Sky | Hit::Far => None,
    }
}
