//! Where a camera sees all ground of a map.

use glam::{DMat3, DVec3};

use crate::scene::height_map::HeightMap;

/// Share of the screen that the map may fill.
const FILLED: f64 = 0.94;

/// What a camera sees from wherever it stands: its axes, and how far its screen reaches from the axis
/// of sight, as tangents.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    /// Columns u (forward), v (up) and w (to the right) in the ground frame.
    pub axes: DMat3,
    /// To the left.
    pub left: f64,
    /// To the right.
    pub right: f64,
    /// Upwards.
    pub up: f64,
    /// Downwards.
    pub down: f64,
}

impl Sight {
    /// Where the camera sees all these points as large as the screen allows, from above `top`;
    /// `None` if it would have to stand below `top` and does not look down.
    ///
    /// With the camera's axes u, v and w, a point p is seen if p·w - a ≤ k (p·u + D) and
    /// a - p·w ≤ l (p·u + D) for a camera at a w + b v - D u, and likewise for v. Of
    /// A = max(p·w - k p·u) and B = max(-p·w - l p·u), the nearest camera has D = (A + B)/(k + l);
    /// the larger D of the two axes serves both. Any a from A - k D to l D - B will do: the middle.
    #[must_use]
    pub fn overlooking(&self, points: &[DVec3], top: f64) -> Option<DVec3> {
        let DMat3 { x_axis: u, y_axis: v, z_axis: w } = self.axes;
        let across = Fit::new(points, u, w, self.right, self.left);
        let upright = Fit::new(points, u, v, self.up, self.down);
        let place =
            |distance: f64| w * across.aside(distance) + v * upright.aside(distance) - u * distance;
        let distance = across.nearest().max(upright.nearest());
        // On a very high screen all may fit from below the top: step back, which is up.
        let bottom = points.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
        let least = top + (top - bottom) / 8.0;
        let position = place(distance);
        if position.y >= least {
            return Some(position);
        }
        let per_distance = (w * across.drift() + v * upright.drift() - u).y;
        (per_distance > 0.0).then(|| place(distance + (least - position.y) / per_distance))
    }
}

/// How points fit on a screen along one of its axes.
struct Fit {
    /// Tangents in the direction of the axis and against it.
    reach: [f64; 2],
    /// The outermost points, as A and B of [`Sight::overlooking`].
    most: [f64; 2],
}

impl Fit {
    fn new(points: &[DVec3], u: DVec3, axis: DVec3, along: f64, against: f64) -> Self {
        // The part of the screen that may be filled, in its middle.
        let (middle, half) = ((along - against) / 2.0, (along + against) / 2.0 * FILLED);
        let reach = [half + middle, half - middle];
        let mut most = [f64::NEG_INFINITY; 2];
        for p in points {
            most[0] = most[0].max(p.dot(axis) - reach[0] * p.dot(u));
            most[1] = most[1].max(-p.dot(axis) - reach[1] * p.dot(u));
        }
        Self { reach, most }
    }

    /// D of the nearest camera.
    fn nearest(&self) -> f64 {
        (self.most[0] + self.most[1]) / (self.reach[0] + self.reach[1])
    }

    /// Where on the axis a camera at a distance stands.
    fn aside(&self, distance: f64) -> f64 {
        (self.most[0] - self.most[1]) / 2.0 + self.drift() * distance
    }

    /// How far that moves per unit of distance.
    fn drift(&self) -> f64 {
        (self.reach[1] - self.reach[0]) / 2.0
    }
}

/// Corners of boxes that enclose all ground, a box for each row of nodes: from `bottom` to the row's
/// highest node by `height`, which gives that of a sample in scene units.
pub fn outline(
    map: &HeightMap,
    cell: glam::DVec2,
    bottom: f64,
    height: impl Fn(f32) -> f64,
) -> Vec<DVec3> {
    let mut corners = Vec::new();
    for (j, row) in map.samples().chunks_exact(map.columns()).enumerate() {
        let data = |sample: &f32| !sample.is_nan();
        let (Some(west), Some(east)) = (row.iter().position(data), row.iter().rposition(data))
        else {
            continue;
        };
        let top = height(row.iter().copied().fold(f32::NEG_INFINITY, f32::max));
        for i in [west, east] {
            for y in [bottom, top] {
                corners.push(DVec3::new(i as f64 * cell.x, y, j as f64 * cell.y));
            }
        }
    }
    corners
}
