//! Netlists of the RTL by Yosys: which cells the modules are made of.

pub mod multipliers;
pub mod yosys;

pub use yosys::{Cells, Target};

/// A module of `rtl/` with parameters, to be looked at by itself.
#[derive(Clone, Copy, Debug)]
pub struct Design {
    /// What the reports call it.
    pub name: &'static str,
    /// Top module, a file of `rtl/`.
    pub top: &'static str,
    /// Parameters besides `WIDE`.
    pub parameters: &'static [(&'static str, u32)],
    /// Whether the module has the parameter `WIDE`.
    pub has_words: bool,
    /// Whether both mappings take but a few seconds: part of the test that always runs.
    pub is_quick: bool,
}

impl Design {
    const fn new(
        name: &'static str,
        top: &'static str,
        parameters: &'static [(&'static str, u32)],
    ) -> Self {
        Self { name, top, parameters, has_words: true, is_quick: false }
    }

    const fn quick(self) -> Self {
        Self { is_quick: true, ..self }
    }

    const fn without_words(self) -> Self {
        Self { has_words: false, ..self }
    }

    /// Word sizes that it is built for: 0 narrow, 1 wide; one entry where it has none.
    pub fn words(&self) -> &'static [u32] {
        if self.has_words { &[0, 1] } else { &[0] }
    }

    /// All parameters, with words of a size.
    pub fn with_words(&self, wide: u32) -> Vec<(&'static str, u32)> {
        let words = self.has_words.then_some(("WIDE", wide));
        words.into_iter().chain(self.parameters.iter().copied()).collect()
    }
}

/// Every unit, the multiplier, and whole machines. Other modules are parts of these.
pub const DESIGNS: &[Design] = &[
    Design::new("raster", "raster", &[]).without_words().quick(),
    Design::new("projector", "projector", &[]).quick(),
    Design::new("product 32×23", "product", &[("A", 32), ("B", 23)]).without_words().quick(),
    Design::new("divider, serial", "divider", &[("SERIAL", 1)]).quick(),
    Design::new("divider, array", "divider", &[]),
    Design::new("checkers", "checkers", &[]),
    Design::new("stepper", "stepper", &[]),
    Design::new("interpolator, samples", "interpolator", &[("SLOPES", 0)]),
    Design::new("interpolator, hits", "interpolator", &[("SLOPES", 1)]),
    Design::new("interpolator, 3×3", "interpolator", &[("SLOPES", 1), ("STRETCH", 1)]),
    Design::new("surface_stage", "surface_stage", &[]).quick(),
    Design::new("shader", "shader", &[]),
    Design::new("plane, serial", "terraline", &[("TERRAIN", 0), ("SERIAL", 1)]),
    Design::new("plane, pipelined", "terraline", &[("TERRAIN", 0)]),
    Design::new("terrain, pipelined", "terraline", &[]),
    Design::new("terrain, 3×3", "terraline", &[("STRETCH", 1)]),
];
