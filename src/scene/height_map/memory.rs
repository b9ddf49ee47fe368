//! How much memory a map takes, and how much there is.

use std::fs;

use super::error::{MapError, least_thinning};

/// Bytes for each node, from reading to the studies of a frame: measured at the peak of `render` on
/// maps of 4096² and 8192² nodes (70 and 69), and rounded up.
const BYTES_PER_NODE: u64 = 75;

/// Share of what there is that a map may take.
const SHARE: f64 = 0.8;

/// Bytes that a map of so many nodes takes.
pub fn taken(nodes: u64) -> u64 {
    nodes * BYTES_PER_NODE
}

/// Refuses a map that there is no memory for, before any of it is taken.
pub fn refuse_too_large(
    name: &str,
    columns: u64,
    rows: u64,
    remedy: impl Fn(u64) -> String,
) -> Result<(), MapError> {
    let Some(available) = available() else { return Ok(()) };
    let nodes = columns * rows;
    if taken(nodes) <= available {
        return Ok(());
    }
    let reason = format!(
        "a map of {columns} x {rows} nodes takes about {}, and there is room for {}",
        in_words(taken(nodes)),
        in_words(available)
    );
    let every = least_thinning(columns, rows, nodes_in(available));
    Err(MapError::new(name, reason, remedy(every)))
}

/// Nodes of a map that so many bytes hold.
pub fn nodes_in(bytes: u64) -> u64 {
    bytes / BYTES_PER_NODE
}

/// Bytes that this process may still take for a map: what the machine has free, or what it is
/// limited to (`ulimit -v`). `None` where the system does not say.
pub fn available() -> Option<u64> {
    let free = fs::read_to_string("/proc/meminfo").ok().and_then(|text| free(&text));
    let limit = fs::read_to_string("/proc/self/limits").ok().and_then(|text| limit(&text));
    let least = [free, limit].into_iter().flatten().min()?;
    Some((least as f64 * SHARE) as u64)
}

/// `MemAvailable` in bytes.
fn free(meminfo: &str) -> Option<u64> {
    let line = meminfo.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.split_whitespace().next()?.parse::<u64>().ok().map(|kilobytes| kilobytes << 10)
}

/// The soft limit of the address space in bytes; `None` if there is none.
fn limit(limits: &str) -> Option<u64> {
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    line.split_whitespace().next()?.parse().ok()
}

/// Bytes as written on the command line: a number with K, M or G.
///
/// # Errors
/// If it is none; the text says what to give.
#[cfg(feature = "cli")]
pub fn bytes(text: &str) -> Result<u64, String> {
    let (number, unit) = text.split_at(text.len() - text.chars().last().map_or(0, char::len_utf8));
    let factor = match unit {
        "K" | "k" => 1e3,
        "M" | "m" => 1e6,
        "G" | "g" => 1e9,
        _ => f64::NAN,
    };
    let bytes = number.parse::<f64>().map_or(f64::NAN, |number| number * factor);
    if (1e6..=1e13).contains(&bytes) {
        Ok(bytes as u64)
    } else {
        Err("give so many M or G, for example 600M or 2.5G".to_owned())
    }
}

/// Bytes in words: "1.3 GB".
pub fn in_words(bytes: u64) -> String {
    let bytes = bytes as f64;
    if bytes < 1e9 { format!("{:.0} MB", bytes / 1e6) } else { format!("{:.1} GB", bytes / 1e9) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_system_says() {
        assert_eq!(free("MemTotal: 9 kB\nMemAvailable:   1024 kB\n"), Some(1 << 20));
        assert_eq!(free("MemTotal: 9 kB\n"), None);
        let line = "Max address space         3072000000           unlimited            bytes\n";
        assert_eq!(limit(line), Some(3_072_000_000));
        assert_eq!(limit(&line.replace("3072000000", "unlimited")), None);
        assert!(!cfg!(target_os = "linux") || available().is_some_and(|bytes| bytes > 1 << 20));
    }

    #[cfg(feature = "cli")]
    #[test]
    fn amounts() {
        assert_eq!(bytes("600M"), Ok(600_000_000));
        assert_eq!(bytes("2.5G"), Ok(2_500_000_000));
        for text in ["", "G", "600", "-1G", "nanG", "1K", "9ä"] {
            assert!(bytes(text).is_err(), "{text}");
        }
    }

    #[test]
    fn in_gigabytes() {
        assert_eq!(in_words(1_260_000_000), "1.3 GB");
        assert_eq!(in_words(600_000_000), "600 MB");
    }
}
