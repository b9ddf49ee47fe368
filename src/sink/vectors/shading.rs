//! What the files of the two shaders hold.

use super::text::{Coefficient, Way};
use super::units::Unit;
use super::wires::{
    COLOR, COUNT, EXPONENT, Wire, color, entry, hit, is_met, is_on_surface, notation, number,
    packed, place, wire, word,
};
use crate::unit::Line;
use crate::unit::checker::Checker;
use crate::unit::color::Flat;
use crate::unit::shader::TerrainShader;
use crate::word::{Complete, Readout, Register};

fn flat(flat: &Flat) -> [Coefficient; 3] {
    [
        number("sky", COLOR, packed(flat.sky), "colour of sky"),
        number("far", COLOR, packed(flat.far), "colour of far"),
        number("side", COLOR, packed(flat.side), "colour of a side"),
    ]
}

/// The shader of height maps.
pub fn shader<'a, W: Complete>(world: &W, unit: &TerrainShader<W>) -> Unit<'a, W> {
    use Register as R;
    let mut coefficients = flat(&unit.flat).to_vec();
    if let Some(light) = &unit.light {
        let [x, y, z] = light.toward;
        const TOWARD: &str = "direction towards the light, times the diffuse share";
        coefficients.extend([
            word(world, R::Shade, "light_x", x, TOWARD),
            word(world, R::Shade, "light_y", y, TOWARD),
            word(world, R::Shade, "light_z", z, TOWARD),
            word(world, R::Shade, "ambient", light.ambient, "the ambient share"),
            word(world, R::Shade, "one", light.one, "full light"),
            number("rsqrt_log2", COUNT, light.rsqrt_log2, "the table has 2^log2 entries a unit"),
        ]);
    }
    let ramp = &unit.ramp;
    coefficients.extend([
        number("ramp_exponent", EXPONENT, ramp.exponent, "heights are shifted left by this"),
        word(world, R::Ramp, "ramp_gain", ramp.gain, "segments per shifted height"),
        number("ramp_segments", COUNT, ramp.segments.len() as i64, "rows of ramp.mem"),
    ]);
    Unit {
        stem: "shader",
        page: "shader",
        holds: "the colour of a pixel of a height map",
        registers: &[R::Surface, R::SlopeX, R::SlopeZ, R::Normal, R::Shade, R::Ramp, R::Channel],
        coefficients,
        wires: shader_wires(world),
    }
}

/// The shader of planes.
pub fn checker<'a, W: Complete>(world: &W, unit: &Checker<W>) -> Unit<'a, W> {
    use Register as R;
    let mut coefficients = flat(&unit.flat).to_vec();
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
        page: "shader",
        holds: "outcome and colour of a pixel of a plane",
        registers: &[R::GroundX, R::GroundZ, R::Denominator, R::Shade, R::Channel],
        coefficients,
        wires: checker_wires(world),
    }
}

/// The wires of the shader of height maps.
fn shader_wires<'a, W: Complete>(world: &W) -> Vec<Wire<'a, W>> {
    let mut wires = place();
    wires.extend([
        hit(Way::In),
        wire!(world, In Surface surface "height; valid on surface and side" if is_on_surface),
        wire!(world, In SlopeX slope_x "negated slope along x; valid as the height" if is_on_surface),
        wire!(world, In SlopeZ slope_z "negated slope along z; valid as the height" if is_on_surface),
        color(),
    ]);
    wires
}

/// The wires of the shader of planes.
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
