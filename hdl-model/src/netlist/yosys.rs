//! Yosys, run on sources in SystemVerilog.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

/// What a netlist is mapped to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Lattice iCE40.
    Ice40,
    /// Lattice ECP5.
    Ecp5,
}

impl Target {
    /// Both, the smaller family first.
    pub const ALL: [Self; 2] = [Self::Ice40, Self::Ecp5];

    /// Name of the family, as its maker spells it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ice40 => "iCE40",
            Self::Ecp5 => "ECP5",
        }
    }

    /// The synthesis command. Both may use the device's multipliers: a multiplication in the
    /// sources would take one.
    pub fn synthesis(self) -> &'static str {
        match self {
            Self::Ice40 => "synth_ice40 -dsp",
            Self::Ecp5 => "synth_ecp5",
        }
    }
}

/// Cells of a netlist by type, all its modules together.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    /// Number of cells of each type.
    pub count: BTreeMap<String, u64>,
    /// Modules of the sources that it is made of, without their parameters.
    pub modules: BTreeSet<String>,
}

impl Cells {
    /// Cells of some types together.
    pub fn of(&self, types: &[&str]) -> u64 {
        types.iter().filter_map(|name| self.count.get(*name)).sum()
    }

    /// Cells of types whose name begins so.
    pub fn beginning(&self, prefix: &str) -> u64 {
        self.count.iter().filter(|(name, _)| name.starts_with(prefix)).map(|(_, n)| n).sum()
    }
}

/// Why Yosys cannot be run; `None` where it can.
pub fn missing() -> Option<String> {
    version("yosys", "-V").err()
}

/// The first line that a tool says about its version.
///
/// # Errors
/// If it cannot be run.
pub fn version(tool: &str, option: &str) -> Result<String, String> {
    let out = Command::new(tool)
        .arg(option)
        .stdin(Stdio::null())
        .output()
        .map_err(|error| format!("{tool} cannot be run ({error}); install it"))?;
    // nextpnr says its version on standard error.
    let text = [out.stdout, out.stderr].concat();
    let text = String::from_utf8_lossy(&text);
    Ok(text.lines().next().unwrap_or_default().trim().to_owned())
}

/// All sources of `rtl/`, the package first.
///
/// # Errors
/// If the folder cannot be read.
pub fn sources() -> Result<Vec<PathBuf>, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("rtl");
    let unreadable = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut files = Vec::new();
    for entry in std::fs::read_dir(&folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.extension().is_some_and(|extension| extension == "sv") {
            files.push(path);
        }
    }
    files.sort_by_key(|path| (!path.ends_with("terraline_pkg.sv"), path.clone()));
    Ok(files)
}

/// A folder for what one run leaves, removed when dropped.
#[derive(Debug)]
pub struct Scratch(tempfile::TempDir);

impl Scratch {
    /// An empty folder.
    ///
    /// # Errors
    /// If there is no room for one.
    pub fn new() -> Result<Self, String> {
        tempfile::tempdir().map(Self).map_err(|error| format!("no temporary folder: {error}"))
    }

    /// A file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The text of a file in it.
    ///
    /// # Errors
    /// If it does not exist.
    pub fn read(&self, name: &str) -> Result<String, String> {
        std::fs::read_to_string(self.file(name)).map_err(|error| format!("{name}: {error}"))
    }

    /// A file in it that a tool wrote as JSON.
    ///
    /// # Errors
    /// If it does not exist or is no JSON.
    pub fn json(&self, name: &str) -> Result<Value, String> {
        serde_json::from_str(&self.read(name)?).map_err(|error| format!("{name}: {error}"))
    }
}

/// Commands that read sources and set a module's parameters.
pub fn read(files: &[PathBuf], top: &str, parameters: &[(&str, u32)]) -> String {
    let mut script = String::from("read_verilog -sv");
    for file in files {
        let _ = write!(script, " \"{}\"", file.display());
    }
    script.push('\n');
    for (name, value) in parameters {
        let _ = writeln!(script, "chparam -set {name} {value} {top}");
    }
    script
}

/// Runs a script in a folder of its own.
///
/// # Errors
/// What Yosys refuses.
pub fn run(script: &str, scratch: &Scratch) -> Result<(), String> {
    let file = scratch.file("script.ys");
    std::fs::write(&file, script).map_err(|error| format!("{}: {error}", file.display()))?;
    let out = Command::new("yosys")
        .args(["-q", "-s", "script.ys"])
        .current_dir(scratch.0.path())
        .stdin(Stdio::null())
        .output()
        .map_err(|error| format!("yosys cannot be run ({error}); install it"))?;
    if out.status.success() {
        Ok(())
    } else {
        Err(format!("yosys refuses: {}", String::from_utf8_lossy(&out.stderr).trim()))
    }
}

/// The cells of a module as the sources have it: before any optimisation.
///
/// # Errors
/// What Yosys refuses.
pub fn elaborated(
    files: &[PathBuf],
    top: &str,
    parameters: &[(&str, u32)],
) -> Result<Cells, String> {
    let scratch = Scratch::new()?;
    let script = read(files, top, parameters)
        + &format!("hierarchy -check -top {top}\nproc\nwrite_json netlist.json\n");
    run(&script, &scratch)?;
    cells(&scratch.json("netlist.json")?)
}

/// The cells of a module on a device.
///
/// # Errors
/// What Yosys refuses.
pub fn mapped(
    files: &[PathBuf],
    top: &str,
    parameters: &[(&str, u32)],
    target: Target,
) -> Result<Cells, String> {
    let scratch = Scratch::new()?;
    let script = read(files, top, parameters)
        + &format!("{} -top {top}\nwrite_json netlist.json\n", target.synthesis());
    run(&script, &scratch)?;
    cells(&scratch.json("netlist.json")?)
}

/// Counts the cells of a netlist that `write_json` wrote. Each module counts once, however often the
/// netlist has it; its instances are no cells of their own.
///
/// # Errors
/// If it is something else.
pub fn cells(netlist: &Value) -> Result<Cells, String> {
    let other = || "yosys: the netlist has no modules".to_owned();
    let modules = netlist["modules"].as_object().ok_or_else(other)?;
    let is_primitive = |module: &Value| !module["attributes"]["blackbox"].is_null();
    let mut cells = Cells::default();
    for (name, module) in modules.iter().filter(|(_, module)| !is_primitive(module)) {
        // What its parameters were, the name says in its own way.
        let plain = module["attributes"]["hdlname"].as_str().unwrap_or(name);
        cells.modules.insert(plain.trim_start_matches('\\').to_owned());
        for cell in module["cells"].as_object().into_iter().flat_map(|cells| cells.values()) {
            let kind = cell["type"].as_str().ok_or_else(other)?;
            if modules.get(kind).is_none_or(is_primitive) {
                *cells.count.entry(kind.to_owned()).or_default() += 1;
            }
        }
    }
    Ok(cells)
}
