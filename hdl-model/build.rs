//! Makes C++ models of the RTL with Verilator and links them, behind the thin shim in `shim/`.
//!
//! Sets `cfg(rtl)` where Verilator and a C++ compiler are there. Without them the package builds
//! too, and everything that needs a model says that it is left out; with `REQUIRE_RTL=1` the build
//! fails instead. `SKIP_RTL=1` makes no models although Verilator is there: for `generate`, while
//! the generated files do not fit the others.

use std::collections::hash_map::DefaultHasher;
use std::env;
use std::fmt::Write as _;
use std::fs;
use std::hash::{Hash as _, Hasher as _};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;

/// A module of `rtl/` with the parameters that a model of it is made with.
struct Model {
    /// Name in [`terraline_hdl::Model::new`].
    name: &'static str,
    /// Module.
    top: &'static str,
    /// Parameters, `NAME=value`.
    parameters: &'static [&'static str],
}

impl Model {
    /// Whether it can write a trace: only whole machines can.
    fn traces(&self) -> bool {
        self.top == "terraline"
    }
}

const fn model(
    name: &'static str,
    top: &'static str,
    parameters: &'static [&'static str],
) -> Model {
    Model { name, top, parameters }
}

/// Memory latency and kernel table of the machines: the largest that scenes may ask for.
const LATENCY: &str = "OUTSTANDING=64";
const TABLE: &str = "TABLE_LOG2=16";

/// Every model that tests and commands use.
const MODELS: &[Model] = &[
    model("queue_1", "queue", &["WIDTH=16", "DEPTH=1"]),
    model("queue_5", "queue", &["WIDTH=16", "DEPTH=5"]),
    model("projector_narrow", "projector", &["WIDE=0"]),
    model("projector_wide", "projector", &["WIDE=1"]),
    model("divider_narrow", "divider", &["WIDE=0"]),
    model("divider_wide", "divider", &["WIDE=1"]),
    model("divider_serial_narrow", "divider", &["WIDE=0", "SERIAL=1"]),
    model("divider_serial_wide", "divider", &["WIDE=1", "SERIAL=1"]),
    model("light_narrow", "light", &["WIDE=0"]),
    model("light_wide", "light", &["WIDE=1"]),
    model("ramp_narrow", "ramp", &["WIDE=0"]),
    model("ramp_wide", "ramp", &["WIDE=1"]),
    model("shader_narrow", "shader", &["WIDE=0", "TAG=16"]),
    model("shader_wide", "shader", &["WIDE=1", "TAG=16"]),
    model("checkers_narrow", "checkers", &["WIDE=0", "TAG=16"]),
    model("checkers_wide", "checkers", &["WIDE=1", "TAG=16"]),
    model("plane_narrow", "terraline", &["WIDE=0", "TERRAIN=0"]),
    model("plane_wide", "terraline", &["WIDE=1", "TERRAIN=0"]),
    model("plane_narrow_serial", "terraline", &["WIDE=0", "TERRAIN=0", "SERIAL=1"]),
    model("plane_wide_serial", "terraline", &["WIDE=1", "TERRAIN=0", "SERIAL=1"]),
    model("terrain_narrow", "terraline", &["WIDE=0", LATENCY, TABLE]),
    model("terrain_wide", "terraline", &["WIDE=1", LATENCY, TABLE]),
    model("terrain_narrow_3x3", "terraline", &["WIDE=0", "STRETCH=1", LATENCY, TABLE]),
    model("terrain_wide_3x3", "terraline", &["WIDE=1", "STRETCH=1", LATENCY, TABLE]),
    model("terrain_narrow_serial", "terraline", &["WIDE=0", "SERIAL=1", LATENCY, TABLE]),
    model("product_5_5", "product", &["A=5", "B=5"]),
    model("product_5_6", "product", &["A=5", "B=6", "SIGNED=0"]),
    model("product_32_21", "product", &["A=32", "B=21", "SIGNED=0"]),
    model("product_32_23", "product", &["A=32", "B=23"]),
    model("product_64_25", "product", &["A=64", "B=25", "SIGNED=0"]),
    model("product_64_64", "product", &["A=64", "B=64"]),
    model(
        "interpolator_narrow_cell_height",
        "interpolator",
        &["WIDE=0", "STRETCH=0", "SLOPES=0", "TAG=7", "TABLE_LOG2=16", "OUTSTANDING=5"],
    ),
    model(
        "interpolator_narrow_cell_slopes",
        "interpolator",
        &["WIDE=0", "STRETCH=0", "SLOPES=1", "TAG=7", "TABLE_LOG2=16", "OUTSTANDING=5"],
    ),
    model(
        "interpolator_narrow_stretch_height",
        "interpolator",
        &["WIDE=0", "STRETCH=1", "SLOPES=0", "TAG=7", "TABLE_LOG2=16", "OUTSTANDING=5"],
    ),
    model(
        "interpolator_narrow_stretch_slopes",
        "interpolator",
        &["WIDE=0", "STRETCH=1", "SLOPES=1", "TAG=7", "TABLE_LOG2=16", "OUTSTANDING=5"],
    ),
    model(
        "interpolator_wide_cell_height",
        "interpolator",
        &["WIDE=1", "STRETCH=0", "SLOPES=0", "TAG=7", "TABLE_LOG2=16", "OUTSTANDING=5"],
    ),
    model(
        "interpolator_wide_cell_slopes",
        "interpolator",
        &["WIDE=1", "STRETCH=0", "SLOPES=1", "TAG=7", "TABLE_LOG2=16", "OUTSTANDING=5"],
    ),
    model(
        "interpolator_wide_stretch_height",
        "interpolator",
        &["WIDE=1", "STRETCH=1", "SLOPES=0", "TAG=7", "TABLE_LOG2=16", "OUTSTANDING=5"],
    ),
    model(
        "interpolator_wide_stretch_slopes",
        "interpolator",
        &["WIDE=1", "STRETCH=1", "SLOPES=1", "TAG=7", "TABLE_LOG2=16", "OUTSTANDING=5"],
    ),
];

fn main() {
    println!("cargo::rerun-if-changed=rtl");
    println!("cargo::rerun-if-changed=shim");
    println!("cargo::rerun-if-env-changed=REQUIRE_RTL");
    println!("cargo::rerun-if-env-changed=SKIP_RTL");
    println!("cargo::rerun-if-env-changed=PATH");
    let is_set = |name| env::var(name).is_ok_and(|value| value == "1");
    let required = is_set("REQUIRE_RTL");
    let include = if is_set("SKIP_RTL") { Err("SKIP_RTL=1".into()) } else { include_folder() };
    match include {
        Ok(include) => {
            build(&include);
            println!("cargo::rustc-cfg=rtl");
        }
        Err(why) if required => panic!("REQUIRE_RTL=1, but {why}"),
        Err(why) => {
            println!("cargo::warning=no models of the RTL: {why}; its tests will be skipped");
            println!("cargo::rustc-env=RTL_MISSING={why}");
        }
    }
}

/// Where Verilator's own sources are.
fn include_folder() -> Result<PathBuf, String> {
    let out = Command::new("verilator")
        .args(["--getenv", "VERILATOR_ROOT"])
        .output()
        .map_err(|error| format!("verilator cannot be run ({error}); install it"))?;
    let root = String::from_utf8_lossy(&out.stdout).trim().to_owned();
    let include = Path::new(&root).join("include");
    if include.join("verilated.cpp").is_file() {
        Ok(include)
    } else {
        Err(format!("verilator has no sources under {}", include.display()))
    }
}

/// Makes the models, or takes those that an earlier build made of the same sources: tests, commands
/// and lints build the package in several ways, and all models together take a minute or more.
fn build(include: &Path) {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    // OUT_DIR is target/PROFILE/build/PACKAGE/out.
    let profile = out.ancestors().nth(3).expect("cargo nests OUT_DIR");
    let kept = profile.join("rtl");
    fs::create_dir_all(&kept).expect("the build folder is writable");
    let version = Command::new("verilator").arg("--version").output();
    let version = version.expect("verilator was found a moment ago").stdout;
    let print = |parts: &[&[u8]]| {
        let mut hasher = DefaultHasher::new();
        let target = env::var("TARGET").expect("cargo sets TARGET");
        for file in ["build.rs", "rtl/waivers.vlt", "shim/model.hpp", "shim/model.cpp"] {
            read(file).hash(&mut hasher);
        }
        (parts, &version, target).hash(&mut hasher);
        format!("{:016x}", hasher.finish())
    };
    let link = |folder: &Path, library: &str| {
        println!("cargo::rustc-link-search=native={}", folder.display());
        println!("cargo::rustc-link-lib=static={library}");
    };
    let made = |model: &Model| {
        let sources = sources(model.top);
        let texts: Vec<Vec<u8>> = sources.iter().map(read).collect();
        let mut parts: Vec<&[u8]> = texts.iter().map(Vec::as_slice).collect();
        let parameters = model.parameters.join(" ");
        parts.push(parameters.as_bytes());
        let folder = kept.join(format!("{}-{}", model.name, print(&parts)));
        keep(&folder, &out.join(model.name), |making| make(model, &sources, include, making));
        folder
    };
    // As many at a time as there are processors; the list ends with the largest ones, which begin.
    let next = AtomicUsize::new(0);
    let folders = Mutex::new(vec![PathBuf::new(); MODELS.len()]);
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(at) = MODELS.len().checked_sub(1 + next.fetch_add(1, Relaxed)) {
                    let folder = made(&MODELS[at]);
                    folders.lock().expect("no other thread fails")[at] = folder;
                }
            });
        }
    });
    let folders = folders.into_inner().expect("no thread failed");
    let mut table = String::from("#include \"model.hpp\"\n");
    let mut rows = String::new();
    let mut libraries = Vec::new();
    for (model, folder) in MODELS.iter().zip(folders) {
        libraries.push((folder, format!("rtl_{}", model.name)));
        let _ = writeln!(table, "Model *make_{}();", model.name);
        let _ = writeln!(rows, "    {{\"{}\", make_{}}},", model.name, model.name);
    }
    let _ = write!(table, "const Row rows[] = {{\n{rows}    {{nullptr, nullptr}},\n}};\n");
    let folder = kept.join(format!("shim-{}", print(&[table.as_bytes()])));
    keep(&folder, &out.join("shim"), |making| {
        let rows = making.join("models.cpp");
        fs::write(&rows, &table).expect("the build folder is writable");
        let mut cpp = compiler(include, making, 1);
        for runtime in ["verilated.cpp", "verilated_threads.cpp", "verilated_fst_c.cpp"] {
            cpp.file(include.join(runtime));
        }
        cpp.file(rows).file("shim/model.cpp").compile("rtl_shim");
    });
    // A library is asked for what is missing so far: the shim for models, models for the runtime.
    link(&folder, "rtl_shim");
    for (folder, library) in &libraries {
        link(folder, library);
    }
    for library in ["static=rtl_shim", "stdc++", "z"] {
        println!("cargo::rustc-link-lib={library}");
    }
}

fn read(file: impl AsRef<Path>) -> Vec<u8> {
    let file = file.as_ref();
    fs::read(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// A module's file, and those of all modules that are named in it; the package first.
fn sources(top: &str) -> Vec<PathBuf> {
    let file = |module: &str| Path::new("rtl").join(module).with_extension("sv");
    let mut found = vec!["terraline_pkg".to_owned(), top.to_owned()];
    let mut at = 1;
    while at < found.len() {
        let text = String::from_utf8(read(file(&found[at]))).expect("sources are UTF-8");
        for word in text.split(|c: char| !c.is_alphanumeric() && c != '_') {
            if !found.iter().any(|known| known == word) && file(word).is_file() {
                found.push(word.to_owned());
            }
        }
        at += 1;
    }
    found[1..].sort();
    found.iter().map(|module| file(module)).collect()
}

/// Makes a folder unless it exists.
fn keep(folder: &Path, making: &Path, make: impl FnOnce(&Path)) {
    if folder.is_dir() {
        return;
    }
    let _ = fs::remove_dir_all(making);
    fs::create_dir_all(making).expect("OUT_DIR is writable");
    make(making);
    // Whoever is second finds the same there.
    if fs::rename(making, folder).is_err() {
        assert!(folder.is_dir(), "{} cannot be made", folder.display());
    }
}

fn compiler(include: &Path, out: &Path, level: u32) -> cc::Build {
    let mut cpp = cc::Build::new();
    cpp.cpp(true).std("c++17").include(include).include("shim").warnings(false).debug(false);
    cpp.opt_level(level).out_dir(out).cargo_metadata(false);
    cpp
}

/// Makes the library of one model.
fn make(model: &Model, sources: &[PathBuf], include: &Path, out: &Path) {
    let folder = out.join("cpp");
    verilate(model, sources, &folder);
    let prefix = format!("V{}", model.name);
    // What runs in every cycle, and what runs once; one file each, as most of the time goes into
    // Verilator's headers.
    let (mut fast, mut slow) = (String::new(), String::new());
    for entry in fs::read_dir(&folder).expect("verilator made the folder") {
        let name = entry.expect("a readable folder").file_name();
        let name = name.to_string_lossy();
        if name.ends_with(".cpp") {
            let runs_once = name.contains("Slow") || name.contains("Trace");
            let file = if runs_once { &mut slow } else { &mut fast };
            let _ = writeln!(file, "#include \"{name}\"");
        }
    }
    let header = fs::read_to_string(folder.join(format!("{prefix}.h")))
        .expect("verilator made the model's header");
    slow.push_str(&ports(model, &prefix, &header));
    let mut objects = Vec::new();
    for (level, kind, text) in [(1, "fast", fast), (0, "slow", slow)] {
        let file = out.join(format!("{}_{kind}.cpp", model.name));
        fs::write(&file, text).expect("OUT_DIR is writable");
        let mut cpp = compiler(include, out, level);
        objects.extend(cpp.include(&folder).file(file).compile_intermediates());
    }
    let mut library = compiler(include, out, 1);
    library.objects(objects).compile(&format!("rtl_{}", model.name));
}

fn verilate(model: &Model, sources: &[PathBuf], folder: &Path) {
    let mut command = Command::new("verilator");
    command
        .args(["--cc", "-Wall", "-O3", "--x-assign", "fast", "--output-split", "0"])
        .args(["--top-module", model.top, "--prefix", &format!("V{}", model.name), "--Mdir"])
        .arg(folder)
        .arg("rtl/waivers.vlt")
        .args(sources);
    if model.traces() {
        command.arg("--trace-fst");
    }
    for parameter in model.parameters {
        command.arg(format!("-G{parameter}"));
    }
    let done = command.output().expect("verilator was found a moment ago");
    if !done.status.success() {
        panic!("verilator refuses {}:\n{}", model.top, String::from_utf8_lossy(&done.stderr));
    }
}

/// The list of a model's ports, from the declarations in its header: `VL_IN8(&clock,0,0);`.
fn ports(model: &Model, prefix: &str, header: &str) -> String {
    let (name, traces) = (model.name, model.traces());
    let mut out = format!(
        "#include \"{prefix}.h\"\n#include \"model.hpp\"\n\n\
         Model *make_{name}() {{\n    auto *made = new Made<{prefix}, {traces}>();\n    \
         auto &m = made->rtl;\n"
    );
    for line in header.lines() {
        let Some((kind, rest)) = line.trim().split_once("(&") else { continue };
        let input = match kind.strip_prefix("VL_") {
            Some(kind) if kind.starts_with("IN") && !kind.starts_with("INOUT") => true,
            Some(kind) if kind.starts_with("OUT") => false,
            _ => continue,
        };
        let mut fields = rest.trim_end_matches(");").split(',');
        let (Some(port), Some(high), Some(low)) = (fields.next(), fields.next(), fields.next())
        else {
            panic!("a port declaration that is not understood: {line}");
        };
        let bit = |text: &str| text.parse::<u32>().expect("a bit number in a port declaration");
        let width = bit(high) - bit(low) + 1;
        let _ = writeln!(out, "    made->add(\"{port}\", {input}, {width}, &m.{port});");
    }
    out.push_str("    return made;\n}\n");
    out
}
