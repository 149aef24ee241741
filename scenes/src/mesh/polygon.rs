//! Polygons in space as triangles.

use earcut::Earcut;
use glam::{DVec2, DVec3};
use std::collections::HashSet;

/// Twice the area times the unit normal of a polygon, planar or not, by Newell's
/// sum over its sides. Source: Sutherland, Sproull & Schumacker, "A
/// Characterization of Ten Hidden-Surface Algorithms", ACM Computing Surveys
/// 6 (1), 1974, appendix.
pub(crate) fn area_vector(corners: &[DVec3]) -> DVec3 {
    let Some(first) = corners.first() else { return DVec3::ZERO };
    let from_first = |i: usize| corners[i % corners.len()] - first;
    (1..corners.len()).map(|i| from_first(i).cross(from_first(i + 1))).sum()
}

/// The corner to begin with, so that a polygon is cut the same way wherever its
/// list of corners begins.
pub(crate) fn first_corner(corners: &[DVec3]) -> usize {
    let key = |p: &DVec3| p.to_array();
    let less = |a: &usize, b: &usize| {
        key(&corners[*a]).partial_cmp(&key(&corners[*b])).unwrap_or(std::cmp::Ordering::Equal)
    };
    (0..corners.len()).min_by(less).unwrap_or(0)
}

/// A polygon cut into triangles.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Cut {
    /// Numbers of corners, in the polygon's sense; n - 2 triangles, which use
    /// each side of the polygon once.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The polygon crosses itself, so that no triangles without overlaps exist.
    pub(crate) crosses: bool,
}

/// Cuts a polygon of at least three corners, seen along its normal, without overlaps:
/// quads along the shorter diagonal that lies inside, others so that no circle through
/// a triangle's corners holds another corner that it sees (constrained Delaunay), which
/// does not depend on where the list begins.
pub(crate) fn cut(corners: &[DVec3]) -> Cut {
    let normal = area_vector(corners);
    let count = corners.len() as u32;
    if count < 4 || normal == DVec3::ZERO {
        return Cut { triangles: fan(count), crosses: false };
    }
    let found = if count == 4 { quad(corners, normal) } else { ears(corners, normal) };
    let crosses = found.is_none();
    Cut { triangles: found.unwrap_or_else(|| fan(count)), crosses }
}

fn fan(count: u32) -> Vec<[u32; 3]> {
    (1..count.saturating_sub(1)).map(|i| [0, i, i + 1]).collect()
}

fn quad(corners: &[DVec3], normal: DVec3) -> Option<Vec<[u32; 3]>> {
    let [a, b, c, d] = [corners[0], corners[1], corners[2], corners[3]];
    let faces_along = |[p, q, r]: [DVec3; 3]| (q - p).cross(r - p).dot(normal) > 0.0;
    let from_a = [[0, 1, 2], [0, 2, 3]];
    let from_b = [[1, 2, 3], [1, 3, 0]];
    let fits = |pair: &[[u32; 3]; 2]| {
        pair.iter().all(|triangle| faces_along(triangle.map(|i| corners[i as usize])))
    };
    let shorter_first =
        if a.distance(c) <= b.distance(d) { [from_a, from_b] } else { [from_b, from_a] };
    shorter_first.into_iter().find(fits).map(|pair| pair.to_vec())
}

fn ears(corners: &[DVec3], normal: DVec3) -> Option<Vec<[u32; 3]>> {
    let normal = normal.try_normalize()?;
    let (right, up) = normal.any_orthonormal_pair();
    let flat: Vec<[f64; 2]> = corners
        .iter()
        .map(|p| {
            let p = *p - corners[0];
            DVec2::new(p.dot(right), p.dot(up)).to_array()
        })
        .collect();
    let mut numbers: Vec<u32> = Vec::new();
    Earcut::new().earcut_slice(&flat, &[], &mut numbers);
    let mut triangles = numbers.as_chunks().0.to_vec();
    let count = corners.len() as u32;
    let is_along = |[a, b, c]: &[u32; 3]| {
        let next = |from: u32, to: u32| to == (from + 1) % count;
        next(*a, *b) || next(*b, *c) || next(*c, *a)
    };
    if !triangles.iter().any(is_along) {
        triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    let mut triangles = with_skipped_corners(triangles, count)?;
    earcut::refine(triangles.as_flattened_mut(), &flat);
    has_sides(&triangles, count).then_some(triangles)
}

/// Corners that lie on a straight side are skipped by the cutter, and would leave
/// a gap beside the neighbour that has them: the triangle at such a side becomes
/// several. `None` if the sides are not those of the polygon after all.
fn with_skipped_corners(mut open: Vec<[u32; 3]>, count: u32) -> Option<Vec<[u32; 3]>> {
    let sides_of = |[a, b, c]: [u32; 3]| [(a, b), (b, c), (c, a)];
    let mut sides: HashSet<(u32, u32)> = open.iter().copied().flat_map(sides_of).collect();
    let mut done = Vec::with_capacity(count as usize - 2);
    while let Some(triangle) = open.pop() {
        if done.len() + open.len() + 3 > count as usize {
            return None;
        }
        let gap = (0..3).find(|i| {
            let (from, to) = sides_of(triangle)[*i];
            !sides.contains(&(to, from)) && to != (from + 1) % count
        });
        let Some(gap) = gap else {
            done.push(triangle);
            continue;
        };
        let [from, to, apex] = [0, 1, 2].map(|i| triangle[(gap + i) % 3]);
        let between = (from + 1) % count;
        sides.remove(&(from, to));
        sides.extend([(from, between), (between, to), (between, apex), (apex, between)]);
        open.extend([[from, between, apex], [between, to, apex]]);
    }
    // What the refiner asks for: each side of the polygon once, the others in pairs.
    (done.len() + 2 == count as usize && has_sides(&done, count)).then_some(done)
}

/// True if the triangles' sides cancel but for each side of the polygon, once.
fn has_sides(triangles: &[[u32; 3]], count: u32) -> bool {
    let mut sides: Vec<(u32, u32, bool)> = triangles
        .iter()
        .flat_map(|[a, b, c]| [(*a, *b), (*b, *c), (*c, *a)])
        .map(|(from, to)| (from.min(to), from.max(to), from < to))
        .collect();
    sides.sort_unstable();
    let mut outer = 0;
    sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).all(|side| match side {
        [(low, high, upwards)] => {
            outer += 1;
            if *upwards { low + 1 == *high } else { *low == 0 && high + 1 == count }
        }
        [one, two] => one.2 != two.2,
        _ => false,
    }) && outer == count
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(corners: &[DVec3], by: usize) -> Vec<DVec3> {
        (0..corners.len()).map(|i| corners[(i + by) % corners.len()]).collect()
    }

    /// In a plane that is no coordinate plane.
    fn outline(points: &[[f64; 2]]) -> Vec<DVec3> {
        let (u, v) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.48, 0.8, -0.36));
        points.iter().map(|[x, y]| u * *x + v * *y).collect()
    }

    fn area(corners: &[DVec3]) -> f64 {
        0.5 * area_vector(corners).length()
    }

    /// Triangles that neither overlap nor leave anything out have together the
    /// area of the polygon, and each faces along it.
    fn covers(corners: &[DVec3], cut: &Cut) -> bool {
        let normal = area_vector(corners);
        let pieces = cut.triangles.iter().map(|t| t.map(|i| corners[i as usize]));
        let whole: f64 = pieces.clone().map(|t| area(&t)).sum();
        pieces.clone().all(|t| area_vector(&t).dot(normal) >= -1e-12)
            && (whole - area(corners)).abs() < 1e-11 * whole
            && has_sides(&cut.triangles, corners.len() as u32)
            && !cut.crosses
    }

    const SHAPES: [&[[f64; 2]]; 5] = [
        // An L, an arrow head, a star, a comb, and a square with corners on its sides.
        &[[-1.0, -1.0], [1.0, -1.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [-1.0, 1.0]],
        &[[0.0, 0.0], [2.0, -1.0], [0.5, 0.0], [2.0, 1.0]],
        &[
            [0.0, 3.0],
            [-0.5, 0.5],
            [-3.0, 0.0],
            [-0.5, -0.5],
            [0.0, -3.0],
            [0.5, -0.5],
            [3.0, 0.0],
            [0.5, 0.5],
        ],
        &[
            [0.0, 0.0],
            [5.0, 0.0],
            [5.0, 3.0],
            [4.0, 3.0],
            [4.0, 1.0],
            [3.0, 1.0],
            [3.0, 3.0],
            [2.0, 3.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [0.0, 3.0],
        ],
        &[
            [0.0, 0.0],
            [1.0, 0.0],
            [2.0, 0.0],
            [2.0, 1.0],
            [2.0, 2.0],
            [1.5, 2.0],
            [1.0, 2.0],
            [0.0, 2.0],
            [0.0, 1.0],
        ],
    ];

    #[test]
    fn concave_polygons_are_covered_once_wherever_they_begin() {
        for shape in SHAPES {
            let corners = outline(shape);
            for by in 0..corners.len() {
                let corners = turned(&corners, by);
                let cut = cut(&corners);
                assert!(covers(&corners, &cut), "{shape:?} from {by}: {cut:?}");
            }
        }
        // A fan from the wrong corner does not cover an L.
        let bad = turned(&outline(SHAPES[0]), 1);
        assert!(!covers(&bad, &Cut { triangles: fan(6), crosses: false }));
    }

    /// Random outlines about a point, with a corner in the middle of every second side:
    /// nearly on it, since the plane is tilted.
    #[test]
    fn random_outlines_are_covered_once() {
        let mut state = 7u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as f64 / f64::from(1u32 << 31)
        };
        for round in 0..300 {
            let count = 5 + round % 40;
            let mut points: Vec<[f64; 2]> = Vec::new();
            for i in 0..count {
                let turn =
                    std::f64::consts::TAU * (f64::from(i) + 0.8 * random()) / f64::from(count);
                let point = DVec2::from_angle(turn) * (0.2 + random());
                if let Some(last) = points.last().filter(|_| i % 2 == 1) {
                    points.push((0.5 * (DVec2::from_array(*last) + point)).to_array());
                }
                points.push(point.to_array());
            }
            let corners = outline(&points);
            let cut = cut(&corners);
            assert!(covers(&corners, &cut), "{round}: {points:?} {cut:?}");
        }
    }

    #[test]
    fn the_first_corner_is_the_same_point_wherever_the_list_begins() {
        let corners = outline(SHAPES[2]);
        let first = corners[first_corner(&corners)];
        for by in 0..corners.len() {
            let list = turned(&corners, by);
            assert_eq!(list[first_corner(&list)], first);
        }
    }

    #[test]
    fn a_bow_tie_is_told_from_a_square() {
        let square = outline(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let tie = outline(&[[0.0, 0.0], [1.0, 0.0], [0.0, 2.0], [1.0, 1.0]]);
        assert!(!cut(&square).crosses && cut(&tie).crosses);
        assert_eq!(cut(&tie).triangles.len(), 2);
    }

    /// Nothing to see along: a fan, without complaint.
    #[test]
    fn a_polygon_without_area_is_a_fan() {
        let line = outline(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [1.5, 0.0]]);
        assert_eq!(cut(&line).triangles.len(), 3);
    }
}
