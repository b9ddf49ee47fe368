//! Scenes at the edge of what a file may say: whatever is planned and set up is drawn without a
//! panic in the fixed and in the real world, and alike by both engines.

use std::panic::{AssertUnwindSafe, catch_unwind};

use glam::{DVec2, DVec3};
use terraline::plan::Plan;
use terraline::scene::{
    Bisection, Deformation, Extent, KernelShape, Outside, Scene, Stepper, StepperMode,
};

use super::support::{both, builtin, difference, draw_in_real, map, over, terrain};

fn hills() -> Scene {
    over(map(12, 9, |i, j| ((i * 7 + j * 11) % 13) as f32), 19, 13)
}

/// Every corner case with its name.
fn scenes() -> Vec<(String, Scene)> {
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

#[test]
fn corner_cases_are_refused_or_drawn() {
    let (mut drawn, mut refused, mut wrong) = (0, Vec::new(), Vec::new());
    for (name, scene) in scenes() {
        for full in [false, true] {
            let attempt = catch_unwind(AssertUnwindSafe(|| {
                let plan = Plan::new(&scene, None, full).map_err(|error| error.to_string())?;
                let frames = both(&scene, &plan).map_err(|error| error.to_string())?;
                let real = draw_in_real(&scene, &plan).map_err(|error| error.to_string())?;
                assert_eq!(real.hit.len(), frames.0.hit.len());
                Ok::<_, String>(frames)
            }));
            match attempt {
                Err(_) => wrong.push(format!("{name}, full {full}: panicked")),
                Ok(Err(error)) => refused.push(format!("{name}: {error}")),
                Ok(Ok((processor, fast))) => {
                    drawn += 1;
                    if let Some(difference) = difference(&processor, &fast) {
                        wrong.push(format!("{name}, full {full}: {difference}"));
                    }
                }
            }
        }
    }
    println!("{drawn} drawn; refused:\n{}", refused.join("\n"));
    assert!(wrong.is_empty(), "{} failures:\n{}", wrong.len(), wrong.join("\n"));
    assert!(drawn > 2 * refused.len(), "{drawn} drawn, refused:\n{}", refused.join("\n"));
}

#[test]
fn what_is_refused_names_the_field_to_change() {
    let mut wrong = Vec::new();
    let mut refused = 0;
    for (name, scene) in scenes() {
        let Err(error) = Plan::new(&scene, None, false) else { continue };
        refused += 1;
        let message = error.to_string();
        // The part of the scene that is out of bounds; moving the eye would not help the others.
        let field = match name.split(' ').next() {
            Some("cells" | "heights" | "base") => "surface.",
            _ if name.ends_with("degrees") => "screen.",
            Some("pixels" | "screen") => "screen.",
            _ => "camera.position",
        };
        if message.contains('\n') || !message.starts_with(field) {
            wrong.push(format!("{name} (expected {field}): {message}"));
        }
    }
    // Within the places that are counted, but not within the steps.
    let mut far = hills();
    far.camera.position.x += 1e6;
    far.stepper.fineness = 6;
    let message = Plan::new(&far, None, false).expect_err("a long walk").to_string();
    assert!(message.contains("2^26 are counted"), "{message}");
    assert!(refused > 10, "{refused} scenes are refused");
    assert!(wrong.is_empty(), "{} failures:\n{}", wrong.len(), wrong.join("\n"));
}
