//! Axes, rays and projection.

use glam::{DMat3, DVec2, DVec3};

use super::{Dice, kernel, oracle, scene};
use crate::oracle::camera::{axes_of_angles, axes_of_attitude};
use crate::scene::{Angles, Attitude, Deformation, Extent, KernelShape, Plane, Scene, Surface};

fn random_angles(dice: &mut Dice) -> Angles {
    Angles {
        heading: dice.between(-3.0, 3.0),
        pitch: dice.between(-1.5, 1.5),
        roll: dice.between(-3.0, 3.0),
    }
}

/// A scene with everything off its axis.
fn crooked(dice: &mut Dice) -> Scene {
    let plane = Surface::Plane(Plane { normal: DVec3::Y, distance: 0.0, checker: 8.0 });
    let hat = kernel(KernelShape::Hat, Deformation::None);
    let mut scene = scene(plane, hat, DVec3::new(1.0, 20.0, -3.0), DVec3::X);
    scene.camera.attitude = Attitude::Angles(random_angles(dice));
    scene.camera.offset = DVec3::new(0.5, 1.5, -0.25);
    let screen = &mut scene.screens[0];
    (screen.columns, screen.lines) = (41, 32);
    screen.extent = Extent::Pitch { distance: 0.7, pixel: DVec2::new(0.02, 0.03) };
    screen.center = DVec2::new(0.1, -0.2);
    screen.mount = random_angles(dice);
    scene
}

#[test]
fn the_table_is_the_product_of_rotations() {
    let mut dice = Dice(5);
    for _ in 0..100 {
        let a = random_angles(&mut dice);
        let product = DMat3::from_rotation_y(a.heading)
            * DMat3::from_rotation_z(a.pitch)
            * DMat3::from_rotation_x(a.roll);
        assert!(axes_of_angles(a).abs_diff_eq(product, 1e-15));
    }
}

#[test]
fn angles_turn_the_stated_way() {
    let axes = |heading, pitch, roll| axes_of_angles(Angles { heading, pitch, roll });
    let close = |a: DVec3, b: DVec3| assert!(a.abs_diff_eq(b, 1e-15), "{a} {b}");
    let quarter = std::f64::consts::FRAC_PI_2;
    close(axes(0.0, 0.0, 0.0).x_axis, DVec3::X);
    close(axes(0.0, 0.0, 0.0).z_axis, DVec3::Z);
    // Heading to the left of east is north; the nose goes up; the right wing goes down.
    close(axes(quarter, 0.0, 0.0).x_axis, DVec3::NEG_Z);
    assert!(axes(0.3, 0.1, 0.0).x_axis.y > 0.0);
    assert!(axes(0.3, 0.0, 0.1).z_axis.y < 0.0);
}

#[test]
fn directions_make_the_axes() {
    let attitude =
        Attitude::Directions { forward: DVec3::new(0.0, -2.0, 2.0), up: DVec3::new(0.0, 3.0, 0.5) };
    let axes = axes_of_attitude(&attitude);
    let half = 0.5f64.sqrt();
    assert!(axes.x_axis.abs_diff_eq(DVec3::new(0.0, -half, half), 1e-15));
    assert!(axes.y_axis.abs_diff_eq(DVec3::new(0.0, half, half), 1e-15));
    // Looking south, the right is west.
    assert!(axes.z_axis.abs_diff_eq(DVec3::NEG_X, 1e-15));
}

#[test]
fn the_mount_turns_the_screen_but_not_the_eye() {
    let mut scene = crooked(&mut Dice(9));
    let turned = oracle(&scene);
    let mount = axes_of_angles(scene.screens[0].mount);
    scene.screens[0].mount = Angles::default();
    let straight = oracle(&scene);
    assert_eq!(turned.eye(), straight.eye());
    assert!(turned.axes().abs_diff_eq(straight.axes() * mount, 1e-15));
    let craft = axes_of_attitude(&scene.camera.attitude);
    let eye = scene.camera.position + craft * DVec3::new(0.5, 1.5, -0.25);
    assert!(turned.eye().abs_diff_eq(eye, 1e-14));
}

#[test]
fn directions_follow_the_raster() {
    let mut scene = crooked(&mut Dice(3));
    scene.camera.attitude = Attitude::Angles(Angles::default());
    scene.screens[0].mount = Angles::default();
    let oracle = oracle(&scene);
    // 41 columns and 32 lines: Nz = 20.5, Ny = 16; Ve = 0.1, We = −0.2.
    let v = oracle.direction(2.0, 7.0);
    let by_hand = DVec3::new(0.7, 0.1 + 13.5 * 0.03, -0.2 - 13.0 * 0.02);
    assert!(v.abs_diff_eq(by_hand, 1e-15), "{v}");
}

#[test]
fn projection_undoes_the_ray() {
    let mut dice = Dice(1);
    for _ in 0..20 {
        let oracle = oracle(&crooked(&mut dice));
        for _ in 0..20 {
            let (line, column) = (dice.between(-5.0, 40.0), dice.between(-5.0, 50.0));
            let ahead = oracle.direction(line, column) * dice.between(0.1, 500.0);
            let (j, k) = oracle.project(oracle.eye() + ahead).unwrap();
            assert!((j - line).abs() < 1e-9 && (k - column).abs() < 1e-9);
            assert!(oracle.project(oracle.eye() - ahead).is_none());
        }
    }
}
