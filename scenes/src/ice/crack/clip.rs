//! Sheets cut off exactly where they leave a body.

use crate::ice::columns::Columns;
use crate::topology::weld;
use crate::{Mesh, mesh::CornerNormals};
use glam::DVec3;

/// The part of a sheet inside a closed mesh (winding number above zero).
///
/// Every triangle of the sheet is cut along the planes of the body's triangles
/// that cross it, so that no piece crosses the surface; pieces inside stay.
/// Normals are interpolated. Both meshes in the same space.
#[must_use]
pub fn clipped(sheet: &Mesh, body: &Mesh) -> Mesh {
    let columns = Columns::new(body);
    let mut inside = Mesh { normals: Some(CornerNormals::default()), ..Mesh::default() };
    for triangle in 0..sheet.triangles.len() {
        let corners = sheet.corners(triangle);
        for piece in pieces(corners, body, &columns) {
            let centre = piece.iter().sum::<DVec3>() / piece.len() as f64;
            if columns.winding(centre) > 0 {
                add(&mut inside, sheet, triangle, &piece);
            }
        }
    }
    if sheet.normals.is_none() {
        inside.normals = None;
    }
    weld(&inside)
}

/// Convex pieces of a triangle that the body's surface does not cross.
fn pieces(corners: [DVec3; 3], body: &Mesh, columns: &Columns) -> Vec<Vec<DVec3>> {
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let mut pieces = vec![corners.to_vec()];
    for index in columns.near([a.min(b).min(c), a.max(b).max(c)]) {
        let Some(cut) = crossing(body.corners(index), normal, a) else { continue };
        let out = body.area_vector(index);
        let origin = body.corners(index)[0];
        pieces = pieces
            .into_iter()
            .flat_map(|piece| {
                if meets(&piece, normal, cut) { split(&piece, out, origin) } else { vec![piece] }
            })
            .collect();
    }
    pieces
}

/// Where a triangle crosses the plane through `origin`: both ends of the cut.
fn crossing(corners: [DVec3; 3], normal: DVec3, origin: DVec3) -> Option<[DVec3; 2]> {
    let height = corners.map(|p| normal.dot(p - origin));
    let mut ends = (0..3).filter_map(|i| {
        let j = (i + 1) % 3;
        let is_crossed = (height[i] < 0.0) != (height[j] < 0.0);
        is_crossed.then(|| corners[i].lerp(corners[j], height[i] / (height[i] - height[j])))
    });
    Some([ends.next()?, ends.next()?])
}

/// True where a segment in the piece's plane touches the convex piece.
fn meets(piece: &[DVec3], normal: DVec3, [from, to]: [DVec3; 2]) -> bool {
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for (i, corner) in piece.iter().enumerate() {
        let inward = normal.cross(piece[(i + 1) % piece.len()] - corner);
        let [start, end] = [inward.dot(from - corner), inward.dot(to - corner)];
        if start < 0.0 && end < 0.0 {
            return false;
        }
        if start < 0.0 {
            enter = enter.max(start / (start - end));
        } else if end < 0.0 {
            leave = leave.min(start / (start - end));
        }
    }
    enter <= leave
}

/// Both parts of a convex polygon on the two sides of a plane; one where the
/// plane misses it.
fn split(piece: &[DVec3], out: DVec3, origin: DVec3) -> Vec<Vec<DVec3>> {
    let height: Vec<f64> = piece.iter().map(|p| out.dot(p - origin)).collect();
    let mut parts = [Vec::new(), Vec::new()];
    for i in 0..piece.len() {
        let j = (i + 1) % piece.len();
        let above = usize::from(height[i] >= 0.0);
        parts[above].push(piece[i]);
        if (height[i] >= 0.0) != (height[j] >= 0.0) {
            let share = height[i] / (height[i] - height[j]);
            let cut = piece[i].lerp(piece[j], share);
            parts.iter_mut().for_each(|part| part.push(cut));
        }
    }
    parts.into_iter().filter(|part| has_area(part)).collect()
}

fn has_area(piece: &[DVec3]) -> bool {
    piece.len() > 2 && area_vector(piece) != DVec3::ZERO
}

fn area_vector(piece: &[DVec3]) -> DVec3 {
    piece.windows(2).map(|pair| (pair[0] - piece[0]).cross(pair[1] - piece[0])).sum()
}

/// Adds a piece of a sheet's triangle as a fan.
fn add(mesh: &mut Mesh, sheet: &Mesh, triangle: usize, piece: &[DVec3]) {
    let index = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
    let first = index(mesh.positions.len());
    let fan = (1..index(piece.len()) - 1).map(|i| [0, i, i + 1]);
    mesh.triangles.extend(fan.clone().map(|corners| corners.map(|i| first + i)));
    mesh.positions.extend_from_slice(piece);
    if let Some((ours, theirs)) = mesh.normals.as_mut().zip(sheet.normals.as_ref()) {
        let first = index(ours.values.len());
        ours.indices.extend(fan.map(|corners| corners.map(|i| first + i)));
        let at_corners = theirs.indices[triangle].map(|i| theirs.values[i as usize]);
        ours.values.extend(piece.iter().map(|p| {
            let w = weights(sheet.corners(triangle), *p);
            (w.x * at_corners[0] + w.y * at_corners[1] + w.z * at_corners[2])
                .normalize_or(at_corners[0])
        }));
    }
}

/// Barycentric coordinates of a point in a triangle's plane.
fn weights([a, b, c]: [DVec3; 3], p: DVec3) -> DVec3 {
    let normal = (b - a).cross(c - a);
    let part = |q: DVec3, r: DVec3| (q - p).cross(r - p).dot(normal) / normal.length_squared();
    DVec3::new(part(b, c), part(c, a), part(a, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crack::crack_surface;
    use crate::generate::{cube, cuboid, geodesic, shell, teapot, torus};
    use crate::noise::SplitMix64;

    fn area(mesh: &Mesh) -> f64 {
        (0..mesh.triangles.len()).map(|i| 0.5 * mesh.area_vector(i).length()).sum()
    }

    /// A sheet that sticks out of every body on all sides.
    fn sheet(scale: f64, seed: u64) -> Mesh {
        let turn = glam::DQuat::from_rotation_x(0.7 + seed as f64);
        crack_surface(24, seed).with_positions(|p| turn * (scale * p))
    }

    /// A plane cuts a cube of edge 2 in a square of area 4, a ball in a disc.
    #[test]
    fn flat_sheets_give_plane_sections() {
        let flat = |z: f64| crack_surface(24, 1).with_positions(|p| (4.0 * p).with_z(z));
        let cut = clipped(&flat(0.3), &cuboid(DVec3::ONE));
        assert!((area(&cut) - 4.0).abs() < 1e-12, "{}", area(&cut));
        let [low, high] = cut.bounds();
        assert!(low.distance(DVec3::new(-1.0, -1.0, 0.3)) < 1e-14);
        assert!(high.distance(DVec3::new(1.0, 1.0, 0.3)) < 1e-14);
        let disc = area(&clipped(&flat(0.6), &geodesic(24)));
        assert!((disc / (std::f64::consts::PI * 0.64) - 1.0).abs() < 5e-3, "{disc}");
        let ring = area(&clipped(&flat(0.0), &shell(24, 0.5)));
        assert!((ring / (std::f64::consts::PI * 0.75) - 1.0).abs() < 5e-3, "{ring}");
        assert_eq!(clipped(&flat(1.5), &cuboid(DVec3::ONE)).triangles.len(), 0);
    }

    /// Nothing is lost by cutting, and every piece lies on one side only:
    /// random points of each piece agree with its centre.
    #[test]
    fn pieces_cover_the_sheet_and_do_not_cross_the_surface() {
        let mut random = SplitMix64(8);
        for (seed, body) in [cube(3), teapot(6), torus(1.0, 0.4, 24, 12)].iter().enumerate() {
            let sheet = sheet(1.5, seed as u64);
            let columns = Columns::new(body);
            let (mut covered, mut wrong, mut inside) = (0.0, 0.0, 0);
            for triangle in 0..sheet.triangles.len() {
                for piece in pieces(sheet.corners(triangle), body, &columns) {
                    let area = 0.5 * area_vector(&piece).length();
                    covered += area;
                    let centre = piece.iter().sum::<DVec3>() / piece.len() as f64;
                    let is_inside = columns.winding(centre) > 0;
                    inside += usize::from(is_inside);
                    let corner = piece[random.next_bits() as usize % piece.len()];
                    let p = centre.lerp(corner, 0.98 * random.uniform());
                    wrong += if (columns.winding(p) > 0) == is_inside { 0.0 } else { area };
                }
            }
            assert!((covered / area(&sheet) - 1.0).abs() < 1e-12);
            // Slivers as thin as a rounding error have no inside of their own.
            assert!(inside > 50 && wrong < 1e-12, "{inside} inside, {wrong} m² wrong");
        }
    }

    /// Without cutting, triangles do cross the surface: the test above can fail.
    #[test]
    fn uncut_triangles_cross_the_surface() {
        let (sheet, body) = (sheet(1.5, 0), cube(3));
        let columns = Columns::new(&body);
        let crossing = (0..sheet.triangles.len()).filter(|triangle| {
            let counts = sheet.corners(*triangle).map(|p| columns.winding(p));
            counts[0] != counts[1] || counts[1] != counts[2]
        });
        assert!(crossing.count() > 50);
    }

    #[test]
    fn normals_are_those_of_the_sheet() {
        let sheet = crack_surface(24, 2);
        let cut = clipped(&sheet, &cuboid(DVec3::splat(0.5)));
        let Some(normals) = &cut.normals else { unreachable!() };
        assert_eq!(normals.indices.len(), cut.triangles.len());
        for (index, corner) in normals.indices.iter().enumerate() {
            let face = cut.area_vector(index);
            if face.length() < 1e-12 {
                continue;
            }
            for i in corner {
                assert!(normals.values[*i as usize].dot(face.normalize()) > 0.8);
            }
        }
    }
}
