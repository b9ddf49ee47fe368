//! Coordinate systems as well-known text (OGC 01-009, and ISO 19162 as far as it is alike): what
//! ESRI's programs write into GeoTIFF citations and `.prj` files.

use super::projection::{Cylindrical, Ellipsoid, Method, Projection};

/// Deeper nesting is no coordinate system.
const DEEPEST: usize = 16;

/// `KEYWORD[argument, …]`.
#[derive(Debug, Default)]
struct Node {
    /// In capitals.
    keyword: String,
    texts: Vec<String>,
    numbers: Vec<f64>,
    nodes: Vec<Node>,
}

/// What a text says of a coordinate system.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct System {
    pub(super) name: String,
    /// Metres of the unit of projected coordinates.
    pub(super) length_m: Option<f64>,
    /// Degrees of the unit of geographic coordinates, where there is no projection.
    pub(super) angle_deg: Option<f64>,
    /// Metres of the unit of heights.
    pub(super) height_m: Option<f64>,
    pub(super) ellipsoid: Option<Ellipsoid>,
    pub(super) projection: Option<Projection>,
}

/// Reads the first system in a text, whatever stands before it.
pub(super) fn read(text: &str) -> Option<System> {
    const HEADS: [&str; 8] =
        ["PROJCS", "PROJCRS", "GEOGCS", "GEOGCRS", "COMPD_CS", "COMPOUNDCRS", "VERTCS", "VERT_CS"];
    let capitals = text.to_ascii_uppercase();
    // A name of something else may hold the word: a bracket follows.
    let opens =
        |&(at, head): &(usize, &str)| capitals[at + head.len()..].trim_start().starts_with('[');
    let found = HEADS.iter().flat_map(|&head| capitals.match_indices(head)).filter(opens);
    let start = found.map(|(at, _)| at).min()?;
    let (root, _) = node(&text[start..], 0)?;
    let mut system = System::default();
    system.take(&root);
    // Heights may stand in a text of their own behind that of the plan.
    if system.height_m.is_none()
        && let Some(start) = capitals.find("VERTCS[")
        && let Some((vertical, _)) = node(&text[start..], 0)
    {
        system.take(&vertical);
    }
    Some(system)
}

/// A node at the head of a text, and what follows it. A text that is cut short ends its nodes.
fn node(text: &str, depth: usize) -> Option<(Node, &str)> {
    let open = text.find('[')?;
    let keyword = text[..open].trim().to_ascii_uppercase();
    if keyword.is_empty() || depth > DEEPEST || !keyword.bytes().all(is_keyword) {
        return None;
    }
    let mut found = Node { keyword, ..Node::default() };
    let mut rest = &text[open + 1..];
    loop {
        rest = rest.trim_start_matches([',', ' ', '\t', '\r', '\n']);
        if let Some(after) = rest.strip_prefix(']') {
            return Some((found, after));
        }
        if let Some(quoted) = rest.strip_prefix('"') {
            let end = quoted.find('"').unwrap_or(quoted.len());
            found.texts.push(quoted[..end].to_owned());
            rest = quoted.get(end + 1..).unwrap_or_default();
            continue;
        }
        if rest.is_empty() {
            return Some((found, rest));
        }
        let end = rest.find([',', ']', '[']).unwrap_or(rest.len());
        if rest[end..].starts_with('[') {
            let (inner, after) = node(rest, depth + 1)?;
            found.nodes.push(inner);
            rest = after;
        } else {
            found.numbers.extend(rest[..end].trim().parse::<f64>().ok());
            rest = &rest[end..];
        }
    }
}

fn is_keyword(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

impl Node {
    fn child(&self, keywords: &[&str]) -> Option<&Self> {
        self.nodes.iter().find(|node| keywords.contains(&node.keyword.as_str()))
    }

    fn name(&self) -> &str {
        self.texts.first().map_or("", String::as_str)
    }

    /// The factor of its unit, which stands behind those of its parts.
    fn unit(&self) -> Option<f64> {
        let is_unit =
            |node: &&Self| matches!(node.keyword.as_str(), "UNIT" | "LENGTHUNIT" | "ANGLEUNIT");
        // The newer form may give it with each axis.
        let axis = || self.child(&["AXIS"])?.nodes.iter().find(is_unit);
        let unit = self.nodes.iter().rev().find(is_unit).or_else(axis)?;
        unit.numbers.first().copied().filter(|&factor| factor.is_finite() && factor > 0.0)
    }

    /// The value of a parameter by the start of its name.
    fn parameter(&self, start: &str) -> Option<f64> {
        let named = |node: &&Self| {
            node.keyword == "PARAMETER" && node.name().to_ascii_lowercase().starts_with(start)
        };
        self.nodes.iter().find(named)?.numbers.first().copied()
    }
}

impl System {
    fn take(&mut self, node: &Node) {
        match node.keyword.as_str() {
            "COMPD_CS" | "COMPOUNDCRS" => {
                node.nodes.iter().for_each(|part| self.take(part));
                node.name().clone_into(&mut self.name);
            }
            "PROJCS" | "PROJCRS" => {
                node.name().clone_into(&mut self.name);
                self.length_m = node.unit();
                self.take_ellipsoid(node.child(&["GEOGCS", "BASEGEOGCRS"]));
                self.projection = Some(projection(node));
            }
            "GEOGCS" | "GEOGCRS" => {
                node.name().clone_into(&mut self.name);
                self.angle_deg = node.unit().map(f64::to_degrees);
                self.take_ellipsoid(Some(node));
            }
            "VERT_CS" | "VERTCS" | "VERTCRS" => self.height_m = node.unit(),
            _ => {}
        }
    }

    fn take_ellipsoid(&mut self, geographic: Option<&Node>) {
        let datum = geographic.and_then(|node| node.child(&["DATUM"]));
        let spheroid = datum.and_then(|node| node.child(&["SPHEROID", "ELLIPSOID"]));
        if let Some([semi_major_m, inverse, ..]) = spheroid.map(|node| node.numbers.as_slice()) {
            self.ellipsoid = ellipsoid(*semi_major_m, *inverse);
        }
    }
}

/// By its radius and inverse flattening, which is 0 of a sphere.
pub(super) fn ellipsoid(semi_major_m: f64, inverse: f64) -> Option<Ellipsoid> {
    let flattening = if inverse == 0.0 { 0.0 } else { 1.0 / inverse };
    let is_body = (1.0..1e9).contains(&semi_major_m) && (0.0..0.5).contains(&flattening);
    is_body.then_some(Ellipsoid { semi_major_m, flattening })
}

/// By the names of OGC and ESRI.
fn projection(node: &Node) -> Projection {
    let name = node.child(&["PROJECTION", "METHOD"]).map_or("", Node::name);
    let plain = name.to_ascii_lowercase().replace(['_', ' '], "");
    let wide = |a: f64, b: f64| (a - b).abs() > WIDE_PARALLELS;
    let method = match plain.as_str() {
        "mercatorauxiliarysphere" | "popularvisualisationpseudomercator" => {
            Method::SphericalMercator
        }
        "mercator" | "mercator1sp" | "mercator2sp" | "mercatorvarianta" | "mercatorvariantb" => {
            Method::Mercator
        }
        "equidistantcylindrical" | "platecarree" | "equirectangular" => Method::Equirectangular,
        _ => {
            let parallels = ["standard_parallel_1", "standard_parallel_2"];
            let [first, second] = parallels.map(|start| node.parameter(start));
            let wide = first.zip(second).is_some_and(|(first, second)| wide(first, second));
            return match is_true_to_scale(&plain) && !wide {
                true => Projection::TrueToScale,
                false => Projection::Distorted(name.replace('_', " ")),
            };
        }
    };
    let of = |start| node.parameter(start);
    Projection::Cylindrical(Cylindrical {
        method,
        scale: of("scale_factor").unwrap_or(1.0),
        origin_latitude: of("latitude_of_origin")
            .or_else(|| of("latitude_of_center"))
            .unwrap_or(0.0),
        standard_parallel: of("standard_parallel").or_else(|| of("latitude_of_1st")).unwrap_or(0.0),
        false_northing: of("false_northing").unwrap_or(0.0) * node.unit().unwrap_or(1.0),
    })
}

/// Conics whose standard parallels lie farther apart, degrees, are off between them.
pub(super) const WIDE_PARALLELS: f64 = 10.0;

/// Projections whose lengths are true within a few per mille where they are used, by parts of their
/// names.
fn is_true_to_scale(plain: &str) -> bool {
    const NAMES: [&str; 17] = [
        "transversemercator",
        "gausskruger",
        "lambertconformalconic",
        "lambertconicconformal",
        "obliquemercator",
        "hotine",
        "swissoblique",
        "rectifiedskew",
        "obliquestereographic",
        "doublestereographic",
        "krovak",
        "cassini",
        "newzealandmapgrid",
        "laborde",
        "tunisiamining",
        "local",
        "guam",
    ];
    plain.is_empty() || NAMES.iter().any(|name| plain.contains(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    const WGS84: &str = "GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\",SPHEROID[\"WGS_1984\",\
                         6378137.0,298.257223563]],PRIMEM[\"Greenwich\",0.0],\
                         UNIT[\"Degree\",0.0174532925199433]]";

    #[test]
    fn units_of_plan_and_heights() {
        let text = format!(
            "ESRI PE String = PROJCS[\"Custom_ft\",{WGS84},PROJECTION[\"Transverse_Mercator\"],\
             PARAMETER[\"False_Easting\",500000.0],UNIT[\"Foot_US\",0.3048006096012192]],\
             VERTCS[\"NAVD_1988_Foot\",VDATUM[\"N\"],PARAMETER[\"Direction\",1.0],UNIT[\"Foot\",0.3048]]"
        );
        let system = read(&text).unwrap();
        assert_eq!(system.name, "Custom_ft");
        assert_eq!(system.length_m, Some(0.3048006096012192));
        assert_eq!((system.angle_deg, system.height_m), (None, Some(0.3048)));
        assert_eq!(system.projection, Some(Projection::TrueToScale));
        let geographic = read(WGS84).unwrap();
        assert!((geographic.angle_deg.unwrap() - 1.0).abs() < 1e-12);
        assert_eq!(geographic.length_m, None);
        assert_eq!(geographic.ellipsoid, Some(Ellipsoid::WGS84));
    }

    #[test]
    fn projections_that_change_lengths() {
        let of = |projection: &str| {
            let text =
                format!("PROJCS[\"x\",{WGS84},PROJECTION[\"{projection}\"],UNIT[\"Meter\",1.0]]");
            read(&text).unwrap().projection.unwrap()
        };
        assert!(matches!(
            of("Mercator_Auxiliary_Sphere"),
            Projection::Cylindrical(Cylindrical { method: Method::SphericalMercator, .. })
        ));
        assert_eq!(of("Albers"), Projection::Distorted("Albers".to_owned()));
        assert_eq!(of("Lambert_Conformal_Conic"), Projection::TrueToScale);
        let text = "PROJCS[\"Mars\",GEOGCS[\"M\",DATUM[\"M\",SPHEROID[\"M\",3396190.0,0.0]]],\
                    PROJECTION[\"Equidistant_Cylindrical\"],PARAMETER[\"Standard_Parallel_1\",40.0],\
                    UNIT[\"Meter\",1.0]]";
        let mars = read(text).unwrap();
        assert_eq!(mars.ellipsoid, Some(Ellipsoid { semi_major_m: 3_396_190.0, flattening: 0.0 }));
        assert!(matches!(
            mars.projection,
            Some(Projection::Cylindrical(Cylindrical { standard_parallel: 40.0, .. }))
        ));
    }

    #[test]
    fn texts_that_are_none_or_cut_short() {
        for text in
            ["", "WGS 84", "PROJCS", "PROJCS[", "PROJCS[\"", "[[[[", "GEOGCS[]]]", "é[PROJCS["]
        {
            let unit = read(text).map(|system| (system.length_m, system.angle_deg));
            assert!(matches!(unit, None | Some((None, None))), "{text}");
        }
        let deep = "PROJCS[".repeat(1000);
        assert_eq!(read(&deep), None);
        // Every prefix of a sound text.
        let text = format!("PROJCS[\"ä\",{WGS84},UNIT[\"Foot\",0.3048]]");
        for end in (0..text.len()).filter(|&end| text.is_char_boundary(end)) {
            let _ = read(&text[..end]);
        }
    }
}
