//! Units of length by their names, as files and users write them.

/// A unit of length.
struct Unit {
    /// Name on the command line.
    short: &'static str,
    /// Name in reports, of several.
    plural: &'static str,
    metres: f64,
    /// Other names: small letters and digits alone.
    names: &'static [&'static str],
}

/// US survey foot in metres.
const SURVEY_FOOT: f64 = 1200.0 / 3937.0;

const UNITS: [Unit; 13] = [
    unit(
        "m",
        "metres",
        1.0,
        &["metre", "metres", "meter", "meters", "mètre", "mètres", "masl", "mamsl"],
    ),
    unit(
        "ft",
        "feet",
        0.3048,
        &[
            "foot",
            "feet",
            "footintl",
            "internationalfoot",
            "internationalfeet",
            "footinternational",
            "feetinternational",
            "ftint",
            "fti",
        ],
    ),
    unit(
        "us-ft",
        "US survey feet",
        SURVEY_FOOT,
        &[
            "ftus",
            "footus",
            "feetus",
            "usfoot",
            "usfeet",
            "surveyfoot",
            "surveyfeet",
            "ussurveyfoot",
            "ussurveyfeet",
            "footussurvey",
            "ftussurvey",
            "sft",
        ],
    ),
    unit("km", "kilometres", 1e3, &["kilometre", "kilometres", "kilometer", "kilometers"]),
    unit("dm", "decimetres", 0.1, &["decimetre", "decimetres", "decimeter", "decimeters"]),
    unit("cm", "centimetres", 0.01, &["centimetre", "centimetres", "centimeter", "centimeters"]),
    unit("mm", "millimetres", 1e-3, &["millimetre", "millimetres", "millimeter", "millimeters"]),
    unit("um", "micrometres", 1e-6, &["µm", "μm", "micron", "microns", "micrometre", "micrometer"]),
    unit("nm", "nanometres", 1e-9, &["nanometre", "nanometres", "nanometer", "nanometers"]),
    unit("yd", "yards", 0.9144, &["yard", "yards"]),
    unit("mi", "miles", 1609.344, &["mile", "miles", "statutemile"]),
    unit("in", "inches", 0.0254, &["inch", "inches"]),
    unit("fathom", "fathoms", 1.8288, &["fathoms", "ftm"]),
];

const fn unit(
    short: &'static str,
    plural: &'static str,
    metres: f64,
    names: &'static [&'static str],
) -> Unit {
    Unit { short, plural, metres, names }
}

/// Metres of the unit of a name; capitals, spaces and punctuation do not count.
pub(super) fn metres(name: &str) -> Option<f64> {
    let plain: String =
        name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect();
    // Capitals tell nautical miles from nanometres.
    if name.trim() == "NM" {
        return Some(1852.0);
    }
    let of =
        |unit: &&Unit| unit.short.replace('-', "") == plain || unit.names.contains(&plain.as_str());
    let found = UNITS.iter().find(of).map(|unit| unit.metres);
    // "metre (m)"
    found.or_else(|| metres(name.trim().strip_suffix(')')?.split_once('(')?.0))
}

/// The name of a unit for reports: "metres"; units without one are given in metres.
pub fn name(unit_m: f64) -> String {
    let near = |unit: &&Unit| (unit.metres / unit_m - 1.0).abs() < 1e-7;
    match UNITS.iter().find(near) {
        Some(unit) => unit.plural.to_owned(),
        None => format!("units of {unit_m} m"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_as_files_write_them() {
        for (text, expected) in [
            ("m", 1.0),
            ("Metre", 1.0),
            ("US survey foot", SURVEY_FOOT),
            ("Foot_US", SURVEY_FOOT),
            ("ftUS", SURVEY_FOOT),
            ("us-ft", SURVEY_FOOT),
            ("foot", 0.3048),
            ("cm", 0.01),
            ("metre (m)", 1.0),
            ("Feet (International)", 0.3048),
            ("m a.s.l.", 1.0),
            ("NM", 1852.0),
            ("nm", 1e-9),
        ] {
            assert_eq!(metres(text), Some(expected), "{text}");
        }
        assert_eq!(metres("degree"), None);
        assert_eq!(metres(""), None);
        assert_eq!(name(0.304_800_609_601_219_2), "US survey feet");
        assert_eq!(name(0.3048), "feet");
        assert_eq!(name(20.0), "units of 20 m");
    }

    #[test]
    fn no_name_means_two_units() {
        let plain = |unit: &Unit| unit.short.replace('-', "");
        let mut all: Vec<String> = UNITS.iter().map(plain).collect();
        all.extend(UNITS.iter().flat_map(|unit| unit.names).map(|&name| name.to_owned()));
        let count = all.len();
        all.sort();
        all.dedup();
        assert_eq!(all.len(), count);
    }
}
