//! Balls: deviations, rainbows, weights and focal lengths.
//!
//! Source: H. C. van de Hulst, "Light Scattering by Small Particles", 12-13.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;
mod shots;

use common::{furnace, object};
use glam::DVec3;
use reference::interface::fresnel;
use scenes::scene::Normals;
use scenes::{MediumId, Scene, Shape, Surface};
use shots::{gather_by_order, shoot};
use std::f64::consts::PI;
use test_support::angle;

fn ball(eta: f64) -> Scene {
    furnace(vec![object(Shape::Sphere { radius_m: 1.0 }, 1, Normals::Flat)], eta)
}

fn close(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{found} is not {expected} within {within}");
}

/// Where a ray along -z at this distance from the axis starts.
fn at(impact: f64) -> DVec3 {
    DVec3::new(impact, 0.0, 3.0)
}

#[test]
fn a_ball_deviates_the_direct_path_by_twice_the_difference_of_angles() {
    for eta in [1.000_001, 1.333, 1.5, 2.417, 10.0, 1e4] {
        for impact in [1e-9, 0.01, 0.3, 0.5, 0.9, 0.999] {
            let shot = shoot(&ball(eta), at(impact), -DVec3::Z);
            let expected = 2.0 * (impact.asin() - (impact / eta).asin());
            close(angle(shot.exit, shot.sent), expected, 1e-12);
            assert_eq!((shot.events, shot.total_reflections), (2, 0));
        }
    }
}

/// As the index nears 1 the deviation falls in proportion.
#[test]
fn the_deviation_vanishes_in_proportion_to_the_contrast() {
    for k in 1..=6 {
        let step = 10.0_f64.powi(-k);
        let (eta, b) = (1.0 + step, 0.5_f64);
        let shot = shoot(&ball(eta), at(b), -DVec3::Z);
        let expected = 2.0 * (b.asin() - (b / eta).asin());
        let found = angle(shot.exit, shot.sent);
        assert!((found / expected - 1.0).abs() < 1e-6, "{k}: {found} {expected}");
        let r0 = (step / (2.0 + step)).powi(2);
        assert!((fresnel(1.0, 1.0, eta) / r0 - 1.0).abs() < 1e-6, "{k}");
    }
}

#[test]
fn light_that_leaves_after_p_reflections_has_weight_t_squared_r_to_the_p() {
    for (eta, impact) in [(1.5, 0.3), (1.333, 0.860_66), (2.417, 0.95)] {
        let r = fresnel((1.0_f64 - impact * impact).sqrt(), 1.0, eta);
        let orders = gather_by_order(&ball(eta), at(impact), -DVec3::Z, 24);
        close(orders[0], 0.0, 0.0);
        close(orders[1], r, 1e-14);
        for (p, found) in orders[2..12].iter().enumerate() {
            close(*found, (1.0 - r).powi(2) * r.powi(p as i32), 1e-14);
        }
        close(orders.iter().sum(), 1.0, 1e-6);
    }
}

/// The least deviation of light reflected p times inside, by a search over
/// traced rays: (impact parameter, degrees from the point opposite the sun).
fn rainbow(eta: f64, p: u32) -> (f64, f64) {
    let turned = |impact: f64| {
        let (outside, inside) = (impact.asin(), (impact / eta).asin());
        // Follow the traced ray's own inner direction, p times around.
        let shot = shoot(&ball(eta), at(impact), -DVec3::Z);
        let bend = angle(shot.first, shot.sent);
        close(bend, outside - inside, 1e-12);
        let mirrored = shot.first - 2.0 * shot.hit2 * shot.hit2.dot(shot.first);
        let chord = angle(shot.first, mirrored);
        2.0 * bend + f64::from(p) * chord
    };
    let (mut low, mut high) = (0.5, 0.999_9);
    for _ in 0..80 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if turned(a) < turned(b) { high = b } else { low = a }
    }
    let impact = 0.5 * (low + high);
    (impact, (turned(impact) - PI).abs().to_degrees())
}

#[test]
fn rainbows_stand_where_descartes_found_them() {
    for (eta, p, impact, degrees) in [
        (4.0 / 3.0, 1, 0.860_66, 42.030),
        (4.0 / 3.0, 2, 0.950_15, 50.978),
        (1.333, 1, 0.861, 42.078),
        (1.333, 2, 0.950, 50.891),
        (1.331, 1, 0.862, 42.37),
        (1.343, 1, 0.855, 40.65),
    ] {
        let (found_impact, found) = rainbow(eta, p);
        close(found, degrees, 5.1e-3);
        close(found_impact, impact, 2e-3);
        let cos2 = (eta * eta - 1.0) / f64::from(p * (p + 2));
        close(found_impact, (1.0 - cos2).sqrt(), 1e-6);
    }
}

/// Where the chain crosses the axis, from the centre, in radii.
fn crossing(scene: &Scene, impact: f64) -> f64 {
    let shot = shoot(scene, at(impact), -DVec3::Z);
    let t = -shot.exit_position.x / shot.exit.x;
    -(shot.exit_position.z + t * shot.exit.z)
}

#[test]
fn a_ball_lens_focuses_at_its_focal_length() {
    for (impact, expected) in [(0.01, 1.499_96), (0.5, 1.391_57), (0.9, 1.104_45)] {
        close(crossing(&ball(1.5), impact), expected, 5.1e-6);
    }
    for eta in [1.2, 1.5, 1.9] {
        // Effective focal length n R / (2 (n - 1)), from the centre.
        close(crossing(&ball(eta), 1e-5), eta / (2.0 * (eta - 1.0)), 1e-8);
    }
    assert!((crossing(&ball(2.0), 1e-5) - 1.0).abs() < 1e-8);
}

/// Half of a ball: the part of it with z above or below 0, cut by a plate of
/// the surroundings' medium with priority.
fn half_ball(flat_first: bool) -> Scene {
    let mut scene = ball(1.5);
    let mut plate = object(Shape::HalfSpace, 0, Normals::Flat);
    plate.surface = Surface::Dielectric { medium: MediumId(0), priority: 1 };
    let towards = if flat_first { -DVec3::Z } else { DVec3::Z };
    // Turned so that the empty half lies behind the flat side.
    plate.world_from_object.matrix3 =
        glam::DMat3::from_quat(glam::DQuat::from_rotation_arc(DVec3::Y, towards));
    scene.objects.push(plate);
    scene
}

#[test]
fn a_half_ball_focuses_as_its_two_sides_say() {
    // Flat side first: only the sphere bends.
    for h in [1e-5_f64, 0.1, 0.3, 0.6] {
        let bend = (1.5 * h).asin() - h.asin();
        let expected = (1.0 - h * h).sqrt() + h / bend.tan();
        close(crossing(&half_ball(true), h), expected, 1e-9);
    }
    close(crossing(&half_ball(true), 1e-5), 1.0 + 1.0 / 0.5, 1e-8);
    let beyond = shoot(&half_ball(true), at(1.0 / 1.5 + 1e-6), -DVec3::Z);
    assert!(beyond.total_reflections > 0);
    // Curved side first: distances past the flat side.
    for (h, expected) in [(0.01, 1.333_28), (0.3, 1.283_89), (0.6, 1.118_69)] {
        close(crossing(&half_ball(false), h), expected, 5.1e-6);
    }
}

#[test]
fn a_hollow_ball_deviates_by_the_printed_angles() {
    let mut scene = ball(1.5);
    let mut bubble = object(Shape::Sphere { radius_m: 0.8 }, 0, Normals::Flat);
    bubble.surface = Surface::Dielectric { medium: MediumId(0), priority: 1 };
    scene.objects.push(bubble);
    for (impact, degrees) in
        [(0.1, 0.967_894), (0.7, 17.501_552), (0.85, 42.413_933), (0.95, 10.299_629)]
    {
        let shot = shoot(&scene, at(impact), -DVec3::Z);
        close(angle(shot.exit, shot.sent).to_degrees(), degrees, 5.1e-7);
    }
}
