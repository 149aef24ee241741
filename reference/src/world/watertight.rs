//! No line passes between two triangles: a million of them aimed at edges and
//! vertices.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

#[path = "../../tests/common/mod.rs"]
mod common;

use crate::geometry::bvh::Stack;
use crate::geometry::line::Line;
use crate::request::Level;
use crate::world::World;
use crate::world::crossing::Crossing;
use common::{furnace, meshes, object};
use glam::DVec3;
use obvhs::ray::{Ray, RayHit};
use scenes::scene::Normals;
use scenes::{Mesh, Shape};
use test_support::Dice;

/// A vertex, or a point on an edge, of a random triangle.
fn target(mesh: &Mesh, dice: &mut Dice) -> DVec3 {
    let triangle = (dice.unit() * mesh.triangles.len() as f64) as usize;
    let [a, b, _] = mesh.corners(triangle);
    match (dice.unit() * 4.0) as u32 {
        0 => a,
        1 => (a + b) * 0.5,
        _ => a.lerp(b, dice.unit()),
    }
}

/// A point in or around the body, some of them with many zeros.
fn origin(dice: &mut Dice) -> DVec3 {
    let far = dice.direction() * [0.05, 0.3, 3.0, 1e3][(dice.unit() * 4.0) as usize];
    match (dice.unit() * 4.0) as u32 {
        0 => DVec3::new(0.0, far.y, far.z),
        1 => DVec3::new(0.0, 0.0, far.z),
        _ => far,
    }
}

fn world_of(mesh: &Mesh) -> World {
    let scene = furnace(vec![object(Shape::Mesh(mesh.clone()), 1, Normals::Flat)], 1.5);
    World::new(&scene, 0, Level::R1).unwrap()
}

const RAYS: usize = 170_000;

#[test]
fn a_million_lines_at_edges_and_vertices_enter_as_often_as_they_leave() {
    let mut crossings: Vec<Crossing> = Vec::new();
    let mut stack = Stack::default();
    let (mut dice, mut lines, mut ties) = (Dice::new(1), 0_u64, 0_u64);
    for (name, mesh) in meshes() {
        let world = world_of(&mesh);
        for _ in 0..RAYS {
            let from = origin(&mut dice);
            let direction = (target(&mesh, &mut dice) - from).normalize();
            if !direction.is_finite() {
                continue;
            }
            let line = Line::new(from, direction);
            world.all_crossings(&line, &mut crossings);
            let sum: i32 = crossings.iter().map(|c| if c.entering { 1 } else { -1 }).sum();
            assert_eq!(sum, 0, "{name}: {from} {direction}");
            assert_eq!(crossings.len() % 2, 0);
            let inside: i32 = crossings
                .iter()
                .filter(|c| c.t > 0.0)
                .map(|c| if c.entering { -1 } else { 1 })
                .sum();
            let next = world.next(&line, None, (0.0, u32::MAX), &mut stack);
            assert!(inside == 0 || next.first.is_some(), "{name}: leak from {from}");
            // The walk with pruning answers what the full list says, to the bit.
            let listed = crossings.iter().find(|c| c.t > 0.0).map(Crossing::key);
            assert_eq!(next.first.map(|c| c.key()), listed);
            lines += 1;
            ties += u64::from(crossings.windows(2).any(|pair| pair[0].t == pair[1].t));
        }
    }
    assert!(lines > 1_000_000, "{lines}");
    assert!(ties > 0, "no line went through an edge exactly: the aim is bad");
}

/// The control: obvhs's own triangle test loses rays that leave a closed body
/// through its edges.
#[test]
fn a_common_triangle_test_leaks_at_edges() {
    let mesh = common::icosphere(2);
    let triangles: Vec<obvhs::triangle::Triangle> = (0..mesh.triangles.len())
        .map(|i| mesh.corners(i).map(|p| p.as_vec3a()))
        .map(|[v0, v1, v2]| obvhs::triangle::Triangle { v0, v1, v2 })
        .collect();
    let params = obvhs::BvhBuildParams::medium_build();
    let bvh = obvhs::bvh2::builder::build_bvh2_from_tris(
        &triangles,
        params,
        &mut std::time::Duration::default(),
    );
    let (mut dice, mut leaks) = (Dice::new(1), 0);
    for _ in 0..100_000 {
        let from = dice.direction() * 0.3;
        let direction = (target(&mesh, &mut dice) - from).normalize();
        let ray = Ray::new_inf(from.as_vec3a(), direction.as_vec3a());
        let mut hit = RayHit::none();
        let test =
            |ray: &Ray, id: usize| triangles[bvh.primitive_indices[id] as usize].intersect(ray);
        leaks += u32::from(!bvh.ray_traverse(ray, &mut hit, test));
    }
    assert!(leaks > 100, "{leaks}");
}
