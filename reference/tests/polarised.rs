//! Light whose polarisation is followed: plates, stacks and the rainbow.
//!
//! Source: M. Born, E. Wolf, "Principles of Optics", 7th ed., 1.5; H. C. van de
//! Hulst, "Light Scattering by Small Particles", 13.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;
mod shots;

use common::{cup, furnace, icosphere, object};
use glam::{DAffine3, DVec3};
use reference::{Estimator, Level, Paths, Request, render};
use scenes::scene::Normals;
use scenes::{Camera, LayerName, Projection, Scene, Shape};
use shots::two_halves;
use test_support::view;

fn close(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{found} is not {expected} within {within}");
}

fn stokes_layer() -> LayerName {
    LayerName::Buffer("stokes".to_owned())
}

/// I and (Q, U, V) of one ray over paths of at most so many events; without
/// polarisation I alone.
fn light(scene: &Scene, origin: DVec3, d: DVec3, events: u32, polarised: bool) -> (f64, DVec3) {
    let camera = Camera {
        eye: origin,
        target: origin + d,
        up: DVec3::Y,
        projection: Projection::Orthographic { height_m: 1e-300 },
        resolution_px: [1, 1],
    };
    let mut layers = vec![LayerName::Radiance];
    layers.extend(polarised.then(stokes_layer));
    let mut request = Request::new(view(1, 1, &layers), Level::R1);
    request.estimator = Estimator::Tree { cut: 1e-9 };
    request.restriction.max_events = events;
    request.polarised = polarised;
    let rendering = render(&Scene { camera, ..scene.clone() }, &request).unwrap();
    let vector = |name| DVec3::from_slice(&rendering.layers.get(&name).unwrap().data);
    let rest = if polarised { vector(stokes_layer()) } else { DVec3::ZERO };
    (vector(LayerName::Radiance).y, rest)
}

fn plates(count: u32, eta: f64) -> Scene {
    let plate = |i: u32| {
        let mut plate = object(Shape::Slab { thickness_m: 1.0 }, 1, Normals::Flat);
        plate.world_from_object = DAffine3::from_translation(DVec3::Z * (-2.0 * f64::from(i)));
        plate
    };
    furnace((0..count).map(plate).collect(), eta)
}

/// What plates pass at an angle, in degrees.
fn passed(count: u32, eta: f64, degrees: f64, polarised: bool) -> (f64, DVec3) {
    let mut scene = plates(count, eta);
    scene.environment = two_halves(1.0, 0.0);
    let (sin, cos) = degrees.to_radians().sin_cos();
    let origin = DVec3::new(0.0, 0.0, 3.0);
    light(&scene, origin, DVec3::new(sin, 0.0, -cos), 20_000, polarised)
}

#[test]
fn a_plate_reflects_less_of_polarised_light_at_60_degrees() {
    close(1.0 - passed(1, 1.5, 60.0, true).0, 0.151_872, 5.1e-7);
    close(1.0 - passed(1, 1.5, 60.0, false).0, 0.163_768, 5.1e-7);
    // Head-on there is no difference.
    close(passed(1, 1.5, 0.0, true).0, 0.923_077, 5.1e-7);
}

/// At Brewster's angle light in the plane of incidence passes every plate.
#[test]
fn a_stack_of_plates_at_brewsters_angle_polarises() {
    let eta = 1.5_f64;
    let across = ((eta * eta - 1.0) / (eta * eta + 1.0)).powi(2);
    for (count, within) in [(1, 1e-7), (2, 1e-4)] {
        let (intensity, rest) = passed(count, eta, eta.atan().to_degrees(), true);
        let surfaces = f64::from(2 * count);
        let s = (1.0 - across) / (1.0 + (surfaces - 1.0) * across);
        close(intensity, 0.5 * (1.0 + s), within);
        close(rest.length() / intensity, (1.0 - s) / (1.0 + s), within);
    }
}

/// How much an unpolarised calculation underestimates what a plate passes.
#[test]
fn averaging_at_every_surface_loses_light_in_a_plate() {
    for (eta, most) in [(1.309, 0.010), (1.5, 0.022), (2.417, 0.078)] {
        let gain =
            |degrees: f64| passed(1, eta, degrees, true).0 - passed(1, eta, degrees, false).0;
        let found = (60..90).map(|degrees| gain(f64::from(degrees))).fold(0.0, f64::max);
        close(found, most, 7e-4);
    }
}

/// Light that was reflected once in a drop, at the angle of the rainbow.
#[test]
fn the_rainbow_is_polarised_along_its_arc() {
    let drop = furnace(vec![object(Shape::Sphere { radius_m: 1.0 }, 1, Normals::Flat)], 4.0 / 3.0);
    let once = |polarised| {
        let part =
            |events| light(&drop, DVec3::new(0.860_66, 0.0, 3.0), -DVec3::Z, events, polarised);
        let (two, three) = (part(2), part(3));
        (three.0 - two.0, three.1 - two.1)
    };
    let (intensity, rest) = once(true);
    close(intensity, 0.045_61, 5.1e-6);
    close(once(false).0, 0.050_91, 5.1e-6);
    close(rest.length() / intensity, 0.925, 5.1e-4);
    // Across the plane of incidence, which holds the image's horizontal here.
    close(rest.x / intensity, -0.925, 5.1e-4);
}

/// Interpolated normals trap light without end: paths must get out again, and not
/// be dropped after so many events.
#[test]
fn bodies_vanish_in_uniform_light_with_polarisation_too() {
    for (mesh, normals) in [cup(), icosphere(2)]
        .into_iter()
        .flat_map(|mesh| [Normals::Flat, Normals::Smooth].map(|normals| (mesh.clone(), normals)))
    {
        let scene = furnace(vec![object(Shape::Mesh(mesh), 1, normals)], 1.5);
        let layers = [LayerName::Radiance, LayerName::Truncated];
        let mut request = Request::new(view(32, 1, &layers), Level::R1);
        request.polarised = true;
        let rendering = render(&scene, &request).unwrap();
        let data = |name| rendering.layers.get(&name).unwrap().data.clone();
        for (pixel, lost) in data(LayerName::Radiance).chunks(3).zip(data(LayerName::Truncated)) {
            let sound = |v: &f64| *v <= 1.0 + 1e-9 && *v >= 1.0 - lost - 1e-9;
            assert!(pixel.iter().all(sound), "{pixel:?} {lost}");
            assert!(lost < 0.02, "{normals:?}: {lost}");
        }
        assert_eq!(rendering.counters["left_inside"], 0);
        assert_eq!(rendering.counters["capped"], 0, "{normals:?}");
    }
}

#[test]
fn what_cannot_be_polarised_is_refused() {
    let scene = plates(1, 1.5);
    let mut request = Request::new(view(1, 1, &[stokes_layer()]), Level::R1);
    assert!(render(&scene, &request).is_err());
    request.polarised = true;
    assert!(render(&scene, &request).is_ok());
    request.estimator = Estimator::Paths(Paths { batches: 2, samples: 2, ..Paths::default() });
    assert!(render(&scene, &request).is_err());
}
