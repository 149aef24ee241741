#![allow(clippy::unwrap_used, reason = "a failing test may panic")]
//! The sun has the same flux in every image of the sky.

use super::{Environment, Map, Sky, Sun, direction_of};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

const RADIANCE: f64 = 700.0;

/// A sun in a black sky.
fn night(towards: DVec3, radius_deg: f64) -> Sky {
    let sun = Sun { direction: towards.normalize(), radius_deg, radiance: DVec3::splat(RADIANCE) };
    let (zenith, horizon, ground) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
    Sky { zenith, horizon, ground, sun: Some(sun), checker: None, graticule: None }
}

/// Radiance times solid angle of a disc whose edge falls as 1 - t² (3 - 2 t)
/// from 0.95 to 1.05 radii.
fn flux_of_the_disc(radius_deg: f64) -> f64 {
    let radius = radius_deg.to_radians();
    let steps = 200_000;
    let width = 1.05 * radius / f64::from(steps);
    let ring = |i: i32| {
        let angle = (f64::from(i) + 0.5) * width;
        let t = ((angle / radius - 0.95) / 0.1).clamp(0.0, 1.0);
        TAU * angle.sin() * width * (1.0 - t * t * (3.0 - 2.0 * t))
    };
    RADIANCE * (0..steps).map(ring).sum::<f64>()
}

/// Integral of what is looked up over the texels within an angle of a direction:
/// at 4 x 4 places in each, two of Gauss's in each half, where a bilinear lookup
/// is smooth. `at`: direction and steradians per unit of area
/// of a place in the unit square.
fn flux_near(
    (towards, within): (DVec3, f64),
    [columns, rows]: [u32; 2],
    at: impl Fn(DVec2) -> (DVec3, f64),
    look: impl Fn(DVec3) -> DVec3,
) -> f64 {
    let size = DVec2::new(1.0 / f64::from(columns), 1.0 / f64::from(rows));
    let texels = (0..rows).flat_map(|y| (0..columns).map(move |x| [x, y]));
    let lows = texels.map(|texel| DVec2::from_array(texel.map(f64::from)) * size);
    let near = lows.filter(|low| at(*low + 0.5 * size).0.dot(towards) > within.cos());
    let flux = |low: DVec2| {
        let along = [-1.0, 1.0].map(|half: f64| [-1.0, 1.0].map(|g| half + g / 3.0f64.sqrt()));
        let along = along.as_flattened().iter().map(|place| 0.5 + 0.25 * place);
        let places = along.clone().flat_map(|x| along.clone().map(move |y| DVec2::new(x, y)));
        let shown = places.map(|place| at(low + place * size));
        shown.map(|(d, density)| look(d).x * density / 16.0).sum::<f64>()
    };
    size.element_product() * near.map(flux).sum::<f64>()
}

/// What the cube and the lat-long original keep of a disc's flux.
fn kept(towards: DVec3, radius_deg: f64, size_px: u32) -> [f64; 2] {
    let sky = night(towards, radius_deg);
    let map = Map::from_sky(&sky, 0.0, Some(size_px));
    let environment = Environment::Map(Arc::new(map));
    let near = |texel: f64| (towards.normalize(), (1.05 * radius_deg).to_radians() + 3.0 * texel);
    let on_face = |face| {
        move |at: DVec2| {
            let q = 1.0 + (2.0 * at - 1.0).length_squared();
            (direction_of(face, at), 4.0 / q.powf(1.5))
        }
    };
    let size = f64::from(size_px);
    let look = |d| environment.radiance(d);
    let face = |face| flux_near(near(2.0 / size), [size_px; 2], on_face(face), look);
    let cube = (0..6).map(face).sum::<f64>();
    let on_globe = |at: DVec2| {
        let ((sin_phi, cos_phi), (sin, cos)) = ((TAU * at.x).sin_cos(), (PI * at.y).sin_cos());
        (DVec3::new(sin * sin_phi, cos, -sin * cos_phi), TAU * PI * sin)
    };
    let look = |d| environment.radiance_lat_long(d);
    let lat_long = flux_near(near(PI / size), [2 * size_px, size_px], on_globe, look);
    [cube, lat_long].map(|flux| flux / flux_of_the_disc(radius_deg))
}

/// Whatever the size of the disc and of the texels, and wherever it stands: in
/// the middle of a face, on an edge, in a corner, over a pole.
#[test]
fn the_sun_keeps_its_flux() {
    let nowhere_special = DVec3::new(0.31, 0.83, -0.42);
    let mut cases = Vec::new();
    for towards in [DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.1), DVec3::ONE, nowhere_special] {
        cases.extend([0.01, 0.27, 3.0].map(|radius| (towards, radius, 16)));
    }
    for size_px in [32, 64, 128] {
        cases.extend([0.01, 0.1, 0.27, 1.0, 5.0].map(|radius| (nowhere_special, radius, size_px)));
    }
    cases.extend([(DVec3::Y, 0.05, 64), (nowhere_special, 0.27, 512)]);
    for (towards, radius_deg, size_px) in cases {
        for (image, kept) in
            ["cube", "lat-long"].into_iter().zip(kept(towards, radius_deg, size_px))
        {
            let case = format!("{image} of {size_px}, {radius_deg} degrees towards {towards}");
            assert!((kept - 1.0).abs() < 1e-4, "{case}: {kept}");
        }
    }
}

/// The disc stays where it is and as bright as it is: no texel is brighter than
/// it by more than its weight in lookups says.
#[test]
fn the_sun_stays_where_it_is() {
    let sky = night(DVec3::new(0.2, 0.4, -1.0), 3.0);
    let sun = sky.sun.unwrap();
    for rotation_deg in [0.0, 70.0] {
        let map = Map::from_sky(&sky, rotation_deg, Some(256));
        let turn = glam::DQuat::from_rotation_y(-f64::to_radians(rotation_deg));
        let environment = Environment::Map(Arc::new(map));
        let across = sun.direction.any_orthonormal_vector();
        for (angle_deg, expected) in [(0.0, RADIANCE), (1.5, RADIANCE), (4.5, 0.0), (20.0, 0.0)] {
            let angle = f64::to_radians(angle_deg);
            let at = turn * (angle.cos() * sun.direction + angle.sin() * across);
            for found in [environment.radiance(at), environment.radiance_lat_long(at)] {
                assert!((found.x - expected).abs() < 1e-4 * RADIANCE, "{angle_deg}: {found}");
            }
        }
    }
}

/// A small disc of radius r has the solid angle π sin² r, weighted by the
/// cosine; the soft edge changes it by less than a per cent.
#[test]
fn the_suns_irradiance_is_radiance_times_projected_solid_angle() {
    let sun = night(DVec3::X, 2.0).sun.unwrap();
    let sharp = RADIANCE * PI * 2.0f64.to_radians().sin().powi(2);
    assert!((sun.irradiance().x / sharp - 1.0).abs() < 0.01);
}
