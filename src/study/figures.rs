//! Numbers as reports show them.

/// A number with four significant digits.
#[must_use]
pub fn digits(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        "0".into()
    } else if size >= 1000.0 {
        format!("{value:.0}")
    } else if size >= 1e-3 {
        let leading = size.log10().floor() as i32;
        format!("{value:.*}", (3 - leading) as usize)
    } else {
        format!("{value:.2e}")
    }
}
