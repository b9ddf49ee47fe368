//! Running a proof of `formal/` with Yosys.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A harness of `formal/` with what it needs.
#[derive(Clone, Copy, Debug)]
pub struct Proof<'a> {
    /// Harness: module and stem of its file.
    pub harness: &'a str,
    /// Modules of `rtl/` that it uses.
    pub modules: &'a [&'a str],
    /// Parameters of the top module.
    pub parameters: &'a [(&'a str, i64)],
    /// Module that the harness is bound into, where it is not the top module itself.
    pub bound: Option<&'a str>,
    /// Over how many cycles a case may be reached; none where there are no registers, 1 where the
    /// assertions are about one cycle, with registers of any content.
    pub cycles: Option<u32>,
}

/// A change of the RTL that makes a proof fail: module, text that occurs once, its replacement.
pub type Twin<'a> = (&'a str, &'a str, &'a str);

/// Runs a script of Yosys in the package's folder.
pub fn yosys(script: &str) -> (bool, String) {
    let done = Command::new("yosys")
        .args(["-p", script])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("yosys was found a moment ago");
    let text = String::from_utf8_lossy(&done.stdout) + String::from_utf8_lossy(&done.stderr);
    (done.status.success(), text.into_owned())
}

impl Proof<'_> {
    /// Shows that the assertions always hold, that there are `assertions` of them, and that under the
    /// assumptions each of `covers` may be one.
    pub fn holds(&self, assertions: usize, covers: &[&str]) {
        let proof = self.induction();
        let cover = self.cycles.map_or(String::new(), |cycles| format!(" -seq {cycles}"));
        let mut script = self.script(None);
        script += &format!("sat -set-assumes -show-ports -prove-asserts -verify{proof}\n");
        for port in covers {
            let port = self.bound.map_or(port.to_string(), |_| format!("properties.{port}"));
            script += &format!("sat -set-assumes -show-ports -prove {port} 0 -falsify{cover}\n");
        }
        let (done, text) = self.run(&script, "holds");
        assert!(done, "{self:?} does not hold, or a case is not possible:\n{}", tail(&text));
        let steps = if self.cycles > Some(1) { 2 } else { 1 };
        let found = text.matches("Import proof for assert:").count();
        assert!(found >= assertions * steps, "{self:?}: {found} assertions in {steps} steps");
    }

    /// Shows that the assertions fail where the RTL is changed.
    pub fn fails_with(&self, twin: Twin) {
        let script = self.script(Some(twin));
        let proof = self.induction();
        let script = format!("{script}sat -set-assumes -prove-asserts -falsify{proof}\n");
        let (done, text) = self.run(&script, "twin");
        assert!(done, "{self:?} holds with {twin:?} too, or is no proof:\n{}", tail(&text));
    }

    /// How assertions are proved: by induction over the cycles where there are several.
    fn induction(&self) -> &'static str {
        match self.cycles {
            None => "",
            Some(1) => " -seq 1",
            Some(_) => " -tempinduct -seq 1 -maxsteps 2",
        }
    }

    /// Reads and elaborates.
    fn script(&self, twin: Option<Twin>) -> String {
        let mut script = String::from("read_verilog -sv -formal");
        for module in self.modules {
            script += &format!(" {}", self.source(module, twin).display());
        }
        script += &format!(" formal/{}.sv\nhierarchy", self.harness);
        script += &format!(" -check -top {}", self.bound.unwrap_or(self.harness));
        // Those of a bound harness are in its instance.
        for (name, value) in self.parameters.iter().filter(|_| self.bound.is_none()) {
            script += &format!(" -chparam {name} {value}");
        }
        script + "\nproc\nflatten\nmemory -nomap\nmemory_map\nopt -full\n"
    }

    /// A module's file: its own, or a copy with the twin's change and the properties bound into it.
    fn source(&self, module: &str, twin: Option<Twin>) -> PathBuf {
        let file = PathBuf::from(format!("rtl/{module}.sv"));
        let change = twin.filter(|twin| twin.0 == module);
        if change.is_none() && self.bound != Some(module) {
            return file;
        }
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut text = fs::read_to_string(root.join(&file)).expect("a module of the RTL");
        if let Some((_, from, to)) = change {
            assert_eq!(text.matches(from).count(), 1, "{module}.sv has {from:?} once");
            text = text.replace(from, to);
        }
        if self.bound == Some(module) {
            // Yosys 0.23 reads `bind`, and does nothing.
            let harness = fs::read_to_string(root.join(format!("formal/{}.sv", self.harness)))
                .expect("a harness");
            let bind = format!("\nbind {module} ");
            let (_, instance) = harness.split_once(&bind).expect("the harness is bound");
            let mut instance = instance.to_owned();
            for (name, value) in self.parameters {
                instance =
                    instance.replace(&format!(".{name}({name})"), &format!(".{name}({value})"));
            }
            let end = text.rfind("endmodule").expect("a module's end");
            text.insert_str(end, &instance);
        }
        let copy = self.folder(twin.map_or("holds", |_| "twin")).join(format!("{module}.sv"));
        fs::write(&copy, text).expect("the folder for tests is writable");
        copy
    }

    /// Runs a script and keeps what it printed.
    fn run(&self, script: &str, kind: &str) -> (bool, String) {
        let started = std::time::Instant::now();
        let (done, text) = yosys(script);
        fs::write(self.folder(kind).join("yosys.log"), &text).expect("the folder is writable");
        println!("{} {kind} {:?}: {:.1?}", self.harness, self.parameters, started.elapsed());
        (done, text)
    }

    /// A folder of its own for each proof and twin.
    fn folder(&self, kind: &str) -> PathBuf {
        let mut name = format!("{}_{kind}", self.harness);
        for (parameter, value) in self.parameters {
            name += &format!("_{parameter}_{value}");
        }
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        fs::create_dir_all(&folder).expect("the folder for tests is writable");
        folder
    }
}

/// The last lines of what Yosys printed: the model that was found, and the error.
fn tail(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    lines[lines.len().saturating_sub(60)..].join("\n")
}
