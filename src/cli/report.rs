//! Output shared by the commands.

use std::io::Write as _;

use serde::Serialize;
use serde_json::{Map, Value};

use super::Stop;
pub use crate::study::figures::digits;

/// Prints to stdout. A reader that has gone away (a pager, `head`) is no error.
pub fn print(text: &str) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// Prints one JSON object: `schema`, `command`, `scene`, `version`, then the command's fields.
pub fn json(command: &str, scene: Option<&str>, fields: &impl Serialize) -> Result<(), Stop> {
    let mut object = Map::new();
    object.insert("schema".into(), 3.into());
    object.insert("command".into(), command.into());
    object.insert("scene".into(), scene.map_or(Value::Null, Value::from));
    object.insert("version".into(), env!("CARGO_PKG_VERSION").into());
    match serde_json::to_value(fields)? {
        Value::Object(fields) => object.extend(fields),
        other => {
            object.insert("result".into(), other);
        }
    }
    print(&serde_json::to_string(&object)?);
    Ok(())
}

/// Runs work; where it takes more than a second, a terminal shows that it goes on.
pub fn while_waiting<T>(what: &str, work: impl FnOnce() -> T) -> T {
    use std::io::IsTerminal as _;
    if !std::io::stderr().is_terminal() {
        return work();
    }
    let bar = indicatif::ProgressBar::new_spinner().with_message(format!("{what} …"));
    bar.set_draw_target(indicatif::ProgressDrawTarget::hidden());
    let (done, finished) = std::sync::mpsc::channel::<()>();
    let shown = bar.clone();
    let ticker = std::thread::spawn(move || {
        let mut wait = std::time::Duration::from_secs(1);
        while let Err(std::sync::mpsc::RecvTimeoutError::Timeout) = finished.recv_timeout(wait) {
            shown.set_draw_target(indicatif::ProgressDrawTarget::stderr());
            shown.tick();
            wait = std::time::Duration::from_millis(100);
        }
    });
    let result = work();
    drop(done);
    let _ = ticker.join();
    bar.finish_and_clear();
    result
}

/// The line about what the formats in use do not hold, if there is anything.
pub fn not_proved(claims: &[String]) -> Option<String> {
    (!claims.is_empty()).then(|| format!("  not proved: {}", claims.join("; ")))
}

/// The lines about what should be known before a picture is trusted.
pub fn cautions(cautions: &[String]) -> impl Iterator<Item = String> {
    cautions.iter().map(|caution| format!("  caution   {caution}"))
}
