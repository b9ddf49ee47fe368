//! Corner cases: words at the ends of their ranges, tiny and negative denominators, accumulators
//! that wrap, places on the rims of cells. What stands on the wires is random, but nothing that
//! the units before would never hand on; what is expected comes from the units themselves.

use crate::frame::Hit;
use crate::setup::{Back, SurfaceUnits, TerrainUnits};
use crate::unit::checker::Checker;
use crate::unit::divider::Divider;
use crate::unit::line::Entry;
use crate::unit::projector::{Linear, Projector};
use crate::unit::surface_unit::SurfaceUnit;
use crate::unit::{Description, Line};
use crate::word::format::hash;
use crate::word::{Complete, Fixed, Load, Readout, Register, Site, Word};

/// Lines and columns that a set of coefficients is scanned over.
pub const RASTER: u32 = 4;

/// Random words of a world.
#[derive(Debug)]
pub struct CornerCases<W> {
    world: W,
    seed: u64,
    drawn: u64,
}

/// Ends of a register's range.
fn range(fixed: Fixed) -> (i64, i64) {
    (i64::MIN >> (64 - fixed.width), i64::MAX >> (64 - fixed.width))
}

impl<W: Complete> CornerCases<W> {
    /// A source of random words.
    pub fn new(world: W, seed: u64) -> Self {
        Self { world, seed, drawn: 0 }
    }

    fn bits(&mut self) -> u64 {
        self.drawn += 1;
        hash(self.seed, self.drawn)
    }

    fn below(&mut self, end: u64) -> u64 {
        self.bits() % end.max(1)
    }

    /// A number within an inclusive range, anywhere in it.
    fn within(&mut self, from: i64, to: i64) -> i64 {
        let span = (i128::from(to) - i128::from(from) + 1).max(1) as u128;
        (i128::from(from) + (u128::from(self.bits()) % span) as i128) as i64
    }

    /// A number within an inclusive range: anywhere, near its ends, near zero or near a power of
    /// two.
    fn number(&mut self, from: i64, to: i64) -> i64 {
        let by = self.within(-2, 2);
        let near = match self.below(8) {
            0 => from.saturating_add(self.within(0, 2)),
            1 => to.saturating_sub(self.within(0, 2)),
            2 => by,
            3 | 4 => {
                let places = self.below(63);
                let power = (1_i64 << places).saturating_add(by);
                if self.bits() & 1 == 0 { power } else { -power }
            }
            5 => {
                // As many leading bits as sign as may be.
                let places = self.below(63);
                self.within(from, to) >> places
            }
            _ => self.within(from, to),
        };
        near.clamp(from, to)
    }

    fn fixed(&self, register: Register) -> Fixed {
        // Worlds without bits are refused before anything is written.
        self.world.fixed(register).unwrap_or(Fixed { width: 32, point: 0 })
    }

    fn view(&mut self, register: Register, positive: bool) -> W::View {
        let (low, high) = range(self.fixed(register));
        let bits = self.number(if positive { 1 } else { low }, high);
        let format = self.world.view(register);
        W::View::load_raw(bits, format).unwrap_or(W::View::zero(format))
    }

    fn ground(&self, register: Register, bits: i64) -> W::Ground {
        let (low, high) = range(self.fixed(register));
        let format = self.world.ground(register);
        W::Ground::load_raw(bits.clamp(low, high), format).unwrap_or(W::Ground::zero(format))
    }

    fn height(&self, register: Register, bits: i64) -> W::Height {
        let format = self.world.height(register);
        W::Height::load_raw(bits, format).unwrap_or(W::Height::zero(format))
    }

    /// Wires of this many pixels.
    fn idle(&self, pixels: u32) -> Line<W> {
        Line::new(&self.world, 0..pixels)
    }

    /// A projector of the same build with other coefficients.
    pub fn projector(&mut self, unit: &Projector<W>) -> Projector<W> {
        let mut other = unit.clone();
        for (register, _) in unit.accumulators() {
            let start = self.view(register, false);
            let per_line = self.view(register, false);
            let per_column = self.view(register, false);
            let linear = Linear { start, per_line, per_column };
            match register {
                Register::ViewX => other.x = linear,
                Register::ViewY => other.y = Some(linear),
                Register::ViewZ => other.z = linear,
                _ => other.denominator = Some(linear),
            }
        }
        other
    }

    /// Inputs of a unit of a surface.
    pub fn line(&mut self, units: &SurfaceUnits<W>, unit: &Description, pixels: u32) -> Line<W> {
        let divider = units.divider.as_ref();
        match (&units.back, unit.name, divider) {
            (_, "divider", Some(unit)) => self.divider(unit, pixels),
            (Back::Terrain(units), "stepper", _) => self.stepper(units, divider, pixels),
            (Back::Terrain(units), "interpolator", _) => self.interpolator(units, pixels),
            (Back::Terrain(units), "light" | "ramp", _) => self.surface(units, pixels),
            (_, "mixer" | "pixel", _) => self.colors(pixels),
            (Back::Plane(checker), "checker", _) => self.checker(checker, divider, pixels),
            _ => unreachable!("corner cases of {} stand here", unit.name),
        }
    }

    /// Inputs of the divider: any numerators, any denominators, quotients at the ends of the
    /// range.
    fn divider(&mut self, unit: &Divider<W>, pixels: u32) -> Line<W> {
        let mut line = self.idle(pixels);
        for at in 0..line.len() {
            let positive = self.below(8) > 0;
            line.denominator[at] = self.view(Register::Denominator, positive);
            line.view_x[at] = self.view(Register::ViewX, false);
            line.view_z[at] = self.view(Register::ViewZ, false);
            if positive && self.below(3) == 0 {
                let (shift, bits) = (unit.shifts[0], unit.bits[0] - 1);
                if let Some(x) = self.at_the_end(line.denominator[at], shift, bits) {
                    line.view_x[at] = x;
                }
            }
        }
        line
    }

    /// A numerator whose quotient is about ±2^bits, if the register holds it.
    fn at_the_end(&mut self, denominator: W::View, shift: i32, bits: u32) -> Option<W::View> {
        let denominator = i128::from(denominator.raw()?);
        let places = bits as i32 - shift;
        let end = if places >= 0 {
            denominator.checked_shl(places as u32).filter(|end| end >> places == denominator)?
        } else {
            denominator >> (-places).min(126)
        };
        let end = if self.bits() & 1 == 0 { end } else { -end };
        let bits = i64::try_from(end + i128::from(self.within(-2, 2))).ok()?;
        W::View::load_raw(bits, self.world.view(Register::ViewX))
    }

    /// A coordinate on or near a map of this many nodes: within a cell, on its rim, on its middle.
    fn coordinate(&mut self, nodes: i32, register: Register) -> i64 {
        let point = self.fixed(register).point;
        let (one, half) = (1_i64 << point, (1_i64 << point) >> 1);
        let nodes = i64::from(nodes);
        let cell = match self.below(4) {
            0 => self.within(-1, 1),
            1 => self.within(nodes - 3, nodes),
            _ => self.within(0, nodes - 1),
        };
        let fraction = match self.below(6) {
            0 => 0,
            1 => one - 1,
            2 => (half + self.within(-1, 1)).clamp(0, one - 1),
            3 => self.within(0, 1).min(one - 1),
            _ => self.within(0, one - 1),
        };
        (cell << point) + fraction
    }

    /// A view vector, never zero: mostly falling, of any length, along an axis or not.
    fn ray(&mut self) -> (W::View, W::View, W::View) {
        let registers = [Register::ViewX, Register::ViewY, Register::ViewZ];
        let any = self.below(3) == 0;
        let places = self.below(u64::from(self.fixed(Register::ViewX).width) - 8);
        let mut words = registers.map(|register| {
            let (low, high) = range(self.fixed(register));
            let word = if any { self.number(low, high) } else { self.within(low, high) >> places };
            if register == Register::ViewY && self.below(8) > 0 {
                -word.saturating_abs().min(high)
            } else {
                word
            }
        });
        if self.below(4) == 0 {
            words[self.below(3) as usize] = 0;
        }
        if words == [0; 3] {
            words[0] = 1;
        }
        let word = |at: usize| {
            let format = self.world.view(registers[at]);
            W::View::load_raw(words[at], format).unwrap_or(W::View::zero(format))
        };
        (word(0), word(1), word(2))
    }

    /// Inputs of the stepper: rays of any direction, from places on and around the map that a
    /// divider of this range can give.
    fn stepper(
        &mut self,
        units: &TerrainUnits<W>,
        divider: Option<&Divider<W>>,
        pixels: u32,
    ) -> Line<W> {
        let mut line = self.idle(pixels);
        let range = divider.map_or(0, |divider| divider.ratio_x.range);
        let heights = &*units.interpolator.heights;
        let axes = [
            (Register::GroundX, units.stepper.eye_x, heights.columns()),
            (Register::GroundZ, units.stepper.eye_z, heights.rows()),
        ];
        for at in 0..line.len() {
            (line.view_x[at], line.view_y[at], line.view_z[at]) = self.ray();
            line.entry[at] = match self.below(16) {
                0 if !units.stepper.from_eye => Entry::Sky,
                1 if !units.stepper.from_eye => Entry::OutOfRange,
                _ => Entry::Met,
            };
            let [x, z] = axes.map(|(register, eye, nodes)| {
                let reach = 1_i64 << (range + self.fixed(register).point).min(62);
                let eye = eye.raw().unwrap_or_default();
                let place = match self.below(4) {
                    // Beside the map, from where rays come to its sides.
                    0 => self.within(-16, 16 + i64::from(nodes)) << self.fixed(register).point,
                    _ => self.coordinate(nodes, register),
                };
                let away = place.saturating_sub(eye);
                let away = if (-reach..reach).contains(&away) {
                    away
                } else {
                    self.within(-reach, reach - 1)
                };
                self.ground(register, eye.saturating_add(away))
            });
            (line.entry_x[at], line.entry_z[at]) = (x, z);
        }
        line
    }

    /// Inputs of the interpolator: places where the surface exists.
    fn interpolator(&mut self, units: &TerrainUnits<W>, pixels: u32) -> Line<W> {
        let mut line = self.idle(pixels);
        let unit = &units.interpolator;
        for at in 0..line.len() {
            // A map may be made of holes: then there is no such place, and the pixel is sky.
            for _ in 0..64 {
                let x = self.coordinate(unit.heights.columns(), Register::GroundX);
                let z = self.coordinate(unit.heights.rows(), Register::GroundZ);
                let x = self.ground(Register::GroundX, x);
                let z = self.ground(Register::GroundZ, z);
                if unit.contains(x, z, Site::pixel(line.number, line.column[at])) {
                    (line.ground_x[at], line.ground_z[at]) = (x, z);
                    line.hit[at] = if self.below(8) == 0 { Hit::Side } else { Hit::Surface };
                    break;
                }
            }
        }
        line
    }

    /// The highest node as a height of the interpolator.
    fn highest(&self, units: &TerrainUnits<W>) -> i64 {
        let (from, to) = (self.fixed(Register::RayY), self.fixed(Register::Surface));
        let top = i128::from(units.stepper.top.raw().unwrap_or_default());
        let top = if to.point > from.point {
            top << (to.point - from.point)
        } else {
            top >> (from.point - to.point)
        };
        top.clamp(0, range(to).1.into()) as i64
    }

    /// An outcome, mostly a surface.
    fn hit(&mut self) -> Hit {
        match self.below(16) {
            0 => Hit::Sky,
            1 => Hit::Side,
            2 => Hit::OutOfRange,
            _ => Hit::Surface,
        }
    }

    /// Inputs of light and ramp: any slopes, heights from the lowest to the highest node.
    fn surface(&mut self, units: &TerrainUnits<W>, pixels: u32) -> Line<W> {
        let mut line = self.idle(pixels);
        let highest = self.highest(units);
        for at in 0..line.len() {
            line.hit[at] = self.hit();
            let height = self.number(0, highest);
            line.surface[at] = self.height(Register::Surface, height);
            let (low, high) = range(self.fixed(Register::SlopeX));
            let (x, z) = (self.number(low, high), self.number(low, high));
            line.slope_x[at] = self.height(Register::SlopeX, x);
            line.slope_z[at] = self.height(Register::SlopeZ, z);
        }
        line
    }

    /// Inputs of the mixer and of the pixel: any colours, often a byte or half a level from one,
    /// under any shade, often none or full.
    fn colors(&mut self, pixels: u32) -> Line<W> {
        let mut line = self.idle(pixels);
        for at in 0..line.len() {
            line.hit[at] = self.hit();
            line.albedo[at] = std::array::from_fn(|_| self.tone(Register::Channel, 255));
            line.lit[at] = std::array::from_fn(|_| self.tone(Register::Channel, 255));
            line.shade[at] = self.tone(Register::Shade, 1);
        }
        line
    }

    /// A tone from zero to a whole number: anywhere, at the ends, at a multiple of a half or a bit
    /// beside it.
    fn tone(&mut self, register: Register, whole: i64) -> W::Tone {
        let fixed = self.fixed(register);
        let one = 1_i64 << fixed.point;
        let most = whole.saturating_mul(one).min(range(fixed).1);
        let bits = match self.below(4) {
            0 => self.number(0, most),
            1 => (one / 2).saturating_mul(self.within(0, 2 * whole)) + self.within(-1, 1),
            2 => most,
            _ => self.within(0, most),
        };
        let bits = bits.clamp(0, most);
        let format = self.world.tone(register);
        W::Tone::load_raw(bits, format).unwrap_or(W::Tone::zero(format))
    }

    /// Inputs of the checker: any place that the divider can give, any denominator that
    /// goes with it, often one where squares fade.
    fn checker(&mut self, unit: &Checker<W>, divider: Option<&Divider<W>>, pixels: u32) -> Line<W> {
        let mut line = self.idle(pixels);
        let range = divider.map_or(0, |divider| divider.ratio_x.range);
        let eyes = divider.and_then(|divider| Some([divider.eye_x.raw()?, divider.eye_z.raw()?]));
        let [eye_x, eye_z] = eyes.unwrap_or_default();
        for at in 0..line.len() {
            line.entry[at] = match self.below(8) {
                0 => Entry::Sky,
                1 => Entry::OutOfRange,
                _ => Entry::Met,
            };
            line.denominator[at] = self.view(Register::Denominator, true);
            if let (Some(full), true) = (unit.full_from.and_then(Readout::raw), self.below(2) == 0)
            {
                let fading = self.within(full / 4, full).max(1);
                let format = self.world.view(Register::Denominator);
                if let Some(word) = W::View::load_raw(fading, format) {
                    line.denominator[at] = word;
                }
            }
            if line.entry[at] == Entry::Sky {
                line.denominator[at] = -line.denominator[at];
            }
            let mut place = |register, eye: i64| {
                let reach = 1_i64 << (range + self.fixed(register).point).min(62);
                let away = self.number(-reach, reach - 1);
                self.ground(register, eye.saturating_add(away))
            };
            line.entry_x[at] = place(Register::GroundX, eye_x);
            line.entry_z[at] = place(Register::GroundZ, eye_z);
        }
        line
    }
}
