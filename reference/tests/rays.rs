//! Every set of instructions and every tree answers with the same bits.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;

use common::meshes;
use glam::DVec3;
use reference::{Hit, Instructions, Triangles};
use scenes::{Mesh, Ray};
use test_support::Dice;

/// A ray at a vertex, an edge or the inside of a triangle; some along axes,
/// some from far away, some that start on the surface.
fn aimed(corners: &[[DVec3; 3]], dice: &mut Dice) -> Ray {
    let [a, b, c] = corners[dice.pick(corners.len())];
    let at = match dice.pick(3) {
        0 => a,
        1 => a.lerp(b, dice.unit()),
        _ => (a + b + c) / 3.0,
    };
    let axes = [DVec3::X, DVec3::NEG_Y, DVec3::Z];
    let towards = match dice.pick(8) {
        0 => axes[dice.pick(3)],
        1 => (axes[dice.pick(3)] + axes[dice.pick(3)] * dice.unit()).normalize(),
        2 => (axes[dice.pick(3)] + 1e-12 * dice.point()).normalize(),
        _ => dice.point().normalize(),
    };
    let distance_m = [0.0, 0.1, 1.0, 3.0, 1e4][dice.pick(5)];
    Ray { origin: at - towards * distance_m, direction: towards }
}

fn corners_of(mesh: &Mesh) -> Vec<[DVec3; 3]> {
    (0..mesh.triangles.len()).map(|i| mesh.corners(i)).collect()
}

#[test]
fn every_set_of_instructions_answers_with_the_same_bits() {
    let mut dice = Dice::new(3);
    let (mut rays, mut hits) = (0, 0);
    for (name, mesh) in meshes() {
        let corners = corners_of(&mesh);
        let mut trees: Vec<Triangles> = Instructions::available()
            .into_iter()
            .map(|instructions| {
                let mut tree = Triangles::build(&corners);
                tree.use_instructions(instructions);
                tree
            })
            .collect();
        for _ in 0..180_000 {
            let ray = aimed(&corners, &mut dice);
            let skip = [u32::MAX, dice.pick(corners.len()) as u32][dice.pick(2)];
            let answers: Vec<Option<Hit>> =
                trees.iter_mut().map(|tree| tree.closest(&ray, skip, f64::INFINITY)).collect();
            assert!(answers.iter().all(|a| *a == answers[0]), "{name}: {ray:?} {answers:?}");
            rays += 1;
            hits += usize::from(answers[0].is_some());
        }
    }
    assert!(rays > 1_000_000 && hits > rays / 2, "{rays} {hits}");
}

/// Boxes only prune: the tree finds what each triangle on its own says.
#[test]
fn the_tree_loses_no_crossing() {
    let mut dice = Dice::new(5);
    for (name, mesh) in meshes() {
        let corners = corners_of(&mesh);
        let corners = &corners[..corners.len().min(400)];
        let mut tree = Triangles::build(corners);
        let alone: Vec<Triangles> =
            corners.iter().map(|corners| Triangles::build(&[*corners])).collect();
        for _ in 0..3_000 {
            let ray = aimed(corners, &mut dice);
            let mut expected: Vec<Hit> = Vec::new();
            for (triangle, single) in (0..).zip(&alone) {
                single.all(&ray, |hit| expected.push(Hit { triangle, ..hit }));
            }
            let mut found: Vec<Hit> = Vec::new();
            tree.all(&ray, |hit| found.push(hit));
            let order = |a: &Hit, b: &Hit| a.t.total_cmp(&b.t).then(a.triangle.cmp(&b.triangle));
            expected.sort_by(order);
            found.sort_by(order);
            assert_eq!(found, expected, "{name}: {ray:?}");
            let ahead = expected.into_iter().find(|hit| hit.t > 0.0);
            assert_eq!(tree.closest(&ray, u32::MAX, f64::INFINITY), ahead, "{name}: {ray:?}");
        }
    }
}

/// Where two triangles coincide, the one with the smaller index is answered,
/// and the other when that is skipped.
#[test]
fn among_equal_distances_the_smaller_index_wins() {
    let one = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let mut tree = Triangles::build(&[one; 37]);
    let ray = Ray { origin: DVec3::new(0.25, 0.25, 1.0), direction: DVec3::NEG_Z };
    let mut ask = |skip: u32| tree.closest(&ray, skip, 2.0).map(|hit| (hit.t, hit.triangle));
    assert_eq!(ask(u32::MAX), Some((1.0, 0)));
    assert_eq!(ask(0), Some((1.0, 1)));
    assert!(tree.closest(&ray, 0, 0.5).is_none());
}

/// Nothing a caller can pass makes the walk panic or hang.
#[test]
fn hostile_rays_and_triangles_are_answered() {
    let bad = [f64::NAN, f64::INFINITY, -1e300, 0.0, 5e-324, 1e308];
    let mut corners = corners_of(&meshes()[0].1);
    for x in bad {
        corners.push([DVec3::splat(x), DVec3::X * x, DVec3::Y]);
    }
    for corners in [&corners[..], &[]] {
        for instructions in Instructions::available() {
            let mut tree = Triangles::build(corners);
            tree.use_instructions(instructions);
            for origin in bad {
                for direction in bad {
                    let ray = Ray { origin: DVec3::splat(origin), direction: DVec3::X * direction };
                    let _ = tree.closest(&ray, u32::MAX, f64::INFINITY);
                    tree.all(&ray, |_| ());
                }
            }
        }
    }
}
