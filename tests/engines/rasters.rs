//! Both engines on rasters of one line or one column, and with ratios at the ends of their range.

use super::support::{both, builtin, count, difference, drawn, map, over, plan};
use glam::DVec3;
use terraline::frame::Hit;
use terraline::plan::{Plan, WordClass};
use terraline::scene::{Angles, Attitude, Extent, Scene, StepperMode, Surface, WordSize};

fn turned(mut scene: Scene, heading: f64, pitch: f64, roll: f64) -> Scene {
    scene.camera.attitude = Attitude::Angles(Angles {
        heading: heading.to_radians(),
        pitch: pitch.to_radians(),
        roll: roll.to_radians(),
    });
    scene
}

/// Both engines give one frame, in both word sizes where they can be proved. Returns the pixels
/// that met something, and what went wrong.
fn check(what: &str, scene: &Scene, wrong: &mut Vec<String>) -> usize {
    let mut met = 0;
    for words in [WordSize::Narrow, WordSize::Wide] {
        let mut scene = scene.clone();
        scene.machine.words = words;
        let Ok(plan) = Plan::new(&scene, None, false) else { continue };
        let drawn = std::panic::catch_unwind(|| both(&scene, &plan));
        match drawn {
            Err(_) => wrong.push(format!("{what}, {}: panicked", plan.words.name)),
            Ok(Err(error)) => wrong.push(format!("{what}, {}: {error}", plan.words.name)),
            Ok(Ok((processor, fast))) => {
                met += count(&processor, Hit::Surface);
                if let Some(difference) = difference(&processor, &fast) {
                    wrong.push(format!("{what}, {}: {difference}", plan.words.name));
                }
            }
        }
    }
    met
}

fn none(wrong: &[String]) {
    let first = &wrong[..wrong.len().min(20)];
    assert!(wrong.is_empty(), "{} failures, the first:\n{}", wrong.len(), first.join("\n"));
}

#[test]
fn thin_rasters_are_drawn_alike() {
    let mut wrong = Vec::new();
    let mut met = 0;
    for name in super::support::SCENES {
        for (columns, lines) in [(1, 1), (1, 2), (2, 1), (1, 77), (77, 1), (3, 2), (37, 23)] {
            for fov in [10.0_f64, 60.0, 100.0, 150.0] {
                let mut scene = builtin(name, columns, lines);
                scene.screens[0].extent = Extent::FieldOfView(fov.to_radians());
                let what = format!("{name}, {columns}x{lines}, {fov} degrees");
                met += check(&what, &scene, &mut wrong);
            }
        }
    }
    none(&wrong);
    assert!(met > 5000, "{met} pixels met something");
}

#[test]
fn level_lines_are_drawn_alike() {
    // A line that looks almost along the ground has a denominator close to zero in every pixel.
    let mut wrong = Vec::new();
    let mut met = 0;
    for name in super::support::SCENES {
        for (columns, lines) in [(1, 1), (64, 1), (63, 3), (1, 5)] {
            for pitch in [0.0, -1e-12, -1e-6, -1e-3, -0.05, 0.05] {
                for roll in [0.0, 180.0, 0.001, 90.0] {
                    let scene = turned(builtin(name, columns, lines), 30.0, pitch, roll);
                    let what = format!("{name}, {columns}x{lines}, pitch {pitch}, roll {roll}");
                    met += check(&what, &scene, &mut wrong);
                }
            }
        }
    }
    none(&wrong);
    assert!(met > 10_000, "{met} pixels met something");
}

#[test]
fn planes_are_drawn_alike_from_every_height() {
    let mut wrong = Vec::new();
    let mut met = 0;
    for checker in [1e-3, 1.0, 8.0, 1e4, 1e9] {
        for exponent in -9..=9 {
            for sign in [1.0, -1.0] {
                for pitch in [-10.0, -90.0, -0.01] {
                    let mut scene = turned(builtin("plane", 33, 29), 0.0, sign * pitch, 0.0);
                    let height = sign * 10_f64.powi(exponent);
                    scene.camera.position = DVec3::new(3.0, height, -2.0);
                    let Surface::Plane(plane) = &mut scene.surfaces[0] else { panic!("a plane") };
                    plane.checker = checker;
                    let what = format!("squares of {checker}, eye at {height}, pitch {pitch}");
                    met += check(&what, &scene, &mut wrong);
                }
            }
        }
    }
    none(&wrong);
    assert!(met > 100_000, "{met} pixels met something");
}

#[test]
fn planes_of_every_direction_are_drawn_alike() {
    let mut wrong = Vec::new();
    let mut met = 0;
    for normal in [DVec3::X, DVec3::Z, DVec3::new(1.0, 2.0, -3.0), DVec3::NEG_Y] {
        for distance in [-40.0, -0.25, 0.0, 7.0, 300.0] {
            for heading in [0.0, 90.0, 7200.0 + 200.0, -5000.0] {
                let mut scene = turned(builtin("plane", 31, 17), heading, -20.0, 33.0);
                let Surface::Plane(plane) = &mut scene.surfaces[0] else { panic!("a plane") };
                plane.normal = normal.normalize();
                plane.distance = distance;
                let what = format!("normal {normal}, distance {distance}, heading {heading}");
                met += check(&what, &scene, &mut wrong);
            }
        }
    }
    none(&wrong);
    assert!(met > 5000, "{met} pixels met something");
}

#[test]
fn maps_are_drawn_alike_from_every_height() {
    let mut wrong = Vec::new();
    let mut met = 0;
    for exponent in -4..=5 {
        for outside in [terraline::scene::Outside::Sky, terraline::scene::Outside::Clamp] {
            for (pitch, roll) in [(-90.0, 0.0), (-60.0, 10.0), (-1.0, 0.0), (0.0, 0.0)] {
                let hills = map(9, 14, |i, j| ((i * 5 + j * 3) % 7) as f32 / 3.0);
                let mut scene = turned(over(hills, 21, 19), 77.0, pitch, roll);
                super::support::terrain(&mut scene).outside = outside;
                scene.camera.position = DVec3::new(4.0, 2.0 + 10_f64.powi(exponent), 7.0);
                let what = format!("{outside:?}, 1e{exponent} above, pitch {pitch}, roll {roll}");
                met += check(&what, &scene, &mut wrong);
            }
        }
    }
    none(&wrong);
    assert!(met > 3000, "{met} pixels met something");
}

#[test]
fn the_smallest_maps_are_drawn_alike() {
    use terraline::scene::Outside;
    let mut wrong = Vec::new();
    let mut met = 0;
    for (columns, rows) in [(1, 1), (1, 2), (2, 1), (1, 9), (9, 1), (2, 2), (2, 3), (3, 2)] {
        for outside in [Outside::Clamp, Outside::Wrap, Outside::Sky] {
            if outside == Outside::Sky && columns.min(rows) < 2 {
                continue;
            }
            for kernel in kernels() {
                let mut scene = over(map(columns, rows, |i, j| (i * 2 + j) as f32 - 1.5), 15, 11);
                super::support::terrain(&mut scene).outside = outside;
                scene.camera.position.y += 1.0;
                scene.kernel = kernel;
                let what = format!("{columns}x{rows} nodes, {outside:?}, {kernel:?}");
                met += check(&what, &scene, &mut wrong);
                let skipping = drawn(&scene, &plan(&scene)).expect("a frame");
                scene.stepper.mode = StepperMode::Plain;
                let plain = drawn(&scene, &plan(&scene)).expect("a frame");
                if let Some(difference) = difference(&skipping, &plain) {
                    wrong.push(format!("{what}: skipping and plain: {difference}"));
                }
            }
        }
    }
    none(&wrong);
    assert!(met > 5000, "{met} pixels met something");
}

#[test]
fn repeated_maps_do_not_depend_on_skipping() {
    // Thin walls behind a last block that is cut off, met by level rays after long jumps.
    use terraline::scene::Outside;
    let mut wrong = Vec::new();
    let mut met = 0;
    for size in [7, 13, 14, 25, 27, 49] {
        for wall in 0..6 {
            for heading in [0.0, 180.0, 90.0, -37.0] {
                let height = |i, j| if i == wall || j == wall { 1.0 } else { 0.0 };
                let mut scene = turned(over(map(size, size, height), 31, 5), heading, 0.0, 0.0);
                super::support::terrain(&mut scene).outside = Outside::Wrap;
                scene.screens[0].extent = Extent::FieldOfView(0.3);
                let middle = wall as f64 + size as f64 / 2.0;
                scene.camera.position = DVec3::new(middle, 0.5, middle + 0.2);
                let (skipping, fast) = both(&scene, &plan(&scene)).expect("a frame");
                met += count(&skipping, Hit::Surface);
                scene.stepper.mode = StepperMode::Plain;
                let plain = drawn(&scene, &plan(&scene)).expect("a frame");
                for (name, frame) in [("skipping", &skipping), ("fast", &fast)] {
                    if let Some(difference) = difference(&plain, frame) {
                        let what = format!("{size} nodes, wall {wall}, heading {heading}");
                        wrong.push(format!("{what}: plain and {name}: {difference}"));
                    }
                }
            }
        }
    }
    none(&wrong);
    assert!(met > 10_000, "{met} pixels met something");
}

fn kernels() -> Vec<terraline::scene::Kernel> {
    use terraline::scene::{Deformation, Kernel};
    let deformations =
        [Deformation::None, Deformation::Stretch, Deformation::TowardHat { weight_shift: 1 }];
    super::support::SHAPES
        .into_iter()
        .flat_map(|shape| deformations.map(|deformation| Kernel { shape, deformation, table: 64 }))
        .collect()
}

#[test]
fn the_word_sizes_are_what_was_asked_for() {
    let mut scene = builtin("flight", 8, 8);
    assert_eq!(plan(&scene).words, WordClass::NARROW);
    scene.machine.words = WordSize::Wide;
    assert_eq!(plan(&scene).words, WordClass::WIDE);
    // Left to the plan: squares so large that the last bit of a place is a tenth of a pixel.
    let mut scene = builtin("plane", 1024, 1024);
    assert_eq!(plan(&scene).words, WordClass::NARROW);
    let Surface::Plane(plane) = &mut scene.surfaces[0] else { panic!("a plane") };
    plane.checker = 800.0;
    assert_eq!(plan(&scene).words, WordClass::WIDE);
    // Cells so narrow that slopes are beyond the shorter words: 12 · 9/4 over 1/100.
    let mut scene = over(map(12, 9, |i, j| (12 * (i % 2 * j % 2)) as f32), 19, 13);
    super::support::terrain(&mut scene).cell = (0.01, 100.0).into();
    scene.camera.position = DVec3::new(0.06, 30.0, -50.0);
    let found = plan(&scene);
    assert_eq!(found.words, WordClass::WIDE);
    assert!(found.words_why.contains("slopes reach 2700"), "{}", found.words_why);
}
