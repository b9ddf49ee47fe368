//! The coefficients that are loaded before a frame: their addresses, and their values from the
//! emulator's set-up. The module `registers` of the RTL is generated from this list.

use terraline::frame::Hit;
use terraline::scene::Hardware;
use terraline::setup::{Back, Setup, TerrainUnits};

use terraline::unit::checker::Checker;
use terraline::unit::color::Flat;
use terraline::unit::height_memory::Edge;
use terraline::unit::interpolator::Form;
use terraline::unit::projector::Linear;
use terraline::unit::stepper::HalvingRule;
use terraline::word::{Complete, Readout, Word};

/// Bits of a coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bits {
    /// A word of the machine, signed.
    Word,
    /// An index of a cell, as many bits as positions have before the point.
    Cell,
    /// So many bits, unsigned.
    Unsigned(u32),
    /// So many bits, signed.
    Signed(u32),
}

/// A coefficient; its place in [`COEFFICIENTS`] is its address.
#[derive(Clone, Copy, Debug)]
pub struct Coefficient {
    /// Name in the RTL.
    pub name: &'static str,
    /// Bits.
    pub bits: Bits,
    /// What it is.
    pub meaning: &'static str,
}

const fn row(name: &'static str, bits: Bits, meaning: &'static str) -> Coefficient {
    Coefficient { name, bits, meaning }
}

/// All coefficients, by address.
pub const COEFFICIENTS: &[Coefficient] = {
    use Bits::{Cell, Signed, Unsigned, Word};
    &[
        row("columns", Unsigned(16), "pixels across"),
        row("lines", Unsigned(16), "scan lines"),
        row("view_x_start", Word, "view_x of line 0, column 0"),
        row("view_x_per_line", Word, "its increment per line"),
        row("view_x_per_column", Word, "its increment per column"),
        row("view_y_start", Word, "view_y of line 0, column 0"),
        row("view_y_per_line", Word, "its increment per line"),
        row("view_y_per_column", Word, "its increment per column"),
        row("view_z_start", Word, "view_z of line 0, column 0"),
        row("view_z_per_line", Word, "its increment per line"),
        row("view_z_per_column", Word, "its increment per column"),
        row("denominator_start", Word, "denominator of line 0, column 0"),
        row("denominator_per_line", Word, "its increment per line"),
        row("denominator_per_column", Word, "its increment per column"),
        row("eye_x", Word, "the eye, x: cells or squares"),
        row("eye_z", Word, "the eye, z"),
        row("ratio_shift", Signed(8), "numerators times two to this power"),
        row("ratio_bits", Unsigned(6), "quotient bits: stages in use"),
        row("from_eye", Unsigned(1), "rays start at the eye: the divider is passed by"),
        row("eye_y", Word, "the eye, y in height units"),
        row("highest", Word, "the highest node"),
        row("base", Word, "base of the block under the map"),
        row("fineness", Unsigned(3), "k: a step is at most 2^-k cells"),
        row("last", Unsigned(26), "index of the last sample"),
        row("halvings_fixed", Unsigned(1), "always halve halvings_cap times"),
        row("halvings_bias", Signed(8), "halvings at distance one"),
        row("halvings_cap", Unsigned(6), "most halvings"),
        row("skipping", Unsigned(1), "the pyramid is fitted"),
        row("pyramid_top", Unsigned(5), "highest level of the pyramid"),
        row("beyond_sky", Unsigned(1), "quotients out of range are sky, not far"),
        row("map_columns", Cell, "nodes of the map in x"),
        row("map_rows", Cell, "nodes of the map in z"),
        row("map_ends", Unsigned(1), "the map ends at its edge, else its edge nodes go on"),
        row("sides", Unsigned(1), "the map has sides, down to the base"),
        row("void_bits", Unsigned(1), "nodes may have no data"),
        row("form", Unsigned(2), "weights: 0 the kernel's, 1 blended with the hat's, 2 the hat's"),
        row("blend_shift", Unsigned(6), "the blend's shift"),
        row("table_log2", Unsigned(5), "entries of the kernel tables per cell, power of two"),
        row("slope_scaled", Unsigned(1), "slopes have factors"),
        row("slope_scale_x", Word, "height unit over cell size, x"),
        row("slope_scale_z", Word, "height unit over cell size, z"),
        row("memory_latency", Unsigned(7), "M: cycles from address to data"),
        row("sky_color", Unsigned(24), "colour where nothing is met, red in the low byte"),
        row("far_color", Unsigned(24), "colour out of range"),
        row("side_color", Unsigned(24), "colour of the map's side"),
        row("lit", Unsigned(1), "the light is fitted"),
        row("toward_x", Word, "direction to the light times the diffuse share, x"),
        row("toward_y", Word, "the same, y"),
        row("toward_z", Word, "the same, z"),
        row("ambient", Word, "ambient share"),
        row("ramp_exponent", Signed(8), "heights times two to this power lie in [0, 1)"),
        row("ramp_gain", Word, "ramp segments per such height"),
        row("ramp_last", Unsigned(4), "last segment"),
        row("mean_red", Word, "mean of the two colours, red"),
        row("mean_green", Word, "the same, green"),
        row("mean_blue", Word, "the same, blue"),
        row("swing_red", Word, "half their difference, red"),
        row("swing_green", Word, "the same, green"),
        row("swing_blue", Word, "the same, blue"),
        row("contrast_exponent", Signed(8), "power of two on the denominator"),
        row("contrast_gain", Word, "gain that makes contrast plus one"),
        row("full_from_fitted", Unsigned(1), "there is a denominator of full contrast"),
        row("full_from", Word, "denominator from which on contrast is full"),
    ]
};

/// Values of the coefficients that a scene uses, by name; the others are zero.
#[derive(Debug, Default)]
pub struct Values(Vec<(&'static str, i64)>);

impl Values {
    /// Address and word of every coefficient.
    pub fn words(&self) -> impl Iterator<Item = (u32, u64)> + '_ {
        COEFFICIENTS.iter().enumerate().map(|(address, coefficient)| {
            let set = self.0.iter().find(|(name, _)| *name == coefficient.name);
            (address as u32, set.map_or(0, |&(_, value)| value) as u64)
        })
    }

    fn set(&mut self, name: &'static str, value: impl Into<i64>) {
        debug_assert!(COEFFICIENTS.iter().any(|coefficient| coefficient.name == name), "{name}");
        self.0.push((name, value.into()));
    }

    fn word<T: Word + Readout>(&mut self, name: &'static str, word: T) {
        self.set(name, raw(word));
    }

    fn linear<T: Word + Readout>(&mut self, names: [&'static str; 3], linear: &Linear<T>) {
        let [start, per_line, per_column] = names;
        self.word(start, linear.start);
        self.word(per_line, linear.per_line);
        self.word(per_column, linear.per_column);
    }
}

/// The bits of a stock word.
pub fn raw<T: Readout>(word: T) -> i64 {
    word.raw().unwrap_or_else(|| unreachable!("stock words have bits"))
}

/// A power of two as the registers hold it. Shifts by more than a word leave nothing, whatever they
/// are.
fn exponent(value: i32) -> i64 {
    value.clamp(-128, 127).into()
}

/// What a set-up loads into the coefficient registers of a machine.
pub fn values<W: Complete>(setup: &Setup<W>, hardware: &Hardware) -> Values {
    let mut out = Values::default();
    out.set("memory_latency", hardware.memory_latency);
    out.set("columns", setup.columns);
    out.set("lines", setup.lines);
    let projector = &setup.projector;
    out.linear(["view_x_start", "view_x_per_line", "view_x_per_column"], &projector.x);
    if let Some(y) = &projector.y {
        out.linear(["view_y_start", "view_y_per_line", "view_y_per_column"], y);
    }
    out.linear(["view_z_start", "view_z_per_line", "view_z_per_column"], &projector.z);
    if let Some(d) = &projector.denominator {
        let names = ["denominator_start", "denominator_per_line", "denominator_per_column"];
        out.linear(names, d);
    }
    if let Some(divider) = &setup.divider {
        out.word("eye_x", divider.eye_x);
        out.word("eye_z", divider.eye_z);
        out.set("ratio_bits", divider.bits);
        let point = divider.bits - 1 - divider.ratio_x.range;
        let shift = divider.ratio_x.exponent + point as i32;
        // A numerator that is shifted further is out of range unless it is zero.
        let width = raw_width(setup);
        out.set("ratio_shift", exponent(shift.min((width + divider.bits) as i32 - 2)));
    }
    match &setup.back {
        Back::Terrain(units) => terrain(&mut out, units),
        Back::Plane(checker) => plane(&mut out, checker),
    }
    out
}

/// Bits of a stock word.
fn raw_width<W: Complete>(setup: &Setup<W>) -> u32 {
    let fixed = setup.world.fixed(terraline::word::Register::ViewX);
    fixed.map_or_else(|| unreachable!("stock words have a width"), |fixed| fixed.width)
}

fn terrain<W: Complete>(out: &mut Values, units: &TerrainUnits<W>) {
    let stepper = &units.stepper;
    if stepper.from_eye {
        out.word("eye_x", stepper.eye_x);
        out.word("eye_z", stepper.eye_z);
    }
    out.set("from_eye", stepper.from_eye);
    out.word("eye_y", stepper.eye_y);
    out.word("highest", stepper.top);
    out.word("base", stepper.base);
    out.set("fineness", stepper.fineness);
    out.set("last", stepper.last);
    match stepper.halvings {
        HalvingRule::Fixed(times) => {
            out.set("halvings_fixed", true);
            out.set("halvings_cap", times);
        }
        HalvingRule::Footprint { bias, cap } => {
            out.set("halvings_bias", exponent(bias));
            out.set("halvings_cap", cap);
        }
    }
    out.set("skipping", stepper.pyramid.is_some());
    out.set("pyramid_top", stepper.pyramid.as_ref().map_or(0, |pyramid| pyramid.top()));
    out.set("beyond_sky", stepper.beyond == Hit::Sky);
    let interpolator = &units.interpolator;
    let heights = &interpolator.heights;
    out.set("map_columns", heights.columns());
    out.set("map_rows", heights.rows());
    out.set("map_ends", heights.edge() == Edge::Ends);
    out.set("sides", stepper.sides);
    out.set("void_bits", heights.has_voids());
    let (form, shift) = match interpolator.form {
        Form::Plain | Form::Stretch => (0, 0),
        Form::Blend(shift) => (1, shift),
        Form::Hat => (2, 0),
    };
    out.set("form", form);
    out.set("blend_shift", shift);
    out.set("table_log2", interpolator.rom.as_ref().map_or(4, |rom| rom.log2()));
    if let Some([x, z]) = interpolator.slope_scale {
        out.set("slope_scaled", true);
        out.word("slope_scale_x", x);
        out.word("slope_scale_z", z);
    }
    let shader = &units.shader;
    flat(out, shader.flat);
    if let Some(light) = &shader.light {
        let [x, y, z] = light.toward;
        out.set("lit", true);
        out.word("toward_x", x);
        out.word("toward_y", y);
        out.word("toward_z", z);
        out.word("ambient", light.ambient);
    }
    out.set("ramp_exponent", exponent(shader.ramp.exponent));
    out.word("ramp_gain", shader.ramp.gain);
    out.set("ramp_last", shader.ramp.segments.len() as i64 - 1);
}

fn plane<W: Complete>(out: &mut Values, checker: &Checker<W>) {
    flat(out, checker.flat);
    for (names, words) in [
        (["mean_red", "mean_green", "mean_blue"], checker.mean),
        (["swing_red", "swing_green", "swing_blue"], checker.swing),
    ] {
        for (name, word) in names.into_iter().zip(words) {
            out.word(name, word);
        }
    }
    out.set("contrast_exponent", exponent(checker.contrast_exponent));
    out.word("contrast_gain", checker.contrast_gain);
    if let Some(full) = checker.full_from {
        out.set("full_from_fitted", true);
        out.word("full_from", full);
    }
}

fn flat(out: &mut Values, flat: Flat) {
    for (name, [red, green, blue]) in
        [("sky_color", flat.sky), ("far_color", flat.far), ("side_color", flat.side)]
    {
        out.set(name, u32::from_le_bytes([red, green, blue, 0]));
    }
}
