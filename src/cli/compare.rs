//! `terraline compare`.

use std::path::PathBuf;

use clap::Args;

use super::{Stop, outputs, report};
use crate::sink::png;
use crate::study::compare::{Comparison, compare_files, difference_picture, gain};

/// Compare two frames (PNG) or two sets of buffers (npz).
#[derive(Debug, Args)]
#[command(after_help = "Example: terraline compare fast.png processor.png --max-diff 0")]
pub struct Compare {
    /// The first frame or buffers.
    a: PathBuf,

    /// The file it is compared with, of the same kind.
    b: PathBuf,

    /// Exit 1 if any value differs by more than this.
    #[arg(long, value_name = "D")]
    max_diff: Option<f64>,

    /// Write the absolute difference of two pictures as a PNG, amplified so that 95 % of the pixels
    /// that differ stay below full brightness.
    #[arg(short, long, value_name = "OUT.png")]
    output: Option<PathBuf>,

    /// One JSON object on stdout.
    #[arg(long)]
    json: bool,
}

impl Compare {
    pub fn run(&self) -> Result<(), Stop> {
        if self.max_diff.is_some_and(|limit| !(limit >= 0.0 && limit.is_finite())) {
            return Err(Stop::BadInput(
                "--max-diff: give a number of at least 0, for example --max-diff 2".into(),
            ));
        }
        if let Some(path) = &self.output {
            let output = [("--output", path.as_path())];
            outputs::check(output)?;
            outputs::keep_inputs(output, &[self.a.clone(), self.b.clone()])?;
            outputs::check_endings(output)?;
        }
        let comparison = compare_files(&self.a, &self.b)?;
        if let Some(path) = &self.output {
            let Comparison::Picture(pictures) = &comparison else {
                return Err(Stop::BadInput(
                    "-o: a difference picture needs two PNGs, these are buffers; leave -o out"
                        .into(),
                ));
            };
            let full = pictures.p95_difference;
            let gain = gain(full);
            let difference = difference_picture(&png::read(&self.a)?, &png::read(&self.b)?, gain)?;
            png::write(path, difference.columns, difference.lines, &difference.pixels)?;
            eprintln!(
                "wrote {}: differences times {gain}, black where there is none; of the pixels that \
                 differ, 95 % lie within {full} levels, larger differences than {} are as bright as it",
                path.display(),
                255 / gain
            );
        }
        if self.json {
            report::json("compare", None, &comparison)?;
        } else {
            report::print(&comparison.to_string());
        }
        let Some(limit) = self.max_diff else { return Ok(()) };
        let beyond = comparison.beyond(limit);
        if beyond.is_empty() {
            return Ok(());
        }
        eprintln!("beyond --max-diff {limit}: {}", beyond.join(", "));
        Err(Stop::Failure)
    }
}
