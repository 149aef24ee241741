//! Light of many wavelengths in place of three.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;

use common::{cup, furnace, object};
use glam::DVec3;
use reference::{Error, Level, Request, Spectrum, render};
use scenes::environment::{Cube, LatLong, Map};
use scenes::scene::Normals;
use scenes::{Dispersion, Environment, Eta, LayerName, Medium, Scene, Shape};
use std::sync::Arc;
use test_support::view;

/// Cauchy's law through 1.6 at the d line.
fn dispersive(b_um2: f64) -> Medium {
    let a = 1.6 - b_um2 / 0.587_561_8_f64.powi(2);
    Medium {
        dispersion: Dispersion::Cauchy { a, b_um2 },
        ..Medium::plain("glass", Eta::try_from(1.6).unwrap())
    }
}

/// An environment that is bright on one side and coloured.
fn coloured() -> Environment {
    let radiance = |d: DVec3| DVec3::new(1.5 + d.x, 1.0 + 0.5 * d.y, 1.2 - d.z);
    let map = Map {
        name: "coloured".to_owned(),
        lat_long: LatLong { size_px: [2, 1], texels: vec![[1.0; 3]; 2] },
        cube: Cube::from_fn(64, radiance),
        rotation_deg: 0.0,
        repaired_texels: 0,
    };
    Environment::Map(Arc::new(map))
}

fn ball(medium: Medium) -> Scene {
    let body = object(Shape::Sphere { radius_m: 1.0 }, 1, Normals::Flat);
    let mut scene = furnace(vec![body], 1.6);
    scene.media[1] = medium;
    scene.environment = coloured();
    scene
}

/// Radiance and what was dropped of it.
fn image(scene: &Scene, spectrum: Spectrum) -> [Vec<f64>; 2] {
    let view = view(24, 2, &[LayerName::Radiance, LayerName::Truncated]);
    let request = Request { spectrum, ..Request::new(view, Level::R1) };
    let layers = render(scene, &request).unwrap().layers;
    [LayerName::Radiance, LayerName::Truncated].map(|name| layers.get(&name).unwrap().data.clone())
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn without_dispersion_the_number_of_wavelengths_changes_no_bit() {
    let scene = ball(dispersive(0.0));
    assert_eq!(image(&scene, Spectrum::Channels), image(&scene, Spectrum::Wavelengths(31)));
}

/// All colours of glass that hardly disperses take one way: what is mixed from
/// wavelengths is what was given.
#[test]
fn as_dispersion_goes_to_nothing_so_does_what_wavelengths_change() {
    let differs = |b_um2: f64| {
        let scene = ball(dispersive(b_um2));
        let [many, _] = image(&scene, Spectrum::Wavelengths(31));
        let [plain, _] = image(&ball(dispersive(0.0)), Spectrum::Channels);
        apart(&many, &plain)
    };
    // Branches are cut elsewhere by then, so not to zero.
    assert!(differs(1e-12) < 1e-3, "{}", differs(1e-12));
    assert!(differs(0.05) > 1e-2, "{}", differs(0.05));
}

/// Finer steps change less and less: 16, 32 and 64 against 256 wavelengths.
#[test]
fn more_wavelengths_converge() {
    let scene = ball(dispersive(0.02));
    let [exact, _] = image(&scene, Spectrum::Wavelengths(256));
    let error = |count| {
        let [found, _] = image(&scene, Spectrum::Wavelengths(count));
        (found.iter().zip(&exact).map(|(a, b)| (a - b).powi(2)).sum::<f64>()).sqrt()
    };
    let [coarse, middle, fine] = [16, 32, 64].map(error);
    assert!(fine < 0.6 * middle && middle < 0.6 * coarse, "{coarse} {middle} {fine}");
    // Three lines are another question, not a coarse answer to this one.
    let [channels, _] = image(&scene, Spectrum::Channels);
    assert!(apart(&channels, &exact) > 1e-3);
}

/// A body that takes no light is invisible in white light of any spectrum.
#[test]
fn white_light_stays_white_in_a_furnace() {
    let mut scene = furnace(vec![object(Shape::Mesh(cup()), 1, Normals::Flat)], 1.6);
    scene.media[1] = dispersive(0.02);
    let [radiance, truncated] = image(&scene, Spectrum::Wavelengths(16));
    for (rgb, dropped) in radiance.chunks_exact(3).zip(truncated) {
        for value in rgb {
            assert!((value - 1.0).abs() <= dropped + 1e-9, "{rgb:?} {dropped}");
        }
    }
}

#[test]
fn too_few_or_too_many_wavelengths_are_refused() {
    for count in [0, 7, 1025] {
        let view = view(2, 1, &[LayerName::Radiance]);
        let spectrum = Spectrum::Wavelengths(count);
        let request = Request { spectrum, ..Request::new(view, Level::R1) };
        let error = render(&ball(dispersive(0.02)), &request).unwrap_err();
        assert!(matches!(error, Error::Range { name: "wavelengths", .. }), "{error}");
    }
}

/// An index below 1 for one colour (anomalous dispersion) is physics like any
/// other: red light is totally reflected from outside, and none is lost or made.
#[test]
fn a_colour_below_vacuum_loses_and_gains_nothing() {
    let (bent, d_um) = (0.9, 0.587_561_8_f64);
    let mut scene = furnace(vec![object(Shape::Sphere { radius_m: 1.0 }, 1, Normals::Flat)], 1.2);
    scene.media[1] = Medium {
        dispersion: Dispersion::Cauchy { a: 1.2 - bent / d_um.powi(2), b_um2: bent },
        ..Medium::plain("anomalous", Eta::try_from(1.2).unwrap())
    };
    let red = scene.media[1].eta_at(0.656_272_5);
    assert!((0.6..0.8).contains(&red), "{red}");
    let [radiance, truncated] = image(&scene, Spectrum::Channels);
    for (pixel, lost) in radiance.chunks_exact(3).zip(&truncated) {
        let sound = pixel.iter().all(|v| (1.0 - lost - 1e-9..=1.0 + 1e-9).contains(v));
        assert!(sound, "{pixel:?} where {lost} was dropped");
    }
}

/// A law may have an index for red, green and blue, and none at other
/// wavelengths that are traced.
#[test]
fn every_wavelength_that_is_traced_has_an_index() {
    let ask = |b_um2: f64, spectrum| {
        let request = Request { spectrum, ..Request::new(view(8, 1, &[]), Level::R1) };
        (render(&ball(dispersive(b_um2)), &request).map(|_| ()), request)
    };
    let many = Spectrum::Wavelengths(31);
    assert_eq!(ask(-0.45, Spectrum::Channels).0, Ok(()));
    assert_eq!(ask(-0.2, many).0, Ok(()));
    let (Err(Error::Dispersion(error)), request) = ask(-0.45, many) else { panic!() };
    assert!((390.0..400.0).contains(&error.nm) && error.eta < 0.1, "{error}");
    let plan = reference::plan(&ball(dispersive(-0.45)), &request).map(|_| ());
    assert_eq!(plan, Err(Error::Dispersion(error)));
    // Scenes that no file was read for are checked as well.
    assert!(matches!(ask(-1.2, Spectrum::Channels).0, Err(Error::Dispersion(_))));
}
