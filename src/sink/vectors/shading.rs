//! What the files of the shader's parts and of the checker hold.

use super::text::{Coefficient, Way};
use super::units::Unit;
use super::wires::{
    COLOR, COUNT, EXPONENT, FLAG, Wire, color, entry, hit, is_lit, is_met, is_on_surface, notation,
    number, packed, place, wire, word,
};
use crate::unit::Line;
use crate::unit::checker::Checker;
use crate::unit::light::Light;
use crate::unit::mixer::Mixer;
use crate::unit::pixel::Pixel;
use crate::unit::ramp::Ramp;
use crate::word::{Complete, Readout, Register};

/// The constant colours.
fn constants(pixel: &Pixel) -> [Coefficient; 3] {
    [
        number("sky", COLOR, packed(pixel.sky), "colour of sky"),
        number(
            "out_of_range",
            COLOR,
            packed(pixel.out_of_range),
            "colour where the ground is out of range",
        ),
        number("side", COLOR, packed(pixel.side), "colour of a side"),
    ]
}

/// The light.
pub fn light<'a, W: Complete>(world: &W, unit: &Light<W>) -> Unit<'a, W> {
    use Register as R;
    const TOWARD: &str = "direction towards the light, times the diffuse share";
    let [x, y, z] = unit.toward;
    let mut wires = place();
    wires.extend([
        hit(Way::In),
        wire!(world, In SlopeX slope_x "negated slope along x; valid on surface and side" if is_on_surface),
        wire!(world, In SlopeZ slope_z "negated slope along z; valid on surface and side" if is_on_surface),
        wire!(world, Out Shade shade "light that the surface reflects; valid on surface" if is_lit),
    ]);
    Unit {
        stem: "light",
        holds: "the light that a surface of some slopes reflects",
        registers: &[R::SlopeX, R::SlopeZ, R::Normal, R::Shade],
        coefficients: vec![
            word(world, R::Shade, "light_x", x, TOWARD),
            word(world, R::Shade, "light_y", y, TOWARD),
            word(world, R::Shade, "light_z", z, TOWARD),
            word(world, R::Shade, "ambient", unit.ambient, "the ambient share"),
            word(world, R::Shade, "one", unit.one, "full light"),
            number("rsqrt_log2", COUNT, unit.rsqrt.log2(), "the table has 2^log2 entries a unit"),
        ],
        wires,
    }
}

/// The ramp.
pub fn ramp<'a, W: Complete>(world: &W, unit: &Ramp<W>) -> Unit<'a, W> {
    use Register as R;
    let segments = unit.segments.len() as i64;
    let mut wires = place();
    wires.extend([
        hit(Way::In),
        wire!(world, In Surface surface "height; valid on surface and side" if is_on_surface),
    ]);
    wires.extend(albedo(world, Way::Out));
    Unit {
        stem: "ramp",
        holds: "the colour of the ground by its height",
        registers: &[R::Surface, R::Ramp, R::Channel],
        coefficients: vec![
            number("ramp_exponent", EXPONENT, unit.exponent, "heights are shifted left by this"),
            word(world, R::Ramp, "ramp_gain", unit.gain, "segments per shifted height"),
            number("ramp_segments", COUNT, segments, "rows of ramp_segments.mem"),
        ],
        wires,
    }
}

/// The mixer.
pub fn mixer<'a, W: Complete>(world: &W, unit: &Mixer) -> Unit<'a, W> {
    use Register as R;
    const SHADED: &str = "1 where the light is fitted, 0 where the albedo is the lit colour";
    let mut wires = place();
    wires.push(hit(Way::In));
    wires.extend(albedo(world, Way::In));
    if unit.shaded {
        wires.push(wire!(world, In Shade shade "light that the surface reflects; valid on surface" if is_lit));
    }
    wires.extend(lit(world, Way::Out));
    Unit {
        stem: "mixer",
        holds: "the lit colour of the ground",
        registers: &[R::Shade, R::Channel],
        coefficients: vec![number("shaded", FLAG, unit.shaded, SHADED)],
        wires,
    }
}

/// The pixel.
pub fn pixel<'a, W: Complete>(world: &W, unit: &Pixel) -> Unit<'a, W> {
    let mut wires = place();
    wires.push(hit(Way::In));
    wires.extend(lit(world, Way::In));
    wires.push(color());
    Unit {
        stem: "pixel",
        holds: "the colour of a pixel of a height map",
        registers: &[Register::Channel],
        coefficients: constants(unit).to_vec(),
        wires,
    }
}

/// The checker.
pub fn checker<'a, W: Complete>(world: &W, unit: &Checker<W>) -> Unit<'a, W> {
    use Register as R;
    let mut coefficients = constants(&unit.pixel).to_vec();
    for (at, channel) in ["red", "green", "blue"].into_iter().enumerate() {
        const MEAN: &str = "mean of the two colours";
        const SWING: &str = "half of what they differ by";
        coefficients.push(word(world, R::Channel, format!("mean_{channel}"), unit.mean[at], MEAN));
        coefficients.push(word(
            world,
            R::Channel,
            format!("swing_{channel}"),
            unit.swing[at],
            SWING,
        ));
    }
    coefficients.extend([
        number(
            "contrast_exponent",
            EXPONENT,
            unit.contrast_exponent,
            "the denominator is shifted left by this",
        ),
        word(world, R::Shade, "contrast_gain", unit.contrast_gain, "contrast plus one per that"),
        word(world, R::Shade, "one", unit.one, "full contrast"),
    ]);
    if let Some(full) = unit.full_from {
        coefficients.push(Coefficient {
            name: "full_from".into(),
            notation: notation(world, R::Denominator),
            value: full.raw().unwrap_or_default(),
            meaning: "denominators from this on have full contrast",
        });
    }
    Unit {
        stem: "checker",
        holds: "outcome and colour of a pixel of a plane",
        registers: &[R::GroundX, R::GroundZ, R::Denominator, R::Shade, R::Channel],
        coefficients,
        wires: checker_wires(world),
    }
}

/// The colour of the ground, a wire per channel.
fn albedo<'a, W: Complete>(world: &W, way: Way) -> [Wire<'a, W>; 3] {
    [
        channel(world, way, "albedo_red", |line, at| line.albedo[at][0]),
        channel(world, way, "albedo_green", |line, at| line.albedo[at][1]),
        channel(world, way, "albedo_blue", |line, at| line.albedo[at][2]),
    ]
}

/// The lit colour of the ground, a wire per channel.
fn lit<'a, W: Complete>(world: &W, way: Way) -> [Wire<'a, W>; 3] {
    [
        channel(world, way, "lit_red", |line, at| line.lit[at][0]),
        channel(world, way, "lit_green", |line, at| line.lit[at][1]),
        channel(world, way, "lit_blue", |line, at| line.lit[at][2]),
    ]
}

/// A channel of a colour.
fn channel<'a, W: Complete>(
    world: &W,
    way: Way,
    name: &str,
    read: impl Fn(&Line<W>, usize) -> W::Tone + 'a,
) -> Wire<'a, W> {
    let read = move |line: &Line<W>, at: usize| {
        if is_lit(line, at) { read(line, at).raw() } else { None }
    };
    Wire::new(way, name, notation(world, Register::Channel), "0 to 255; valid on surface", read)
}

/// The wires of the checker.
fn checker_wires<'a, W: Complete>(world: &W) -> Vec<Wire<'a, W>> {
    let mut wires = place();
    wires.extend([
        entry(Way::In),
        wire!(world, In GroundX ground_x "place, x in squares; valid if met" if is_met),
        wire!(world, In GroundZ ground_z "place, z in squares; valid if met" if is_met),
        wire!(world, In Denominator denominator "denominator of the projection"),
        hit(Way::Out),
        color(),
    ]);
    wires
}
