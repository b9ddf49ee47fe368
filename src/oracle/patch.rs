//! One smooth patch of the terrain: 3×3 nodes mixed by the weights of both axes.
//!
//! With r_m the mixture of row m along z and c the pivot, `r_m = h_mc + a_z (h_ma − h_mc) +
//! b_z (h_mb − h_mc)` and `y = r_c + a_x (r_a − r_c) + b_x (r_b − r_c)`. Over two nodes per axis
//! this is `A = h2 + (h1 − h2) f(zd)`, `B = h4 + (h3 − h4) f(zd)`, `y = B + (A − B) f(xd)`.

use super::kernel::Stencil;

/// Height and slopes at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Height {
    /// Scene units.
    pub y: f64,
    /// ∂y/∂X, scene units per cell.
    pub dx: f64,
    /// ∂y/∂Z, scene units per cell.
    pub dz: f64,
}

/// Bounds on the change of the surface's height along a straight line through the patch, per λ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// Least possible dy/dλ.
    pub low: f64,
    /// Greatest possible dy/dλ.
    pub high: f64,
    /// Bound of the Lipschitz constant of dy/dλ.
    pub bend: f64,
}

/// A patch: its nodes `nodes[m][n]`, m along x and n along z, each in the order pivot, before,
/// after; scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    stencil: Stencil,
    nodes: [[f64; 3]; 3],
}

impl Patch {
    /// A patch from its nodes.
    #[must_use]
    pub fn new(stencil: Stencil, nodes: [[f64; 3]; 3]) -> Self {
        Self { stencil, nodes }
    }

    /// Whether one of its nodes has no data: there is no surface then.
    #[must_use]
    pub fn is_hole(&self) -> bool {
        self.nodes.as_flattened().iter().any(|height| height.is_nan())
    }

    /// Lowest and highest node: the surface lies between them, since no weight is negative.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        self.nodes
            .as_flattened()
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &h| (low.min(h), high.max(h)))
    }

    /// Height and slopes at (px, pz), each in \[0, 1\] from the patch's beginning.
    #[must_use]
    pub fn height(&self, px: f64, pz: f64) -> Height {
        let x = self.stencil.weights(px);
        let z = self.stencil.weights(pz);
        let [pivot, before, after] =
            self.nodes.map(|[c, a, b]| c + (z.a * (a - c) + z.b * (b - c)));
        let [pivot_dz, before_dz, after_dz] =
            self.nodes.map(|[c, a, b]| z.da * (a - c) + z.db * (b - c));
        Height {
            y: pivot + (x.a * (before - pivot) + x.b * (after - pivot)),
            dx: x.da * (before - pivot) + x.db * (after - pivot),
            dz: pivot_dz + (x.a * (before_dz - pivot_dz) + x.b * (after_dz - pivot_dz)),
        }
    }

    /// Bounds along a line that moves (dx, dz) cells per λ.
    #[must_use]
    pub fn rates(&self, dx: f64, dz: f64) -> Rates {
        let slope = self.stencil.slope_bound();
        let curvature = self.stencil.curvature_bound();
        let n = &self.nodes;
        let along_x = Differences::new(|m, k| n[m][k] - n[0][k]);
        let along_z = Differences::new(|m, k| n[k][m] - n[k][0]);
        let (x_low, x_high) = scaled(along_x.slopes(slope), dx);
        let (z_low, z_high) = scaled(along_z.slopes(slope), dz);
        let twist: f64 = [(1, 1), (1, 2), (2, 1), (2, 2)]
            .map(|(m, k)| ((n[m][k] - n[0][k]) - (n[m][0] - n[0][0])).abs())
            .iter()
            .sum();
        Rates {
            low: x_low + z_low,
            high: x_high + z_high,
            bend: dx * dx * curvature * along_x.size()
                + 2.0 * (dx * dz).abs() * slope * slope * twist
                + dz * dz * curvature * along_z.size(),
        }
    }
}

/// Ranges of the differences (before − pivot) and (after − pivot) over the three lines across.
struct Differences {
    before: (f64, f64),
    after: (f64, f64),
}

impl Differences {
    fn new(difference: impl Fn(usize, usize) -> f64) -> Self {
        let range = |m| {
            let [c, a, b] = [0, 1, 2].map(|k| difference(m, k));
            (c.min(a).min(b), c.max(a).max(b))
        };
        Self { before: range(1), after: range(2) }
    }

    /// Range of `da (before − pivot) + db (after − pivot)` for −bound ≤ da ≤ 0 ≤ db ≤ bound.
    fn slopes(&self, bound: f64) -> (f64, f64) {
        (
            bound * ((-self.before.1).min(0.0) + self.after.0.min(0.0)),
            bound * ((-self.before.0).max(0.0) + self.after.1.max(0.0)),
        )
    }

    /// Sum of the greatest sizes of both differences.
    fn size(&self) -> f64 {
        self.before.0.abs().max(self.before.1.abs()) + self.after.0.abs().max(self.after.1.abs())
    }
}

fn scaled((low, high): (f64, f64), factor: f64) -> (f64, f64) {
    if factor < 0.0 { (high * factor, low * factor) } else { (low * factor, high * factor) }
}
