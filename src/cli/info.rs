//! `terraline info`.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use serde_json::Value;

use super::reading::Reading;
use super::{Stop, report};
use crate::scene::height_map::georeference::Coordinates;
use crate::scene::height_map::source;
use crate::scene::height_map::{MAX_NODES, Thinning, unit};
use crate::scene::{HeightFile, Interpretation, quote};

/// Say what is understood of height files: size, cells, place, range, nodes without data.
#[derive(Debug, Args)]
#[command(after_help = "Example: terraline info dem.tif N36W085.hgt
Example: terraline info dem.asc --unit ft --height-unit ft --nodata -32767")]
pub struct Info {
    /// Height files: GeoTIFF, SRTM .hgt, ESRI ASCII grid, PNG, also in .zip and .gz.
    #[arg(required = true)]
    files: Vec<PathBuf>,

    #[command(flatten)]
    reading: Reading,

    /// One JSON object on stdout.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Report {
    files: Vec<Described>,
    errors: Vec<Unread>,
}

/// Coordinates of the outermost nodes.
#[derive(Serialize)]
struct Extent {
    west: f64,
    east: f64,
    south: f64,
    north: f64,
}

/// What is known of one file.
#[derive(Serialize)]
struct Described {
    file: String,
    format: &'static str,
    /// `zip`, `gzip` or null.
    packed: Option<&'static str>,
    columns: usize,
    rows: usize,
    sample_type: &'static str,
    compression: Option<String>,
    layout: Option<String>,
    byte_order: Option<&'static str>,
    /// `degrees`, `lengths` or null.
    coordinates: Option<&'static str>,
    /// Metres per unit of lengths.
    coordinate_unit_m: Option<f64>,
    epsg: Option<u16>,
    citation: Option<String>,
    pixel_is: Option<&'static str>,
    cell: Option<[f64; 2]>,
    cell_m: Option<[f64; 2]>,
    middle_latitude_deg: Option<f64>,
    extent: Option<Extent>,
    lowest: f32,
    highest: f32,
    height_unit_m: Option<f64>,
    /// A number, `"nan"`, or null where none is declared.
    nodata: Value,
    /// Nodes that range and voids are told of: all, but in files that are thinned.
    nodes_read: usize,
    nodata_nodes: usize,
    nodata_share: f64,
    notes: Vec<String>,
    render: String,
}

/// A file that could not be read.
#[derive(Serialize)]
struct Unread {
    file: String,
    message: String,
}

impl Info {
    pub fn run(&self) -> Result<(), Stop> {
        let (mut files, mut errors) = (Vec::new(), Vec::new());
        for path in &self.files {
            let what = format!("reading {}", path.display());
            match report::while_waiting(&what, || describe(path, &self.reading)) {
                Ok(file) => {
                    if !self.json {
                        let gap = if files.is_empty() { "" } else { "\n" };
                        report::print(&format!("{gap}{}", text(&file)));
                    }
                    files.push(file);
                }
                Err(Stop::BadInput(message)) if self.files.len() > 1 => {
                    eprintln!("terraline: {message}");
                    errors.push(Unread { file: path.display().to_string(), message });
                }
                Err(stop) => return Err(stop),
            }
        }
        let (read, unread) = (files.len(), errors.len());
        if self.json {
            report::json("info", None, &Report { files, errors })?;
        }
        if unread == 0 {
            return Ok(());
        }
        Err(Stop::BadInput(format!("{unread} of {} files cannot be used", read + unread)))
    }
}

fn describe(path: &Path, reading: &Reading) -> Result<Described, Stop> {
    if !path.exists() {
        return Err(Stop::BadInput(format!(
            "{}: there is no such file; check the name of the height file",
            path.display()
        )));
    }
    let asked =
        Interpretation { thinning: Thinning::Fit(MAX_NODES), ..reading.interpretation() };
    let HeightFile { map, mut georeference, storage, whole, whole_origin, every, nodata, mut notes } =
        source::read(path, &asked)?;
    // The file is described, not what is kept of it.
    let (columns, rows) = whole;
    georeference.cell = georeference.cell.map(|cell| cell / every as f64);
    georeference.origin = whole_origin;
    let (lowest, highest) = map.range();
    let voids = map.voids();
    let extent = georeference
        .origin
        .zip(georeference.far_corner(columns, rows))
        .map(|(origin, far)| Extent { west: origin.x, east: far.x, south: far.y, north: origin.y });
    notes.extend(georeference.height_unit_remark());
    let stem = path.file_stem().map_or_else(|| "terrain".into(), |stem| stem.to_string_lossy());
    let mut render = vec![format!(
        "terraline render {} -o {}",
        quote(&path.display().to_string()),
        quote(&format!("{stem}-view.png"))
    )];
    render.extend(reading.words());
    Ok(Described {
        file: path.display().to_string(),
        format: storage.format,
        packed: storage.packed,
        columns,
        rows,
        sample_type: storage.sample,
        compression: storage.compression,
        layout: storage.layout,
        byte_order: storage.byte_order,
        coordinates: match georeference.coordinates {
            Coordinates::Degrees => Some("degrees"),
            Coordinates::Lengths { .. } => Some("lengths"),
            Coordinates::Unknown => None,
        },
        coordinate_unit_m: match georeference.coordinates {
            Coordinates::Lengths { unit_m } => Some(unit_m),
            _ => None,
        },
        epsg: georeference.epsg,
        pixel_is: georeference.pixel_is.map(|pixel| pixel.name()),
        cell: georeference.cell.map(|cell| cell.to_array()),
        cell_m: georeference.cell_m(columns, rows).map(|cell| cell.to_array()),
        middle_latitude_deg: georeference.middle_latitude(columns, rows),
        height_unit_m: georeference.height_unit_m,
        citation: georeference.citation,
        extent,
        lowest,
        highest,
        nodata: match nodata {
            Some(value) if value.is_nan() => "nan".into(),
            Some(value) if value.is_infinite() => value.to_string().into(),
            Some(value) => value.into(),
            None => Value::Null,
        },
        nodata_nodes: voids,
        nodes_read: map.samples().len(),
        nodata_share: voids as f64 / map.samples().len() as f64,
        notes,
        render: render.join(" "),
    })
}

fn text(file: &Described) -> String {
    let mut out = vec![file.file.clone()];
    let mut line = |what: &str, text: String| out.push(format!("  {what:<9} {text}"));
    let stored =
        [file.compression.clone(), file.layout.clone(), file.byte_order.map(str::to_owned)];
    let stored: String = stored.iter().flatten().map(|word| format!(", {word}")).collect();
    let packed = file.packed.map_or(String::new(), |kind| format!(" in a {kind} file"));
    line("format", format!("{}{packed}, {}{stored}", file.format, file.sample_type));
    line("size", format!("{} x {} nodes", file.columns, file.rows));
    line("cell", cell(file));
    line("place", place(file));
    if let Some(Extent { west, east, south, north }) = &file.extent {
        line(
            "nodes",
            format!(
                "from {} to {} east, from {} to {} north",
                coordinate(*west),
                coordinate(*east),
                coordinate(*south),
                coordinate(*north)
            ),
        );
    }
    let unit = match file.height_unit_m {
        Some(1.0) => " m".to_owned(),
        Some(unit_m) => format!(" {}", unit::name(unit_m)),
        None => ", unit not stated".to_owned(),
    };
    line(
        "heights",
        format!(
            "{} to {}{unit}",
            height(f64::from(file.lowest), file.lowest),
            height(f64::from(file.highest), file.highest)
        ),
    );
    let declared = match &file.nodata {
        Value::Null => "none declared".to_owned(),
        Value::String(word) => format!("declared as {word}"),
        number => {
            let number = number.as_f64().unwrap_or_default();
            format!("declared as {}", height(number, number))
        }
    };
    line(
        "no data",
        format!(
            "{declared}; {} of {} nodes{} ({:.2} %)",
            file.nodata_nodes,
            file.nodes_read,
            if file.nodes_read < file.columns * file.rows { " that were read" } else { "" },
            100.0 * file.nodata_share
        ),
    );
    for note in &file.notes {
        line("note", note.clone());
    }
    line("render", file.render.clone());
    out.join("\n")
}

/// A coordinate with enough digits for a node, or few where it has many.
fn coordinate(value: f64) -> String {
    if value.abs() < 1e12 { format!("{value:.9}") } else { format!("{value:e}") }
}

/// A height as it is written in its own precision.
fn height(size: f64, value: impl std::fmt::Display + std::fmt::LowerExp) -> String {
    if size == 0.0 || (1e-4..1e12).contains(&size.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

fn cell(file: &Described) -> String {
    let Some([x, z]) = file.cell else { return "not known".to_owned() };
    let Some([x_m, z_m]) = file.cell_m else { return format!("{x} x {z}, metres not known") };
    let metres = format!("{} m x {} m", report::digits(x_m), report::digits(z_m));
    match (file.coordinates, file.middle_latitude_deg) {
        (Some("degrees"), Some(latitude)) => {
            format!("{x:.9} x {z:.9} degrees: {metres} at latitude {latitude:.3}")
        }
        (_, Some(latitude)) => {
            format!("{x} x {z}: {metres} on the ground at latitude {latitude:.3}")
        }
        _ if file.coordinate_unit_m == Some(1.0) => metres,
        _ => format!("{x} x {z}: {metres}"),
    }
}

fn place(file: &Described) -> String {
    let mut words = vec![match (file.coordinates, file.coordinate_unit_m) {
        (Some("degrees"), _) => "longitude and latitude in degrees".to_owned(),
        (Some(_), Some(unit_m)) => format!("projected, in {}", unit::name(unit_m)),
        _ => "not known".to_owned(),
    }];
    words.extend(file.epsg.map(|code| format!("EPSG:{code}")));
    words.extend(file.citation.clone());
    words.extend(file.pixel_is.map(|pixel| {
        format!(
            "a sample is {}",
            match pixel {
                "area" => "an area, its node the centre",
                _ => "a point",
            }
        )
    }));
    words.join(", ")
}
