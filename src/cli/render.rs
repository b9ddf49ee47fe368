//! `terraline render`.

mod errors;
mod summary;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::{Args, ValueEnum};

use super::outputs::{self, Named};
use super::scene_args::{Planned, SceneArgs};
use super::scene_out::SceneOut;
use super::{Stop, report};
use errors::Extent;
use crate::engine::{Band, Engine, Machine, Wanted};
use crate::sink::picture::Picture;
use crate::sink::picture::errors::{ErrorPart, ErrorView};
use crate::sink::{npz, png};
use crate::study::error::{PixelError, Sample};

/// Draw one frame and say what it is worth and what it costs.
#[derive(Debug, Args)]
#[command(after_help = "Example: terraline render flight -o flight.png --size 640x480 --repeat 9
Example: terraline render dem.tif -o terrain.png --scene-out terrain.toml")]
pub struct Render {
    #[command(flatten)]
    scene: SceneArgs,

    /// The picture to write, a PNG; without it only the summary is made.
    #[arg(short, long, value_name = "OUT.png")]
    output: Option<PathBuf>,

    /// Engine that draws the frame.
    #[arg(long, value_enum, default_value_t = Engine::Fast)]
    engine: Engine,

    /// What the picture shows.
    #[arg(long, value_enum, default_value_t = Picture::Color)]
    picture: Picture,

    /// Which errors the picture of errors shows: of the machine, or of its two parts; `total` if not
    /// given.
    #[arg(long, value_enum)]
    error: Option<ErrorPart>,

    /// Pixels at the bright end of the picture of errors; as its errors need if not given.
    #[arg(long, value_name = "PIXELS", value_parser = parse_range)]
    range: Option<f64>,

    /// Write every pixel's outcome, ground point, height, normal, steps and colour.
    #[arg(long, value_name = "OUT.npz")]
    buffers: Option<PathBuf>,

    /// Arrays that the file of --buffers holds besides, with commas between.
    #[arg(long, value_enum, value_name = "ARRAYS", value_delimiter = ',')]
    with: Vec<With>,

    #[command(flatten)]
    scene_out: SceneOut,

    /// Draw the frame this many times and report minimum, median and maximum.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    repeat: u32,

    /// Errors are measured on N lines x N columns, one at random in each of N strips, and on up to
    /// 6 N² pixels where errors are likely; `all` for every pixel, 0 for none.
    #[arg(long, value_name = "N|all", default_value = "64", value_parser = Extent::parse)]
    sample: Extent,

    /// One JSON object on stdout.
    #[arg(long)]
    json: bool,
}

/// Arrays that are measured for the buffers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum With {
    /// Total error of every pixel against the oracle, as `error_px`; engines fast and processor.
    Error,
    /// Cycles of every pixel, as `cycles`; engine processor.
    Cycles,
}

/// Pixels beyond which buffers are refused: they hold about 90 bytes each.
const MAX_BUFFERED: usize = 1 << 24;

/// A drawn frame.
struct Drawn<'a> {
    /// What drew it last.
    machine: Machine<'a>,
    band: Band,
    times: Vec<Duration>,
    /// Loading maps and tables.
    setup: Duration,
}

/// A length on the screen.
fn parse_range(text: &str) -> Result<f64, String> {
    let pixels = text.parse().ok().filter(|pixels| (1e-9..=1e9).contains(pixels));
    pixels.ok_or_else(|| "give a number of pixels above 0, for example 0.01".into())
}

impl Render {
    pub fn run(&self) -> Result<(), Stop> {
        let errors = [("--error", self.error.is_some()), ("--range", self.range.is_some())];
        if let Some((option, _)) = errors.iter().find(|(_, given)| *given)
            && self.picture != Picture::Error
        {
            return Err(Stop::BadInput(format!(
                "{option}: it is about the picture of errors; add --picture error"
            )));
        }
        self.check_with()?;
        outputs::check(self.outputs())?;
        let planned = self.scene.load()?;
        outputs::keep_inputs(self.outputs(), &self.scene.inputs(&planned))?;
        outputs::check_endings(self.outputs())?;
        let scene_text = self.scene_out.text(&planned)?;
        let pixels = planned.plan.geometry.columns as usize * planned.plan.geometry.lines as usize;
        let buffers = self.buffers.is_some() || self.picture.needs_buffers();
        // The oracle's frame has buffers always, the picture of errors holds as much.
        let heavy = buffers || self.engine == Engine::Oracle || self.picture == Picture::Error;
        if heavy && pixels > MAX_BUFFERED {
            return Err(Stop::BadInput(format!(
                "--size: {pixels} pixels with their buffers would take gigabytes, at most \
                 {MAX_BUFFERED} are held; draw a smaller frame, or the colour picture with the fast \
                 engine"
            )));
        }
        if self.sample == Extent::All && pixels > MAX_BUFFERED {
            return Err(Stop::BadInput(format!(
                "--sample all: the errors of {pixels} pixels would take gigabytes, at most \
                 {MAX_BUFFERED} are held; draw a smaller frame, or measure a sample of it, for \
                 example with --sample 1024"
            )));
        }
        let mut drawn = report::while_waiting("drawing", || self.draw(&planned, buffers))?;
        let every = self.every_error(&planned, &drawn)?;
        let every = every.as_deref();
        let summary =
            report::while_waiting("measuring", || self.summarise(&planned, &drawn, every))?;
        if let Some(path) = &self.output {
            self.write_picture(path, &drawn.band, every)?;
        }
        if let Some(path) = &self.buffers {
            self.write_buffers(path, &mut drawn.band, every)?;
        }
        self.scene_out.write(scene_text.as_deref())?;
        if self.json {
            return report::json("render", Some(&planned.scene.name), &summary);
        }
        report::print(&self.text(&planned, &summary));
        Ok(())
    }

    /// Refuses arrays that there is no file for, or that the engine does not have.
    fn check_with(&self) -> Result<(), Stop> {
        let refusal = if self.with.is_empty() {
            return Ok(());
        } else if self.buffers.is_none() {
            "--with: it adds arrays to the buffers; add --buffers OUT.npz"
        } else if self.with.contains(&With::Cycles) && self.engine != Engine::Processor {
            "--with cycles: cycles are the processor's; add --engine processor"
        } else if self.with.contains(&With::Error) && !self.engine.is_fixed() {
            "--with error: errors are those of the machine in fixed point; give --engine fast or \
             --engine processor"
        } else {
            return Ok(());
        };
        Err(Stop::BadInput(refusal.into()))
    }

    /// The files to write.
    fn outputs(&self) -> impl Iterator<Item = Named<'_>> {
        let named = [("--output", &self.output), ("--buffers", &self.buffers)];
        named
            .into_iter()
            .filter_map(|(option, path)| Some((option, path.as_deref()?)))
            .chain(self.scene_out.named())
    }

    fn draw<'a>(&self, planned: &'a Planned, buffers: bool) -> Result<Drawn<'a>, Stop> {
        if self.picture == Picture::Cycles && self.engine != Engine::Processor {
            return Err(Stop::BadInput(
                "--picture cycles: cycles are the processor's; add --engine processor".into(),
            ));
        }
        let cycles = self.picture == Picture::Cycles || self.with.contains(&With::Cycles);
        let refused = |error| planned.refused(&error);
        let mut times = Vec::new();
        let mut setup = Duration::ZERO;
        loop {
            let machine = planned.machine_for(self.engine)?;
            let set_up = machine.set_up_time(self.engine).map_err(refused)?;
            setup = setup.max(set_up.memories);
            let start = Instant::now();
            let wanted = Wanted { first_line: 0, buffers, cycles };
            let band = machine.scan(self.engine, wanted).map_err(refused)?.finish();
            times.push(set_up.coefficients + start.elapsed());
            if times.len() == self.repeat as usize {
                return Ok(Drawn { machine, band, times, setup });
            }
        }
    }

    /// The errors of all pixels where a file shows them.
    fn every_error(
        &self,
        planned: &Planned,
        drawn: &Drawn<'_>,
    ) -> Result<Option<Vec<PixelError>>, Stop> {
        let pictured = self.output.is_some() && self.picture == Picture::Error;
        if !pictured && !self.with.contains(&With::Error) {
            return Ok(None);
        }
        let every = report::while_waiting("asking the oracle", || {
            drawn.machine.errors(&Sample::all(&planned.plan))
        });
        every.map(Some).map_err(|error| planned.refused(&error))
    }

    fn write_picture(
        &self,
        path: &Path,
        band: &Band,
        every: Option<&[PixelError]>,
    ) -> Result<(), Stop> {
        let frame = &band.frame;
        let errors = every.filter(|_| self.picture == Picture::Error).map(Band::of_errors);
        let view = ErrorView { part: self.error.unwrap_or_default(), high: self.range };
        let painted = self.picture.with(errors.as_ref().unwrap_or(band), view);
        let painted = painted.unwrap_or_else(|| unreachable!("it was drawn"));
        png::write(path, frame.columns, frame.lines, &painted.pixels)?;
        if let Some(legend) = painted.legend {
            eprintln!(
                "{}: {} to {} {}{}",
                self.picture.name(),
                report::digits(legend.low),
                report::digits(legend.high),
                legend.unit,
                if legend.logarithmic { ", logarithmic" } else { "" }
            );
        }
        Ok(())
    }

    /// Writes buffers with the arrays that are asked for besides.
    fn write_buffers(
        &self,
        path: &Path,
        band: &mut Band,
        every: Option<&[PixelError]>,
    ) -> Result<(), Stop> {
        if let Some(buffers) = &mut band.frame.buffers {
            if self.with.contains(&With::Error) {
                let errors = every.unwrap_or_default().iter();
                buffers.error_px = errors.map(|pixel| pixel.total_px).collect();
            }
            if self.with.contains(&With::Cycles) {
                buffers.cycles = std::mem::take(&mut band.cycles);
            }
        }
        Ok(npz::write(path, &band.frame)?)
    }
}
