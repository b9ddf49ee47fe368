//! How errors are measured and told.

use serde::Serialize;

use super::super::report;
use crate::engine::Machine;
use crate::frame::Hit;
use crate::setup::SetupError;
use crate::study::error::{
    Counts, ErrorReport, Outcomes, PixelError, Sample, Sheet, Spread, Worst,
};
use crate::word::Register;

/// Suspects that are measured for each pixel of the sample.
const SUSPECTS: usize = 6;

/// On which pixels errors are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// Every one.
    All,
    /// A line and a column at random in each of so many strips, and suspects.
    Strips(u32),
}

impl Extent {
    /// Most strips.
    const MOST: u32 = 4096;

    /// `all`, or a number of strips.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        match text.parse() {
            _ if text == "all" => Ok(Self::All),
            Ok(strips) if strips <= Self::MOST => Ok(Self::Strips(strips)),
            _ => Err(format!("give `all`, or a number of lines and columns up to {}", Self::MOST)),
        }
    }

    /// Measures a machine's errors there; nothing where that is on no pixel. Those of `every` pixel
    /// are not measured again where they are known.
    pub(super) fn measure(
        self,
        machine: &Machine<'_>,
        every: Option<&[PixelError]>,
    ) -> Result<Option<ErrorReport>, SetupError> {
        let (plan, scene) = (machine.plan(), machine.scene());
        let sample = match self {
            Self::Strips(0) => return Ok(None),
            Self::All => Sample::all(plan),
            Self::Strips(count) => Sample::strips(plan, count, scene.seed),
        };
        let whole = sample == Sample::all(plan);
        let measured;
        let pixels = match every.filter(|_| whole) {
            Some(every) => every,
            None => {
                measured = machine.errors(&sample)?;
                &measured
            }
        };
        let report = ErrorReport::new(&sample, pixels, scene.unit_m);
        if whole {
            return Ok(Some(report));
        }
        let suspects = machine.suspects(SUSPECTS * sample.len(), &sample)?;
        let pixels = machine.suspect_errors(&suspects)?;
        Ok(Some(report.with_suspects(&suspects, &pixels, scene.unit_m)))
    }
}

/// The pixel to look at first.
#[derive(Serialize)]
pub(super) struct Pointed {
    column: u32,
    line: u32,
    /// What is wrong with it.
    why: String,
    /// Only where machine and oracle are on one sheet.
    error_px: Option<f64>,
    /// The command that explains it.
    explain: String,
}

impl Pointed {
    /// A lost pixel, else an overflow (register, pixels, first as line and column), else what is
    /// worst.
    pub(super) fn new(
        errors: Option<&ErrorReport>,
        overflow: Option<&(Register, u64, (u32, u32))>,
        invocation: &str,
    ) -> Option<Self> {
        let worst = errors.and_then(|errors| errors.worst);
        let lost = worst.filter(|worst| worst.sheet == Sheet::Lost);
        let (column, line, why, error_px) = match (lost, overflow, worst) {
            (None, Some((register, _, (line, column))), _) => {
                (*column, *line, format!("{register} overflows"), None)
            }
            (_, _, Some(worst)) => (worst.column, worst.line, why(&worst), worst.error_px),
            _ => return None,
        };
        let explain = format!("terraline explain {invocation} --pixel {column},{line}");
        Some(Self { column, line, why, error_px, explain })
    }

    /// The line about it.
    pub(super) fn line(&self) -> String {
        format!(
            "  worst     column {}, line {}: {}; {}",
            self.column, self.line, self.why, self.explain
        )
    }
}

fn why(worst: &Worst) -> String {
    let (machine, oracle) = (worst.machine.name(), worst.oracle.name());
    match (worst.sheet, worst.error_px) {
        (Sheet::Same, Some(error)) => format!("{} pixels off", report::digits(error)),
        (Sheet::Lost, _) if worst.machine == Hit::Surface => {
            "lost, another sheet of the surface".into()
        }
        (Sheet::Lost, _) => format!("lost, {machine} instead of surface"),
        (Sheet::Ghost, _) => format!("a ghost, surface instead of {oracle}"),
        _ => format!("{machine} instead of {oracle}"),
    }
}

/// Errors in words; `invocation` is the scene with its options, as on a command line.
pub(super) fn lines(errors: &ErrorReport, invocation: &str) -> Vec<String> {
    let Counts { pixels, reference, .. } = errors.counts;
    let (lines, columns) = (errors.sampled_lines, errors.sampled_columns);
    let mut out = match &errors.suspects {
        None => vec![format!(
            "  error     against the oracle on all {pixels} pixels, over the {reference} with surface"
        )],
        Some(suspects) => vec![
            format!(
                "  error     against the oracle; median and 99.9 % on a random grid of {lines} lines x \
                 {columns} columns, over its"
            ),
            format!(
                "            {reference} pixels with surface; max also on {} suspects beside it: {} at rims, \
                 {} far",
                suspects.counts.pixels, suspects.rims, suspects.far
            ),
        ],
    };
    out.push(format!(
        "            {:<13} {:>9} {:>9} {:>9}    {:>9} {:>9} {:>9}",
        "", "median", "99.9 %", "max", "median", "99.9 %", "max"
    ));
    out.push(row("total", errors.total_px, errors.total_m));
    out.push(row("algorithm", errors.algorithm_px, errors.algorithm_m));
    out.push(row("quantisation", errors.quantisation_px, errors.quantisation_m));
    out.push(format!("            colour within 2 levels on {:.2} %", 100.0 * errors.color_within_2));
    let lost = [("another sheet", SHEET), ("side", SIDE), ("sky", SKY), ("out of range", FAR)];
    out.push(told("lost", errors, LOST, &lost));
    let others = [("side", SIDE), ("sky", SKY), ("out of range", FAR)];
    let found = |pick: Pick| {
        pick(&errors.counts).total + errors.suspects.as_ref().map_or(0, |s| pick(&s.counts).total)
    };
    for (name, pick) in [("ghosts", GHOSTS), ("flips", FLIPS)] {
        // Rare: README.md says what they are.
        if found(pick) > 0 {
            out.push(told(name, errors, pick, &others));
        }
    }
    if errors.suspects.is_some() {
        out.push(format!(
            "  unseen    what is rarer than 1 in {pixels} pixels may lie on none of these; every pixel: terraline \
             render {invocation} --sample all"
        ));
    }
    out
}

/// A kind of pixel in which machine and oracle disagree.
type Pick = fn(&Counts) -> Outcomes;

const LOST: Pick = |counts| counts.lost;
const GHOSTS: Pick = |counts| counts.ghosts;
const FLIPS: Pick = |counts| counts.flips;

/// A part of some outcomes.
type Part = fn(&Outcomes) -> usize;

const SHEET: Part = |outcomes| outcomes.surface;
const SIDE: Part = |outcomes| outcomes.side;
const SKY: Part = |outcomes| outcomes.sky;
const FAR: Part = |outcomes| outcomes.out_of_range;

/// The line about a kind of pixel, with the parts that occur.
fn told(
    name: &str,
    errors: &ErrorReport,
    pick: Pick,
    parts: &[(&str, Part)],
) -> String {
    let count = |outcomes: Outcomes| {
        let parts: Vec<String> = parts
            .iter()
            .map(|(name, part)| (part(&outcomes), name))
            .filter(|(count, _)| *count > 0)
            .map(|(count, name)| format!("{count} {name}"))
            .collect();
        match outcomes.total {
            0 => "none".to_owned(),
            total => format!("{total} ({})", parts.join(", ")),
        }
    };
    let own = count(pick(&errors.counts));
    match &errors.suspects {
        None => format!("  {name:<9} {own} of all pixels"),
        Some(suspects) => {
            format!("  {name:<9} {own} on the grid, {} of the suspects", count(pick(&suspects.counts)))
        }
    }
}

fn row(name: &str, px: Option<Spread>, m: Option<Spread>) -> String {
    let (Some(px), Some(m)) = (px, m) else {
        return format!("            {name:<13} no pixel with surface");
    };
    let figure = |value: f64| match value {
        _ if value.is_finite() => report::digits(value),
        _ if value.is_infinite() => "lost".to_owned(),
        _ => "none".to_owned(),
    };
    format!(
        "            {name:<13} {:>9} {:>9} {:>9} px {:>9} {:>9} {:>9} m",
        figure(px.median),
        figure(px.p999),
        figure(px.max),
        figure(m.median),
        figure(m.p999),
        figure(m.max)
    )
}
