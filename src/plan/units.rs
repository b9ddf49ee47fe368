//! The plan in words: every unit, fitted or not, why, at which widths, and what leaving it out
//! saves.

use serde::Serialize;

use super::{Plan, SurfacePlan, kernel_is_hat, needs_kernel};
use crate::scene::{Deformation, KernelShape, Scene, StepperMode, Surface};
use crate::word::{Register, World};

/// One unit of the plan.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnitPlan {
    /// Name of the unit.
    pub name: &'static str,
    /// Whether the machine has it.
    pub fitted: bool,
    /// Why it is fitted or left out.
    pub why: String,
    /// Formats of its registers, name and format.
    pub widths: Vec<(String, String)>,
    /// What leaving it out saves, where it is left out.
    pub saves: Option<String>,
}

/// All units of a plan in a number world.
pub fn units<W: World>(plan: &Plan, scene: &Scene, world: &W) -> Vec<UnitPlan> {
    let describe = Describe { plan, scene, world };
    let mut units = describe.projection();
    units.extend(match &plan.surface {
        SurfacePlan::Terrain(_) => describe.terrain(),
        SurfacePlan::Plane(_) => describe.plane(),
    });
    units
}

struct Describe<'a, W> {
    plan: &'a Plan,
    scene: &'a Scene,
    world: &'a W,
}

impl<W: World> Describe<'_, W> {
    fn widths(&self, registers: &[Register]) -> Vec<(String, String)> {
        registers
            .iter()
            .map(|&register| {
                let format = self
                    .world
                    .fixed(register)
                    .map_or_else(|| "f64".to_owned(), |fixed| fixed.to_string());
                (register.name().to_owned(), format)
            })
            .collect()
    }

    /// A unit that the scene needs, or that the full machine has all the same.
    fn unit(
        &self,
        name: &'static str,
        needed: bool,
        fitted: bool,
        why: String,
        registers: &[Register],
        saves: &str,
    ) -> UnitPlan {
        let why = if fitted && !needed { format!("--full; not needed: {why}") } else { why };
        UnitPlan {
            name,
            fitted,
            why,
            widths: if fitted { self.widths(registers) } else { Vec::new() },
            saves: (!fitted).then(|| saves.to_owned()),
        }
    }

    fn projection(&self) -> Vec<UnitPlan> {
        use Register as R;
        let fitted = self.plan.fitted;
        let view = &self.plan.geometry.view;
        let still = [
            ("view_x", view.per_column.x),
            ("view_y", view.per_column.y),
            ("view_z", view.per_column.z),
        ];
        let idle: Vec<_> =
            still.iter().filter(|(_, step)| *step == 0.0).map(|(name, _)| *name).collect();
        let mut why = "every scene: view vector by additions".to_owned();
        if !idle.is_empty() && matches!(self.plan.surface, SurfacePlan::Terrain(_)) {
            why += &format!("; no column adder for {} (increment zero)", idle.join(", "));
        }
        let (needed, reason) = match &self.plan.surface {
            SurfacePlan::Terrain(walk) if walk.from_eye => {
                (false, "the eye is below the highest node: rays start at the eye".to_owned())
            }
            SurfacePlan::Terrain(_) => (
                true,
                "the eye is above the highest node: rays enter the slab under it by a ratio"
                    .to_owned(),
            ),
            SurfacePlan::Plane(plane) if plane.numerator == 0.0 => (
                true,
                "the eye lies in the plane, which is seen edge-on: nothing is met".to_owned(),
            ),
            SurfacePlan::Plane(_) => (true, "plane coordinates are a ratio".to_owned()),
        };
        vec![
            self.unit("projector", true, true, why, &[R::ViewX, R::ViewY, R::ViewZ], ""),
            self.unit(
                "divider",
                needed,
                fitted.divider,
                reason,
                &[R::Denominator, R::GroundX, R::GroundZ],
                "one accumulator and two ratios per pixel",
            ),
        ]
    }

    fn terrain(&self) -> Vec<UnitPlan> {
        use Register as R;
        let (plan, fitted) = (self.plan, self.plan.fitted);
        let kernel = &self.scene.kernel;
        let (constant, voids) = match &self.scene.surface {
            Surface::Terrain(terrain) => {
                (terrain.range().0 == terrain.range().1, terrain.map.voids())
            }
            Surface::Plane(_) => (false, 0),
        };
        let shows = needs_kernel(self.scene, constant, voids > 0);
        let hat = kernel_is_hat(self.scene, plan.words());
        let kernel_why = if !shows {
            "every node has one height: any weights give it".to_owned()
        } else if kernel.shape == KernelShape::Hat && kernel.deformation != Deformation::Stretch {
            "the kernel is the hat, whose weight is the fraction itself".to_owned()
        } else if hat {
            "the weight shift leaves no bit of the kernel: it is the hat".to_owned()
        } else {
            "the kernel's weights are read from a table".to_owned()
        };
        let square = self.scene_is_square();
        let dark = self.scene.light.ambient >= 1.0;
        let skipping = self.scene.stepper.mode == StepperMode::Skipping;
        vec![
            self.unit(
                "stepper",
                true,
                true,
                "a height map is met by stepping".into(),
                &[R::GroundX, R::GroundZ, R::RayY],
                "",
            ),
            self.unit(
                "pyramid",
                skipping,
                fitted.pyramid,
                if skipping {
                    "jumps over samples that it proves clear".into()
                } else {
                    "stepper.mode is plain".into()
                },
                &[R::Node],
                "its memory; the plain stepper tests every sample",
            ),
            self.unit(
                "kernel_rom",
                shows && !hat,
                fitted.kernel_rom,
                kernel_why,
                &[R::Weight, R::WeightSlope],
                "the tables, two reads and the hat weight's additions per interpolation",
            ),
            self.unit(
                "void_bits",
                voids > 0,
                fitted.void_bits,
                match voids {
                    0 => "every node has data: the map has no holes".into(),
                    1 => "1 node has no data: cells that touch it are a hole".into(),
                    _ => format!("{voids} nodes have no data: cells that touch them are holes"),
                },
                &[],
                "one bit per node, and a test of those read",
            ),
            self.unit(
                "interpolator",
                true,
                true,
                if kernel.deformation == Deformation::Stretch {
                    "3×3 nodes around the nearest one".into()
                } else {
                    "2×2 nodes".into()
                },
                &[R::Node, R::Surface, R::SlopeX, R::SlopeZ],
                "",
            ),
            self.unit(
                "slope_scale",
                !constant && !square,
                fitted.slope_scale,
                if square {
                    "cells are squares of the height unit: slopes need no factor".into()
                } else if constant {
                    "every node has one height: slopes are zero".into()
                } else {
                    "cells are not squares of the height unit".into()
                },
                &[R::SlopeX, R::SlopeZ],
                "two products per pixel",
            ),
            self.unit(
                "light",
                !dark,
                fitted.light,
                if dark {
                    "the ambient share is one: the normal does not show".into()
                } else {
                    "diffuse light needs the normal".into()
                },
                &[R::Normal, R::Shade],
                "ten products and a table read per pixel",
            ),
            self.unit("ramp", true, true, "colour over height".into(), &[R::Ramp, R::Channel], ""),
        ]
    }

    fn scene_is_square(&self) -> bool {
        match &self.plan.surface {
            SurfacePlan::Terrain(walk) => {
                walk.lengths.x == walk.lengths.y && walk.lengths.z == walk.lengths.y
            }
            SurfacePlan::Plane(_) => true,
        }
    }

    fn plane(&self) -> Vec<UnitPlan> {
        use Register as R;
        let idle = self.plan.fitted.idle;
        let without = |name, saves| {
            self.unit(
                name,
                false,
                idle,
                if idle {
                    "idle, the scene has no height map".into()
                } else {
                    "the scene has no height map".into()
                },
                &[],
                saves,
            )
        };
        vec![
            without("stepper", "all steps of all rays"),
            without("pyramid", "its memory"),
            without("kernel_rom", "its tables"),
            without("interpolator", "five lerps and two slopes per pixel"),
            without("light", "ten products and a table read per pixel"),
            self.unit(
                "checker",
                true,
                true,
                "colour of a plane: parity of the square, faded where squares are too small".into(),
                &[R::Shade, R::Channel],
                "",
            ),
        ]
    }
}
