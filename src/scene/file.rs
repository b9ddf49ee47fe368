//! The reader of scene files: TOML text and `--set` options to a checked [`Scene`].
//!
//! Every key has a default, angles are in degrees, unknown keys are errors. A [`SceneError`] names
//! the file, the line, the field, what is wrong with it and what to do.

use std::path::Path;

use glam::DVec3;
use toml::de::DeTable;

use super::array::is_unit;
use super::error::{Place, SceneError};
use super::field::{Context, Field, Fields, is_length};
use super::height_map::{file_reason, one_line, read_limited, shown_path};
use super::tree::Node;
use super::{
    Colors, Deformation, FormatRequest, Halvings, Hardware, Kernel, KernelShape, Light, Overflow,
    RatioForm, Registers, Rounding, Scene, Stepper, StepperMode, WordSize, camera, format, keys,
    screen, set, surface,
};

/// A scene file is a few hundred bytes; what is much larger was given by mistake.
const MAX_FILE_BYTES: u64 = 1 << 20;

/// The text of a scene and where it comes from.
#[derive(Clone, Copy, Debug)]
pub struct Document<'a> {
    /// Name of the scene, for reports.
    pub name: &'a str,
    /// What messages call the file.
    pub file: &'a str,
    /// Folder where relative paths in the scene start.
    pub folder: &'a Path,
    /// TOML.
    pub text: &'a str,
}

/// Reads a scene file and applies the `--set` options.
///
/// # Errors
/// If the file cannot be read or [`parse`] fails.
pub fn read(path: &Path, sets: &[String]) -> Result<Scene, SceneError> {
    let file = shown_path(path);
    let unreadable = |reason: String, remedy: &str| SceneError::Unreadable {
        file: file.clone(),
        reason,
        remedy: remedy.to_owned(),
    };
    let bytes = read_limited(path, MAX_FILE_BYTES).map_err(|error| {
        unreadable(file_reason(&error), "give a scene file (TOML) or the name of a built-in scene")
    })?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = 1 + error.as_bytes()[..at].iter().filter(|&&byte| byte == b'\n').count();
        unreadable(
            format!("line {line} is not UTF-8 text"),
            "give a scene file, which is TOML text in UTF-8, or a height file that \
             `terraline info` understands",
        )
    })?;
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    parse(
        &Document {
            name: stem.as_deref().unwrap_or("scene"),
            file: &file,
            folder: path.parent().unwrap_or(Path::new("")),
            text: &text,
        },
        sets,
    )
}

/// Parses the text of a scene and applies the `--set` options.
///
/// # Errors
/// If the text is not TOML, a field is unknown or wrong, or the height map cannot be used.
///
/// # Examples
/// ```
/// use std::path::Path;
/// use terraline::scene::file::{Document, parse};
///
/// let text = "[camera]\nposition = [0, 12, 0]\nheading = 450";
/// let document = Document { name: "mine", file: "mine.toml", folder: Path::new(""), text };
/// let scene = parse(&document, &["screen.size=[64, 48]".to_owned()])?;
/// assert_eq!((scene.screens[0].columns, scene.screens[0].lines), (64, 48));
///
/// let error = parse(&document, &["camera.hedding=3".to_owned()]).unwrap_err();
/// assert!(error.to_string().contains("did you mean `camera.heading`?"));
/// # Ok::<(), terraline::scene::SceneError>(())
/// ```
pub fn parse(document: &Document<'_>, sets: &[String]) -> Result<Scene, SceneError> {
    parse_with(document, sets, None)
}

/// As [`parse`], with a map that was read before.
pub(super) fn parse_with(
    document: &Document<'_>,
    sets: &[String],
    known: Option<&surface::ReadMap>,
) -> Result<Scene, SceneError> {
    let table = DeTable::parse(document.text).map_err(|error| syntax(document, &error))?;
    let mut root = Node::document(table);
    let options = set::apply(&mut root, sets)?;
    let context = Context { file: document.file, text: document.text, options };
    let scene = Fields::root(&context, &root)?;
    Ok(Scene {
        name: document.name.to_owned(),
        unit_m: scene.read("unit_m", 80.0, Field::length)?,
        seed: scene.read("seed", 1, |seed| seed.integer(0..=i64::MAX).map(i64::cast_unsigned))?,
        camera: camera::read(&scene.table("camera", &keys::CAMERA)?)?,
        screens: screen::read(&scene)?,
        kernel: kernel(&scene.table("kernel", &keys::KERNEL)?)?,
        stepper: stepper(&scene.table("stepper", &keys::STEPPER)?)?,
        light: light(&scene.table("light", &keys::LIGHT)?)?,
        color: colors(&scene.table("color", &keys::COLOR)?)?,
        machine: hardware(&scene.table("machine", &keys::MACHINE)?)?,
        formats: formats(&scene)?,
        // Last, because the map may be large: every other mistake is found before it is read.
        surface: surface::read(&scene, surface::Maps { folder: document.folder, known })?,
    })
}

fn syntax(document: &Document<'_>, error: &toml::de::Error) -> SceneError {
    // Without a span the text ended too early.
    let offset = error.span().map_or(document.text.len(), |span| span.start);
    SceneError::Syntax {
        place: Place::in_text(document.file, document.text, offset),
        reason: one_line(error.message()),
        remedy: "correct this line; `terraline scenes overview` prints a scene to compare with"
            .to_owned(),
    }
}

fn kernel(table: &Fields<'_>) -> Result<Kernel, SceneError> {
    let shape = table.read("shape", KernelShape::Cosine, |shape| {
        shape.choice(&[
            ("cosine", KernelShape::Cosine),
            ("parabola", KernelShape::Parabola),
            ("exponential", KernelShape::Exponential),
            ("hat", KernelShape::Hat),
        ])
    })?;
    let weight_shift = table.read("weight_shift", 2, |shift| shift.count(0..=64))?;
    let deformation = match table.read("deformation", 2, |number| number.count(0..=2))? {
        0 => Deformation::None,
        1 => Deformation::Stretch,
        _ => Deformation::Blend { weight_shift },
    };
    let entries = table.read("table", 4096, |entries| {
        let count = entries.count(16..=65536)?;
        if count.is_power_of_two() {
            Ok(count)
        } else {
            Err(entries.error(
                format!("{count} is not a power of two"),
                format!("give {} or {}", count.next_power_of_two() / 2, count.next_power_of_two()),
            ))
        }
    })?;
    Ok(Kernel { shape, deformation, table: entries })
}

fn stepper(table: &Fields<'_>) -> Result<Stepper, SceneError> {
    let mode = table.read("mode", StepperMode::Skipping, |mode| {
        if mode.text("\"skipping\" or \"plain\"")? == "thesis" {
            return Err(mode.error(
                "the mode \"thesis\" is not built yet",
                "use \"skipping\", or \"plain\" to test every step",
            ));
        }
        mode.choice(&[("skipping", StepperMode::Skipping), ("plain", StepperMode::Plain)])
    })?;
    let fineness = table.read("fineness", 3, |fineness| fineness.count(0..=6))?;
    let halvings = table.read("halvings", Halvings::Footprint, |halvings| {
        if halvings.is_text() {
            halvings.choice(&[("footprint", Halvings::Footprint)]).map_err(|_| {
                halvings.error(
                    "this is no rule for halvings",
                    "give \"footprint\" or a whole number from 0 to 20",
                )
            })
        } else {
            halvings.count(0..=20).map(Halvings::Fixed)
        }
    })?;
    Ok(Stepper { mode, fineness, halvings })
}

fn light(table: &Fields<'_>) -> Result<Light, SceneError> {
    let direction = table.read("direction", DVec3::new(-1.0, 1.5, -1.0), Field::direction)?;
    let ambient = table.read("ambient", 0.3, |ambient| {
        ambient.number("a number from 0 to 1", |share| (0.0..=1.0).contains(&share))
    })?;
    let direction = if is_unit(direction) { direction } else { direction.normalize() };
    Ok(Light { direction, ambient })
}

fn colors(table: &Fields<'_>) -> Result<Colors, SceneError> {
    let several = |field: &Field<'_>, expected: &str, counts: std::ops::RangeInclusive<usize>| {
        let colors = field.elements(expected)?;
        if !counts.contains(&colors.len()) {
            return Err(
                field.error(format!("found {} colours", colors.len()), format!("give {expected}"))
            );
        }
        colors.iter().map(Field::color).collect::<Result<Vec<_>, _>>()
    };
    let ramp = table.read("ramp", vec![[0, 0, 255], [255, 0, 0]], |ramp| {
        several(ramp, "an array of 2 to 16 colours, lowest node first", 2..=16)
    })?;
    let checker = table.read("checker", vec![[200, 200, 190], [70, 90, 70]], |checker| {
        several(checker, "an array of 2 colours", 2..=2)
    })?;
    Ok(Colors {
        ramp,
        sky: table.read("sky", [160, 190, 220], Field::color)?,
        far: table.read("far", [160, 190, 220], Field::color)?,
        side: table.read("side", [96, 82, 64], Field::color)?,
        checker: [checker[0], checker[1]],
    })
}

fn hardware(table: &Fields<'_>) -> Result<Hardware, SceneError> {
    Ok(Hardware {
        clock_mhz: table.read("clock_mhz", 100.0, |clock| {
            clock.number("a clock above 0 MHz (from 1e-9 to 1e9)", is_length)
        })?,
        memory_latency: table.read("memory_latency", 2, |cycles| cycles.count(1..=64))?,
        words: table.read("words", WordSize::Auto, |words| {
            words.choice(&[
                ("auto", WordSize::Auto),
                ("narrow", WordSize::Narrow),
                ("wide", WordSize::Wide),
            ])
        })?,
        ratio: table.read("ratio", RatioForm::Array, |ratio| {
            ratio.choice(&[("array", RatioForm::Array), ("serial", RatioForm::Serial)])
        })?,
    })
}

fn formats(scene: &Fields<'_>) -> Result<Vec<(Registers, FormatRequest)>, SceneError> {
    let Some(field) = scene.get("format") else {
        return Ok(Vec::new());
    };
    field
        .open()?
        .all()
        .map(|(name, request)| {
            let registers = format::registers(name)
                .map_err(|(reason, remedy)| request.error(reason, remedy))?;
            Ok((registers, format_request(&request)?))
        })
        .collect()
}

fn format_request(field: &Field<'_>) -> Result<FormatRequest, SceneError> {
    let table = field.table(&keys::FORMAT)?;
    let required = |key: &str, range| {
        let bits = table.get(key).ok_or_else(|| {
            field.error(
                format!("`{key}` is missing"),
                "give width and point, as in { width = 48, point = 30 }",
            )
        })?;
        bits.count(range)
    };
    let width = required("width", 2..=62)?;
    let point = required("point", 0..=width)?;
    let rounding = table.read("rounding", Rounding::default(), |rounding| {
        rounding.choice(&Rounding::ALL.map(|rounding| (rounding.name(), rounding)))
    })?;
    let overflow = table.read("overflow", Overflow::default(), |overflow| {
        overflow.choice(&Overflow::ALL.map(|overflow| (overflow.name(), overflow)))
    })?;
    Ok(FormatRequest { width, point, rounding, overflow })
}

/// Which of two ways to say the same thing a table uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// No key of either is given.
    Neither,
    First,
    Second,
}

/// Chooses between two ways to say the same thing; both at once are an error, but a `--set`
/// option replaces what the file says.
pub(super) fn one_form(
    table: &Fields<'_>,
    first: &[&str],
    second: &[&str],
    remedy: &str,
) -> Result<Form, SceneError> {
    let given = |keys: &[&str], set: bool| {
        keys.iter().filter_map(|key| table.get(key)).find(|field| field.is_set() == set)
    };
    // The options among themselves come first, then the file by itself.
    for set in [true, false] {
        return match (given(first, set), given(second, set)) {
            (Some(a), Some(b)) => Err(both(a, b, remedy)),
            (Some(_), None) if set => Ok(Form::First),
            (None, Some(_)) if set => Ok(Form::Second),
            (Some(_), None) => Ok(Form::First),
            (None, Some(_)) => Ok(Form::Second),
            (None, None) if set => continue,
            (None, None) => Ok(Form::Neither),
        };
    }
    Ok(Form::Neither)
}

fn both(a: Field<'_>, b: Field<'_>, remedy: &str) -> SceneError {
    let offset = |field: &Field<'_>| match field.place() {
        Place::File { line, column, .. } => (line, column),
        Place::Set { .. } => (0, 0),
    };
    let (earlier, later) = if offset(&b) >= offset(&a) { (a, b) } else { (b, a) };
    SceneError::Field {
        place: later.place(),
        field: later.path.clone(),
        reason: format!(
            "this and `{}` ({}) say the same thing twice",
            earlier.path,
            earlier.place().brief()
        ),
        remedy: remedy.to_owned(),
    }
}
