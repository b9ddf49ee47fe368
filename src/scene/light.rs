//! `[light]` and `[color]`: what the shader makes of the surface.

use glam::DVec3;

use super::kind::Kind;
use super::table::table;

table! {
    /// Direction towards the light, and what shines from everywhere.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Light {
        /// Towards the light, in the ground frame.
        ///
        /// A unit vector.
        direction: DVec3 = DVec3::new(-1.0, 1.5, -1.0).normalize(), Kind::UnitDirection;
        /// Share of the light that comes from everywhere.
        ambient: f64 = 0.3, Kind::Number(0.0..=1.0);
    }
}

table! {
    /// Colours, sRGB bytes.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Colors {
        /// From the lowest to the highest node, evenly spaced, linear in sRGB bytes.
        ramp: Vec<[u8; 3]> = vec![[0, 0, 255], [255, 0, 0]], Kind::colors(2..=16);
        /// A ray that meets nothing.
        sky: [u8; 3] = [160, 190, 220], Kind::color();
        /// A ray that meets something out of the registers' range.
        far: [u8; 3] = [160, 190, 220], Kind::color();
        /// The side of the map, where a ray enters it below ground.
        side: [u8; 3] = [96, 82, 64], Kind::color();
        /// The two colours of a checkered plane.
        checker: [[u8; 3]; 2] = [[200, 200, 190], [70, 90, 70]], Kind::colors(2..=2);
    }
}
