//! Scenes at the edge of what a file may say: whatever is planned and set up is drawn.

use glam::{DVec2, DVec3};
use terraline::scene::{
    Bisection, Deformation, Extent, KernelShape, Outside, Scene, Stepper, StepperMode,
};

use crate::compared::{Compared, Draw};
use crate::scenes::{builtin, map, over, terrain};

/// Low hills, seen from above.
pub fn hills() -> Scene {
    over(map(12, 9, |i, j| ((i * 7 + j * 11) % 13) as f32), 19, 13)
}

/// Every corner case with its name.
pub fn scenes() -> Vec<(String, Scene)> {
    let mut all: Vec<(String, Scene)> = Vec::new();
    let mut add = |name: String, change: &dyn Fn(&mut Scene)| {
        let mut scene = hills();
        change(&mut scene);
        all.push((name, scene));
    };
    for cell in [(1e-9, 1e-9), (1e7, 1e7), (1e-3, 1e3), (1e3, 1e-3), (1.0, 3e4), (1e-6, 1e6)] {
        add(format!("cells of {cell:?}"), &|scene| {
            let land = terrain(scene);
            land.cell = DVec2::new(cell.0, cell.1);
            land.scale = (cell.0 * cell.1).sqrt();
            let high = land.range().1;
            scene.camera.position = DVec3::new(6.0 * cell.0, 1.5 * high, -cell.1);
        });
    }
    for scale in [1e-25, 1e-14, 1e-9, 1e-6, 1e3, 1e5, 1e7] {
        add(format!("heights times {scale}"), &|scene| {
            terrain(scene).scale = scale;
            scene.camera.position.y = 12.0 * scale + 3.0;
        });
    }
    for offset in [1e9, -1e9, 123_456.789] {
        add(format!("heights from {offset}"), &|scene| {
            terrain(scene).offset = offset;
            scene.camera.position.y -= offset;
        });
    }
    for away in [1e3, 1e5, 1e7, 1e9] {
        for outside in [Outside::Sky, Outside::Clamp, Outside::Wrap] {
            add(format!("{away} away, {outside:?}"), &|scene| {
                terrain(scene).outside = outside;
                scene.camera.position.x += away;
                scene.camera.position.y += away / 10.0;
            });
        }
    }
    for fov in [1e-6_f64, 0.01, 175.0] {
        add(format!("{fov} degrees"), &|scene| {
            scene.screens[0].extent = Extent::FieldOfView(fov.to_radians());
        });
    }
    for pixel in [(1e-9, 1.0), (1e9, 1e-9), (1e-6, 1e-6), (50.0, 50.0)] {
        add(format!("pixels of {pixel:?}"), &|scene| {
            scene.screens[0].extent =
                Extent::Pitch { distance: 1.0, pixel: DVec2::new(pixel.0, pixel.1) };
        });
    }
    for center in [(1e9, 0.0), (0.0, -1e9), (30.0, 30.0), (-300.0, 1e4)] {
        add(format!("screen {center:?} off axis"), &|scene| {
            scene.screens[0].center = DVec2::new(center.0, center.1);
        });
    }
    for (fineness, times) in [(0, 0), (0, 20), (6, 0), (6, 20)] {
        add(format!("fineness {fineness}, {times} bisection steps"), &|scene| {
            scene.stepper =
                Stepper { mode: StepperMode::Plain, fineness, halvings: Bisection::Fixed(times) };
        });
    }
    for table in [16, 1 << 16] {
        for deformation in [Deformation::None, Deformation::Stretch] {
            add(format!("{table} entries, {deformation:?}"), &|scene| {
                scene.kernel.shape = KernelShape::Exponential;
                scene.kernel.deformation = deformation;
                scene.kernel.table = table;
            });
        }
    }
    for weight_shift in [19, 30, 31, 32, 62, 63, 64] {
        add(format!("weights shifted by {weight_shift}"), &|scene| {
            scene.kernel.deformation = Deformation::TowardHat { weight_shift };
        });
    }
    for base_depth in [1e-9, 1e3, 1e9] {
        add(format!("base at {base_depth}"), &|scene| {
            terrain(scene).base_depth = Some(base_depth);
            scene.camera.position = DVec3::new(-5.0, -3.0, 4.0);
        });
    }
    for seed in [u64::MAX, 0] {
        add(format!("seed {seed}"), &|scene| scene.seed = seed);
    }
    for height in [0.0, 1e-12, 1.0 / 256.0, 0.01] {
        add(format!("eye {height} above the highest node"), &|scene| {
            scene.camera.position.y = terrain(scene).range().1 + height;
        });
    }
    all.push(("the plane from 1e9".into(), {
        let mut scene = builtin("plane", 11, 9);
        scene.camera.position = DVec3::new(1e9, 1e9, 1e9);
        scene
    }));
    all
}

/// All of them, pruned and with everything fitted.
pub fn all(candidate: &Draw) {
    let mut compared = Compared::default();
    for (name, scene) in scenes() {
        for full in [false, true] {
            compared.scene(&name, &scene, full, candidate);
        }
    }
    let refused = &compared.refused;
    println!("refused:\n{}", refused.join("\n"));
    assert!(compared.frames > 2 * refused.len(), "refused:\n{}", refused.join("\n"));
    compared.finish(1000);
}
