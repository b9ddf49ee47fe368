//! What the file of each unit holds: its registers, and the wires that are its columns.

use super::text::{Coefficient, Way};
use super::wires::{
    COUNT, EXPONENT, FLAG, OUTCOME, Wire, entry, hit, is_met, is_on_surface, notation, number,
    place, wire, word,
};
use crate::clock::Chain;
use crate::setup::TerrainUnits;
use crate::unit::Line;
use crate::unit::divider::Divider;
use crate::unit::height_memory::Edge;
use crate::unit::interpolator::{Form, Interpolator};
use crate::unit::projector::{Linear, Projector};
use crate::unit::stepper::HalvingRule;
use crate::word::{Complete, Ratio, Readout, Register, World};

/// The file of a unit.
pub struct Unit<'a, W: World> {
    /// Name: stem of the file, and of the unit's page in docs/units.
    pub stem: &'static str,
    /// What the unit is.
    pub holds: &'static str,
    /// Registers whose formats and equations the header gives.
    pub registers: &'static [Register],
    /// Coefficient registers.
    pub coefficients: Vec<Coefficient>,
    /// Wires in and out.
    pub wires: Vec<Wire<'a, W>>,
}

/// The accumulators of a projector that are fitted.
pub fn accumulators<W: World>(unit: &Projector<W>) -> Vec<(Register, Linear<W::View>)> {
    let all = [
        (Register::ViewX, Some(unit.x)),
        (Register::ViewY, unit.y),
        (Register::ViewZ, Some(unit.z)),
        (Register::Denominator, unit.denominator),
    ];
    all.into_iter().filter_map(|(register, linear)| Some((register, linear?))).collect()
}

/// The projector, without the number of the coefficient set.
pub fn projector<'a, W: Complete>(world: &W, unit: &Projector<W>) -> Unit<'a, W> {
    let mut coefficients = Vec::new();
    let mut wires = place();
    for (register, linear) in accumulators(unit) {
        for (part, value, meaning) in [
            ("start", linear.start, "value at line 0, column 0"),
            ("per_line", linear.per_line, "increment per line"),
            ("per_column", linear.per_column, "increment per column"),
        ] {
            let name = format!("{register}_{part}");
            coefficients.push(word(world, register, name, value, meaning));
        }
        wires.push(match register {
            Register::ViewX => wire!(world, Out ViewX view_x "view vector along x"),
            Register::ViewY => wire!(world, Out ViewY view_y "view vector along y"),
            Register::ViewZ => wire!(world, Out ViewZ view_z "view vector along z"),
            _ => wire!(world, Out Denominator denominator "positive towards the plane"),
        });
    }
    Unit {
        stem: "projector",
        holds: "view vector and denominator of a pixel by additions",
        registers: &[Register::ViewX, Register::ViewY, Register::ViewZ, Register::Denominator],
        coefficients,
        wires,
    }
}

/// Places by which the array shifts the numerator's bits to the left: the exponent, and what the
/// points of numerator, denominator and quotient differ by.
pub fn shift<W: World, F>(
    world: &W,
    ratio: &Ratio<F>,
    numerator: Register,
    ground: Register,
) -> i32 {
    let point = |register| world.fixed(register).map_or(0, |fixed| fixed.point as i32);
    ratio.exponent + point(ground) + point(Register::Denominator) - point(numerator)
}

/// The divider.
pub fn divider<'a, W: Complete>(world: &W, unit: &Divider<W>) -> Unit<'a, W> {
    use Register as R;
    let shift_x = shift(world, &unit.ratio_x, R::ViewX, R::GroundX);
    let shift_z = shift(world, &unit.ratio_z, R::ViewZ, R::GroundZ);
    let bits = |register| {
        let point = world.fixed(register).map_or(0, |fixed| fixed.point);
        i64::from(unit.ratio_x.range + point + 1)
    };
    const SHIFT: &str = "places to shift the numerator left (right if negative) before the ratio";
    const BITS: &str = "quotient bits: the quotient is in range from -2^(bits-1) to 2^(bits-1)-1";
    let mut wires = place();
    wires.extend([
        wire!(world, In ViewX view_x "numerator along x"),
        wire!(world, In ViewZ view_z "numerator along z"),
        wire!(world, In Denominator denominator "denominator of both"),
        entry(Way::Out),
        wire!(world, Out GroundX ground_x "eye plus quotient, x; valid if met" if is_met),
        wire!(world, Out GroundZ ground_z "eye plus quotient, z; valid if met" if is_met),
    ]);
    Unit {
        stem: "divider",
        holds: "where the ray meets a plane: one ratio per axis",
        registers: &[R::ViewX, R::ViewZ, R::Denominator, R::GroundX, R::GroundZ],
        coefficients: vec![
            word(world, R::GroundX, "eye_x", unit.eye_x, "foot of the ratio: the eye, x"),
            word(world, R::GroundZ, "eye_z", unit.eye_z, "foot of the ratio: the eye, z"),
            number("shift_x", EXPONENT, shift_x, SHIFT),
            number("shift_z", EXPONENT, shift_z, SHIFT),
            number("bits_x", COUNT, bits(R::GroundX), BITS),
            number("bits_z", COUNT, bits(R::GroundZ), BITS),
        ],
        wires,
    }
}

/// Code of what lies beyond the edge of the map.
fn edge(edge: Edge) -> Coefficient {
    let meaning = "beyond the edge: 0 the map ends, 1 its edge nodes go on, 2 it repeats";
    number("edge", OUTCOME, edge as i64, meaning)
}

/// The stepper.
pub fn stepper<'a, W: Complete>(
    world: &W,
    units: &TerrainUnits<W>,
    chain: &'a Chain,
) -> Unit<'a, W> {
    use Register as R;
    let unit = &units.stepper;
    let mut coefficients = vec![
        number("from_eye", FLAG, unit.from_eye, "1 where rays start at the eye, not at the entry"),
        word(world, R::GroundX, "eye_x", unit.eye_x, "the eye, x"),
        word(world, R::RayY, "eye_y", unit.eye_y, "the eye, y"),
        word(world, R::GroundZ, "eye_z", unit.eye_z, "the eye, z"),
        word(world, R::RayY, "top", unit.top, "the highest node: y of an entry"),
        word(world, R::RayY, "base", unit.base, "base of the block under the map"),
        number("sides", FLAG, unit.sides, "1 where the map has sides, drawn down to the base"),
        number("fineness", COUNT, unit.fineness, "k: steps are 2^-k-1 to 2^-k cells"),
        number("last", COUNT, unit.last, "index of the last sample"),
        number("beyond", OUTCOME, unit.beyond as i64, "hit of an entry that is far"),
        number("columns", COUNT, units.interpolator.heights.columns(), "nodes of the map in x"),
        number("rows", COUNT, units.interpolator.heights.rows(), "nodes of the map in z"),
        edge(units.interpolator.heights.edge()),
    ];
    match unit.halvings {
        HalvingRule::Fixed(times) => {
            coefficients.push(number("halvings", COUNT, times, "halvings after every hit"));
        }
        HalvingRule::Footprint { bias, cap } => coefficients.extend([
            number("halving_bias", EXPONENT, bias, "halvings are bias minus leading one"),
            number("halving_cap", COUNT, cap, "and at most this many"),
        ]),
    }
    if let Some(pyramid) = &unit.pyramid {
        coefficients.push(number("pyramid_top", COUNT, pyramid.top(), "highest level"));
    }
    let mut wires = place();
    wires.extend([
        wire!(world, In ViewX view_x "view vector along x"),
        wire!(world, In ViewY view_y "view vector along y"),
        wire!(world, In ViewZ view_z "view vector along z"),
    ]);
    if !unit.from_eye {
        wires.extend([
            entry(Way::In),
            wire!(world, In GroundX ground_x "entry, x; valid if met" if is_met),
            wire!(world, In GroundZ ground_z "entry, z; valid if met" if is_met),
        ]);
    }
    let steps = |line: &Line<W>, at: usize| is_on_surface(line, at).then(|| line.steps[at].into());
    let work = |line: &Line<W>, at: usize| Some(chain.stepper_work(line.work[at]).into());
    wires.extend([
        hit(Way::Out),
        wire!(world, Out GroundX ground_x "place, x; valid on surface and side" if is_on_surface),
        wire!(world, Out GroundZ ground_z "place, z; valid on surface and side" if is_on_surface),
        Wire::new(
            Way::Out,
            "steps",
            COUNT,
            "index of the sample that hit; valid as the place",
            steps,
        ),
        Wire::new(Way::Out, "work", COUNT, "cycles of work on the item", work),
    ]);
    Unit {
        stem: "stepper",
        holds: "the first sample of a ray under the surface",
        registers: &[
            R::ViewX,
            R::ViewY,
            R::ViewZ,
            R::GroundX,
            R::GroundZ,
            R::DGroundX,
            R::DGroundZ,
            R::RayY,
            R::DRayY,
            R::Node,
            R::Surface,
            R::Weight,
        ],
        coefficients,
        wires,
    }
}

/// The interpolator.
pub fn interpolator<'a, W: Complete>(world: &W, unit: &Interpolator<W>) -> Unit<'a, W> {
    use Register as R;
    let (form, shift) = match unit.form {
        Form::Plain => (0, 0),
        Form::Blend(shift) => (1, shift),
        Form::Hat => (2, 0),
        Form::Stretch => (3, 0),
    };
    let mut coefficients = vec![
        number("form", OUTCOME, form, "0 plain, 1 blend, 2 hat, 3 stretch"),
        number("blend_shift", COUNT, shift, "places that a blend shifts the difference right"),
        word(world, R::Weight, "one", unit.one, "the weight one"),
        number("columns", COUNT, unit.heights.columns(), "nodes of the map in x"),
        number("rows", COUNT, unit.heights.rows(), "nodes of the map in z"),
        edge(unit.heights.edge()),
    ];
    if let Some(rom) = &unit.rom {
        let meaning = "the kernel tables have 2^log2 entries a cell, and one";
        coefficients.push(number("kernel_log2", COUNT, rom.log2(), meaning));
    }
    if let Some([x, z]) = unit.slope_scale {
        const SCALE: &str = "factor on a slope: height unit over cell";
        coefficients.push(word(world, R::Weight, "slope_scale_x", x, SCALE));
        coefficients.push(word(world, R::Weight, "slope_scale_z", z, SCALE));
    }
    let mut wires = place();
    wires.extend([
        hit(Way::In),
        wire!(world, In GroundX ground_x "place, x; valid on surface and side" if is_on_surface),
        wire!(world, In GroundZ ground_z "place, z; valid on surface and side" if is_on_surface),
        wire!(world, Out Surface surface "height there; valid as the place" if is_on_surface),
        wire!(world, Out SlopeX slope_x "negated slope along x; valid as the place" if is_on_surface),
        wire!(world, Out SlopeZ slope_z "negated slope along z; valid as the place" if is_on_surface),
    ]);
    Unit {
        stem: "interpolator",
        holds: "surface height and slopes at a place",
        registers: &[
            R::GroundX,
            R::GroundZ,
            R::Node,
            R::Surface,
            R::SlopeX,
            R::SlopeZ,
            R::Weight,
            R::WeightSlope,
        ],
        coefficients,
        wires,
    }
}
