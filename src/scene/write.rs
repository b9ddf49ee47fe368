//! A scene as TOML: complete, so that nothing depends on a default, and exact, so that reading it
//! gives the same scene in every bit.

use std::fmt::Write as _;

use glam::DVec3;

use super::{
    Angles, Attitude, Deformation, Extent, FormatRequest, Halvings, KernelShape, NoData, Outside,
    RatioForm, Scene, Screen, StepperMode, Surface, WordSize,
};

/// The scene file of a scene. `map` is written as the path of its height map, if it has one that
/// is not built in: give a path that holds from the folder where the file will lie.
///
/// The file reads back as the same scene in every bit if the scene came from a file, or if its
/// angles came from degrees and its directions were normalised as the reader does.
#[must_use]
pub fn toml(scene: &Scene, map: &str) -> String {
    let mut out = Tables(String::new());
    out.key("unit_m", number(scene.unit_m));
    out.key("seed", scene.seed.to_string());
    camera(&mut out, scene);
    for screen in &scene.screens {
        self::screen(&mut out, screen);
    }
    surface(&mut out, &scene.surface, map);
    kernel(&mut out, scene);

    out.table("stepper");
    out.key(
        "mode",
        text(match scene.stepper.mode {
            StepperMode::Skipping => "skipping",
            StepperMode::Plain => "plain",
        }),
    );
    out.key("fineness", scene.stepper.fineness.to_string());
    out.key(
        "halvings",
        match scene.stepper.halvings {
            Halvings::Footprint => text("footprint"),
            Halvings::Fixed(count) => count.to_string(),
        },
    );

    out.table("light");
    out.key("direction", vector(scene.light.direction));
    out.key("ambient", number(scene.light.ambient));

    let color = &scene.color;
    out.table("color");
    out.key("ramp", list(color.ramp.iter().copied().map(bytes)));
    out.key("sky", bytes(color.sky));
    out.key("far", bytes(color.far));
    out.key("side", bytes(color.side));
    out.key("checker", list(color.checker.map(bytes)));

    out.table("machine");
    out.key("clock_mhz", number(scene.machine.clock_mhz));
    out.key("memory_latency", scene.machine.memory_latency.to_string());
    out.key(
        "words",
        text(match scene.machine.words {
            WordSize::Auto => "auto",
            WordSize::Narrow => "narrow",
            WordSize::Wide => "wide",
        }),
    );
    out.key(
        "ratio",
        text(match scene.machine.ratio {
            RatioForm::Array => "array",
            RatioForm::Serial => "serial",
        }),
    );

    if !scene.formats.is_empty() {
        out.table("format");
        for (index, (registers, request)) in scene.formats.iter().enumerate() {
            // Of several requests for one register the last one counts, as in the program.
            if !scene.formats[index + 1..].iter().any(|(later, _)| later == registers) {
                out.key(registers.name(), format(request));
            }
        }
    }
    out.0
}

fn camera(out: &mut Tables, scene: &Scene) {
    out.table("camera");
    out.key("position", vector(scene.camera.position));
    out.key("offset", vector(scene.camera.offset));
    match scene.camera.attitude {
        Attitude::Angles(angles) => {
            out.key("heading", number(degrees(angles.heading)));
            out.key("pitch", number(degrees(angles.pitch)));
            out.key("roll", number(degrees(angles.roll)));
        }
        Attitude::Directions { forward, up } => {
            out.key("forward", vector(forward));
            out.key("up", vector(up));
        }
    }
}

fn screen(out: &mut Tables, screen: &Screen) {
    out.tables("screen");
    out.key("name", text(&screen.name));
    out.key("size", list([screen.columns, screen.lines].map(|n| n.to_string())));
    match screen.extent {
        Extent::FieldOfView(fov) => out.key("fov", number(degrees(fov))),
        Extent::Pitch { distance, pixel } => {
            out.key("distance", number(distance));
            out.key("pixel", list([pixel.x, pixel.y].map(number)));
        }
    }
    out.key("center", list([screen.center.x, screen.center.y].map(number)));
    let Angles { heading, pitch, roll } = screen.mount;
    let [heading, pitch, roll] = [heading, pitch, roll].map(|angle| number(degrees(angle)));
    out.key("mount", format!("{{ heading = {heading}, pitch = {pitch}, roll = {roll} }}"));
}

fn surface(out: &mut Tables, surface: &Surface, map: &str) {
    out.tables("surface");
    match surface {
        Surface::Terrain(terrain) => {
            let built_in = terrain.source.starts_with("builtin:");
            out.key("kind", text("terrain"));
            out.key("map", text(if built_in { &terrain.source } else { map }));
            out.key("encoding", text(terrain.encoding.name()));
            out.key("cell", list([terrain.cell.x, terrain.cell.y].map(number)));
            let (offset, scale) = (number(terrain.offset), number(terrain.scale));
            out.key("height", format!("{{ offset = {offset}, scale = {scale} }}"));
            out.key(
                "outside",
                text(match terrain.outside {
                    Outside::Sky => "sky",
                    Outside::Clamp => "clamp",
                    Outside::Wrap => "wrap",
                }),
            );
            out.key(
                "nodata",
                match terrain.nodata {
                    NoData::Hole => text("hole"),
                    NoData::Nearest => text("nearest"),
                    NoData::Sample(sample) => number(sample),
                },
            );
            if let Some(depth) = terrain.base_depth {
                out.key("base_depth", number(depth));
            }
        }
        Surface::Plane(plane) => {
            out.key("kind", text("plane"));
            out.key("normal", vector(plane.normal));
            out.key("distance", number(plane.distance));
            out.key("checker", number(plane.checker));
        }
    }
}

fn kernel(out: &mut Tables, scene: &Scene) {
    out.table("kernel");
    out.key("shape", text(scene.kernel.shape.name()));
    match scene.kernel.deformation {
        Deformation::None => out.key("deformation", "0".into()),
        Deformation::Stretch => out.key("deformation", "1".into()),
        Deformation::Blend { weight_shift } => {
            out.key("deformation", "2".into());
            out.key("weight_shift", weight_shift.to_string());
        }
    }
    out.key("table", scene.kernel.table.to_string());
}

impl KernelShape {
    /// Name in scene files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Cosine => "cosine",
            Self::Parabola => "parabola",
            Self::Exponential => "exponential",
            Self::Hat => "hat",
        }
    }
}

fn format(request: &FormatRequest) -> String {
    format!(
        "{{ width = {}, point = {}, rounding = \"{}\", overflow = \"{}\" }}",
        request.width,
        request.point,
        request.rounding.name(),
        request.overflow.name()
    )
}

/// TOML under construction.
struct Tables(String);

impl Tables {
    fn key(&mut self, key: &str, value: String) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{key} = {value}");
    }

    fn table(&mut self, name: &str) {
        let _ = writeln!(self.0, "\n[{name}]");
    }

    fn tables(&mut self, name: &str) {
        let _ = writeln!(self.0, "\n[[{name}]]");
    }
}

/// Quoted and escaped.
fn text(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// The shortest decimal that reads back as the same number.
fn number(value: f64) -> String {
    format!("{value:?}")
}

fn list(values: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", values.into_iter().collect::<Vec<_>>().join(", "))
}

fn vector(vector: DVec3) -> String {
    list(vector.to_array().map(number))
}

fn bytes(color: [u8; 3]) -> String {
    list(color.map(|byte| byte.to_string()))
}

/// Degrees that read back as these radians: the shortest of few decimals, or the nearest that do.
fn degrees(radians: f64) -> f64 {
    let near = radians.to_degrees();
    let reads_back = |degrees: &f64| (degrees % 360.0).to_radians() == radians;
    let rounded = (0..=9).map(|digits| {
        let unit = 10.0_f64.powi(digits);
        (near * unit).round() / unit
    });
    let (mut above, mut below) = (near, near);
    let neighbours = std::iter::once(near).chain((0..8).flat_map(|_| {
        (above, below) = (above.next_up(), below.next_down());
        [above, below]
    }));
    rounded.chain(neighbours).find(reads_back).unwrap_or(near)
}
