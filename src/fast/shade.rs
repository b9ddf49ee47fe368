//! Interpolator and shader at the hits of a line, sixteen pixels at a time: the arithmetic of
//! `unit::interpolator`, and of `light`, `ramp`, `mixer` and `pixel` there in functions of the same
//! names, on vectors.

use fearless_simd::prelude::*;
use fearless_simd::{i32x16, mask32x16, u32x16};

use super::heights::{entries, nodes, slope, weight};
use super::land::Land;
use super::narrow::Products;
use super::words::{LANES, Packed, Words, lanes};
use crate::frame::Hit;
use crate::unit::interpolator::Form;
use crate::unit::light::Light;
use crate::unit::ramp::Ramp;
use crate::unit::shader::Shader;
use crate::unit::{Line, Unit as _};
use crate::word::Lane as _;

/// Drives `surface`, `slope_x`, `slope_z` and `color` of one line.
#[inline(always)]
pub fn run<W: Packed, S: Simd>(land: &Land<'_, W, S>, shader: &Shader<W>, line: &mut Line<W>) {
    if land.surface.form == Form::Stretch || !factors_are_short(land, shader) {
        land.surface.run(line);
        shader.units().for_each(|unit| unit.run(line));
        return;
    }
    for from in (0..line.len()).step_by(LANES) {
        let pixels = from..line.len().min(from + LANES);
        let hit = &line.hit[pixels.clone()];
        if hit.contains(&Hit::Surface) || hit.contains(&Hit::Side) {
            lit(land, shader, line, from);
        }
        for i in pixels {
            if let Some(color) = shader.pixel.constant(line.hit[i]) {
                line.color[i] = color;
            }
        }
    }
}

/// Whether the factors that a scene can make long have 32 bits, and their products 64.
fn factors_are_short<W: Packed, S: Simd>(land: &Land<'_, W, S>, shader: &Shader<W>) -> bool {
    let short = |factor: W::Int| i32::try_from(factor.into()).is_ok();
    let steepest: i64 = land.stepper.top.int().into();
    let product = |factor: W::Int| steepest.checked_mul(4)?.checked_mul(factor.into());
    short(shader.ramp.gain.int())
        && land.surface.slope_scale.iter().flatten().all(|scale| {
            let scale = scale.int();
            short(scale) && product(scale).is_some()
        })
}

/// Up to sixteen pixels as if all of them met the surface.
#[inline(always)]
fn lit<W: Packed, S: Simd>(
    land: &Land<'_, W, S>,
    shader: &Shader<W>,
    line: &mut Line<W>,
    from: usize,
) {
    let count = LANES.min(line.len() - from);
    let (mut x, mut z) = ([W::Int::default(); LANES], [W::Int::default(); LANES]);
    for lane in 0..count {
        (x[lane], z[lane]) = (line.ground_x[from + lane].int(), line.ground_z[from + lane].int());
    }
    let (x, z) = (W::Words::load(land.simd, x), W::Words::load(land.simd, z));
    let [h1, h2, h3, h4] = nodes(land, x.cell(), z.cell());
    let (fraction_x, fraction_z) = (x.fraction(), z.fraction());
    let (entries_x, entries_z) = (entries(land, fraction_x), entries(land, fraction_z));
    let weight_x = weight(land, fraction_x, entries_x.as_ref());
    let weight_z = weight(land, fraction_z, entries_z.as_ref());
    let west = h2 + (h1 - h2).weighted(weight_z);
    let east = h4 + (h3 - h4).weighted(weight_z);
    let north = h3 + (h1 - h3).weighted(weight_x);
    let south = h4 + (h2 - h4).weighted(weight_x);
    let surface = east + (west - east).weighted(weight_x);
    let mut slope_x = (east - west).weighted(slope(land, entries_x.as_ref()));
    let mut slope_z = (south - north).weighted(slope(land, entries_z.as_ref()));
    if let Some(scale) = &land.surface.slope_scale {
        let [scale_x, scale_z] = scale.map(|scale| word(land, scale.int()));
        (slope_x, slope_z) = (slope_x.weighted(scale_x), slope_z.weighted(scale_z));
    }
    let mut color = ramp(land, &shader.ramp, surface);
    if let Some(unit) = &shader.light {
        let shade = light(land, unit, slope_x, slope_z);
        color = mixer::<W, S>(color, shade);
    }
    let [red, green, blue] = pixel::<W, S>(color);
    let (surface, slope_x, slope_z) = (surface.store(), slope_x.store(), slope_z.store());
    for lane in 0..count {
        line.surface[from + lane] = W::Height::of_int(surface[lane]);
        line.slope_x[from + lane] = W::Height::of_int(slope_x[lane]);
        line.slope_z[from + lane] = W::Height::of_int(slope_z[lane]);
        line.color[from + lane] = [red[lane] as u8, green[lane] as u8, blue[lane] as u8];
    }
}

/// A word that is known to have 32 bits.
#[inline(always)]
fn short<W: Packed>(word: W::Int) -> i32 {
    let word: i64 = word.into();
    word as i32
}

/// A register of at most 32 bits in all lanes.
#[inline(always)]
fn word<W: Packed, S: Simd>(land: &Land<'_, W, S>, word: W::Int) -> i32x16<S> {
    i32x16::simd_from(land.simd, short::<W>(word))
}

/// `a·b`, words of 32 bits, rounded once.
#[inline(always)]
fn product<W: Packed, S: Simd>(a: i32x16<S>, b: i32x16<S>) -> i32x16<S> {
    Products::of(a, b).rounded(W::Words::<S>::POINT)
}

/// `a·b + c·d`, words of 32 bits, rounded once.
#[inline(always)]
fn two_products<W: Packed, S: Simd>(
    (a, b): (i32x16<S>, i32x16<S>),
    (c, d): (i32x16<S>, i32x16<S>),
) -> i32x16<S> {
    (Products::of(a, b) + Products::of(c, d)).rounded(W::Words::<S>::POINT)
}

/// Ambient plus diffuse light: `Light::shade`.
#[inline(always)]
fn light<W: Packed, S: Simd>(
    land: &Land<'_, W, S>,
    light: &Light<W>,
    slope_x: W::Words<S>,
    slope_z: W::Words<S>,
) -> i32x16<S> {
    let one = word(land, light.one.int());
    let leading = W::Words::leading_one([slope_x, slope_z, slope_z]).max(0);
    let places = (leading + 1).bitcast::<u32x16<S>>();
    let (x, z) = (slope_x.reduced(places), slope_z.reduced(places));
    let y = one >> (leading + 1).min(31);
    let square = two_products::<W, S>((x, x), (z, z)) + product::<W, S>(y, y);
    let roots = light.rsqrt.entries();
    let places = W::Words::<S>::POINT - light.rsqrt.log2();
    let last = roots.len() as i32 - 1;
    let entries = ((square + (1 << (places - 1))) >> places).min(last).max(0).to_array();
    let rsqrt = lanes!(lane => short::<W>(roots[entries[lane] as usize].int()));
    let rsqrt = i32x16::simd_from(land.simd, rsqrt);
    let [light_x, light_y, light_z] = light.toward;
    let (light_x, light_z) = (word(land, light_x.int()), word(land, light_z.int()));
    let dot = two_products::<W, S>((x, light_x), (z, light_z))
        + product::<W, S>(y, word(land, light_y.int()));
    let ambient = word(land, light.ambient.int());
    let lit: mask32x16<S> = dot.simd_gt(0);
    lit.select((ambient + product::<W, S>(dot, rsqrt)).min(one), ambient)
}

/// Albedo: `Ramp::color` at `Ramp::place`.
#[inline(always)]
fn ramp<W: Packed, S: Simd>(
    land: &Land<'_, W, S>,
    ramp: &Ramp<W>,
    surface: W::Words<S>,
) -> [W::Words<S>; 3] {
    let place = surface.rescaled(ramp.exponent).weighted(word(land, ramp.gain.int()));
    let last = ramp.segments.len() as i32 - 1;
    let segment = place.cell().max(0).min(last).to_array();
    // The end of the ramp is the end of its last segment.
    let fraction = place
        .cell()
        .simd_gt(last)
        .select(i32x16::simd_from(land.simd, 1 << W::Words::<S>::POINT), place.fraction());
    let mut colors = [surface; 3];
    for (channel, color) in colors.iter_mut().enumerate() {
        let start = lanes!(lane => ramp.segments[segment[lane] as usize][channel].0.int());
        let rise = lanes!(lane => ramp.segments[segment[lane] as usize][channel].1.int());
        let rise = W::Words::load(land.simd, rise).weighted(fraction);
        *color = W::Words::load(land.simd, start) + rise;
    }
    colors
}

/// Albedo times shade: `Mixer`.
#[inline(always)]
fn mixer<W: Packed, S: Simd>(albedo: [W::Words<S>; 3], shade: i32x16<S>) -> [W::Words<S>; 3] {
    let [red, green, blue] = albedo;
    [red.weighted(shade), green.weighted(shade), blue.weighted(shade)]
}

/// The nearest bytes: `Pixel::rounded`.
#[inline(always)]
fn pixel<W: Packed, S: Simd>(lit: [W::Words<S>; 3]) -> [[i32; LANES]; 3] {
    let half = i32x16::simd_from(lit[0].cell().token(), 1 << (W::Words::<S>::POINT - 1));
    let mut bytes = [[0; LANES]; 3];
    for (bytes, channel) in bytes.iter_mut().zip(lit) {
        *bytes = (channel + W::Words::widened(half)).cell().max(0).min(255).to_array();
    }
    bytes
}
