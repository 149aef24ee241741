//! Colour: dispersion, absorption, and light that tells its direction.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;
mod shots;

use common::{cup, furnace, object};
use glam::DVec3;
use reference::{EnvironmentLookup, Level, Request, render};
use scenes::environment::{Cube, LatLong, Map};
use scenes::medium::RGB_WAVELENGTH_UM;
use scenes::scene::Normals;
use scenes::{Dispersion, Environment, Eta, LayerName, Medium, Scene, Shape};
use shots::{gather, shoot};
use std::sync::Arc;
use test_support::view;

fn close(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{found} is not {expected} within {within}");
}

/// Schott N-BK7, coefficients of the maker's data sheet.
fn crown() -> Medium {
    Medium {
        dispersion: Dispersion::Sellmeier {
            b: [1.039_612_12, 0.231_792_344, 1.010_469_45],
            c_um2: [0.006_000_698_67, 0.020_017_914_4, 103.560_653],
        },
        ..Medium::plain("crown", Eta::try_from(1.5168).unwrap())
    }
}

#[test]
fn sellmeiers_law_gives_the_makers_indices() {
    let [c, d, f] = RGB_WAVELENGTH_UM.map(|wavelength| crown().eta_at(wavelength));
    close(d, 1.516_80, 5e-6);
    close(f, 1.522_376, 1e-6);
    close(c, 1.514_322, 1e-6);
    close((d - 1.0) / (f - c), 64.167, 5e-3);
}

#[test]
fn an_abbe_number_of_20_over_the_dispersion_comes_back() {
    for dispersion in [0.1, 0.312, 1.0] {
        let medium = Medium {
            dispersion: Dispersion::Gltf { dispersion },
            ..Medium::plain("glass", Eta::try_from(1.6).unwrap())
        };
        let [c, d, f] = RGB_WAVELENGTH_UM.map(|wavelength| medium.eta_at(wavelength));
        close(d, 1.6, 1e-15);
        close((d - 1.0) / (f - c), 20.0 / dispersion, 1e-9);
    }
}

/// Radiance that is a linear function of direction in every place of the cube's
/// faces, so that filtering hardly blurs it.
fn directions() -> Environment {
    let radiance = |d: DVec3| DVec3::splat(0.5) + 0.5 * d;
    let lat_long = LatLong { size_px: [2, 1], texels: vec![[0.5; 3]; 2] };
    let map = Map {
        name: "directions".to_owned(),
        lat_long,
        cube: Cube::from_fn(1024, radiance),
        rotation_deg: 0.0,
        repaired_texels: 0,
    };
    Environment::Map(Arc::new(map))
}

#[test]
fn each_channel_leaves_the_ball_by_its_own_index() {
    let mut scene = furnace(vec![object(Shape::Sphere { radius_m: 1.0 }, 1, Normals::Flat)], 1.5);
    scene.media[1] = crown();
    scene.environment = directions();
    let (impact, cut) = (0.8_f64, 0.5);
    let colour = gather(&scene, DVec3::new(impact, 0.0, 3.0), -DVec3::Z, cut);
    for channel in 0..3 {
        let eta = crown().eta_at(RGB_WAVELENGTH_UM[channel]);
        let plain = {
            let mut plain = scene.clone();
            plain.media[1] = Medium::plain("one", Eta::try_from(eta).unwrap());
            gather(&plain, DVec3::new(impact, 0.0, 3.0), -DVec3::Z, cut)
        };
        close(colour[channel], plain[channel], 1e-14);
    }
    // The control: the channels are not those of one index.
    let mut plain = scene.clone();
    plain.media[1] = Medium::plain("d", Eta::try_from(crown().eta_at(0.587_561_8)).unwrap());
    let other = gather(&plain, DVec3::new(impact, 0.0, 3.0), -DVec3::Z, cut);
    assert!((colour.z - other.z).abs() > 1e-5, "{colour} {other}");
}

/// The colour seen is the exit direction shown: chain and tree agree.
#[test]
fn light_that_tells_its_direction_shows_the_exit_direction() {
    let mut scene = furnace(vec![object(Shape::Mesh(cup()), 1, Normals::Flat)], 1.5);
    scene.environment = directions();
    let mut request = Request::new(view(64, 1, &[LayerName::Radiance, LayerName::Exit]), Level::R0);
    request.environment_lookup = EnvironmentLookup::Cube;
    let rendering = render(&scene, &request).unwrap();
    let data = |name| rendering.layers.get(&name).unwrap().data.clone();
    let mut seen = 0;
    for (colour, exit) in data(LayerName::Radiance).chunks(3).zip(data(LayerName::Exit).chunks(3)) {
        let (colour, exit) = (DVec3::from_slice(colour), DVec3::from_slice(exit));
        if exit != DVec3::ZERO {
            // Within a texel: at the faces' edges the nearest one is repeated.
            assert!((2.0 * colour - 1.0 - exit).length() < 2e-3, "{colour} {exit}");
            seen += 1;
        }
    }
    assert!(seen > 500, "{seen}");
}

fn amber(absorption: f64) -> Scene {
    let mut scene = furnace(vec![object(Shape::Slab { thickness_m: 1.0 }, 1, Normals::Flat)], 1.5);
    scene.media[1].absorption_per_m = DVec3::new(absorption, 0.0, 2.0 * absorption);
    scene
}

/// Twice the depth is the square of the transmittance.
#[test]
fn absorption_multiplies_along_the_path() {
    let origin = DVec3::new(0.0, 0.0, 3.0);
    let d = DVec3::new(0.3, 0.2, -1.0).normalize();
    let shot = shoot(&amber(1.0), origin, d);
    assert_eq!(shot.events, 2);
    // The chain carries no Fresnel weights: only absorption is left.
    let through = |absorption: f64| {
        let scene = amber(absorption);
        let camera = scenes::Camera {
            eye: origin,
            target: origin + d,
            projection: scenes::Projection::Orthographic { height_m: 1e-300 },
            resolution_px: [1, 1],
            ..scene.camera
        };
        let request = Request::new(view(1, 1, &[LayerName::Radiance]), Level::R0);
        let rendering = render(&Scene { camera, ..scene }, &request).unwrap();
        DVec3::from_slice(&rendering.layers.get(&LayerName::Radiance).unwrap().data)
    };
    let (once, twice) = (through(0.7), through(1.4));
    close(twice.x, once.x * once.x, 1e-15);
    close(once.z, once.x * once.x, 1e-15);
    let cos = shot.first.z.abs();
    close(once.x, (-0.7 / cos).exp(), 1e-15);
    assert_eq!(through(0.0), DVec3::ONE);
    assert_eq!(through(1e6).x, 0.0);
    assert_eq!(through(1e-12).y, 1.0);
}
