//! Where a line crosses a triangle: watertight, in f64, from both sides alike.

use crate::geometry::edge::{cross, resolve};
use crate::geometry::line::Line;
use glam::DVec3;

/// A triangle where the traversal finds it, corners in world space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    pub(crate) corners: [[f64; 3]; 3],
    /// Number that does not depend on the tree.
    pub(crate) id: u32,
    /// Index of the body it belongs to.
    pub(crate) body: u32,
}

/// A line's passage through a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pierce {
    pub(crate) t: f64,
    /// Weights of the corners, ≥ 0, sum 1.
    pub(crate) weights: [f64; 3],
    /// True when the line goes against the normal. From exact signs.
    pub(crate) entering: bool,
}

/// A passage as it is found: what [`Pierce`] says of it is worked out once it
/// is known to be the answer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passage {
    pub(crate) t: f64,
    /// Twice the areas that the line's place spans with the edges opposite to
    /// each corner; all of one sign, also where they are zero.
    pub(crate) areas: [f64; 3],
}

impl Passage {
    /// The passage of a line through a triangle, coordinate by corner and axis.
    #[inline(always)]
    pub(crate) fn new(line: &Line, at: impl Fn(usize, usize) -> f64) -> Option<Self> {
        let (a, a_t) = line.see(|axis| at(0, axis));
        let (b, b_t) = line.see(|axis| at(1, axis));
        let (c, c_t) = line.see(|axis| at(2, axis));
        let [mut u, mut v, mut w] = [cross(c, b), cross(a, c), cross(b, a)];
        if u == 0.0 || v == 0.0 || w == 0.0 {
            [u, v, w] = [resolve(c, b), resolve(a, c), resolve(b, a)];
        }
        let negative = u.is_sign_negative();
        if v.is_sign_negative() != negative || w.is_sign_negative() != negative {
            return None;
        }
        let sum = u + v + w;
        if sum == 0.0 {
            return None;
        }
        Some(Self { t: (u * a_t + v * b_t + w * c_t) / sum, areas: [u, v, w] })
    }
}

impl From<Passage> for Pierce {
    #[inline(always)]
    fn from(Passage { t, areas }: Passage) -> Self {
        let sum = areas[0] + areas[1] + areas[2];
        Self { t, weights: areas.map(|area| area / sum), entering: areas[0].is_sign_positive() }
    }
}

impl Triangle {
    /// The passage of a line through this triangle, if there is one. Along a
    /// full line a closed mesh is entered exactly as often as it is left.
    #[cfg(test)]
    pub(crate) fn pierce(&self, line: &Line) -> Option<Pierce> {
        Passage::new(line, |corner, axis| self.corners[corner][axis]).map(Pierce::from)
    }

    pub(crate) fn corner(&self, i: usize) -> DVec3 {
        DVec3::from_array(self.corners[i])
    }

    /// Unit normal on the side from which the corners run counter-clockwise;
    /// zero for a triangle without area.
    pub(crate) fn normal(&self) -> DVec3 {
        let [a, b, c] = [0, 1, 2].map(|i| self.corner(i));
        (b - a).cross(c - a).normalize_or_zero()
    }

    /// The point with these weights.
    pub(crate) fn point(&self, weights: [f64; 3]) -> DVec3 {
        let [a, b, c] = [0, 1, 2].map(|i| self.corner(i));
        a + (b - a) * weights[1] + (c - a) * weights[2]
    }

    /// The unit normal, and the distance of the point with these weights to the
    /// nearest edge.
    pub(crate) fn normal_and_margin(&self, weights: [f64; 3]) -> (DVec3, f64) {
        let [a, b, c] = [0, 1, 2].map(|i| self.corner(i));
        let across = (b - a).cross(c - a);
        // A height over an edge is twice an area over the edge's length.
        let height2 = |weight: f64, edge: DVec3| weight * weight / edge.length_squared();
        let [u, v, w] = weights;
        let least = height2(u, c - b).min(height2(v, a - c)).min(height2(w, b - a));
        (across.normalize_or_zero(), (least * across.length_squared()).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(corners: [[f64; 3]; 3]) -> Triangle {
        Triangle { corners, id: 0, body: 0 }
    }

    #[test]
    fn entering_means_against_the_normal() {
        let t = triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [0.0, 1.0, -0.2]]);
        for origin in [DVec3::new(0.2, 0.3, 4.0), DVec3::new(3.0, -2.0, -1.0)] {
            let to = t.point([0.3, 0.3, 0.4]);
            let line = Line::new(origin, (to - origin).normalize());
            let pierce = t.pierce(&line).expect("aimed at the inside");
            assert_eq!(pierce.entering, line.direction.dot(t.normal()) < 0.0);
            assert!((line.at(pierce.t) - to).length() < 1e-14);
            assert!((t.point(pierce.weights) - to).length() < 1e-14);
        }
    }

    #[test]
    fn the_margin_is_the_distance_to_the_nearest_edge() {
        let t = triangle([[0.0, 0.0, 2.0], [3.0, 0.0, 2.0], [0.0, 4.0, 2.0]]);
        for (weights, distance) in
            [([0.5, 0.25, 0.25], 0.75), ([0.1, 0.4, 0.5], 0.24), ([0.5, 0.4, 0.1], 0.4)]
        {
            let (normal, margin) = t.normal_and_margin(weights);
            assert_eq!(normal, DVec3::Z);
            assert!((margin - distance).abs() < 1e-15, "{margin} {distance}");
        }
    }

    /// Two triangles that share an edge: a line through a point of it pierces
    /// one of them, never both or neither.
    #[test]
    fn a_line_through_a_shared_edge_meets_one_triangle() {
        let (p, q) = ([0.0, 0.0, 0.0], [1.0, 0.5, 0.25]);
        let left = triangle([p, q, [0.0, 2.0, 0.0]]);
        let right = triangle([q, p, [1.0, -2.0, 0.0]]);
        for i in 0..=64 {
            let s = f64::from(i) / 64.0;
            let on = DVec3::from_array(q) * s;
            for direction in [DVec3::Z, DVec3::NEG_Z, DVec3::new(0.6, 0.0, 0.8)] {
                let line = Line::new(on - direction * 3.0, direction);
                let met = [&left, &right].map(|t| t.pierce(&line).is_some());
                if i > 0 && i < 64 {
                    assert!(met[0] != met[1], "{s} {direction}");
                }
            }
        }
    }
}
