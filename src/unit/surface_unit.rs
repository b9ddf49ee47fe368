//! What the stepper may ask of a surface: the stepper itself cannot interpolate.

use crate::word::{Site, World};

/// The surface, as the stepper asks for it at its samples.
pub trait SurfaceUnit<W: World> {
    /// Whether the surface exists at a place: it is on the map and not in a hole.
    fn contains(&self, x: W::Ground, z: W::Ground, site: Site) -> bool;
    /// Its height there.
    fn height(&self, x: W::Ground, z: W::Ground, site: Site) -> W::Height;
}
