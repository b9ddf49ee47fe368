//! Reports of errors: what is counted, which quantiles lost pixels enter, and what suspects find.

mod support;

use support::{builtin, loaded, machine, plan};
use terraline::frame::Hit;
use terraline::study::error::{
    Counts, ErrorReport, Outcomes, PixelError, Sample, Sheet, Spread, Worst,
};

/// A pixel whose lengths are multiples of a number, as [`Spread`] is asked about them.
fn pixel(n: u32, sheet: Sheet, machine: Hit, oracle: Hit) -> PixelError {
    let times = |factor: u32| match sheet {
        Sheet::Same => f64::from(factor * n),
        Sheet::Lost => f64::INFINITY,
        _ => f64::NAN,
    };
    PixelError {
        line: n / 50,
        column: n % 50,
        sheet,
        machine,
        oracle,
        total_px: times(1),
        algorithm_px: times(2),
        quantisation_px: times(3),
        total: times(4),
        algorithm: times(5),
        quantisation: times(6),
        height: times(7),
        color: (n % 8) as u8,
    }
}

fn same(n: u32) -> PixelError {
    pixel(n, Sheet::Same, Hit::Surface, Hit::Surface)
}

fn sample() -> Sample {
    Sample { lines: (0..41).collect(), columns: (0..50).collect() }
}

#[test]
fn a_report_sums_up_its_pixels() {
    let pixels: Vec<PixelError> = (1..=2000).rev().map(same).collect();
    let report = ErrorReport::new(&sample(), &pixels, 0.5);
    // Of 1 to 2000, a metre being two units.
    for (spread, factor) in [
        (report.total_px, 1.0),
        (report.algorithm_px, 2.0),
        (report.quantisation_px, 3.0),
        (report.total_m, 2.0),
        (report.algorithm_m, 2.5),
        (report.quantisation_m, 3.0),
        (report.height_m, 3.5),
    ] {
        let Spread { median, p999, max } = spread.expect("pixels");
        assert_eq!([median, p999, max], [1000.0, 1998.0, 2000.0].map(|n| n * factor));
    }
    assert_eq!((report.sampled_lines, report.sampled_columns), (41, 50));
    assert_eq!(report.counts.same_sheet, 2000);
    assert_eq!(report.color_within_2, 3.0 / 8.0);
    let Worst { column, line, error_px, .. } = report.worst.expect("a pixel");
    assert_eq!((column, line, error_px), (0, 40, Some(2000.0)));
}

#[test]
fn every_kind_of_pixel_is_counted() {
    use Hit::{OutOfRange, Side, Sky, Surface};
    let kinds = [
        (Sheet::Lost, Surface, Surface, 5),
        (Sheet::Lost, Sky, Surface, 4),
        (Sheet::Lost, Side, Surface, 3),
        (Sheet::Lost, OutOfRange, Surface, 2),
        (Sheet::Ghost, Surface, Sky, 6),
        (Sheet::Ghost, Surface, Side, 7),
        (Sheet::Ghost, Surface, OutOfRange, 1),
        (Sheet::Flip, OutOfRange, Sky, 8),
        (Sheet::Flip, Side, Sky, 9),
        (Sheet::Empty, Sky, Sky, 10),
        (Sheet::Same, Surface, Surface, 11),
    ];
    let of = |(sheet, machine, oracle, times): (Sheet, Hit, Hit, usize)| {
        std::iter::repeat_n(pixel(3, sheet, machine, oracle), times)
    };
    let pixels: Vec<PixelError> = kinds.into_iter().flat_map(of).collect();
    let expected = Counts {
        pixels: 66,
        reference: 25,
        same_sheet: 11,
        lost: Outcomes { total: 14, surface: 5, side: 3, sky: 4, out_of_range: 2 },
        ghosts: Outcomes { total: 14, surface: 0, side: 7, sky: 6, out_of_range: 1 },
        flips: Outcomes { total: 17, surface: 0, side: 9, sky: 0, out_of_range: 8 },
    };
    assert_eq!(Counts::of(&pixels), expected);
}

#[test]
fn lost_pixels_are_infinitely_far_off() {
    // Of 1000 reference pixels one may be lost before 99.9 % are, and half before the median is.
    for (lost, p999, median) in [(1, 999.0, 500.0), (2, f64::INFINITY, 500.0)] {
        let mut pixels: Vec<PixelError> = (1..=1000 - lost).map(same).collect();
        let gone = |n| pixel(n, Sheet::Lost, Hit::Sky, Hit::Surface);
        pixels.extend((1..=lost).map(gone));
        // What the oracle does not see as surface is no reference.
        pixels.extend((1..500).map(|n| pixel(n, Sheet::Ghost, Hit::Surface, Hit::Sky)));
        let report = ErrorReport::new(&sample(), &pixels, 1.0);
        let spread = report.total_px.expect("pixels");
        let largest = f64::from(1000 - lost);
        assert_eq!((spread.median, spread.p999, spread.max), (median, p999, largest));
        let worst = report.worst.expect("a pixel");
        assert_eq!((worst.sheet, worst.error_px), (Sheet::Lost, None));
    }
    let pixels: Vec<PixelError> =
        (1..4).map(|n| pixel(n, Sheet::Lost, Hit::Sky, Hit::Surface)).collect();
    let spread = ErrorReport::new(&sample(), &pixels, 1.0).total_px.expect("pixels");
    assert!(spread.median.is_infinite() && spread.max.is_nan());
}

/// Suspects leave quantiles and shares as they are.
#[test]
fn suspects_find_what_a_grid_misses() {
    let scene = builtin("overview", 512, 512);
    let plan = plan(&scene);
    let machine = machine(&scene, &plan).expect("a machine");
    let all = Sample::all(&plan);
    let whole = ErrorReport::new(&all, &machine.errors(&all).expect("errors"), scene.unit_m);
    let grid = Sample::strips(&plan, 32, scene.seed);
    let alone = ErrorReport::new(&grid, &machine.errors(&grid).expect("errors"), scene.unit_m);
    let suspects = machine.suspects(12_000, &grid).expect("suspects");
    assert!(suspects.len() > 10_000 && suspects.len() <= 12_000, "{}", suspects.len());
    let found = machine.suspect_errors(&suspects).expect("errors");
    assert_eq!(found.len(), suspects.len());
    assert!(found.iter().all(|pixel| !grid.contains(pixel.line, pixel.column)));
    let places: std::collections::HashSet<_> = found.iter().map(|p| (p.line, p.column)).collect();
    assert_eq!(places.len(), found.len(), "every pixel once");
    let report = alone.clone().with_suspects(&suspects, &found, scene.unit_m);

    let lost = |report: &ErrorReport| {
        let suspects = report.suspects.as_ref().map_or(0, |s| s.counts.lost.total);
        report.counts.lost.total + suspects
    };
    println!("{} lost of {}, {report:?}", lost(&report), lost(&whole));
    assert_eq!(lost(&alone), 0, "the grid would do by itself");
    assert!(lost(&whole) > 10 && 4 * lost(&report) >= 3 * lost(&whole));
    let [all, both, own] = [&whole, &report, &alone].map(|r| r.total_m.expect("pixels"));
    assert!(both.max > own.max && both.max > 0.5 * all.max, "{own:?}, {both:?}, {all:?}");
    assert_eq!((both.median, both.p999), (own.median, own.p999));
    assert_eq!(report.counts, alone.counts);
    assert_eq!(report.worst.expect("a pixel").sheet, Sheet::Lost);
}

#[test]
fn a_horizon_row_out_of_range_is_counted() {
    // With an odd number of lines the middle one looks along the plane.
    let scene = loaded("plane", &["screen.size=[64, 49]", "camera.pitch=0"]);
    let plan = plan(&scene);
    let machine = machine(&scene, &plan).expect("a machine");
    let all = Sample::all(&plan);
    let counts = Counts::of(&machine.errors(&all).expect("errors"));
    assert_eq!((counts.flips.total, counts.flips.out_of_range), (64, 64), "{counts:?}");
    assert_eq!((counts.lost.total, counts.ghosts.total), (0, 0), "{counts:?}");
}
