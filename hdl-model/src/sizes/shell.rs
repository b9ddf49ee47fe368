//! A shell round a unit, so that it can be placed on a device with fewer pins than it has ports.
//!
//! A long shift register from one pin feeds the inputs; outputs are taken into registers and folded
//! into one pin by another shift register with xor. Inputs that the netlist does not use, outputs
//! that are constant, and the probes of a machine get nothing.

use std::collections::HashSet;
use std::fmt::Write as _;

use serde_json::Value;

/// First of the ports of the top that are probes; all after it are.
const FIRST_PROBE: &str = "takes";

/// The module `shell` round `unit`, from the unit's mapped netlist as `write_json` gives it.
///
/// # Errors
/// If the netlist is something else, or has no clock.
pub fn around(unit: &str, netlist: &Value) -> Result<String, String> {
    let module = &netlist["modules"][unit];
    let ports = module["ports"].as_object().ok_or("yosys: the netlist has no ports")?;
    if !ports.contains_key("clock") {
        return Err(format!("{unit} has no clock"));
    }
    let used = used_nets(module);
    let (mut inputs, mut outputs) = (0, Vec::new());
    let (mut wires, mut connections) = (String::new(), String::new());
    let mut probes = false;
    for (name, port) in ports {
        probes |= name == FIRST_PROBE;
        let bits = port["bits"].as_array().ok_or("yosys: a port has no bits")?;
        if name == "clock" || probes {
            continue;
        }
        if port["direction"] == "input" {
            let mut fed: Vec<String> = Vec::new();
            for bit in bits {
                if bit.as_u64().is_some_and(|net| used.contains(&net)) {
                    fed.push(format!("inputs[{inputs}]"));
                    inputs += 1;
                } else {
                    fed.push("1'b0".into());
                }
            }
            fed.reverse();
            let _ = write!(connections, ",\n      .{name}({{{}}})", fed.join(", "));
        } else {
            let _ = writeln!(wires, "  wire [{}:0] {name};", bits.len().saturating_sub(1));
            let _ = write!(connections, ",\n      .{name}({name})");
            let driven = bits.iter().enumerate().filter(|(_, bit)| bit.is_u64());
            outputs.extend(driven.map(|(index, _)| format!("{name}[{index}]")));
        }
    }
    if inputs == 0 || outputs.is_empty() {
        return Err(format!("{unit} has no inputs or no outputs"));
    }
    Ok(format!(
        "module shell (input wire clock, input wire feed, output wire fold);\n  \
         reg [{input_high}:0] inputs;\n  reg [{output_high}:0] taken, folded;\n{wires}  \
         always @(posedge clock) begin\n    inputs <= {{inputs, feed}};\n    \
         taken <= {{{outputs}}};\n    folded <= (folded >> 1) ^ taken;\n  end\n  \
         assign fold = folded[0];\n  {unit} unit (\n      .clock(clock){connections}\n  );\n\
         endmodule\n",
        input_high = inputs - 1,
        output_high = outputs.len() - 1,
        outputs = outputs.join(", "),
    ))
}

/// Nets that a cell or an output port takes part in.
fn used_nets(module: &Value) -> HashSet<u64> {
    let mut used = HashSet::new();
    let mut add = |bits: &Value| {
        used.extend(bits.as_array().into_iter().flatten().filter_map(Value::as_u64));
    };
    for cell in module["cells"].as_object().into_iter().flat_map(|cells| cells.values()) {
        for bits in cell["connections"].as_object().into_iter().flat_map(|ends| ends.values()) {
            add(bits);
        }
    }
    for port in module["ports"].as_object().into_iter().flat_map(|ports| ports.values()) {
        if port["direction"] == "output" {
            add(&port["bits"]);
        }
    }
    used
}
