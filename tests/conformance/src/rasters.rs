//! Rasters of one line or one column, ratios at the ends of their range, the smallest maps.

use glam::DVec3;
use terraline::scene::{Deformation, Extent, Kernel, Outside, Surface};

use crate::compared::{Compared, Draw};
use crate::scenes::{SCENES, SHAPES, builtin, map, over, terrain, turned};

/// All of them.
pub fn all(candidate: &Draw) {
    thin_rasters(candidate);
    level_lines(candidate);
    planes_from_every_height(candidate);
    planes_of_every_direction(candidate);
    maps_from_every_height(candidate);
    the_smallest_maps(candidate);
    repeated_maps(candidate);
}

fn thin_rasters(candidate: &Draw) {
    let mut compared = Compared::default();
    for name in SCENES {
        for (columns, lines) in [(1, 1), (1, 2), (2, 1), (1, 77), (77, 1), (3, 2), (37, 23)] {
            for fov in [10.0_f64, 60.0, 100.0, 150.0] {
                let mut scene = builtin(name, columns, lines);
                scene.screens[0].extent = Extent::FieldOfView(fov.to_radians());
                let what = format!("{name}, {columns}x{lines}, {fov} degrees");
                compared.in_both_words(&what, &scene, candidate);
            }
        }
    }
    compared.finish(5000);
}

fn level_lines(candidate: &Draw) {
    // A line that looks almost along the ground has a denominator close to zero in every pixel.
    let mut compared = Compared::default();
    for name in SCENES {
        for (columns, lines) in [(1, 1), (64, 1), (63, 3), (1, 5)] {
            for pitch in [0.0, -1e-12, -1e-6, -1e-3, -0.05, 0.05] {
                for roll in [0.0, 180.0, 0.001, 90.0] {
                    let scene = turned(builtin(name, columns, lines), 30.0, pitch, roll);
                    let what = format!("{name}, {columns}x{lines}, pitch {pitch}, roll {roll}");
                    compared.in_both_words(&what, &scene, candidate);
                }
            }
        }
    }
    compared.finish(10_000);
}

fn planes_from_every_height(candidate: &Draw) {
    let mut compared = Compared::default();
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
                    compared.in_both_words(&what, &scene, candidate);
                }
            }
        }
    }
    compared.finish(100_000);
}

fn planes_of_every_direction(candidate: &Draw) {
    let mut compared = Compared::default();
    for normal in [DVec3::X, DVec3::Z, DVec3::new(1.0, 2.0, -3.0), DVec3::NEG_Y] {
        for distance in [-40.0, -0.25, 0.0, 7.0, 300.0] {
            for heading in [0.0, 90.0, 7200.0 + 200.0, -5000.0] {
                let mut scene = turned(builtin("plane", 31, 17), heading, -20.0, 33.0);
                let Surface::Plane(plane) = &mut scene.surfaces[0] else { panic!("a plane") };
                plane.normal = normal.normalize();
                plane.distance = distance;
                let what = format!("normal {normal}, distance {distance}, heading {heading}");
                compared.in_both_words(&what, &scene, candidate);
            }
        }
    }
    compared.finish(5000);
}

fn maps_from_every_height(candidate: &Draw) {
    let mut compared = Compared::default();
    for exponent in -4..=5 {
        for outside in [Outside::Sky, Outside::Clamp] {
            for (pitch, roll) in [(-90.0, 0.0), (-60.0, 10.0), (-1.0, 0.0), (0.0, 0.0)] {
                let hills = map(9, 14, |i, j| ((i * 5 + j * 3) % 7) as f32 / 3.0);
                let mut scene = turned(over(hills, 21, 19), 77.0, pitch, roll);
                terrain(&mut scene).outside = outside;
                scene.camera.position = DVec3::new(4.0, 2.0 + 10_f64.powi(exponent), 7.0);
                let what = format!("{outside:?}, 1e{exponent} above, pitch {pitch}, roll {roll}");
                compared.in_both_words(&what, &scene, candidate);
            }
        }
    }
    compared.finish(3000);
}

fn the_smallest_maps(candidate: &Draw) {
    let mut compared = Compared::default();
    for (columns, rows) in [(1, 1), (1, 2), (2, 1), (1, 9), (9, 1), (2, 2), (2, 3), (3, 2)] {
        for outside in [Outside::Clamp, Outside::Wrap, Outside::Sky] {
            if outside == Outside::Sky && columns.min(rows) < 2 {
                continue;
            }
            for kernel in kernels() {
                let mut scene = over(map(columns, rows, |i, j| (i * 2 + j) as f32 - 1.5), 15, 11);
                terrain(&mut scene).outside = outside;
                scene.camera.position.y += 1.0;
                scene.kernel = kernel;
                let what = format!("{columns}x{rows} nodes, {outside:?}, {kernel:?}");
                compared.in_both_words(&what, &scene, candidate);
            }
        }
    }
    compared.finish(5000);
}

fn repeated_maps(candidate: &Draw) {
    // Thin walls behind a last block that is cut off, met by level rays after long jumps.
    let mut compared = Compared::default();
    for size in [7, 13, 14, 25, 27, 49] {
        for wall in 0..6 {
            for heading in [0.0, 180.0, 90.0, -37.0] {
                let height = |i, j| if i == wall || j == wall { 1.0 } else { 0.0 };
                let mut scene = turned(over(map(size, size, height), 31, 5), heading, 0.0, 0.0);
                terrain(&mut scene).outside = Outside::Wrap;
                scene.screens[0].extent = Extent::FieldOfView(0.3);
                let middle = wall as f64 + size as f64 / 2.0;
                scene.camera.position = DVec3::new(middle, 0.5, middle + 0.2);
                let what = format!("{size} nodes, wall {wall}, heading {heading}");
                compared.in_both_words(&what, &scene, candidate);
            }
        }
    }
    compared.finish(10_000);
}

fn kernels() -> Vec<Kernel> {
    let deformations =
        [Deformation::None, Deformation::Stretch, Deformation::TowardHat { weight_shift: 1 }];
    SHAPES
        .into_iter()
        .flat_map(|shape| deformations.map(|deformation| Kernel { shape, deformation, table: 64 }))
        .collect()
}
