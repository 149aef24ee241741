//! Boxes and corner cubes: what right angles make of total reflection.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;
mod shots;

use common::{furnace, object};
use glam::{DVec3, DVec4};
use reference::{Level, Request, render};
use scenes::layer::flag;
use scenes::scene::Normals;
use scenes::{LayerName, Mesh, Projection, Scene, Shape};
use shots::shoot;
use test_support::view;

fn solid(half_extent_m: DVec3, mesh: bool, eta: f64) -> Scene {
    let shape = if mesh {
        Shape::Mesh(scenes::generate::cuboid(half_extent_m))
    } else {
        Shape::Box { half_extent_m }
    };
    furnace(vec![object(shape, 1, Normals::Flat)], eta)
}

/// Low-discrepancy numbers in [0, 1)⁴ (the generalised golden ratio).
fn point(i: u32) -> DVec4 {
    let g = 1.167_303_978_261_418_7_f64;
    let steps = DVec4::new(1.0 / g, 1.0 / g.powi(2), 1.0 / g.powi(3), 1.0 / g.powi(4));
    (0.5 + f64::from(i + 1) * steps).fract()
}

/// Above n = √2 light cannot leave through a face next to the one it entered,
/// so the exit direction is the entry direction with flipped signs.
#[test]
fn a_box_of_glass_only_flips_signs() {
    for mesh in [false, true] {
        let scene = solid(DVec3::new(0.7, 0.5, 0.9), mesh, 1.5);
        let mut straight = 0;
        for i in 0..1000 {
            let p = point(i);
            let z = 2.0 * p.x - 1.0;
            let (sin, cos) = (std::f64::consts::TAU * p.y).sin_cos();
            let d = DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z);
            let aim = DVec3::new(p.z - 0.5, p.w - 0.5, (p.z + p.w).fract() - 0.5) * 0.8;
            let shot = shoot(&scene, aim - 4.0 * d, d);
            assert!(shot.events >= 2);
            let off = (shot.exit.abs() - shot.sent.abs()).abs().max_element();
            assert!(off < 1e-12, "{d}: {off}");
            if shot.total_reflections == 0 {
                assert!((shot.exit - shot.sent).length() < 1e-12);
                straight += 1;
            }
        }
        assert!((1..1000).contains(&straight), "{straight}");
    }
}

/// The control: below √2 light does leave through an adjacent face.
#[test]
fn a_box_of_ice_lets_light_out_at_its_side() {
    let shot = shoot(
        &solid(DVec3::ONE, false, 1.309),
        DVec3::new(0.9, 0.0, 1.0) + 2.0 * DVec3::new(-0.94, 0.0, 0.34),
        DVec3::new(0.94, 0.0, -0.34).normalize(),
    );
    let same = (shot.exit.abs() - shot.sent.abs()).abs().max_element();
    assert!(shot.events == 2 && same > 0.01, "{shot:?}");
}

#[test]
fn four_hundred_total_reflections_in_a_rod_lose_nothing() {
    for mesh in [false, true] {
        let scene = solid(DVec3::new(0.5, 0.5, 400.0), mesh, 1.5);
        let d = DVec3::new(0.6, 0.55, -0.5).normalize();
        let entry = DVec3::new(0.123, -0.0721, 400.0);
        let shot = shoot(&scene, entry - 2.0 * d, d);
        assert!(shot.events >= 400, "{}", shot.events);
        let off = (shot.exit.abs() - shot.sent.abs()).abs().max_element();
        assert!(off < 1e-12, "{} events: {off}", shot.events);
    }
}

/// Unfolded, the way through a rod is a straight line, and each plane x or y = k + ½
/// that it crosses is a reflection. Nothing is counted twice, and a limit of just so
/// many events lets it pass.
#[test]
fn a_rod_reflects_as_often_as_its_unfolded_way_crosses_walls() {
    for mesh in [false, true] {
        let mut scene = solid(DVec3::new(0.5, 0.5, 400.0), mesh, 1.5);
        let d = DVec3::new(-300.0, -30.0, -600.0).normalize();
        scene.camera.eye = DVec3::new(300.0, 30.0, 1000.0);
        scene.camera.target = DVec3::new(0.0, 0.0, 400.0);
        scene.camera.projection = Projection::Orthographic { height_m: 1e-300 };
        let inside = DVec3::new(d.x / 1.5, d.y / 1.5, 0.0);
        let length_m = 800.0 / (1.0 - inside.length_squared()).sqrt();
        let across = (inside * length_m).abs().round();
        let reflections = across.x + across.y;
        let flags = LayerName::Flags;
        let path = LayerName::Path("glass".to_owned());
        let layers = [LayerName::Events, LayerName::TotalReflections, flags, path];
        let chain = |most: f64| {
            let mut request = Request::new(view(1, 1, &layers), Level::R0);
            request.restriction.max_events = most as u32;
            let layers = render(&scene, &request).unwrap().layers;
            layers.list.iter().map(|layer| layer.data[0]).collect::<Vec<_>>()
        };
        assert!(reflections > 270.0, "{reflections}");
        for most in [20_000.0, reflections + 2.0] {
            let found = chain(most);
            assert_eq!(found[..3], [reflections + 2.0, reflections, 0.0], "{mesh}");
            assert!((found[3] - length_m).abs() < 1e-9, "{found:?} {length_m}");
        }
        // The control: one event less and the chain is lost.
        let lost = f64::from(flag::CAP | flag::LOST);
        assert_eq!(chain(reflections + 1.0)[2], lost);
    }
}

fn corner_cube() -> Mesh {
    let [o, x, y, z] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    // Three faces through the origin and the entrance across the axes' ends.
    Mesh {
        positions: vec![o, x, y, z],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        normals: None,
    }
}

#[test]
fn a_corner_cube_sends_light_back_where_it_came_from() {
    for eta in [1.3, 1.5, 2.4] {
        let scene = furnace(vec![object(Shape::Mesh(corner_cube()), 1, Normals::Flat)], eta);
        let mut tried = 0;
        for i in 0..600 {
            let p = point(i);
            let (a, b) = if p.x + p.y > 1.0 { (1.0 - p.x, 1.0 - p.y) } else { (p.x, p.y) };
            let entry = DVec3::new(a, b, 1.0 - a - b);
            if entry.max_element() >= 0.6 {
                continue;
            }
            let tilt = 2.0_f64.to_radians().tan() * p.z;
            let (sin, cos) = (std::f64::consts::TAU * p.w).sin_cos();
            let u = DVec3::new(1.0, -1.0, 0.0).normalize();
            let v = DVec3::new(1.0, 1.0, -2.0).normalize();
            let d = (-DVec3::ONE.normalize() + tilt * (u * cos + v * sin)).normalize();
            let shot = shoot(&scene, entry - 2.0 * d, d);
            assert_eq!((shot.events, shot.total_reflections), (5, 3), "{entry}");
            assert!((shot.exit + shot.sent).length() < 1e-13, "{}", shot.exit + shot.sent);
            tried += 1;
        }
        assert!(tried > 200, "{tried}");
    }
    // The control: below √(3/2) the faces are not beyond the critical angle.
    let leaky = furnace(vec![object(Shape::Mesh(corner_cube()), 1, Normals::Flat)], 1.2);
    let d = -DVec3::ONE.normalize();
    let shot = shoot(&leaky, DVec3::new(0.3, 0.33, 0.37) - 2.0 * d, d);
    assert!((shot.exit + shot.sent).length() > 0.1);
}
