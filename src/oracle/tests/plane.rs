//! The plane in closed form.

use glam::DVec3;

use super::{kernel, oracle, scene};
use crate::frame::Hit;
use crate::oracle::plane::{checker_axes, checker_parity};
use crate::scene::{Deformation, KernelShape, Plane, Scene, Surface};

fn plane_scene(normal: DVec3, distance: f64, eye: DVec3, forward: DVec3) -> Scene {
    let plane = Plane { normal: normal.normalize(), distance, checker: 8.0 };
    let hat = kernel(KernelShape::Hat, Deformation::None);
    scene(Surface::Plane(plane), hat, eye, forward)
}

#[test]
fn points_lie_in_the_plane_and_on_the_ray() {
    let normal = DVec3::new(0.2, 0.9, -0.3);
    let scene = plane_scene(normal, -4.0, DVec3::new(3.0, 8.0, 1.0), DVec3::new(1.0, -0.1, 0.4));
    let oracle = oracle(&scene);
    let (mut hits, mut sky) = (0, 0);
    for line in 0..48 {
        for column in 0..64 {
            let (line, column) = (f64::from(line), f64::from(column));
            let sighting = oracle.pixel(line, column);
            let falls = normal.dot(oracle.direction(line, column)) < 0.0;
            assert_eq!(sighting.hit == Hit::Surface, falls);
            if !falls {
                sky += 1;
                assert!(sighting.lambda.is_nan() && sighting.color == [160, 190, 220]);
                continue;
            }
            hits += 1;
            let distance = normal.normalize().dot(sighting.point) + 4.0;
            assert!(distance.abs() < 1e-12 * sighting.point.length().max(1.0));
            let (j, k) = oracle.project(sighting.point).unwrap();
            assert!((j - line).abs() < 1e-9 && (k - column).abs() < 1e-9);
            let y = oracle.surface_height(sighting.point.x, sighting.point.z).unwrap();
            assert!((y - sighting.point.y).abs() < 1e-9 * sighting.point.length().max(1.0));
        }
    }
    assert!(hits > 500 && sky > 500);
}

#[test]
fn seen_edge_on_there_is_nothing() {
    let scene = plane_scene(DVec3::Y, 5.0, DVec3::new(0.0, 5.0, 0.0), DVec3::new(1.0, -0.5, 0.0));
    let oracle = oracle(&scene);
    assert!((0..48).all(|line| oracle.pixel(f64::from(line), 9.0).hit == Hit::Sky));
}

#[test]
fn checker_axes_lie_in_the_plane() {
    assert_eq!(checker_axes(DVec3::Y), (DVec3::X, DVec3::Z));
    for normal in [DVec3::Y, DVec3::X, DVec3::Z, DVec3::NEG_Y, DVec3::new(0.1, 0.5, -2.0)] {
        let n = normal.normalize();
        let (s, t) = checker_axes(n);
        assert!(s.dot(n).abs() < 1e-15 && t.dot(n).abs() < 1e-15 && s.dot(t).abs() < 1e-15);
        assert!((s.length() - 1.0).abs() < 1e-15 && (t.length() - 1.0).abs() < 1e-15);
    }
}

#[test]
fn squares_alternate() {
    let plane = Plane { normal: DVec3::Y, distance: 0.0, checker: 8.0 };
    let parity = |x, z| checker_parity(&plane, DVec3::new(x, 0.0, z));
    assert_eq!([parity(1.0, 1.0), parity(9.0, 1.0), parity(9.0, 9.0)], [0, 1, 0]);
    assert_eq!([parity(-1.0, 1.0), parity(-1.0, -1.0), parity(1.0, -7.9)], [1, 0, 1]);
}
