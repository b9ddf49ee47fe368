//! The wires of one scan line: a structure of arrays, one entry per pixel in flight.

use crate::frame::Hit;
use crate::word::{Register, Word, World};

/// What the divider says of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Entry {
    /// The ray meets the plane, or it starts at the eye.
    #[default]
    Met,
    /// The denominator is not positive: the ray never meets the plane.
    Sky,
    /// The quotient is out of range.
    Far,
}

/// What the stepper did for a pixel; its cycles follow from it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Jumps tried against the pyramid.
    pub trials: u32,
    /// Samples of the ray compared with the surface.
    pub samples: u32,
    /// Runs of samples streamed through the interpolator.
    pub groups: u32,
    /// Halvings after the hit.
    pub halvings: u32,
    /// Hits: one, or none.
    pub hits: u32,
}

/// The wires of one scan line. A unit that is not fitted leaves its wires as they are.
#[derive(Clone, Debug)]
pub struct Line<W: World> {
    /// Scan line from the top.
    pub number: u32,
    /// Column of each pixel.
    pub column: Vec<u32>,
    /// View vector, x in cells (on a plane: along its first axis, in squares).
    pub view_x: Vec<W::View>,
    /// View vector, y in height units.
    pub view_y: Vec<W::View>,
    /// View vector, z in cells (on a plane: along its second axis, in squares).
    pub view_z: Vec<W::View>,
    /// Denominator of the projection.
    pub denominator: Vec<W::View>,
    /// Outcome of the projection.
    pub entry: Vec<Entry>,
    /// Ground position, x: after the divider the entry, after the stepper the hit.
    pub ground_x: Vec<W::Ground>,
    /// Ground position, z.
    pub ground_z: Vec<W::Ground>,
    /// Outcome of the pixel.
    pub hit: Vec<Hit>,
    /// Index of the sample that hit.
    pub steps: Vec<u32>,
    /// What the stepper did.
    pub work: Vec<Work>,
    /// Surface height at the ground position.
    pub surface: Vec<W::Height>,
    /// Negated slope of the surface against x.
    pub slope_x: Vec<W::Height>,
    /// Negated slope of the surface against z.
    pub slope_z: Vec<W::Height>,
    /// Light that the surface reflects, from 0 to 1.
    pub shade: Vec<W::Tone>,
    /// Colour of the ground before it is lit, channels from 0 to 255.
    pub albedo: Vec<[W::Tone; 3]>,
    /// Colour of the lit ground, channels from 0 to 255.
    pub lit: Vec<[W::Tone; 3]>,
    /// sRGB bytes.
    pub color: Vec<[u8; 3]>,
}

impl<W: World> Line<W> {
    /// Idle wires for the given columns.
    pub fn new(world: &W, columns: impl IntoIterator<Item = u32>) -> Self {
        let column: Vec<u32> = columns.into_iter().collect();
        let n = column.len();
        let view = vec![W::View::zero(world.view(Register::ViewX)); n];
        let height = |register| vec![W::Height::zero(world.height(register)); n];
        let color = vec![[W::Tone::zero(world.tone(Register::Channel)); 3]; n];
        Self {
            number: 0,
            column,
            view_x: view.clone(),
            view_y: view.clone(),
            view_z: view.clone(),
            denominator: view,
            entry: vec![Entry::Met; n],
            ground_x: vec![W::Ground::zero(world.ground(Register::GroundX)); n],
            ground_z: vec![W::Ground::zero(world.ground(Register::GroundZ)); n],
            hit: vec![Hit::Sky; n],
            steps: vec![0; n],
            work: vec![Work::default(); n],
            surface: height(Register::Surface),
            slope_x: height(Register::SlopeX),
            slope_z: height(Register::SlopeZ),
            shade: vec![W::Tone::zero(world.tone(Register::Shade)); n],
            albedo: color.clone(),
            lit: color,
            color: vec![[0; 3]; n],
        }
    }

    /// Number of pixels on the wires.
    pub fn len(&self) -> usize {
        self.column.len()
    }

    /// Whether there are no pixels on the wires.
    pub fn is_empty(&self) -> bool {
        self.column.is_empty()
    }

    /// Registers whose wires carry overflowed values: pixels, and the first pixel's column. Empty
    /// in stock worlds, whose ranges are proved.
    pub fn overflows(&self) -> Vec<(Register, u64, u32)> {
        let mut found = Vec::new();
        let mut look = |register, overflowed: &dyn Fn(usize) -> bool| {
            let mut pixels = (0..self.len()).filter(|&i| overflowed(i));
            if let Some(first) = pixels.next() {
                found.push((register, 1 + pixels.count() as u64, self.column[first]));
            }
        };
        let met = |i: usize| matches!(self.hit[i], Hit::Surface | Hit::Side);
        look(Register::ViewX, &|i| self.view_x[i].overflowed());
        look(Register::ViewY, &|i| self.view_y[i].overflowed());
        look(Register::ViewZ, &|i| self.view_z[i].overflowed());
        look(Register::Denominator, &|i| self.denominator[i].overflowed());
        // Pixels that the divider turned away still carry what was there before.
        let entered = |i: usize| self.entry[i] == Entry::Met;
        look(Register::GroundX, &|i| entered(i) && self.ground_x[i].overflowed());
        look(Register::GroundZ, &|i| entered(i) && self.ground_z[i].overflowed());
        look(Register::Surface, &|i| met(i) && self.surface[i].overflowed());
        look(Register::SlopeX, &|i| met(i) && self.slope_x[i].overflowed());
        look(Register::SlopeZ, &|i| met(i) && self.slope_z[i].overflowed());
        found
    }
}
