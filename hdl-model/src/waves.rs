//! A save file for GTKWave: the signals between the units, under their names, with their binary
//! points.

use std::fmt::Write as _;
use std::path::Path;

use terraline::plan::{Ground, Plan};
use terraline::word::Register;

use crate::machine::{UNITS, wires};

/// Flags of GTKWave: right-justified hexadecimal, the same as signed decimal, and with a shift for
/// the binary point.
const HEXADECIMAL: u64 = 0x22;
const DECIMAL: u64 = 0x24;
const SIGNED: u64 = 0x420;
const FIXED_POINT: u64 = 1 << 30;
/// A comment line between groups.
const BLANK: u64 = 0x200;

/// Bits after the point of a wire between units; `None` where it is no word.
fn point(wire: &str, plan: &Plan) -> Option<u32> {
    let words = plan.words();
    let register = match wire {
        "view_x" | "view_y" | "view_z" | "denominator" => Register::ViewX,
        "entry_x" | "entry_z" | "ground_x" | "ground_z" => Register::GroundX,
        "surface" | "slope_x" | "slope_z" => Register::Surface,
        "bound" => Register::Node,
        _ => return None,
    };
    Some(words.fixed(register).point)
}

/// The save file beside a trace.
pub fn gtkw(trace: &Path, plan: &Plan) -> String {
    let terrain = matches!(plan.ground, Ground::Terrain(_));
    let width = plan.words().width;
    let name = trace.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
    let mut out = Waves(format!("[dumpfile] \"{name}\"\n"));
    out.group("clock, units that take an item, units before which one waits");
    out.signal("clock", 1, HEXADECIMAL, None);
    out.signal("takes", 6, HEXADECIMAL, None);
    out.signal("waits", 6, HEXADECIMAL, None);
    for (unit, title) in UNITS.iter().enumerate().filter(|(unit, _)| !wires(*unit).is_empty()) {
        if !terrain && matches!(*title, "stepper" | "interpolator") {
            continue;
        }
        out.group(&format!("from the {title}"));
        for &wire in wires(unit) {
            match point(wire, plan) {
                Some(point) => out.signal(wire, width, SIGNED | FIXED_POINT, Some(point)),
                None if wire == "steps" => out.signal(wire, 26, DECIMAL, None),
                None if wire == "pixel_color" => out.signal(wire, 24, HEXADECIMAL, None),
                None => out.signal(wire, 2, DECIMAL, None),
            }
        }
    }
    if terrain {
        out.group("memory of the pyramid");
        out.signal("bound_read", 1, HEXADECIMAL, None);
        out.signal("bound_level", 5, DECIMAL, None);
        out.signal("bound_valid", 1, HEXADECIMAL, None);
        out.signal("bound", width, SIGNED | FIXED_POINT, point("bound", plan));
    }
    out.0
}

/// The lines of a save file.
struct Waves(String);

impl Waves {
    fn group(&mut self, title: &str) {
        let _ = write!(self.0, "@{BLANK:x}\n-{title}\n");
    }

    fn signal(&mut self, name: &str, bits: u32, flags: u64, point: Option<u32>) {
        let _ = writeln!(self.0, "@{flags:x}");
        if let Some(point) = point {
            let _ = writeln!(self.0, "[fpshift_count] {point}");
        }
        let range = if bits > 1 { format!("[{}:0]", bits - 1) } else { String::new() };
        let _ = writeln!(self.0, "TOP.terraline.{name}{range}");
    }
}
