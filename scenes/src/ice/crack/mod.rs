//! Crack surfaces inside a body: curved sheets with an irregular outline, posed
//! at random about the body's centre and larger than it, so that clipping shows
//! where they end.
//!
//! Source of the method: Seipel & Nivfors, "Efficient rendering of multiple
//! refractions and reflections in natural objects", SIGRAD 2006. Shape and poses
//! are not in the paper; ours are stated here.

mod clip;

pub use clip::clipped;

use crate::ice::pose::{centre_and_diagonal, offset, placed, rotation};
use crate::noise::{SplitMix64, fbm};
use crate::scene::Crack;
use crate::{Mesh, normals};
use glam::{DAffine3, DVec2, DVec3};

/// Most grid points along a side.
const MOST_POINTS: u32 = 128;

/// The crack surfaces of a body with the given bounding box, in the body's
/// space, not clipped. The same seed gives the same bits.
#[must_use]
pub fn cracks(crack: &Crack, bounds: [DVec3; 2]) -> Vec<Mesh> {
    crack_poses(crack, bounds)
        .into_iter()
        .zip(0..)
        .map(|(body_from_crack, number)| {
            let sheet = crack_surface(crack.grid, crack.seed.wrapping_add(number));
            let mesh = sheet.with_positions(|p| body_from_crack.transform_point3(p));
            let normals = normals::smooth(&mesh);
            Mesh { normals: Some(normals), ..mesh }
        })
        .collect()
}

/// Body space from the space of each unit crack surface: a uniform rotation, a
/// centre within a quarter of the box's diagonal d (normally distributed, 0.1 d
/// along each axis), and a radius of 0.5 to 0.7 d.
#[must_use]
pub fn crack_poses(crack: &Crack, bounds: [DVec3; 2]) -> Vec<DAffine3> {
    let (centre, diagonal) = centre_and_diagonal(bounds);
    let mut random = SplitMix64(crack.seed);
    (0..crack.count)
        .map(|_| {
            let turn = rotation(&mut random);
            let at = centre + offset(&mut random, 0.1 * diagonal, 0.25 * diagonal);
            placed((0.5 + 0.2 * random.uniform()) * diagonal, turn, at)
        })
        .collect()
}

/// A crack surface of about unit radius: `grid` x `grid` vertices (row by row)
/// over a disc in the x-y plane whose radius varies by a quarter, at the height
/// 0.25 (x² - 0.5 y²) + 0.12 fBm. Open; smooth normals.
#[must_use]
pub fn crack_surface(grid: u32, seed: u64) -> Mesh {
    let grid = grid.clamp(2, MOST_POINTS);
    let at = |i: u32| 2.0 * f64::from(i) / f64::from(grid - 1) - 1.0;
    let mut mesh = Mesh::default();
    for row in 0..grid {
        mesh.positions.extend((0..grid).map(|column| sheet(at(column), at(row), seed)));
    }
    for row in 0..grid - 1 {
        for column in 0..grid - 1 {
            let a = row * grid + column;
            let [b, c, d] = [a + 1, a + grid + 1, a + grid];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh.normals = Some(normals::smooth(&mesh));
    mesh
}

/// Point of the sheet over a point of the square |x|, |y| ≤ 1.
fn sheet(x: f64, y: f64, seed: u64) -> DVec3 {
    let disc = DVec2::new(x * (1.0 - 0.5 * y * y).sqrt(), y * (1.0 - 0.5 * x * x).sqrt());
    let direction = disc.normalize_or(DVec2::X);
    let wobble = fbm((1.5 * direction).extend(0.0), 3, seed.wrapping_add(0x5eed)).value;
    let p = disc * (1.0 + 0.25 * wobble);
    let height = 0.25 * (p.x * p.x - 0.5 * p.y * p.y);
    p.extend(height + 0.12 * fbm((3.0 * p).extend(0.0), 3, seed).value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topology::{inspect, rims};

    const BOUNDS: [DVec3; 2] = [DVec3::NEG_ONE, DVec3::ONE];
    const CRACK: Crack = Crack { count: 40, grid: 24, seed: 9 };

    #[test]
    fn a_sheet_is_one_open_piece_with_one_rim() {
        for seed in 0..20 {
            let mesh = crack_surface(24, seed);
            let report = inspect(&mesh);
            assert_eq!((report.components, report.euler_characteristic), (1, 1));
            assert_eq!((report.triangles, report.boundary_edges), (2 * 23 * 23, 4 * 23));
            assert_eq!((report.inconsistent_edges, rims(&mesh).len()), (0, 1));
            let radius = mesh.positions.iter().map(|p| p.truncate().length()).fold(0.0, f64::max);
            assert!((1.0..=1.25).contains(&radius), "{radius}");
        }
    }

    #[test]
    fn seeds_decide_everything() {
        assert_eq!(cracks(&CRACK, BOUNDS), cracks(&CRACK, BOUNDS));
        let other = Crack { seed: 10, ..CRACK };
        assert_ne!(cracks(&CRACK, BOUNDS)[0], cracks(&other, BOUNDS)[0]);
        // More cracks leave the first ones where they were.
        let fewer = Crack { count: 2, ..CRACK };
        assert_eq!(cracks(&fewer, BOUNDS), cracks(&CRACK, BOUNDS)[..2]);
    }

    #[test]
    fn poses_keep_their_limits_and_use_them() {
        let diagonal = 12.0f64.sqrt();
        let mut turned = 0;
        for pose in crack_poses(&CRACK, BOUNDS) {
            let (scale, turn, at) = pose.to_scale_rotation_translation();
            assert!((0.5..=0.7).contains(&(scale.x / diagonal)));
            assert!(at.length() <= 0.25 * diagonal);
            turned += usize::from((turn * DVec3::Z).z < 0.0);
        }
        assert!((10..30).contains(&turned), "{turned} of 40 upside down");
    }

    /// Moving and scaling the body moves and scales its cracks.
    #[test]
    fn cracks_follow_the_body() {
        let shift = DVec3::new(4.0, -2.0, 8.0);
        let bounds = BOUNDS.map(|p| 2.0 * p + shift);
        let (here, there) = (cracks(&CRACK, BOUNDS), cracks(&CRACK, bounds));
        for (p, q) in here[3].positions.iter().zip(&there[3].positions) {
            assert!(q.distance(2.0 * p + shift) < 1e-14);
        }
    }
}
