//! Making a body of what nearly is one.

use super::edges::{edges, sides};
use super::weld::cyclic;
use super::{orient_outward, parts, rims, solid};
use crate::{Mesh, mesh::polygon};
use glam::DVec3;
use std::collections::HashSet;

/// What [`repair`] did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Repaired {
    /// Triangles that were dropped because they are there in both senses.
    pub doubles_dropped: usize,
    /// Triangles that were turned over.
    pub turned: usize,
    /// Holes that were closed.
    pub holes_closed: usize,
    /// Triangles that close them.
    pub triangles_added: usize,
    /// Holes that are too long, or not rings.
    pub holes_left: usize,
    /// Normals were dropped, because they no longer fit: they are made from the faces.
    pub normals_dropped: bool,
}

/// A mesh without doubled triangles, whose triangles agree and face outwards, and
/// whose holes of at most `longest_m` around are closed; not always a solid.
///
/// A closed part in which every triangle is there in both senses keeps one of each,
/// and so does an open one that is all there is; elsewhere both are dropped, since a
/// sheet within a body bounds nothing.
#[must_use]
pub fn repair(mesh: &Mesh, longest_m: f64) -> (Mesh, Repaired) {
    let mut done = Repaired::default();
    let mut mended = without_doubles(mesh, &mut done);
    turn(&mut mended, &mut done);
    close(&mut mended, longest_m, &mut done);
    if done.holes_closed > 0 {
        turn(&mut mended, &mut done);
    }
    turn_bodies(&mut mended, &mut done);
    if done.turned + done.triangles_added > 0 {
        done.normals_dropped = mended.normals.take().is_some();
    }
    (mended, done)
}

fn turn(mesh: &mut Mesh, done: &mut Repaired) {
    // A one-sided surface stays as it is, and is no solid afterwards either.
    done.turned += orient_outward(mesh).unwrap_or(0);
}

fn without_doubles(mesh: &Mesh, done: &mut Repaired) -> Mesh {
    let all: HashSet<[u32; 3]> = mesh.triangles.iter().map(|t| cyclic(*t)).collect();
    let has_twin = |[a, b, c]: [u32; 3]| all.contains(&cyclic([a, c, b]));
    let mut kept = vec![true; mesh.triangles.len()];
    let parts = parts(mesh);
    for part in &parts {
        let triangles = || part.triangles.iter().map(|i| *i as usize);
        let is_all_twins = triangles().all(|i| has_twin(mesh.triangles[i]));
        let mut seen = HashSet::new();
        for index in triangles() {
            let triangle = mesh.triangles[index];
            let mut key = triangle;
            key.sort_unstable();
            kept[index] = !has_twin(triangle) || is_all_twins && seen.insert(key);
        }
        if is_all_twins && parts.len() > 1 && is_open(mesh, triangles().filter(|i| kept[*i])) {
            triangles().for_each(|index| kept[index] = false);
        }
    }
    let keep: Vec<usize> = (0..kept.len()).filter(|i| kept[*i]).collect();
    done.doubles_dropped = kept.len() - keep.len();
    let mut fewer = mesh.clone();
    fewer.triangles = keep.iter().map(|i| mesh.triangles[*i]).collect();
    if let Some(normals) = &mut fewer.normals {
        normals.indices = keep.iter().map(|i| normals.indices[*i]).collect();
    }
    fewer
}

/// True if some side of these triangles belongs to one of them only.
fn is_open(mesh: &Mesh, triangles: impl Iterator<Item = usize>) -> bool {
    let triangles = triangles.map(|index| mesh.triangles[index]).collect();
    let part = Mesh { triangles, ..Mesh::default() };
    let sides = sides(&part);
    edges(&sides).any(|edge| edge.len() == 1)
}

/// Fills rings, seen along their mean normal.
fn close(mesh: &mut Mesh, longest_m: f64, done: &mut Repaired) {
    for rim in rims(mesh) {
        // The lid runs against the triangles beside it.
        let ring: Vec<u32> = rim.vertices.iter().rev().copied().collect();
        let corners: Vec<DVec3> = ring.iter().map(|i| mesh.positions[*i as usize]).collect();
        let length_m: f64 =
            (0..corners.len()).map(|i| corners[i].distance(corners[(i + 1) % corners.len()])).sum();
        if !rim.is_ring || ring.len() < 3 || length_m > longest_m {
            done.holes_left += 1;
            continue;
        }
        let cut = polygon::cut(&corners);
        let lid: Vec<[u32; 3]> = if cut.crosses {
            around_the_middle(mesh, &ring, &corners)
        } else {
            cut.triangles.iter().map(|t| t.map(|i| ring[i as usize])).collect()
        };
        done.holes_closed += 1;
        done.triangles_added += lid.len();
        mesh.triangles.extend(lid);
        // Normals that new triangles do not have are no normals of this mesh.
        done.normals_dropped |= mesh.normals.take().is_some();
    }
}

/// Triangles from each side of a ring to its middle.
fn around_the_middle(mesh: &mut Mesh, ring: &[u32], corners: &[DVec3]) -> Vec<[u32; 3]> {
    let middle = mesh.positions.len() as u32;
    mesh.positions.push(corners.iter().sum::<DVec3>() / corners.len() as f64);
    (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()], middle]).collect()
}

/// Turns closed parts that face inwards and are no cavity.
fn turn_bodies(mesh: &mut Mesh, done: &mut Repaired) {
    let found = parts(mesh);
    if !matches!(solid(mesh), Err(super::NotSolid::PartInverted { .. })) {
        return;
    }
    let depths = super::depths(mesh, &found);
    for (part, depth) in found.iter().zip(depths) {
        let faces_inwards = part.signed_volume_m3 < 0.0;
        if depth == 0 && faces_inwards {
            for triangle in &part.triangles {
                mesh.triangles[*triangle as usize].swap(1, 2);
                if let Some(normals) = &mut mesh.normals {
                    normals.indices[*triangle as usize].swap(1, 2);
                }
            }
            done.turned += part.triangles.len();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{cube, geodesic, half_flipped, shell};
    use crate::topology::{signed_volume, weld};

    #[test]
    fn a_good_body_is_left_alone() {
        for mesh in [geodesic(4), shell(4, 0.5), cube(3)] {
            assert_eq!(repair(&mesh, 1e9), (mesh.clone(), Repaired::default()));
        }
    }

    #[test]
    fn turned_doubled_and_inverted_bodies_become_solid() {
        let ball = geodesic(4);
        let mut both = ball.clone();
        both.append(&ball.clone().reversed());
        let (mended, done) = repair(&weld(&both), 0.0);
        assert_eq!(done.doubles_dropped, 320);
        assert_eq!((solid(&mended), mended.triangles.len()), (Ok(()), 320));
        let (mended, done) = repair(&half_flipped(4), 0.0);
        assert_eq!((solid(&mended), done.turned), (Ok(()), 160));
        let (mended, _) = repair(&ball.clone().reversed(), 0.0);
        assert_eq!(solid(&mended), Ok(()));
        let mut apart = ball.clone();
        apart.append(&cube(1).with_positions(|p| p * 0.1 + 3.0).reversed());
        let (mended, done) = repair(&apart, 0.0);
        assert_eq!((solid(&mended), done.turned), (Ok(()), 12));
    }

    /// A sheet across a body bounds nothing and goes.
    #[test]
    fn a_sheet_inside_goes() {
        let mut mesh = cube(2);
        let at = |x: f64, y: f64, z: f64| {
            let p = DVec3::new(x, y, z);
            mesh.positions.iter().position(|q| *q == p).map_or(u32::MAX, |i| i as u32)
        };
        let sheet = [at(1.0, 0.0, 1.0), at(1.0, 0.0, -1.0), at(-1.0, 0.0, -1.0)];
        let [a, b, c] = sheet;
        mesh.triangles.extend([[a, b, c], [a, c, b]]);
        let (mended, done) = repair(&mesh, 0.0);
        assert_eq!((done.doubles_dropped, mended), (2, cube(2)));
    }

    #[test]
    fn holes_up_to_the_size_are_closed_and_no_others() {
        let mut mesh = cube(4);
        // A whole side (around: 8 m) and one triangle elsewhere.
        let is_top = |t: &[u32; 3]| t.iter().all(|i| mesh.positions[*i as usize].y == 1.0);
        let triangles = mesh.triangles.clone();
        let top: Vec<_> = triangles.iter().copied().filter(is_top).collect();
        assert_eq!(top.len(), 32);
        mesh.triangles.retain(|t| !top.contains(t));
        let other = mesh
            .triangles
            .iter()
            .position(|t| t.iter().all(|i| mesh.positions[*i as usize].y < 0.5));
        mesh.triangles.swap_remove(other.unwrap_or(0));
        let (small, done) = repair(&mesh, 3.0);
        assert_eq!((done.holes_closed, done.holes_left, done.triangles_added), (1, 1, 1));
        assert!(solid(&small).is_err());
        let (all, done) = repair(&mesh, 8.1);
        assert_eq!((done.holes_closed, done.holes_left), (2, 0));
        assert_eq!(solid(&all), Ok(()));
        assert!((signed_volume(&all) - 8.0).abs() < 1e-12);
    }
}
