//! Which units a height map needs, and why.

use super::TerrainPlan;
use crate::plan::ALL_BITS;
use crate::plan::fitted::{Fit, UnitFit};
use crate::plan::geometry::Geometry;
use crate::plan::word_class::WordClass;
use crate::scene::{Deformation, Kernel, KernelShape, Scene, StepperMode, Terrain};
use crate::word::Register as R;

/// The units that may be left out.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// Divider, with the denominator's accumulator.
    pub divider: Fit,
    /// Skip pyramid, with the adders of a jump.
    pub pyramid: Fit,
    /// Kernel ROM, with the weight toward the hat.
    pub kernel_rom: Fit,
    /// The bits that mark nodes without data.
    pub void_bits: Fit,
    /// Slope multipliers for cells that are not cubes of the height unit.
    pub slope_scale: Fit,
    /// The light unit; without it shade is one.
    pub light: Fit,
}

impl Fitted {
    /// What a scene's height map needs in words of a size, with rays that start at the eye or not,
    /// and heights in this unit.
    pub(super) fn new(
        terrain: &Terrain,
        scene: &Scene,
        words: WordClass,
        full: bool,
        from_eye: bool,
        unit: f64,
    ) -> Self {
        let (lowest, highest) = terrain.range();
        let constant = lowest == highest;
        let voids = terrain.map.voids();
        let skipping = scene.stepper.mode == StepperMode::Skipping;
        let square = terrain.cell.x == unit && terrain.cell.y == unit;
        let dark = scene.light.ambient >= 1.0;
        Self {
            divider: Fit::where_needed(
                !from_eye,
                full,
                if from_eye {
                    "the eye is below the highest node: rays start at the eye"
                } else {
                    "the eye is above the highest node: rays enter the slab under it by a ratio"
                },
            ),
            // A plain stepper has none in a full machine either.
            pyramid: Fit::where_needed(
                skipping,
                false,
                if skipping {
                    "jumps over samples that it proves clear"
                } else {
                    "stepper.mode is plain"
                },
            ),
            kernel_rom: kernel_rom(scene, words, constant, voids > 0, full),
            void_bits: Fit::where_needed(
                voids > 0,
                full,
                match voids {
                    0 => "every node has data: the map has no holes".into(),
                    1 => "1 node has no data: cells that touch it are a hole".into(),
                    _ => format!("{voids} nodes have no data: cells that touch them are holes"),
                },
            ),
            slope_scale: Fit::where_needed(
                !constant && !square,
                full,
                if square {
                    "cells are squares of the height unit: slopes need no factor"
                } else if constant {
                    "every node has one height: slopes are zero"
                } else {
                    "cells are not squares of the height unit"
                },
            ),
            light: Fit::where_needed(
                !dark,
                full,
                if dark {
                    "the ambient share is one: the normal does not show"
                } else {
                    "diffuse light needs the normal"
                },
            ),
        }
    }
}

/// The kernel ROM: not needed where every weight gives the same, but for the reach of holes, or
/// where the kernel's weights are the hat's in every bit.
fn kernel_rom(scene: &Scene, words: WordClass, constant: bool, holes: bool, full: bool) -> Fit {
    let Kernel { shape, deformation, .. } = scene.kernel;
    let stretch = deformation == Deformation::Stretch;
    let last = if scene.formats.is_empty() { words.width - 1 } else { ALL_BITS };
    let no_bit =
        matches!(deformation, Deformation::TowardHat { weight_shift } if weight_shift >= last);
    let (needed, why) = if constant && !(holes && stretch) {
        (false, "every node has one height: any weights give it")
    } else if shape == KernelShape::Hat && !stretch {
        (false, "the kernel is the hat, whose weight is the fraction itself")
    } else if no_bit {
        (false, "the weight shift leaves no bit of the kernel: it is the hat")
    } else {
        (true, "the kernel's weights are read from a table")
    };
    Fit::where_needed(needed, full, why)
}

impl TerrainPlan {
    /// All units in the order of the data flow.
    pub(super) fn unit_fits(&self, geometry: &Geometry) -> Vec<UnitFit> {
        let unit = |name, fit: &Fit, registers, saves| UnitFit {
            name,
            fit: fit.clone(),
            registers,
            saves,
        };
        let always = |name, why: &'static str, registers| UnitFit {
            name,
            fit: Fit::always(why),
            registers,
            saves: "",
        };
        let nodes = if self.stretch { "3×3 nodes around the nearest one" } else { "2×2 nodes" };
        let fitted = &self.fitted;
        vec![
            UnitFit::projector(geometry, true),
            UnitFit::divider(fitted.divider.clone()),
            always(
                "stepper",
                "a height map is met by stepping",
                &[R::GroundX, R::GroundZ, R::RayY],
            ),
            unit(
                "pyramid",
                &fitted.pyramid,
                &[R::Node],
                "its memory; the plain stepper tests every sample",
            ),
            unit(
                "kernel_rom",
                &fitted.kernel_rom,
                &[R::Weight, R::WeightSlope],
                "the tables, two reads and the hat weight's additions per interpolation",
            ),
            unit("void_bits", &fitted.void_bits, &[], "one bit per node, and a test of those read"),
            always("interpolator", nodes, &[R::Node, R::Surface, R::SlopeX, R::SlopeZ]),
            unit(
                "slope_scale",
                &fitted.slope_scale,
                &[R::SlopeX, R::SlopeZ],
                "two products per pixel",
            ),
            unit(
                "light",
                &fitted.light,
                &[R::Normal, R::Shade],
                "ten products and a table read per pixel",
            ),
            always("ramp", "colour over height", &[R::Ramp, R::Channel]),
        ]
    }
}
