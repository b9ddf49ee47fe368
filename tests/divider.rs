//! The ratio unit: the non-restoring array, the host's own division, and their definition.

mod scenes;
mod support;

use glam::DVec3;
use proptest::prelude::*;
use terraline::plan::Plan;
use terraline::scene::{Attitude, Scene, Surface, WordSize};
use terraline::unit::Unit as _;
use terraline::unit::divider::Method;
use terraline::unit::line::Entry;
use terraline::word::array::{direct, non_restoring};
use terraline::word::stock::{Ground32, Ground64, Narrow, View32, View64, Wide};
use terraline::word::{Complete, Divide, Load, Ratio, Readout, Site};

fn site() -> Site {
    Site::pixel(0, 0)
}

/// Floor of the exact ratio times 2^shift, where it lies in `-2^(bits-1) .. 2^(bits-1)`.
fn floor_ratio(numerator: i128, denominator: i128, shift: i32, bits: u32) -> Option<i128> {
    let quotient = (numerator << shift.max(0)).div_euclid(denominator << (-shift).max(0));
    let limit = 1 << (bits - 1);
    (-limit..limit).contains(&quotient).then_some(quotient)
}

/// Any word, and often those near the ends, near zero and near powers of two.
fn corner_cases(width: u32) -> impl Strategy<Value = i64> {
    let (low, high) = (i64::MIN >> (64 - width), i64::MAX >> (64 - width));
    prop_oneof![
        low..=high,
        (0..width - 1, -2..=2_i64).prop_map(|(place, by)| (1_i64 << place) + by),
        (0..width - 1, -2..=2_i64).prop_map(|(place, by)| -(1_i64 << place) + by),
        (0..=3_i64).prop_map(move |by| high - by),
        (0..=3_i64).prop_map(move |by| low + by),
        -3..=3_i64,
    ]
    .prop_map(move |value| value.clamp(low, high))
}

fn positive(width: u32) -> impl Strategy<Value = i64> {
    corner_cases(width).prop_map(move |value| {
        value.checked_abs().unwrap_or(i64::MAX).clamp(1, i64::MAX >> (64 - width))
    })
}

/// Numerators a step away from the ends of the range: `(±2^(bits-1))·denominator / 2^shift`.
fn at_the_ends(denominator: i128, shift: i32, bits: u32) -> impl Iterator<Item = i128> {
    let end = (denominator << (bits - 1) << (-shift).max(0)) >> shift.max(0);
    (-2..=2).flat_map(move |by| [end + by, -end + by])
}

fn view32(bits: i64) -> View32 {
    View32::load(bits as f64 / (1_i64 << 30) as f64, ()).expect("a word of 32 bits")
}

/// Words of 64 bits are put together, since `f64` does not hold them all.
fn view64(bits: i64) -> View64 {
    let part = |bits: i64| View64::load(bits as f64 / (1_i64 << 38) as f64, ()).expect("a word");
    part(bits & !0xffff_ffff) + part(bits & 0xffff_ffff)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4096, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_array_is_the_floor(
        n in corner_cases(64), d in positive(64), shift in -20..=48_i32, bits in 1..=40_u32,
    ) {
        let (n, d) = (i128::from(n), i128::from(d));
        let expected = floor_ratio(n, d, shift, bits);
        prop_assert_eq!(non_restoring(n, d, shift, bits), expected);
        prop_assert_eq!(direct(n, d, shift, bits), expected);
    }

    #[test]
    fn the_array_is_the_floor_near_the_ends_of_its_range(
        d in positive(48), shift in -20..=32_i32, bits in 1..=48_u32,
    ) {
        let d = i128::from(d);
        for n in at_the_ends(d, shift, bits) {
            let expected = floor_ratio(n, d, shift, bits);
            prop_assert_eq!(non_restoring(n, d, shift, bits), expected, "{}", n);
            prop_assert_eq!(direct(n, d, shift, bits), expected, "{}", n);
        }
    }

    #[test]
    fn narrow_direct_equals_array_and_floor(
        n in corner_cases(32), d in positive(32), exponent in -40..=40_i32, range in 0..=11_u32,
    ) {
        check_narrow(n, d, exponent, range)?;
        let shift = exponent + 20;
        for end in at_the_ends(d.into(), shift, range + 21) {
            if i32::try_from(end).is_ok() {
                check_narrow(end as i64, d, exponent, range)?;
            }
        }
    }

    #[test]
    fn wide_direct_equals_array_and_floor(
        n in corner_cases(64), d in positive(64), exponent in -36..=30_i32, range in 0..=23_u32,
    ) {
        check_wide(n, d, exponent, range)?;
        let shift = exponent + 24;
        for end in at_the_ends(d.into(), shift, range + 25) {
            if let Ok(end) = i64::try_from(end) {
                check_wide(end, d, exponent, range)?;
            }
        }
    }
}

fn check_narrow(n: i64, d: i64, exponent: i32, range: u32) -> Result<(), TestCaseError> {
    let ratio = Ratio { exponent, range, format: () };
    let expected = floor_ratio(n.into(), d.into(), exponent + 20, range + 21);
    let (n, d) = (view32(n), view32(d));
    let array: Option<Ground32> = n.divide_array(d, ratio, site());
    let direct: Option<Ground32> = n.divide_direct(d, ratio, site());
    prop_assert_eq!(array.and_then(Readout::raw).map(i128::from), expected);
    prop_assert_eq!(array, direct);
    Ok(())
}

fn check_wide(n: i64, d: i64, exponent: i32, range: u32) -> Result<(), TestCaseError> {
    let ratio = Ratio { exponent, range, format: () };
    let expected = floor_ratio(n.into(), d.into(), exponent + 24, range + 25);
    let (n, d) = (view64(n), view64(d));
    let array: Option<Ground64> = n.divide_array(d, ratio, site());
    let direct: Option<Ground64> = n.divide_direct(d, ratio, site());
    prop_assert_eq!(array.and_then(Readout::raw).map(i128::from), expected);
    prop_assert_eq!(array, direct);
    Ok(())
}

#[test]
fn out_of_range_is_none_exactly_beyond_the_ends() {
    // Quotients of one bit: -1 and 0 fit. Eight bits: -128 ..= 127.
    let fits = |n, bits| non_restoring(n, 7, 0, bits);
    assert_eq!(fits(-7, 1), Some(-1));
    assert_eq!(fits(-8, 1), None);
    assert_eq!(fits(6, 1), Some(0));
    assert_eq!(fits(7, 1), None);
    assert_eq!(fits(-128 * 7, 8), Some(-128));
    assert_eq!(fits(-128 * 7 - 1, 8), None);
    assert_eq!(fits(128 * 7 - 1, 8), Some(127));
    assert_eq!(fits(128 * 7, 8), None);
    assert_eq!(fits(0, 8), Some(0));
    assert_eq!(fits(-1, 8), Some(-1));
}

/// Runs the divider of a scene on every line, by the array and directly, and compares all wires.
fn both_ways_agree<W: Complete>(world: W, scene: &Scene) -> usize {
    let (_, setup) = scenes::machine(world, scene, false);
    let units = &setup.surfaces[0];
    let divider = units.divider.as_ref().expect("a divider");
    let mut line = terraline::unit::Line::new(&world, 0..setup.columns);
    let mut start = units.projector.first_line();
    let mut met = 0;
    for number in 0..setup.lines {
        line.number = number;
        line.start = vec![start];
        units.projector.run(&mut line);
        let mut direct = line.clone();
        divider.run_by(Method::Array, &mut line);
        divider.run_by(Method::Direct, &mut direct);
        for i in 0..line.len() {
            assert_eq!(
                (line.entry[i], line.entry_x[i].raw(), line.entry_z[i].raw()),
                (direct.entry[i], direct.entry_x[i].raw(), direct.entry_z[i].raw()),
                "line {number}, column {i}, exponent {}",
                divider.ratio_x.exponent
            );
        }
        met += line.entry.iter().filter(|&&entry| entry == Entry::Met).count();
        units.projector.next_line(&mut start);
    }
    met
}

fn planes_divide_alike(heights: &[f64]) {
    let mut met = 0;
    for &y in heights {
        let mut drawn = 0;
        for checker in [1e-6, 1e-3, 1.0, 8.0, 1000.0] {
            let eye = DVec3::new(3.0 * checker, y, -5.0 * checker);
            let at = |words| scenes::plane_scene(eye, checker, words);
            // An eye so near that positions are coarser than pixels is refused.
            let planned = |scene: &Scene| Plan::new(scene, None, false).is_ok();
            let (narrow, wide) = (at(WordSize::Narrow), at(WordSize::Wide));
            println!("height {y}, squares of {checker}");
            if planned(&narrow) {
                met += both_ways_agree(Narrow, &narrow);
                drawn += 1;
            }
            if planned(&wide) {
                met += both_ways_agree(Wide, &wide);
                drawn += 1;
            }
        }
        assert!(drawn > 1, "height {y} is drawn");
    }
    assert!(met > 4000, "{met} pixels meet a plane");
}

#[test]
fn planes_seen_from_close_by_divide_alike_both_ways() {
    planes_divide_alike(&[1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9, 0.0]);
}

#[test]
fn planes_seen_from_high_above_divide_alike_both_ways() {
    planes_divide_alike(&[1.0, 50.0, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9]);
}

#[test]
fn a_map_seen_from_high_above_towards_the_horizon_divides_alike_both_ways() {
    let mut met = 0;
    // The first of them looks down on the map, too.
    for (y, lines) in [(20.0, 200), (20.0, 12), (1000.0, 12), (1000.0, 2), (1400.0, 2)] {
        println!("height {y}, {lines} lines");
        let map = scenes::terrain(2, 2, vec![0.0, 1.0, 2.0, 3.0]);
        let mut scene =
            scenes::scene(Surface::Terrain(map), DVec3::new(-300.0, y, -5.0), WordSize::Narrow);
        scene.camera.attitude = Attitude::Directions { forward: DVec3::X, up: DVec3::Y };
        scene.screens[0].lines = lines;
        scene.screens[0].columns = 500;
        met += both_ways_agree(Narrow, &scene);
        scene.machine.words = WordSize::Wide;
        met += both_ways_agree(Wide, &scene);
    }
    assert!(met > 10_000, "{met} pixels meet the slab");
}

#[test]
fn a_usual_plane_is_met_everywhere() {
    let scene = scenes::plane_scene(DVec3::new(3.0, 10.0, -5.0), 8.0, WordSize::Narrow);
    assert_eq!(both_ways_agree(Narrow, &scene), 16 * 12);
}

#[test]
fn ratios_of_any_exponent_keep_to_the_floor() {
    for bits in [8, 32, 49] {
        for (n, d) in [(1_i128, 1_i128), (-1, 1), (7, 3), (-7, 3), (1 << 38, (1 << 39) - 1), (0, 5)]
        {
            for shift in [-300, -128, -127, -64, 64, 100, 126, 127, 128, 300] {
                let expected = match (n, shift > 0) {
                    (0, _) => Some(0),
                    // Beyond every range.
                    (_, true) => None,
                    (n, false) => Some(if n < 0 { -1 } else { 0 }),
                };
                assert_eq!(non_restoring(n, d, shift, bits), expected, "{n}/{d} · 2^{shift}");
                assert_eq!(direct(n, d, shift, bits), expected, "{n}/{d} · 2^{shift}");
            }
        }
    }
}
