#![allow(clippy::unwrap_used, reason = "the meshes are known")]

use super::*;
use crate::Mesh;
use crate::generate::{builtin, cube, fan, geodesic, half_flipped, shell};

#[test]
fn a_missing_triangle_is_found() {
    let mut mesh = geodesic(3);
    let removed = mesh.triangles.swap_remove(17);
    let report = inspect(&mesh);
    assert_eq!(report.boundary_edges, 3);
    assert_eq!(solid(&mesh), Err(NotSolid::Open { boundary_edges: 3, wrong_way: 0 }));
    let [Rim { vertices: ring, is_ring: true }] = &rims(&mesh)[..] else { panic!() };
    assert_eq!(ring.len(), 3);
    // The hole runs against the triangle that filled it.
    let at = ring.iter().position(|v| *v == removed[0]).unwrap();
    assert_eq!(ring[(at + 2) % 3], removed[1]);
}

#[test]
fn a_turned_triangle_is_found_and_turned_back() {
    let good = geodesic(3);
    let mut mesh = good.clone();
    mesh.triangles[17].swap(1, 2);
    let report = inspect(&mesh);
    assert_eq!((report.inconsistent_edges, report.unbalanced_edges), (3, 3));
    assert!(!report.is_closed());
    assert_eq!(orient_outward(&mut mesh), Ok(1));
    assert_eq!(mesh, good);
}

#[test]
fn an_inverted_ball_is_turned_and_half_flipped_ones_too() {
    let mut inverted = geodesic(4).reversed();
    let volume = inspect(&inverted).signed_volume_m3;
    assert_eq!(solid(&inverted), Err(NotSolid::Inverted { signed_volume_m3: volume }));
    assert_eq!(orient_outward(&mut inverted), Ok(320));
    assert_eq!(solid(&inverted), Ok(()));
    let mut half = half_flipped(4);
    assert_eq!(solid(&half), Err(NotSolid::WrongWay { faces: 160, triangles: 320 }));
    assert_eq!(orient_outward(&mut half), Ok(160));
    assert_eq!(solid(&half), Ok(()));
}

#[test]
fn cavities_stay_cavities() {
    let mut mesh = shell(4, 0.5);
    assert_eq!(orient_outward(&mut mesh), Ok(0));
    assert_eq!(mesh, shell(4, 0.5));
    let mut inside_out = shell(4, 0.5).reversed();
    orient_outward(&mut inside_out).unwrap();
    assert_eq!(inspect(&inside_out).signed_volume_m3, inspect(&mesh).signed_volume_m3);
}

/// A strip with half a twist has one side.
#[test]
fn a_moebius_strip_is_refused() {
    let mut mesh = Mesh::default();
    let count = 5u32;
    for i in 0..count {
        let turn = std::f64::consts::TAU * f64::from(i) / f64::from(count);
        let (sin, cos) = turn.sin_cos();
        for side in [-0.3, 0.3] {
            let radius = 1.0 + side * (0.5 * turn).cos();
            let height = side * (0.5 * turn).sin();
            mesh.positions.push(glam::DVec3::new(radius * cos, height, radius * sin));
        }
    }
    for i in 0..count {
        let [a, b] = [2 * i, 2 * i + 1];
        let (c, d) = if i + 1 == count { (1, 0) } else { (a + 2, b + 2) };
        mesh.triangles.extend([[a, c, b], [b, c, d]]);
    }
    let before = mesh.clone();
    assert!(orient_outward(&mut mesh).is_err());
    assert_eq!(mesh, before);
}

#[test]
fn odd_surfaces_are_named() {
    let report = inspect(&fan());
    assert_eq!((report.non_manifold_edges, report.boundary_edges), (1, 6));
    let report = inspect(&builtin("edge-to-edge").unwrap());
    assert_eq!((report.non_manifold_edges, report.unbalanced_edges), (1, 0));
    assert!(report.is_closed() && !report.is_manifold());
    // Two cubes that touch in one corner.
    let mut touching = cube(1);
    touching.append(&cube(1).with_positions(|p| p + 2.0));
    let report = inspect(&weld(&touching));
    assert_eq!((report.pinched_vertices, report.components), (1, 2));
    assert_eq!(solid(&Mesh::default()), Err(NotSolid::Empty));
}

#[test]
fn welding_joins_equal_positions_and_cleaning_drops_what_has_no_area() {
    let ball = geodesic(2);
    let mut soup = Mesh::default();
    for index in 0..ball.triangles.len() {
        let first = u32::try_from(soup.positions.len()).unwrap();
        soup.positions.extend(ball.corners(index));
        soup.triangles.push([first, first + 1, first + 2]);
    }
    assert!(!inspect(&soup).is_closed());
    let mut welded = weld(&soup);
    assert_eq!(welded.positions.len(), ball.positions.len());
    assert!(inspect(&welded).is_manifold());
    let [a, b, c] = welded.triangles[0];
    welded.triangles.extend([[a, a, b], [b, c, a]]);
    let (cleaned, removed) = clean(&welded);
    assert_eq!(removed, Removed { degenerate: 1, duplicate: 1 });
    assert!(inspect(&cleaned).is_manifold());
}

/// Negative zero is the same place as zero.
#[test]
fn both_zeros_weld() {
    let mut mesh = fan();
    mesh.positions.push(-mesh.positions[0]);
    mesh.triangles[1][0] = 5;
    assert_eq!(weld(&mesh).positions.len(), 5);
}

/// The great icosahedron: closed, Euler characteristic 2, no concave edge, yet
/// its vertices are stars and it winds seven times around its centre.
#[test]
fn the_great_icosahedron_is_not_convex() {
    let good = geodesic(1);
    let nearest = |a: usize, b: usize| good.positions[a].distance(good.positions[b]) < 1.2;
    let mut mesh = Mesh { triangles: Vec::new(), ..good.clone() };
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let apart = |i: usize, j: usize| {
                    !nearest(i, j) && good.positions[i].distance(good.positions[j]) < 1.9
                };
                if apart(a, b) && apart(b, c) && apart(a, c) {
                    mesh.triangles.push([a, b, c].map(|i| u32::try_from(i).unwrap()));
                }
            }
        }
    }
    assert_eq!(mesh.triangles.len(), 20);
    orient_outward(&mut mesh).unwrap();
    let report = inspect(&mesh);
    assert!(report.is_manifold() && report.euler_characteristic == 2);
    assert!(!is_convex(&mesh));
    assert!(is_convex(&good));
}

#[test]
fn a_dent_is_not_convex() {
    let mut mesh = geodesic(8);
    mesh.positions[100] *= 0.97;
    assert!(!is_convex(&mesh));
    assert!(!is_convex(&shell(4, 0.5)));
    assert!(!is_convex(&geodesic(4).reversed()));
}

/// Each of these has its own name, and the good twin of each passes.
#[test]
fn what_is_no_solid_is_told_apart() {
    let ball = geodesic(4);
    assert_eq!(solid(&ball), Ok(()));
    let mut flipped = ball.clone();
    flipped.triangles[3..8].iter_mut().for_each(|t| t.swap(1, 2));
    assert_eq!(solid(&flipped), Err(NotSolid::WrongWay { faces: 5, triangles: 320 }));
    let message = solid(&flipped).unwrap_err().to_string();
    assert!(message.contains("5 of 320 triangles run the wrong way"), "{message}");
    assert!(!message.contains("is open"), "{message}");
    flipped.triangles.pop();
    assert_eq!(solid(&flipped), Err(NotSolid::Open { boundary_edges: 3, wrong_way: 5 }));
    let mut both = ball.clone();
    both.append(&ball.clone().reversed());
    assert_eq!(solid(&weld(&both)), Err(NotSolid::TwoSided));
    // Two sheets over one square, cut along different diagonals.
    let mut sheets = Mesh { positions: cube(1).positions, ..Mesh::default() };
    let square: Vec<u32> = (0..8u32).filter(|i| sheets.positions[*i as usize].z > 0.0).collect();
    let at = |x: f64, y: f64| {
        *square
            .iter()
            .find(|i| sheets.positions[**i as usize] == glam::DVec3::new(x, y, 1.0))
            .unwrap()
    };
    let [a, b, c, d] = [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
    sheets.triangles = vec![[a, b, c], [a, c, d], [b, a, d], [b, d, c]];
    assert_eq!(solid(&sheets), Err(NotSolid::Flat { signed_volume_m3: 0.0 }));
    assert!(matches!(solid(&fan()), Err(NotSolid::Open { .. })));
    let mut apart = ball.clone();
    apart.append(&cube(1).with_positions(|p| p * 0.1 + 3.0).reversed());
    assert!(matches!(solid(&apart), Err(NotSolid::PartInverted { triangles: 12, .. })));
    let body = must_be_body("glass", Some(&flipped)).unwrap_err().to_string();
    assert!(body.starts_with("object \"glass\": the mesh is open"), "{body}");
    assert!(body.contains("snell mesh FILE") && body.contains("--repair"), "{body}");
    assert_eq!(must_be_body("nothing", Some(&Mesh::default())), Ok(()));
}
