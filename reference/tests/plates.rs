//! Plates and prisms: what Fresnel's and Snell's laws sum to.
//!
//! Source: M. Born, E. Wolf, "Principles of Optics", 7th ed., 1.5 and 4.7.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;
mod shots;

use common::{furnace, object};
use glam::{DAffine3, DVec2, DVec3};
use reference::interface::fresnel;
use scenes::scene::Normals;
use scenes::{Environment, Scene, Shape};
use shots::{gather, shoot, two_halves};
use test_support::angle;

fn plates(count: u32, eta: f64) -> Scene {
    let plate = |i: u32| {
        let mut plate = object(Shape::Slab { thickness_m: 1.0 }, 1, Normals::Flat);
        plate.world_from_object = DAffine3::from_translation(DVec3::Z * (-2.0 * f64::from(i)));
        plate
    };
    furnace((0..count).map(plate).collect(), eta)
}

fn tilted(degrees: f64) -> DVec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    DVec3::new(sin, 0.0, -cos)
}

/// Share of light that passes, and share that comes back.
fn shares(mut scene: Scene, degrees: f64, cut: f64) -> [f64; 2] {
    let halves = [(1.0, 0.0), (0.0, 1.0)];
    halves.map(|(below, above)| {
        scene.environment = two_halves(below, above);
        gather(&scene, DVec3::new(0.0, 0.0, 3.0), tilted(degrees), cut).x
    })
}

fn close(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{found} is not {expected} within {within}");
}

#[test]
fn a_plate_reflects_2r_over_1_plus_r() {
    for (degrees, reflects) in [(0.0, 0.076_923), (60.0, 0.163_768)] {
        let [passed, back] = shares(plates(1, 1.5), degrees, 1e-14);
        close(back, reflects, 5e-7);
        close(passed + back, 1.0, 1e-12);
        let r = fresnel(degrees.to_radians().cos(), 1.0, 1.5);
        close(back, 2.0 * r / (1.0 + r), 1e-12);
    }
    // The control: one interface alone reflects half of it.
    assert!((fresnel(1.0, 1.0, 1.5) - 0.076_923).abs() > 0.03);
}

#[test]
fn a_stack_of_plates_passes_what_its_surfaces_share() {
    for count in [2_u32, 3] {
        let surfaces = f64::from(2 * count);
        let r = fresnel(50.0_f64.to_radians().cos(), 1.0, 1.5);
        let [passed, back] = shares(plates(count, 1.5), 50.0, 1e-9);
        close(passed, (1.0 - r) / (1.0 + (surfaces - 1.0) * r), 2e-5);
        close(passed + back, 1.0, 2e-5);
    }
}

#[test]
fn an_absorbing_plate_sums_its_reflections_geometrically() {
    for (degrees, passes, reflects) in [(0.0, 0.339_111, 0.044_990), (60.0, 0.243_925, 0.095_579)] {
        let mut scene = plates(1, 1.5);
        scene.media[1].absorption_per_m = DVec3::ONE;
        let [passed, back] = shares(scene, degrees, 1e-14);
        close(passed, passes, 5e-7);
        close(back, reflects, 5e-7);
    }
}

#[test]
fn a_plate_shifts_the_direct_path_and_keeps_its_direction() {
    for degrees in [0.0, 10.0, 30.0, 60.0, 85.0] {
        let shot = shoot(&plates(1, 1.5), DVec3::new(0.0, 0.0, 3.0), tilted(degrees));
        assert!((shot.exit - shot.sent).length() < 1e-14, "{degrees}");
        // Distance of the exit from the line of entry.
        let shift = (shot.exit_position - DVec3::new(0.0, 0.0, 3.0)).cross(shot.sent).length();
        let (sin, cos) = degrees.to_radians().sin_cos();
        close(shift, sin * (1.0 - cos / (1.5 * 1.5 - sin * sin).sqrt()), 1e-14);
        if degrees == 60.0 {
            close(shift, 0.512_472, 5e-7);
        }
    }
}

/// A prism about z with this angle at its top, as a mesh.
fn prism(apex_deg: f64) -> Scene {
    let half = (0.5 * apex_deg).to_radians().tan();
    let outline = [DVec2::new(0.0, 0.5), DVec2::new(-half, -0.5), DVec2::new(half, -0.5)];
    let mesh = scenes::generate::extruded(&outline, 5.0);
    furnace(vec![object(Shape::Mesh(mesh), 1, Normals::Flat)], 1.5)
}

/// Deviation by the prism of a ray at an angle of incidence on its left face.
fn deviation_deg(apex_deg: f64, incidence_deg: f64) -> Option<f64> {
    // The face's inward normal points right and, turned by half the apex, down.
    let turn = (incidence_deg - 0.5 * apex_deg).to_radians();
    let direction = DVec3::new(turn.cos(), turn.sin(), 0.0);
    let entry = DVec3::new(-0.1 * (0.5 * apex_deg).to_radians().tan(), 0.4, 0.0123);
    let shot = shoot(&prism(apex_deg), entry - 3.0 * direction, direction);
    assert!(shot.events >= 2);
    (shot.events == 2 && shot.total_reflections == 0)
        .then(|| angle(shot.exit, shot.sent).to_degrees())
}

#[test]
fn a_prism_deviates_least_when_passed_symmetrically() {
    let symmetric = (1.5 * 30.0_f64.to_radians().sin()).asin().to_degrees();
    let least = deviation_deg(60.0, symmetric).unwrap();
    close(least, 37.180_8, 5e-5);
    close(((60.0 + least) / 2.0).to_radians().sin() / 30.0_f64.to_radians().sin(), 1.5, 1e-13);
    for off in [-3.0, -0.5, 0.5, 3.0] {
        assert!(deviation_deg(60.0, symmetric + off).unwrap() > least);
    }
    // At any incidence: deviation = entry + exit angle - apex.
    let inside = (40.0_f64.to_radians().sin() / 1.5).asin();
    let beyond = (1.5 * (60.0_f64.to_radians() - inside).sin()).asin().to_degrees();
    close(deviation_deg(60.0, 40.0).unwrap(), 40.0 + beyond - 60.0, 1e-11);
}

#[test]
fn a_prism_beyond_twice_the_critical_angle_passes_nothing() {
    let limit = 2.0 * (1.0_f64 / 1.5).asin().to_degrees();
    close(limit, 83.62, 5e-3);
    assert!(deviation_deg(limit - 0.2, 89.9).is_some());
    for incidence in [10.0, 45.0, 80.0, 89.9] {
        assert!(deviation_deg(limit + 0.2, incidence).is_none());
    }
}

#[test]
fn without_a_change_of_index_nothing_is_seen() {
    let scene = plates(1, 1.0);
    let shot = shoot(&scene, DVec3::new(0.0, 0.0, 3.0), tilted(60.0));
    assert_eq!((shot.events, shot.exit), (0, DVec3::ZERO));
    let radiance = Environment::radiance(&scene.environment, tilted(60.0));
    assert_eq!(gather(&scene, DVec3::new(0.0, 0.0, 3.0), tilted(60.0), 1e-9), radiance);
}
