//! Explanations in words.

use super::{Explanation, Row};

/// The pixel, register by register, as a table; `scene` and `world` are names.
#[must_use]
pub fn text(scene: &str, world: &str, e: &Explanation) -> String {
    let sample = match e.hit {
        "surface" | "side" => format!("sample {} hit", e.steps),
        _ => "no sample hit".to_owned(),
    };
    let mut out = vec![
        format!("{scene}, column {}, line {}, {world}", e.column, e.line),
        format!(
            "fixed: {}, real: {}, oracle: {}; {} after {} skip tests, {} samples, {} bisection steps",
            e.hit, e.real_hit, e.oracle_hit, sample, e.skip_tests, e.samples, e.bisection_steps
        ),
        format!(
            "colour {:?}, oracle {:?}. Numbers on the right: equations of docs/mathematics.md",
            e.color, e.oracle_color
        ),
        exponents(e),
        String::new(),
        format!(
            "{:<22} {:<9} {:>14} {:>16} {:>16} {:>16} {:>10} {:>10}  eq.",
            "", "format", "raw", "value", "real", "oracle", "error", "bound"
        ),
    ];
    let mut unit = "";
    for row in &e.rows {
        if row.unit != unit {
            unit = row.unit;
            out.push(format!("{unit} {}", "-".repeat(100_usize.saturating_sub(unit.len()))));
        }
        out.push(line_of(row));
    }
    let beyond: Vec<&str> =
        e.rows.iter().filter(|row| row.beyond_bound).map(|row| row.what.as_str()).collect();
    if !beyond.is_empty() {
        out.push(format!("beyond their bounds (marked !): {}", beyond.join(", ")));
    }
    if let Some(why) = e.turned_away {
        out.push(format!("the ray ends at the divider: {why}"));
    }
    if let Some(hole) = e.hole {
        out.push(format!("hole: {hole}"));
    }
    out.join("\n")
}

/// The powers of two that the view registers are scaled by.
fn exponents(e: &Explanation) -> String {
    let view = format!("view registers hold V 2^{} (equation 6)", e.view_exponent);
    match e.denominator_exponent {
        Some(exponent) => format!("{view}, the denominator D 2^{exponent} (equation 9)"),
        None => view,
    }
}

fn line_of(row: &Row) -> String {
    let optional = |value: Option<f64>, text: &dyn Fn(f64) -> String| value.map_or("".into(), text);
    let exact = |value: f64| format!("{value:.9}");
    let small = |value: f64| format!("{value:.1e}");
    format!(
        "{:<22} {:<9} {:>14} {:>16} {:>16} {:>16} {:>10} {:>10} {} {}",
        row.what,
        row.format,
        row.raw.map_or(String::new(), |raw| raw.to_string()),
        exact(row.value),
        optional(row.real, &exact),
        optional(row.oracle, &exact),
        optional(row.error, &small),
        optional(row.bound, &small),
        if row.beyond_bound { "!" } else { " " },
        row.equations
    )
}
