//! The fast engine: the processor's frame, bit for bit, by threads, direct entry and loops that
//! vectorise.
#![deny(clippy::float_arithmetic)]
#![expect(
    clippy::needless_range_loop,
    reason = "loops over lanes read and write several arrays at one index, and vectorise so"
)]

pub mod enter;
pub mod heights;
pub mod march;

use fearless_simd::{Level, Simd as _, dispatch};
use rayon::prelude::*;

use crate::frame::Frame;
use crate::plan::Plan;
use crate::readout::FrameBuilder;
use crate::setup::{Back, Setup};
use crate::unit::Line;
use crate::unit::divider::Method;
use crate::word::Complete;
use enter::Enterable;

/// Lines that one task draws: enough to amortise its wires, few enough to balance two threads
/// between sky and ground.
const BAND: u32 = 16;

/// Draws one line on wires that hold all columns, at the widest SIMD level of the processor it runs
/// on.
pub fn run_line<W: Complete + Enterable>(setup: &Setup<W>, number: u32, line: &mut Line<W>) {
    let level = Level::new();
    dispatch!(level, simd => simd.vectorize(
        #[inline(always)]
        || run_units(setup, number, line)
    ));
}

#[inline(always)]
fn run_units<W: Complete + Enterable>(setup: &Setup<W>, number: u32, line: &mut Line<W>) {
    line.number = number;
    let start = enter::line_start(&setup.projector, number);
    enter::fill(&setup.projector, &start, line);
    if let Some(divider) = &setup.divider {
        divider.run(line, Method::Direct);
    }
    match &setup.back {
        Back::Terrain(units) => {
            march::run(&units.stepper, &units.interpolator, line);
            units.shade(line);
        }
        Back::Plane(shader) => shader.run(line),
    }
}

/// Draws a whole frame on all threads.
pub fn render<W: Complete + Enterable>(setup: &Setup<W>, plan: &Plan, buffers: bool) -> Frame {
    render_and_look(setup, plan, buffers, &|_| {})
}

/// Draws a whole frame and shows every finished line to `look`, in no particular order.
pub fn render_and_look<W: Complete + Enterable>(
    setup: &Setup<W>,
    plan: &Plan,
    buffers: bool,
    look: &(impl Fn(&Line<W>) + Sync),
) -> Frame {
    let bands: Vec<FrameBuilder<'_>> = (0..setup.lines.div_ceil(BAND))
        .into_par_iter()
        .map_init(
            || Line::new(&setup.world, 0..setup.columns),
            |line, band| {
                let lines = band * BAND..setup.lines.min((band + 1) * BAND);
                let mut builder = FrameBuilder::new(plan, lines.len(), buffers, false);
                for number in lines {
                    run_line(setup, number, line);
                    look(line);
                    builder.push(line);
                }
                builder
            },
        )
        .collect();
    let mut frame = FrameBuilder::new(plan, setup.lines as usize, buffers, false);
    for band in bands {
        frame.append(band);
    }
    frame.finish()
}
