#![allow(clippy::unwrap_used, reason = "a missing built-in is what the tests are for")]

use super::*;
use crate::topology::{Report, clean, inspect, is_convex, solid};
use glam::DVec2;

/// Built-ins that do not bound a solid, on purpose.
const NOT_SOLID: [&str; 4] = ["teapot-newell", "landscape", "fan", "half-flipped"];

fn solids() -> impl Iterator<Item = (&'static str, Mesh)> {
    NAMES
        .iter()
        .filter(|(name, _)| !NOT_SOLID.contains(name) && *name != "geodesic-N")
        .map(|(name, _)| (*name, builtin(name).unwrap()))
}

/// Counts follow from how each body is divided, not from running the code.
#[test]
fn triangle_counts_are_those_of_the_papers_models() {
    for (name, count) in [
        ("teapot-newell", 32 * 15 * 15 * 2),
        ("teapot", 32 * 15 * 15 * 2 - 120 + 4 * 15 * 2 + 4 * 28),
        ("sphere-960", 960),
        ("ice-cube", 4_800),
        ("landscape", 2_340),
        ("cup", 7_100),
        ("mug", 3_746),
        ("figure-50k", 50_000),
        ("figure-100k", 100_000),
        ("noisy-ball", 81_920),
        ("geodesic-7", 20 * 49),
        ("brilliant", 110),
    ] {
        assert_eq!(builtin(name).unwrap().triangles.len(), count, "{name}");
    }
}

#[test]
fn descriptions_state_the_count() {
    for (name, description) in NAMES.iter().filter(|(name, _)| *name != "geodesic-N") {
        let count = description.rsplit(": ").next().unwrap().replace([',', 's'], "");
        let count: usize = count.strip_suffix(" triangle").unwrap().parse().unwrap();
        assert_eq!(builtin(name).unwrap().triangles.len(), count, "{name}");
    }
}

#[test]
fn unknown_names_are_refused() {
    for name in ["", "Teapot", "geodesic-", "geodesic-0", "geodesic-1001", "geodesic-N"] {
        assert!(builtin(name).is_none(), "{name}");
    }
}

#[test]
fn solids_are_closed_face_outwards_and_are_clean() {
    for (name, mesh) in solids() {
        let report = inspect(&mesh);
        assert_eq!(solid(&mesh), Ok(()), "{name}: {report:?}");
        assert_eq!(report.is_manifold(), name != "edge-to-edge", "{name}: {report:?}");
        assert_eq!((report.degenerate, report.duplicate), (0, 0), "{name}");
    }
}

#[test]
fn normals_are_unit_and_on_the_outer_side() {
    for (name, mesh) in solids() {
        let normals = mesh.normals.as_ref().unwrap();
        assert_eq!(normals.indices.len(), mesh.triangles.len());
        assert!(normals.values.iter().all(|n| (n.length() - 1.0).abs() < 1e-12), "{name}");
        for (index, corner) in normals.indices.iter().enumerate() {
            let face = mesh.area_vector(index).normalize();
            let worst = corner.map(|i| normals.values[i as usize].dot(face));
            // Slivers point anywhere; everywhere else a normal stays near its face.
            assert!(name == "slivers" || worst.iter().all(|dot| *dot > 0.3), "{name}: {worst:?}");
        }
    }
}

/// χ = 2 (components - genus) for closed manifolds.
#[test]
fn genus_is_what_the_shape_says() {
    for (name, components, genus) in [
        ("teapot", 3, 0),
        ("cup", 1, 0),
        ("mug", 1, 1),
        ("torus", 1, 1),
        ("shell", 2, 0),
        ("nested-shells", 8, 0),
        ("ice-cube", 1, 0),
        ("brilliant", 1, 0),
        ("figure-100k", 1, 0),
    ] {
        let report = inspect(&builtin(name).unwrap());
        assert_eq!(report.components, components, "{name}");
        assert_eq!(report.euler_characteristic, 2 * (components as i64 - genus), "{name}");
    }
}

#[test]
fn newells_teapot_is_open_as_published() {
    let mesh = builtin("teapot-newell").unwrap();
    let report = inspect(&mesh);
    assert_eq!((report.boundary_edges, report.degenerate), (240, 120));
    assert!(!report.is_closed() && solid(&mesh).is_err());
    assert_eq!(clean(&mesh).0.triangles.len(), 14_280);
}

/// Three units of the data are one metre: Newell's pot is 6.4 units from handle
/// to spout and 3.15 high.
#[test]
fn the_teapot_has_its_size_and_stands_on_the_ground() {
    let [low, high] = builtin("teapot").unwrap().bounds();
    assert_eq!(low.y, 0.0);
    assert!((high.y - 1.05).abs() < 1e-12);
    assert!((low.x + 1.0).abs() < 0.02 && (high.x - 1.145).abs() < 0.02, "{low} {high}");
}

/// Volumes of inscribed bodies approach the smooth ones from below as 1/n².
#[test]
fn volumes_approach_the_closed_forms() {
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    let torus = 2.0 * std::f64::consts::PI.powi(2) * 0.4f64.powi(2);
    let cap = {
        let height = 1.5 - (1.5f64 * 1.5 - 1.0).sqrt();
        2.0 * std::f64::consts::PI * height * height * (3.0 * 1.5 - height) / 3.0
    };
    for (name, volume, tolerance) in [
        ("geodesic-64", ball, 5e-4),
        ("sphere-960", ball, 0.03),
        ("half-ball", ball / 2.0, 4e-3),
        ("torus", torus, 8e-3),
        ("lens", cap, 4e-3),
        ("shell", ball * (1.0 - 0.512), 8e-3),
        ("corner-cube", 1.0 / 6.0, 1e-12),
        ("cube", 8.0, 1e-12),
        ("prism", 1.5 * 3.0f64.sqrt(), 1e-12),
    ] {
        let found = inspect(&builtin(name).unwrap()).signed_volume_m3;
        let deviation = 1.0 - found / volume;
        assert!((-1e-12..tolerance).contains(&deviation), "{name}: {found} against {volume}");
    }
}

/// 57 facets and 16 pieces of girdle, counted as distinct planes.
#[test]
fn the_brilliant_has_57_facets_and_is_convex() {
    let mesh = brilliant(Brilliant::default());
    let mut planes: Vec<(DVec3, f64)> = Vec::new();
    for index in 0..mesh.triangles.len() {
        let normal = mesh.area_vector(index).normalize();
        let distance = normal.dot(mesh.corners(index)[0]);
        if !planes.iter().any(|(n, d)| n.distance(normal) < 1e-9 && (d - distance).abs() < 1e-9) {
            planes.push((normal, distance));
        }
    }
    assert_eq!(planes.len(), 57 + 16);
    for (normal, distance) in planes {
        assert!(mesh.positions.iter().all(|p| normal.dot(*p) <= distance + 1e-12));
    }
}

#[test]
fn convex_bodies_are_recognised_and_no_others() {
    for name in ["geodesic-20", "cube", "corner-cube", "thin-wall"] {
        assert!(is_convex(&builtin(name).unwrap()), "{name}");
    }
    for (name, mesh) in solids() {
        let may_be = ["sphere-960", "half-ball", "lens", "brilliant", "prism", "cube"];
        let may_be_too = ["corner-cube", "thin-wall", "slivers"];
        if !may_be.contains(&name) && !may_be_too.contains(&name) {
            assert!(!is_convex(&mesh), "{name}");
        }
    }
}

#[test]
fn seeds_give_the_same_bits_again_and_other_seeds_other_shapes() {
    assert_eq!(ice_cube(6, 0.03, 7), ice_cube(6, 0.03, 7));
    assert_ne!(ice_cube(6, 0.03, 7), ice_cube(6, 0.03, 8));
    assert_eq!(noisy_ball(4, 0.1, 1), noisy_ball(4, 0.1, 1));
    assert_ne!(landscape(1.0, 1.0, 1), landscape(1.0, 1.0, 2));
}

/// Any number of divisions keeps the bodies closed.
#[test]
fn parameters_do_not_open_the_surface() {
    for n in 1..6 {
        for mesh in [geodesic(n), teapot(n), cube(n), ice_cube(n, 0.03, 1), slivers(n, 1e8)] {
            assert!(inspect(&mesh).is_manifold(), "{n}: {:?}", inspect(&mesh));
        }
        assert!(inspect(&uv_sphere(n + 2, n + 1)).is_manifold());
        assert!(inspect(&gear(n + 2, 1.0)).is_manifold());
    }
    let square = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y];
    let report: Report = inspect(&extruded(&square, 1.0));
    assert!((report.signed_volume_m3 - 4.0).abs() < 1e-15);
}

/// Analytic shapes become closed meshes of about their volume, a box exactly.
#[test]
fn analytic_shapes_can_be_triangulated() {
    let pi = std::f64::consts::PI;
    for (shape, volume_m3, within) in [
        (Shape::Box { half_extent_m: DVec3::new(1.0, 2.0, 0.5) }, 8.0, 1e-14),
        (Shape::Sphere { radius_m: 2.0 }, 32.0 / 3.0 * pi, 1e-3),
        (Shape::Cylinder { radius_m: 0.5, half_height_m: 1.0 }, 0.5 * pi, 1e-3),
    ] {
        let mesh = triangulated(&shape).unwrap();
        assert_eq!(solid(&mesh), Ok(()), "{shape:?}");
        let found = inspect(&mesh).signed_volume_m3;
        assert!((found / volume_m3 - 1.0).abs() <= within, "{shape:?}: {found}");
    }
    assert_eq!(triangulated(&Shape::HalfSpace), None);
}
