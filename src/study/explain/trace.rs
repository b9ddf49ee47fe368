//! What one number world says of one pixel, register by register.

use super::quantity::{Axis, Quantity};
use crate::engine::WithSetup;
use crate::frame::Hit;
use crate::processor::Processor;
use crate::setup::{Back, Setup, SurfaceUnits, TerrainUnits};
use crate::unit::interpolator::{AT_THE_HIT, Form, Interpolator};
use crate::unit::line::{Entry, Work};
use crate::unit::stepper::Place;
use crate::unit::{Line, Wire};
use crate::word::{Cell, Complete, Fixed, Readout, Register, Site};

/// A quantity as one world has it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    /// Unit that drives it.
    pub unit: &'static str,
    pub quantity: Quantity,
    pub raw: Option<i64>,
    pub value: f64,
}

/// What one world says of the pixel.
#[derive(Clone, Debug)]
pub(super) struct Trace {
    pub hit: Hit,
    /// Index of the surface that it shows, whose units are read.
    pub owner: usize,
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
    pub fn value(&self, quantity: Quantity) -> Option<f64> {
        let found = self.readings.iter().find(|reading| reading.quantity == quantity);
        found.map(|reading| reading.value)
    }
}

/// The readings of a unit, in the order of the data flow.
struct Readings<'a> {
    unit: &'static str,
    readings: &'a mut Vec<Reading>,
}

impl Readings<'_> {
    fn read(&mut self, quantity: Quantity, word: impl Readout) {
        let (raw, value) = (word.raw(), word.value());
        self.readings.push(Reading { unit: self.unit, quantity, raw, value });
    }

    fn place<W: Complete>(&mut self, quantity: fn(Axis) -> Quantity, place: Place<W>) {
        self.read(quantity(Axis::X), place.x);
        self.read(quantity(Axis::Y), place.y);
        self.read(quantity(Axis::Z), place.z);
    }

    /// The words on an output wire, where the unit says something.
    fn wire<W: Complete>(&mut self, line: &Line<W>, wire: Wire) {
        if let (true, Some(value)) = (line.is(wire.when(), 0), line.value(wire, 0)) {
            let (quantity, raw) = (Quantity::Wire(wire), line.bits(wire, 0));
            self.readings.push(Reading { unit: self.unit, quantity, raw, value });
        }
    }
}

/// One pixel whose readings are wanted, in some world.
#[derive(Clone, Copy)]
pub(super) struct PixelTrace {
    pub column: u32,
    pub line: u32,
    /// Take the ray's position at this sample instead of the world's own hit.
    pub index: Option<u32>,
}

impl WithSetup for PixelTrace {
    type Output = Trace;

    fn run<W: Complete>(self, setup: &Setup<W>) -> Trace {
        let world = &setup.world;
        let mut line = Line::new(world, [self.column]);
        let mut processor = Processor::new(setup);
        for _ in 0..self.line {
            processor.skip_line();
        }
        processor.run_line(&mut line);
        let mut trace = Trace {
            hit: line.hit[0],
            owner: line.owner[0] as usize,
            steps: line.steps[0],
            work: line.work[0],
            color: line.color[0],
            turned_away: None,
            hole: None,
            exponent: 0,
            readings: Vec::new(),
            formats: Register::ALL.iter().map(|&register| world.fixed(register)).collect(),
        };
        let units = &setup.surfaces[trace.owner];
        if units.divider.is_some() {
            trace.turned_away = match line.entry[0] {
                Entry::Met => None,
                Entry::Sky => {
                    Some("the denominator is not positive: the ray does not meet the plane")
                }
                Entry::OutOfRange => Some("the quotient is out of range: the entry lies beyond it"),
            };
        }
        let mut readings = Vec::new();
        for unit in units.chain().iter().filter(|unit| !unit.is_idle()) {
            let name = unit.description().name;
            let mut own = Readings { unit: name, readings: &mut readings };
            self.inside(units, name, &line, &mut own, &mut trace);
            for wire in unit.outputs() {
                own.wire(&line, wire);
            }
        }
        trace.readings = readings;
        trace
    }
}

impl PixelTrace {
    /// What a unit has inside, between the wires.
    fn inside<W: Complete>(
        &self,
        units: &SurfaceUnits<W>,
        unit: &str,
        line: &Line<W>,
        own: &mut Readings<'_>,
        trace: &mut Trace,
    ) {
        let site = Site::pixel(self.line, self.column);
        let shown = trace.hit == Hit::Surface;
        match (&units.back, unit) {
            (Back::Terrain(units), "stepper") => self.ray(units, line, own, trace),
            (Back::Terrain(units), "interpolator") if shown || trace.hit == Hit::Side => {
                let place = (line.ground_x[0], line.ground_z[0]);
                interpolation(&units.interpolator, place, site, own);
            }
            (Back::Terrain(units), "ramp") if shown => {
                own.read(Quantity::RampPlace, units.shader.ramp.place(line.surface[0], site));
            }
            (Back::Plane(checker), "checker") if line.entry[0] == Entry::Met => {
                own.read(Quantity::Contrast, checker.contrast(line.denominator[0], site));
            }
            _ => {}
        }
    }

    fn ray<W: Complete>(
        &self,
        units: &TerrainUnits<W>,
        line: &Line<W>,
        own: &mut Readings<'_>,
        trace: &mut Trace,
    ) {
        let stepper = &units.stepper;
        if stepper.from_eye {
            // A full machine's divider runs for nothing here.
            trace.turned_away = None;
        }
        let Some(mut place) = stepper.start(line, 0) else { return };
        let (x, y, z) = (line.view_x[0], line.view_y[0], line.view_z[0]);
        let site = Site::pixel(self.line, self.column);
        let step = stepper.step(x, y, z, site);
        own.place(Quantity::Start, place);
        trace.exponent = stepper.exponent(x, y, z, site);
        own.place(Quantity::Step, step);
        for _ in 0..self.index.unwrap_or(trace.steps) {
            place = place.plus(step);
        }
        own.place(Quantity::LastSample, place);
        let there = [line.ground_x[0], line.ground_z[0]];
        trace.hole = at_hole(units, trace.hit, place.minus(step), there, site);
    }
}

/// Nodes and weights around a place.
fn interpolation<W: Complete>(
    interpolator: &Interpolator<W>,
    (x, z): (W::Ground, W::Ground),
    site: Site,
    own: &mut Readings<'_>,
) {
    if interpolator.form == Form::Stretch {
        let stencil = interpolator.stencil(x, z, site);
        for (column, nodes) in (-1..).zip(stencil.nodes) {
            for (row, node) in (-1..).zip(nodes) {
                own.read(Quantity::Node(column, row), node);
            }
        }
        for (axis, outer) in [(Axis::X, stencil.weights_x), (Axis::Z, stencil.weights_z)] {
            own.read(Quantity::Weight(axis), outer.weights[0]);
            own.read(Quantity::WeightAfter(axis), outer.weights[1]);
        }
    } else {
        for (at, node) in interpolator.nodes(x, z, site).into_iter().enumerate() {
            own.read(Quantity::CellNode(at), node);
        }
        let arm_x = interpolator.arm(x.fraction(), site.step(AT_THE_HIT ^ 1));
        let arm_z = interpolator.arm(z.fraction(), site.step(AT_THE_HIT));
        own.read(Quantity::Weight(Axis::X), arm_x.weight);
        own.read(Quantity::Weight(Axis::Z), arm_z.weight);
        own.read(Quantity::WeightSlope(Axis::X), arm_x.slope);
        own.read(Quantity::WeightSlope(Axis::Z), arm_z.slope);
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
        Hit::Surface | Hit::Side | Hit::Sky | Hit::OutOfRange => None,
    }
}
