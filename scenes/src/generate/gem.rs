//! The round brilliant cut.

use super::grid::index;
use crate::Mesh;
use glam::DVec3;

/// Proportions of a brilliant, for a girdle of unit radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brilliant {
    /// Angle of the eight large crown facets against the girdle plane, degrees.
    pub crown_deg: f64,
    /// Angle of the eight large pavilion facets, degrees.
    pub pavilion_deg: f64,
    /// Radius of the table's corners.
    pub table: f64,
    /// Where the star facets end: share of the way from table edge to girdle.
    pub star: f64,
    /// Length of the lower girdle facets: share of the way from girdle to culet.
    pub lower: f64,
    /// Height of the girdle's wall.
    pub girdle: f64,
}

impl Default for Brilliant {
    /// Close to Tolkowsky's proportions (*Diamond Design*, 1919).
    fn default() -> Self {
        Self {
            crown_deg: 34.5,
            pavilion_deg: 40.75,
            table: 0.56,
            star: 0.5,
            lower: 0.77,
            girdle: 0.04,
        }
    }
}

/// A round brilliant with 57 facets (table, 8 stars, 8 kites, 16 upper and 16
/// lower girdle facets, 8 pavilion mains) and a girdle of 16 flat pieces.
/// Girdle radius 1, table up, girdle about y = 0: 110 triangles.
#[must_use]
pub fn brilliant(cut: Brilliant) -> Mesh {
    let turn = |eighths: f64, radius: f64, y: f64| {
        let (sin, cos) = (eighths * std::f64::consts::FRAC_PI_4).sin_cos();
        DVec3::new(radius * cos, y, -radius * sin)
    };
    let half_step = (0.5 * std::f64::consts::FRAC_PI_4).cos();
    let half_girdle = 0.5 * cut.girdle;
    let crown = |x: f64| half_girdle + (1.0 - x) * cut.crown_deg.to_radians().tan();
    let pavilion = |x: f64| -half_girdle - (1.0 - x) * cut.pavilion_deg.to_radians().tan();
    let star = cut.table * half_step + cut.star * (1.0 - cut.table * half_step);
    let lower = 1.0 - cut.lower;

    let mut mesh = Mesh::default();
    // Per eighth k: table T, star tip S (half a step on), upper girdle G and M
    // (half a step on), lower girdle H and N, pavilion corner L (half a step on).
    for k in 0..8 {
        let k = f64::from(k);
        mesh.positions.extend([
            turn(k, cut.table, crown(cut.table)),
            turn(k + 0.5, star, crown(star * half_step)),
            turn(k, 1.0, half_girdle),
            turn(k + 0.5, 1.0, half_girdle),
            turn(k, 1.0, -half_girdle),
            turn(k + 0.5, 1.0, -half_girdle),
            turn(k + 0.5, lower, pavilion(lower * half_step)),
        ]);
    }
    let culet = index(mesh.positions.len());
    mesh.positions.push(DVec3::new(0.0, pavilion(0.0), 0.0));
    for k in 0..8 {
        let [t, s, g, m, h, n, l] = [0, 1, 2, 3, 4, 5, 6].map(|i| 7 * k + i);
        let next = 7 * ((k + 1) % 8);
        let [t1, g1, h1] = [next, next + 2, next + 4];
        let last = 7 * ((k + 7) % 8);
        let [s0, l0] = [last + 1, last + 6];
        if (1..7).contains(&k) {
            mesh.triangles.push([0, t, t1]);
        }
        mesh.triangles.extend([
            [t, s, t1], // star
            [t, s0, g],
            [t, g, s], // kite
            [s, g, m],
            [s, m, g1], // upper girdle
            [g, h, n],
            [g, n, m],
            [m, n, h1],
            [m, h1, g1], // girdle
            [l, n, h],
            [l, h1, n], // lower girdle
            [culet, l, h],
            [culet, h, l0], // pavilion main
        ]);
    }
    mesh
}
