//! What a scene does not need is left out, and leaving it out changes no bit.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;

use common::{cup, furnace, icosphere, object, torus};
use glam::{DAffine3, DVec3};
use reference::{Keep, Level, Request, plan, render};
use scenes::environment::{LatLong, Map};
use scenes::scene::Normals;
use scenes::{Cube, Environment, LayerName, Medium, MediumId, Scene, Shape, Surface};
use std::sync::Arc;
use test_support::view;

const ALL: [LayerName; 11] = [
    LayerName::Radiance,
    LayerName::Coverage,
    LayerName::Exit,
    LayerName::ExitPosition,
    LayerName::First,
    LayerName::Hit2,
    LayerName::Events,
    LayerName::TotalReflections,
    LayerName::Flags,
    LayerName::Truncated,
    LayerName::Samples,
];

/// Radiance that names its direction.
fn directions() -> Environment {
    let texels = vec![[0.5; 3]; 8];
    Environment::Map(Arc::new(Map {
        name: "directions".to_owned(),
        lat_long: LatLong { size_px: [4, 2], texels },
        cube: Cube::from_fn(32, |d| 0.5 + 0.5 * d),
        rotation_deg: 0.0,
        repaired_texels: 0,
    }))
}

fn one(shape: Shape, normals: Normals) -> Scene {
    let mut scene = furnace(vec![object(shape, 1, normals)], 1.5);
    scene.environment = directions();
    scene
}

fn request() -> Request {
    Request::new(view(48, 2, &ALL), Level::R1)
}

/// Renders both ways, checks that the plan says what was specialised.
fn agrees(scene: &Scene, feature: &str) {
    for level in [Level::R0, Level::R1] {
        let special = Request { level, ..request() };
        let general = Request { keep: Keep::Everything, ..special.clone() };
        let plan = plan(scene, &special).unwrap();
        let said = |plan: &scenes::Plan| {
            plan.left_out.iter().any(|left| left.what == feature || left.reason.contains(feature))
        };
        assert!(said(&plan), "{feature}: {plan:?}");
        let images = [&special, &general].map(|request| render(scene, request).unwrap());
        assert!(!said(&images[1].plan), "{feature} is not in the general variant");
        for (a, b) in images[0].layers.list.iter().zip(&images[1].layers.list) {
            let bits = |data: &[f64]| data.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&a.data), bits(&b.data), "{feature} {level:?} {}", a.name);
        }
    }
}

#[test]
fn one_convex_body_needs_no_counts() {
    agrees(&one(Shape::Mesh(icosphere(3)), Normals::Smooth), "winding counts");
    agrees(&one(Shape::Mesh(icosphere(3)), Normals::Flat), "winding counts");
    agrees(&one(Shape::Sphere { radius_m: 1.0 }, Normals::Smooth), "winding counts");
    agrees(
        &one(Shape::Box { half_extent_m: DVec3::new(0.7, 0.5, 0.6) }, Normals::Flat),
        "winding counts",
    );
}

#[test]
fn one_medium_needs_one_count() {
    let mut scene = one(Shape::Mesh(torus()), Normals::Smooth);
    scene.objects.push(object(Shape::Sphere { radius_m: 0.6 }, 1, Normals::Flat));
    agrees(&scene, "a winding count per medium");
}

#[test]
fn a_uniform_environment_needs_no_lookup() {
    let mut scene = one(Shape::Mesh(cup()), Normals::Smooth);
    scene.environment = Environment::Uniform(DVec3::new(0.2, 0.5, 0.9));
    agrees(&scene, "environment lookup");
}

#[test]
fn clear_media_need_no_lengths() {
    agrees(&one(Shape::Mesh(cup()), Normals::Flat), "lengths per medium");
}

#[test]
fn a_body_of_index_one_cannot_be_seen() {
    let mut with = one(Shape::Mesh(cup()), Normals::Smooth);
    with.media[1] = Medium::vacuum();
    let mut without = with.clone();
    without.objects.clear();
    let images = [&with, &without].map(|scene| {
        let layers = [LayerName::Radiance, LayerName::Exit];
        render(scene, &Request::new(view(48, 2, &layers), Level::R1)).unwrap()
    });
    assert_eq!(images[0].layers, images[1].layers);
}

#[test]
fn the_image_does_not_depend_on_the_number_of_threads() {
    let scene = one(Shape::Mesh(cup()), Normals::Smooth);
    let image = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| render(&scene, &request()).unwrap())
    };
    let [one, two, seven] = [1, 2, 7].map(image);
    assert_eq!(one.layers, two.layers);
    assert_eq!(one.layers, seven.layers);
    assert_eq!(one.counters, seven.counters);
}

/// Powers of two change no mantissa: an absolute epsilon anywhere would show.
#[test]
fn scaling_by_a_power_of_two_changes_no_bit() {
    let mut layers = ALL.to_vec();
    layers.retain(|name| !matches!(name, LayerName::ExitPosition | LayerName::Hit2));
    let image = |s: f64| {
        let mut scene = one(Shape::Mesh(cup()), Normals::Smooth);
        scene.objects.push(object(Shape::Sphere { radius_m: 0.3 }, 2, Normals::Flat));
        scene.objects[1].surface = Surface::Dielectric { medium: MediumId(2), priority: 1 };
        scene.media.push(Medium::plain("water", scenes::Eta::try_from(1.33).unwrap()));
        for object in &mut scene.objects {
            object.world_from_object = DAffine3::from_scale(DVec3::splat(s));
        }
        scene.camera.eye *= s;
        scene.camera.target *= s;
        render(&scene, &Request::new(view(40, 2, &layers), Level::R1)).unwrap().layers
    };
    let unit = image(1.0);
    for k in [-20, -7, 1, 20] {
        assert_eq!(unit, image(2.0_f64.powi(k)), "2^{k}");
    }
    // The control: other factors round differently, and this would show it.
    assert_ne!(unit, image(3.0));
}
