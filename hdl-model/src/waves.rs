//! A save file for GTKWave: the signals between the units, under their names, with their binary
//! points.

use std::fmt::Write as _;
use std::path::Path;

use terraline::setup::Setup;
use terraline::unit::Wire;
use terraline::word::{Complete, Register};

use crate::rtl::{Rtl, STAGES, port_name};

/// Flags of GTKWave: right-justified hexadecimal, the same as signed decimal, and with a shift for
/// the binary point.
const HEXADECIMAL: u64 = 0x22;
const DECIMAL: u64 = 0x24;
const SIGNED: u64 = 0x420;
const FIXED_POINT: u64 = 1 << 30;
/// A comment line between groups.
const BLANK: u64 = 0x200;

/// The save file beside a trace.
pub fn gtkw<W: Complete>(trace: &Path, setup: &Setup<W>, rtl: &Rtl<'_, W>) -> String {
    let point = |register| setup.world.fixed(register).map(|fixed| fixed.point);
    let width = setup.world.fixed(Register::ViewX).map_or(0, |fixed| fixed.width);
    let terrain = setup.surfaces[0].back.terrain().is_some();
    let name = trace.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
    let mut out = Waves(format!("[dumpfile] \"{name}\"\n"));
    out.group("clock, stages that take an item, stages before which one waits");
    out.signal("clock", 1, HEXADECIMAL, None);
    out.signal("takes", 6, HEXADECIMAL, None);
    out.signal("waits", 6, HEXADECIMAL, None);
    for (at, stage) in STAGES.into_iter().enumerate() {
        let wires: Vec<Wire> = rtl.shown(at).collect();
        if !wires.is_empty() {
            out.group(&format!("from the {stage}"));
        }
        for wire in wires {
            let name = port_name(stage, wire);
            match wire {
                Wire::Steps => out.signal(&name, 26, DECIMAL, None),
                Wire::Color => out.signal(&name, 24, HEXADECIMAL, None),
                Wire::Entry | Wire::Hit => out.signal(&name, 2, DECIMAL, None),
                _ => {
                    let point = wire.register().and_then(point);
                    out.signal(&name, width, SIGNED | FIXED_POINT, point);
                }
            }
        }
    }
    if terrain {
        out.group("memory of the pyramid");
        out.signal("bound_read", 1, HEXADECIMAL, None);
        out.signal("bound_level", 5, DECIMAL, None);
        out.signal("bound_valid", 1, HEXADECIMAL, None);
        out.signal("bound", width, SIGNED | FIXED_POINT, point(Register::Node));
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
